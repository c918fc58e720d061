// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/row_encoder.h"

#include "granular/dump/write/text_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t ahead = RowValues::most_rows; ///< rows that are fetched from memory early
constexpr double most_exact = 9007199254740992.0;    // 2^53

using Column = RowValues::Column;

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

/// Throws for an integer that a double cannot hold.
void check_integers(
  const Column& column, const std::string& name, std::size_t first, std::size_t count)
{
  constexpr auto most = static_cast<std::uint64_t>(most_exact);
  std::uint64_t large = 0; // without a branch for each
  for (std::size_t row = first; row < first + count; ++row)
  {
    large |=
      std::uint64_t{ static_cast<std::uint64_t>(column.at<std::int64_t>(row)) + most > 2 * most };
  }
  for (std::size_t row = first; large != 0 && row < first + count; ++row)
  {
    if (!is_double(column.at<std::int64_t>(row)))
    {
      fail_integer(column.at<std::int64_t>(row), name);
    }
  }
}

/// One column of the rows, a double every `step` bytes.
template <class Number>
void scatter(
  const Column& column, std::size_t first, std::size_t count, char* to, std::size_t step) noexcept
{
  const Number* from = column.from<Number>(first);
  const std::int64_t from_step = column.step;
  for (std::size_t row = 0; row < count; ++row)
  {
    __builtin_prefetch(from + ahead * from_step, 0, 2);
    const auto value = static_cast<double>(*from);
    std::memcpy(to, &value, sizeof value);
    from += from_step;
    to += step;
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
    char* const place = to + i * sizeof(double);
    switch (column.type)
    {
      case ValueType::Int32:
        scatter<std::int32_t>(column, first, count, place, step);
        break;
      case ValueType::Int64:
        check_integers(column, plan.columns[i].name, first, count);
        scatter<std::int64_t>(column, first, count, place, step);
        break;
      default:
        scatter<double>(column, first, count, place, step);
        break;
    }
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
      print_rows(values, plan, has_trailing_blanks(format), to);
    }
    row += static_cast<std::int64_t>(values.rows());
  }
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
