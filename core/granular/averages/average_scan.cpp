// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/average_passes.h"
#include "granular/common/shares.h"
#include "granular/grid/sphere_box.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace granular
{
namespace
{
using Rows = std::span<const std::int64_t>;

constexpr std::int64_t rows_of_block = ParticleBlock::most_rows;
constexpr std::int64_t rows_of_chunk = 65536;

/// Bits below the largest possible term of a stress in a cell in which its terms still count.
constexpr int stress_bits = 192;
}

/// Calls take(rows, chunk, worker, particles) for the rows of so many chunks, some at a time; particles: room for them.
template <class Take>
void AveragePasses::each_block(std::size_t chunks, const Take& take)
{
  executor_.parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t worker)
    {
      ParticleBlock particles;
      std::array<std::int64_t, ParticleBlock::most_rows> buffer;
      const std::int64_t start = static_cast<std::int64_t>(chunk) * rows_of_chunk;
      const std::int64_t end = std::min(start + rows_of_chunk, frame_.rows);
      for (std::int64_t first = start; first < end; first += rows_of_block)
      {
        const std::span<std::int64_t> rows =
          std::span(buffer).first(static_cast<std::size_t>(std::min(rows_of_block, end - first)));
        std::iota(rows.begin(), rows.end(), first);
        take(rows, chunk, worker, particles);
      }
    },
    progress_);
}

void AveragePasses::scan()
{
  const auto chunks = static_cast<std::size_t>((frame_.rows + rows_of_chunk - 1) / rows_of_chunk);
  std::vector<ParticleLoader::Scan> scans(executor_.workers(chunks));
  this->each_block(chunks,
    [&](Rows rows, std::size_t, std::size_t worker, ParticleBlock& particles)
    { particles_.scan(rows, particles, scans[worker]); });
  for (const ParticleLoader::Scan& scan : scans)
  {
    scanned_.add(scan);
  }
  particles_.trust(scanned_);
  for (const ParticleLoader::Scan& scan : gather(ranks_, std::exchange(scanned_, {})))
  {
    scanned_.add(scan);
  }
  result_.broken = scanned_.broken;
}

/// In which blocks particles are; a single one has them all.
void AveragePasses::locate()
{
  const auto chunks = static_cast<std::size_t>((frame_.rows + rows_of_chunk - 1) / rows_of_chunk);
  std::vector<std::vector<BlockRows::Entry>> entries(blocks_.blocks() > 1 ? chunks : 0);
  std::vector<std::int64_t> counts(executor_.workers(entries.size()));
  this->each_block(entries.size(),
    [&](Rows rows, std::size_t chunk, std::size_t worker, ParticleBlock& particles)
    {
      particles_.load(rows, particles);
      const std::int64_t first = rows.front() % rows_of_chunk;
      for (std::size_t i = 0; i < particles.rows; ++i)
      {
        const auto row = static_cast<std::uint32_t>(first + static_cast<std::int64_t>(i));
        const bool inside = !particles.uses(i) ||
          blocks_.add_entries(row, entries[chunk],
            [&](const auto& visit)
            { cells_.each_range(particles.positions + 3 * i, particles.radius[i], visit); });
        counts[worker] += inside ? 0 : 1;
      }
    });
  result_.outside = sum_of(counts);
  blocks_.set_rows(blocks_.blocks() > 1
      ? BlockRows::sorted(entries, rows_of_chunk, blocks_.blocks())
      : BlockRows::all(frame_.rows));
  found_.resize(cells_.is_direct() ? static_cast<std::size_t>(blocks_.rows().size()) : 0);
  ranks_.sum({ &result_.outside, 1 });
}

/// Plans the sums and the cells that they are for.
void AveragePasses::plan()
{
  const double radius = scanned_.radius.largest();
  const std::int64_t terms = rows_ * cells_.check(radius);
  cells_.set_largest_volume(sphere_volume(radius));
  const int quantum = cells_.quantum();
  const SumScale::Range mass = scanned_.mass.range(quantum);
  const SumScale::Range speed = scanned_.speed.range(0);
  const SumScale::Range momentum = { mass.top + speed.top, mass.bottom + speed.bottom };
  largest_mass_ = scanned_.mass.largest() > 0 ? scanned_.mass.largest() : 1;
  Magnitudes speeds = scanned_.speed; // see ParticleBlock::speed
  const double stressed[] = { std::sqrt(scanned_.stress.largest()) / std::sqrt(largest_mass_),
    std::sqrt(scanned_.stress.smallest()) / std::sqrt(largest_mass_) };
  speeds.add(stressed, 2);
  mass_top_ = std::ilogb(largest_mass_) + 1;
  speed_top_ = speeds.range(0).top;
  Magnitudes volumes; // that of the smallest one may be less than any number
  const double volume[] = { sphere_volume(radius), sphere_volume(scanned_.radius.smallest()) };
  volumes.add(volume, 2);
  sums_ = SumScale({ { { 1, quantum }, mass, momentum, momentum, momentum,
                     scanned_.radius.range(quantum), volumes.range(quantum), speeds.range(0) } },
    terms);
  std::array<SumScale::Range, SumScale::lanes> ranges;
  ranges.fill({ 0, -stress_bits });   // see stress_scale
  ranges[6] = { 1, 1 - stress_bits }; // of all three squares
  stresses_ = SumScale(ranges, terms);

  this->make_cells();
}

/// The wanted cells, empty.
void AveragePasses::make_cells()
{
  const EulerGrid& grid = request_.grid;
  EulerCells& cells = result_.cells;
  EulerSums& sums = result_.sums;
  const std::int64_t wanted = request_.wanted.count(grid);
  const auto kept = request_.keep_sums ? static_cast<std::size_t>(wanted) : 0;
  result_.make_room(wanted, tensors_, request_.fields);
  sums.share.resize(kept);
  sums.mass.resize(kept);
  sums.momentum.resize(3 * kept);
  sums.volume.resize(kept);
  request_.wanted.range.each(
    [&](const std::array<std::int64_t, 3>& cell)
    {
      const std::int64_t place = request_.wanted.place(grid, cell);
      const auto to = static_cast<std::size_t>(place);
      for (std::size_t axis = 0; place >= 0 && axis < 3; ++axis)
      {
        cells.centres[3 * to + axis] = grid.centre(axis, cell[axis]);
      }
      if (place >= 0 && kept > 0)
      {
        sums.volume[to] = blocks_.volume_of(cell);
      }
    });
}
}
