// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing_plan.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

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
constexpr std::int64_t tries_a_report = 4096;

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
  , wanted_(radii.particles())
  , group_(tries_a_group)
{
  std::int64_t tries_left = tries_at_least + tries_a_particle * wanted_;
  std::int64_t most = 0; // particles that found places in one attempt
  PartialProgress never_back(progress);
  for (std::int64_t attempt = 0;
       !this->place_all(RandomNumbers(seed, Stream::Places, attempt), tries_left, never_back);
       ++attempt)
  {
    most = std::max(most, std::ssize(particles_));
    if (tries_left <= 0)
    {
      this->give_up(most);
    }
  }
  group_.clear();
  this->number_by_cells();
}

/// Returns false if a particle finds no place.
bool RandomPacking::place_all(RandomNumbers numbers, std::int64_t& tries_left, Progress& progress)
{
  grids_.clear();
  first_.clear();
  particles_.clear();
  particles_.reserve(static_cast<std::size_t>(wanted_));
  std::size_t end = 0;
  std::int64_t tries = 0;
  for (std::uint32_t size = 0; size < sizes_.size(); ++size)
  {
    this->add_grid(sizes_[size]);
    end += static_cast<std::size_t>(sizes_[size].particles);
    for (std::int64_t idle = 0; particles_.size() < end; tries += tries_a_group)
    {
      if (idle >= idle_tries || tries_left <= 0)
      {
        return false;
      }
      if (tries % tries_a_report == 0)
      {
        progress.step(static_cast<double>(particles_.size()) / static_cast<double>(wanted_));
      }
      const std::size_t before = particles_.size();
      this->place_group(size, end, numbers);
      tries_left -= tries_a_group;
      idle = particles_.size() > before ? 0 : idle + tries_a_group;
    }
  }
  return true;
}

/// Tries places one after the other. Where particles may be in the way is fetched for the whole group before.
void RandomPacking::place_group(std::uint32_t size, std::size_t end, RandomNumbers& numbers)
{
  const double reach = sizes_[size].radius + gap_;
  for (Try& each : group_)
  {
    Vector3 scaled;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double inset = inset_of(box_, axis, reach);
      scaled[axis] = inset + numbers.unit() * (1 - 2 * inset);
    }
    each.at = box_.edge(scaled);
    each.near.clear();
    this->each_cell(each.at, reach, true,
      [&](std::uint32_t cell, const PeriodicImage& image)
      {
        __builtin_prefetch(first_.data() + cell);
        each.near.emplace_back(cell, image);
      });
  }
  for (const Try& each : group_)
  {
    for (const auto& [cell, image] : each.near)
    {
      __builtin_prefetch(particles_.data() + (first_[cell] == none ? 0 : first_[cell]));
    }
  }
  for (const Try& each : group_)
  {
    if (particles_.size() < end && this->fits(each, sizes_[size].radius))
    {
      this->add({ each.at, size, none });
    }
  }
}

bool RandomPacking::fits(const Try& wanted, double radius) const noexcept
{
  for (const auto& [cell, image] : wanted.near)
  {
    const Vector3 at = moved(wanted.at, image, box_, -1);
    for (std::uint32_t i = first_[cell]; i != none; i = particles_[i].next)
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

std::size_t RandomPacking::cell_of(const Grid& grid, const Vector3& at) const noexcept
{
  const Vector3 scaled = box_.scaled(at);
  std::int64_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t count = grid.counts[axis];
    const auto along = static_cast<std::int64_t>(scaled[axis] * static_cast<double>(count));
    cell += std::clamp<std::int64_t>(along, 0, count - 1) * grid.strides[axis];
  }
  return grid.begin + static_cast<std::size_t>(cell);
}

void RandomPacking::add(Particle particle)
{
  std::uint32_t& first = first_[this->cell_of(grids_[particle.size], particle.at)];
  particle.next = std::exchange(first, static_cast<std::uint32_t>(particles_.size()));
  particles_.push_back(particle);
}

/// Visits the cells that may have centres nearer than a distance, each once per image. of_size: and the radius of the grid.
template <class Visit>
void RandomPacking::each_cell(
  const Vector3& at, double distance, bool of_size, const Visit& visit) const
{
  const Vector3 scaled = box_.scaled(at);
  for (const Grid& grid : grids_)
  {
    // more by the rounding of scaled coordinates
    const double reach =
      (distance + (of_size ? grid.radius : 0)) * (1 + 1e-9) + 16 * box_.rounding();
    CellCounts low;
    CellCounts high;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto count = static_cast<double>(grid.counts[axis]);
      const double part = reach / box_.heights[axis];
      low[axis] = static_cast<std::int64_t>(std::floor((scaled[axis] - part) * count));
      high[axis] = static_cast<std::int64_t>(std::floor((scaled[axis] + part) * count));
    }
    for_cells(low, high, grid.counts, box_.periodic,
      [&](const CellCounts& cell, const PeriodicImage& image)
      {
        const std::int64_t place =
          cell[0] * grid.strides[0] + cell[1] * grid.strides[1] + cell[2] * grid.strides[2];
        visit(static_cast<std::uint32_t>(grid.begin + static_cast<std::size_t>(place)), image);
      });
  }
}

/// Sorts the particles by the cells of the largest ones. From then on they are found by their rows.
void RandomPacking::number_by_cells()
{
  std::vector<std::uint32_t> rows(first_.size() + 1); // of the next particle of each cell
  const auto cell = [this](const Particle& particle)
  { return this->cell_of(grids_.front(), particle.at); };
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
    this->add(particle);
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
  this->each_cell(particles_[static_cast<std::size_t>(row)].at, distance, false,
    [&](std::uint32_t cell, const PeriodicImage& image)
    {
      for (std::uint32_t i = first_[cell]; i != none; i = particles_[i].next)
      {
        visit(i, image);
      }
    });
}

void RandomPacking::give_up(std::int64_t most) const
{
  double asked = 0;
  double reached = 0;
  double radius = 0; // of those that found no place
  std::int64_t placed = most;
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
    " when " + std::to_string(most) + " of " + std::to_string(wanted_) +
    " had theirs: expected a solid fraction of at most about 0.3, and less where walls are near, "
    "got " +
    std::to_string(asked) + ", of which " + std::to_string(reached) + " was reached");
}
}
