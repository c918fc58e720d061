// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/local/local_reader.h"

#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/lines/line_columns.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t least_rounded = 1'000'000; ///< what %g does not print as it is
constexpr std::string_view end_arrays[] = { "position1", "position2" };

/// The schema of local data, in which columns that hold texts do so, too.
ColumnSchema schema_for(const std::vector<std::string>& names, const ColumnSchema& of_file)
{
  ColumnSchema schema = make_local_schema(names);
  const std::size_t count = std::min(names.size(), of_file.columns().size());
  std::vector<ColumnSchema::TypeChange> texts;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (of_file.columns()[i].type == ValueType::Text && !schema.columns()[i].known)
    {
      texts.push_back({ static_cast<int>(i), ValueType::Text });
    }
  }
  schema.set_types(texts);
  return schema;
}

/// Returns true if no digit of a number is lost where it is printed with six.
bool has_six_digits(std::int64_t id) noexcept
{
  std::uint64_t left = id < 0 ? 0 - static_cast<std::uint64_t>(id) : static_cast<std::uint64_t>(id);
  while (left >= static_cast<std::uint64_t>(least_rounded))
  {
    if (left % 10 != 0)
    {
      return false;
    }
    left /= 10;
  }
  return true;
}

bool is_large(std::int64_t id) noexcept
{
  return id >= least_rounded || id <= -least_rounded;
}

/// Returns the number of words of an array of texts that have an exponent.
std::int64_t count_exponents(const TableArray& array)
{
  std::vector<char> has(array.words.size());
  std::ranges::transform(array.words, has.begin(),
    [](const std::string& word) { return word.find_first_of("eE") != word.npos ? 1 : 0; });
  const std::span words(static_cast<const std::int32_t*>(array.block.data()),
    array.block.bytes() / sizeof(std::int32_t));
  return std::ranges::count_if(
    words, [&](std::int32_t word) { return has[static_cast<std::size_t>(word)] != 0; });
}

/// Returns the number of ids of a part that were printed with an exponent. Only where all that have more than six digits end in zeros
/// is the text looked at again.
std::int64_t count_rounded(const std::vector<FramePiece>& pieces, const Request& request,
  Table& frame, bool together, Progress& progress)
{
  constexpr std::string_view ids[] = { "id1", "id2" };
  bool any = false;
  for (const std::string_view name : ids)
  {
    const TableArray* array = find_array(frame, name);
    for (const std::int64_t id : values_in<std::int64_t>(array))
    {
      if (is_large(id) && !has_six_digits(id))
      {
        return 0;
      }
      any = any || is_large(id);
    }
  }
  if (!any)
  {
    return 0;
  }
  Request texts = request;
  texts.ranges = false;
  texts.wanted = [&](std::string_view name, bool is_usual)
  { return std::ranges::find(ids, name) != std::end(ids) && request.wanted(name, is_usual); };
  for (const int end : { 0, 1 })
  {
    const int column = request.schema->find(ColumnRole::Id, end);
    if (column >= 0)
    {
      texts.schema->set_type(column, ValueType::Text);
    }
  }
  const DumpPart part = decode_dump(pieces, texts, together, progress);
  std::int64_t count = 0;
  for (const TableArray& array : part.frame.arrays)
  {
    count += count_exponents(array);
  }
  return count;
}

/// Throws where a column cannot be what it is taken for.
void check_flags(const TableArray* periodic, const Where& where)
{
  const auto check = [&](auto flags)
  {
    const auto other =
      std::ranges::find_if(flags, [](auto flag) { return flag != 0 && flag != 1; });
    if (other != flags.end())
    {
      throw FormatError(
        "expected the flags 0 and 1 in the column that is taken for periodic, got " +
          to_text(static_cast<double>(*other)) +
          ": bonds have their type there, contacts with walls a particle (wall_id in ColumnMap)",
        where);
    }
  };
  check(values_in<std::int32_t>(periodic));
  check(values_in<double>(periodic)); // where one is no integer
}

/// Returns true for an array that a user sees.
bool is_shown(const Request& request, std::string_view name)
{
  return is_wanted(request.wanted, name, !is_end_array(name));
}

Request table_request(const Request& request, const ColumnSchema& schema)
{
  Request table;
  table.points = false;
  table.schema = schema;
  table.ranges = true;
  table.piece = request.piece;
  table.pieces = request.pieces;
  table.threads = request.threads;
  table.pool = request.pool;
  table.wanted = [&](std::string_view name, bool)
  { return is_end_array(name) || name == "periodic" || is_shown(request, name); };
  return table;
}

/// The rows of the parts before one that is read alone, of which nothing else is known.
std::int64_t count_rows_before(
  const std::vector<FramePiece>& pieces, const Request& request, Progress& progress)
{
  Request before = request;
  before.ranges = false;
  before.wanted = [](std::string_view, bool) { return false; };
  std::int64_t rows = 0;
  for (before.piece = 0; before.piece < request.piece; ++before.piece)
  {
    rows += decode_dump(pieces, before, false, progress).frame.rows;
  }
  return rows;
}

