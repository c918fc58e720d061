// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/average_passes.h"

#include "granular/euler/sphere_box.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
/// Of the sums of a group, where there is one process.
constexpr std::int64_t bytes_of_thread = std::int64_t{ 8 } << 20;

/// Below it the parts of a block are not worth a sum of their own each.
constexpr std::int64_t rows_of_part = 16384;

/// Shares of a group that the first pass keeps for the second: 256 MiB.
constexpr std::size_t most_kept = std::size_t{ 1 } << 24;

/// Where the sums of each quantity are.
enum Lane : std::size_t
{
  Share,
  Mass,
  MomentumX,
  MomentumY,
  MomentumZ,
  Radius,
  Volume
};
}

/// Shares of grains in cells of a block, some at a time.
struct AveragePasses::Batch
{
  static constexpr std::size_t most = GrainBlock::most_rows;

  GrainBlock grains;
  std::array<std::int64_t, most> rows;
  GrainCells::Shares shares;

  std::int64_t outside = 0; ///< grains that had no share
  std::size_t size = 0;
  std::array<std::size_t, most> grain; ///< of grains
  std::array<std::int64_t, most> cell; ///< of the block
  std::array<double, most> share;
  std::array<double, most> volume;
  std::array<SumScale::Terms, most> terms;

  /// All grains, each whole in its cell; the stress needs no volumes.
  void fill_whole(Pass pass) noexcept
  {
    size = grains.rows;
    std::iota(grain.begin(), grain.end(), std::size_t{ 0 });
    share.fill(1);
    for (std::size_t i = 0; pass == Pass::Means && i < size; ++i)
    {
      volume[i] = sphere_volume(grains.radius[i]);
    }
  }
};

AveragePasses::AveragePasses(const FrameView& frame, const GrainSources& sources, std::int64_t rows,
  const EulerAverageRequest& request, Communicator& ranks, const Executor& executor,
  Progress& progress)
  : frame_(frame)
  , rows_(rows)
  , request_(request)
  , ranks_(ranks)
  , executor_(executor)
  , progress_(progress)
  , grains_(frame, sources)
  , cells_(request.grid, request.cells, frame.has_box ? &frame.header.box : nullptr)
  , blocks_(request.grid.counts)
  , stress_(!request.arrays.stress.empty())
{
}

EulerAverages AveragePasses::run()
{
  progress_.set_part(0, 0.2);
  this->scan();
  this->plan();
  progress_.set_part(0.2, 0.3);
  this->locate();
  const std::int64_t block_bytes =
    blocks_.largest() * 8 * static_cast<std::int64_t>(std::max(sums_.size(), stresses_.size()));
  // one process alone does better with what fits into caches
  const std::int64_t bytes = ranks_.size() > 1
    ? bytes_of_group
    : std::min<std::int64_t>(bytes_of_group, bytes_of_thread * executor_.threads());
  const std::int64_t together = std::max<std::int64_t>(bytes / block_bytes, 1);
  const std::int64_t blocks = blocks_.size();
  for (std::int64_t first = 0; first < blocks; first += together)
  {
    const std::int64_t last = std::min(first + together, blocks);
    const std::int64_t rows =
      std::accumulate(counts_.begin() + first, counts_.begin() + last, std::int64_t{ 0 });
    if (rows > 0)
    {
      const auto threads = static_cast<std::int64_t>(executor_.threads());
      const std::int64_t parts =
        last - first >= 2 * threads ? 1 : std::clamp<std::int64_t>(rows / rows_of_part, 1, threads);
      progress_.set_part(0.3 + 0.7 * static_cast<double>(first) / static_cast<double>(blocks),
        0.3 + 0.7 * static_cast<double>(last) / static_cast<double>(blocks));
      this->sum_group({ first, last, parts });
    }
  }
  return std::move(result_);
}

