// SPDX-License-Identifier: BSD-3-Clause
// Positions of all forms from points of all forms, against 113 bits: the points as they are in memory, with what
// was subtracted from them, are exact.
#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "../support/reference_dump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace granular;
using Exact3 = std::array<Exact, 3>;

/// Far from the origin, thin, flat, strongly tilted.
std::vector<ReferenceBox> boxes()
{
  return { { { -1.5, 0, 2 }, { 8.5, 7.75, 10.5 }, 0, 0, 0, false },
    { { 1e6, -3e7, 1.0 / 3 }, { 1e6 + 0.1, -3e7 + 1, 2.0 / 3 }, 0, 0, 0, false },
    { { 0, -1e-9, 5 }, { 1e4, 1e-9, 5 + 1e-7 }, 0, 0, 0, false },
    { { -1.5, 0, 2 }, { 12.25, 9, 10.5 }, 2.5, -1.5, 1.25, true },
    { { 1e6, -3e7, 1.0 / 3 }, { 1e6 + 0.7, -3e7 + 1, 2.0 / 3 }, 0.1, -0.3, 0.2, true },
    { { -40, 0, 0 }, { 60, 12, 1 }, 47.1, -33.3, 10.9, true } };
}

/// H times a vector.
Exact3 times(const ReferenceBox& box, const Exact3& vector)
{
  const auto h = box.matrix();
  Exact3 product;
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t j = k; j < 3; ++j)
    {
      product[k] = product[k] + h[k][j] * vector[j];
    }
  }
  return product;
}

Exact3 sum(const Exact3& a, const Exact3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

/// The 12 columns that a point of some form must become.
std::vector<Exact> exact_columns(
  const ReferenceBox& box, Coordinates coordinates, const Exact3& point, const Exact3& image)
{
  Exact3 x = point;
  Exact3 xs;
  if (coordinates == Coordinates::Scaled)
  {
    xs = point;
    x = sum(box.corner(), times(box, xs));
  }
  else
  {
    if (coordinates == Coordinates::Unwrapped)
    {
      x = sum(point, times(box, { -image[0], -image[1], -image[2] }));
    }
    xs = box.scaled(x);
  }
  const Exact3 xu = coordinates == Coordinates::Unwrapped ? point : sum(x, times(box, image));
  const Exact3 xsu = sum(xs, image);
  std::vector<Exact> all;
  for (const Exact3& form : { x, xs, xu, xsu })
  {
    all.insert(all.end(), form.begin(), form.end());
  }
  return all;
}

const std::vector<std::string> columns = { "x", "y", "z", "xs", "ys", "zs", "xu", "yu", "zu", "xsu",
  "ysu", "zsu" };

std::vector<double> written_values(const FrameView& frame, std::string* said = nullptr)
{
  const Folder folder;
  DumpFormat format;
  format.binary = true;
  format.columns = columns;
  const Written written = write_dump(folder.path("a"), Frames{ frame }, format);
  EXPECT_EQ(written.error, "");
  if (said)
  {
    *said = written.said;
  }
  std::vector<double> values(columns.size() * static_cast<std::size_t>(frame.rows));
  const std::size_t bytes = values.size() * sizeof(double);
  EXPECT_GT(written.bytes.size(), bytes);
  std::memcpy(values.data(), written.bytes.data() + written.bytes.size() - bytes, bytes);
  return values;
}

/// Points of a form, with the counts of images.
struct Points
{
  std::vector<double> values;
  std::vector<std::int32_t> images;
};

Points random_points(
  const ReferenceBox& box, Coordinates coordinates, std::int32_t most_images, std::size_t rows)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> inside(-0.1, 1.1);
  std::uniform_int_distribution<std::int32_t> images(-most_images, most_images);
  Points points;
  for (std::size_t row = 0; row < rows; ++row)
  {
    const Exact3 lambda = { inside(random), inside(random), inside(random) };
    Exact3 image;
    for (Exact& count : image)
    {
      points.images.push_back(images(random));
      count = points.images.back();
    }
    const Exact3 x = sum(box.corner(), times(box, lambda));
    const Exact3 xu = sum(x, times(box, image));
    const Exact3& point = coordinates == Coordinates::Scaled ? lambda
      : coordinates == Coordinates::Unwrapped                ? xu
                                                             : x;
    for (const Exact& value : point)
    {
      points.values.push_back(static_cast<double>(value.value));
    }
  }
  return points;
}

/// The most that any value is off, in units of the bound.
template <class Value>
double worst(const ReferenceBox& box, Coordinates coordinates, std::int32_t most_images,
  const Vector3& origin, ValueType type)
{
  constexpr std::size_t rows = 1000;
  const Points points = random_points(box, coordinates, most_images, rows);
  std::vector<Value> held;
  for (std::size_t i = 0; i < points.values.size(); ++i)
  {
    held.push_back(static_cast<Value>(points.values[i] - origin[i % 3]));
  }
  FrameView frame;
  frame.header.box = box_of(box);
  frame.rows = rows;
  frame.points = view_rows("points", type, held.data(), 3);
  frame.coordinates = coordinates;
  frame.point_origin = origin;
  frame.arrays.push_back(view_rows("image", ValueType::Int32, points.images.data(), 3));
  const std::vector<double> values = written_values(frame);
  double most = 0;
  for (std::size_t row = 0; row < rows; ++row)
  {
    Exact3 point;
    Exact3 image;
    for (std::size_t k = 0; k < 3; ++k)
    {
      point[k] = Exact(static_cast<double>(held[3 * row + k])) + origin[k];
      image[k] = Exact(points.images[3 * row + k]);
    }
    const std::vector<Exact> exact = exact_columns(box, coordinates, point, image);
    for (std::size_t i = 0; i < exact.size(); ++i)
    {
      most = std::max(most, error_in_bounds(values[exact.size() * row + i], exact[i]));
    }
  }
  return most;
}
}

