// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/text_rows.h"

#include "granular/common/words.h"
#include "granular/numbers/number_cells.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace granular
{
namespace
{
using Column = RowValues::Column;

constexpr std::size_t most_cells =
  256; ///< at a time: they stay in the nearest cache, and on any stack

/// Numbers as text, row by row. Columns are printed one after the other, which is faster than rows, and then joined.
struct Cells
{
  static constexpr std::uint8_t long_text = 255; ///< instead of a length: the cell holds a LongText
  static constexpr std::size_t half = most_number_chars / 2;

  struct LongText
  {
    const std::string* text;
    std::array<char, 2> end;
    std::uint8_t end_chars;
  };

  std::array<char, most_cells * most_number_chars> text;
  std::array<std::uint8_t, most_cells> lengths;

  void put_texts(const Column& column, std::size_t first, std::size_t count, const NumberCells& to);
  char* join(std::size_t count, char* to) const noexcept;
};

void Cells::put_texts(
  const Column& column, std::size_t first, std::size_t count, const NumberCells& to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const LongText word{ column.texts[first + i], to.end, to.end_chars };
    std::memcpy(to.text + i * to.step * most_number_chars, &word, sizeof word);
    to.lengths[i * to.step] = long_text;
  }
}

/// Writes the cells one behind the other. Each moves a fixed number of bytes: what is too much is written over.
char* Cells::join(std::size_t count, char* to) const noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const char* const cell = text.data() + i * most_number_chars;
    const std::size_t length = lengths[i];
    if (length == long_text)
    {
      LongText word;
      std::memcpy(&word, cell, sizeof word);
      to = std::copy(word.text->begin(), word.text->end(), to);
      std::memcpy(to, word.end.data(), word.end.size());
      to += word.end_chars;
      continue;
    }
    std::memcpy(to, cell, half);
    if (length > half)
    {
      std::memcpy(to + half, cell + half, half);
    }
    to += length;
  }
  return to;
}

void print_column(Cells& cells, const Column& column, NumberFormat format, std::size_t first,
  std::size_t count, const NumberCells& to)
{
  switch (column.type)
  {
    case ValueType::Int32:
      print_integers(column.from<std::int32_t>(first), column.step, count, to);
      break;
    case ValueType::Int64:
      print_integers(column.from<std::int64_t>(first), column.step, count, to);
      break;
    case ValueType::Float64:
      print_numbers(column.from<double>(first), column.step, count, format, column.whole, to);
      break;
    default:
      cells.put_texts(column, first, count, to);
      break;
  }
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

/// Room that rows can need.
std::size_t most_bytes(std::span<const Column> columns, std::size_t rows)
{
  std::size_t bytes = (rows * columns.size() + 1) * most_number_chars;
  for (const Column& column : columns)
  {
    for (std::size_t row = 0; column.type == ValueType::Text && row < rows; ++row)
    {
      bytes += column.texts[row]->size();
    }
  }
  return bytes;
}
}

void print_rows(const RowValues& values, const ColumnPlan& plan, bool trailing_blank, RowBuffer& to)
{
  const std::span<const Column> columns = values.columns();
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (columns[i].type == ValueType::Text)
    {
      check_texts(columns[i], plan.columns[i].name);
    }
  }
  char* const begin = to.room(most_bytes(columns, values.rows()));
  char* end = begin;
  Cells cells;
  // several rows, or a part of one
  const std::size_t width = std::min(columns.size(), most_cells);
  const std::size_t height =
    width < columns.size() ? 1 : most_cells / std::max(width, std::size_t{ 1 });
  for (std::size_t row = 0; row < values.rows(); row += height)
  {
    const std::size_t rows = std::min(height, values.rows() - row);
    for (std::size_t first = 0; first < columns.size(); first += width)
    {
      const std::size_t count = std::min(width, columns.size() - first);
      for (std::size_t i = 0; i < count; ++i)
      {
        const bool last = first + i + 1 == columns.size();
        const bool both = last && trailing_blank;
        print_column(cells, columns[first + i], plan.columns[first + i].numbers, row, rows,
          { cells.text.data() + i * most_number_chars, cells.lengths.data() + i, count,
            { last && !both ? '\n' : ' ', '\n' }, static_cast<std::uint8_t>(both ? 2 : 1) });
      }
      end = cells.join(rows * count, end);
    }
  }
  to.add(static_cast<std::size_t>(end - begin));
}
}
