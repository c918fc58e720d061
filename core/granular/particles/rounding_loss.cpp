// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/rounding_loss.h"

#include "granular/numbers/number_print.h"
#include "granular/parallel/gather.h"

#include <algorithm>
#include <limits>

namespace granular
{
namespace
{
/// Calls visit(i, j, k) for each corner of a box.
template <class Visit>
void for_each_corner(const Visit& visit)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    visit(corner & 1, corner >> 1 & 1, corner >> 2);
  }
}

/// The largest error of the double nearest to a number of such a magnitude.
double half_ulp_of_double(double magnitude) noexcept
{
  const double next = std::nextafter(magnitude, HUGE_VAL);
  return magnitude < HUGE_VAL ? (next - magnitude) / 2 : 0;
}

std::string short_text(double value)
{
  return to_text(value, { 3 });
}
}

RoundingLimit::RoundingLimit(const Box& box, double smallest_radius) noexcept
  : radius(smallest_radius)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double length = 0;
    for (const Twofold3& edge : box.vectors)
    {
      length += std::abs(edge[axis].hi);
    }
    const bool known = length > 0 && std::isfinite(length);
    lengths[axis] = length;
    distance[axis] = radius < HUGE_VAL ? of_radius * radius : known ? of_box * length : HUGE_VAL;
  }
}

void RoundingLoss::change(std::size_t column, double value, double rounded) noexcept
{
  const double part = std::abs(rounded - value) / std::abs(value);
  if (part > changed_ || (part == changed_ && column < column_))
  {
    changed_ = part;
    column_ = column;
  }
}

void RoundingLoss::add(const RoundingLoss& other) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->move(axis, other.moved_[axis]);
  }
  if (other.changed_ > changed_ || (other.changed_ == changed_ && other.column_ < column_))
  {
    changed_ = other.changed_;
    column_ = other.column_;
  }
  this->add_radius(other.radius_);
}

std::string RoundingLoss::text(
  const RoundingLimit& limit, const char* points, std::span<const std::string> names) const
{
  std::string text;
  std::size_t worst = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    const double ratio = moved_[axis] / limit.distance[axis];
    worst = ratio > moved_[worst] / limit.distance[worst] ? axis : worst;
  }
  if (moved_[worst] > limit.distance[worst])
  {
    text = std::string("moves ") + points + " by up to " + short_text(moved_[worst]) + " along " +
      "xyz"[worst] + ", where " +
      (limit.radius < HUGE_VAL ? "the smallest radius is " + short_text(limit.radius)
                               : "the box is " + short_text(limit.lengths[worst]) + " long");
  }
  if (changed_ > RoundingLimit::of_value)
  {
    text += (text.empty() ? "changes '" : ", and changes '") + names[column_] + "' by up to " +
      short_text(100 * changed_) + " % of itself";
  }
  return text;
}

RoundingLoss add_ranks(RoundingLoss own, Communicator& ranks)
{
  RoundingLoss sum;
  for (const RoundingLoss& loss : gather(ranks, own))
  {
    sum.add(loss);
  }
  return sum;
}

Vector3 rounding_of_points(const Box& box, const Vector3& origin) noexcept
{
  Vector3 rounding = {};
  for_each_corner(
    [&](int i, int j, int k)
    {
      const Vector3 corner = box.corner(i, j, k, origin);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        rounding[axis] = std::max(rounding[axis], half_ulp_of_double(std::abs(corner[axis])));
      }
    });
  return rounding;
}

Vector3 distance_of_corners(const Box& one, const Box& other) noexcept
{
  Vector3 distance = {};
  for_each_corner(
    [&](int i, int j, int k)
    {
      const Vector3 a = one.corner(i, j, k);
      const Vector3 apart = other.corner(i, j, k, a);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        distance[axis] = std::max(distance[axis], std::abs(apart[axis]));
      }
    });
  return distance;
}
}
