// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/random_packing.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace granular
{
namespace
{
/// Tries in all attempts. An attempt ends after so many tries in a row without a place: a small box may then need another.
constexpr std::int64_t tries_at_least = 500'000;
constexpr std::int64_t tries_a_particle = 100;
constexpr std::int64_t idle_tries = 20'000;

/// Tries that are drawn together, so that memory is fetched for many of them at once.
constexpr std::int64_t tries_a_group = 32;
constexpr std::int64_t groups_a_report = 128;

/// Returns the distance of centres from a face in scaled coordinates; 0.5 where only a plane is left between two faces.
double inset_of(const BoxShape& box, std::size_t axis, double distance)
{
  constexpr double flat = 1e-12;
  const double part = distance / box.heights[axis];
  return box.periodic[axis] ? 0 : part > 0.5 - flat / 2 ? 0.5 : part;
}
}

RandomPacking::RandomPacking(
  const BoxShape& box, const Radii& radii, std::uint64_t seed, Progress& progress)
  : box_(box)
  , gap_(4 * box.rounding())
  , sizes_(radii.by_size())
  , group_(tries_a_group)
{
  for (const SizeClass& size : sizes_)
  {
    wanted_ += size.particles;
  }
  tries_left_ = tries_at_least + tries_a_particle * wanted_;
  PartialProgress never_back(progress);
  for (std::int64_t attempt = 0;
       !this->place_all(RandomNumbers(seed, Stream::Places, attempt), never_back); ++attempt)
  {
    if (tries_left_ <= 0)
    {
      this->give_up();
    }
  }
  group_.clear();
  this->number_by_cells();
}

/// Returns false if a particle finds no place.
bool RandomPacking::place_all(RandomNumbers numbers, Progress& progress)
{
  grids_.clear();
  first_.clear();
  particles_.clear();
  particles_.reserve(static_cast<std::size_t>(wanted_));
  std::size_t end = 0;
  std::int64_t groups = 0;
  for (std::uint32_t size = 0; size < sizes_.size(); ++size)
  {
    this->add_grid(sizes_[size]);
    end += static_cast<std::size_t>(sizes_[size].particles);
    for (std::int64_t idle = 0; particles_.size() < end;)
    {
      if (idle >= idle_tries || tries_left_ <= 0)
      {
        return false;
      }
      if (groups++ % groups_a_report == 0)
      {
        progress.step(static_cast<double>(particles_.size()) / static_cast<double>(wanted_));
      }
      const std::size_t before = particles_.size();
      this->place_group(size, end, numbers);
      tries_left_ -= tries_a_group;
      idle = particles_.size() > before ? 0 : idle + tries_a_group;
      most_ = std::max(most_, static_cast<std::int64_t>(particles_.size()));
    }
  }
  return true;
}

/// Tries places one after the other. Where particles may be in the way is fetched for the whole group before.
void RandomPacking::place_group(std::uint32_t size, std::size_t end, RandomNumbers& numbers)
{
  const double radius = sizes_[size].radius;
  for (Try& wanted : group_)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double inset = inset_of(box_, axis, radius + gap_);
      wanted.scaled[axis] = inset + numbers.unit() * (1 - 2 * inset);
    }
    wanted.at = box_.edge(wanted.scaled);
    wanted.near.clear();
    this->each_near(wanted.scaled, radius + gap_, true,
      [&](const NearCell& near)
      {
        __builtin_prefetch(first_.data() + near.cell);
        wanted.near.push_back(near);
      });
  }
  for (const Try& wanted : group_)
  {
    for (const NearCell& near : wanted.near)
    {
      const std::uint32_t first = first_[near.cell];
      __builtin_prefetch(particles_.data() + (first == none ? 0 : first));
    }
  }
  for (const Try& wanted : group_)
  {
    if (particles_.size() < end && this->fits(wanted, radius))
    {
      this->add(wanted.scaled, { wanted.at, size, none });
    }
  }
}

bool RandomPacking::fits(const Try& wanted, double radius) const noexcept
{
  for (const NearCell& near : wanted.near)
  {
    const Vector3 at = moved(wanted.at, near.image, box_, -1);
    for (std::uint32_t i = first_[near.cell]; i != none; i = particles_[i].next)
    {
      const Particle& other = particles_[i];
      const Vector3 way = { other.at[0] - at[0], other.at[1] - at[1], other.at[2] - at[2] };
      const double clear = radius + sizes_[other.size].radius + gap_;
      if (dot(way, way) < clear * clear)
      {
        return false;
      }
    }
  }
  return true;
}

/// Adds cells of two radii, but not many more than there are particles. The highest axis of the box has the largest stride.
void RandomPacking::add_grid(const SizeClass& size)
{
  const double most = 2 * static_cast<double>(size.particles) + 64;
  Vector3 counts;
  std::ranges::transform(box_.heights, counts.begin(),
    [&](double height) { return std::clamp(std::floor(height / (2 * size.radius)), 1.0, most); });
  while (counts[0] * counts[1] * counts[2] > most)
  {
    double& longest = *std::ranges::max_element(counts);
    longest = std::max(1.0, std::floor(longest * 0.9));
  }
  Grid grid = { size.radius, first_.size() };
  std::array<std::size_t, 3> order = { 0, 1, 2 };
  std::ranges::stable_sort(order, {}, [this](std::size_t axis) { return box_.heights[axis]; });
  std::int64_t cells = 1;
  for (const std::size_t axis : order)
  {
    grid.counts[axis] = static_cast<std::int64_t>(counts[axis]);
    grid.strides[axis] = cells;
    cells *= grid.counts[axis];
  }
  first_.resize(first_.size() + static_cast<std::size_t>(cells), none);
  grids_.push_back(grid);
}

