// SPDX-License-Identifier: BSD-3-Clause
#include "packings.h"
#include "error_of.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using granular::Vector3;

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

template <typename T>
std::vector<T> values(const granular::Block& block, std::size_t rows)
{
  const auto* const from = static_cast<const T*>(block.data());
  return std::vector<T>(from, from + rows);
}

const granular::Block& block_of(const granular::Table& frame, const std::string& name)
{
  for (const granular::TableArray& array : frame.arrays)
  {
    if (array.info.name == name)
    {
      return array.block;
    }
  }
  throw std::logic_error("no array " + name);
}

std::string text_of(const granular::Block& block)
{
  return std::string(static_cast<const char*>(block.data()), block.bytes());
}

struct Image
{
  Vector3 centre;
  double radius;
};
}

Grains::Grains(const granular::PackingRequest& request)
{
  granular::Progress progress;
  frame = granular::make_packing(request, progress);
  points = values<Vector3>(frame.points, this->size());
  radius = values<double>(block_of(frame, "radius"), this->size());
  id = values<std::int64_t>(block_of(frame, "id"), this->size());
  type = values<std::int32_t>(block_of(frame, "type"), this->size());
  v = values<Vector3>(block_of(frame, "v"), this->size());
  const granular::Box& box = frame.header.box;
  for (std::size_t i = 0; i < 3; ++i)
  {
    origin[i] = box.origin[i].value();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      vectors[i][axis] = box.vectors[i][axis].value();
    }
  }
  volume = std::abs(dot(vectors[0], cross(vectors[1], vectors[2])));
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Vector3 face = cross(vectors[(i + 1) % 3], vectors[(i + 2) % 3]);
    heights[i] = volume / std::sqrt(dot(face, face));
  }
}

Vector3 Grains::scaled(std::size_t particle) const
{
  const Vector3& point = points[particle];
  const Vector3 edge = { point[0] - origin[0], point[1] - origin[1], point[2] - origin[2] };
  Vector3 place;
  for (std::size_t i = 0; i < 3; ++i)
  {
    place[i] = dot(edge, cross(vectors[(i + 1) % 3], vectors[(i + 2) % 3])) /
      dot(vectors[0], cross(vectors[1], vectors[2]));
  }
  return place;
}

double Grains::least_gap() const
{
  const double largest = *std::max_element(radius.begin(), radius.end());
  std::vector<Image> images;
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    const Vector3 place = this->scaled(i);
    for (int n = 0; n < 27; ++n)
    {
      const std::array<int, 3> shift = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
      Image image = { points[i], radius[i] };
      bool near = true;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const bool periodic = frame.header.box.boundary[3 * k] == 'p';
        const double margin = 2.1 * largest / heights[k];
        const double at = place[k] + shift[k];
        near = near && (shift[k] == 0 || (periodic && at > -margin && at < 1 + margin));
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          image.centre[axis] += shift[k] * vectors[k][axis];
        }
      }
      if (near)
      {
        images.push_back(image);
      }
    }
  }
  std::sort(images.begin(), images.end(),
    [](const Image& a, const Image& b) { return a.centre[0] < b.centre[0]; });
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const Image& a = images[i];
    for (std::size_t j = i + 1;
         j < images.size() && images[j].centre[0] - a.centre[0] < 2.1 * largest; ++j)
    {
      const Image& b = images[j];
      const Vector3 edge = { b.centre[0] - a.centre[0], b.centre[1] - a.centre[1],
        b.centre[2] - a.centre[2] };
      least = std::min(least, std::sqrt(dot(edge, edge)) / (a.radius + b.radius) - 1);
    }
  }
  return least;
}

double Grains::least_inside() const
{
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < this->size(); ++i)
  {
    const Vector3 place = this->scaled(i);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double away = std::min(place[k], 1 - place[k]);
      const bool periodic = frame.header.box.boundary[3 * k] == 'p';
      least = std::min(least, periodic ? away : away * heights[k] / radius[i] - 1);
    }
  }
  return least;
}

double Grains::solid_fraction() const
{
  double sum = 0;
  for (const double r : radius)
  {
    sum += 4.0 / 3 * std::numbers::pi * r * r * r;
  }
  return sum / volume;
}

std::string Grains::bytes() const
{
  std::string all = text_of(frame.points);
  for (const granular::TableArray& array : frame.arrays)
  {
    all += text_of(array.block);
  }
  return all;
}

granular::Box tilted_box(const Vector3& origin, const Vector3& lengths, const Vector3& tilts)
{
  granular::Box box = granular::Box::from_vectors(origin,
    { Vector3{ lengths[0], 0, 0 }, Vector3{ tilts[0], lengths[1], 0 },
      Vector3{ tilts[1], tilts[2], lengths[2] } });
  return box;
}

granular::RadiusChoice one_radius(double radius)
{
  return { granular::RadiusChoice::Kind::One, radius, radius, 0 };
}

granular::RadiusChoice two_radii(double first, double second, double share)
{
  return { granular::RadiusChoice::Kind::Two, first, second, share };
}

std::string error_of(const granular::PackingRequest& request)
{
  granular::Progress progress;
  return error_of<granular::LimitError>([&] { granular::make_packing(request, progress); });
}
