// SPDX-License-Identifier: BSD-3-Clause
// Every call of the system that a reader makes fails in turn, once or for ever. The reference is the run in which none does.
#include "granular/bytes/byte_sink.h"
#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"
#include "granular/decomposition/decomposition_file.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/euler/euler_file.h"
#include "granular/local/local_columns.h"
#include "granular/local/local_file.h"
#include "granular/local/local_reader.h"
#include "granular/memory/block_pool.h"
#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

#include "../support/frame_content.h"
#include "../support/series.h"
#include "failing_cases.h"

#include <gtest/gtest.h>

#include <functional>
#include <span>

using granular::FramePiece;
using granular::Notices;
using granular::Progress;
using granular::RunIndex;

namespace
{
// ---- what is read ------------------------------------------------------------------------------

std::string bytes_of(std::span<const double> values)
{
  return { reinterpret_cast<const char*>(values.data()), values.size_bytes() };
}

std::string text_of(const FrameContent& content)
{
  std::string text = content.head + "\n";
  for (const std::vector<std::string>* parts : { &content.values, &content.words })
  {
    for (const std::string& part : *parts)
    {
      text += std::to_string(part.size()) + ":" + part;
    }
  }
  return text;
}

/// All that a frame holds.
using Content = std::string (*)(const RunIndex& index, std::size_t frame, Notices& notices);

/// Threads of an index and of a dump, and whether its memory is of a pool: the result does not depend on them.
int threads = 1;
bool pooled = false;

std::string dump_content(const RunIndex& index, std::size_t frame, Notices& notices)
{
  Progress progress;
  granular::DumpRequest request =
    threads == 1 ? everything() : in_chunks(everything(), threads, 4096);
  request.pool = pooled ? std::make_shared<granular::BlockPool>(std::size_t{ 1 } << 28) : nullptr;
  return text_of(content_of(granular::read_dump(index.pieces(frame), request, notices, progress)));
}

std::string lines_content(const granular::LocalFrame& frame)
{
  return text_of(content_of(frame.table)) +
    std::string(static_cast<const char*>(frame.lines.points.data()), frame.lines.points.bytes());
}

std::string local_content(const RunIndex& index, std::size_t frame, Notices& notices)
{
  Progress progress;
  granular::SerialCommunicator alone;
  const granular::FrameKind& kind = *index.first_piece(frame).entry.kind;
  granular::LocalRequest request;
  for (const granular::ColumnInfo& column : kind.schema.columns())
  {
    request.columns.push_back(column.name);
  }
  if (frame == 0)
  {
    const granular::LocalSample sample = granular::read_sample(index, kind, progress);
    request.columns = granular::find_columns(request.columns, sample, {}, notices);
  }
  return lines_content(
    granular::read_local(index.pieces(frame), request, alone, notices, progress));
}

std::string data_content(const RunIndex& index, std::size_t frame, Notices& notices)
{
  Progress progress;
  granular::SerialCommunicator alone;
  const granular::DataFrame read =
    granular::read_data(index.first_piece(frame), {}, alone, notices, progress);
  return text_of(content_of(read.particles)) + lines_content(read.bonds);
}

std::string restart_content(const RunIndex& index, std::size_t frame, Notices& notices)
{
  Progress progress;
  const granular::FileIndex& file = index.first_piece(frame).file;
  const auto source = granular::open_indexed(file);
  const auto layout = granular::find_restart_layout(file, *source, notices, progress);
  const granular::RestartFrame read =
    granular::read_restart(*source, *layout, {}, notices, progress);
  return text_of(content_of(read.particles)) + lines_content(read.bonds);
}

std::string euler_content(const RunIndex& index, std::size_t frame, Notices& notices)
{
  Progress progress;
  const FramePiece piece = index.first_piece(frame);
  const auto all = [](std::string_view) { return true; };
  const granular::EulerFrame read =
    granular::read_euler(*granular::open_indexed(piece.file), piece.entry, all, notices, progress);
  std::string text = bytes_of(read.centres);
  for (const granular::EulerValues& values : read.arrays)
  {
    text += values.name + bytes_of(values.values);
  }
  return text;
}

std::string decomposition_content(const RunIndex& index, std::size_t frame, Notices& notices)
{
  Progress progress;
  std::string text;
  for (const FramePiece& piece : index.pieces(frame))
  {
    const granular::Decomposition read = granular::read_decomposition(
      *granular::open_indexed(piece.file), piece.entry, notices, progress);
    for (const granular::Subdomain& own : read.subdomains)
    {
      text += std::to_string(own.rank) + " " + std::to_string(own.particles) + bytes_of(own.lo) +
        bytes_of(own.hi);
    }
  }
  return text;
}

/// Files of a kind, copied into a folder of the test's own.
struct Kind
{
  const char* name;
  std::vector<std::string> files; ///< of tests/data/good; FILE=NAME for another name
  const granular::FileFormat& (*format)() noexcept;
  Content content;
  std::size_t frames;                    ///< that there are, as the program wrote them
  std::vector<std::string> columns = {}; ///< that the user names
  long rows = 0;                         ///< of a file that is made, with this many
};

// clang-format off
const std::vector<Kind>& kinds()
{
  using namespace granular;
  static const std::vector<Kind> all = {
    { "text", { "grains.dump" }, dump_format, dump_content, 3 },
    { "text of several files", { "grains_0.dump", "grains_1000.dump", "grains_2000.dump" }, dump_format, dump_content, 3 },
    { "done again", { "grains_1000.dump=again.0.dump", "grains_1000.dump=again.1.dump" }, dump_format, dump_content, 1 },
    { "binary without names", { "plain.bin" }, dump_format, dump_content, 3,
      { "id", "type", "x", "y", "z", "ix", "iy", "iz", "vx", "vy", "vz", "radius", "element" } },
    { "binary of several processes", { "grains.bin" }, dump_format, dump_content, 3,
      { "id", "type", "x", "y", "z", "ix", "iy", "iz", "vx", "vy", "vz", "radius" } },
    { "binary, revision 2", { "tri_custom.bin" }, dump_format, dump_content, 2 },
    { "compressed", { "ortho_000000.dump.gz", "ortho_000050.dump.gz", "ortho_000100.dump.gz" }, dump_format, dump_content, 3 },
    { "pieces", { "pieces_1000.0.dump", "pieces_1000.1.dump", "pieces_1000.2.dump", "pieces_1000.3.dump" }, dump_format,
      dump_content, 1 },
    { "contacts", { "local/contacts.dump" }, local_format, local_content, 5 },
    { "contacts, compressed", { "local/settled_contacts.dump.gz" }, local_format, local_content, 1 },
    { "contacts, rows alone", { "local/pieces_3000.0.dump", "local/pieces_3000.1.dump", "local/pieces_3000.2.dump",
      "local/pieces_3000.3.dump" }, local_format, local_content, 1 },
    { "data file", { "data_file/full.data" }, data_file_format, data_content, 1 },
    { "data file that does not say its style", { "local/chain.data" }, data_file_format, data_content, 1 },
    { "restart", { "restart/fibres.restart" }, restart_format, restart_content, 1 },
    { "restart of another program", { "restart/pfm.restart" }, restart_format, restart_content, 1 },
    { "restart without particles", { "restart/none.restart" }, restart_format, restart_content, 1 },
    { "restart of several files", { "restart/parts.base.restart", "restart/parts.0.restart", "restart/parts.1.restart",
      "restart/parts.2.restart" }, restart_format, restart_content, 1 },
    { "Euler cells", { "euler_1000.vtk", "euler_2000.vtk" }, euler_format, euler_content, 2 },
    { "Euler cells, binary", { "euler/grid_51_binary.vtk" }, euler_format, euler_content, 1 },
    { "decompositions in one file", { "decomposition/all.vtk" }, decomposition_format, decomposition_content, 3 },
    { "decomposition, binary", { "decomposition/voxels_51_binary.vtk" }, decomposition_format, decomposition_content, 1 },
    { "decomposition, .vtu", { "decomposition/blocks_raw_zlib.vtu" }, decomposition_format, decomposition_content, 1 },
    { "many rows", {}, dump_format, dump_content, 1, {}, 180000 },
    { "rows in memory of a pool", {}, dump_format, dump_content, 1, {}, 20000 },
  };
  return all;
}
// clang-format on

constexpr std::size_t large_kinds = 2; // at the end

// ---- looking at it -----------------------------------------------------------------------------

/// What a user has of a look at the files.
struct Seen
{
  std::vector<std::string> frames;
  std::string said;  ///< notices, one a line
  std::string error; ///< what an update, or reading a frame, threw

