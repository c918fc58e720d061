// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/bond_frame.h"

#include "granular/local/local_columns.h"
#include "granular/restart/history_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace granular
{
namespace
{
/// The copies in a block of which the first particle is in some rows, and which count.
template <class Visit>
void for_bonds(const BondCopies& copies, std::int64_t first, std::int64_t end, const Visit& visit)
{
  const auto rows = static_cast<std::int64_t>(copies.rows());
  const auto from =
    static_cast<std::size_t>(std::clamp<std::int64_t>(first - copies.first_row, 0, rows));
  const auto to =
    static_cast<std::size_t>(std::clamp<std::int64_t>(end - copies.first_row, 0, rows));
  for (std::size_t row = from; row < to; ++row)
  {
    for (auto i = copies.begins[row]; i < copies.begins[row + 1]; ++i)
    {
      if (copies.states[static_cast<std::size_t>(i)] != BondCopies::Left)
      {
        visit(copies.first_row + static_cast<std::int64_t>(row), static_cast<std::size_t>(i));
      }
    }
  }
}

/// A bond that counts.
struct Bond
{
  std::int64_t row;   ///< of the first particle
  std::int64_t other; ///< of the second
  std::size_t copy;   ///< in its block
};

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
  const auto layouts = history_layouts();
  if (asked < 0 || static_cast<std::size_t>(asked) >= layouts.size() || values == 0)
  {
    return;
  }
  const HistoryLayout& layout = layouts[static_cast<std::size_t>(asked)];
  if (static_cast<std::int64_t>(layout.columns.size()) != values)
  {
    notices.push_back({ where,
      "expected " + std::to_string(layout.columns.size()) + " history values of a bond, as " +
        std::string(layout.name) + " has them, got " + std::to_string(values) +
        ": they are named history1, history2, ..." });
  }
}

class FrameMaker
{
public:
  FrameMaker(const BondCollector& bonds, const RestartLayout& layout, const RestartRequest& request,
    std::int64_t first, std::int64_t end, LocalFrame& local)
    : bonds_(bonds)
    , request_(request)
    , version_(layout.header.version)
    , first_row_(first)
    , end_row_(end)
    , executor_(request.lines.threads)
    , local_(local)
  {
  }

  void make(Progress& progress)
  {
    PartialProgress part(progress);
    this->count();
    this->make_arrays();
    part.set_part(0, 0.5);
    executor_.parallel_for(
      bonds_.copies().size(), [&](std::size_t block, std::size_t) { this->fill(block); }, part);
    part.set_part(0.5, 1);
    const auto rows = 3 * static_cast<std::size_t>(local_.table.rows);
    local_.lines = make_lines(std::span(static_cast<const double*>(ends_[0].data()), rows),
      std::span(static_cast<const double*>(ends_[1].data()), rows), local_.table.header.box,
      request_.lines, part);
    local_.has_lines = true;
  }

private:
  /// The rows of each block in the table, and of all.
  void count()
  {
    DumpFrame& table = local_.table;
    constexpr std::int64_t last = std::numeric_limits<std::int64_t>::max();
    for (const BondCopies& copies : bonds_.copies())
    {
      first_bonds_.push_back(static_cast<std::size_t>(table.rows));
      for_bonds(copies, 0, last,
        [&](std::int64_t row, std::size_t)
        {
          ++table.header.rows;
          local_.first_row += row < first_row_ ? 1 : 0;
          table.rows += row >= first_row_ && row < end_row_ ? 1 : 0;
        });
    }
  }

  /// Memory for the arrays that are wanted.
  void make_arrays()
  {
    DumpFrame& table = local_.table;
    const auto values = static_cast<std::int64_t>(bonds_.history_values());
    const bool known = find_history_layout(request_.history_layout, version_, values);
    unsigned_from_ = known ? HistoryLayout::unsigned_from : bonds_.history_values();
    table.schema = make_bond_schema(request_.history_layout, version_, values);
    const auto rows = static_cast<std::size_t>(table.rows);
    for (const ArrayInfo& info : table.schema.arrays())
    {
      if (!request_.wanted_bonds || request_.wanted_bonds(info.name))
      {
        DumpArray array{ info, {}, {}, {} };
        array.block = Block(size_of(info.type) * info.columns.size() * rows, request_.lines.pool);
        table.arrays.push_back(std::move(array));
      }
    }
    for (Block& end : ends_)
    {
      end = Block(rows * sizeof(Vector3), request_.lines.pool);
    }
  }

  void fill(std::size_t block)
  {
    const BondCopies& copies = bonds_.copies()[block];
    std::vector<Bond> bonds;
    bonds.reserve(copies.size());
    for_bonds(copies, first_row_, end_row_,
      [&](std::int64_t row, std::size_t copy) {
        bonds.push_back({ row, copies.partners[copy], copy });
      });
    const std::size_t first = first_bonds_[block];
    this->fill_ends(bonds, first);
    const auto ids = bonds_.ids();
    const auto id_of = [&](std::int64_t row) { return ids[static_cast<std::size_t>(row)]; };
    for (const DumpArray& array : local_.table.arrays)
    {
      switch (array.info.columns.front())
      {
        case 0:
          put(array, bonds, first, [&](const Bond& bond) { return id_of(bond.row); });
          break;
        case 1:
          put(array, bonds, first, [&](const Bond& bond) { return id_of(bond.other); });
          break;
        case 2:
          put(array, bonds, first, [&](const Bond& bond) { return copies.types[bond.copy]; });
          break;
        default:
          this->fill_history(array, bonds, first, copies);
      }
    }
  }

  void fill_ends(std::span<const Bond> bonds, std::size_t first)
  {
    for (const int end : { 0, 1 })
    {
      auto* to = static_cast<double*>(ends_[end].data()) + 3 * first;
      for (const Bond& bond : bonds)
      {
        to = std::copy_n(bonds_.point(end == 0 ? bond.row : bond.other), 3, to);
      }
    }
  }

  template <class ValueOf>
  static void put(
    const DumpArray& array, std::span<const Bond> bonds, std::size_t first, const ValueOf& value_of)
  {
    using Value = decltype(value_of(bonds[0]));
    auto* to = static_cast<Value*>(array.block.data()) + first;
    for (const Bond& bond : bonds)
    {
      *to++ = value_of(bond);
    }
  }

  void fill_history(const DumpArray& array, std::span<const Bond> bonds, std::size_t first,
    const BondCopies& copies) const
  {
    const std::vector<int>& columns = array.info.columns;
    auto* to = static_cast<double*>(array.block.data()) + first * columns.size();
    for (const Bond& bond : bonds)
    {
      const double* const values = copies.values() + bond.copy * bonds_.history_values();
      for (const int column : columns)
      {
        const auto i = static_cast<std::size_t>(column) - 3;
        *to++ = i < unsigned_from_ ? values[i] : std::abs(values[i]);
      }
    }
  }

  const BondCollector& bonds_;
  const RestartRequest& request_;
  const std::string& version_; ///< of the program
  std::int64_t first_row_;
  std::int64_t end_row_;
  Executor executor_;
  LocalFrame& local_;
  std::size_t unsigned_from_ = 0;
  std::vector<std::size_t> first_bonds_; ///< of each block in the table
  Block ends_[2];
};
}

ColumnSchema make_bond_schema(
  int history_layout, std::string_view version, std::int64_t history_values)
{
  std::vector<std::string> names = { "id1", "id2", "btype" };
  const auto history = history_columns(history_layout, version, history_values);
  names.insert(names.end(), history.begin(), history.end());
  return make_local_schema(names);
}

void make_bond_frame(BondCollector& bonds, const RestartLayout& layout,
  const RestartRequest& request, std::int64_t first, std::int64_t end, const Where& where,
  LocalFrame& local, Notices& notices, Progress& progress)
{
  PartialProgress part(progress);
  part.set_part(0, 0.4);
  add_notices(match_bonds(bonds.copies(), bonds.ids(), layout.header.newton_bond,
                bonds.history_values(), Executor(request.lines.threads), part),
    where, notices);
  check_layout(
    request.history_layout, static_cast<std::int64_t>(bonds.history_values()), where, notices);
  part.set_part(0.4, 1);
  FrameMaker(bonds, layout, request, first, end, local).make(part);
}
}
