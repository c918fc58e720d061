// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/row_batches.h"

#include "granular/common/words.h"
#include "granular/numbers/number_print.h"

#include <array>
#include <cstring>
#include <iterator>

namespace granular
{
namespace
{
using Column = RowValues::Column;

constexpr std::int64_t chunk_values = std::int64_t{ 1 } << 15; ///< some 300 KB of text or binary
constexpr std::size_t chunks_per_thread = 4;
constexpr std::size_t most_chunks = 32;              ///< in a batch, for the memory that they take
constexpr std::int64_t ahead = RowValues::most_rows; ///< rows that are fetched from memory early

/// Throws for an integer that a double cannot hold.
void check_integers(
  const Column& column, const std::string& name, std::size_t first, std::size_t count)
{
  for (std::size_t row = first; row < first + count; ++row)
  {
    const auto value = column.at<std::int64_t>(row);
    const auto real = static_cast<double>(value);
    if (!(real < 0x1p63 && static_cast<std::int64_t>(real) == value))
    {
      throw LimitError(
        "expected integers that a double can hold, as all up to 2^53, for a binary dump, got " +
          std::to_string(value),
        { .column = name });
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

/// Stores rows [first, first + count) as the doubles of a binary dump, row by row. Throws LimitError for integers that are not
/// doubles.
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

/// Uncompressed bytes in a member of a gzip file or a frame of a Zstandard file.
constexpr std::size_t member_bytes = std::size_t{ 1 } << 20;

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

  char* join(std::size_t count, char* to) const noexcept;
};

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

void print_column(const Column& column, NumberFormat format, std::size_t first, std::size_t count,
  const NumberCells& to)
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
      for (std::size_t i = 0; i < count; ++i)
      {
        const Cells::LongText word{ column.texts[first + i], to.end, to.end_chars };
        std::memcpy(to.text + i * to.step * most_number_chars, &word, sizeof word);
        to.lengths[i * to.step] = Cells::long_text;
      }
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

/// Adds rows as lines of text, with a blank between columns, and one at the end of each line if trailing_blank. Throws
/// FormatError for a text that is not one word.
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
        print_column(columns[first + i], plan.columns[first + i].numbers, row, rows,
          { cells.text.data() + i * most_number_chars, cells.lengths.data() + i, count,
            { last && !both ? '\n' : ' ', '\n' }, static_cast<std::uint8_t>(both ? 2 : 1) });
      }
      end = cells.join(rows * count, end);
    }
  }
  to.add(static_cast<std::size_t>(end - begin));
}
}

void FileAppender::append(std::string_view bytes)
{
  if (this->is_plain())
  {
    this->write_at(this->take(bytes.size()), bytes);
    return;
  }
  constexpr int most_members = 16; // at a time, for the memory that they take
  const std::size_t most =
    member_bytes * static_cast<std::size_t>(std::min(executor_.threads(), most_members));
  while (!bytes.empty())
  {
    const std::size_t part = std::min(bytes.size(), most - pending_.size());
    pending_ += bytes.substr(0, part);
    bytes.remove_prefix(part);
    if (pending_.size() == most)
    {
      this->end_part();
    }
  }
}

void FileAppender::end_part()
{
  const std::string_view pending = pending_;
  std::vector<std::string> members((pending.size() + member_bytes - 1) / member_bytes);
  Progress silent;
  executor_.parallel_for(
    members.size(),
    [&](std::size_t i, std::size_t)
    { members[i] = compress(pending.substr(i * member_bytes, member_bytes), compression_); },
    silent);
  for (const std::string& member : members)
  {
    this->write_at(this->take(member.size()), member);
  }
  pending_.clear();
}

std::int64_t count_kept(const FrameView& frame, std::int64_t first, std::int64_t end) noexcept
{
  return !frame.ghosts
    ? end - first
    : std::count_if(frame.ghosts + first, frame.ghosts + end,
        [](unsigned char ghost) { return (ghost & FrameView::duplicate_row) == 0; });
}