void AveragePasses::sum_group(const Group& group)
{
  this->add_grains(Pass::Means, group,
    [](Batch& batch, const double*)
    {
      const GrainBlock& grains = batch.grains;
      for (std::size_t n = 0; n < batch.size; ++n)
      {
        const std::size_t i = batch.grain[n];
        const double* const v = grains.velocities + 3 * i;
        const double mass = grains.mass[i] * batch.share[n];
        batch.terms[n] = { batch.share[n], mass, mass * v[0], mass * v[1], mass * v[2],
          grains.radius[i] * batch.share[n], batch.volume[n], 0 };
      }
    });
  if (blocks_.size() == 1) // nobody looked where grains are
  {
    ranks_.sum({ &outside_, 1 });
    result_.outside = outside_;
  }
  this->finish_means(group);
  this->add_grains(Pass::Stress, group,
    [](Batch& batch, const double* means)
    {
      const GrainBlock& grains = batch.grains;
      for (std::size_t n = 0; n < batch.size; ++n)
      {
        const std::size_t i = batch.grain[n];
        const double* const v = grains.velocities + 3 * i;
        const double* const mean = means + 3 * batch.cell[n];
        const double mass = grains.mass[i] * batch.share[n];
        const double x = deviation(v[0], mean[0]);
        const double y = deviation(v[1], mean[1]);
        const double z = deviation(v[2], mean[2]);
        batch.terms[n] = { -mass * x * x, -mass * y * y, -mass * z * z, -mass * x * y,
          -mass * x * z, -mass * y * z, 0, 0 };
        for (std::size_t k = 0; grains.stresses && k < 6; ++k)
        {
          batch.terms[n][k] += grains.stresses[6 * i + k] * batch.share[n];
        }
      }
    });
  this->finish_stress(group);
}

/// The cells of grains that have one each, whose places among those of all blocks begin there. The first pass keeps
/// what it finds for the second. Whether all have one.
bool AveragePasses::find_cells(std::int64_t place, const CellRange& range, Pass pass, Batch& batch)
{
  const auto found = found_.begin() + place;
  const std::size_t count = batch.grains.rows;
  if (pass == Pass::Means)
  {
    const bool all =
      cells_.finder().find({ batch.grains.positions, 3 * count }, range, batch.cell.data());
    std::transform(batch.cell.begin(), batch.cell.begin() + static_cast<std::ptrdiff_t>(count),
      found, [](std::int64_t cell) { return static_cast<std::int16_t>(cell); });
    return all;
  }
  std::int64_t missing = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    batch.cell[i] = found[static_cast<std::ptrdiff_t>(i)];
    missing |= batch.cell[i];
  }
  return missing >= 0;
}

/// Calls take() whenever the batch is full, and at the end, with the shares of some of the rows of a block.
template <class Take>
void AveragePasses::each_batch(
  Pass pass, const Part& part, Batch& batch, KeptShares& kept, const Take& take)
{
  const CellRange range = blocks_.range(part.block);
  const GrainBlock& grains = batch.grains;
  const auto add = [&](std::size_t grain, std::int64_t cell, double share, double volume)
  {
    batch.grain[batch.size] = grain;
    batch.cell[batch.size] = cell;
    batch.share[batch.size] = share;
    batch.volume[batch.size] = volume;
    if (++batch.size == Batch::most)
    {
      take();
      batch.size = 0;
    }
  };
  auto next = kept.shares.begin();
  for (std::int64_t first = part.first; first < part.last;)
  {
    const std::span<const std::int64_t> rows =
      block_rows_.rows(part.block, first, part.last, batch.rows);
    grains_.load(rows, batch.grains);
    const auto before = static_cast<std::uint64_t>(first - part.first);
    const std::int64_t place = block_rows_.start(part.block) + first;
    first += static_cast<std::int64_t>(rows.size());
    if (!found_.empty() && !grains.usable && this->find_cells(place, range, pass, batch))
    {
      batch.fill_whole(pass);
    }
    else if (pass == Pass::Stress && kept.complete)
    {
      for (; next != kept.shares.end() && next->grain - before < grains.rows; ++next)
      {
        add(next->grain - before, next->cell, next->share, 0); // volumes are summed up already
      }
    }
    else
    {
      for (std::size_t i = 0; i < grains.rows; ++i)
      {
        if (!grains.uses(i))
        {
          continue;
        }
        bool inside = false;
        cells_.each_share(grains.positions + 3 * i, grains.radius[i], range, batch.shares,
          [&](std::int64_t cell, double share, double volume)
          {
            inside = true;
            kept.add(before + i, cell, share);
            add(i, cell, share, volume);
          });
        if (!inside)
        {
          cells_.each_range(grains.positions + 3 * i, grains.radius[i],
            [&](const CellRange&) { inside = true; }); // so little that its share is 0
          batch.outside += inside ? 0 : 1;
        }
      }
    }
    take();
    batch.size = 0;
  }
}

