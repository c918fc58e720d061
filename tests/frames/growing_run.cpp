// SPDX-License-Identifier: BSD-3-Clause
// A run that writes while somebody looks: never a part of a frame, none missed, and files that are
// replaced or removed meanwhile.
#include "granular/frames/run_index.h"

#include "../support/binary_dumps.h"
#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

namespace
{
namespace fs = std::filesystem;

// ---- a run whose frames can be checked ---------------------------------------------------------

constexpr std::int64_t step_size = 7; // steps of all lengths: 0, 7, ... 98, 105, ...

/// Returns the number of particles at a step: more and more, as they are poured, but also none.
std::int64_t rows_at(std::int64_t frame, std::int64_t most)
{
  return frame % 10 == 9 ? 0 : (frame * 7919) % most;
}

double x_of(std::int64_t step, std::int64_t id)
{
  return static_cast<double>(step * 100000 + id) / 64;
}

/// Numbers of many digits: of some that are cut off, the rest is still a number.
std::string text_frame(std::int64_t frame, std::int64_t most)
{
  const std::int64_t step = frame * step_size;
  const std::int64_t rows = rows_at(frame, most);
  std::string text = header(step, static_cast<std::size_t>(rows));
  for (std::int64_t id = 1; id <= rows; ++id)
  {
    text += std::to_string(id) + " " + std::to_string(x_of(step, id)) + " -1.5e-3 " +
      std::to_string(step) + "\n";
  }
  return text;
}

/// As LIGGGHTS writes them, with a chunk of rows for each of two processes.
std::string binary_frame(std::int64_t frame, std::int64_t most)
{
  const std::int64_t step = frame * step_size;
  const std::int64_t rows = rows_at(frame, most);
  binary::Frame written;
  written.timestep = step;
  written.size_one = 5; // id type x y z
  written.chunks.resize(2);
  for (std::int64_t id = 1; id <= rows; ++id)
  {
    std::vector<double>& chunk = written.chunks[id <= rows / 3 ? 0 : 1];
    chunk.insert(chunk.end(),
      { static_cast<double>(id), 1, x_of(step, id), -1.5e-3, static_cast<double>(step) });
  }
  return binary::write(binary::form("plain, little-endian"), { written }).bytes;
}

/// What a frame holds must be what was written at its step, all of it.
void check_frame(const Series& run, std::size_t frame, std::int64_t most)
{
  const std::int64_t step = run.steps()[frame];
  const std::int64_t rows = rows_at(step / step_size, most);
  const Decoded decoded = run.read(frame);
  ASSERT_EQ(decoded.rows(), rows) << "step " << step;
  ASSERT_EQ(decoded.frame.header.timestep, step);
  const Ids ids = decoded.integers("id");
  const std::vector<double> points = decoded.points();
  for (std::int64_t row = 0; row < rows; ++row)
  {
    const double* const point = points.data() + 3 * row;
    ASSERT_EQ(ids[static_cast<std::size_t>(row)], row + 1) << "step " << step;
    ASSERT_EQ(point[0], x_of(step, row + 1)) << "step " << step << ", row " << row;
    ASSERT_EQ(point[1], -1.5e-3);
    ASSERT_EQ(point[2], static_cast<double>(step));
  }
}

// ---- a writer and a reader at the same time ----------------------------------------------------

/// Appends bytes to a file in a process of its own, a burst at a time.
class Writer
{
public:
  Writer(const std::string& path, const std::string& bytes, const std::vector<std::size_t>& ends)
  {
    int go[2] = {};
    int done[2] = {};
    EXPECT_EQ(::pipe(go) + ::pipe(done), 0);
    child_ = ::fork();
    if (child_ == 0)
    {
      ::close(go[1]);
      ::_exit(write_all(path.c_str(), bytes, ends, go[0], done[1]));
    }
    ::close(go[0]);
    ::close(done[1]);
    go_ = go[1];
    done_ = done[0];
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer()
  {
    ::close(go_);
    ::close(done_);
    ::waitpid(child_, nullptr, 0);
  }

  /// Lets it begin the next burst.
  void go()
  {
    const char byte = 0;
    EXPECT_EQ(::write(go_, &byte, 1), 1);
  }

  /// Whether the burst has ended, now.
  bool done() const
  {
    ::pollfd end = { done_, POLLIN, 0 };
    return ::poll(&end, 1, 0) != 0;
  }

  /// Waits for the end of the burst; false if it failed.
  bool wait()
  {
    char byte = 0;
    return ::read(done_, &byte, 1) == 1;
  }

private:
  /// Calls of the system, and nothing else: the process is a copy of one that tests. A burst is
  /// many short writes that end anywhere.
  static int write_all(const char* path, const std::string& bytes,
    const std::vector<std::size_t>& ends, int go, int done)
  {
    const int file = ::open(path, O_WRONLY | O_CREAT | O_APPEND, 0644);
    const std::size_t most = 9 + bytes.size() / 50000;
    std::size_t at = 0;
    for (const std::size_t end : ends)
    {
      char byte = 0;
      if (file < 0 || ::read(go, &byte, 1) != 1)
      {
        return 1;
      }
      while (at < end)
      {
        const std::size_t some = 1 + at * 7919 % most;
        const ssize_t written = ::write(file, bytes.data() + at, std::min(some, end - at));
        if (written <= 0)
        {
          return 1;
        }
        at += static_cast<std::size_t>(written);
      }
      if (::write(done, &byte, 1) != 1)
      {
        return 1;
      }
    }
    return 0;
  }

  pid_t child_ = -1;
  int go_ = -1;
  int done_ = -1;
};

/// Random places in bytes, in their order, and the end.
std::vector<std::size_t> random_ends(std::size_t bytes, std::size_t count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::size_t> ends(count - 1);
  std::ranges::generate(ends, [&] { return random() % (bytes + 1); });
  ends.push_back(bytes);
  std::ranges::sort(ends);
  return ends;
}

/// Frames must be those from the first one on, and only become more; times gets theirs.
void check_index(const Series& run, std::vector<double>& times, const std::string& may_say)
{
  ASSERT_TRUE(run.said.empty() ||
    (!may_say.empty() && run.said.find(may_say) != run.said.npos &&
      std::count(run.said.begin(), run.said.end(), '\n') == 1))
    << run.said;
  std::vector<double> now = run.index.times(0.5);
  ASSERT_GE(now.size(), times.size());
  ASSERT_TRUE(std::equal(times.begin(), times.end(), now.begin()));
  times = std::move(now);
  for (std::size_t i = 0; i < run.index.size(); ++i)
  {
    ASSERT_EQ(run.index.first_piece(i).entry.timestep, static_cast<std::int64_t>(i) * step_size);
  }
}

/// Follows a file while its bytes are written, with that many looks at least; frames is how many are
/// in it at the end, may_say what may be said of it in a notice.
void follow(const std::string& path, const std::string& bytes, std::int64_t frames,
  std::int64_t most, std::size_t looks, const std::string& may_say = "")
{
  constexpr std::size_t bursts = 20;
  Writer writer(path, bytes, random_ends(bytes.size(), bursts, 5));
  Series run;
  std::size_t seen = 0;
  std::size_t looks_with_news = 0;
  std::vector<double> times;
  for (std::size_t burst = 0; burst < bursts; ++burst)
  {
    writer.go();
    for (std::size_t look = 0; look < looks / bursts || !writer.done(); ++look)
    {
      const std::string error = error_of([&] { run.update({ path }); });
      ASSERT_TRUE(error.empty() || seen == 0) << error; // there is no frame yet
      if (error.empty())
      {
        const std::size_t before = seen;
        ASSERT_NO_FATAL_FAILURE(check_index(run, times, may_say));
        seen = run.index.size();
        looks_with_news += seen > before ? 1U : 0U;
      }
      if (seen > 0 && look % 10 == 0)
      {
        ASSERT_NO_FATAL_FAILURE(check_frame(run, seen - 1, most));
      }
    }
    ASSERT_TRUE(writer.wait());
  }
  run.update({ path });
  ASSERT_EQ(run.index.size(), static_cast<std::size_t>(frames));
  EXPECT_GE(looks_with_news, bursts / 2) << "looks that found a frame";
  EXPECT_FALSE(run.index.changed());
  for (std::size_t i = 0; i < run.index.size(); ++i)
  {
    ASSERT_NO_FATAL_FAILURE(check_frame(run, i, most));
  }
  // as if it had never been looked at before
  Series fresh;
  fresh.update({ path });
  ASSERT_EQ(fresh.index.size(), run.index.size());
  for (std::size_t i = 0; i < run.index.size(); ++i)
  {
    ASSERT_EQ(run.index.first_piece(i).entry.offset, fresh.index.first_piece(i).entry.offset);
    ASSERT_EQ(run.index.first_piece(i).entry.end, fresh.index.first_piece(i).entry.end);
    ASSERT_EQ(run.index.first_piece(i).entry.line, fresh.index.first_piece(i).entry.line);
  }
}

std::string all_frames(std::string (*frame)(std::int64_t, std::int64_t), int frames, int most)
{
  std::string bytes;
  for (int i = 0; i < frames; ++i)
  {
    bytes += frame(i, most);
  }
  return bytes;
}

/// One member that is flushed at random places, as `| gzip` in a pipe that is fed now and then.
std::string gzip_flushed(const std::string& content, std::size_t flushes)
{
  z_stream stream = {};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(content.size() + 100 * flushes + 10000, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  std::size_t at = 0;
  for (const std::size_t end : random_ends(content.size(), flushes, 11))
  {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data() + at));
    stream.avail_in = static_cast<uInt>(end - at);
    deflate(&stream, end == content.size() ? Z_FINISH : Z_SYNC_FLUSH);
    at = end;
  }
  packed.resize(stream.total_out);
  EXPECT_EQ(deflateEnd(&stream), Z_OK);
  return packed;
}

/// One frame of Zstandard that is flushed at random places.
std::string zstd_flushed(const std::string& content, std::size_t flushes)
{
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_checksumFlag, 1);
  std::string packed(content.size() + 100 * flushes + 10000, '\0');
  ZSTD_outBuffer out = { packed.data(), packed.size(), 0 };
  std::size_t at = 0;
  for (const std::size_t end : random_ends(content.size(), flushes, 11))
  {
    ZSTD_inBuffer in = { content.data() + at, end - at, 0 };
    const auto mode = end == content.size() ? ZSTD_e_end : ZSTD_e_flush;
    EXPECT_EQ(ZSTD_compressStream2(context, &out, &in, mode), 0u);
    at = end;
  }
  ZSTD_freeCCtx(context);
  packed.resize(out.pos);
  return packed;
}

