// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_block_sums_h
#define granular_averages_block_sums_h

#include "granular/averages/average.h"
#include "granular/common/progress.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/grid/euler_grid.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/sorting/block_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

namespace granular
{
/// Sums in the cells of a grid over rows of all ranks. The grid is divided into blocks of cells whose sums fit into the cache of
/// a core, some at a time: all ranks work on the same blocks at the same time, and add up the integers of their sums, so that
/// order, threads and ranks cannot matter.
class BlockSums
{
public:
  static constexpr std::int64_t most_cells_of_block = 4096; ///< fits into 16 bits

  /// Bytes of the sums of a group. Larger groups mean fewer reductions over ranks.
  static constexpr std::int64_t bytes_of_group = std::int64_t{ 64 } << 20;

  /// Blocks [first, last), each summed by this many tasks.
  struct Group
  {
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::int64_t parts = 1;

    std::int64_t blocks() const noexcept { return last - first; }
    std::size_t tasks() const noexcept { return static_cast<std::size_t>(this->blocks() * parts); }
  };

  /// Rows [first, last) of the rows of a block, and the number of the block in its group.
  struct Part
  {
    std::int64_t block;
    std::int64_t first;
    std::int64_t last;
    std::int64_t place;
  };

  /// grid and wanted must stay.
  BlockSums(const EulerGrid& grid, const WantedCells& wanted, Communicator& ranks,
    const Executor& executor, Progress& progress);

  /// Returns the number of blocks.
  std::int64_t blocks() const noexcept { return blocks_[0] * blocks_[1] * blocks_[2]; }

  /// Returns the number of cells of the largest block.
  std::int64_t largest() const noexcept { return largest_; }

  CellRange range(std::int64_t block) const noexcept;
  const BlockRows& rows() const noexcept { return rows_; }

  /// Adds an entry of a row for each block with cells of the ranges that each_range(visit) visits, the images of one thing; none
  /// of these is empty. A block has one entry, though several images may reach it. Returns true if there are any.
  template <class EachRange>
  bool add_entries(
    std::uint32_t row, std::vector<BlockRows::Entry>& entries, const EachRange& each_range) const
  {
    const auto first = static_cast<std::ptrdiff_t>(entries.size());
    each_range(
      [&](const CellRange& range)
      {
        const auto own = static_cast<std::ptrdiff_t>(entries.size());
        CellRange blocks;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          blocks.first[axis] = range.first[axis] >> shifts_[axis];
          blocks.last[axis] = ((range.last[axis] - 1) >> shifts_[axis]) + 1;
        }
        blocks.each(
          [&](const std::array<std::int64_t, 3>& at)
          {
            const std::int64_t block = (at[2] * blocks_[1] + at[1]) * blocks_[0] + at[0];
            const BlockRows::Entry entry = { static_cast<std::uint32_t>(block), row };
            const auto end = entries.begin() + own; // a range has a block once
            if (std::find(entries.begin() + first, end, entry) == end)
            {
              entries.push_back(entry);
            }
          });
      });
    return first < static_cast<std::ptrdiff_t>(entries.size());
  }

  /// Takes the rows of this rank in each block. Collective.
  void set_rows(BlockRows rows);

  /// Returns groups of blocks, without those that no rank has rows in. largest_scale: see SumScale::size.
  std::vector<Group> make_groups(std::size_t largest_scale) const;

  /// Calls work(part, task, room, sums) for parts of the blocks of a group, on any threads, with the integers of the sums of
  /// the block's cells. Afterwards the first part of each block has those of all ranks. rooms: one for each worker of
  /// executor().workers(group.tasks()). Collective.
  template <class Room, class Work>
  void add(const Group& group, const SumScale& scale, std::vector<Room>& rooms, const Work& work)
  {
    const std::int64_t block_size = largest_ * static_cast<std::int64_t>(scale.size());
    const std::int64_t part_size = group.blocks() * block_size;
    integers_.resize(static_cast<std::size_t>(group.parts * part_size));
    executor_.parallel_for(
      group.tasks(),
      [&](std::size_t task, std::size_t worker)
      {
        const std::int64_t place = static_cast<std::int64_t>(task) / group.parts;
        const std::int64_t part = static_cast<std::int64_t>(task) % group.parts;
        std::int64_t* const sums = integers_.data() + part * part_size + place * block_size;
        std::fill_n(sums, block_size, 0);
        const std::int64_t count = rows_.count(group.first + place);
        work(Part{ group.first + place, count * part / group.parts,
               count * (part + 1) / group.parts, place },
          task, rooms[worker], sums);
      },
      progress_);
    for (std::int64_t part = 1; part < group.parts; ++part)
    {
      const auto from = integers_.begin() + part * part_size;
      std::transform(from, from + part_size, integers_.begin(), integers_.begin(), std::plus<>());
    }
    ranks_.sum({ integers_.data(), static_cast<std::size_t>(part_size) });
  }

  /// Calls take(number of the cell in the group, its place among the wanted ones or -1, its volume, its sums) for each cell of the
  /// blocks that have rows.
  template <class Take>
  void each_cell(const Group& group, const SumScale& scale, const Take& take) const
  {
    const auto largest = static_cast<std::size_t>(largest_);
    executor_.parallel_for(
      static_cast<std::size_t>(group.blocks()),
      [&](std::size_t place, std::size_t)
      {
        const std::int64_t block = group.first + static_cast<std::int64_t>(place);
        if (counts_[static_cast<std::size_t>(block)] == 0)
        {
          return;
        }
        std::size_t cell = place * largest;
        this->range(block).each(
          [&](const std::array<std::int64_t, 3>& x)
          {
            take(cell, wanted_.place(grid_, x), this->volume_of(x),
              scale.values(integers_.data() + cell * scale.size()));
            ++cell;
          });
      },
      progress_);
  }

  /// The same for the wanted ones.
  template <class Take>
  void each_wanted(const Group& group, const SumScale& scale, const Take& take) const
  {
    this->each_cell(group, scale,
      [&](std::size_t cell, std::int64_t place, double volume, const SumScale::Terms& sums)
      {
        if (place >= 0)
        {
          take(cell, static_cast<std::size_t>(place), volume, sums);
        }
      });
  }

  double volume_of(const std::array<std::int64_t, 3>& cell) const noexcept;

private:
  const EulerGrid& grid_;
  const WantedCells& wanted_;
  std::array<int, 3> shifts_ = {}; ///< sizes of blocks are powers of two
  std::array<std::int64_t, 3> blocks_ = {};
  std::int64_t largest_ = 1;
  Communicator& ranks_;
  const Executor& executor_;
  Progress& progress_;
  BlockRows rows_;
  std::vector<std::int64_t> counts_;         ///< rows of each block, of all ranks
  std::vector<std::int64_t> integers_;       ///< sums of a group: part, block, cell, level, lane
  std::array<std::vector<double>, 3> edges_; ///< of the cells along each axis
};
}
#endif
