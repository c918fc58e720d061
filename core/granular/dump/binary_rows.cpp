// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/binary_rows.h"

#include "granular/dump/binary_dump.h"
#include "granular/dump/binary_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t buffer_bytes = std::size_t{ 1 } << 18;

/// Rows whose columns are converted one after the other: they stay in the nearest cache.
constexpr std::size_t block_bytes = std::size_t{ 1 } << 14;

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

/// By ColumnSink::Kind and byte order. There are no texts in binary files.
constexpr ConvertColumn convert_columns[][2] = {
  { convert_column<std::int32_t, false>, convert_column<std::int32_t, true> },
  { convert_column<std::int64_t, false>, convert_column<std::int64_t, true> },
  { convert_column<double, false>, convert_column<double, true> },
};
}

BinaryRows::BinaryRows(const ByteSource& source, const FrameEntry& entry)
  : source_(source)
  , entry_(entry)
{
  const BinaryLayout& layout = binary_layouts()[static_cast<std::size_t>(entry.kind->layout)];
  const std::size_t columns = entry.kind->schema.columns().size();
  swapped_ = layout.swapped;
  std::vector<std::string> names;
  header_.rows = -1; // what is no header is not the one that was there
  try
  {
    const auto header = read_binary_header(source, entry.offset, layout);
    if (header && static_cast<std::size_t>(header->size_one) == columns)
    {
      header_ = header->frame;
      names = header->columns;
      next_offset_ = header->chunks_offset;
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
        describe_first_row(source, entry.offset, layout),
      where_of(source.path(), entry));
  }
  header_.units = entry.kind->units;
  row_bytes_ = columns * sizeof(double);
  buffer_ = std::make_unique<char[]>(std::max(buffer_bytes, row_bytes_));
}

double BinaryRows::fraction() const noexcept
{
  return entry_.rows > 0 ? static_cast<double>(rows_) / static_cast<double>(entry_.rows) : 1.0;
}

/// Makes sure that bytes are in the buffer behind at_.
void BinaryRows::fill(std::size_t bytes)
{
  if (end_ - at_ >= bytes)
  {
    return;
  }
  std::memmove(buffer_.get(), buffer_.get() + at_, end_ - at_);
  end_ -= at_;
  at_ = 0;
  const std::size_t room = std::max(buffer_bytes, row_bytes_) - end_;
  const auto left = static_cast<std::size_t>(entry_.end - next_offset_);
  const std::size_t got = source_.read(next_offset_, buffer_.get() + end_, std::min(room, left));
  end_ += got;
  next_offset_ += static_cast<std::int64_t>(got);
  if (end_ < bytes)
  {
    throw IoError("the file was shortened while it was read: expected " +
        std::to_string(entry_.end) + " bytes, got " + std::to_string(next_offset_),
      { source_.path() });
  }
}

/// Goes on to the next chunk that has rows.
void BinaryRows::next_chunk()
{
  while (chunk_rows_ == 0)
  {
    std::int32_t n = 0;
    this->fill(sizeof n);
    std::memcpy(&n, buffer_.get() + at_, sizeof n);
    n = swapped_ ? static_cast<std::int32_t>(__builtin_bswap32(static_cast<std::uint32_t>(n))) : n;
    at_ += sizeof n;
    const auto columns = static_cast<std::int32_t>(row_bytes_ / sizeof(double));
    if (n < 0 || n % columns != 0 || n / columns > entry_.rows - rows_)
    {
      throw IoError("the file changed while it was read: expected a chunk of at most " +
          std::to_string((entry_.rows - rows_) * columns) + " values, got " + std::to_string(n),
        { source_.path() });
    }
    chunk_rows_ = n / columns;
  }
}

std::int64_t BinaryRows::decode(std::span<ColumnSink> sinks, std::int64_t max_rows)
{
  if (rows_ == entry_.rows)
  {
    return 0;
  }
  this->next_chunk();
  this->fill(row_bytes_);
  const auto buffered = static_cast<std::int64_t>((end_ - at_) / row_bytes_);
  const std::int64_t rows = std::min({ max_rows, chunk_rows_, buffered });
  this->convert(sinks, rows);
  if (misfit_)
  {
    return 0;
  }
  at_ += static_cast<std::size_t>(rows) * row_bytes_;
  chunk_rows_ -= rows;
  rows_ += rows;
  return rows;
}

void BinaryRows::convert(std::span<ColumnSink> sinks, std::int64_t rows)
{
  const std::size_t block = std::max(std::size_t{ 1 }, block_bytes / row_bytes_);
  const char* from = buffer_.get() + at_;
  for (auto left = static_cast<std::size_t>(rows); left > 0;)
  {
    const std::size_t count = std::min(block, left);
    for (ColumnSink& sink : sinks)
    {
      const ConvertColumn convert_one =
        convert_columns[static_cast<std::size_t>(sink.kind)][swapped_];
      const char* const misfit =
        convert_one(from + sink.column * sizeof(double), row_bytes_, count, sink);
      if (misfit)
      {
        this->set_misfit(sink, misfit);
        return;
      }
    }
    from += count * row_bytes_;
    left -= count;
  }
}

void BinaryRows::set_misfit(const ColumnSink& sink, const char* value)
{
  const double number = swapped_ ? load<true>(value) : load<false>(value);
  char word[32];
  const auto end = std::to_chars(word, word + sizeof word, number).ptr;
  const std::int64_t behind = buffer_.get() + end_ - value;
  misfit_ = Misfit{ static_cast<int>(sink.column), RowStatus::NotExact, std::string(word, end),
    { source_.path(), 0, next_offset_ - behind, entry_.kind->schema.columns()[sink.column].name } };
}
}