constexpr int frames = 240;
constexpr int most_rows = 14;
constexpr std::size_t looks = 1000;
constexpr const char* cut_short = "got the end of the file; what is there is taken unchecked";
}

TEST(GrowingRun, Text)
{
  // many times: that a line comes just between two reads is luck
  const Folder folder;
  const std::string bytes = all_frames(text_frame, frames, most_rows);
  for (int round = 0; round < 20; ++round)
  {
    const std::string path = folder.path("a" + std::to_string(round) + ".dump");
    ASSERT_NO_FATAL_FAILURE(follow(path, bytes, frames, most_rows, looks)) << "round " << round;
  }
}

TEST(GrowingRun, OtherForms)
{
  constexpr int few = 30;
  constexpr int large = 20000; // rows, more than all buffers of the reader hold
  const std::string text = all_frames(text_frame, frames, most_rows);
  const std::string large_text = all_frames(text_frame, few, large);
  std::string members;
  std::string packed_frames;
  for (int i = 0; i < frames; ++i)
  {
    members += packing::gzip(text_frame(i, most_rows));
    packed_frames += packing::zstd(text_frame(i, most_rows));
  }
  // without a name for its columns: id type xs ys zs in a box from 0 to 1
  const char* const unnamed = "set ColumnNames if the columns, which the file does not name";
  const struct
  {
    const char* name;
    std::string bytes;
    int frames, most;
    std::size_t looks;
    const char* may_say;
  } files[] = {
    { "large.dump", large_text, few, large, 200, "" },
    { "a.bin", all_frames(binary_frame, frames, most_rows), frames, most_rows, looks, unnamed },
    { "large.bin", all_frames(binary_frame, few, large), few, large, 200, unnamed },
    { "flushed.dump.gz", gzip_flushed(text, 500), frames, most_rows, looks, cut_short },
    // content of several MiB: seek points come into play
    { "large.dump.gz", gzip_flushed(large_text, 500), few, large, 100, cut_short },
    { "members.dump.gz", members, frames, most_rows, looks, cut_short },
    { "flushed.dump.zst", zstd_flushed(text, 500), frames, most_rows, looks, cut_short },
    { "frames.dump.zst", packed_frames, frames, most_rows, looks, cut_short },
  };
  const Folder folder;
  for (const auto& file : files)
  {
    SCOPED_TRACE(file.name);
    ASSERT_NO_FATAL_FAILURE(
      follow(folder.path(file.name), file.bytes, file.frames, file.most, file.looks, file.may_say));
  }
}

