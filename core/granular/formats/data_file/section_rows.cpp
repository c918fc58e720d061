// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/section_rows.h"

#include "granular/common/words.h"
#include "granular/formats/dump/read/dump_reader.h"
#include "granular/lines/fetch_particles.h"
#include "granular/lines/id_finder.h"
#include "granular/numbers/number.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/point_forms.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
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

/// Says which row has the id of an earlier one: the text is looked at again.
[[noreturn]] void fail_repeated(const ByteSource& source, const ParticleSection& section)
{
  const std::string wanted =
    "expected one row of each particle in the section " + std::string(section.name) + ", got ";
  TextScanner scanner(source, section.rows.offset, section.rows.line);
  IdTable lines;
  std::string_view line;
  while (scanner.offset() < section.rows.end && scanner.next(line))
  {
    const std::string_view word = take_word(line);
    std::int64_t id = 0;
    if (parse_int64(word.data(), word.data() + word.size(), id) &&
      !lines.add(id, scanner.last_line()))
    {
      Where where = scanner.where();
      where.column = "id";
      throw FormatError(wanted + "another one of particle " + std::to_string(id) +
          "; the first is in line " + std::to_string(lines.find(id)),
        where);
    }
  }
  throw FormatError(wanted + "several", { source.path(), section.rows.name_line });
}

/// The array of the table that is fetched as the places of particles are otherwise.
const TableArray& vector_of(const Table& table)
{
  return *std::ranges::find_if(
    table.arrays, [](const TableArray& array) { return array.info.components() == 3; });
}

/// The values of the table, one vector of which is where the places of particles are otherwise.
ParticleValues values_of(const Table& table)
{
  const TableArray& vector = vector_of(table);
  ParticleValues values;
  values.points = static_cast<const double*>(vector.block.data());
  for (const TableArray& array : table.arrays)
  {
    if (array.info.name != "id" && &array != &vector)
    {
      values.arrays.push_back(view_rows(
        array.info.name, ValueType::Float64, array.block.data(), array.info.components()));
    }
  }
  return values;
}

/// The values of a particle without a row: a point, as LAMMPS has them beside ellipsoids.
double value_without_row(std::string_view array, std::size_t component) noexcept
{
  return array == "quat" && component == 0 ? 1 : array == "blockiness" ? 2 : 0;
}

/// A byte source in which each comment, from # to the end of the line, is blank. The underlying source must outlive it.
class Uncommented final : public ByteSource
{
public:
  /// begin: the start of a line; no byte before it is read.
  Uncommented(const ByteSource& source, std::int64_t begin)
    : source_(source)
    , begin_(begin)
  {
  }

  const std::string& path() const override { return source_.path(); }
  FileStamp stamp() const override { return source_.stamp(); }
  double fraction(std::int64_t offset) const override { return source_.fraction(offset); }
  bool compressed() const override { return source_.compressed(); }
  bool concurrent() const override { return source_.concurrent(); }
  std::string unchecked() const override { return source_.unchecked(); }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    const bool begins_inside = this->is_comment(offset);
    const std::size_t got = source_.read(offset, buffer, bytes);
    char* const end = buffer + got;
    for (char* at = begins_inside ? buffer : std::find(buffer, end, '#'); at != end;
         at = std::find(at, end, '#'))
    {
      while (at != end && *at != '\n')
      {
        *at++ = ' ';
      }
    }
    return got;
  }

private:
  /// Returns true if the line up to a byte has begun a comment.
  bool is_comment(std::int64_t offset) const
  {
    std::string before;
    for (std::int64_t bytes = 256; offset > begin_; bytes *= 2)
    {
      const std::int64_t from = std::max(begin_, offset - bytes);
      before.resize(static_cast<std::size_t>(offset - from));
      before.resize(source_.read(from, before.data(), before.size()));
      const std::size_t feed = before.rfind('\n');
      if (feed != before.npos || from == begin_)
      {
        return before.find('#', feed == before.npos ? 0 : feed) != before.npos;
      }
    }
    return false;
  }

  const ByteSource& source_;
  std::int64_t begin_;
};
}

Table read_section(const FramePiece& file, const ByteSource& source, const DataSection& section,
  const std::vector<std::string>& columns, const Request& request, Communicator& ranks,
  Notices& notices, Progress& progress)
{
  FrameKind kind;
  kind.schema = ColumnSchema(columns);
  kind.layout = FrameKind::bare;
  FrameEntry entry = file.entry;
  entry.kind = std::make_shared<const FrameKind>(std::move(kind));
  entry.rows = section.rows;
  entry.offset = section.offset;
  entry.line = section.line;
  entry.end = section.end;
  const Uncommented uncommented(source, section.offset);
  const ByteSource* const rows = section.has_comments ? &uncommented : &source;
  return read_dump({ { file.file, entry, rows } }, request, ranks, notices, progress);
}

std::int64_t join_section(Table& particles, const Table& table, const ColumnSchema& schema,
  const ByteSource& source, const ParticleSection& section, const std::shared_ptr<BlockPool>& pool,
  Communicator& ranks)
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
    fail_repeated(source, section);
  }
  std::vector<std::int64_t> places(wanted.size());
  finder.find(wanted, places.data());
  const auto missing = std::ranges::find(places, IdFinder::nowhere);
  if (section.of_all && missing != places.end())
  {
    throw FormatError("expected a row of particle " +
        std::to_string(wanted[static_cast<std::size_t>(missing - places.begin())]) +
        " in the section " + std::string(section.name) + ", got none",
      { source.path(), section.rows.name_line });
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
  std::vector<ArrayView> views = values.arrays;
  views.insert(
    views.begin(), view_rows(vector_of(table).info.name, ValueType::Float64, values.points, 3));
  views.front().step = values.point_step;
  std::vector<double> numbers(found.size());
  for (const ArrayView& view : views)
  {
    const auto size = static_cast<std::size_t>(view.size());
    TableArray array{ schema.arrays()[static_cast<std::size_t>(schema.find_array(view.name))], {},
      {}, {} };
    array.block = Block(size * places.size() * sizeof(double), pool);
    for (std::size_t i = 0; i < size; ++i)
    {
      load_numbers(component_of(view, static_cast<int>(i)), found, numbers.data());
      auto* const to = static_cast<double*>(array.block.data()) + i;
      for (std::size_t row = 0; found.size() < places.size() && row < places.size(); ++row)
      {
        to[row * size] = value_without_row(view.name, i);
      }
      for (std::size_t k = 0; k < rows.size(); ++k)
      {
        to[rows[k] * size] = numbers[k];
      }
    }
    particles.arrays.push_back(std::move(array));
  }
  std::ranges::sort(found);
  return std::distance(found.begin(), std::unique(found.begin(), found.end()));
}
}
