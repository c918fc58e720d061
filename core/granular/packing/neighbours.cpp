// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/neighbours.h"

#include <algorithm>
#include <cmath>

namespace granular
{
void Neighbours::start(const BoxShape& box, const Vector3& low, const Vector3& high,
  double smallest, double largest, double gap, double grains)
{
  box_ = &box;
  low_ = low;
  high_ = high;
  gap_ = gap;
  grains_.clear();
  levels_used_ = 0;
  for (double radius = largest; radius >= smallest || levels_used_ == 0; radius /= 2)
  {
    if (levels_used_ == levels_.size())
    {
      levels_.emplace_back();
    }
    Level& level = levels_[levels_used_++];
    level.radius = radius;
    this->lay(level, grains);
  }
}

/// Cells as large as two grains, but not many more than grains.
void Neighbours::lay(Level& level, double grains) const
{
  const double most = 4 * grains + 64;
  Vector3 cells;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double width = (high_[k] - low_[k]) * box_->heights[k];
    cells[k] = std::clamp(std::floor(width / (2 * level.radius)), 1.0, most);
  }
  while (cells[0] * cells[1] * cells[2] > most)
  {
    double& longest = *std::max_element(cells.begin(), cells.end());
    longest = std::max(1.0, std::floor(longest / 2));
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    level.cells[k] = static_cast<int>(cells[k]);
    level.scale[k] = cells[k] / (high_[k] - low_[k]);
  }
  level.first.assign(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]), none);
}

bool Neighbours::holds(const Vector3& scaled) const noexcept
{
  return scaled[0] >= low_[0] && scaled[0] <= high_[0] && scaled[1] >= low_[1] &&
    scaled[1] <= high_[1] && scaled[2] >= low_[2] && scaled[2] <= high_[2];
}

Vector3 Neighbours::from_low(const Vector3& scaled) const noexcept
{
  return box_->edge({ scaled[0] - low_[0], scaled[1] - low_[1], scaled[2] - low_[2] });
}

std::size_t Neighbours::cell_of(const Level& level, const Vector3& scaled) const noexcept
{
  std::size_t cell = 0;
  for (std::size_t k = 3; k-- > 0;)
  {
    const int place = static_cast<int>((scaled[k] - low_[k]) * level.scale[k]);
    cell = cell * static_cast<std::size_t>(level.cells[k]) +
      static_cast<std::size_t>(std::clamp(place, 0, level.cells[k] - 1));
  }
  return cell;
}

void Neighbours::add(const Vector3& scaled, double radius)
{
  std::size_t at = 0;
  while (at + 1 < levels_used_ && radius <= levels_[at + 1].radius)
  {
    ++at;
  }
  Level& level = levels_[at];
  const std::size_t cell = this->cell_of(level, scaled);
  const auto grain = static_cast<std::int32_t>(grains_.size());
  grains_.push_back({ this->from_low(scaled), radius, level.first[cell] });
  level.first[cell] = grain;
}

bool Neighbours::is_clear(std::int32_t first, const Vector3& centre, double radius) const noexcept
{
  for (std::int32_t i = first; i != none;)
  {
    const Grain& grain = grains_[static_cast<std::size_t>(i)];
    const double x = grain.centre[0] - centre[0];
    const double y = grain.centre[1] - centre[1];
    const double z = grain.centre[2] - centre[2];
    const double least = radius + grain.radius + gap_;
    if (x * x + y * y + z * z < least * least)
    {
      return false;
    }
    i = grain.next;
  }
  return true;
}

bool Neighbours::has_room(const Vector3& scaled, double radius) const noexcept
{
  const Vector3 centre = this->from_low(scaled);
  for (std::size_t at = 0; at < levels_used_; ++at)
  {
    const Level& level = levels_[at];
    const std::size_t own = this->cell_of(level, scaled);
    if (!this->is_clear(level.first[own], centre, radius)) // most of what is in the way is here
    {
      return false;
    }
    std::array<int, 3> from = {};
    std::array<int, 3> to = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double place = (scaled[k] - low_[k]) * level.scale[k];
      const double reach = (radius + level.radius + gap_) / box_->heights[k] * level.scale[k];
      from[k] = static_cast<int>(std::max(place - reach, 0.0));
      to[k] = std::min(static_cast<int>(place + reach), level.cells[k] - 1);
    }
    for (int z = from[2]; z <= to[2]; ++z)
    {
      for (int y = from[1]; y <= to[1]; ++y)
      {
        const auto row = static_cast<std::size_t>((z * level.cells[1] + y) * level.cells[0]);
        for (int x = from[0]; x <= to[0]; ++x)
        {
          const std::int32_t first = level.first[row + static_cast<std::size_t>(x)];
          if (first != none && !this->is_clear(first, centre, radius))
          {
            return false;
          }
        }
      }
    }
  }
  return true;
}
}
