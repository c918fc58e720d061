// SPDX-License-Identifier: BSD-3-Clause
// Every call of the system that each writer of granular.h makes fails in turn, with each fault. The reference is the run in which
// none does. Readers: failing_reads.cpp.
#include "../support/dumps.h"
#include "failing_cases.h"
#include "runs.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <string>

using namespace runs;

namespace
{
constexpr long most_of_calls = 8; ///< that are tried, where not all are wanted
constexpr long most_of_large = 2; ///< in files that take long

/// What came of a function.
struct Result
{
  granular_status status = GRANULAR_OK;
  std::string error; ///< its message
};

Result result_of(granular_status status)
{
  stop_failing();
  return { status, status == GRANULAR_OK ? "" : message() };
}

void expect_named(const FailingCase& one, const Result& result, const std::string& folder)
{
  EXPECT_TRUE(!one.harmless || result.status == GRANULAR_OK) << result.error;
  EXPECT_TRUE(result.status == GRANULAR_OK || of_memory(one) ||
    result.error.find(folder) != std::string::npos)
    << result.error;
  EXPECT_TRUE(result.status == GRANULAR_OK || !result.error.empty());
}

/// A file to write, from a file of a real run.
struct Target
{
  const char* name;
  const char* from;
  const char* file; ///< with `*` a file for each frame
  const char* style = "";
  const char* dialect = "";
  int sorted = 0;
  long rows = 0;   ///< of a file to read that is made, with this many
  int durable = 2; ///< the default
};

const Target targets[] = {
  { "text", "plain.dump", "new.dump" },
  { "text, sorted", "chain.dump", "new.dump", "", "", 1 },
  { "style atom", "ortho_scaled.dump", "new.dump", "atom" },
  { "binary", "chain.dump", "new.bin" },
  { "gzip", "chain.dump", "new.dump.gz" },
  { "Zstandard", "chain.dump", "new.dump.zst" },
  { "a file for each frame", "plain.dump", "new_*.dump" },
  { "a file for each frame, durable", "plain.dump", "new_*.dump", "", "", 0, 0, 1 },
  { "contacts", "local/contacts.dump", "new.bonds" },
  { "Euler cells", "euler_1000.vtk", "new.euler" },
  { "decomposition", "decomposition_1000.vtk", "new.decomposition" },
  { "decomposition, PUBLIC", "decomposition_1000.vtk", "new.decomposition", "", "PUBLIC" },
  { "many rows, sorted", "", "new.dump", "", "", 1, 530000 },
};

class FailingWriter : public ::testing::TestWithParam<Target>
{
protected:
  static constexpr const char* old_content = "what was there before";

  Result write_all(const FailingCalls& calls) const
  {
    const Target& target = GetParam();
    granular_format format;
    granular_format_init(&format);
    format.style = target.style;
    format.dialect = target.dialect;
    format.sort_by_id = target.sorted;
    format.threads = 2;
    format.durable = target.durable;
    const std::string path = folder_.path(target.file);
    make_fail(calls);
    return result_of(frames_.write(path, format));
  }

  void write_old() const
  {
    for (const auto& [name, bytes] : whole_)
    {
      folder_.write(name, old_content);
    }
  }

  /// Fails a call of a writer. Returns how many there were that might.
  long try_one(const FailingCase& one, long number)
  {
    const std::string folder = without_slash(folder_.path(""));
    this->write_old();
    if (one.leaves == Leaves::Older)
    {
      EXPECT_NE(this->write_all(leaving_calls(folder)).error, "");
      this->write_old();
    }
    const Result result = this->write_all(failing_calls_of(one, number, folder));
    const long possible = calls_that_may_fail();
    expect_named(one, result, folder);
    EXPECT_EQ(count_hidden(folder), possible >= number && one.leaves != Leaves::Nothing ? 1 : 0)
      << result.error;
    this->expect_old_or_new(result);
    EXPECT_EQ(this->write_all({}).error, "");
    EXPECT_TRUE(files_of(folder) == whole_) << result.error;
    return possible;
  }

  /// Each file is the old one or the new one, all are new where there was no error, and there are no others.
  void expect_old_or_new(const Result& result)
  {
    std::map<std::string, std::string> files = files_of(folder_.path(""));
    std::erase_if(files, [](const auto& file) { return is_hidden(file.first); });
    EXPECT_EQ(files.size(), whole_.size());
    const bool written_but = result.error.find(": written, but") != std::string::npos;
    written_but_ += written_but ? 1 : 0;
    for (const auto& [name, bytes] : files)
    {
      const bool is_new = bytes == whole_[name];
      EXPECT_TRUE(is_new || (result.status != GRANULAR_OK && bytes == old_content)) << result.error;
      // once one file has its name, the next ones may fail
      const bool one_file = whole_.size() == 1;
      EXPECT_TRUE(!one_file || result.status == GRANULAR_OK || !is_new || written_but)
        << result.error;
    }
  }

  static std::string source()
  {
    const Target& target = GetParam();
    return target.rows == 0 ? good(target.from)
                            : Folder().write("made.dump", dump_of_rows(target.rows));
  }

  Frames frames_{ source() };
  Folder folder_; ///< empty
  std::map<std::string, std::string> whole_;
  long written_but_ = 0;
};

std::string name_of(const ::testing::TestParamInfo<Target>& info)
{
  std::string name = info.param.name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}
}

TEST_P(FailingWriter, LeavesTheOldFileOrTheNewOne)
{
  ASSERT_EQ(this->write_all({}).error, "");
  whole_ = files_of(folder_.path(""));
  ASSERT_FALSE(whole_.empty());
  const bool large = GetParam().rows > 0;
  const bool waits = std::string(GetParam().name) != "a file for each frame"; // for the disk
  for (const FailingCase& one : large ? std::span<const FailingCase>(large_cases) : writer_cases)
  {
    if (GetParam().durable == 1 && (one.kinds & (calls::sync | calls::rename)) == 0)
    {
      continue; // as for the one file of "text", which waits for the disk, and for the files that do not
    }
    const long delivered = fail_each(one.name, large ? most_of_large : most_of_calls,
      [&](long number) { return this->try_one(one, number); });
    EXPECT_TRUE(HasFailure() || (delivered > 0) == (waits || one.kinds != calls::sync)) << one.name;
  }
  EXPECT_EQ(written_but_ > 0, waits && !large) << "of the folder, which is behind the file";
}

INSTANTIATE_TEST_SUITE_P(Kinds, FailingWriter, ::testing::ValuesIn(targets), name_of);

TEST(FailingDisk, SaysWhichFileALossOfPowerMayTakeBack)
{
  const Folder folder;
  const std::string path = folder.path("a.dump");
  const Frames frames(good("grains_1000.dump"));
  granular_format format;
  granular_format_init(&format);
  const std::string said[] = { ": cannot write: Input/output error",
    ": written, but a loss of power may take the new file back: cannot synchronise its folder: "
    "Input/output error" };
  for (const long number : { 1, 2 })
  {
    make_fail({ CallFault::Error, number, 1, calls::sync });
    EXPECT_EQ(result_of(frames.write(path, format)).error, path + said[number - 1]);
    EXPECT_EQ(fs::exists(path), number == 2);
  }
}
