// SPDX-License-Identifier: BSD-3-Clause
// Every call of the system that a reader makes fails in turn, once or for ever, below the C interface. The reference is the run in
// which none does.
#include "granular/bytes/byte_sink.h"
#include "granular/common/hash.h"

#include "../support/dumps.h"
#include "failing_cases.h"
#include "runs.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <vector>

using namespace runs;

namespace
{
/// Files of a kind, copied into a folder of the test's own.
struct FilesOfKind
{
  const char* name;
  granular_kind kind; ///< given: a file that is shortened while it is looked for is a shorter file
  std::vector<std::string> files; ///< of tests/data/good; FILE=NAME for another name
  std::int64_t frames;            ///< that there are, as the program wrote them
  const char* columns = "";       ///< that the user names
  long rows = 0;                  ///< of a file that is made, with this many
};

// clang-format off
const FilesOfKind small_kinds[] = {
  { "text", GRANULAR_KIND_DUMP, { "grains.dump" }, 3 },
  { "text of several files", GRANULAR_KIND_DUMP, { "grains_0.dump", "grains_1000.dump", "grains_2000.dump" }, 3 },
  { "done again", GRANULAR_KIND_DUMP, { "grains_1000.dump=again.0.dump", "grains_1000.dump=again.1.dump" }, 1 },
  { "binary without names", GRANULAR_KIND_DUMP, { "plain.bin" }, 3,
    "id type x y z ix iy iz vx vy vz radius element" },
  { "binary of several processes", GRANULAR_KIND_DUMP, { "grains.bin" }, 3,
    "id type x y z ix iy iz vx vy vz radius" },
  { "binary, revision 2", GRANULAR_KIND_DUMP, { "tri_custom.bin" }, 2 },
  { "compressed", GRANULAR_KIND_DUMP, { "ortho_000000.dump.gz", "ortho_000050.dump.gz", "ortho_000100.dump.gz" }, 3 },
  { "pieces", GRANULAR_KIND_DUMP, { "pieces_1000.0.dump", "pieces_1000.1.dump", "pieces_1000.2.dump", "pieces_1000.3.dump" }, 1 },
  { "bonds", GRANULAR_KIND_LOCAL, { "local/chain_bonds.dump" }, 3 },
  { "contacts, compressed", GRANULAR_KIND_LOCAL, { "local/settled_contacts.dump.gz" }, 1 },
  { "contacts, rows alone", GRANULAR_KIND_LOCAL, { "local/pieces_3000.0.dump", "local/pieces_3000.1.dump", "local/pieces_3000.2.dump",
    "local/pieces_3000.3.dump" }, 1 },
  { "data file", GRANULAR_KIND_DATA_FILE, { "data_file/full.data" }, 1 },
  { "data file that does not say its style", GRANULAR_KIND_DATA_FILE, { "local/chain.data" }, 1 },
  { "restart", GRANULAR_KIND_RESTART, { "restart/fibres.restart" }, 1 },
  { "restart of another program", GRANULAR_KIND_RESTART, { "restart/pfm.restart" }, 1 },
  { "restart without particles", GRANULAR_KIND_RESTART, { "restart/none.restart" }, 1 },
  { "restart of several files", GRANULAR_KIND_RESTART, { "restart/parts.base.restart", "restart/parts.0.restart", "restart/parts.1.restart",
    "restart/parts.2.restart" }, 1 },
  { "Euler cells", GRANULAR_KIND_EULER, { "euler_1000.vtk", "euler_2000.vtk" }, 2 },
  { "Euler cells, binary", GRANULAR_KIND_EULER, { "euler/grid_51_binary.vtk" }, 1 },
  { "grids in one file", GRANULAR_KIND_GRID, { "grid/grid.dump" }, 2 },
  { "decompositions in one file", GRANULAR_KIND_DECOMPOSITION, { "decomposition/all.vtk" }, 3 },
  { "decomposition, binary", GRANULAR_KIND_DECOMPOSITION, { "decomposition/voxels_51_binary.vtk" }, 1 },
  { "decomposition, .vtu", GRANULAR_KIND_DECOMPOSITION, { "decomposition/blocks_raw_zlib.vtu" }, 1 },
};
// clang-format on

// ---- looking at it -----------------------------------------------------------------------------

/// What a user has of a look at the files.
struct Look
{
  std::int64_t frames = 0;
  std::uint64_t values = 0; ///< a hash: the test takes no memory while memory is refused
  std::string error;
  std::string said; ///< notices, one a line

