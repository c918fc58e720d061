// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/binary_rows.h"

#include "granular/formats/dump/grammar/atom_fit.h"
#include "granular/formats/dump/grammar/binary_dump.h"
#include "granular/formats/dump/grammar/binary_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <type_traits>

namespace granular
{
namespace
{
/// Rows whose columns are converted one after the other: they stay in the nearest cache.
constexpr std::size_t block_bytes = std::size_t{ 1 } << 14;

/// Size of the number of values before a run.
constexpr std::int64_t count_bytes = sizeof(std::int32_t);

/// Bytes for such numbers that are read with the rows of a chunk.
constexpr std::int64_t run_counts = 512;

template <bool swapped>
double load(const char* from) noexcept
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, from, sizeof bits);
  if constexpr (swapped)
  {
    bits = __builtin_bswap64(bits);
  }
  return std::bit_cast<double>(bits);
}

template <typename T>
bool fits(double value) noexcept
{
  if constexpr (std::is_same_v<T, double>)
  {
    return true;
  }
  else
  {
    // the least value is a power of two, and so a double; the one above the largest is its negative
    constexpr auto least = static_cast<double>(std::numeric_limits<T>::min());
    return value >= least && value < -least && value == static_cast<double>(static_cast<T>(value));
  }
}

/// A column of some rows. Returns the first value that does not fit, or null.
template <typename T, bool swapped>
const char* convert_column(
  const char* from, std::size_t row_bytes, std::size_t rows, ColumnSink& sink) noexcept
{
  char* to = sink.data;
  for (std::size_t row = 0; row < rows; ++row, from += row_bytes, to += sink.stride)
  {
    const double value = load<swapped>(from);
    if (!fits<T>(value))
    {
      return from;
    }
    const T narrow = static_cast<T>(value);
    std::memcpy(to, &narrow, sizeof narrow);
  }
  sink.data = to;
  return nullptr;
}

using ConvertColumn = const char* (*)(const char*, std::size_t, std::size_t, ColumnSink&) noexcept;

/// Functions for Int32, Int64 and Float64, by byte order. There are no texts in binary files.
constexpr ConvertColumn convert_columns[][2] = {
  { convert_column<std::int32_t, false>, convert_column<std::int32_t, true> },
  { convert_column<std::int64_t, false>, convert_column<std::int64_t, true> },
  { convert_column<double, false>, convert_column<double, true> },
};

/// Returns why the columns of dump atom are none.
std::string describe_fit(std::size_t columns, AtomFit fit)
{
  return !is_atom(columns) ? ""
    : fit.scaled ? "; its rows lie in the box both as id type x y z and as id type xs ys zs"
                 : "; its rows lie in the box neither as id type x y z nor as id type xs ys zs";
}

constexpr std::size_t place_of(ValueType type) noexcept
{
  return type == ValueType::Int32 ? 0 : type == ValueType::Int64 ? 1 : 2;
}
}

BinaryRows::BinaryRows(const ByteSource& source, const FrameEntry& entry)
  : source_(source)
  , entry_(entry)
{
  const BinaryLayout& layout = binary_layouts()[static_cast<std::size_t>(entry.kind->layout)];
  const std::size_t columns = entry.kind->schema.columns().size();
  swapped_ = layout.swapped;
  std::vector<std::string> names;
  std::int64_t chunks_offset = 0;
  AtomFit fit;
  header_.rows = -1; // what is no header is not the one that was there
  try
  {
    const auto header = read_binary_header(source, entry.offset, layout);
    if (header && static_cast<std::size_t>(header->size_one) == columns)
    {
      header_ = header->frame;
      names = header->columns;
      fit = entry.kind->named ? AtomFit{} : fit_atom(source, *header, layout);
      chunks_offset = header->chunks_offset;
    }
  }
  catch (const FormatError&)
  {
    if (source.compressed())
    {
      throw;
    }
  }
  check_header(source.path(), entry, header_, names);
  if (!entry.kind->named)
  {
    throw FormatError("expected " + std::to_string(columns) +
        " names in ColumnNames, because the file does not name its columns, got none" +
        describe_first_row(source, entry.offset, layout) + describe_fit(columns, fit),
      where_of(source.path(), entry));
  }
  header_.units = entry.kind->units;
  row_bytes_ = static_cast<std::int64_t>(columns * sizeof(double));
  runs_.push_back({ 0, 0, chunks_offset });
}

