// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/read_data.h"

#include "granular/common/shares.h"
#include "granular/formats/data_file/data_file.h"
#include "granular/geometry/box.h"
#include "granular/lines/join.h"
#include "granular/lines/lines.h"
#include "granular/parallel/trade.h"
#include "granular/particles/table.h"
#include "granular/sorting/sort_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
/// Returns the names of types from 1 on; empty where a type has none.
std::vector<std::string> names_of(const TypeLabels& labels)
{
  std::vector<std::string> names;
  for (const auto& [name, type] : labels)
  {
    constexpr std::int64_t most = 1 << 20; // a number in a file is a claim
    if (type > 0 && type <= most)
    {
      names.resize(std::max(names.size(), static_cast<std::size_t>(type)));
      names[static_cast<std::size_t>(type - 1)] = name;
    }
  }
  return names;
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

  /// Reads a section with types in a column, which may be labels; of a file without it no rows.
  Table read_rows(std::string_view name, const ColumnSchema& schema, const Request& request,
    std::string_view labels, std::string_view types)
  {
    const DataSection* const section = layout_->find(name);
    const TypeLabels* const known = layout_->find_labels(labels);
    Table table = read_section(file_, *source_, section ? *section : DataSection{}, schema, known,
      types, request, ranks_, notices_, progress_);
    table.type_names = known ? names_of(*known) : std::vector<std::string>();
    return table;
  }

  /// With the ids, which velocities and bonds need, whether they are wanted or not.
  void read_particles(Table& frame)
  {
    progress_.set_part(0.1, 0.5);
    Request request = own_;
    request.header = this->header();
    request.wanted = [this](std::string_view name, bool is_usual)
    {
      return name == "id" || name == "image" || (name == "type" && columns_.masses) ||
        granular::is_wanted(request_.wanted, name, is_usual);
    };
    frame = this->read_rows(
      "Atoms", ColumnSchema(columns_.particles), request, "Atom Type Labels", "type");
    if (options_.boundary.empty())
    {
      this->find_boundary(frame);
    }
    const ColumnSchema particles = std::move(frame.schema);
    frame.schema = make_particle_schema(columns_);
    this->change_types(frame.schema, 0, particles);
    std::size_t first = columns_.particles.size();
    progress_.set_part(0.5, 0.7);
    for (const JoinedSection& section : columns_.joined)
    {
      const std::size_t end = first + section.columns.size() - 1;
      if (this->wants_any(frame.schema, first, end))
      {
        this->join(frame, section, first);
      }
      first = end;
    }
    if (columns_.masses && this->wants_any(frame.schema, first, first + 1))
    {
      this->add_masses(frame);
    }
  }

  /// Gives columns from the first one on the types that they have come to be.
  static void change_types(ColumnSchema& schema, std::size_t first, const ColumnSchema& read)
  {
    std::vector<ColumnSchema::TypeChange> changes;
    for (std::size_t i = first == 0 ? 0 : 1; i < read.columns().size(); ++i) // ids stand once
    {
      const std::size_t column = first == 0 ? i : first + i - 1;
      if (read.columns()[i].type != schema.columns()[column].type)
      {
        changes.push_back({ static_cast<int>(column), read.columns()[i].type });
      }
    }
    schema.set_types(changes);
  }

  /// Adds the masses of the types of particles; nan without a mass or a type.
  void add_masses(Table& frame)
  {
    const auto types = values_in<std::int32_t>(find_array(frame, "type"));
    const auto odd_types = values_in<double>(find_array(frame, "type")); // where one is not whole
    const auto place = static_cast<std::size_t>(frame.schema.find_array("mass"));
    TableArray array{ frame.schema.arrays()[place], {}, {}, {} };
    array.block = Block(static_cast<std::size_t>(frame.rows) * sizeof(double), own_.pool);
    auto* const to = static_cast<double*>(array.block.data());
    std::fill_n(to, frame.rows, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t row = 0; row < std::max(types.size(), odd_types.size()); ++row)
    {
      const double type = types.empty() ? odd_types[row] : types[row];
      const auto mass = std::abs(type) < 0x1p31 && std::trunc(type) == type
        ? layout_->masses.find(static_cast<std::int64_t>(type))
        : layout_->masses.end();
      to[row] = mass == layout_->masses.end() ? to[row] : mass->second;
    }
    frame.arrays.push_back(std::move(array));
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

  bool wants_any(const ColumnSchema& schema, std::size_t first, std::size_t end) const
  {
    return std::ranges::any_of(schema.arrays(),
      [&](const ArrayInfo& array)
      {
        const auto column = static_cast<std::size_t>(array.columns.front());
        return column >= first && column < end && this->is_wanted(array);
      });
  }

  /// first: the first of its columns in the schema of the frame.
  void join(Table& frame, const JoinedSection& section, std::size_t first)
  {
    Request request = this->table_request();
    request.ranges = false;
    const std::string& name = section.section->name;
    const Table table = read_section(file_, *source_, *section.section,
      ColumnSchema(section.columns), nullptr, {}, request, ranks_, notices_, progress_);
    const auto text = std::ranges::find(table.schema.columns(), ValueType::Text, &ColumnInfo::type);
    if (text != table.schema.columns().end())
    {
      throw FormatError(
        "expected numbers in column '" + text->name + "' of the section " + name + ", got words",
        { source_->path(), section.section->name_line });
    }
    change_types(frame.schema, first, table.schema);
    const std::int64_t joined =
      join_section(frame, table, frame.schema, first, *source_, section, own_.pool, ranks_);
    std::int64_t all = joined;
    ranks_.sum({ &all, 1 });
    if (!this->is_filtered())
    {
      this->note(name,
        "rows of the section " + name + " that are left out, as their particle is not there",
        section.section->rows - all);
    }
  }

  /// Adds a notice about a section if the count is not 0.
  void note(std::string_view name, const std::string& of_what, std::int64_t count)
  {
    const DataSection* const section = layout_->find(name);
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
    table = this->read_rows("Bonds", make_data_bond_schema(), request, "Bond Type Labels", "btype");
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
      this->note(
        "Bonds", "bonds that are left out, as a particle of theirs is not there", joined.missing);
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
    const int velocity = schema.find_array("v");
    if (velocity >= 0 && this->is_wanted(schema.arrays()[static_cast<std::size_t>(velocity)]))
    {
      this->note("Velocities", what + "and its velocity", repeated);
    }
    this->note("Bonds", what + "where bonds end at the first that has it", repeated);
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

Tables read_data(const FramePiece& file, const DataOptions& options, const Request& request,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  SharedProgress shared(progress, ranks);
  return do_together(
    ranks, [&] { return DataReader(file, options, request, ranks, notices, shared).read(); });
}
}