// ---- a file a process --------------------------------------------------------------------------

namespace
{
/// What some processes write, and how much of it is in their files.
class Processes
{
public:
  static constexpr unsigned count = 3;

  explicit Processes(const Folder& folder)
    : folder_(folder)
  {
    for (unsigned process = 0; process < count; ++process)
    {
      files.push_back(folder.write(name(process), ""));
    }
  }

  static Ids ids(std::int64_t frame, std::int64_t process)
  {
    return ids_from(1000 * process, (frame + process) % 4);
  }

  void write(std::int64_t frame)
  {
    for (unsigned process = 0; process < count; ++process)
    {
      text_[process] += particles(frame * step_size, ids(frame, process));
      ends_[process].push_back(text_[process].size());
    }
  }

  std::size_t left(unsigned process) const { return text_[process].size() - done_[process]; }

  /// Some of what was written comes to be in the file.
  void flush(unsigned process, std::size_t bytes)
  {
    folder_.append(name(process), text_[process].substr(done_[process], bytes));
    done_[process] = std::min(text_[process].size(), done_[process] + bytes);
  }

  /// How many frames are complete in all files.
  std::size_t complete() const
  {
    std::size_t least = ends_[0].size();
    for (unsigned process = 0; process < count; ++process)
    {
      const auto beyond = std::ranges::upper_bound(ends_[process], done_[process]);
      least = std::min(least, static_cast<std::size_t>(beyond - ends_[process].begin()));
    }
    return least;
  }

