// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/atom_fit.h"
#include "granular/formats/dump/grammar/binary_dump.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <mutex>
#include <type_traits>
#include <vector>

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

constexpr std::size_t place_of(ValueType type) noexcept
{
  return type == ValueType::Int32 ? 0 : type == ValueType::Int64 ? 1 : 2;
}

/// The rows of a frame of a binary dump: the chunks of the ranks, one after the other, as doubles, row-major. Values are
/// narrowed to the column's type if that is exact; others are an error.
class BinaryRows final : public FrameRows
{
public:
  /// The rows of one rank, after their number.
  struct Run
  {
    std::int64_t first; ///< row
    std::int64_t rows;
    std::int64_t offset; ///< of the first row
  };

  BinaryRows(const ByteSource& source, const FrameEntry& entry);

  const FrameHeader& header() const noexcept override { return header_; }
  std::unique_ptr<RowReader> reader() const override;

  void locate(Misfits& misfits) const override
  {
    for (Misfit& misfit : misfits)
    {
      misfit.where = { source.path(), 0, misfit.offset,
        entry.kind->schema.columns()[static_cast<std::size_t>(misfit.column)].name };
    }
  }

  [[noreturn]] void fail_short(std::int64_t end) const
  {
    throw IoError("the file was shortened while it was read: expected " +
        std::to_string(entry.end) + " bytes, got " + std::to_string(end),
      { source.path() });
  }

  std::int64_t behind(const Run& run) const noexcept { return run.offset + run.rows * row_bytes; }

  /// Checks the place of the number of values of a run.
  void check_place(std::int64_t at) const
  {
    if (at + count_bytes > entry.end)
    {
      throw IoError("the file changed while it was read: expected all rows up to byte " +
          std::to_string(entry.end) + ", got some of them behind it",
        { source.path() });
    }
  }

