// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/section_rows.h"

#include "granular/common/words.h"
#include "granular/formats/data_file/data_header.h"
#include "granular/formats/data_file/data_text.h"
#include "granular/formats/dump/read/dump_reader.h"
#include "granular/lines/fetch_particles.h"
#include "granular/lines/id_finder.h"
#include "granular/numbers/number.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/point_forms.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <utility>

namespace granular
{
namespace
{
using IdSpan = std::span<const std::int64_t>;

IdSpan ids_of(const Table& frame)
{
  const auto ids = std::ranges::find_if(
    frame.arrays, [](const TableArray& array) { return array.info.name == "id"; });
  return { static_cast<const std::int64_t*>(ids->block.data()),
    static_cast<std::size_t>(frame.rows) };
}

/// Looks at the text again for the first row whose word in a column is wrong. Returns where it is.
Where find_row(const ByteSource& source, const DataSection& section, std::size_t column,
  const std::string& name, const std::function<bool(std::string_view, std::int64_t)>& is_wrong)
{
  const DataText text(source);
  TextScanner scanner(text, section.offset, section.line);
  std::string_view line;
  while (scanner.offset() < section.end && scanner.next(line))
  {
    const std::vector<std::string_view> words = split_words(line.substr(0, line.find('#')));
    if (words.size() > column && is_wrong(words[column], scanner.last_line()))
    {
      Where where = scanner.where();
      where.column = name;
      return where;
    }
  }
  return { source.path(), section.name_line };
}

/// Says which row has the id of an earlier one.
[[noreturn]] void fail_repeated(const ByteSource& source, const DataSection& section)
{
  IdTable lines;
  std::int64_t id = 0;
  const auto repeats = [&](std::string_view word, std::int64_t line)
  {
    return static_cast<bool>(parse_int64(word.data(), word.data() + word.size(), id)) &&
      !lines.add(id, line);
  };
  const Where where = find_row(source, section, 0, "id", repeats);
  throw FormatError("expected one row of each particle in the section " + section.name +
      ", got another one of particle " + std::to_string(id) + "; the first is in line " +
      std::to_string(lines.find(id)),
    where);
}

/// Puts the numbers of types in the place of their labels.
void number_types(Table& table, std::size_t column, const TypeLabels& labels,
  const ByteSource& source, const DataSection& section)
{
  const std::string name = table.schema.columns()[column].name;
  if (TableArray* const types = find_array(table, name))
  {
    std::vector<std::int32_t> numbers;
    for (const std::string& word : types->words)
    {
      std::int64_t number = 0;
      if (!is_type(word, &labels, number) || !std::in_range<std::int32_t>(number))
      {
        throw FormatError("expected a type or its label, got " + quoted(word),
          find_row(source, section, column, name,
            [&](std::string_view other, std::int64_t) { return other == word; }));
      }
      numbers.push_back(static_cast<std::int32_t>(number));
    }
    const auto values = std::span(
      static_cast<std::int32_t*>(types->block.data()), static_cast<std::size_t>(table.rows));
    std::ranges::transform(values, values.begin(),
      [&](std::int32_t word) { return numbers[static_cast<std::size_t>(word)]; });
    types->words.clear();
    types->info.type = ValueType::Int32;
  }
  table.schema.set_type(static_cast<int>(column), ValueType::Int32);
}

/// The arrays of a table but for its ids.
ParticleValues values_of(const Table& table)
{
  static constexpr double none[3] = {};
  ParticleValues values;
  values.points = none; // sections have no places
  values.point_step = 0;
  for (const TableArray& array : table.arrays)
  {
    if (array.info.name != "id")
    {
      values.arrays.push_back(
        view_rows(array.info.name, array.info.type, array.block.data(), array.info.components()));
    }
  }
  return values;
}

/// The values of a particle without a row: a point, as LAMMPS has them beside ellipsoids.
double value_without_row(std::string_view array, std::size_t component) noexcept
{
  return array == "quat" && component == 0 ? 1 : array == "blockiness" ? 2 : 0;
}

template <class Number>
void put_numbers(TableArray& array, std::size_t component, std::span<const double> numbers)
{
  const auto size = static_cast<std::size_t>(array.info.components());
  auto* const to = static_cast<Number*>(array.block.data()) + component;
  for (std::size_t row = 0; row < numbers.size(); ++row)
  {
    to[row * size] = static_cast<Number>(numbers[row]);
  }
}
}

Table read_section(const FramePiece& file, const ByteSource& source, const DataSection& section,
  const ColumnSchema& schema, const TypeLabels* labels, std::string_view type_column,
  const Request& asked, Communicator& ranks, Notices& notices, Progress& progress)
{
  const auto types = std::ranges::find(schema.columns(), type_column, &ColumnInfo::name);
  const auto column = static_cast<std::size_t>(types - schema.columns().begin());
  const bool numbers_types = labels && types != schema.columns().end();
  Request request = asked;
  request.schema = schema;
  if (numbers_types)
  {
    request.schema->set_type(static_cast<int>(column), ValueType::Text);
  }
  FrameKind kind;
  kind.schema = *request.schema;
  kind.layout = FrameKind::bare;
  kind.loose = section.most_words > schema.columns().size();
  if (kind.loose)
  {
    notices.push_back({ { source.path(), section.line },
      "expected " + std::to_string(schema.columns().size()) +
        " words in a row, got more in some rows; the rest of them was ignored" });
  }
  FrameEntry entry = file.entry;
  entry.kind = std::make_shared<const FrameKind>(std::move(kind));
  entry.rows = section.rows;
  entry.offset = section.offset;
  entry.line = section.line;
  entry.end = section.end;
  const DataText text(source, section.has_comments, section.offset);
  Table table = read_dump({ { file.file, entry, &text } }, request, ranks, notices, progress);
  if (numbers_types)
  {
    number_types(table, column, *labels, text, section);
  }
  return table;
}

std::int64_t join_section(Table& particles, const Table& table, const ColumnSchema& schema,
  std::size_t first, const ByteSource& source, const JoinedSection& section,
  const std::shared_ptr<BlockPool>& pool, Communicator& ranks)
{
  const bool alone = ranks.size() == 1;
  const IdSpan wanted = ids_of(particles);
  const ParticleValues own = values_of(table);
  FetchedParticles fetched;
  if (!alone)
  {
    const IdDirectory directory(ids_of(table), nullptr, ranks);
    fetched = fetch_particles(own, directory, distinct_ids(wanted, wanted), ranks);
  }
  const ParticleValues& values = alone ? own : fetched.values;
  const IdFinder finder(alone ? ids_of(table) : IdSpan(fetched.ids));
  std::int64_t repeated = alone ? finder.repeated() : fetched.repeated;
  ranks.sum({ &repeated, 1 });
  if (repeated > 0)
  {
    fail_repeated(source, *section.section);
  }
  std::vector<std::int64_t> places(wanted.size());
  finder.find(wanted, places.data());
  const auto missing = std::ranges::find(places, IdFinder::nowhere);
  if (section.of_all && missing != places.end())
  {
    throw FormatError("expected a row of particle " +
        std::to_string(wanted[static_cast<std::size_t>(missing - places.begin())]) +
        " in the section " + section.section->name + ", got none",
      { source.path(), section.section->name_line });
  }
  std::vector<std::size_t> rows; // of the particles that have a row, and the places of those
  std::vector<std::int64_t> found;
  for (std::size_t row = 0; row < places.size(); ++row)
  {
    if (places[row] != IdFinder::nowhere)
    {
      rows.push_back(row);
      found.push_back(places[row]);
    }
  }
  std::vector<double> some(found.size());
  std::vector<double> all(places.size());
  const std::vector<int> array_of = schema.arrays_of_columns();
  for (const ArrayView& view : values.arrays)
  {
    const auto source_array = static_cast<std::size_t>(table.schema.find_array(view.name));
    const auto column =
      static_cast<std::size_t>(table.schema.arrays()[source_array].columns.front());
    const auto place = static_cast<std::size_t>(array_of[first + column - 1]);
    TableArray array{ schema.arrays()[place], {}, {}, {} };
    const auto size = static_cast<std::size_t>(view.size());
    array.block = Block(size * places.size() * size_of(array.info.type), pool);
    for (std::size_t i = 0; i < size; ++i)
    {
      load_numbers(component_of(view, static_cast<int>(i)), found, some.data());
      std::ranges::fill(all, value_without_row(view.name, i));
      for (std::size_t k = 0; k < rows.size(); ++k)
      {
        all[rows[k]] = some[k];
      }
      (array.info.type == ValueType::Int64      ? put_numbers<std::int64_t>
          : array.info.type == ValueType::Int32 ? put_numbers<std::int32_t>
                                                : put_numbers<double>)(array, i, all);
    }
    particles.arrays.push_back(std::move(array));
  }
  std::ranges::sort(found);
  return std::distance(found.begin(), std::unique(found.begin(), found.end()));
}
}