  /// Looks at the files, and checks what is shown.
  void look(Series& run) const
  {
    const std::string error = error_of([&] { run.update(files); });
    ASSERT_EQ(run.index.size(), this->complete()) << error;
    // how many frames some have before others is worth a word
    ASSERT_TRUE(run.said.empty() || run.said.ends_with("left out until all are there\n"))
      << run.said;
    for (std::size_t i = run.index.size() - std::min(run.index.size(), std::size_t{ 2 });
         i < run.index.size(); ++i)
    {
      Ids expected;
      for (unsigned process = 0; process < count; ++process)
      {
        const Ids some = ids(static_cast<std::int64_t>(i), process);
        expected.insert(expected.end(), some.begin(), some.end());
      }
      ASSERT_EQ(run.ids(i), expected) << "frame " << i;
    }
  }

  Files files;

private:
  static std::string name(unsigned process) { return "a." + std::to_string(process) + ".dump"; }

  const Folder& folder_;
  std::string text_[count];
  std::vector<std::size_t> ends_[count]; ///< of the frames
  std::size_t done_[count] = {};
};
}

TEST(GrowingRun, OneFileAProcessInStep)
{
  // as LAMMPS does, with dump_modify flush yes: no process is more than a frame ahead
  const Folder folder;
  Processes processes(folder);
  Series run;
  std::minstd_rand random(7);
  for (std::int64_t frame = 0; frame < 60; ++frame)
  {
    processes.write(frame);
    for (unsigned process = static_cast<unsigned>(frame % 3); processes.left(process) > 0;
         process = (process + 1) % 3)
    {
      processes.flush(process, processes.left(process) * (random() % 4 + 1) / 3 + 1);
      ASSERT_NO_FATAL_FAILURE(processes.look(run)) << "while frame " << frame << " is written";
      EXPECT_EQ(run.said, "") << "while frame " << frame << " is written";
    }
    for (unsigned process = 0; process < Processes::count; ++process)
    {
      processes.flush(process, processes.left(process));
    }
    ASSERT_NO_FATAL_FAILURE(processes.look(run)) << "when frame " << frame << " was written";
  }
}