  bool operator==(const Seen&) const = default;
};

constexpr const char* no_memory = "out of memory";
constexpr long most_of_memory = 25; ///< calls that are tried, where not all are wanted

/// What may be seen of a fault.
enum class Sees
{
  Nothing,
  Word,  ///< all is as it should be, or there is an error or a notice
  Others ///< anything: the file might be so; but it ends
};

/// What fails, and how often.
struct Case
{
  const char* name;
  CallFault fault;
  long count;
  Sees sees;
  unsigned kinds = calls::reading;
  int error = EIO;
};

constexpr long always = FailingCalls::always;

constexpr Case all_cases[] = {
  { "a read gives one byte", CallFault::Short, 1, Sees::Nothing },
  { "a call is interrupted", CallFault::Interrupted, 1, Sees::Nothing },
  { "a read gives nothing, once", CallFault::End, 1, Sees::Word },
  { "reads give nothing", CallFault::End, always, Sees::Word },
  { "a call fails once", CallFault::Error, 1, Sees::Word },
  { "two calls fail", CallFault::Error, 2, Sees::Word },
  { "calls fail", CallFault::Error, always, Sees::Word },
  { "calls are interrupted", CallFault::Interrupted, always, Sees::Word },
  { "a file is shortened", CallFault::Shortened, 1, Sees::Word },
  { "a read gives zeros", CallFault::Zeros, 1, Sees::Others },
  { "reads give zeros", CallFault::Zeros, always, Sees::Others },
  { "a read gives ones", CallFault::Ones, 1, Sees::Others },
  { "reads give ones", CallFault::Ones, always, Sees::Others },
  { "reads give letters", CallFault::Letters, always, Sees::Others },
  { "a read gives others", CallFault::Moved, 1, Sees::Others },
  { "reads give others", CallFault::Moved, always, Sees::Others },
  { "a file cannot be closed", CallFault::Error, 1, Sees::Nothing, calls::close },
  { "closing is interrupted", CallFault::Interrupted, 1, Sees::Nothing, calls::close },
};

constexpr Case memory_cases[] = {
  { "memory is refused once", CallFault::Error, 1, Sees::Word, calls::memory, ENOMEM },
  { "memory is refused", CallFault::Error, always, Sees::Word, calls::memory, ENOMEM },
};

/// Small files need neither.
constexpr Case page_cases[] = {
  { "pages are refused once", CallFault::Error, 1, Sees::Word, calls::map, ENOMEM },
  { "pages are refused", CallFault::Error, always, Sees::Word, calls::map, ENOMEM },
  { "a thread is refused", CallFault::Error, 1, Sees::Nothing, calls::thread, EAGAIN },
  { "threads are refused", CallFault::Error, always, Sees::Nothing, calls::thread, EAGAIN },
};

constexpr bool is_of_file(const Case& one)
{
  return (one.kinds & (calls::memory | calls::map | calls::thread)) == 0;
}

/// Other bytes may look like many more frames than there are, of some bytes each.
long most_calls(const Case& one, long usual, std::size_t bytes)
{
  return (one.fault == CallFault::Interrupted ? 101 : 4) * usual + 100 +
    (one.sees == Sees::Others ? static_cast<long>(bytes) : 0);
}

/// Where each look begins with files that are written anew.
constexpr Case some_cases[] = {
  { "a read gives one byte", CallFault::Short, 1, Sees::Nothing },
  { "a read gives nothing, once", CallFault::End, 1, Sees::Word },
  { "a call fails once", CallFault::Error, 1, Sees::Word },
  { "calls fail", CallFault::Error, always, Sees::Word },
};

class FailingReads : public ::testing::TestWithParam<std::size_t>
{
protected:
  const Kind& kind() const { return kinds()[GetParam()]; }

