// SPDX-License-Identifier: BSD-3-Clause
// Every call of the system that a function of granular.h makes fails in turn: for each reader and each writer, with each fault. The
// reference is the run in which none does.
#include "../c/handles.h"
#include "../support/dumps.h"
#include "failing_cases.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;

constexpr int threads = 2;
constexpr long most_of_memory = 20; ///< calls that are tried, where not all are wanted
constexpr long most_of_large = 2;   ///< in inputs that take long

// ---- faults ------------------------------------------------------------------------------------

/// What came of a function.
struct Result
{
  granular_status status = GRANULAR_OK;
  std::string error;   ///< its message
  std::string content; ///< of what was read
  std::string notices; ///< of files that cannot be read, among others
};

Result failed(granular_status status)
{
  stop_failing();
  return { status, granular_last_error()->message, "", "" };
}

/// Lets the last error of this thread always take the same memory.
void keep_long_error()
{
  const std::string path(100, 'x');
  const char* const name = path.c_str();
  granular_run* run = nullptr;
  EXPECT_EQ(granular_open(&name, 1, nullptr, &run), GRANULAR_IO_ERROR);
}

/// Calls use(case, number) for each call that may fail, in each way. use returns how many calls there were that might. Memory and
/// files must be as many after it as before.
void fail_each(std::span<const FailingCase> cases,
  const std::function<long(const FailingCase& one, long number)>& use,
  std::span<const NeverFires> never = {})
{
  FaultCount faults;
  for (const FailingCase& one : cases)
  {
    long made = 0;
    long delivered = 0;
    bool fired = true;
    for (long number = 1; fired;)
    {
      SCOPED_TRACE(std::string(one.name) + ", call " + std::to_string(number));
      const long files = open_files();
      const long before = live_blocks();
      const long possible = use(one, number);
      fired = possible >= number;
      made = std::max(made, possible);
      delivered += fired ? 1 : 0;
      keep_long_error();
      if (live_blocks() != before && !::testing::Test::HasFailure())
      {
        const long blocks = live_blocks(); // the first time, something may be kept for good
        use(one, number);
        keep_long_error();
        EXPECT_EQ(live_blocks(), blocks) << "memory is lost";
      }
      EXPECT_EQ(open_files(), files) << "files are left open";
      faults.add(fired);
      if (::testing::Test::HasFailure())
      {
        return;
      }
      const bool large = (one.kinds & (calls::map | calls::thread)) != 0;
      number = large     ? next_number(number, made, most_of_large)
        : of_memory(one) ? next_number(number, made, most_of_memory)
                         : number + 1;
    }
    expect_delivered(one.name, delivered, never);
  }
}

// ---- readers -----------------------------------------------------------------------------------

/// A run to read.
struct Input
{
  const char* name;
  std::vector<std::string> files;
  long rows = 0; ///< of a file that is made, with this many
};

class FailingInput : public ::testing::TestWithParam<Input>
{
};

/// Adds all that a frame holds to a text.
granular_status add_frame(granular_run* run, std::int64_t number, int table, std::string& text)
{
  granular_request request;
  granular_request_init(&request);
  request.threads = threads;
  request.table = table;
  granular_frame* read = nullptr;
  granular_status status = granular_read(run, number, &request, &read);
  const FrameHandle frame(read, granular_release);
  granular_frame_header header = {};
  status = status == GRANULAR_OK ? granular_header(read, &header) : status;
  for (std::size_t i = 0; status == GRANULAR_OK && i < header.arrays; ++i)
  {
    granular_array array = {};
    status = granular_array_at(read, i, &array);
    if (status == GRANULAR_OK)
    {
      const std::size_t width =
        array.type == GRANULAR_FLOAT64 || array.type == GRANULAR_INT64 ? 8 : 1;
      text += array.name;
      text.append(static_cast<const char*>(array.data),
        static_cast<std::size_t>(array.rows * array.components) * width);
    }
  }
  return status;
}