std::unique_ptr<RowReader> BinaryRows::reader() const
{
  return std::make_unique<BinaryReader>(*this);
}

void BinaryRows::locate(Misfits& misfits) const
{
  for (Misfit& misfit : misfits)
  {
    misfit.where = { source_.path(), 0, misfit.offset,
      entry_.kind->schema.columns()[static_cast<std::size_t>(misfit.column)].name };
  }
}

void BinaryRows::fail_short(std::int64_t end) const
{
  throw IoError("the file was shortened while it was read: expected " + std::to_string(entry_.end) +
      " bytes, got " + std::to_string(end),
    { source_.path() });
}

/// Checks the number of values of a run.
void BinaryRows::check_place(std::int64_t at) const
{
  if (at + count_bytes > entry_.end)
  {
    throw IoError("the file changed while it was read: expected all rows up to byte " +
        std::to_string(entry_.end) + ", got some of them behind it",
      { source_.path() });
  }
}

std::int32_t BinaryRows::load_values(const char* from) const noexcept
{
  std::uint32_t values = 0;
  std::memcpy(&values, from, sizeof values);
  return static_cast<std::int32_t>(swapped_ ? __builtin_bswap32(values) : values);
}

/// The run behind a run, which holds so many values.
BinaryRows::Run BinaryRows::next_run(const Run& run, std::int32_t values) const
{
  const std::int64_t before = run.first + run.rows;
  const std::int64_t columns = row_bytes_ / static_cast<std::int64_t>(sizeof(double));
  if (values < 0 || values % columns != 0 || values / columns > entry_.rows - before)
  {
    throw IoError("the file changed while it was read: expected a chunk of at most " +
        std::to_string((entry_.rows - before) * columns) + " values, got " + std::to_string(values),
      { source_.path() });
  }
  return { before, values / columns, this->behind(run) + count_bytes };
}

/// The run that holds a row. Those before it that nobody has met are passed over.
BinaryRows::Run BinaryRows::find_run(std::int64_t row) const
{
  const std::lock_guard lock(mutex_);
  for (Run run = runs_.back(); run.first + run.rows <= row;)
  {
    const std::int64_t at = this->behind(run);
    this->check_place(at);
    char bytes[count_bytes];
    const std::size_t got = source_.read(at, bytes, sizeof bytes);
    if (got < sizeof bytes)
    {
      this->fail_short(at + static_cast<std::int64_t>(got));
    }
    run = this->next_run(run, this->load_values(bytes));
    if (run.rows > 0) // there may be many processes without
    {
      runs_.push_back(run);
    }
  }
  const auto behind_it = std::ranges::upper_bound(runs_, row, {}, &Run::first);
  return behind_it[-1];
}

/// Keeps the runs that a reader has met, one behind the other, for those who come. In a file that
/// changes another may have met others.
void BinaryRows::keep_runs(const std::vector<Run>& runs) const
{
  const std::lock_guard lock(mutex_);
  for (const Run& run : runs)
  {
    if (run.first == runs_.back().first + runs_.back().rows)
    {
      runs_.push_back(run);
    }
  }
}

/// Fills the buffer up to that place of the content.
void BinaryReader::fill(std::int64_t end)
{
  const std::int64_t from = offset_ + static_cast<std::int64_t>(filled_);
  const auto bytes = static_cast<std::size_t>(std::max(std::int64_t{ 0 }, end - from));
  if (buffer_.size() < filled_ + bytes)
  {
    buffer_.resize(filled_ + bytes + std::size_t{ 2 * run_counts });
  }
  const std::size_t got = of_.source_.read(from, buffer_.data() + filled_, bytes);
  if (got < bytes)
  {
    of_.fail_short(from + static_cast<std::int64_t>(got));
  }
  filled_ += bytes;
}