  /// Files as they were, or the first part of the last one.
  void SetUp() override
  {
    for (const std::string& file : this->kind().files)
    {
      const std::size_t equals = file.find('=');
      const std::string name = equals == file.npos ? file : file.substr(equals + 1);
      texts_.push_back(data_file("good/" + file.substr(0, equals)));
      paths_.push_back(folder_.path(std::filesystem::path(name).filename().string()));
    }
    if (this->kind().rows > 0)
    {
      texts_.push_back(dump_of_rows(this->kind().rows));
      paths_.push_back(folder_.path("made.dump"));
    }
    this->write_all();
  }

  void TearDown() override
  {
    make_fail({});
    threads = 1;
    pooled = false;
  }

  void write_all() const
  {
    for (std::size_t i = 0; i < paths_.size(); ++i)
    {
      this->write(i, texts_[i]);
    }
  }

  void write(std::size_t file, const std::string& text) const
  {
    folder_.write(std::filesystem::path(paths_[file]).filename().string(), text);
  }

  /// What there is to be seen with an index that may know the files already.
  Seen look(RunIndex& index) const
  {
    Seen seen;
    Notices notices;
    Progress progress;
    try
    {
      granular::IndexOptions options = { .format = &granular::dump_format() };
      options.format = &this->kind().format();
      options.threads = threads;
      options.column_names = this->kind().columns;
      index.update(paths_, options, notices, progress);
      for (std::size_t frame = 0; frame < index.size(); ++frame)
      {
        seen.frames.push_back(this->kind().content(index, frame, notices));
      }
    }
    catch (const granular::Error& error)
    {
      stop_failing();
      seen.error = error.what();
    }
    catch (const std::bad_alloc&)
    {
      stop_failing();
      seen.error = no_memory;
    }
    stop_failing();
    seen.said = lines_of(notices);
    return seen;
  }

  Seen look_with(const FailingCalls& calls, RunIndex& index, long& possible, long& made) const
  {
    make_fail(calls);
    Seen seen = this->look(index);
    possible = calls_that_may_fail();
    made = all_calls();
    make_fail({});
    return seen;
  }