/// Reads all frames, while these calls fail.
Result read_all(const std::vector<const char*>& names, const FailingCalls& calls)
{
  Result result;
  result.content.reserve(
    std::size_t{ 1 } << 22); // the test takes no memory while memory is refused
  granular_open_options options;
  granular_open_options_init(&options);
  options.threads = threads;
  result.notices.reserve(std::size_t{ 1 } << 16);
  options.notice = [](const char* text, void* user)
  { static_cast<std::string*>(user)->append(text).append("\n"); };
  options.user = &result.notices;
  make_fail(calls);
  granular_run* opened = nullptr;
  result.status = granular_open(names.data(), names.size(), &options, &opened);
  const RunHandle run(opened, granular_close);
  granular_run_facts facts = {};
  granular_status& status = result.status;
  status = status == GRANULAR_OK ? granular_run_info(opened, &facts) : status;
  for (std::int64_t i = 0; status == GRANULAR_OK && i < facts.frames; ++i)
  {
    granular_frame_facts own = {};
    status = granular_frame_info(opened, i, &own);
    for (int table = 0; status == GRANULAR_OK && table < facts.tables; ++table)
    {
      status = add_frame(opened, i, table, result.content);
    }
  }
  stop_failing();
  result.error = status == GRANULAR_OK ? "" : message();
  return result;
}

// ---- writers -----------------------------------------------------------------------------------

/// A file to write, from a file of a real run.
struct Output
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

class FailingOutput : public ::testing::TestWithParam<Output>
{
protected:
  static constexpr const char* old_content = "what was there before";

  void SetUp() override
  {
    const Output& output = GetParam();
    const Folder own;
    own.write("made.dump", dump_of_rows(output.rows));
    const RunHandle run = open_run(output.rows > 0 ? own.path("made.dump") : good(output.from));
    granular_run_facts facts = {};
    granular_run_info(run.get(), &facts);
    for (std::int64_t i = 0; i < facts.frames; ++i)
    {
      frames_.push_back(read_frame(run, i));
    }
    ASSERT_FALSE(frames_.empty());
    fs::remove(own.path("made.dump"));
    path_ = folder_.path(output.file);
    ASSERT_EQ(this->write_all({}).error, "");
    for (const auto& entry : fs::directory_iterator(folder_.path("")))
    {
      const std::string name = entry.path().filename().string();
      names_.push_back(name);
      whole_.push_back(content(entry.path().string()));
    }
    ASSERT_FALSE(names_.empty());
  }

  /// All files as they were before.
  void begin() const
  {
    for (const auto& entry : fs::directory_iterator(folder_.path("")))
    {
      fs::remove(entry.path());
    }
    this->rewrite_old();
  }

  Result write_all(const FailingCalls& calls) const
  {
    const Output& output = GetParam();
    granular_format format;
    granular_format_init(&format);
    format.style = output.style;
    format.dialect = output.dialect;
    format.sort_by_id = output.sorted;
    format.threads = threads;
    format.durable = output.durable;
    make_fail(calls);
    granular_writer* writer = nullptr;
    granular_status status = granular_create(path_.c_str(), &format, &writer);
    if (status != GRANULAR_OK)
    {
      return failed(status);
    }
    for (const FrameHandle& frame : frames_)
    {
      status = granular_write_frame(writer, frame.get());
      if (status != GRANULAR_OK)
      {
        granular_abandon(writer); // which keeps the last error
        return failed(status);
      }
    }
    status = granular_finish(writer);
    stop_failing();
    return status == GRANULAR_OK ? Result{} : failed(status);
  }

  /// Fails a call of a writer.
  Result write_failing(const FailingCase& one, long number) const
  {
    const std::string folder = without_slash(folder_.path(""));
    this->begin();
    if (one.leaves == Leaves::Older)
    {
      EXPECT_NE(this->write_all(leaving_calls(folder)).error, "");
      this->rewrite_old();
    }
    return this->write_all(failing_calls_of(one, number, folder));
  }

  void rewrite_old() const
  {
    for (const std::string& name : names_)
    {
      folder_.write(name, old_content);
    }
  }

  /// Each file is the old one or the new one, all are new where there was no error, and there are no others.
  void expect_old_or_new(const Result& result) const
  {
    std::size_t found = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path("")))
    {
      const std::string name = entry.path().filename().string();
      if (is_hidden(name))
      {
        continue; // counted by others
      }
      const auto known = std::find(names_.begin(), names_.end(), name);
      ASSERT_NE(known, names_.end()) << name << " was left behind: " << result.error;
      const std::string now = content(entry.path().string());
      const bool is_new = now == whole_[static_cast<std::size_t>(known - names_.begin())];
      EXPECT_TRUE(is_new || (result.status != GRANULAR_OK && now == old_content)) << result.error;
      // once one file has its name, the next ones may fail
      const bool one_file = names_.size() == 1;
      const bool was_renamed = result.error.find(": written, but") != std::string::npos;
      EXPECT_TRUE(!one_file || result.status == GRANULAR_OK || !is_new || was_renamed)
        << result.error;
      ++found;
    }
    EXPECT_EQ(found, names_.size());
  }

  Folder folder_;
  std::string path_;
  std::vector<FrameHandle> frames_;
  std::vector<std::string> names_;
  std::vector<std::string> whole_;
};

