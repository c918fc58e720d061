// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/near_grains.h"

#include "granular/base/error.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace granular
{
namespace
{
Vector3 cross(const Vector3& a, const Vector3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::array<double, 2> radii_of(const PlacedGrains& own, const std::vector<PlacedGrains>& others)
{
  std::array<double, 2> range = { own.radius[0], own.radius[0] };
  const auto add = [&range](const PlacedGrains& grains)
  {
    const auto [least, most] =
      std::minmax_element(grains.radius, grains.radius + grains.rows.count());
    range = { std::min(range[0], *least), std::max(range[1], *most) };
  };
  add(own);
  std::for_each(others.begin(), others.end(), add);
  return range;
}
}

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
  const auto [smallest, largest] = radii_of(own, others);
  largest_ = largest;
  for (double radius = largest; radius >= smallest; radius /= 2)
  {
    levels_.push_back({ radius });
  }
  this->bound(own);
  this->add(own);
  std::for_each(
    others.begin(), others.end(), [this](const PlacedGrains& grains) { this->add(grains); });
  for (Level& level : levels_)
  {
    this->lay(level);
    this->sort(level);
  }
}

Vector3 NearGrains::scaled(const double* point) const noexcept
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
    const Vector3 place = this->scaled(own.points + 3 * i);
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

void NearGrains::add(const PlacedGrains& grains)
{
  for (std::int64_t i = 0; i < grains.rows.count(); ++i)
  {
    const Grain grain = { {}, grains.radius[i], grains.rows.first + i, {} };
    this->add_images(grains.points + 3 * i, grain);
  }
}

/// A grain and its images, as far as they are within the bounds.
void NearGrains::add_images(const double* point, const Grain& grain)
{
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
  std::size_t at = 0;
  while (at + 1 < levels_.size() && grain.radius <= levels_[at + 1].radius)
  {
    ++at;
  }
  for (int z = from[2]; z <= to[2]; ++z)
  {
    for (int y = from[1]; y <= to[1]; ++y)
    {
      for (int x = from[0]; x <= to[0]; ++x)
      {
        const Vector3 edge =
          box_.edge({ static_cast<double>(x), static_cast<double>(y), static_cast<double>(z) });
        Grain image = grain;
        image.point = { point[0] + edge[0], point[1] + edge[1], point[2] + edge[2] };
        image.image = { static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
          static_cast<std::int8_t>(z) };
        levels_[at].grains.push_back(image);
      }
    }
  }
}

/// Cells as large as two grains, but not many more than grains.
void NearGrains::lay(Level& level) const
{
  const double most = 2 * static_cast<double>(level.grains.size()) + 64;
  Vector3 cells;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double width = (high_[k] - low_[k]) * box_.heights[k];
    cells[k] = std::clamp(std::floor(width / (2 * level.radius)), 1.0, most);
  }
  while (cells[0] * cells[1] * cells[2] > most)
  {
    double& longest = *std::max_element(cells.begin(), cells.end());
    longest = std::max(1.0, std::floor(longest * 0.9));
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    level.cells[k] = static_cast<std::int64_t>(cells[k]);
    level.scale[k] = cells[k] / (high_[k] - low_[k]);
  }
}

/// By counting, cell by cell.
void NearGrains::sort(Level& level) const
{
  if (level.grains.size() >= std::numeric_limits<std::uint32_t>::max())
  {
    throw LimitError("expected less than 2^32 grains a process to find bonds of, got " +
      std::to_string(level.grains.size()));
  }
  const auto cell_of = [&](const Grain& grain)
  {
    const Vector3 place = this->scaled(grain.point.data());
    std::int64_t cell = 0;
    for (std::size_t k = 3; k-- > 0;)
    {
      const auto at = static_cast<std::int64_t>((place[k] - low_[k]) * level.scale[k]);
      cell = cell * level.cells[k] + std::clamp<std::int64_t>(at, 0, level.cells[k] - 1);
    }
    return static_cast<std::size_t>(cell);
  };
  const auto cells = static_cast<std::size_t>(level.cells[0] * level.cells[1] * level.cells[2]);
  level.first.assign(cells + 1, 0);
  for (const Grain& grain : level.grains)
  {
    ++level.first[cell_of(grain)];
  }
  std::uint32_t end = 0;
  for (std::uint32_t& first : level.first)
  {
    end += first;
    first = end; // of the cell; each grain that is put there goes before the others
  }
  std::vector<Grain> sorted(level.grains.size());
  for (const Grain& grain : level.grains)
  {
    sorted[--level.first[cell_of(grain)]] = grain;
  }
  level.grains = std::move(sorted);
}
}