/// Leaves out what was only needed on the way.
void drop_unwanted(const Request& request, Table& frame)
{
  const auto wanted = [&](std::string_view name, bool) { return is_shown(request, name); };
  std::erase_if(
    frame.arrays, [&](const TableArray& array) { return !is_wanted(wanted, array.info); });
}

/// Says how many ids were rounded, and how many of all rows have another length than the file says.
void note_rows(
  std::int64_t rows, std::int64_t rounded, std::int64_t misfits, Where where, Notices& notices)
{
  if (rounded > 0)
  {
    where.column = "id1 and id2";
    notices.push_back({ where,
      std::to_string(rounded) +
        " ids are printed with an exponent and have lost the digits beyond six: lines of them "
        "end at wrong particles. In the input script, dump_modify with format float %.15g, or "
        "\"%.15g\" for each column, keeps them" });
  }
  if (misfits > 0)
  {
    where.column = "dist";
    notices.push_back({ where,
      std::to_string(misfits) + " of " + std::to_string(rows) +
        " lines are not as long as the column dist says" });
  }
}
}

bool is_end_array(std::string_view name) noexcept
{
  return std::ranges::find(end_arrays, name) != std::end(end_arrays);
}

LocalSample read_sample(const RunIndex& index, const FrameKind& kind, Progress& progress)
{
  constexpr std::int64_t most_rows = 100'000;
  std::size_t best = 0;
  std::int64_t rows = 0;
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    std::int64_t there = 0;
    for (const FramePiece& piece : index.pieces(frame))
    {
      there += piece.entry.kind->schema == kind.schema ? piece.entry.rows : 0;
    }
    best = there > rows ? frame : best;
    rows = std::max(rows, there);
  }
  LocalSample sample;
  if (rows == 0)
  {
    return sample;
  }
  Request request;
  request.points = false;
  const std::vector<std::string> names = numbered_columns(kind.schema.columns().size());
  request.schema = ColumnSchema(names);
  request.pieces = static_cast<int>((rows + most_rows - 1) / most_rows);
  const DumpPart part = decode_dump(index.pieces(best), request, false, progress);
  const auto is_number = [](const TableArray& array) { return holds<double>(array, 1); };
  if (!part.misfits.empty() || part.frame.arrays.size() != names.size() ||
    !std::ranges::all_of(part.frame.arrays, is_number))
  {
    return sample; // words among the numbers, perhaps of one piece: names must say what is what
  }
  sample.rows = static_cast<std::size_t>(part.frame.rows);
  sample.values.resize(sample.rows * names.size());
  sample.box = part.frame.header.box;
  sample.has_box = part.frame.header.has_box;
  for (std::size_t column = 0; column < names.size(); ++column)
  {
    const auto from = values_in<double>(&part.frame.arrays[column]);
    for (std::size_t row = 0; row < sample.rows; ++row)
    {
      sample.values[row * names.size() + column] = from[row];
    }
  }
  return sample;
}

Table read_local(const std::vector<FramePiece>& pieces, const std::vector<std::string>& columns,
  const Request& request, Communicator& ranks, Notices& notices, Progress& progress)
{
  SharedProgress shared(progress, ranks);
  PartialProgress forward(shared);
  return do_together(ranks,
    [&]
    {
      const FramePiece& piece = pieces.front();
      const ColumnSchema schema = schema_for(columns, piece.entry.kind->schema);
      const Request table = table_request(request, schema);
      const Where where = where_of(piece);
      forward.set_part(0, 0.8);
      Table frame = read_dump(pieces, table, ranks, notices, forward);
      frame.has_lines = has_ends(schema);
      const bool is_bare = piece.entry.kind->layout == FrameKind::bare; // no header says it
      frame.header.counted = is_bare ? "ENTRIES" : frame.header.counted;
      check_flags(find_array(frame, "periodic"), where);
      forward.set_part(0.8, 0.9);
      if (frame.has_lines && request.periodic_lines == PeriodicLines::Split && ranks.size() == 1)
      {
        frame.first_row = count_rows_before(pieces, table, forward);
      }
      forward.set_part(0.9, 1);
      std::array<std::int64_t, 3> sums = { frame.rows, 0, 0 };
      sums[1] = count_rounded(pieces, table, frame, ranks.size() > 1, forward);
      if (frame.has_lines)
      {
        const auto first = values_in<double>(find_array(frame, end_arrays[0]), 3);
        const auto second = values_in<double>(find_array(frame, end_arrays[1]), 3);
        frame.lines = make_lines(first, second, frame.header.box, request, forward);
        const bool as_written = request.periodic_lines == PeriodicLines::AsWritten;
        const std::span lengths(
          static_cast<const double*>(frame.lines.lengths.data()), first.size() / 3);
        const auto dist = values_in<double>(find_array(frame, "dist"));
        sums[2] = as_written ? 0 : count_misfits(lengths, dist, first, second);
      }
      drop_unwanted(request, frame);
      const std::vector<std::int64_t> rows = gather(ranks, frame.rows);
      frame.first_row = std::accumulate(rows.begin(), rows.begin() + ranks.rank(), frame.first_row);
      ranks.sum(sums);
      note_rows(sums[0], sums[1], sums[2], where, notices);
      return frame;
    });
}
}
