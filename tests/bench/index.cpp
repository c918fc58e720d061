// SPDX-License-Identifier: BSD-3-Clause
// Finding the frames of a file: scan_lines and RunIndex against counting line feeds with memchr.
#include "bench.h"
#include "dump_text.h"

#include "granular/dump/formats/dump_files.h"
#include "granular/frames/run_index.h"
#include "granular/text/line_scan.h"

#include <algorithm>
#include <cstring>

namespace bench
{
namespace
{
using granular::Simd;

/// What the index reads at a time.
constexpr std::size_t window = std::size_t{ 1 } << 18;

std::int64_t count_feeds(const char* first, const char* last)
{
  std::int64_t feeds = 0;
  while (const void* feed = std::memchr(first, '\n', static_cast<std::size_t>(last - first)))
  {
    first = static_cast<const char*>(feed) + 1;
    ++feeds;
  }
  return feeds;
}

/// The yardstick: the same file, read in the same way.
std::int64_t count_feeds(const std::string& path)
{
  const auto source = granular::open_file(path);
  granular::PaddedBuffer buffer(window);
  std::int64_t feeds = 0;
  std::int64_t offset = 0;
  for (std::size_t got = 1; got > 0; offset += static_cast<std::int64_t>(got))
  {
    got = source->read(offset, buffer.data(), buffer.size());
    feeds += count_feeds(buffer.data(), buffer.data() + got);
  }
  return feeds;
}

/// A file of many frames of the same rows.
struct Dump
{
  Dump(Form form, std::int64_t frame_count, std::int64_t rows_a_frame)
    : rows(make_rows(form, rows_a_frame))
    , frames(frame_count)
  {
    std::string text;
    for (std::int64_t frame = 0; frame < frames; ++frame)
    {
      const std::string head = header(100 * frame, rows.count, 0, 1, Print::Full, rows);
      feeds += rows.count + std::count(head.begin(), head.end(), '\n');
      bytes += static_cast<double>(head.size() + rows.text.size());
      text += head;
      text += rows.text;
    }
    file.append(text);
  }

  Rows rows;
  TemporaryFile file;
  std::int64_t frames;
  std::int64_t feeds = 0;
  double bytes = 0;
};

/// Whether the index has every frame, each with its rows where they are.
bool check(const Dump& dump, const granular::RunIndex& index, const granular::Notices& notices)
{
  bool right = notices.empty() && static_cast<std::int64_t>(index.size()) == dump.frames;
  std::int64_t end = 0;
  std::int64_t step = 0;
  for (std::size_t i = 0; i < index.size(); ++i)
  {
    const granular::FrameEntry& frame = index.first_piece(i).entry;
    right = right && frame.offset == end && frame.timestep == step && frame.rows == dump.rows.count;
    end = frame.end;
    step += 100;
  }
  return right && static_cast<double>(end) == dump.bytes;
}

void index_file(benchmark::State& state, Form form, std::int64_t frames, std::int64_t rows)
{
  const Dump dump(form, frames, rows);
  Rounds rounds;
  rounds.add("memchr", [&dump] { return count_feeds(dump.file.path()) == dump.feeds; });
  rounds.add("index",
    [&dump]
    {
      granular::RunIndex index;
      granular::Notices notices;
      granular::Progress progress;
      index.update({ dump.file.path() }, { .format = &granular::dump_format() }, notices, progress);
      return check(dump, index, notices);
    });
  if (!rounds.run_all(state, "the index does not hold the frames of the file", dump.bytes))
  {
    return;
  }
  tell(state, "memchr", 1e-9 / median(rounds.of("memchr")), "GB/s");
  tell(state, "index", 1e-9 / median(rounds.of("index")), "GB/s");
  tell(state, "ratio", median_ratio(rounds.of("index"), rounds.of("memchr")), "1");
  tell(state, "ratio spread", spread_of_ratio(rounds.of("index"), rounds.of("memchr")), "1");
}

/// In memory, a window at a time, as it is when it has just been read.
void scan_memory(benchmark::State& state, Form form, std::int64_t count)
{
  const Rows rows = make_rows(form, count);
  const granular::PaddedBuffer text = padded(rows.text);
  const std::vector<Slice> slices = cut(text.data(), text.data() + text.size(), window);
  Slice slice = slices.front();
  Rounds rounds;
  rounds.add("memchr", [&slice] { return count_feeds(slice.first, slice.last) == slice.rows; });
  const auto scan = [&slice](Simd simd)
  {
    const granular::LineScan found = granular::scan_lines(slice.first, slice.last, 'I', {}, simd);
    return found.feeds == slice.rows && found.ptr == slice.last;
  };
  rounds.add("portable", [scan] { return scan(Simd::Portable); });
  rounds.add("index", [scan] { return scan(granular::best_simd()); });
  std::size_t next = 0;
  for (auto _ : state)
  {
    slice = slices[next++ % slices.size()];
    const auto bytes = static_cast<double>(slice.last - slice.first);
    bool right = count_feeds(slice.first, slice.last) == slice.rows; // brings it into the cache
    right = rounds.run(bytes, 8) && right;
    if (!right)
    {
      fail(state, "scan_lines does not count the line feeds of the text");
      return;
    }
    state.SetIterationTime(rounds.of("index").back() * bytes);
  }
  tell(state, "memchr", 1e-9 / median(rounds.of("memchr")), "GB/s");
  tell(state, "portable", 1e-9 / median(rounds.of("portable")), "GB/s");
  tell(state, "index", 1e-9 / median(rounds.of("index")), "GB/s");
  tell(state, "ratio", median_ratio(rounds.of("index"), rounds.of("memchr")), "1");
  tell(state, "ratio spread", spread_of_ratio(rounds.of("index"), rounds.of("memchr")), "1");
}
}

void add_benchmarks(const Size& size)
{
  struct Case
  {
    const char* name;
    Form form;
    std::int64_t frames;
    std::int64_t rows;
  };
  const Case cases[] = {
    { "file, 8 columns", Form::Atom, 1, size.pick(1'000'000, 3'000) },
    { "file, 12 columns", Form::Custom, 1, size.pick(1'000'000, 3'000) },
    { "file, 12 columns, frames of 1000 rows", Form::Custom, size.pick(1'000, 3), 1'000 },
  };
  for (const Case& each : cases)
  {
    add(std::string("index/") + each.name, size.pick(40, 1),
      [each](benchmark::State& state) { index_file(state, each.form, each.frames, each.rows); });
  }
  for (const Case& each : { Case{ "memory, 8 columns", Form::Atom, 1, size.pick(200'000, 3'000) },
         Case{ "memory, 12 columns", Form::Custom, 1, size.pick(200'000, 3'000) } })
  {
    add(std::string("index/") + each.name, size.pick(200, 1),
      [each](benchmark::State& state) { scan_memory(state, each.form, each.rows); });
  }
}
}
