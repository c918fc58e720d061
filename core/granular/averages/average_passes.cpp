// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/average_passes.h"

#include "granular/grid/sphere_box.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace granular
{
namespace
{
/// Shares of a group that the first pass keeps for the second: 256 MiB.
constexpr std::size_t most_kept = std::size_t{ 1 } << 24;

/// Places of the sums of each quantity.
enum Lane : std::size_t
{
  Share,
  Mass,
  MomentumX,
  MomentumY,
  MomentumZ,
  Radius,
  Volume,
  Speed
};
}

/// Shares of particles in cells of a block, some at a time.
struct AveragePasses::Batch
{
  static constexpr std::size_t most = ParticleBlock::most_rows;

  ParticleBlock particles;
  std::array<std::int64_t, most> rows;
  ParticleCells::Shares shares;

  std::int64_t outside = 0; ///< particles that had no share
  std::size_t size = 0;
  std::array<std::size_t, most> particle; ///< of particles
  std::array<std::int64_t, most> cell;    ///< of the block
  std::array<double, most> share;
  std::array<double, most> volume;
  std::array<SumScale::Terms, most> terms;

  /// All particles, each whole in its cell; the stress needs no volumes.
  void fill_whole(Pass pass) noexcept
  {
    size = particles.rows;
    std::iota(particle.begin(), particle.end(), std::size_t{ 0 });
    share.fill(1);
    for (std::size_t i = 0; pass == Pass::Means && i < size; ++i)
    {
      volume[i] = sphere_volume(particles.radius[i]);
    }
  }
};

AveragePasses::AveragePasses(const FrameView& frame, const ParticleSources& sources,
  std::int64_t rows, const EulerAverageRequest& request, Communicator& ranks,
  const Executor& executor, Progress& progress)
  : frame_(frame)
  , rows_(rows)
  , request_(request)
  , ranks_(ranks)
  , executor_(executor)
  , progress_(progress)
  , particles_(frame, sources)
  , cells_(request.grid, request.cells, frame.has_box ? &frame.header.box : nullptr)
  , blocks_(request.grid, request.wanted, ranks, executor, progress_)
  , stress_(!request.arrays.stress.empty())
  , tensors_(stress_ || request.tensors)
{
}

EulerAverages AveragePasses::run()
{
  progress_.set_part(0, 0.2);
  this->scan();
  this->plan();
  progress_.set_part(0.2, 0.3);
  this->locate();
  const std::vector<Group> groups = blocks_.make_groups(std::max(sums_.size(), stresses_.size()));
  const auto count = static_cast<double>(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    progress_.set_part(
      0.3 + 0.7 * static_cast<double>(i) / count, 0.3 + 0.7 * static_cast<double>(i + 1) / count);
    this->sum_group(groups[i]);
  }
  return std::move(result_);
}

void AveragePasses::sum_group(const Group& group)
{
  this->add_particles(Pass::Means, group,
    [this](Batch& batch, const Mean*)
    {
      const ParticleBlock& particles = batch.particles;
      for (std::size_t n = 0; n < batch.size; ++n)
      {
        const std::size_t i = batch.particle[n];
        const double* const v = particles.velocities + 3 * i;
        const double mass = particles.mass[i] * batch.share[n];
        batch.terms[n] = { batch.share[n], mass, mass * v[0], mass * v[1], mass * v[2],
          particles.radius[i] * batch.share[n], batch.volume[n],
          particles.speed(i, largest_mass_) };
      }
    });
  if (blocks_.blocks() == 1) // nobody looked where particles are
  {
    ranks_.sum({ &outside_, 1 });
    result_.outside = outside_;
  }
  this->finish_means(group);
  if (!request_.pressure && !tensors_ && !request_.fields.temperature)
  {
    return;
  }
  this->add_particles(Pass::Stress, group,
    [](Batch& batch, const Mean* means)
    {
      const ParticleBlock& particles = batch.particles;
      for (std::size_t n = 0; n < batch.size; ++n)
      {
        const std::size_t i = batch.particle[n];
        const auto& [mean, scale] = means[batch.cell[n]];
        const auto terms =
          fluctuation_terms(particles.mass[i] * batch.share[n], particles.velocities + 3 * i, mean);
        std::ranges::copy(terms, batch.terms[n].begin());
        batch.terms[n].back() = 0;
        for (std::size_t k = 0; particles.stresses && k < 6; ++k)
        {
          batch.terms[n][k] += particles.stresses[6 * i + k] * batch.share[n];
        }
        for (double& term : batch.terms[n])
        {
          term *= scale;
        }
      }
    });
  this->finish_stress(group);
}

/// The cells of particles that have one each, whose places among those of all blocks begin there. The first pass keeps
/// what it finds for the second. Whether all have one.
bool AveragePasses::find_cells(std::int64_t place, const CellRange& range, Pass pass, Batch& batch)
{
  const auto found = found_.begin() + place;
  const std::size_t count = batch.particles.rows;
  if (pass == Pass::Means)
  {
    const bool all =
      cells_.finder().find({ batch.particles.positions, 3 * count }, range, batch.cell.data());
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
  const ParticleBlock& particles = batch.particles;
  const auto add = [&](std::size_t particle, std::int64_t cell, double share, double volume)
  {
    batch.particle[batch.size] = particle;
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
      blocks_.rows().rows(part.block, first, part.last, batch.rows);
    particles_.load(rows, batch.particles);
    const auto before = static_cast<std::uint64_t>(first - part.first);
    const std::int64_t place = blocks_.rows().start(part.block) + first;
    first += static_cast<std::int64_t>(rows.size());
    if (!found_.empty() && !particles.usable && this->find_cells(place, range, pass, batch))
    {
      batch.fill_whole(pass);
    }
    else if (pass == Pass::Stress && kept.complete)
    {
      for (; next != kept.shares.end() && next->particle - before < particles.rows; ++next)
      {
        add(next->particle - before, next->cell, next->share, 0); // volumes are summed up already
      }
    }
    else
    {
      for (std::size_t i = 0; i < particles.rows; ++i)
      {
        if (!particles.uses(i))
        {
          continue;
        }
        bool inside = false;
        cells_.each_share(particles.positions + 3 * i, particles.radius[i], range, batch.shares,
          [&](std::int64_t cell, double share, double volume)
          {
            inside = true;
            kept.add(before + i, cell, share);
            add(i, cell, share, volume);
          });
        if (!inside)
        {
          cells_.each_range(particles.positions + 3 * i, particles.radius[i],
            [&](const CellRange&) { inside = true; }); // so little that its share is 0
          batch.outside += inside ? 0 : 1;
        }
      }
    }
    take();
    batch.size = 0;
  }
}

/// Sums over the particles of all ranks in the cells of a group; make_terms fills the terms of a batch and knows the means
/// of its block.
template <class MakeTerms>
void AveragePasses::add_particles(Pass pass, const Group& group, const MakeTerms& make_terms)
{
  const SumScale& scale = pass == Pass::Means ? sums_ : stresses_;
  const std::int64_t cells = blocks_.largest();
  if (pass == Pass::Means)
  {
    kept_.assign(group.tasks(), { .most = most_kept / group.tasks() });
  }
  std::vector<Batch> batches(executor_.workers(group.tasks()));
  blocks_.add(group, scale, batches,
    [&](const Part& part, std::size_t task, Batch& batch, std::int64_t* sums)
    {
      this->each_batch(pass, part, batch, kept_[task],
        [&]
        {
          make_terms(batch, means_.data() + part.place * cells);
          scale.add(std::span(batch.terms).first(batch.size), batch.cell.data(), sums);
        });
    });
  outside_ = 0;
  for (const Batch& batch : batches)
  {
    outside_ += batch.outside;
  }
}

void AveragePasses::finish_means(const Group& group)
{
  means_.resize(static_cast<std::size_t>(group.blocks() * blocks_.largest()));
  masses_.resize(request_.fields.temperature ? means_.size() : 0);
  blocks_.each_cell(group, sums_,
    [&](std::size_t cell, std::int64_t place, double volume, const SumScale::Terms& sums)
    {
      auto& [mean, scale] = means_[cell];
      scale = this->stress_scale(sums);
      if (request_.fields.temperature)
      {
        masses_[cell] = sums[Mass];
      }
      mean = mean_velocity(&sums[Mass]);
      if (place < 0)
      {
        return;
      }
      const auto to = static_cast<std::size_t>(place);
      result_.store_means(to, sums.data(), mean, volume);
      if (request_.keep_sums)
      {
        result_.sums.share[to] = sums[Share];
        result_.sums.mass[to] = sums[Mass];
        std::copy_n(&sums[MomentumX], 3, result_.sums.momentum.begin() + 3 * place);
      }
    });
}

/// Returns the scale of a cell, by its own sums where these are less than what there is anywhere.
double AveragePasses::stress_scale(const SumScale::Terms& sums) const noexcept
{
  const auto top_of = [](double sum, int largest)
  { return sum > 0 ? std::min(std::ilogb(sum) + 1, largest) : largest; };
  const int mass = stress_ ? mass_top_ : top_of(sums[Mass], mass_top_);
  const int difference = top_of(sums[Speed], speed_top_) + 1; // of two speeds
  constexpr int least = -900;                                 // for a scale that is a number
  return std::ldexp(1, -std::max(mass + 2 * difference + 1, least));
}

void AveragePasses::finish_stress(const Group& group)
{
  blocks_.each_wanted(group, stresses_,
    [&](std::size_t cell, std::size_t place, double volume, SumScale::Terms sums)
    {
      for (double& sum : sums)
      {
        sum /= means_[cell].scale;
      }
      result_.store_fluctuations(place, sums.data(), masses_.empty() ? 0 : masses_[cell], volume);
    });
}
}
