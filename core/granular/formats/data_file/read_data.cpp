// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/read_data.h"

#include "granular/common/shares.h"
#include "granular/formats/data_file/data_file.h"
#include "granular/formats/data_file/section_rows.h"
#include "granular/geometry/box.h"
#include "granular/lines/join.h"
#include "granular/lines/line_columns.h"
#include "granular/lines/lines.h"
#include "granular/parallel/trade.h"
#include "granular/particles/table.h"
#include "granular/sorting/sort_rows.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
const std::vector<std::string> bond_columns = { "bond_id", "btype", "id1", "id2" };

/// The columns of all, with the types that those of the particles have come to be.
ColumnSchema join_schemas(const DataColumns& columns, const ColumnSchema& particles)
{
  ColumnSchema schema = make_particle_schema(columns);
  std::vector<ColumnSchema::TypeChange> changes;
  for (std::size_t i = 0; i < particles.columns().size(); ++i)
  {
    if (particles.columns()[i].type != schema.columns()[i].type)
    {
      changes.push_back({ static_cast<int>(i), particles.columns()[i].type });
    }
  }
  schema.set_types(changes);
  return schema;
}

/// Leaves lines of which both ends were found.
void keep_found(Table& table, const JoinedLines& joined)
{
  for (TableArray& array : table.arrays)
  {
    const std::size_t bytes = size_of(array.info.type);
    auto* const data = static_cast<char*>(array.block.data());
    for (std::size_t i = 0; i < joined.rows.size(); ++i)
    {
      std::memmove(
        data + i * bytes, data + static_cast<std::size_t>(joined.rows[i]) * bytes, bytes);
    }
  }
  keep_rows(table, 0, joined.count);
}

/// Reads one data file, by one rank or by all.
class DataReader
{
public:
  DataReader(const FramePiece& file, const DataOptions& options, const Request& request,
    Communicator& ranks, Notices& notices, Progress& progress)
    : file_(file)
    , options_(options)
    , request_(request)
    , ranks_(ranks)
    , notices_(notices)
    , progress_(progress)
    , source_(open_piece(file))
  {
  }

  Tables read()
  {
    progress_.set_part(0, 0.1);
    layout_ = find_data_layout(file_.file, *source_, progress_);
    if (layout_->timestep != file_.entry.timestep || layout_->atoms != file_.entry.rows)
    {
      throw IoError("the file was changed after it was indexed", where_of(file_));
    }
    columns_ = find_data_columns(*layout_, options_.atom_style, source_->path(), notices_);
    own_ = request_;
    own_.single_precision = false;
    own_.points = true; // bonds end there
    if (ranks_.size() == 1)
    {
      own_.piece = 0; // of all: velocities and bonds may name any particle
      own_.pieces = 1;
      own_.ranges = own_.ranges && request_.pieces == 1;
    }
    Tables frame;
    this->read_particles(frame.rows);
    this->read_bonds(frame);
    this->keep_piece(frame.rows);
    frame.rows.points = request_.points ? std::move(frame.rows.points) : Block();
    return frame;
  }

private:
  FrameHeader header() const
  {
    FrameHeader header;
    header.timestep = layout_->timestep;
    header.units = layout_->units;
    header.box = layout_->box;
    header.box.boundary = options_.boundary.empty() ? "" : parse_boundary(options_.boundary);
    return header;
  }

  bool is_wanted(const ArrayInfo& array) const
  {
    return granular::is_wanted(request_.wanted, array);
  }

  /// A section of so many rows, as an empty one where the file has none.
  Table read_rows(const std::optional<DataSection>& section,
    const std::vector<std::string>& columns, const Request& request)
  {
    return read_section(file_, *source_, section.value_or(DataSection{}), columns, request, ranks_,
      notices_, progress_);
  }