TEST(GrowingRun, OneFileAProcessOutOfStep)
{
  // with dump_modify flush no: each file grows when 4 KiB are full, most of them in other frames
  const Folder folder;
  Processes processes(folder);
  Series run;
  for (std::int64_t frame = 0; frame < 200; ++frame)
  {
    processes.write(frame);
    for (unsigned process = 0; process < Processes::count; ++process)
    {
      if (processes.left(process) >= 4096)
      {
        processes.flush(process, 4096);
        ASSERT_NO_FATAL_FAILURE(processes.look(run)) << "when frame " << frame << " was written";
      }
    }
  }
}

// ---- files that are replaced -------------------------------------------------------------------

namespace
{
/// A file as a run may write it: text, binary, compressed.
struct Form
{
  const char* name;
  std::string (*write)(const std::vector<int>& frames);
};

std::string write_text(const std::vector<int>& list)
{
  std::string bytes;
  for (const int frame : list)
  {
    bytes += text_frame(frame, most_rows);
  }
  return bytes;
}

std::string write_binary(const std::vector<int>& list)
{
  std::string bytes;
  for (const int frame : list)
  {
    bytes += binary_frame(frame, most_rows);
  }
  return bytes;
}

std::string write_gzip(const std::vector<int>& list)
{
  return packing::gzip(write_text(list));
}

std::string write_zstd(const std::vector<int>& list)
{
  return packing::zstd(write_text(list));
}

constexpr Form forms[] = { { "a.dump", write_text }, { "a.bin", write_binary },
  { "a.dump.gz", write_gzip }, { "a.dump.zst", write_zstd } };

Steps steps_of(const std::vector<int>& list)
{
  Steps steps;
  for (const int frame : list)
  {
    steps.push_back(frame * step_size);
  }
  return steps;
}

void expect_frames(Series& run, const std::string& path, const std::vector<int>& list)
{
  SCOPED_TRACE(path);
  EXPECT_TRUE(run.index.changed());
  run.update({ path });
  EXPECT_FALSE(run.index.changed());
  EXPECT_EQ(run.steps(), steps_of(list));
  for (std::size_t i = 0; i < run.index.size(); ++i)
  {
    ASSERT_NO_FATAL_FAILURE(check_frame(run, i, most_rows));
  }
}
}

TEST(ReplacedFile, WrittenAnewIntoTheSameFile)
{
  for (const Form& form : forms)
  {
    const Folder folder;
    const std::string path = folder.write(form.name, form.write({ 1, 2, 3 }));
    const auto inode = granular::stamp_of(path).inode;
    Series run;
    run.update({ path });
    EXPECT_FALSE(run.index.changed());
    // larger, smaller, one frame that is neither
    for (const std::vector<int>& list :
      { std::vector<int>{ 4, 5, 6, 7, 8 }, std::vector<int>{ 1, 2 }, std::vector<int>{ 3 },
        std::vector<int>{ 1, 2, 3, 4, 5, 6, 7, 8 } })
    {
      folder.write(form.name, form.write(list));
      touch(path, 1);
      expect_frames(run, path, list);
    }
    EXPECT_EQ(granular::stamp_of(path).inode, inode);
  }
}