std::size_t RandomPacking::cell_of(const Grid& grid, const Vector3& scaled) noexcept
{
  std::size_t cell = grid.begin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t count = grid.counts[axis];
    const auto at = static_cast<std::int64_t>(scaled[axis] * static_cast<double>(count));
    cell +=
      static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, count - 1) * grid.strides[axis]);
  }
  return cell;
}

void RandomPacking::add(const Vector3& scaled, Particle particle)
{
  std::uint32_t& first = first_[cell_of(grids_[particle.size], scaled)];
  particle.next = std::exchange(first, static_cast<std::uint32_t>(particles_.size()));
  particles_.push_back(particle);
}

/// Visits the cells that may have centres nearer than a distance, each once per image. of_size: and the radius of the grid.
template <class Visit>
void RandomPacking::each_near(
  const Vector3& scaled, double distance, bool of_size, const Visit& visit) const
{
  for (const Grid& grid : grids_)
  {
    std::array<std::int64_t, 3> low;
    std::array<std::int64_t, 3> high;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto count = static_cast<double>(grid.counts[axis]);
      // more by the rounding of scaled coordinates
      const double reach =
        ((distance + (of_size ? grid.radius : 0)) * (1 + 1e-9) + 16 * box_.rounding()) /
        box_.heights[axis];
      low[axis] = static_cast<std::int64_t>(std::floor((scaled[axis] - reach) * count));
      high[axis] = static_cast<std::int64_t>(std::floor((scaled[axis] + reach) * count));
      if (!box_.periodic[axis])
      {
        low[axis] = std::max<std::int64_t>(low[axis], 0);
        high[axis] = std::min(high[axis], grid.counts[axis] - 1);
      }
    }
    NearCell near = {};
    const auto offset = [&](std::size_t axis, std::int64_t cell)
    {
      const std::int64_t count = grid.counts[axis];
      const std::int64_t away = image_of(cell, count);
      near.image[axis] = static_cast<std::int8_t>(away);
      return static_cast<std::size_t>((cell - away * count) * grid.strides[axis]);
    };
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
    {
      const std::size_t layer = grid.begin + offset(2, z);
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
      {
        const std::size_t line = layer + offset(1, y);
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
        {
          near.cell = static_cast<std::uint32_t>(line + offset(0, x));
          visit(near);
        }
      }
    }
  }
}

/// Sorts the particles by the cells of the largest ones. From then on they are found by their rows.
void RandomPacking::number_by_cells()
{
  const auto cell = [this](const Particle& particle)
  { return cell_of(grids_.front(), box_.scaled(particle.at)); };
  std::vector<std::uint32_t> rows(first_.size() + 1); // of the next particle of each cell
  for (const Particle& particle : particles_)
  {
    ++rows[cell(particle) + 1];
  }
  std::partial_sum(rows.begin(), rows.end(), rows.begin());
  std::vector<Particle> sorted(particles_.size());
  for (const Particle& particle : particles_)
  {
    sorted[rows[cell(particle)]++] = particle;
  }
  particles_.clear();
  std::ranges::fill(first_, none);
  for (const Particle& particle : sorted)
  {
    this->add(box_.scaled(particle.at), particle);
  }
}

PlacedParticle RandomPacking::particle(std::int64_t row) const noexcept
{
  const Particle& found = particles_[static_cast<std::size_t>(row)];
  const SizeClass& size = sizes_[found.size];
  return { { box_.origin[0] + found.at[0], box_.origin[1] + found.at[1],
             box_.origin[2] + found.at[2] },
    size.radius, size.type };
}

void RandomPacking::visit_near(std::int64_t row, double distance, const VisitNear& visit) const
{
  this->each_near(box_.scaled(particles_[static_cast<std::size_t>(row)].at), distance, false,
    [&](const NearCell& near)
    {
      for (std::uint32_t i = first_[near.cell]; i != none; i = particles_[i].next)
      {
        visit(i, near.image);
      }
    });
}

void RandomPacking::give_up() const
{
  double asked = 0;
  double reached = 0;
  double radius = 0; // of those that found no place
  std::int64_t placed = most_;
  for (const SizeClass& size : sizes_)
  {
    const double fraction = 4.0 / 3 * std::numbers::pi * std::pow(size.radius, 3) / box_.volume;
    const std::int64_t found = std::min(placed, size.particles);
    placed -= found;
    asked += fraction * static_cast<double>(size.particles);
    reached += fraction * static_cast<double>(found);
    radius = radius == 0 && found < size.particles ? size.radius : radius;
  }
  throw LimitError("no place was found for a random grain of radius " + std::to_string(radius) +
    " when " + std::to_string(most_) + " of " + std::to_string(wanted_) +
    " had theirs: expected a solid fraction of at most about 0.3, and less where walls are near, "
    "got " +
    std::to_string(asked) + ", of which " + std::to_string(reached) + " was reached");
}
}
