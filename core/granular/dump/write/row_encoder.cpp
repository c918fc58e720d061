// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/row_encoder.h"

#include "granular/common/words.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace granular
{
namespace
{
constexpr double most_exact = 9007199254740992.0; // 2^53

using Column = RowValues::Column;

/// Room that rows of text can need.
std::size_t most_text_bytes(std::span<const Column> columns, std::size_t rows)
{
  std::size_t bytes = rows * (columns.size() * (most_number_chars + 1) + 2);
  for (const Column& column : columns)
  {
    for (std::size_t row = 0; column.type == ValueType::Text && row < rows; ++row)
    {
      bytes += column.texts[row]->size();
    }
  }
  return bytes;
}

/// A text that would not be one word when it is read again has no place in a dump.
void check_texts(const Column& column, const std::string& name)
{
  for (const std::string* text : column.texts)
  {
    if (text->empty() || std::any_of(text->begin(), text->end(), is_blank))
    {
      throw FormatError("expected a word, got '" + *text + "'", { .column = name });
    }
  }
}

[[gnu::always_inline]] inline char* print_value(
  char* to, const Column& column, std::size_t row, NumberFormat format)
{
  if (column.type == ValueType::Int64)
  {
    return print_integer(to, column.integers[row]);
  }
  if (column.type == ValueType::Text)
  {
    const std::string& text = *column.texts[row];
    return std::copy(text.begin(), text.end(), to);
  }
  const double value = column.reals[row];
  if (column.whole && std::abs(value) < most_exact && std::trunc(value) == value)
  {
    return print_integer(to, static_cast<std::int64_t>(value));
  }
  return print_number(to, value, format);
}

[[noreturn]] void fail_integer(std::int64_t value, const std::string& name)
{
  throw LimitError(
    "expected integers that a double can hold, as all up to 2^53, for a binary dump, got " +
      std::to_string(value),
    { .column = name });
}

bool is_double(std::int64_t value) noexcept
{
  const auto real = static_cast<double>(value);
  return real < 0x1p63 && static_cast<std::int64_t>(real) == value;
}

/// One column of the rows, a double every `step` bytes.
template <class Value>
void scatter(const Value* from, std::size_t count, char* to, std::size_t step) noexcept
{
  for (std::size_t row = 0; row < count; ++row)
  {
    const auto value = static_cast<double>(from[row]);
    std::memcpy(to + row * step, &value, sizeof value);
  }
}
}

void pack_rows(
  const RowValues& values, const ColumnPlan& plan, std::size_t first, std::size_t count, char* to)
{
  const std::span<const Column> columns = values.columns();
  const std::size_t step = columns.size() * sizeof(double);
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const Column& column = columns[i];
    if (column.type != ValueType::Int64)
    {
      scatter(column.reals.data() + first, count, to + i * sizeof(double), step);
      continue;
    }
    const std::int64_t* integers = column.integers.data() + first;
    const auto* const bad = std::find_if_not(integers, integers + count, is_double);
    if (bad != integers + count)
    {
      fail_integer(*bad, plan.columns[i].name);
    }
    scatter(integers, count, to + i * sizeof(double), step);
  }
}

void RowEncoder::encode(std::int64_t first, std::int64_t count, std::int64_t kept_before,
  RowValues& values, RowBuffer& to, RoundingLoss& loss) const
{
  std::int64_t row = first_row + kept_before;
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  for (std::int64_t done = 0; done < count; done += most)
  {
    values.load(frame, plan, box, first + done, std::min(most, count - done), row);
    print_loss.measure(values, loss);
    if (format.binary)
    {
      this->encode_binary(values, row - first_row + first_in_file, to);
    }
    else
    {
      this->encode_text(values, to);
    }
    row += static_cast<std::int64_t>(values.rows());
  }
}

void RowEncoder::encode_text(const RowValues& values, RowBuffer& to) const
{
  const std::span<const Column> columns = values.columns();
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (columns[i].type == ValueType::Text)
    {
      check_texts(columns[i], plan.columns[i].name);
    }
  }
  const bool trailing_blank = has_trailing_blanks(format);
  char* const begin = to.room(most_text_bytes(columns, values.rows()));
  char* end = begin;
  for (std::size_t row = 0; row < values.rows(); ++row)
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      end = print_value(end, columns[i], row, plan.columns[i].numbers);
      *end++ = ' ';
    }
    end -= trailing_blank ? 0 : 1;
    *end++ = '\n';
  }
  to.add(static_cast<std::size_t>(end - begin));
}

/// Rows up to the next chunk at a time, whose length stands before it.
void RowEncoder::encode_binary(const RowValues& values, std::int64_t in_file, RowBuffer& to) const
{
  const std::size_t row_bytes = values.columns().size() * sizeof(double);
  const auto rows = static_cast<std::int64_t>(values.rows());
  for (std::int64_t done = 0; done < rows;)
  {
    const std::int64_t row = in_file + done;
    if (chunks.begins(row))
    {
      const std::int32_t length = chunks.values(row);
      std::memcpy(to.room(sizeof length), &length, sizeof length);
      to.add(sizeof length);
    }
    const std::int64_t left = chunks.rows_per_chunk() - row % chunks.rows_per_chunk();
    const std::int64_t part = std::min(left, rows - done);
    const std::size_t bytes = static_cast<std::size_t>(part) * row_bytes;
    pack_rows(
      values, plan, static_cast<std::size_t>(done), static_cast<std::size_t>(part), to.room(bytes));
    to.add(bytes);
    done += part;
  }
}
}
