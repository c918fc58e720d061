// SPDX-License-Identifier: BSD-3-Clause
// One frame read by more and more threads, time on the wall: against one of them, against the plain
// loop on the same text in memory, and, where nothing has to be unpacked, against decode_rows alone.
#include "bench.h"
#include "dump_frame.h"
#include "dump_text.h"

#include "granular/memory/block_pool.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>

#define ZLIB_CONST
#include <zlib.h>
#include <zstd.h>

namespace bench
{
namespace
{
/// 1, 2, 4 and so on, and all cores; two threads also where there is only one.
std::vector<int> thread_counts()
{
  const int cores = std::max(2, granular::available_cores());
  std::vector<int> counts;
  for (int threads = 1; threads < cores; threads *= 2)
  {
    counts.push_back(threads);
  }
  counts.push_back(cores);
  return counts;
}

std::string name_of(int threads)
{
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

/// A file, its only frame, and what must come out: these rows, over and over.
struct Subject
{
  const granular::RunIndex& index;
  const Output& truth;
  std::int64_t truth_rows;
  std::int64_t rows;
};

/// Reads the frame again and again, as a pipeline does: the memory is that of a frame before.
class Reading
{
public:
  explicit Reading(const Subject& subject)
    : subject_(subject)
  {
    request_.pool = std::make_shared<granular::BlockPool>(std::size_t{ 1 } << 33);
  }

  bool run(int threads)
  {
    const double start = processor();
    request_.pool->next_frame();
    request_.threads = threads;
    frame_ = read_frame(subject_.index, 0, request_);
    processor_[threads].push_back(processor() - start);
    return frame_.rows == subject_.rows;
  }

  /// Processor time of each run, also of those that only checked.
  const Samples& processor_times(int threads) { return processor_[threads]; }

  bool check(int threads)
  {
    return this->run(threads) && holds(frame_, subject_.truth, subject_.truth_rows);
  }

private:
  Subject subject_;
  granular::DumpRequest request_;
  granular::DumpFrame frame_;
  std::map<int, Samples> processor_;
};

/// What the frame is held against: loops over the same text, as far as they make sense.
struct Yardsticks
{
  TextInMemory* parse = nullptr;
  TextInMemory* decode = nullptr;
};

void tell_times(
  benchmark::State& state, const Rounds& rounds, Reading& reading, const Yardsticks& yardsticks)
{
  for (const std::string yardstick : { "from_chars", "decode alone" })
  {
    if (yardstick == "from_chars" ? yardsticks.parse : yardsticks.decode)
    {
      tell(state, yardstick, 1e9 * median(rounds.of(yardstick)), "ns/row");
    }
  }
  const Samples& one = rounds.of(name_of(1));
  for (const int threads : thread_counts())
  {
    const std::string name = name_of(threads);
    const Samples& ours = rounds.of(name);
    tell(state, name, 1e9 * median(ours), "ns/row");
    tell(state, name + ", speed against 1 thread", median_ratio(one, ours), "1");
    tell(state, name + ", spread", spread_of_ratio(one, ours), "1");
    tell(state, name + ", processor time against 1 thread",
      median_ratio(reading.processor_times(threads), reading.processor_times(1)), "1");
    if (yardsticks.parse)
    {
      const Samples& plain = rounds.of("from_chars");
      tell(state, name + ", speed against from_chars", median_ratio(plain, ours), "1");
    }
    if (yardsticks.decode)
    {
      const Samples& alone = rounds.of("decode alone");
      tell(state, name + ", time against decode alone", median_ratio(ours, alone), "1");
    }
  }
}

void add_yardsticks(Rounds& rounds, const Yardsticks& yardsticks)
{
  if (TextInMemory* const text = yardsticks.parse)
  {
    rounds.add("from_chars", [text] { return text->parse(); });
  }
  if (TextInMemory* const text = yardsticks.decode)
  {
    rounds.add("decode alone", [text] { return text->decode(); });
  }
}

void measure(benchmark::State& state, const Subject& subject, const Yardsticks& yardsticks)
{
  Reading reading(subject);
  Rounds rounds(wall);
  add_yardsticks(rounds, yardsticks);
  for (const int threads : thread_counts())
  {
    if (!reading.check(threads))
    {
      fail(state, name_of(threads) + ": values differ from those that were written");
      return;
    }
    rounds.add(name_of(threads), [&reading, threads] { return reading.run(threads); });
  }
  if (!rounds.run_all(state, "rows are missing", static_cast<double>(subject.rows)))
  {
    return;
  }
  tell_times(state, rounds, reading, yardsticks);
}

void text(benchmark::State& state, std::int64_t rows)
{
  const TextFrame frame(Form::Custom, rows);
  TextInMemory memory(frame.rows, frame.count / frame.rows.count);
  measure(state, { frame.index, frame.truth, frame.rows.count, frame.count }, { &memory, &memory });
}

void binary(benchmark::State& state, std::int64_t rows)
{
  Rows form = make_rows(Form::Custom, 0);
  form.count = rows;
  const BinaryFrame frame(form, (rows + 15) / 16);
  measure(state, { frame.index, frame.truth, rows, rows }, {});
}

/// One member, level 6, as the program gzip writes it.
std::string gzip(const std::string& bytes)
{
  z_stream stream = {};
  if (deflateInit2(&stream, 6, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
  {
    throw std::bad_alloc();
  }
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END)
  {
    throw std::logic_error("gzip failed");
  }
  return packed;
}

/// One frame, level 3, as the program zstd writes it.
std::string zstd(const std::string& bytes)
{
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
    ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3);
  if (ZSTD_isError(size))
  {
    throw std::logic_error(ZSTD_getErrorName(size));
  }
  packed.resize(size);
  return packed;
}

/// Many frames of Zstandard, as the writer of dumps makes them.
std::string zstd_parts(const std::string& bytes)
{
  std::string packed;
  for (std::size_t at = 0; at < bytes.size(); at += std::size_t{ 1 } << 20)
  {
    packed += zstd(bytes.substr(at, std::size_t{ 1 } << 20));
  }
  return packed;
}

/// more: a frame behind it, without rows.
void packed(benchmark::State& state, std::int64_t rows,
  std::string (*pack)(const std::string& bytes), bool more)
{
  const TextFrame frame(Form::Custom, rows);
  TextInMemory memory(frame.rows);
  std::ifstream in(frame.file.path(), std::ios::binary);
  TemporaryFile file;
  std::string content(std::istreambuf_iterator<char>(in), {});
  content += more ? header(100, 0, 0, 1, Print::Full, frame.rows) : "";
  file.append(pack(content));
  const granular::RunIndex index = index_of({ file.path() });
  measure(state, { index, frame.truth, frame.rows.count, frame.count }, { &memory, nullptr });
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t rows = size.pick(1'000'000, 10'000);
  const std::int64_t rounds = size.pick(15, 1);
  struct Case
  {
    const char* name;
    std::function<void(benchmark::State&)> run;
    std::int64_t rounds;
  };
  std::vector<Case> cases = {
    { "text", [rows](benchmark::State& state) { text(state, rows); }, rounds },
    { "binary, 16 chunks", [rows](benchmark::State& state) { binary(state, rows); },
      size.pick(15, 1) },
    { "gzip", [rows](benchmark::State& state) { packed(state, rows, gzip, false); }, rounds },
    { "gzip, two frames", [rows](benchmark::State& state) { packed(state, rows, gzip, true); },
      rounds },
    { "Zstandard", [rows](benchmark::State& state) { packed(state, rows, zstd, false); }, rounds },
    { "Zstandard, two frames in parts of 1 MiB",
      [rows](benchmark::State& state) { packed(state, rows, zstd_parts, true); }, rounds },
  };
  if (size.large)
  {
    cases.push_back(
      { "text, 3 times as long", [rows](benchmark::State& state) { text(state, 3 * rows); }, 9 });
  }
  for (const Case& each : cases)
  {
    add(std::string("threads/") + each.name, each.rounds, each.run);
  }
}
}
