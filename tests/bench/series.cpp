// SPDX-License-Identifier: BSD-3-Clause
// Long runs: many frames in a file, many files, files that hold pieces, and an index that was kept.
#include "bench.h"
#include "dump_frame.h"
#include "dump_text.h"
#include "heap.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace bench
{
namespace
{
using granular::KeepIndex;
using granular::RunIndex;

/// A folder that is gone when this is.
class TemporaryFolder
{
public:
  TemporaryFolder()
    : path_(file_.path() + ".folder")
  {
    std::filesystem::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::string& path() const noexcept { return path_; }

private:
  TemporaryFile file_; ///< for a name that nobody else has
  std::string path_;
};

/// A run as it is on disk: frames of the same rows in one file or in many. With pieces, each has the
/// same rows.
struct Run
{
  enum class Files
  {
    One,
    OneAFrame,
    OneAPiece
  };

  Run(Files how, Form form, std::int64_t frame_count, std::int64_t rows_a_frame,
    std::int64_t piece_count = 1)
    : rows(make_rows(form, rows_a_frame))
    , frames(frame_count)
    , pieces(piece_count)
  {
    constexpr std::size_t enough = std::size_t{ 1 } << 24;
    for (std::int64_t frame = 0; frame < frames; ++frame)
    {
      for (std::int64_t piece = 0; piece < pieces; ++piece)
      {
        text += header(100 * frame, rows.count, 0, 1, Print::Full, rows);
        text += rows.text;
        if (how != Files::One || text.size() > enough || frame + 1 == frames)
        {
          this->write(how, frame, piece);
        }
      }
    }
  }

  Rows rows;
  TemporaryFolder folder;
  std::vector<std::string> paths;
  std::int64_t frames;
  std::int64_t pieces;
  double bytes = 0;
  std::int64_t feeds = 0;

private:
  void write(Files how, std::int64_t frame, std::int64_t piece)
  {
    std::string path = folder.path() + "/run";
    path += how != Files::One ? "." + std::to_string(100 * frame) : "";
    path += how == Files::OneAPiece ? "." + std::to_string(piece) : "";
    path += ".dump";
    std::ofstream out(path, std::ios::binary | std::ios::app);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out)
    {
      throw std::runtime_error("cannot write " + path);
    }
    if (paths.empty() || paths.back() != path)
    {
      paths.push_back(path);
    }
    bytes += static_cast<double>(text.size());
    feeds += std::count(text.begin(), text.end(), '\n');
    text.clear();
  }

  std::string text;
};

/// Whether the index has every frame of the run, each where it lies.
bool lists(const RunIndex& index, const Run& run)
{
  if (static_cast<std::int64_t>(index.size()) != run.frames)
  {
    return false;
  }
  bool right = true;
  std::int64_t end = 0;
  for (std::size_t i = 0; i < index.size() && right; ++i)
  {
    const std::vector<granular::FramePiece> pieces = index.pieces(i);
    right = static_cast<std::int64_t>(pieces.size()) == run.pieces;
    for (std::size_t k = 0; k < pieces.size() && right; ++k)
    {
      const granular::FrameEntry& entry = pieces[k].entry;
      const bool alone = run.paths.size() > 1;
      right = entry.timestep == 100 * static_cast<std::int64_t>(i) &&
        entry.rows == run.rows.count && entry.offset == (alone ? 0 : end) &&
        pieces[k].file.path == run.paths[alone ? i * pieces.size() + k : 0];
      end = entry.end;
    }
  }
  return right && (run.paths.size() > 1 || static_cast<double>(end) == run.bytes);
}

/// A source that notes what was read of it.
class WatchedSource final : public granular::ByteSource
{
public:
  explicit WatchedSource(const std::string& path)
    : source_(granular::open_file(path))
  {
  }

  const std::string& path() const override { return source_->path(); }
  granular::FileStamp stamp() const override { return source_->stamp(); }
  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    const std::size_t got = source_->read(offset, buffer, bytes);
    least = std::min(least, offset);
    most = std::max(most, offset + static_cast<std::int64_t>(got));
    all += static_cast<std::int64_t>(got);
    return got;
  }

  mutable std::int64_t least = std::numeric_limits<std::int64_t>::max();
  mutable std::int64_t most = 0;
  mutable std::int64_t all = 0;

private:
  std::unique_ptr<granular::ByteSource> source_;
};

/// The yardstick of a long file: it is read in the same way, line feeds are counted.
std::int64_t count_feeds(const std::string& path, std::vector<char>& window)
{
  const auto source = granular::open_file(path);
  std::int64_t feeds = 0;
  std::int64_t offset = 0;
  for (std::size_t got = 1; got > 0; offset += static_cast<std::int64_t>(got))
  {
    got = source->read(offset, window.data(), window.size());
    const char* first = window.data();
    const char* const last = first + got;
    while (const void* feed = std::memchr(first, '\n', static_cast<std::size_t>(last - first)))
    {
      first = static_cast<const char*>(feed) + 1;
      ++feeds;
    }
  }
  return feeds;
}

/// The yardstick of many files: what it takes to look into each.
bool look_into(const std::vector<std::string>& paths)
{
  bool right = true;
  for (const std::string& path : paths)
  {
    char first[4096];
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    right = file >= 0 && ::read(file, first, sizeof first) > 0 && right;
    ::close(file);
  }
  return right;
}

/// An index that is made anew, from the files or from an index file.
struct Indexing
{
  explicit Indexing(const Run& a_run, KeepIndex where = KeepIndex::Never)
    : run(a_run)
  {
    options.keep_index = where;
    // pieces with the same particles are none unless somebody says so
    options.repeated_steps =
      run.pieces > 1 ? granular::RepeatedSteps::Merge : granular::RepeatedSteps::Auto;
  }

  bool operator()()
  {
    index = index_of(run.paths, options);
    return true;
  }

  const Run& run;
  granular::IndexOptions options = { .format = &granular::dump_format() };
  RunIndex index;
};

/// Times of indexing a run, against a yardstick, and of the other ways to come by its index.
void measure_index(benchmark::State& state, const Run& run, const std::function<bool()>& yardstick)
{
  Indexing anew(run);
  Indexing kept(run, KeepIndex::Beside);
  kept(); // writes the index file
  Rounds rounds;
  rounds.add("yardstick", yardstick);
  rounds.add("index", std::ref(anew));
  rounds.add("kept", std::ref(kept));
  rounds.add("again",
    [&]
    {
      granular::Notices notices;
      granular::Progress progress;
      anew.index.update(run.paths, anew.options, notices, progress);
      return notices.empty();
    });
  const auto works = static_cast<double>(run.frames);
  for (auto _ : state)
  {
    anew.index = {};
    kept.index = {};
    if (!rounds.run(works) || !lists(anew.index, run) || !lists(kept.index, run))
    {
      fail(state, "the index does not hold the frames of the run");
      return;
    }
    state.SetIterationTime(rounds.of("index").back() * works);
  }
  tell(state, "yardstick", 1e3 * works * median(rounds.of("yardstick")), "ms");
  tell(state, "index", 1e3 * works * median(rounds.of("index")), "ms");
  tell(state, "ratio", median_ratio(rounds.of("index"), rounds.of("yardstick")), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("index"), rounds.of("yardstick")), "1");
  tell(state, "from index file", 1e3 * works * median(rounds.of("kept")), "ms");
  tell(state, "from index file against index", median_ratio(rounds.of("kept"), rounds.of("index")),
    "1");
  tell(state, "index file",
    static_cast<double>(std::filesystem::file_size(run.paths.front() + ".granular.idx")) / works,
    "B/frame");
  tell(state, "again", 1e3 * works * median(rounds.of("again")), "ms");
}