  bool operator==(const Look&) const = default;
};

constexpr long most_of_calls = 6; ///< that are tried, where not all are wanted

constexpr long always = FailingCalls::always;

// clang-format off
constexpr FailingCase all_cases[] = {
  { "a read gives one byte", calls::reading, CallFault::Short, 0, true },
  { "a read gives nothing, once", calls::reading, CallFault::End },
  { "a call fails once", calls::reading, CallFault::Error },
  { "calls fail", calls::reading, CallFault::Error, EIO, false, always },
  { "a call is interrupted", calls::reading, CallFault::Interrupted, EINTR, true },
  { "reads give nothing", calls::reading, CallFault::End, 0, false, always },
  { "two calls fail", calls::reading, CallFault::Error, EIO, false, 2 },
  { "calls are interrupted", calls::reading, CallFault::Interrupted, EINTR, false, always },
  { "a file is shortened", calls::reading, CallFault::Shortened },
  { "a read gives zeros", calls::reading, CallFault::Zeros },
  { "reads give zeros", calls::reading, CallFault::Zeros, 0, false, always },
  { "a read gives ones", calls::reading, CallFault::Ones },
  { "reads give ones", calls::reading, CallFault::Ones, 0, false, always },
  { "reads give letters", calls::reading, CallFault::Letters, 0, false, always },
  { "a read gives others", calls::reading, CallFault::Moved },
  { "reads give others", calls::reading, CallFault::Moved, 0, false, always },
  { "a file cannot be closed", calls::close, CallFault::Error, EIO, true },
  { "closing is interrupted", calls::close, CallFault::Interrupted, EINTR, true },
};
constexpr std::size_t cases_of_a_file_that_grew = 4; ///< the first, as each look begins with files that are written anew

constexpr FailingCase memory_cases[] = {
  { "memory is refused once", calls::memory, CallFault::Error, ENOMEM },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM, false, always },
};

/// Small files need neither.
constexpr FailingCase page_cases[] = {
  { "pages are refused once", calls::map, CallFault::Error, ENOMEM },
  { "pages are refused", calls::map, CallFault::Error, ENOMEM, false, always },
  { "a thread is refused", calls::thread, CallFault::Error, EAGAIN, true },
  { "threads are refused", calls::thread, CallFault::Error, EAGAIN, true, always },
};
// clang-format on

constexpr bool is_of_file(const FailingCase& one)
{
  return (one.kinds & (calls::memory | calls::map | calls::thread)) == 0;
}

/// Other bytes are read: the file might be so, and anything may be seen; but it ends.
constexpr bool gives_others(const FailingCase& one)
{
  constexpr CallFault others[] = { CallFault::Zeros, CallFault::Ones, CallFault::Letters,
    CallFault::Moved };
  return std::ranges::find(others, one.fault) != std::end(others);
}

/// Other bytes may look like many more frames than there are, of some bytes each.
long most_calls(const FailingCase& one, long usual, std::size_t bytes)
{
  return (one.fault == CallFault::Interrupted ? 101 : 4) * usual + 100 +
    (gives_others(one) ? static_cast<long>(bytes) : 0);
}

class FailingReads : public ::testing::TestWithParam<FilesOfKind>
{
protected:
  void SetUp() override
  {
    for (const std::string& file : GetParam().files)
    {
      const std::size_t equals = file.find('=');
      const std::string name = equals == file.npos ? file : file.substr(equals + 1);
      texts_.push_back(content(good(file.substr(0, equals))));
      names_.push_back(fs::path(name).filename());
    }
    if (GetParam().rows > 0)
    {
      texts_.push_back(dump_of_rows(GetParam().rows));
      names_.emplace_back("made.dump");
    }
    this->write_all();
    std::ranges::transform(names_, std::back_inserter(paths_),
      [&](const std::string& name) { return folder_.path(name); });
    std::ranges::transform(
      paths_, std::back_inserter(given_), [](const std::string& path) { return path.c_str(); });
  }

  void TearDown() override { stop_failing(); }

  void write_all() const
  {
    for (std::size_t i = 0; i < names_.size(); ++i)
    {
      folder_.write(names_[i], texts_[i]);
    }
  }

  granular_status open(RunHandle& run, void* said) const
  {
    granular_open_options options = options_of(GetParam().kind, threads_);
    options.column_names = GetParam().columns;
    options.notice = tell;
    options.user = said;
    granular_run* opened = nullptr;
    const granular_status status = granular_open(given_.data(), given_.size(), &options, &opened);
    run.reset(opened);
    return status;
  }

  static void tell(const granular_error* remark, void* said)
  {
    static_cast<std::string*>(said)->append(remark->message).append("\n");
  }

  /// Looks at all frames of a run, which may know the files already, while calls fail.
  Look look(RunHandle& run, const FailingCalls& calls = {}) const
  {
    Look seen;
    seen.said.reserve(std::size_t{ 1 } << 16);
    granular::Hash values;
    granular_request request = request_of(threads_);
    request.notice = tell;
    request.user = &seen.said;
    make_fail(calls);
    granular_status status =
      run ? granular_refresh(run.get(), nullptr, tell, &seen.said) : this->open(run, &seen.said);
    if (status == GRANULAR_OK)
    {
      status = visit(run.get(), request,
        [&](const void* bytes, std::size_t count) { values.add(bytes, count); });
    }
    stop_failing();
    seen.error = status == GRANULAR_OK ? "" : message();
    seen.values = values.value();
    granular_run_facts facts = {};
    seen.frames = run && granular_run_info(run.get(), &facts) == GRANULAR_OK ? facts.frames : 0;
    return seen;
  }