void expect_named(const FailingCase& one, const Result& result, const std::string& folder)
{
  EXPECT_TRUE(!one.harmless || result.status == GRANULAR_OK) << result.error;
  EXPECT_TRUE(result.status == GRANULAR_OK || of_memory(one) ||
    result.error.find(folder) != std::string::npos)
    << result.error;
  EXPECT_TRUE(result.status == GRANULAR_OK || !result.error.empty());
}

template <class Kind>
std::string name_of(const ::testing::TestParamInfo<Kind>& info)
{
  std::string name = info.param.name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}

const Input inputs[] = {
  { "text", { "plain.dump" } },
  { "binary", { "ortho_scaled.bin" } },
  { "compressed", { "ortho_000000.dump.gz", "ortho_000050.dump.gz" } },
  { "pieces",
    { "pieces_1000.0.dump", "pieces_1000.1.dump", "pieces_1000.2.dump", "pieces_1000.3.dump" } },
  { "contacts", { "local/contacts.dump" } },
  { "data file", { "data_file/full.data" } },
  { "restart", { "restart/fibres.restart" } },
  { "Euler cells", { "euler_1000.vtk", "euler_2000.vtk" } },
  { "decomposition", { "decomposition_1000.vtk" } },
  { "decomposition, .vtu", { "decomposition/blocks_raw_zlib.vtu" } },
  { "many rows", {}, 60000 },
};

constexpr NeverFires never_fires[] = {
  { "/afileforeachframe", "the disk takes nothing", "such files do not wait for the disk" },
  { "/afileforeachframe", "waiting for the disk is interrupted",
    "nor is there anything to wait for" },
};

const Output outputs[] = {
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
}

TEST_P(FailingInput, NamesTheFileOrReadsItAll)
{
  const Input& input = GetParam();
  const Folder own;
  std::vector<std::string> paths;
  for (const std::string& file : input.files)
  {
    paths.push_back(good(file));
  }
  if (input.rows > 0)
  {
    own.write("made.dump", dump_of_rows(input.rows));
    paths.push_back(own.path("made.dump"));
  }
  std::vector<const char*> names;
  for (const std::string& path : paths)
  {
    names.push_back(path.c_str());
  }
  const std::string folder = input.rows > 0 ? own.path("") : good("");
  const Result whole = read_all(names, {});
  ASSERT_EQ(whole.error, "");
  ASSERT_FALSE(whole.content.empty());
  fail_each(input.rows > 0 ? std::span<const FailingCase>(large_cases) : reader_cases,
    [&](const FailingCase& one, long number)
    {
      const Result result = read_all(names, failing_calls_of(one, number, folder));
      const long possible = calls_that_may_fail();
      expect_named(one, result, folder);
      const bool same = result.content == whole.content && result.notices == whole.notices;
      const bool told = !one.harmless &&
        (result.status != GRANULAR_OK || result.notices.size() > whole.notices.size());
      EXPECT_TRUE(same || told) << result.notices;
      const Result again = read_all(names, {});
      EXPECT_TRUE(again.content == whole.content) << again.error;
      return possible;
    });
}

TEST_P(FailingOutput, LeavesTheOldFileOrTheNewOne)
{
  const std::string folder = folder_.path("");
  long written_but = 0;
  fail_each(
    GetParam().rows > 0 ? std::span<const FailingCase>(large_cases) : writer_cases,
    [&](const FailingCase& one, long number)
    {
      const Result result = this->write_failing(one, number);
      const long possible = calls_that_may_fail();
      expect_named(one, result, folder);
      EXPECT_EQ(count_hidden(folder), possible >= number && one.leaves != Leaves::Nothing ? 1 : 0)
        << result.error;
      this->expect_old_or_new(result);
      const Result again = this->write_all({});
      EXPECT_EQ(again.error, "");
      EXPECT_EQ(count_hidden(folder), 0) << result.error;
      this->expect_old_or_new(again);
      written_but += result.error.find(": written, but") != std::string::npos ? 1 : 0;
      return possible;
    },
    never_fires);
  const bool waits =
    GetParam().rows == 0 && std::string(GetParam().name) != "a file for each frame";
  EXPECT_EQ(written_but > 0, waits) << "of the folder, which is behind the file";
}

INSTANTIATE_TEST_SUITE_P(Kinds, FailingInput, ::testing::ValuesIn(inputs), name_of<Input>);
INSTANTIATE_TEST_SUITE_P(Kinds, FailingOutput, ::testing::ValuesIn(outputs), name_of<Output>);
