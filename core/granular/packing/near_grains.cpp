// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/near_grains.h"

#include "granular/common/error.h"

#include <cmath>
#include <limits>
#include <new>
#include <string>

namespace granular
{
NearGrains::NearGrains(const BoxShape& box, double factor, const PlacedGrains& own,
  const std::vector<PlacedGrains>& others)
  : box_(box)
  , factor_(factor * (1 + 1e-10))
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    faces_[k] = cross(box.vectors[(k + 1) % 3], box.vectors[(k + 2) % 3]);
    const double height = dot(faces_[k], box.vectors[k]);
    std::for_each(faces_[k].begin(), faces_[k].end(), [height](double& part) { part /= height; });
  }
  std::vector<PlacedGrains> all = others;
  all.push_back(own);
  double smallest = own.radius[0];
  for (const PlacedGrains& grains : all)
  {
    const auto [least, most] =
      std::minmax_element(grains.radius, grains.radius + grains.rows.count());
    smallest = std::min(smallest, *least);
    largest_ = std::max(largest_, *most);
  }
  for (double radius = largest_; radius >= smallest; radius /= 2)
  {
    levels_.push_back({ radius });
  }
  this->bound(own);
  for (const PlacedGrains& grains : all)
  {
    std::for_each(grains.radius, grains.radius + grains.rows.count(),
      [this](double radius) { ++this->level_of(radius).grains; });
  }
  std::for_each(levels_.begin(), levels_.end(), [this](Level& level) { this->lay(level); });
  this->visit_images(
    all, [](const Grain&, Level& level, std::size_t cell) { ++level.first[cell]; });
  this->add_up();
  // each before those of its cell that are there already: in the end cells begin with their first
  this->visit_images(all,
    [this](const Grain& image, Level& level, std::size_t cell)
    { new (this->grains() + --level.first[cell]) Grain(image); });
}

Vector3 NearGrains::scaled(const Vector3& point) const noexcept
{
  const Vector3 from_origin = { point[0] - box_.origin[0], point[1] - box_.origin[1],
    point[2] - box_.origin[2] };
  return { dot(from_origin, faces_[0]), dot(from_origin, faces_[1]), dot(from_origin, faces_[2]) };
}

/// A distance in scaled coordinates, which are rounded.
double NearGrains::margin(double distance, std::size_t axis) const noexcept
{
  return (distance * (1 + 1e-9) + 16 * box_.rounding()) / box_.heights[axis];
}

/// What is near to any of them is within these bounds.
void NearGrains::bound(const PlacedGrains& own)
{
  low_.fill(std::numeric_limits<double>::infinity());
  high_.fill(-std::numeric_limits<double>::infinity());
  for (std::int64_t i = 0; i < own.rows.count(); ++i)
  {
    const Vector3 place = this->scaled(own.point(i));
    for (std::size_t k = 0; k < 3; ++k)
    {
      low_[k] = std::min(low_[k], place[k]);
      high_[k] = std::max(high_[k], place[k]);
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double reach = this->margin(this->limit(2 * largest_), k);
    low_[k] -= reach;
    high_[k] += reach;
  }
}

NearGrains::Level& NearGrains::level_of(double radius) noexcept
{
  std::size_t at = 0;
  while (at + 1 < levels_.size() && radius <= levels_[at + 1].radius)
  {
    ++at;
  }
  return levels_[at];
}

void NearGrains::lay(Level& level) const
{
  Vector3 widths;
  for (std::size_t k = 0; k < 3; ++k)
  {
    widths[k] = (high_[k] - low_[k]) * box_.heights[k];
  }
  const Vector3 cells = count_cells(widths, level.radius, level.grains);
  for (std::size_t k = 0; k < 3; ++k)
  {
    level.cells[k] = static_cast<std::int64_t>(cells[k]);
    level.scale[k] = cells[k] / (high_[k] - low_[k]);
  }
  level.first.assign(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]) + 1, 0);
}

std::size_t NearGrains::cell_of(const Level& level, const Vector3& scaled) const noexcept
{
  std::int64_t cell = 0;
  for (std::size_t k = 3; k-- > 0;)
  {
    const auto at = static_cast<std::int64_t>((scaled[k] - low_[k]) * level.scale[k]);
    cell = cell * level.cells[k] + std::clamp<std::int64_t>(at, 0, level.cells[k] - 1);
  }
  return static_cast<std::size_t>(cell);
}

/// Calls visit(image, level, cell) for all grains and their images, as far as they are within the bounds.
template <class Visit>
void NearGrains::visit_images(const std::vector<PlacedGrains>& all, const Visit& visit)
{
  for (const PlacedGrains& grains : all)
  {
    for (std::int64_t i = 0; i < grains.rows.count(); ++i)
    {
      Level& level = this->level_of(grains.radius[i]);
      this->visit_images(grains, i,
        [&](const Grain& image, const Vector3& scaled)
        { visit(image, level, this->cell_of(level, scaled)); });
    }
  }
}

/// Calls visit(image, scaled) for one grain and its images.
template <class Visit>
void NearGrains::visit_images(const PlacedGrains& grains, std::int64_t i, const Visit& visit) const
{
  const Vector3 point = grains.point(i);
  const Vector3 place = this->scaled(point);
  std::array<int, 3> from = {};
  std::array<int, 3> to = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    // heights are at least two radii, and bounds six radii away: images are few
    constexpr double most = 8;
    const auto first = static_cast<int>(std::clamp(std::ceil(low_[k] - place[k]), -most, most));
    const auto last = static_cast<int>(std::clamp(std::floor(high_[k] - place[k]), -most, most));
    from[k] = box_.periodic[k] ? first : std::max(first, 0);
    to[k] = box_.periodic[k] ? last : std::min(last, 0);
  }
  for (int z = from[2]; z <= to[2]; ++z)
  {
    for (int y = from[1]; y <= to[1]; ++y)
    {
      for (int x = from[0]; x <= to[0]; ++x)
      {
        const Grain image = { point, grains.radius[i], grains.rows.first + i,
          { static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
            static_cast<std::int8_t>(z) } };
        visit(image, { place[0] + x, place[1] + y, place[2] + z });
      }
    }
  }
}

/// Makes of the numbers of cells their ends, and the memory.
void NearGrains::add_up()
{
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  std::uint64_t end = 0;
  for (Level& level : levels_)
  {
    for (std::uint32_t& first : level.first)
    {
      end += first;
      first = static_cast<std::uint32_t>(std::min(end, most));
    }
  }
  if (end > most)
  {
    throw LimitError("expected less than 2^32 grains a process to find bonds of, got " +
      std::to_string(end) + ", images among them");
  }
  block_ = Block(static_cast<std::size_t>(end) * sizeof(Grain));
}
}
