// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/restart_reader.h"

#include "granular/common/shares.h"
#include "granular/formats/restart/decode_records.h"
#include "granular/formats/restart/record_plan.h"
#include "granular/formats/restart/record_scan.h"
#include "granular/lines/line_columns.h"
#include "granular/lines/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace granular
{
namespace
{
/// The history values of a bond, by program.
struct HistoryLayout
{
  std::string_view name; ///< of the program
  std::string_view
    version; ///< a word in the header of its files that no others have; empty: there is none
  std::span<const std::string_view> columns; ///< in turn, as make_local_schema takes them

  /// Values from here on have no sign, in either copy of the bond.
  static constexpr std::size_t unsigned_from = 12;
};

/// Names that all have, then the length, then the damage. Bonds act on their first particle (bond_gran.cpp of each program).
constexpr std::string_view pfm[] = { "force_normalx", "force_normaly", "force_normalz",
  "force_tangentialx", "force_tangentialy", "force_tangentialz", "torque_normalx", "torque_normaly",
  "torque_normalz", "torque_tangentialx", "torque_tangentialy", "torque_tangentialz",
  "initial_length" };

constexpr std::string_view fibers[] = { pfm[0], pfm[1], pfm[2], pfm[3], pfm[4], pfm[5], pfm[6],
  pfm[7], pfm[8], pfm[9], pfm[10], pfm[11], "equilibrium_length", "damage" };

constexpr int first_history = 2; ///< the number of the first of them
constexpr HistoryLayout layouts[] = {
  { "WITH-BONDS", "", std::span(pfm).first(12) },
  { "PFM", "LIGGGHTS-PFM", pfm },
  { "FlexibleFibers", "", std::span(fibers).first(13) },
  { "FlexibleFibersDamage", "", fibers },
};

/// Returns the layout for a number of values, by its place in the table; version: of the program, from the file's header.
/// Null: there is none, or the layout has another number of values.
const HistoryLayout* find_history_layout(
  int layout, std::string_view version, std::int64_t values) noexcept
{
  const HistoryLayout* found = nullptr;
  int place = first_history;
  for (const HistoryLayout& candidate : layouts)
  {
    const bool asked = layout == automatic_history || layout == place++;
    const bool says_so =
      found && !found->version.empty() && version.find(found->version) != version.npos;
    found = asked && std::ssize(candidate.columns) == values && !says_so ? &candidate : found;
  }
  return found;
}

void add_notices(const BondCounts& counts, const Where& where, Notices& notices)
{
  const std::pair<std::int64_t, std::string> said[] = {
    { counts.repeated_ids,
      "particles that have the id of another one, where bonds end at the first that has it" },
    { counts.without_partner, "bonds that are left out, as their partner is not in the file" },
    { counts.of_itself, "bonds of a particle with itself" },
    { counts.differing,
      "bonds whose two particles do not hold the same history, of which that of the lower id is "
      "taken" },
  };
  for (const auto& [count, of_what] : said)
  {
    if (count > 0)
    {
      notices.push_back({ where, of_what + ": " + std::to_string(count) });
    }
  }
}

/// A layout that was asked for, and is not that of the file.
void check_layout(int asked, std::int64_t values, const Where& where, Notices& notices)
{
  if (asked < first_history || asked - first_history >= std::ssize(layouts) || values == 0)
  {
    return;
  }
  const HistoryLayout& layout = layouts[asked - first_history];
  if (std::ssize(layout.columns) != values)
  {
    notices.push_back({ where,
      "expected " + std::to_string(layout.columns.size()) + " history values of a bond, as " +
        std::string(layout.name) + " has them, got " + std::to_string(values) +
        ": they are named history1, history2, ..." });
  }
}

/// Decodes the records of a file.
class FrameReader
{
public:
  FrameReader(const ByteSource& source, const RestartLayout& layout, int history_layout,
    const Request& request, const RecordPlan& plan)
    : source_(source)
    , layout_(layout)
    , history_layout_(history_layout)
    , request_(request)
    , plan_(plan)
    , first_(begin_of_part(layout.records, request.piece, request.pieces))
    , end_(begin_of_part(layout.records, request.piece + 1, request.pieces))
    , executor_(request.threads)
    , particles_(plan, layout, request, first_, end_)
  {
    if (request.bonds && plan.has_bonds())
    {
      const bool all = request.pieces == 1;
      const bool absolute = request.point_origin == Vector3{};
      bonds_.emplace(plan, layout.records, layout.blocks.size(), all ? particles_.ids() : nullptr,
        all && absolute ? particles_.points() : nullptr, request.pool);
    }
  }

  void read(Progress& progress)
  {
    // what fixes have is the same in all records or left out, which all pieces must know
    const bool all = bonds_ || plan_.fixes() > 0;
    const auto is_needed = [&](const RecordBlock& block)
    {
      return all ||
        (first_ < end_ && block.first_row < end_ && block.first_row + block.records > first_);
    };
    const std::vector<RecordBlock>& blocks = layout_.blocks;
    const auto first = std::ranges::find_if(blocks, is_needed) - blocks.begin();
    const auto count = static_cast<std::size_t>(std::ranges::count_if(blocks, is_needed));
    std::vector<RecordRows> rows(executor_.workers(count), RecordRows(plan_));
    std::vector<RecordBuffer> buffers(rows.size());
    Turns turns;
    executor_.parallel_for(
      count,
      [&](std::size_t number, std::size_t worker)
      {
        std::optional<Turn> turn;
        if (!source_.concurrent())
        {
          turn.emplace(turns, number).wait();
        }
        const std::size_t block = static_cast<std::size_t>(first) + number;
        const RecordBatch batch = read_records(source_, layout_, blocks[block], buffers[worker]);
        turn.reset();
        const auto place_of = [&](std::int64_t row)
        {
          return static_cast<std::size_t>(
            std::clamp<std::int64_t>(row - batch.first_row, 0, std::ssize(batch)));
        };
        const std::size_t end = all ? batch.size() : place_of(end_);
        RecordRows& some = rows[worker];
        for (std::size_t at = all ? 0 : place_of(first_); at < end; at += some.count)
        {
          some.load(plan_, batch, at, end);
          particles_.store(some);
          if (bonds_)
          {
            bonds_->collect(block, batch, some);
          }
        }
      },
      progress);
  }

  Tables take(const Where& where, Notices& notices, Progress& progress)
  {
    Tables frame;
    FrameHeader& header = frame.bonds.header;
    header = particles_.header();
    header.rows = 0;
    header.counted = "BONDS";
    if (bonds_)
    {
      this->make_bonds(where, frame.bonds, notices, progress);
    }
    frame.rows = particles_.take(where, notices);
    return frame;
  }

private:
  /// Makes the lines of a frame, whose header is set, from the collected bonds whose first particle is in rows that are read.
  void make_bonds(const Where& where, Table& table, Notices& notices, Progress& progress)
  {
    const std::size_t values = bonds_->history_values();
    PartialProgress part(progress);
    part.set_part(0, 0.4);
    add_notices(match_bonds(bonds_->copies(), bonds_->ids(), layout_.header.newton_bond, values,
                  executor_, part),
      where, notices);
    check_layout(history_layout_, static_cast<std::int64_t>(values), where, notices);
    this->count_bonds(table);
    this->make_arrays(table);
    std::array<Block, 2> ends;
    const auto rows = static_cast<std::size_t>(table.rows);
    for (Block& end : ends)
    {
      end = Block(rows * sizeof(Vector3), request_.pool);
    }
    part.set_part(0.4, 0.7);
    executor_.parallel_for(
      bonds_->copies().size(),
      [&](std::size_t block, std::size_t) { this->fill(block, table, ends); }, part);
    part.set_part(0.7, 1);
    const auto points = [&](const Block& end)
    { return std::span(static_cast<const double*>(end.data()), 3 * rows); };
    table.lines = make_lines(points(ends[0]), points(ends[1]), table.header.box, request_, part);
    table.has_lines = true;
  }

  /// The rows of each block in the table, and of all.
  void count_bonds(Table& table)
  {
    for (const BondCopies& copies : bonds_->copies())
    {
      first_bonds_.push_back(static_cast<std::size_t>(table.rows));
      copies.for_kept(0, layout_.records,
        [&](std::int64_t row, std::size_t)
        {
          ++table.header.rows;
          table.first_row += row < first_ ? 1 : 0;
          table.rows += row >= first_ && row < end_ ? 1 : 0;
        });
    }
  }

  /// Memory for the arrays that are wanted.
  void make_arrays(Table& table) const
  {
    table.schema = make_bond_schema(
      history_layout_, layout_.header.version, static_cast<std::int64_t>(bonds_->history_values()));
    const auto rows = static_cast<std::size_t>(table.rows);
    for (const ArrayInfo& info : table.schema.arrays())
    {
      if (is_wanted(request_.wanted_bonds, info.name))
      {
        const std::size_t bytes = size_of(info.type) * info.columns.size() * rows;
        table.arrays.push_back({ info, Block(bytes, request_.pool), {}, {} });
      }
    }
  }

  /// Stores values of each kept bond of a block: store(row, copy, to) returns where the next go.
  template <class Value, class Store>
  void put(std::size_t block, const Block& array, std::size_t columns, const Store& store) const
  {
    auto* to = static_cast<Value*>(array.data()) + first_bonds_[block] * columns;
    bonds_->copies()[block].for_kept(
      first_, end_, [&](std::int64_t row, std::size_t copy) { to = store(row, copy, to); });
  }

  void fill(std::size_t block, const Table& table, const std::array<Block, 2>& ends) const
  {
    const BondCopies& copies = bonds_->copies()[block];
    this->put<double>(block, ends[0], 3,
      [&](std::int64_t row, std::size_t, double* to)
      { return std::copy_n(bonds_->point(row), 3, to); });
    this->put<double>(block, ends[1], 3,
      [&](std::int64_t, std::size_t copy, double* to)
      { return std::copy_n(bonds_->point(copies.partners[copy]), 3, to); });
    for (const TableArray& array : table.arrays)
    {
      switch (array.info.columns.front())
      {
        case 0:
        case 1:
          this->put<std::int64_t>(block, array.block, 1,
            [&, first = array.info.columns.front() == 0](
              std::int64_t row, std::size_t copy, std::int64_t* to)
            {
              *to = bonds_->ids()[static_cast<std::size_t>(first ? row : copies.partners[copy])];
              return to + 1;
            });
          break;
        case 2:
          this->put<std::int32_t>(block, array.block, 1,
            [&](std::int64_t, std::size_t copy, std::int32_t* to)
            { return std::copy_n(&copies.types[copy], 1, to); });
          break;
        default:
          this->put_history(block, array);
      }
    }
  }

  void put_history(std::size_t block, const TableArray& array) const
  {
    const BondCopies& copies = bonds_->copies()[block];
    const std::size_t all = bonds_->history_values();
    const bool known =
      find_history_layout(history_layout_, layout_.header.version, static_cast<std::int64_t>(all));
    const std::size_t unsigned_from = known ? HistoryLayout::unsigned_from : all;
    this->put<double>(block, array.block, array.info.columns.size(),
      [&](std::int64_t, std::size_t copy, double* to)
      {
        for (const int column : array.info.columns)
        {
          const auto i = static_cast<std::size_t>(column) - 3;
          const double value = copies.values()[copy * all + i];
          *to++ = i < unsigned_from ? value : std::abs(value);
        }
        return to;
      });
  }

  const ByteSource& source_;
  const RestartLayout& layout_;
  int history_layout_;
  const Request& request_;
  const RecordPlan& plan_;
  std::int64_t first_;
  std::int64_t end_;
  Executor executor_;
  ParticleStore particles_;
  std::optional<BondCollector> bonds_;
  std::vector<std::size_t> first_bonds_; ///< of each block in the table
};
}

ColumnSchema make_bond_schema(
  int history_layout, std::string_view version, std::int64_t history_values)
{
  std::vector<std::string> names = { "id1", "id2", "btype" };
  if (const HistoryLayout* const found =
        find_history_layout(history_layout, version, history_values))
  {
    names.insert(names.end(), found->columns.begin(), found->columns.end());
    return make_local_schema(names);
  }
  for (std::int64_t i = 1; i <= history_values; ++i)
  {
    names.push_back("history" + std::to_string(i));
  }
  return make_local_schema(names);
}

RestartColumns find_restart_columns(
  const ByteSource& source, const RestartLayout& layout, Notices& notices, Progress& progress)
{
  const RecordPlan plan(source, layout, notices, progress);
  RestartColumns columns;
  for (const RecordColumn& column : plan.columns())
  {
    columns.particles.push_back(column.name);
  }
  columns.has_bonds = plan.has_bonds();
  columns.history_values = plan.history_values();
  return columns;
}

Tables read_restart(const ByteSource& source, const RestartLayout& layout, int history_layout,
  const Request& request, Notices& notices, Progress& progress)
{
  PartialProgress part(progress);
  part.set_part(0, 0.05);
  const RecordPlan plan(source, layout, notices, part);
  FrameReader reader(source, layout, history_layout, request, plan);
  part.set_part(0.05, plan.has_bonds() ? 0.7 : 1);
  reader.read(part);
  part.set_part(0.7, 1);
  return reader.take({ source.path() }, notices, part);
}
}
