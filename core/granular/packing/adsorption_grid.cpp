// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/adsorption_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace granular
{
namespace
{
/// What is left between two faces is a plane.
constexpr double flat = 1e-12;
}

AdsorptionGrid::AdsorptionGrid(const BoxShape& box, std::vector<SizeClass> classes)
  : box_(box)
  , gap_(4 * box.rounding())
  , classes_(std::move(classes))
{
  std::sort(order_.begin(), order_.end(),
    [&box](std::size_t a, std::size_t b)
    { return std::pair(box.heights[a], a) < std::pair(box.heights[b], b); });
  for (std::size_t place = 0; place < 3; ++place)
  {
    constexpr double slack = 1 + 1e-9; // for the rounding of scaled coordinates
    per_height_[place] = slack / box.heights[order_[place]];
  }
  for (const SizeClass& each : classes_)
  {
    if (levels_.empty() || each.radius <= levels_.back().radius / 2)
    {
      levels_.push_back({ each.radius });
    }
    levels_.back().smallest = each.radius;
    levels_.back().grains += each.grains;
    level_of_.push_back(levels_.size() - 1);
    insets_.push_back({ inset(each.radius, 0), inset(each.radius, 1), inset(each.radius, 2) });
  }
  for (Level& level : levels_)
  {
    this->lay(level);
    shelves_ = std::max(shelves_, level.cells[2]);
    deepest_ = std::max(deepest_, 1 / static_cast<double>(level.cells[2]));
  }
}

/// How far from a face centres are, in units of the height.
double AdsorptionGrid::inset(double radius, std::size_t place) const noexcept
{
  const std::size_t axis = order_[place];
  const double least = std::min((radius + gap_) / box_.heights[axis], 0.5);
  return box_.periodic[axis] ? 0 : 1 - 2 * least < flat ? 0.5 : least;
}

void AdsorptionGrid::lay(Level& level) const
{
  Vector3 widths;
  for (std::size_t place = 0; place < 3; ++place)
  {
    widths[place] = box_.heights[order_[place]] * (1 - 2 * this->inset(level.smallest, place));
  }
  const Vector3 cells = count_cells(widths, level.radius, level.grains);
  for (std::size_t place = 0; place < 3; ++place)
  {
    level.cells[place] = static_cast<std::int64_t>(cells[place]);
    const auto map = [&](double radius) -> Map
    {
      const double from = this->inset(radius, place);
      const double width = 1 - 2 * from;
      return width > 0 ? Map{ from, cells[place] / width, 0 } : Map{ 0, 0, cells[place] / 2 };
    };
    level.least[place] = map(level.smallest);
    level.most[place] = map(level.radius);
  }
}

std::int64_t AdsorptionGrid::shelves_within(double distance) const noexcept
{
  const double wide = distance * per_height_[2] + 2 * insets_.front()[2] + deepest_;
  const auto shelves = static_cast<double>(shelves_);
  return static_cast<std::int64_t>(std::min(std::ceil(wide * shelves) + 1, shelves));
}

std::array<double, 2> AdsorptionGrid::window(
  std::int64_t first, std::int64_t last, double margin) const noexcept
{
  const double around = margin * 2 * levels_.front().radius * per_height_[2];
  const auto shelves = static_cast<double>(shelves_);
  return { static_cast<double>(first) / shelves - around,
    static_cast<double>(last) / shelves + deepest_ + around };
}
}
