// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/fibres.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace granular
{
namespace
{
/// What a box may lack, relative to it: one that was made for a fibre may have been rounded.
constexpr double tolerance = 1e-12;

/// The box as it is seen along its first vector, that of one diameter: its lattice has a grain a fibre.
BoxShape cross_section(const BoxShape& box, double diameter)
{
  BoxShape flat = box;
  const Vector3& along = box.vectors[0];
  const double square = dot(along, along);
  for (Vector3& vector : flat.vectors)
  {
    const double part =
      &vector == &flat.vectors[0] ? 1 - diameter / std::sqrt(square) : dot(vector, along) / square;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      vector[axis] -= part * along[axis];
    }
  }
  flat.heights[0] = diameter;
  flat.periodic[0] = false;
  return flat;
}

/// Between the grains of a fibre a whole number of distances, between its ends and the faces a radius.
std::int64_t room_along(const BoxShape& box, double distance, double radius)
{
  constexpr double most = 1e12;
  const double length = std::sqrt(dot(box.vectors[0], box.vectors[0]));
  const double inside = length * (1 - 2 * radius / box.heights[0]) / distance;
  const double steps = std::floor(inside + tolerance * (1 + length / distance));
  return static_cast<std::int64_t>(std::clamp(steps, 0.0, most)) + 1;
}
}

Fibres::Fibres(
  Kind kind, const BoxShape& box, double distance, double radius, std::int64_t grains_a_fibre)
  : grains_a_fibre_(grains_a_fibre)
  , first_(radius / box.heights[0])
  , step_(distance / std::sqrt(dot(box.vectors[0], box.vectors[0])))
  , nearest_(distance)
{
  const std::int64_t room = room_along(box, distance, radius);
  if (grains_a_fibre > room)
  {
    throw LimitError("expected at most " + std::to_string(room) +
      " grains a fibre, which the box holds along its first vector, got " +
      std::to_string(grains_a_fibre));
  }
  grains_a_fibre_ = grains_a_fibre > 0 ? grains_a_fibre : room;
  if (kind == Kind::Bundle)
  {
    across_.emplace(LatticeKind::FibreBundle, cross_section(box, 2 * radius), distance, radius);
    nearest_ = across_->nearest();
  }
  this->settle(box, distance, radius);
}

/// Finds out how near grains of a fibre are to each other, and to the images of a fibre that is alone.
void Fibres::settle(const BoxShape& box, double distance, double radius)
{
  const double rounding = 2 * box.rounding();
  const double length = std::sqrt(dot(box.vectors[0], box.vectors[0]));
  const auto steps = static_cast<double>(grains_a_fibre_ - 1);
  const double rest = length - steps * distance; // at its ends
  if (box.adds({ box.origin[0], length, distance, radius }) && rest >= 2 * radius)
  {
    exact_first_ = box.origin[0] + radius;
    exact_step_ = distance;
  }
  else if (rest - steps * rounding >= length * 2 * radius / box.heights[0] + rounding)
  {
    step_ = (distance + rounding) / length;
  }
  else
  {
    nearest_ = std::min({ nearest_, distance, rest }) - rounding;
  }
  for (std::size_t axis = 1; axis < 3 && !across_; ++axis)
  {
    if (box.periodic[axis])
    {
      nearest_ = std::min(nearest_, box.heights[axis] - (box.aligned ? 0 : rounding));
    }
  }
}

std::int64_t Fibres::capacity() const noexcept
{
  constexpr double most =
    1e18; // numbers of cells are limited, but not their product with another number
  const std::int64_t fibres = across_ ? across_->capacity() : 1;
  const double product = static_cast<double>(fibres) * static_cast<double>(grains_a_fibre_);
  return product < most ? fibres * grains_a_fibre_ : static_cast<std::int64_t>(most);
}

Vector3 Fibres::scaled(std::int64_t row) const noexcept
{
  Vector3 place = { 0.5, 0.5, 0.5 };
  if (across_)
  {
    place = across_->scaled(this->fibre(row));
  }
  place[0] = first_ + static_cast<double>(row % grains_a_fibre_) * step_;
  return place;
}

Vector3 Fibres::point(std::int64_t row, const BoxShape& box) const noexcept
{
  const Vector3 place = this->scaled(row);
  Vector3 point = box.point(place);
  if (across_ && box.aligned)
  {
    const Vector3 across = across_->point(this->fibre(row), box);
    std::copy(across.begin() + 1, across.end(), point.begin() + 1);
  }
  if (exact_step_ > 0)
  {
    point[0] = exact_first_ + static_cast<double>(row % grains_a_fibre_) * exact_step_;
  }
  return point;
}

Vector3 Fibres::lengths_for(Kind kind, const std::array<bool, 3>& periodic, double distance,
  double radius, std::int64_t grains_a_fibre, std::int64_t fibres)
{
  Vector3 lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = periodic[axis] ? distance : 2 * radius;
  }
  if (kind == Kind::Bundle)
  {
    lengths = Lattice::lengths_for(LatticeKind::FibreBundle, periodic, distance, radius, fibres);
  }
  lengths[0] += static_cast<double>(grains_a_fibre - 1) * distance;
  return lengths;
}
}