/// Sums over the grains of all ranks in the cells of a group; make_terms fills the terms of a batch and knows the means
/// of its block. The sums of all parts of all ranks come to be the first part.
template <class MakeTerms>
void AveragePasses::add_grains(Pass pass, const Group& group, const MakeTerms& make_terms)
{
  const SumScale& scale = pass == Pass::Means ? sums_ : stresses_;
  const std::int64_t cells = blocks_.largest();
  const std::int64_t block_size = cells * static_cast<std::int64_t>(scale.size());
  const std::int64_t part_size = group.blocks() * block_size;
  const auto do_task = [&](std::size_t task, Batch& batch)
  {
    const std::int64_t at = static_cast<std::int64_t>(task) / group.parts;
    const std::int64_t part = static_cast<std::int64_t>(task) % group.parts;
    std::int64_t* const sums = integers_.data() + part * part_size + at * block_size;
    std::fill_n(sums, block_size, 0);
    const std::int64_t count = block_rows_.count(group.first + at);
    this->each_batch(pass,
      { group.first + at, count * part / group.parts, count * (part + 1) / group.parts }, batch,
      kept_[task],
      [&]
      {
        make_terms(batch, means_.data() + 3 * at * cells);
        scale.add(std::span(batch.terms).first(batch.size), batch.cell.data(), sums);
      });
  };
  integers_.resize(static_cast<std::size_t>(group.parts * part_size));
  const auto tasks = static_cast<std::size_t>(group.blocks() * group.parts);
  if (pass == Pass::Means)
  {
    kept_.assign(tasks, { .most = most_kept / tasks });
  }
  std::vector<Batch> batches(executor_.workers(tasks));
  executor_.parallel_for(
    tasks, [&](std::size_t task, std::size_t worker) { do_task(task, batches[worker]); },
    progress_);
  outside_ = 0;
  for (const Batch& batch : batches)
  {
    outside_ += batch.outside;
  }
  for (std::int64_t part = 1; part < group.parts; ++part)
  {
    const auto from = integers_.begin() + part * part_size;
    std::transform(from, from + part_size, integers_.begin(), integers_.begin(), std::plus<>());
  }
  ranks_.sum({ integers_.data(), static_cast<std::size_t>(part_size) });
}

/// Calls take(cell of the group, place among the wanted ones or -1, volume of the cell, its sums) for each cell that has a grain.
template <class Take>
void AveragePasses::each_cell(const Group& group, const SumScale& scale, const Take& take)
{
  const auto largest = static_cast<std::size_t>(blocks_.largest());
  executor_.parallel_for(
    static_cast<std::size_t>(group.blocks()),
    [&](std::size_t at, std::size_t)
    {
      const std::int64_t block = group.first + static_cast<std::int64_t>(at);
      if (counts_[static_cast<std::size_t>(block)] == 0)
      {
        return;
      }
      std::size_t cell = at * largest;
      blocks_.range(block).each(
        [&](const std::array<std::int64_t, 3>& x)
        {
          take(cell, request_.wanted.place(request_.grid, x), this->volume_of(x),
            scale.values(integers_.data() + cell * scale.size()));
          ++cell;
        });
    },
    progress_);
}

void AveragePasses::finish_means(const Group& group)
{
  means_.resize(static_cast<std::size_t>(3 * group.blocks() * blocks_.largest()));
  EulerCells& cells = result_.cells;
  this->each_cell(group, sums_,
    [&](std::size_t cell, std::int64_t place, double volume, const SumScale::Terms& sums)
    {
      double* const mean = means_.data() + 3 * cell;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        mean[axis] = sums[Mass] > 0 ? sums[MomentumX + axis] / sums[Mass] : 0;
      }
      if (place < 0)
      {
        return;
      }
      const auto to = static_cast<std::size_t>(place);
      std::copy_n(mean, 3, cells.velocities.begin() + 3 * place);
      cells.radius[to] = sums[Share] > 0 ? sums[Radius] / sums[Share] : 0;
      cells.volume_fraction[to] = sums[Volume] / volume;
      if (request_.keep_sums)
      {
        result_.sums.share[to] = sums[Share];
        result_.sums.mass[to] = sums[Mass];
        std::copy_n(&sums[MomentumX], 3, result_.sums.momentum.begin() + 3 * place);
      }
    });
}

void AveragePasses::finish_stress(const Group& group)
{
  EulerCells& cells = result_.cells;
  this->each_cell(group, stresses_,
    [&](std::size_t, std::int64_t place, double volume, const SumScale::Terms& sums)
    {
      if (place < 0)
      {
        return;
      }
      const auto to = static_cast<std::size_t>(place);
      cells.pressure[to] = (0 - (sums[0] + sums[1] + sums[2])) / (3 * volume); // 0, not -0
      for (std::size_t k = 0; stress_ && k < 3; ++k)
      {
        cells.normal_stress[3 * to + k] = sums[k] / volume;
        cells.shear_stress[3 * to + k] = sums[3 + k] / volume;
      }
    });
}
}