/// Bytes of the index of a run while it is there, and the most while it is made.
void tell_memory(benchmark::State& state, const Run& run)
{
  const auto frames = static_cast<double>(run.frames);
  for (const KeepIndex where : { KeepIndex::Never, KeepIndex::Beside })
  {
    Indexing indexing(run, where);
    const HeapCount count;
    indexing();
    const std::string way = where == KeepIndex::Never ? "" : " from index file";
    tell(state, "memory" + way, static_cast<double>(count.live()) / frames, "B/frame");
    tell(state, "peak" + way, static_cast<double>(count.peak()) / frames, "B/frame");
    if (!lists(indexing.index, run))
    {
      fail(state, "the index does not hold the frames of the run");
    }
  }
}

/// The last frame of a file alone.
void measure_last_frame(benchmark::State& state, const Run& run)
{
  const RunIndex index = index_of(run.paths);
  Output truth(run.rows, run.rows.count);
  std::vector<granular::ColumnSink> sinks = truth.sinks(0);
  const bool parsed = parse_slowly(run.rows.text.c_str(), sinks, run.rows.count);
  const granular::FrameEntry& last = index.first_piece(index.size() - 1).entry;
  const WatchedSource watched(run.paths.front());
  granular::DumpFrame frame = read_frame(watched, last);
  if (!parsed || !holds(frame, truth, run.rows.count) || watched.least < last.offset ||
    watched.most > last.end)
  {
    fail(state, "values differ from strtod's, or other frames were read");
    return;
  }
  Rounds rounds;
  for (const bool first : { true, false })
  {
    rounds.add(first ? "first" : "last",
      [&, first]
      {
        frame = read_frame(index, first ? 0 : index.size() - 1);
        return frame.rows == run.rows.count;
      });
  }
  if (!rounds.run_all(state, "the frame does not have its rows", 1))
  {
    return;
  }
  tell(state, "last frame", 1e3 * median(rounds.of("last")), "ms");
  tell(state, "against the first", median_ratio(rounds.of("last"), rounds.of("first")), "1");
  tell(state, "bytes read against the frame's",
    static_cast<double>(watched.all) / static_cast<double>(last.end - last.offset), "1");
}