TEST(ReplacedFile, WrittenAnewOfTheSameLength)
{
  // frames 11 and 12 with the numbers of 21 and 22: not a byte more or less
  const auto same_length = [](std::string text)
  {
    text = replaced(text, "\n77\n", "\n78\n");
    return replaced(text, " 77\n", " 78\n");
  };
  for (const Form& form : { forms[0], forms[2] })
  {
    const Folder folder;
    const bool packed = &form != &forms[0] && std::string(form.name).ends_with(".gz");
    const std::string text = text_frame(11, most_rows);
    const std::string other = same_length(text);
    ASSERT_EQ(text.size(), other.size());
    ASSERT_NE(text, other);
    // stored, so that lengths stay
    const auto pack = [&](const std::string& bytes)
    { return packed ? packing::gzip(bytes, { 0 }) : bytes; };
    ASSERT_EQ(pack(text).size(), pack(other).size());
    const std::string path = folder.write(form.name, pack(text));
    Series run;
    run.update({ path });
    EXPECT_EQ(run.steps(), Steps{ 77 });
    folder.write(form.name, pack(other));
    touch(path, 1);
    EXPECT_TRUE(run.index.changed());
    // before it is looked at again it is not read for what it was
    EXPECT_EQ(error_of([&] { run.read(0); }),
      path + ": the file changed since it was indexed; reload the files");
    run.update({ path });
    EXPECT_EQ(run.steps(), Steps{ 78 });
    EXPECT_EQ(run.read(0).points()[2], 78);
  }
}

TEST(ReplacedFile, RenamedOver)
{
  for (const Form& form : forms)
  {
    const Folder folder;
    const std::string path = folder.write(form.name, form.write({ 1, 2, 3 }));
    Series run;
    run.update({ path });
    for (const std::vector<int>& list :
      { std::vector<int>{ 1, 2, 3, 4 }, std::vector<int>{ 3 }, std::vector<int>{ 5, 6, 7, 8, 11 } })
    {
      fs::rename(folder.write("new", form.write(list)), path);
      expect_frames(run, path, list);
    }
  }
}

TEST(ReplacedFile, ByAnotherForm)
{
  // a run that compresses its dumps when they are finished, under the same name
  const Folder folder;
  const std::string path = folder.write("a.dump", write_text({ 1, 2 }));
  Series run;
  run.update({ path });
  for (const Form& form : { forms[2], forms[1], forms[3], forms[0], forms[1], forms[2] })
  {
    folder.write("a.dump", form.write({ 1, 2, 3 }));
    touch(path, 1);
    expect_frames(run, path, { 1, 2, 3 });
  }
}

TEST(ReplacedFile, IsReadFromBeforeUntilItIsLookedAtAgain)
{
  // an open reader of what grew, and an error of what shrank or is another
  for (const Form& form : forms)
  {
    const Folder folder;
    const std::string path = folder.write(form.name, form.write({ 1, 2, 3 }));
    Series run;
    run.update({ path });
    const std::string more = form.write({ 4 });
    folder.append(form.name, more);
    ASSERT_NO_FATAL_FAILURE(check_frame(run, 2, most_rows)) << form.name;
    folder.write(form.name, form.write({ 1, 2 }));
    EXPECT_TRUE(error_of([&] { run.read(2); }).starts_with(path + ": the file was shortened"))
      << form.name;
    fs::rename(folder.write("new", form.write({ 8, 7, 6, 5 })), path);
    EXPECT_EQ(error_of([&] { run.read(2); }),
      path + ": the file changed since it was indexed; reload the files")
      << form.name;
  }
}

// ---- files that go and come --------------------------------------------------------------------

