// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/split_line.h"

#include "granular/local/box_vectors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace granular
{
LineSplitter::LineSplitter(const Box& box, const MinimumImage& images, const Vector3& point_origin)
  : box_(box)
  , images_(images)
  , point_origin_(point_origin)
{
  std::vector<Vector3> vectors;
  std::vector<std::size_t> axes;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (has_length(box.vectors[i]))
    {
      vectors.push_back(values_of(box.vectors[i]));
      axes.push_back(i);
    }
  }
  for (std::size_t i = 0; i < axes.size(); ++i)
  {
    normals_[axes[i]] = own_part(vectors, i);
  }
}

/// whole: from first to the image of second.
LineSplitter::Crossing LineSplitter::find_crossing(std::size_t axis, bool upper,
  const Vector3& first, const Vector3& second, const Vector3& whole) const noexcept
{
  const Vector3& normal = normals_[axis];
  const auto up = [&](std::size_t of) { return upper && of == axis ? 1 : 0; };
  const Vector3 to_face = box_.corner(up(0), up(1), up(2), first);
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    size += std::abs(normal[i]) * std::max(std::abs(first[i]), std::abs(second[i]));
  }
  const double length = dot(normal, whole);
  Crossing crossing;
  crossing.axis = axis;
  crossing.rounding = std::abs(0x1p-50 * size / length);
  const double place = dot(normal, to_face) / length;
  // nothing tells where a line in the face crosses it: at its first end
  crossing.place = place > crossing.rounding ? place : 0;
  crossing.place = crossing.place < 1 - crossing.rounding ? crossing.place : 1;
  return crossing;
}

std::size_t LineSplitter::split(const Vector3& first, const Vector3& second,
  const BoxCounts& counts, std::array<LinePart, most_parts>& parts) const noexcept
{
  const Vector3 whole = images_.moved(second, counts, first);
  std::array<Crossing, 3> crossings; // in their order along the line
  std::size_t crossed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (counts[axis] != 0)
    {
      const Crossing one = this->find_crossing(axis, counts[axis] > 0, first, second, whole);
      std::size_t at = crossed++;
      for (; at > 0 && crossings[at - 1].place > one.place; --at)
      {
        crossings[at] = crossings[at - 1];
      }
      crossings[at] = one;
    }
  }

  BoxCounts of_first = {};      // how many vectors the first end is moved by
  BoxCounts of_second = counts; // and the second one
  const auto point_at = [&](double place)
  {
    Vector3 point = first;
    for (std::size_t i = 0; i < 3; ++i)
    {
      point[i] += place * whole[i];
    }
    return place == 1 ? images_.moved(second, of_second, point_origin_)
                      : images_.moved(point, of_first, point_origin_);
  };
  std::size_t count = 0;
  double from = 0;
  for (std::size_t i = 0; i < crossed; ++i)
  {
    const auto& [place, rounding, axis] = crossings[i];
    if (place - from > rounding)
    {
      parts[count++] = { point_at(from), point_at(place) };
      from = place;
    }
    of_first[axis] = -counts[axis];
    of_second[axis] = 0;
  }
  if (count == 0 || from < 1)
  {
    parts[count++] = { point_at(from), point_at(1) };
  }
  return count;
}
}
