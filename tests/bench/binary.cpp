// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps: the rows of a frame to columns, against a plain copy of the same numbers.
#include "bench.h"
#include "dump_frame.h"
#include "dump_text.h"

#include "granular/dump/formats/frame_rows.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <span>

namespace bench
{
namespace
{
/// The yardstick: row by row, and in it column by column, each double to an array of its column.
/// Nothing is looked at.
class PlainCopy
{
public:
  explicit PlainCopy(const BinaryFrame& frame)
    : values_(frame.values)
    , arrays_(frame.form.words(), std::vector<double>(static_cast<std::size_t>(frame.form.count)))
  {
    for (std::vector<double>& array : arrays_)
    {
      columns_.push_back(array.data());
    }
  }

  bool run()
  {
    const std::size_t columns = columns_.size();
    const std::size_t rows = values_.size() / columns;
    const double* from = values_.data();
    double* const* const to = columns_.data();
    for (std::size_t row = 0; row < rows; ++row)
    {
      for (std::size_t column = 0; column < columns; ++column)
      {
        to[column][row] = *from++;
      }
    }
    return arrays_.back().back() == values_.back();
  }

private:
  std::span<const double> values_;
  std::vector<std::vector<double>> arrays_;
  std::vector<double*> columns_;
};

/// The rows of a frame to memory that has been touched, types narrowed as the sinks say.
bool decode(const granular::ByteSource& source, const granular::FrameEntry& entry, Output& output)
{
  std::vector<granular::ColumnSink> sinks = output.sinks(0);
  const std::unique_ptr<granular::FrameRows> rows = granular::open_rows(source, entry);
  const std::unique_ptr<granular::RowReader> reader = rows->reader();
  const std::int64_t chunk = granular::chunk_extent(entry, std::size_t{ 1 } << 18);
  std::int64_t count = 0;
  for (std::int64_t row = 0; row < entry.rows; row += chunk)
  {
    reader->open(row, std::min(row + chunk, entry.rows));
    count += reader->decode(sinks, chunk);
  }
  return count == entry.rows;
}

void tell_speeds(benchmark::State& state, const Rounds& rounds)
{
  for (const char* const name : { "copy", "file", "memory", "read_dump" })
  {
    tell(state, name, 1e-9 / median(rounds.of(name)), "GB/s");
  }
  for (const std::string name : { "file", "memory", "read_dump" })
  {
    tell(state, name + " against copy", median_ratio(rounds.of("copy"), rounds.of(name)), "1");
  }
  tell(state, "spread", spread_of_ratio(rounds.of("copy"), rounds.of("file")), "1");
}

void measure(benchmark::State& state, const Rows& form, std::int64_t rows_a_chunk)
{
  const BinaryFrame frame(form, rows_a_chunk);
  const granular::FrameEntry& entry = frame.index.first_piece(0).entry;
  const auto memory = granular::open_memory(frame.bytes);
  const auto file = granular::open_file(frame.file.path());
  const std::size_t points_at = form.columns.starts_with("x") ? 0 : 2;
  Output from_memory(form, form.count);
  Output from_file(form, form.count);
  PlainCopy copy(frame);
  granular::DumpFrame read;
  Rounds rounds;
  rounds.add("copy", [&copy] { return copy.run(); });
  rounds.add("file", [&] { return decode(*file, entry, from_file); });
  rounds.add("memory", [&] { return decode(*memory, entry, from_memory); });
  rounds.add("read_dump",
    [&]
    {
      read = read_frame(frame.index, 0);
      return read.rows == form.count;
    });
  const auto bytes = static_cast<double>(frame.values.size() * sizeof(double));
  for (auto _ : state)
  {
    read = {};
    const bool right = rounds.run(bytes);
    if (!right || !(from_file == frame.truth) || !(from_memory == frame.truth) ||
      !holds(read, frame.truth, form.count, points_at))
    {
      fail(state, "values differ from those that were written");
      return;
    }
    state.SetIterationTime(rounds.of("file").back() * bytes);
  }
  tell_speeds(state, rounds);
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t rows = size.pick(1'000'000, 3'000);
  const Array vector = { ValueType::Float64, 3 };
  Rows custom = make_rows(Form::Custom, 0);
  Rows scaled = { "id type xs ys zs", { { ValueType::Int64, 1 }, { ValueType::Int32, 1 }, vector },
    0, {} };
  Rows doubles = { "x y z vx vy vz fx fy fz omegax omegay omegaz",
    { vector, vector, vector, vector }, 0, {} };
  custom.count = scaled.count = doubles.count = rows;
  struct Case
  {
    const char* name;
    const Rows& form;
    std::int64_t rows_a_chunk;
  };
  const Case cases[] = {
    { "12 columns", custom, rows },
    { "12 columns, 16 chunks", custom, (rows + 15) / 16 },
    { "12 columns, chunks of 100 rows", custom, 100 },
    { "12 columns, all doubles", doubles, rows },
    { "5 columns", scaled, rows },
  };
  for (const Case& each : cases)
  {
    add(std::string("binary/") + each.name, size.pick(15, 1),
      [form = each.form, chunk = each.rows_a_chunk](benchmark::State& state)
      { measure(state, form, chunk); });
  }
}
}