  /// The run behind a run; from: the number of its values.
  Run next_run(const Run& run, const char* from) const
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, from, sizeof bits);
    const auto values = static_cast<std::int32_t>(swapped ? __builtin_bswap32(bits) : bits);
    const std::int64_t before = run.first + run.rows;
    const std::int64_t columns = row_bytes / static_cast<std::int64_t>(sizeof(double));
    if (values < 0 || values % columns != 0 || values / columns > entry.rows - before)
    {
      throw IoError("the file changed while it was read: expected a chunk of at most " +
          std::to_string((entry.rows - before) * columns) + " values, got " +
          std::to_string(values),
        { source.path() });
    }
    return { before, values / columns, this->behind(run) + count_bytes };
  }

  /// The run that holds a row. Those before it that nobody has met are passed over.
  Run find_run(std::int64_t row) const
  {
    const std::lock_guard lock(mutex_);
    for (Run run = runs_.back(); run.first + run.rows <= row;)
    {
      const std::int64_t at = this->behind(run);
      this->check_place(at);
      char bytes[count_bytes];
      const std::size_t got = source.read(at, bytes, sizeof bytes);
      if (got < sizeof bytes)
      {
        this->fail_short(at + static_cast<std::int64_t>(got));
      }
      run = this->next_run(run, bytes);
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
  void keep_runs(const std::vector<Run>& runs) const
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

  const ByteSource& source;
  const FrameEntry entry;
  const bool swapped;
  const std::int64_t row_bytes;

private:
  FrameHeader header_;
  mutable std::mutex mutex_;
  mutable std::vector<Run>
    runs_; ///< those that were met, with rows; first the empty one before all
};

BinaryRows::BinaryRows(const ByteSource& of, const FrameEntry& frame)
  : source(of)
  , entry(frame)
  , swapped(binary_layouts()[static_cast<std::size_t>(frame.kind->layout)].swapped)
  , row_bytes(static_cast<std::int64_t>(frame.kind->schema.columns().size() * sizeof(double)))
{
  const BinaryLayout& layout = binary_layouts()[static_cast<std::size_t>(entry.kind->layout)];
  const std::size_t columns = entry.kind->schema.columns().size();
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
  runs_.push_back({ 0, 0, chunks_offset });
}

/// Some rows, all in memory.
class BinaryReader final : public RowReader
{
public:
  explicit BinaryReader(const BinaryRows& of)
    : of_(of)
  {
  }

  void open(std::int64_t first, std::int64_t last) override
  {
    runs_.clear();
    run_ = filled_ = 0;
    decoded_ = 0;
    rows_ = std::max(std::int64_t{ 0 }, last - first);
    if (rows_ == 0)
    {
      return;
    }
    BinaryRows::Run run = of_.find_run(first);
    offset_ = run.offset + (first - run.first) * of_.row_bytes;
    std::int64_t more = run_counts;
    this->fill(std::min(offset_ + rows_ * of_.row_bytes + more, of_.entry.end));
    runs_.push_back(run);
    while (run.first + run.rows < last)
    {
      const std::int64_t at = of_.behind(run);
      of_.check_place(at);
      if (at + count_bytes > offset_ + static_cast<std::int64_t>(filled_))
      {
        this->fill(std::min(at + more, of_.entry.end));
        more *= 2;
      }
      run = of_.next_run(run, buffer_.data() + (at - offset_));
      if (run.rows > 0)
      {
        runs_.push_back(run);
      }
    }
    of_.keep_runs(runs_);
    this->fill(run.offset + (last - run.first) * of_.row_bytes);
    runs_.back().rows = last - run.first;
    runs_.front() = { first, runs_.front().first + runs_.front().rows - first, offset_ };
  }

  std::int64_t rows() const noexcept override { return rows_; }
  bool more() const noexcept override { return decoded_ < rows_; }

  std::int64_t decode(std::span<ColumnSink> sinks, std::int64_t max_rows) override
  {
    std::int64_t done = 0;
    while (done < max_rows && this->more())
    {
      BinaryRows::Run& run = runs_[run_];
      const std::int64_t rows = std::min(max_rows - done, run.rows);
      this->convert(sinks, buffer_.data() + (run.offset - offset_), static_cast<std::size_t>(rows));
      done += rows;
      decoded_ += rows;
      run.rows -= rows;
      run.offset += rows * of_.row_bytes;
      run_ += run.rows == 0 ? 1 : 0;
    }
    return done;
  }

private:
  /// Fills the buffer up to that place of the content.
  void fill(std::int64_t end)
  {
    const std::int64_t from = offset_ + static_cast<std::int64_t>(filled_);
    const auto bytes = static_cast<std::size_t>(std::max(std::int64_t{ 0 }, end - from));
    if (buffer_.size() < filled_ + bytes)
    {
      buffer_.resize(filled_ + bytes + std::size_t{ 2 * run_counts });
    }
    const std::size_t got = of_.source.read(from, buffer_.data() + filled_, bytes);
    if (got < bytes)
    {
      of_.fail_short(from + static_cast<std::int64_t>(got));
    }
    filled_ += bytes;
  }

  const char* convert_column(const char* row, std::size_t rows, ColumnSink& sink) const noexcept
  {
    return convert_columns[place_of(sink.type)][of_.swapped](
      row + sink.column * sizeof(double), static_cast<std::size_t>(of_.row_bytes), rows, sink);
  }

  void convert(std::span<ColumnSink> sinks, const char* from, std::size_t rows) const
  {
    const auto row_bytes = static_cast<std::size_t>(of_.row_bytes);
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
  [[noreturn]] void fail(
    std::span<const ColumnSink> sinks, const char* from, std::size_t rows) const
  {
    Misfits misfits;
    for (const ColumnSink& sink : sinks)
    {
      double number = 0;
      ColumnSink nowhere = { sink.column, sink.type, reinterpret_cast<char*>(&number), 0 };
      if (const char* const value = this->convert_column(from, rows, nowhere))
      {
        char word[32];
        number = of_.swapped ? load<true>(value) : load<false>(value);
        const auto end = std::to_chars(word, word + sizeof word, number).ptr;
        misfits.push_back({ RowStatus::NotExact, static_cast<int>(sink.column),
          std::string(word, end), offset_ + (value - buffer_.data()) });
      }
    }
    std::ranges::sort(misfits, {}, &Misfit::offset);
    throw misfits;
  }

  const BinaryRows& of_;
  std::vector<BinaryRows::Run> runs_; ///< their rows that are left to decode
  std::size_t run_ = 0;               ///< of the next row
  PaddedBuffer buffer_;
  std::size_t filled_ = 0;
  std::int64_t offset_ = 0; ///< of buffer_ in the content
  std::int64_t rows_ = 0;
  std::int64_t decoded_ = 0;
};

std::unique_ptr<RowReader> BinaryRows::reader() const
{
  return std::make_unique<BinaryReader>(*this);
}
}

std::unique_ptr<FrameRows> open_binary_rows(const ByteSource& source, const FrameEntry& entry)
{
  return std::make_unique<BinaryRows>(source, entry);
}
}