/// Indexing a run with one thread and with two.
void measure_threads(benchmark::State& state, const Run& run)
{
  Indexing alone(run);
  Indexing both(run);
  both.options.threads = 2;
  Rounds rounds(wall);
  rounds.add("1", std::ref(alone));
  rounds.add("2", std::ref(both));
  for (auto _ : state)
  {
    if (!rounds.run(1) || !lists(alone.index, run) || both.index.encode() != alone.index.encode())
    {
      fail(state, "the index does not hold the frames of the run");
      return;
    }
    state.SetIterationTime(rounds.of("2").back());
  }
  tell(state, "1 thread", 1e3 * median(rounds.of("1")), "ms");
  tell(state, "2 threads", 1e3 * median(rounds.of("2")), "ms");
  tell(state, "2 against 1", median_ratio(rounds.of("2"), rounds.of("1")), "1");
  tell(state, "2 against 1, spread", spread_of_ratio(rounds.of("2"), rounds.of("1")), "1");
}

/// How to look at the files of a run without thinking.
enum class Yardstick
{
  CountFeeds, ///< read all, count line feeds
  LookInto    ///< open, read 4 KiB, close
};

void index_run(benchmark::State& state, const Run& run, Yardstick yardstick)
{
  std::vector<char> window(std::size_t{ 1 } << 18); // as the index has it
  measure_index(state, run,
    [&]
    {
      return yardstick == Yardstick::LookInto ? look_into(run.paths)
                                              : count_feeds(run.paths.front(), window) == run.feeds;
    });
  tell_memory(state, run);
}
}

void add_benchmarks(const Size& size)
{
  struct Case
  {
    std::string name;
    Run::Files files;
    Yardstick yardstick;
    std::int64_t frames;
    std::int64_t rows;
    std::int64_t pieces;
    std::int64_t rounds;
  };
  using Files = Run::Files;
  const std::int64_t thousand = size.pick(1'000, 20);
  const std::int64_t many_rows = size.pick(10'000, 100);
  const Case cases[] = {
    { "1000 frames", Files::One, Yardstick::CountFeeds, thousand, many_rows, 1, size.pick(9, 1) },
    { "10^6 frames of 1 row", Files::One, Yardstick::CountFeeds, size.pick(1'000'000, 1'000), 1, 1,
      size.pick(3, 1) },
    { "10^4 files", Files::OneAFrame, Yardstick::LookInto, size.pick(10'000, 50), 100, 1,
      size.pick(11, 1) },
    { "1000 frames of 4 files", Files::OneAPiece, Yardstick::LookInto, thousand, 100, 4,
      size.pick(11, 1) },
  };
  for (const Case& each : cases)
  {
    add("series/" + each.name, each.rounds,
      [each](benchmark::State& state)
      {
        const Run run(each.files, Form::Atom, each.frames, each.rows, each.pieces);
        index_run(state, run, each.yardstick);
      });
  }
  const Case threaded[] = {
    { "frames of 10^6 rows", Files::One, {}, size.pick(3, 2), size.pick(1'000'000, 100'000), 1,
      size.pick(15, 1) },
    { "frames of 1000 rows", Files::One, {}, size.pick(3'000, 20), 1'000, 1, size.pick(15, 1) },
    { "10^4 files", Files::OneAFrame, {}, size.pick(10'000, 50), 100, 1, size.pick(15, 1) },
  };
  for (const Case& each : threaded)
  {
    add("series/threads, " + each.name, each.rounds,
      [each](benchmark::State& state)
      { measure_threads(state, Run(each.files, Form::Atom, each.frames, each.rows)); });
  }
  add("series/last of 1000 frames", size.pick(21, 1),
    [thousand, many_rows](benchmark::State& state)
    { measure_last_frame(state, Run(Files::One, Form::Atom, thousand, many_rows)); });
}
}
