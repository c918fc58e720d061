// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/unwrap.h"

#include "granular/lines/minimum_image.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace granular
{
namespace
{
bool is_same(const Box& a, const Box& b) noexcept
{
  const auto numbers = [](const Twofold3& x) {
    return std::array{ x[0].hi, x[0].lo, x[1].hi, x[1].lo, x[2].hi, x[2].lo };
  };
  return a.boundary == b.boundary && numbers(a.origin) == numbers(b.origin) &&
    std::ranges::equal(a.vectors, b.vectors, {}, numbers, numbers);
}

Vector3 add(const Vector3& a, double times, const Vector3& b) noexcept
{
  return { a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2] };
}

std::array<Vector3, 3> vectors_of(const Box& box) noexcept
{
  return { values_of(box.vectors[0]), values_of(box.vectors[1]), values_of(box.vectors[2]) };
}

/// Takes away from a vector what it has of another one more than the vector it is to resemble. Returns how often.
std::int64_t resemble(
  Vector3& vector, const Vector3& wanted, const Vector3& other, std::size_t axis) noexcept
{
  const double times = std::round((vector[axis] - wanted[axis]) / other[axis]);
  if (!(std::abs(times) < 0x1p52)) // also nan: the other one has no length
  {
    return 0;
  }
  vector = add(vector, -times, other);
  return static_cast<std::int64_t>(times);
}
}

BoxImages::BoxImages(const Box& of)
  : box(of)
  , images(of)
  , duals(periodic_duals(of, vectors_of(of)))
{
}

bool BoxImages::is_far(const Vector3& vector) const noexcept
{
  return std::ranges::any_of(
    duals, [&](const Vector3& dual) { return std::abs(dot(dual, vector)) > 0.25; });
}

BoxChange::BoxChange(const Box& from, const Box& to)
  : equal_(is_same(from, to))
{
  if (equal_)
  {
    return;
  }
  std::array<Vector3, 3> before = vectors_of(from);
  const std::array<Vector3, 3> after = vectors_of(to);
  if (!from.general && !to.general)
  {
    flip_yz_ = is_periodic(from, 1) ? resemble(before[2], after[2], before[1], 1) : 0;
    flip_xz_ = is_periodic(from, 0) ? resemble(before[2], after[2], before[0], 0) : 0;
    flip_xy_ = is_periodic(from, 0) ? resemble(before[1], after[1], before[0], 0) : 0;
  }
  origin_ = values_of(from.origin);
  const Vector3 moved = minus(values_of(to.origin), origin_);
  const std::array<Vector3, 3> duals = periodic_duals(from, before);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // along other axes bounds follow the particles, and carry nothing
    if (duals[axis] != Vector3{})
    {
      axes_[axis] = { duals[axis], minus(after[axis], before[axis]) };
      shift_ = add(shift_, dot(duals[axis], moved), before[axis]);
    }
  }
}

Vector3 BoxChange::carry(const Vector3& point) const noexcept
{
  if (equal_)
  {
    return point;
  }
  const Vector3 offset = minus(point, origin_);
  Vector3 carried = add(point, 1, shift_);
  for (const Axis& axis : axes_)
  {
    carried = add(carried, dot(axis.dual, offset), axis.growth);
  }
  return carried;
}

BoxCounts BoxChange::convert(const BoxCounts& counts) const noexcept
{
  // b = b' + xy a, c = c' + yz b + xz a with the old b: its a are converted along
  const std::int64_t b = counts[1] + flip_yz_ * counts[2];
  return { counts[0] + flip_xz_ * counts[2] + flip_xy_ * b, b, counts[2] };
}

Vector3 BoxChange::growth_of(const BoxCounts& counts) const noexcept
{
  Vector3 growth = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    growth = add(growth, static_cast<double>(counts[axis]), axes_[axis].growth);
  }
  return growth;
}

void Unwrapper::add_box(const Box& box)
{
  if (kinds_.empty() || !is_same(kinds_.back().images.box, box))
  {
    const BoxChange change =
      kinds_.empty() ? BoxChange() : BoxChange(kinds_.back().images.box, box);
    kinds_.push_back({ BoxImages(box), change });
  }
  kinds_of_frames_.push_back(kinds_.size() - 1);
}

/// Moves a particle as the boxes do since it was seen: also through frames in which it is not.
void Unwrapper::carry(PathState& state) const
{
  for (std::size_t kind = kinds_of_frames_[static_cast<std::size_t>(state.frame)] + 1;
       kind <= kinds_of_frames_.back(); ++kind)
  {
    const BoxChange& change = kinds_[kind].change;
    state.point = change.carry(state.point);
    state.counts = change.convert(state.counts);
    state.base = change.convert(state.base);
    state.drift = add(state.drift, 1, change.growth_of(state.base));
  }
}

Unwrapper::Step Unwrapper::find_step(const Vector3& from, const Vector3& to) const
{
  const BoxImages& box = kinds_[kinds_of_frames_.back()].images;
  const Vector3 straight = minus(to, from);
  const BoxCounts counts = box.images.find(straight);
  return { counts, box.is_far(box.images.moved(straight, counts, {})) };
}

Unwrapper::Step Unwrapper::advance(PathState& state, const PathFrame& frame, std::size_t i) const
{
  const Vector3 point = { frame.points[3 * i], frame.points[3 * i + 1], frame.points[3 * i + 2] };
  const bool first = state.frame < 0;
  if (!first)
  {
    this->carry(state);
  }
  const BoxCounts before = state.counts;
  Step step;
  if (frame.coordinates == Coordinates::Unwrapped)
  {
    state.counts = {};
    state.drift = {};
  }
  else
  {
    if (!first && !(frame.has_images && state.based))
    {
      step = this->find_step(state.point, point);
      state.counts = { before[0] + step.counts[0], before[1] + step.counts[1],
        before[2] + step.counts[2] };
    }
    if (frame.has_images)
    {
      const BoxCounts images = { frame.images[3 * i], frame.images[3 * i + 1],
        frame.images[3 * i + 2] };
      state.base = state.based ? state.base : minus(images, state.counts);
      state.based = true;
      state.counts = minus(images, state.base);
    }
  }
  step.counts = first ? BoxCounts{} : minus(state.counts, before);
  state.point = point;
  state.frame = static_cast<std::int64_t>(kinds_of_frames_.size()) - 1;
  return step;
}
}