void BinaryReader::open(std::int64_t first, std::int64_t last)
{
  runs_.clear();
  run_ = filled_ = 0;
  in_run_ = decoded_ = 0;
  rows_ = std::max(std::int64_t{ 0 }, last - first);
  if (rows_ == 0)
  {
    return;
  }
  BinaryRows::Run run = of_.find_run(first);
  offset_ = run.offset + (first - run.first) * of_.row_bytes_;
  std::int64_t more = run_counts;
  this->fill(std::min(offset_ + rows_ * of_.row_bytes_ + more, of_.entry_.end));
  runs_.push_back(run);
  while (run.first + run.rows < last)
  {
    const std::int64_t at = of_.behind(run);
    of_.check_place(at);
    if (at + count_bytes > offset_ + static_cast<std::int64_t>(filled_))
    {
      this->fill(std::min(at + more, of_.entry_.end));
      more *= 2;
    }
    run = of_.next_run(run, of_.load_values(buffer_.data() + (at - offset_)));
    if (run.rows > 0)
    {
      runs_.push_back(run);
    }
  }
  of_.keep_runs(runs_);
  this->fill(run.offset + (last - run.first) * of_.row_bytes_);
  runs_.back().rows = last - run.first;
  runs_.front() = { first, runs_.front().first + runs_.front().rows - first, offset_ };
}

std::int64_t BinaryReader::decode(std::span<ColumnSink> sinks, std::int64_t max_rows)
{
  std::int64_t done = 0;
  while (done < max_rows && this->more())
  {
    const BinaryRows::Run& run = runs_[run_];
    const std::int64_t rows = std::min(max_rows - done, run.rows - in_run_);
    const char* const from = buffer_.data() + (run.offset + in_run_ * of_.row_bytes_ - offset_);
    this->convert(sinks, from, static_cast<std::size_t>(rows));
    done += rows;
    decoded_ += rows;
    in_run_ += rows;
    if (in_run_ == run.rows)
    {
      ++run_;
      in_run_ = 0;
    }
  }
  return done;
}

const char* BinaryReader::convert_column(
  const char* row, std::size_t rows, ColumnSink& sink) const noexcept
{
  return convert_columns[place_of(sink.type)][of_.swapped_](
    row + sink.column * sizeof(double), static_cast<std::size_t>(of_.row_bytes_), rows, sink);
}

void BinaryReader::convert(std::span<ColumnSink> sinks, const char* from, std::size_t rows) const
{
  const auto row_bytes = static_cast<std::size_t>(of_.row_bytes_);
  const std::size_t block = std::max(std::size_t{ 1 }, block_bytes / row_bytes);
  for (std::size_t left = rows; left > 0;)
  {
    const std::size_t count = std::min(block, left);
    bool fits = true;
    for (ColumnSink& sink : sinks)
    {
      fits = this->convert_column(from, count, sink) == nullptr && fits;
    }
    if (!fits)
    {
      this->fail(sinks, from, left);
    }
    from += count * row_bytes;
    left -= count;
  }
}

/// Throws what does not fit in these rows, of each column the first.
void BinaryReader::fail(std::span<const ColumnSink> sinks, const char* from, std::size_t rows) const
{
  Misfits misfits;
  for (const ColumnSink& sink : sinks)
  {
    double number = 0;
    ColumnSink nowhere = { sink.column, sink.type, reinterpret_cast<char*>(&number), 0 };
    if (const char* const value = this->convert_column(from, rows, nowhere))
    {
      misfits.push_back(this->misfit_of(sink, value));
    }
  }
  std::ranges::sort(misfits, {}, &Misfit::offset);
  throw misfits;
}

Misfit BinaryReader::misfit_of(const ColumnSink& sink, const char* value) const
{
  const double number = of_.swapped_ ? load<true>(value) : load<false>(value);
  char word[32];
  const auto end = std::to_chars(word, word + sizeof word, number).ptr;
  return { RowStatus::NotExact, static_cast<int>(sink.column), std::string(word, end),
    offset_ + (value - buffer_.data()) };
}
}
