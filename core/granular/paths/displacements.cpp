// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/displacements.h"

#include "granular/local/minimum_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace granular
{
namespace
{
Vector3 origin_of(const FrameView& frame)
{
  return frame.coordinates == Coordinates::Scaled ? Vector3{} : frame.point_origin;
}
}

Displacements::Displacements(const FrameView& current, const FrameView& reference, bool unwrapped)
{
  if (origin_of(current) != origin_of(reference))
  {
    origins_ = { origin_of(current), origin_of(reference) };
  }
  vectors_ = { current.header.box.vectors, reference.header.box.vectors };
  if (!unwrapped)
  {
    const Box box = current.has_box ? current.header.box
      : reference.has_box           ? reference.header.box
                                    : Box{};
    images_.emplace(box);
    vectors_[0] = box.vectors; // of which the shortest image takes some
    duals_ = periodic_duals(
      box, { values_of(box.vectors[0]), values_of(box.vectors[1]), values_of(box.vectors[2]) });
  }
}

Vector3 Displacements::subtract(
  const CountedPoint& current, const CountedPoint& reference) const noexcept
{
  Vector3 result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    CompensatedSum sum;
    sum.add(current.point[axis]);
    sum.add(-reference.point[axis]);
    sum.add(origins_[0][axis]);
    sum.add(-origins_[1][axis]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (current.images[i] != 0) // a box without bounds there has no images, and no number
      {
        sum.add_product(current.images[i], vectors_[0][i][axis]);
      }
      if (reference.images[i] != 0)
      {
        sum.add_product(-reference.images[i], vectors_[1][i][axis]);
      }
    }
    result[axis] = sum.value();
  }
  return result;
}

Vector3 Displacements::find(
  const CountedPoint& current, const CountedPoint& reference) const noexcept
{
  const Vector3 displacement = this->subtract(current, reference);
  if (!images_)
  {
    return displacement;
  }
  const BoxCounts counts = images_->find(displacement);
  if (counts == BoxCounts{})
  {
    return displacement;
  }
  CountedPoint shortest = current;
  std::ranges::transform(
    counts, shortest.images.begin(), [](std::int64_t count) { return static_cast<double>(count); });
  return this->subtract(shortest, reference);
}

bool Displacements::is_far(const Vector3& displacement) const noexcept
{
  return std::ranges::any_of(
    duals_, [&](const Vector3& dual) { return std::abs(dot(dual, displacement)) > 0.25; });
}
}