  /// Fails every call of a look at files, which prepare makes an index for, in every way. Whatever is seen, the next look sees `whole`.
  void try_all(
    const Seen& whole, std::span<const Case> cases, const std::function<RunIndex()>& prepare)
  {
    long possible = 0;
    long usual = 0;
    RunIndex first = prepare();
    const Seen clean = this->look_with({}, first, possible, usual);
    ASSERT_EQ(clean.frames, whole.frames);
    std::size_t bytes = 0;
    for (const std::string& text : texts_)
    {
      bytes += text.size();
    }
    for (const Case& one : cases)
    {
      const long most = most_calls(one, usual, bytes);
      const auto use = [&](long number)
      { return this->try_one(whole, clean, one, number, most, prepare); };
      const bool many = (one.kinds & (calls::memory | calls::map)) != 0;
      expect_delivered(one.name, fail_each(one.name, many ? most_of_memory : 0, faults, use));
      if (::testing::Test::HasFailure())
      {
        return;
      }
    }
  }

  /// Fails a call, and looks again. Returns how many there were that might fail.
  long try_one(const Seen& whole, const Seen& clean, const Case& one, long number, long most,
    const std::function<RunIndex()>& prepare) const
  {
    RunIndex index = prepare();
    long possible = 0;
    long made = 0;
    const Seen seen = this->look_with(
      { one.fault, number, one.count, one.kinds, one.error }, index, possible, made);
    this->judge(one, possible >= number, seen, clean);
    EXPECT_LE(made, most);
    if (one.fault == CallFault::Shortened)
    {
      this->write_all();
    }
    const Seen again = this->look(index);
    if (one.sees != Sees::Others)
    {
      EXPECT_EQ(again.error, "");
      EXPECT_TRUE(again.frames == whole.frames)
        << again.frames.size() << " frames after " << seen.error << seen.said;
    }
    return possible;
  }

  void judge(const Case& one, bool fired, const Seen& seen, const Seen& clean) const
  {
    if (one.sees == Sees::Nothing || !fired)
    {
      EXPECT_TRUE(seen == clean) << seen.error << seen.said;
    }
    const bool complete = seen.frames == clean.frames;
    EXPECT_TRUE(one.sees == Sees::Others || complete || !seen.error.empty() ||
      seen.said.size() > clean.said.size())
      << seen.frames.size() << " of " << clean.frames.size() << " frames, and " << seen.said;
    // who reads it is to know which file it was, unless the memory was for nothing of a file
    const bool names_file = (seen.error + seen.said).find(folder_.path("")) != std::string::npos;
    EXPECT_TRUE(one.sees != Sees::Word || complete || names_file || !is_of_file(one)) << seen.error;
  }

  FaultCount faults;
  Folder folder_;
  std::vector<std::string> texts_;
  std::vector<std::string> paths_;
};

std::string name_of(const ::testing::TestParamInfo<std::size_t>& info)
{
  std::string name = kinds()[info.param].name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}
}

TEST_P(FailingReads, OfAFirstLook)
{
  RunIndex index;
  const Seen whole = this->look(index);
  ASSERT_EQ(whole.error, "");
  ASSERT_EQ(whole.frames.size(), this->kind().frames);
  this->try_all(whole, all_cases, [] { return RunIndex(); });
}

TEST_P(FailingReads, OfMemory)
{
  threads = 3;
  RunIndex index;
  const Seen whole = this->look(index);
  this->try_all(whole, memory_cases, [] { return RunIndex(); });
}

class FailingLargeReads : public FailingReads
{
};

TEST_P(FailingLargeReads, OfPagesAndThreads)
{
  threads = 3;
  pooled = std::string(this->kind().name).ends_with("pool");
  RunIndex index;
  const Seen whole = this->look(index);
  ASSERT_EQ(whole.frames.size(), 1u);
  this->try_all(whole, page_cases, [] { return RunIndex(); });
}

/// The index knows the files as they were before the last one grew.
TEST_P(FailingReads, OfAFileThatGrew)
{
  RunIndex index;
  const Seen whole = this->look(index);
  const std::string& text = texts_.back();
  this->try_all(whole, some_cases,
    [&]
    {
      this->write(texts_.size() - 1, text.substr(0, 2 * text.size() / 3));
      RunIndex before;
      this->look(before);
      this->write(texts_.size() - 1, text);
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

INSTANTIATE_TEST_SUITE_P(
  Kinds, FailingReads, ::testing::Range(std::size_t{ 0 }, kinds().size() - large_kinds), name_of);
INSTANTIATE_TEST_SUITE_P(Kinds, FailingLargeReads,
  ::testing::Range(kinds().size() - large_kinds, kinds().size()), name_of);