RowBatches::RowBatches(const RowsToEncode& rows, const Executor& executor)
  : of_(rows)
  , executor_(executor)
  , chunk_rows_(std::max<std::int64_t>(
      16, chunk_values / std::max<std::int64_t>(1, std::ssize(rows.plan.columns))))
  , chunks_(static_cast<std::size_t>((rows.frame.rows + chunk_rows_ - 1) / chunk_rows_))
{
  const auto threads = static_cast<std::size_t>(executor.threads());
  const std::size_t in_batch =
    std::min({ chunks_, threads * chunks_per_thread, std::max(most_chunks, threads) });
  buffers_.resize(in_batch);
  values_.resize(executor.workers(in_batch));
  losses_.resize(values_.size());
  const FrameView& frame = rows.frame;
  std::int64_t kept = 0;
  for (std::size_t chunk = 0; frame.ghosts && chunk < chunks_; ++chunk)
  {
    kept_before_.push_back(kept);
    const std::int64_t first = static_cast<std::int64_t>(chunk) * chunk_rows_;
    kept += count_kept(frame, first, std::min(first + chunk_rows_, frame.rows));
  }
}

void RowBatches::encode(std::size_t chunk, std::size_t worker, RowBuffer& to)
{
  constexpr auto most = static_cast<std::int64_t>(RowValues::most_rows);
  const std::int64_t begin = static_cast<std::int64_t>(chunk) * chunk_rows_;
  const std::int64_t end = std::min(begin + chunk_rows_, of_.frame.rows);
  std::int64_t kept = kept_before_.empty() ? begin : kept_before_[chunk];
  RowValues& values = values_[worker];
  to.clear();
  for (std::int64_t first = begin; first < end; first += most)
  {
    values.load(
      of_.frame, of_.plan, of_.box, first, std::min(most, end - first), of_.first_row + kept);
    of_.print_loss.measure(values, losses_[worker]);
    if (of_.format.binary)
    {
      this->encode_binary(values, of_.first_in_file + kept, to);
    }
    else
    {
      print_rows(values, of_.plan, has_trailing_blanks(of_.format), to);
    }
    kept += static_cast<std::int64_t>(values.rows());
  }
}

/// Rows up to the next chunk of the file at a time, whose length stands before it.
void RowBatches::encode_binary(const RowValues& values, std::int64_t in_file, RowBuffer& to) const
{
  const ChunkLengths& chunks = of_.chunks;
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
    const auto part = static_cast<std::size_t>(std::min(left, rows - done));
    pack_rows(values, of_.plan, static_cast<std::size_t>(done), part, to.room(part * row_bytes));
    to.add(part * row_bytes);
    done += static_cast<std::int64_t>(part);
  }
}

void RowBatches::write_to(FileAppender& file, Progress& progress)
{
  Turns turns;
  executor_.parallel_for(
    chunks_,
    [&](std::size_t chunk, std::size_t worker)
    {
      Turn turn(turns, chunk);
      this->encode(chunk, worker, buffers_[worker]);
      turn.wait();
      const std::string_view bytes = buffers_[worker].bytes();
      const std::int64_t offset = file.take(bytes.size());
      turn.pass();
      file.write_at(offset, bytes);
    },
    progress);
}

bool RowBatches::next(Progress& progress)
{
  filled_ = std::min(buffers_.size(), chunks_ - place_);
  if (filled_ == 0)
  {
    return false;
  }
  PartialProgress part(progress);
  part.set_part(static_cast<double>(place_) / static_cast<double>(chunks_),
    static_cast<double>(place_ + filled_) / static_cast<double>(chunks_));
  executor_.parallel_for(
    filled_,
    [&](std::size_t i, std::size_t worker) { this->encode(place_ + i, worker, buffers_[i]); },
    part);
  place_ += filled_;
  return true;
}

RoundingLoss RowBatches::loss() const
{
  RoundingLoss all;
  std::for_each(losses_.begin(), losses_.end(), [&](const RoundingLoss& loss) { all.add(loss); });
  return all;
}

std::vector<std::string_view> RowBatches::bytes() const
{
  std::vector<std::string_view> bytes;
  std::transform(buffers_.begin(), buffers_.begin() + static_cast<std::ptrdiff_t>(filled_),
    std::back_inserter(bytes), [](const RowBuffer& buffer) { return buffer.bytes(); });
  return bytes;
}
}