TEST(WritePositions, from_all_forms)
{
  HardCase hard("positions, written",
    "from absolute, unwrapped, scaled and shifted points, up to 2^20 crossings: error over "
    "its bound",
    "bounds", 1);
  for (const ReferenceBox& box : boxes())
  {
    for (const Coordinates coordinates :
      { Coordinates::Absolute, Coordinates::Unwrapped, Coordinates::Scaled })
    {
      const std::vector<Vector3> origins = { Vector3{}, { box.lo[0], box.lo[1], box.lo[2] },
        { 1e5 / 3, -0.1, 7e-9 }, { 1e12, 1e-12, -1e9 } };
      for (const Vector3& origin : origins)
      {
        for (const std::int32_t images : { 0, 3, 1 << 20 })
        {
          const double most = worst<double>(box, coordinates, images, origin, ValueType::Float64);
          hard.add(most, 1000);
          EXPECT_LE(most, 1) << box.lo[0] << " " << to_string(coordinates) << " " << origin[0]
                             << " " << images;
          EXPECT_LE(worst<float>(box, coordinates, images, origin, ValueType::Float32), 1)
            << box.lo[0] << " " << to_string(coordinates) << " " << origin[0] << " " << images;
        }
      }
    }
  }
}

/// Without counts of images unwrapped points are wrapped: into the box along periodic axes, and not along others.
TEST(WritePositions, wrapped)
{
  ReferenceBox box = boxes()[3];
  const Points points = random_points(box, Coordinates::Unwrapped, 1 << 20, 2000);
  FrameView frame;
  frame.header.box = box_of(box);
  frame.header.box.boundary = "pp ff pp";
  frame.rows = 2000;
  frame.points = view_rows("points", ValueType::Float64, points.values.data(), 3);
  frame.coordinates = Coordinates::Unwrapped;
  std::string said;
  const std::vector<double> values = written_values(frame, &said);
  EXPECT_EQ(said,
    "no array 'image': unwrapped points are wrapped into the box to count how often it was "
    "crossed\n");
  for (std::size_t row = 0; row < 2000; ++row)
  {
    const double* const v = values.data() + 12 * row;
    Exact3 image;
    for (std::size_t k = 0; k < 3; ++k)
    {
      ASSERT_EQ(v[6 + k], points.values[3 * row + k]) << "xu is what it was";
      ASSERT_TRUE(k == 1 || (v[3 + k] >= -1e-15 && v[3 + k] <= 1)) << v[3 + k];
      image[k] = std::round(v[9 + k] - v[3 + k]);
      ASSERT_TRUE(k != 1 || static_cast<double>(image[k].value) == 0);
    }
    const Exact3 point = { points.values[3 * row], points.values[3 * row + 1],
      points.values[3 * row + 2] };
    const std::vector<Exact> exact = exact_columns(box, Coordinates::Unwrapped, point, image);
    for (std::size_t i = 0; i < exact.size(); ++i)
    {
      ASSERT_LE(error_in_bounds(v[i], exact[i]), 1) << columns[i];
    }
  }
}

/// The numbers of a file that are kept beside the points count where they are those of the point, and not where a
/// filter has moved it.
TEST(WritePositions, moved_points)
{
  const std::string rows = "1 0.123456 0.7 0.25\n2 0.4 0.8 0.3\n";
  ReadFrameView read(
    Dump(one_frame("id xs ys zs", rows, " pp pp pp\n0 0.3\n0 7\n-1 1\n")).read(everything()).frame);
  const Folder folder;
  const auto body = [&]
  {
    const std::string bytes = write_dump(folder.path("a"), Frames{ read.view }, {}).bytes;
    return bytes.substr(bytes.find("zs\n") + 3);
  };
  EXPECT_EQ(body(), rows);
  auto* const points = static_cast<double*>(read.frame.points.data());
  points[0] += 0.03;
  points[4] -= 0.7 * 1e-9; // moved by less than six digits show
  EXPECT_EQ(body(), "1 0.223456 0.7 0.25\n2 0.4 0.8 0.3\n");
  DumpFormat format;
  format.numbers.digits = 17;
  const std::string exact = write_dump(folder.path("a"), Frames{ read.view }, format).bytes;
  EXPECT_EQ(exact.find(" 0.80000000000000004 "), exact.npos) << exact;
  EXPECT_NE(exact.find(" 0.799999999"), exact.npos) << exact;
}

/// A particle that was lost stays lost, and takes no other coordinate with it. -0 is that of printf, as in (x - lo) / length.
TEST(WritePositions, not_finite)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<double> points = { nan, 1, 2, 3, -inf, 4, -0.0, 0, -0.0 };
  FrameView frame;
  frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 4, 4, 4 });
  frame.header.box.boundary = "pp pp pp";
  frame.rows = 3;
  frame.points = view_rows("points", ValueType::Float64, points.data(), 3);
  DumpFormat format;
  format.columns = { "x", "y", "z", "xs", "ys", "zs" };
  const Folder folder;
  const std::string bytes = write_dump(folder.path("a"), Frames{ frame }, format).bytes;
  EXPECT_EQ(bytes.substr(bytes.find("zs\n") + 3),
    "nan 1 2 nan 0.25 0.5\n3 -inf 4 0.75 -inf 1\n-0 0 -0 -0 0 -0\n");
}