  /// With the ids, which velocities and bonds need, whether they are wanted or not.
  void read_particles(Table& frame)
  {
    progress_.set_part(0.1, 0.5);
    Request request = own_;
    request.header = this->header();
    request.wanted = [this](std::string_view name, bool is_usual) {
      return name == "id" || name == "image" ||
        granular::is_wanted(request_.wanted, name, is_usual);
    };
    frame = this->read_rows(layout_->particles, columns_.particles, request);
    if (options_.boundary.empty())
    {
      this->find_boundary(frame);
    }
    frame.schema = join_schemas(columns_, frame.schema);
    progress_.set_part(0.5, 0.6);
    if (this->wants_velocities(frame.schema))
    {
      this->join(frame, "Velocities", layout_->velocities, columns_.velocities, true);
    }
    progress_.set_part(0.6, 0.7);
    if (this->wants_any(frame.schema, this->first_ellipsoid(), frame.schema.columns().size()))
    {
      this->join(frame, "Ellipsoids", layout_->ellipsoid_rows, columns_.ellipsoids, false);
    }
  }

  /// Finds periodic axes by image counts: where a particle has crossed a face, there are others beyond it.
  void find_boundary(Table& frame)
  {
    std::array<std::int64_t, 3> crossed = {};
    const auto counts = values_in<std::int32_t>(find_array(frame, "image"), 3);
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      crossed[i % 3] += counts[i] != 0 ? 1 : 0;
    }
    ranks_.sum(crossed);
    if (crossed != std::array<std::int64_t, 3>{})
    {
      const auto flag = [&](std::size_t axis) { return crossed[axis] > 0 ? 'p' : 'f'; };
      frame.header.box.boundary = parse_boundary({ flag(0), ' ', flag(1), ' ', flag(2) });
    }
  }

  /// The columns of the sections follow each other, without the ids of all but the first.
  std::size_t first_ellipsoid() const
  {
    const std::size_t velocities = columns_.velocities.size();
    return columns_.particles.size() + (velocities > 0 ? velocities - 1 : 0);
  }

  bool wants_any(const ColumnSchema& schema, std::size_t first, std::size_t end) const
  {
    return std::ranges::any_of(schema.arrays(),
      [&](const ArrayInfo& array)
      {
        const auto column = static_cast<std::size_t>(array.columns.front());
        return column >= first && column < end && this->is_wanted(array);
      });
  }

  bool wants_velocities(const ColumnSchema& schema) const
  {
    return this->wants_any(schema, columns_.particles.size(), this->first_ellipsoid());
  }

  void join(Table& frame, std::string_view name, const std::optional<DataSection>& section,
    const std::vector<std::string>& columns, bool of_all)
  {
    Request request = this->table_request();
    request.ranges = false;
    const Table table = this->read_rows(section, columns, request);
    std::int64_t joined = join_section(
      frame, table, frame.schema, *source_, { name, *section, of_all }, own_.pool, ranks_);
    ranks_.sum({ &joined, 1 });
    if (!this->is_filtered())
    {
      this->note(section,
        "rows of the section " + std::string(name) +
          " that are left out, as their particle is not there",
        section->rows - joined);
    }
  }

  /// Adds a notice about a section if the count is not 0.
  void note(
    const std::optional<DataSection>& section, const std::string& of_what, std::int64_t count)
  {
    if (section && count > 0)
    {
      notices_.push_back(
        { { source_->path(), section->name_line }, of_what + ": " + std::to_string(count) });
    }
  }

  /// All rows of a section, or this rank's share of them.
  Request table_request() const
  {
    Request request;
    request.points = false;
    request.piece = own_.piece;
    request.pieces = own_.pieces;
    request.threads = own_.threads;
    request.pool = own_.pool;
    request.chunk_bytes = own_.chunk_bytes;
    return request;
  }

  void read_bonds(Tables& frame)
  {
    progress_.set_part(0.7, 0.8);
    Table& table = frame.bonds;
    Request request = this->table_request();
    request.schema = make_data_bond_schema();
    table = this->read_rows(layout_->bond_rows, bond_columns, request);
    table.header = frame.rows.header;
    table.header.counted = "BONDS";
    const bool scaled = frame.rows.coordinates == Coordinates::Scaled;
    table.coordinates = scaled ? Coordinates::Absolute : frame.rows.coordinates;
    progress_.set_part(0.8, 0.9);
    const JoinedLines joined = join_lines(view_frame(frame.rows, own_.point_origin),
      values_in<std::int64_t>(find_array(table, "id1")),
      values_in<std::int64_t>(find_array(table, "id2")), { {}, {}, own_.threads, own_.pool },
      ranks_, progress_);
    if (joined.count < table.rows)
    {
      keep_found(table, joined);
    }
    if (joined.missing > 0 && !this->is_filtered())
    {
      this->note(layout_->bond_rows,
        "bonds that are left out, as a particle of theirs is not there", joined.missing);
    }
    this->note_repeated(joined.repeated, frame.rows.schema);
    progress_.set_part(0.9, 1);
    this->make_bond_lines(frame.bonds, joined);
    std::erase_if(table.arrays,
      [&](const TableArray& array)
      { return !request_.bonds || !granular::is_wanted(request_.wanted_bonds, array.info); });
  }

  /// Returns true if particles are left out because the user wants few.
  bool is_filtered() const { return own_.stride > 1 || restricts(own_.region); }

  /// Says what particles share that have one id.
  void note_repeated(std::int64_t repeated, const ColumnSchema& schema)
  {
    const std::string what = "particles that have the id of another one, ";
    if (this->wants_velocities(schema))
    {
      this->note(layout_->velocities, what + "and its velocity", repeated);
    }
    this->note(layout_->bond_rows, what + "where bonds end at the first that has it", repeated);
  }

  /// Lines between the ends that were found, of this rank's piece.
  void make_bond_lines(Table& bonds, const JoinedLines& joined)
  {
    std::int64_t first = 0;
    std::int64_t end = joined.count;
    const std::vector<std::int64_t> rows = gather(ranks_, joined.count);
    bonds.header.rows = sum_of(rows);
    bonds.first_row = sum_of(std::span(rows).first(static_cast<std::size_t>(ranks_.rank())));
    if (ranks_.size() == 1)
    {
      std::tie(first, end) = this->share_of(joined.count);
      keep_rows(bonds, first, end - first);
      bonds.first_row = first;
    }
    const auto ends = [&](const Block& block)
    {
      return std::span(static_cast<const double*>(block.data()), block.bytes() / sizeof(double))
        .subspan(3 * static_cast<std::size_t>(first), 3 * static_cast<std::size_t>(end - first));
    };
    Request lines = own_;
    if (bonds.coordinates == Coordinates::Unwrapped && lines.periodic_lines == PeriodicLines::Split)
    {
      lines.periodic_lines = PeriodicLines::MinimumImage; // there are no faces between
    }
    bonds.lines =
      make_lines(ends(joined.first), ends(joined.second), bonds.header.box, lines, progress_);
    bonds.has_lines = true;
  }

  /// The rows of a rank alone that wants one of several pieces.
  std::pair<std::int64_t, std::int64_t> share_of(std::int64_t rows) const
  {
    const int piece = request_.piece;
    const int pieces = request_.pieces;
    return { begin_of_part(rows, piece, pieces), begin_of_part(rows, piece + 1, pieces) };
  }

  void keep_piece(Table& frame)
  {
    std::erase_if(
      frame.arrays, [&](const TableArray& array) { return !this->is_wanted(array.info); });
    if (ranks_.size() == 1 && request_.pieces > 1)
    {
      const auto [first, end] = this->share_of(frame.rows);
      keep_rows(frame, first, end - first);
    }
  }

  const FramePiece& file_;
  const DataOptions& options_;
  const Request& request_;
  Communicator& ranks_;
  Notices& notices_;
  PartialProgress progress_;
  std::shared_ptr<const ByteSource> source_;
  std::shared_ptr<const DataLayout> layout_;
  DataColumns columns_;
  Request own_; ///< of the particles, as this rank decodes them
};
}

ColumnSchema make_particle_schema(const DataColumns& columns)
{
  std::vector<std::string> names = columns.particles;
  for (const auto* const more : { &columns.velocities, &columns.ellipsoids })
  {
    if (!more->empty())
    {
      names.insert(names.end(), more->begin() + 1, more->end());
    }
  }
  return ColumnSchema(names);
}

ColumnSchema make_data_bond_schema()
{
  return make_local_schema(bond_columns);
}

Tables read_data(const FramePiece& file, const DataOptions& options, const Request& request,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  SharedProgress shared(progress, ranks);
  return do_together(
    ranks, [&] { return DataReader(file, options, request, ranks, notices, shared).read(); });
}
}