  /// Fails every call of a look at files, which prepare opens a run of, in every way. Whatever is seen, the next look sees `whole`.
  void try_all(std::span<const FailingCase> cases, const std::function<RunHandle()>& prepare)
  {
    RunHandle first = prepare();
    const Look clean = this->look(first);
    const long usual = all_calls();
    ASSERT_EQ(clean.error, "");
    ASSERT_EQ(clean.frames, GetParam().frames);
    first.reset();
    ASSERT_EQ(this->look(first).values, clean.values);
    first.reset();
    std::size_t bytes = 0;
    for (const std::string& text : texts_)
    {
      bytes += text.size();
    }
    for (const FailingCase& one : cases)
    {
      const long most = most_calls(one, usual, bytes);
      const auto use = [&](long number)
      { return this->try_one(clean, one, number, most, prepare); };
      expect_delivered(one.name, fail_each(one.name, most_of_calls, use));
      if (::testing::Test::HasFailure())
      {
        return;
      }
    }
  }

  /// Fails a call, and looks again. Returns how many there were that might fail.
  long try_one(const Look& clean, const FailingCase& one, long number, long most,
    const std::function<RunHandle()>& prepare) const
  {
    RunHandle run = prepare();
    const Look seen = this->look(run, { one.fault, number, one.count, one.kinds, one.error });
    const long possible = calls_that_may_fail();
    EXPECT_LE(all_calls(), most);
    this->judge(one, possible >= number, seen, clean);
    if (one.fault == CallFault::Shortened)
    {
      this->write_all();
    }
    const Look again = this->look(run);
    if (!gives_others(one))
    {
      EXPECT_EQ(again.error, "");
      EXPECT_TRUE(again.frames == clean.frames && again.values == clean.values)
        << again.frames << " frames after " << seen.error << seen.said;
    }
    return possible;
  }

  void judge(const FailingCase& one, bool fired, const Look& seen, const Look& clean) const
  {
    if (one.harmless || !fired)
    {
      EXPECT_TRUE(seen == clean) << seen.error << seen.said;
    }
    const bool complete = seen.frames == clean.frames && seen.values == clean.values;
    EXPECT_TRUE(
      gives_others(one) || complete || !seen.error.empty() || seen.said.size() > clean.said.size())
      << seen.frames << " of " << clean.frames << " frames, and " << seen.said;
    // who reads it is to know which file it was, unless the memory was for nothing of a file
    const bool names_file = (seen.error + seen.said).find(folder_.path("")) != std::string::npos;
    EXPECT_TRUE(gives_others(one) || complete || names_file || !is_of_file(one)) << seen.error;
  }

  Folder folder_;
  std::vector<std::string> texts_;
  std::vector<std::string> names_;
  std::vector<std::string> paths_;
  std::vector<const char*> given_; ///< the same
  int threads_ = 1;                ///< on which no value depends
};

RunHandle no_run()
{
  return { nullptr, granular_close };
}

std::string name_of(const ::testing::TestParamInfo<FilesOfKind>& info)
{
  std::string name = info.param.name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}
}

TEST_P(FailingReads, OfAFirstLook)
{
  this->try_all(all_cases, no_run);
}

TEST_P(FailingReads, OfMemory)
{
  threads_ = 3;
  this->try_all(memory_cases, no_run);
}

class FailingLargeReads : public FailingReads
{
};

TEST_P(FailingLargeReads, OfMemoryPagesAndThreads)
{
  threads_ = 3;
  this->try_all(memory_cases, no_run);
  this->try_all(page_cases, no_run);
}

/// The run knows the files as they were before the last one grew.
TEST_P(FailingReads, OfAFileThatGrew)
{
  const std::string& text = texts_.back();
  this->try_all(std::span(all_cases).first(cases_of_a_file_that_grew),
    [&]
    {
      folder_.write(names_.back(), text.substr(0, 2 * text.size() / 3));
      RunHandle before = no_run();
      this->look(before);
      folder_.write(names_.back(), text);
      return before;
    });
}

/// A file that is written by MPI has another one beside it for its lock.
TEST(FailingNewFile, IsMadeWhereMakingItIsInterrupted)
{
  const Folder folder;
  const std::string path = folder.path("new.dump");
  const std::string name = without_slash(folder.path(""));
  bool fired = true;
  long number = 1;
  for (; fired; ++number)
  {
    SCOPED_TRACE(number);
    make_fail({ CallFault::Interrupted, number, 1, calls::create, EINTR, name.c_str() });
    EXPECT_EQ(error_of(
                [&]
                {
                  granular::NewFile file(path, granular::Locking::Others);
                  file.write_at(0, "new");
                  file.finish(false);
                }),
      "");
    stop_failing();
    fired = calls_that_may_fail() >= number;
    EXPECT_EQ(names_in(folder.path("")), "new.dump");
  }
  EXPECT_GT(number, 3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FailingReads, ::testing::ValuesIn(small_kinds), name_of);
INSTANTIATE_TEST_SUITE_P(Kinds, FailingLargeReads,
  ::testing::Values(FilesOfKind{ "many rows", GRANULAR_KIND_DUMP, {}, 1, "", 60000 }), name_of);