TEST(RemovedFile, DropsOutAndComesBack)
{
  const Folder folder;
  Files files;
  for (int i = 0; i < 6; ++i)
  {
    files.push_back(folder.write("dump." + std::to_string(i), text_frame(i, most_rows)));
  }
  Series run;
  run.update(files);
  EXPECT_EQ(run.said, "");
  // dump_modify maxfiles: the oldest is removed
  for (int i = 0; i < 3; ++i)
  {
    fs::remove(files[static_cast<std::size_t>(i)]);
    EXPECT_TRUE(run.index.changed());
    // what is still listed cannot be read, and says so
    EXPECT_EQ(error_of([&] { run.read(0); }),
      files[static_cast<std::size_t>(i)] + ": cannot open: No such file or directory");
    run.update(files);
    EXPECT_FALSE(run.index.changed());
    EXPECT_EQ(run.steps().front(), (i + 1) * step_size);
    EXPECT_EQ(run.index.size(), static_cast<std::size_t>(5 - i));
    EXPECT_NE(run.said.find(files[static_cast<std::size_t>(i)] +
                ": cannot open: No such file or directory; the file is left out\n"),
      std::string::npos)
      << run.said;
    check_frame(run, 0, most_rows);
  }
  folder.write("dump.1", text_frame(1, most_rows));
  EXPECT_TRUE(run.index.changed());
  run.update(files);
  EXPECT_EQ(run.steps(), steps_of({ 1, 3, 4, 5 }));
  check_frame(run, 0, most_rows);
  // all of them
  for (const std::string& file : files)
  {
    fs::remove(file);
  }
  EXPECT_TRUE(run.index.changed());
  EXPECT_EQ(
    error_of([&] { run.update(files); }), files[0] + ": cannot open: No such file or directory");
  EXPECT_EQ(run.index.size(), 0u);
  EXPECT_FALSE(run.index.changed());
  folder.write("dump.5", text_frame(5, most_rows));
  EXPECT_TRUE(run.index.changed());
  run.update(files);
  EXPECT_EQ(run.steps(), steps_of({ 5 }));
}

TEST(RemovedFile, TheOnlyOneComesBackInAnyForm)
{
  for (const Form& form : forms)
  {
    const Folder folder;
    const std::string path = folder.write(form.name, form.write({ 1, 2, 3 }));
    Series run;
    run.update({ path });
    fs::remove(path);
    EXPECT_TRUE(run.index.changed());
    EXPECT_NE(error_of([&] { run.update({ path }); }), "");
    EXPECT_FALSE(run.index.changed());
    folder.write(form.name, form.write({ 2, 3, 4, 5 }));
    expect_frames(run, path, { 2, 3, 4, 5 });
  }
}

TEST(RemovedFile, OfAPieceTakesTheFramesThatItWasOf)
{
  const Folder folder;
  Files files;
  for (int step = 0; step < 5; ++step)
  {
    for (int process = 0; process < 3; ++process)
    {
      files.push_back(folder.write("d." + std::to_string(step) + "." + std::to_string(process),
        particles(step, ids_from(10 * process, 2))));
    }
  }
  Series run;
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 0, 1, 2, 3, 4 }));
  fs::remove(files[1]);
  EXPECT_TRUE(run.index.changed());
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 1, 2, 3, 4 }));
  fs::remove(files[0]);
  fs::remove(files[2]);
  run.update(files);
  EXPECT_EQ(run.steps(), (Steps{ 1, 2, 3, 4 }));
  EXPECT_EQ(run.index.pieces(0).size(), 3u);
}

TEST(RemovedFile, TwiceInTheListIsOneFile)
{
  const Folder folder;
  const std::string path = folder.write("a.dump", "ITEM: UNITS\nsi\n" + write_text({ 1 }));
  Series run;
  run.update({ path, path });
  for (int frame = 2; frame < 6; ++frame)
  {
    folder.append("a.dump", write_text({ frame }));
    run.update({ path, path });
    ASSERT_EQ(run.index.size(), static_cast<std::size_t>(frame));
    for (std::size_t i = 0; i < run.index.size(); ++i)
    {
      EXPECT_EQ(run.index.first_piece(i).entry.kind->units, "si") << "frame " << i;
      check_frame(run, i, most_rows);
    }
  }
}
