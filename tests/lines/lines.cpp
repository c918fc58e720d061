// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/lines.h"

#include "granular/lines/minimum_image.h"
#include "granular/memory/block.h"

#include "../local/text_frames.h"
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace
{
using granular::Box;
using granular::BoxCounts;
using granular::Lines;
using granular::MinimumImage;
using granular::PeriodicLines;
using granular::Progress;
using granular::Request;
using granular::Vector3;
using Points = std::vector<Vector3>;
using Quad3 = std::array<Quad, 3>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Line
{
  Vector3 begin, end;
  bool operator==(const Line&) const = default;
};

/// What make_lines gives, to look at.
struct Made
{
  std::vector<Line> lines;
  std::vector<double> lengths;
  std::vector<std::int64_t> rows;
  std::int64_t moved = 0;
};

Made make(const Points& first, const Points& second, const Box& box, PeriodicLines periodic,
  const Vector3& point_origin = {}, int threads = 1)
{
  Request request;
  request.periodic_lines = periodic;
  request.point_origin = point_origin;
  request.threads = threads;
  Progress progress;
  const Lines lines =
    granular::make_lines({ first.empty() ? nullptr : first[0].data(), 3 * first.size() },
      { second.empty() ? nullptr : second[0].data(), 3 * second.size() }, box, request, progress);
  Made made;
  EXPECT_EQ(lines.points.bytes(), static_cast<std::size_t>(lines.count) * sizeof(Line));
  EXPECT_EQ(lines.lengths.bytes(), first.size() * sizeof(double));
  made.lines.resize(static_cast<std::size_t>(lines.count));
  made.lengths.resize(first.size());
  if (!first.empty())
  {
    std::memcpy(made.lines.data(), lines.points.data(), lines.points.bytes());
    std::memcpy(made.lengths.data(), lines.lengths.data(), lines.lengths.bytes());
  }
  made.rows = lines.rows;
  made.moved = lines.moved;
  return made;
}

Box box_of(const Vector3& lo, const Vector3& hi, const std::string& boundary)
{
  Box box = Box::from_bounds(lo, hi);
  box.boundary = boundary;
  return box;
}

const Box ten = box_of({ 0, 0, 0 }, { 10, 10, 10 }, "pp pp pp");

// ---- made by hand ------------------------------------------------------------------------------

TEST(Lines, AcrossAFace)
{
  const Points first = { { 9, 5, 5 }, { 2, 2, 2 }, { 1, 5, 5 } };
  const Points second = { { 2, 5, 5 }, { 3, 2, 2 }, { 8, 5, 5 } };
  const Made image = make(first, second, ten, PeriodicLines::MinimumImage);
  EXPECT_EQ(image.lines,
    (std::vector<Line>{ { { 9, 5, 5 }, { 12, 5, 5 } }, { { 2, 2, 2 }, { 3, 2, 2 } },
      { { 1, 5, 5 }, { -2, 5, 5 } } }));
  EXPECT_EQ(image.lengths, (std::vector<double>{ 3, 1, 3 }));
  EXPECT_TRUE(image.rows.empty());
  EXPECT_EQ(image.moved, 2);

  const Made split = make(first, second, ten, PeriodicLines::Split);
  EXPECT_EQ(split.lines,
    (std::vector<Line>{ { { 9, 5, 5 }, { 10, 5, 5 } }, { { 0, 5, 5 }, { 2, 5, 5 } },
      { { 2, 2, 2 }, { 3, 2, 2 } }, { { 1, 5, 5 }, { 0, 5, 5 } }, { { 10, 5, 5 }, { 8, 5, 5 } } }));
  EXPECT_EQ(split.rows, (std::vector<std::int64_t>{ 0, 0, 1, 2, 2 }));
  EXPECT_EQ(split.lengths, (std::vector<double>{ 3, 1, 3 }));
  EXPECT_EQ(split.moved, 2);

  const Made written = make(first, second, ten, PeriodicLines::AsWritten);
  EXPECT_EQ(written.lines[0], (Line{ { 9, 5, 5 }, { 2, 5, 5 } }));
  EXPECT_EQ(written.lengths, (std::vector<double>{ 7, 1, 7 }));
  EXPECT_TRUE(written.rows.empty());
  EXPECT_EQ(written.moved, 0);
}

TEST(Lines, AcrossEdgesAndCorners)
{
  // through x = 10 first, then y = 10
  EXPECT_EQ(make({ { 9, 8, 5 } }, { { 3, 2, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 8, 5 }, { 10, 9, 5 } }, { { 0, 9, 5 }, { 1, 10, 5 } },
      { { 1, 0, 5 }, { 3, 2, 5 } } }));
  // through x, y and z one after the other
  EXPECT_EQ(make({ { 9, 8, 3 } }, { { 3, 2, 9 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 8, 3 }, { 10, 9, 2 } }, { { 0, 9, 2 }, { 1, 10, 1 } },
      { { 1, 0, 1 }, { 2, 1, 0 } }, { { 2, 1, 10 }, { 3, 2, 9 } } }));
  // through an edge, and through a corner: two parts
  EXPECT_EQ(make({ { 9, 9, 5 } }, { { 2, 2, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 9, 5 }, { 10, 10, 5 } }, { { 0, 0, 5 }, { 2, 2, 5 } } }));
  EXPECT_EQ(make({ { 9, 9, 1 } }, { { 2, 2, 8 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 9, 1 }, { 10, 10, 0 } }, { { 0, 0, 10 }, { 2, 2, 8 } } }));
}

TEST(Lines, EndsOnFaces)
{
  // the first end on the face that is crossed, the second one, both
  EXPECT_EQ(make({ { 10, 5, 5 } }, { { 2, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 0, 5, 5 }, { 2, 5, 5 } } }));
  EXPECT_EQ(make({ { 8, 5, 5 } }, { { 0, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 8, 5, 5 }, { 10, 5, 5 } } }));
  const Made both = make({ { 10, 5, 5 } }, { { 0, 6, 5 } }, ten, PeriodicLines::Split);
  EXPECT_EQ(both.lines, (std::vector<Line>{ { { 0, 5, 5 }, { 0, 6, 5 } } }));
  EXPECT_EQ(both.lengths, (std::vector<double>{ 1 }));
  EXPECT_EQ(both.moved, 1);
  EXPECT_TRUE(both.rows.empty());
  // the same point, written in two images: one line without a length
  EXPECT_EQ(make({ { 10, 5, 5 } }, { { 0, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 0, 5, 5 }, { 0, 5, 5 } } }));
  EXPECT_EQ(make({ { 3, 5, 5 } }, { { 3, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 3, 5, 5 }, { 3, 5, 5 } } }));
}

/// Grains move for some steps before they are put back into the box.
TEST(Lines, EndsOutsideTheBox)
{
  // beyond the face already: the line is near the second end as a whole
  EXPECT_EQ(make({ { 10.5, 5, 5 } }, { { 1, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 0.5, 5, 5 }, { 1, 5, 5 } } }));
  EXPECT_EQ(make({ { 9, 5, 5 } }, { { -0.5, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 5, 5 }, { 9.5, 5, 5 } } }));
  // both ends are in the same image: nothing is crossed
  EXPECT_EQ(make({ { 9, 5, 5 } }, { { 10.5, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 5, 5 }, { 10.5, 5, 5 } } }));
  EXPECT_EQ(make({ { 10.5, 5, 5 } }, { { 1, 5, 5 } }, ten, PeriodicLines::MinimumImage).lines,
    (std::vector<Line>{ { { 10.5, 5, 5 }, { 11, 5, 5 } } }));
}

TEST(Lines, SeveralBoxesApart)
{
  const Made image = make({ { 9, 5, 5 } }, { { 51, 5, 5 } }, ten, PeriodicLines::MinimumImage);
  EXPECT_EQ(image.lines, (std::vector<Line>{ { { 9, 5, 5 }, { 11, 5, 5 } } }));
  EXPECT_EQ(image.lengths, (std::vector<double>{ 2 }));
  // one place where it jumps, by as many boxes as it takes
  EXPECT_EQ(make({ { 9, 5, 5 } }, { { -29, 5, 5 } }, ten, PeriodicLines::Split).lines,
    (std::vector<Line>{ { { 9, 5, 5 }, { 10, 5, 5 } }, { { -30, 5, 5 }, { -29, 5, 5 } } }));
}

TEST(Lines, AlongPeriodicAxesOnly)
{
  const Points first = { { 9, 9, 9 } };
  const Points second = { { 1, 1, 1 } };
  const auto drawn = [&](const char* boundary, PeriodicLines periodic) {
    return make(first, second, box_of({ 0, 0, 0 }, { 10, 10, 10 }, boundary), periodic).lines;
  };
  for (const PeriodicLines periodic : { PeriodicLines::MinimumImage, PeriodicLines::Split })
  {
    EXPECT_EQ(drawn("", periodic), (std::vector<Line>{ { first[0], second[0] } }));
    EXPECT_EQ(drawn("ff mm ss", periodic), (std::vector<Line>{ { first[0], second[0] } }));
  }
  EXPECT_EQ(drawn("pp pp ff", PeriodicLines::MinimumImage),
    (std::vector<Line>{ { { 9, 9, 9 }, { 11, 11, 1 } } }));
  EXPECT_EQ(drawn("ff pp ff", PeriodicLines::Split),
    (std::vector<Line>{ { { 9, 9, 9 }, { 5, 10, 5 } }, { { 5, 0, 5 }, { 1, 1, 1 } } }));
}

TEST(Lines, BoxesWithoutExtent)
{
  // flat, as those of two dimensions are; and with an axis that is no number
  for (const double z : { 0., nan, infinity })
  {
    const Box flat = box_of({ 0, 0, 0 }, { 10, 10, z }, "pp pp pp");
    EXPECT_EQ(make({ { 9, 5, 7 } }, { { 3, 5, -7 } }, flat, PeriodicLines::Split).lines,
      (std::vector<Line>{ { { 9, 5, 7 }, { 10, 5, 3.5 } }, { { 0, 5, 3.5 }, { 3, 5, -7 } } }));
    EXPECT_EQ(make({ { 9, 5, 7 } }, { { 3, 5, -7 } }, flat, PeriodicLines::MinimumImage).lines,
      (std::vector<Line>{ { { 9, 5, 7 }, { 13, 5, -7 } } }));
  }
}

TEST(Lines, NoRows)
{
  for (const PeriodicLines periodic :
    { PeriodicLines::MinimumImage, PeriodicLines::Split, PeriodicLines::AsWritten })
  {
    const Made made = make({}, {}, ten, periodic);
    EXPECT_TRUE(made.lines.empty());
    EXPECT_TRUE(made.rows.empty());
    EXPECT_EQ(made.moved, 0);
  }
}

TEST(Lines, EndsThatAreNoNumbersPassThrough)
{
  for (const PeriodicLines periodic :
    { PeriodicLines::MinimumImage, PeriodicLines::Split, PeriodicLines::AsWritten })
  {
    const Made made = make({ { nan, 9, 9 }, { 1, 1, 1 } }, { { 1, 1, 1 }, { 1, infinity, 1 } }, ten,
      periodic, { 1, 1, 1 });
    ASSERT_EQ(made.lines.size(), 2u);
    EXPECT_TRUE(std::isnan(made.lines[0].begin[0]));
    EXPECT_EQ(made.lines[0].begin[1], 8);
    EXPECT_EQ(made.lines[0].end, (Vector3{ 0, 0, 0 }));
    EXPECT_EQ(made.lines[1].end, (Vector3{ 0, infinity, 0 }));
    EXPECT_TRUE(std::isnan(made.lengths[0]));
    EXPECT_EQ(made.lengths[1], infinity);
    EXPECT_EQ(made.moved, 0);
  }
}

TEST(Lines, LengthsOfAnySize)
{
  const Made made = make({ { 0, 0, 0 }, { 0, 0, 0 } },
    { { 3e-200, 4e-200, 0 }, { 3e200, 4e200, 0 } }, Box{}, PeriodicLines::MinimumImage);
  EXPECT_DOUBLE_EQ(made.lengths[0], 5e-200);
  EXPECT_DOUBLE_EQ(made.lengths[1], 5e200);
}

// ---- held against 113 bits ---------------------------------------------------------------------

class Numbers
{
public:
  double between(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  Vector3 vector(double lo, double hi)
  {
    return { this->between(lo, hi), this->between(lo, hi), this->between(lo, hi) };
  }

private:
  std::mt19937 engine_{ 19920401 };
};

Quad exact(const granular::Twofold& number)
{
  return static_cast<Quad>(number.hi) + static_cast<Quad>(number.lo);
}

/// That many box vectors, added to a point.
Quad3 moved(const Box& box, const Vector3& point, const BoxCounts& counts)
{
  Quad3 result;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    result[axis] = point[axis];
    for (std::size_t i = 0; i < 3; ++i)
    {
      result[axis] += static_cast<Quad>(counts[i]) * exact(box.vectors[i][axis]);
    }
  }
  return result;
}

/// A point that lies in the box where it says so, to the digits of doubles.
Vector3 point_in(const Box& box, const Vector3& scaled)
{
  Vector3 point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Quad sum = exact(box.origin[axis]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      sum += static_cast<Quad>(scaled[i]) * exact(box.vectors[i][axis]);
    }
    point[axis] = static_cast<double>(sum);
  }
  return point;
}

Quad determinant(const Quad3& a, const Quad3& b, const Quad3& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// How many of each box vector a point is from the corner of the box.
Vector3 scaled(const Box& box, const Vector3& point)
{
  std::array<Quad3, 3> vectors;
  Quad3 from;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    from[axis] = static_cast<Quad>(point[axis]) - exact(box.origin[axis]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      vectors[i][axis] = exact(box.vectors[i][axis]);
    }
  }
  const Quad volume = determinant(vectors[0], vectors[1], vectors[2]);
  return { static_cast<double>(determinant(from, vectors[1], vectors[2]) / volume),
    static_cast<double>(determinant(vectors[0], from, vectors[2]) / volume),
    static_cast<double>(determinant(vectors[0], vectors[1], from) / volume) };
}

std::vector<Box> random_boxes(Numbers& numbers, int count)
{
  constexpr const char* boundaries[] = { "pp pp pp", "pp pp ff", "ff pp pp", "pp ff ff" };
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i)
  {
    const double far = i % 4 == 0 ? 1e6 : 1;
    const Vector3 lo = numbers.vector(-far, far);
    const Vector3 size = numbers.vector(0.5, 2);
    const Vector3 hi = { lo[0] + size[0], lo[1] + size[1], lo[2] + size[2] };
    if (i % 3 == 0)
    {
      boxes.push_back(Box::from_bounds(lo, hi));
    }
    else if (i % 3 == 1)
    {
      const Vector3 tilt = numbers.vector(-2, 2);
      boxes.push_back(Box::from_tilted_bounds(lo,
        { hi[0] + std::abs(tilt[0]) + std::abs(tilt[1]), hi[1] + std::abs(tilt[2]), hi[2] },
        tilt[0], tilt[1], tilt[2]));
    }
    else
    {
      boxes.push_back(Box::from_vectors(
        lo, { numbers.vector(-0.3, 0.3), numbers.vector(-0.3, 0.3), numbers.vector(-0.3, 0.3) }));
      for (std::size_t k = 0; k < 3; ++k)
      {
        boxes.back().vectors[k][k].hi += 1;
      }
    }
    boxes.back().boundary = boundaries[i % 4];
  }
  return boxes;
}

/// Ends in the box, or just outside of it.
struct Ends
{
  Points first, second;
};

Ends random_ends(Numbers& numbers, const Box& box, int count, double outside)
{
  Ends ends;
  for (int i = 0; i < count; ++i)
  {
    ends.first.push_back(point_in(box, numbers.vector(-outside, 1 + outside)));
    ends.second.push_back(point_in(box, numbers.vector(-outside, 1 + outside)));
  }
  return ends;
}

/// Of a number of that size: the bound of all that is tested here is half a unit of its last place, once.
double half_ulp(double number)
{
  return 0.5000001 * ulp(number);
}

TEST(Lines, EndsAndLengthsAreRoundedOnce)
{
  HardCase hard(
    "lengths", "lines across flat, tilted and general boxes, up to 1e6 away: error", "ulp", 2);
  Numbers numbers;
  for (const Box& box : random_boxes(numbers, 200))
  {
    const Ends ends = random_ends(numbers, box, 20, 0.1);
    const Vector3 origin = point_in(box, numbers.vector(0, 1));
    const Made made = make(ends.first, ends.second, box, PeriodicLines::MinimumImage, origin);
    const MinimumImage images(box);
    std::int64_t not_where_it_was = 0;
    for (std::size_t row = 0; row < made.lines.size(); ++row)
    {
      const Vector3& first = ends.first[row];
      const Vector3& second = ends.second[row];
      const BoxCounts counts =
        images.find({ second[0] - first[0], second[1] - first[1], second[2] - first[2] });
      const Quad3 image = moved(box, second, counts);
      not_where_it_was += counts != BoxCounts{};
      Quad square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const Quad end = image[axis] - static_cast<Quad>(origin[axis]);
        EXPECT_EQ(made.lines[row].begin[axis], first[axis] - origin[axis]);
        EXPECT_LE(static_cast<double>(absolute(static_cast<Quad>(made.lines[row].end[axis]) - end)),
          half_ulp(static_cast<double>(end)) + 1e6 * 0x1p-98);
        const Quad along = image[axis] - static_cast<Quad>(first[axis]);
        square += along * along;
      }
      const double length = std::sqrt(static_cast<double>(square));
      EXPECT_NEAR(made.lengths[row], length, 0x1p-51 * length);
      // the square of the computed length less the true square, by twice the length: the error to first order, in 113 bits
      const Quad difference = static_cast<Quad>(made.lengths[row]) * made.lengths[row] - square;
      hard.add(
        static_cast<double>(absolute(difference) / (2 * static_cast<Quad>(length))) / ulp(length));
    }
    EXPECT_EQ(made.moved, not_where_it_was);
    EXPECT_GT(made.moved, 0);
  }
}

/// Far from the origin, a line that is short shows as many digits as its ends have.
TEST(Lines, ShortLinesFarFromTheOrigin)
{
  const Box far = box_of({ 1e6, 1e6, 1e6 }, { 1e6 + 1, 1e6 + 1, 1e6 + 1 }, "pp pp pp");
  const double step = 0x1p-14;
  const Made made = make({ { 1e6 + 1 - step, 1e6, 1e6 } }, { { 1e6 + 2 * step, 1e6, 1e6 } }, far,
    PeriodicLines::Split, { 1e6, 1e6, 1e6 });
  EXPECT_EQ(made.lines,
    (std::vector<Line>{
      { { 1 - step, 0, 0 }, { 1, 0, 0 } }, { { 0, 0, 0 }, { 2 * step, 0, 0 } } }));
  EXPECT_EQ(made.lengths, (std::vector<double>{ 3 * step }));
}

TEST(Lines, PartsLieInTheBoxAndMeetAtItsFaces)
{
  Numbers numbers;
  std::array<int, 5> with_parts = {};
  for (const Box& box : random_boxes(numbers, 300))
  {
    const Ends ends = random_ends(numbers, box, 20, 0);
    const Made made = make(ends.first, ends.second, box, PeriodicLines::Split);
    const MinimumImage images(box);
    // rounding of coordinates, and how far it shows in a box that is not a cube
    const double near = 0x1p-45 *
      std::max(1.,
        std::abs(box.origin[0].value()) + std::abs(box.origin[1].value()) +
          std::abs(box.origin[2].value()));
    std::size_t line = 0;
    for (std::size_t row = 0; row < ends.first.size(); ++row)
    {
      const std::size_t begin = line;
      while (line < made.lines.size() &&
        (made.rows.empty() ? line : static_cast<std::size_t>(made.rows[line])) == row)
      {
        ++line;
      }
      ASSERT_GT(line, begin);
      ++with_parts.at(line - begin);
      const Vector3& first = ends.first[row];
      const Vector3& second = ends.second[row];
      const BoxCounts counts =
        images.find({ second[0] - first[0], second[1] - first[1], second[2] - first[2] });
      const bool one_box =
        std::all_of(counts.begin(), counts.end(), [](std::int64_t k) { return std::abs(k) <= 1; });
      EXPECT_EQ(made.lines[begin].begin, first);
      EXPECT_EQ(made.lines[line - 1].end, second);
      double length = 0;
      std::array<double, 3> jumps = {};
      for (std::size_t i = begin; i < line; ++i)
      {
        const auto& [from, to] = made.lines[i];
        length += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        const Vector3 from_scaled = scaled(box, from);
        const Vector3 to_scaled = scaled(box, to);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          if (one_box || counts[axis] == 0)
          {
            EXPECT_GE(std::min(from_scaled[axis], to_scaled[axis]), -near) << axis;
            EXPECT_LE(std::max(from_scaled[axis], to_scaled[axis]), 1 + near) << axis;
          }
          if (i > begin)
          {
            // from where the part before ended, along one axis, from face to face
            const double jump = from_scaled[axis] - scaled(box, made.lines[i - 1].end)[axis];
            EXPECT_NEAR(jump, std::round(jump), near);
            jumps[axis] += jump;
          }
        }
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(jumps[axis], -static_cast<double>(counts[axis]), near);
      }
      EXPECT_NEAR(length, made.lengths[row], near * std::max(1., length));
      EXPECT_EQ(line - begin == 1, counts == BoxCounts{});
    }
    EXPECT_EQ(line, made.lines.size());
  }
  EXPECT_GT(with_parts[2], 100);
  EXPECT_GT(with_parts[3], 100);
  EXPECT_GT(with_parts[4], 20);
}

// ---- threads, memory, being stopped ------------------------------------------------------------

TEST(Lines, ThreadsChangeNothing)
{
  Numbers numbers;
  const Ends ends = random_ends(numbers, ten, 100000, 0.01);
  for (const PeriodicLines periodic :
    { PeriodicLines::MinimumImage, PeriodicLines::Split, PeriodicLines::AsWritten })
  {
    const Made one = make(ends.first, ends.second, ten, periodic, { 1, 2, 3 });
    const Made four = make(ends.first, ends.second, ten, periodic, { 1, 2, 3 }, 4);
    EXPECT_EQ(one.lines, four.lines);
    EXPECT_EQ(one.lengths, four.lengths);
    EXPECT_EQ(one.rows, four.rows);
    EXPECT_EQ(one.moved, four.moved);
    EXPECT_EQ(one.lines.size() > ends.first.size(), periodic == PeriodicLines::Split);
  }
}

TEST(Lines, CanBeStopped)
{
  const std::vector<double> ends(3 * 100000, 1.);
  Request request;
  request.periodic_lines = PeriodicLines::Split;
  for (const int steps : { 0, 1, 9 })
  {
    Stop progress(steps);
    EXPECT_THROW(granular::make_lines(ends, ends, ten, request, progress), granular::Cancelled);
  }
  Stop progress(1000);
  EXPECT_EQ(granular::make_lines(ends, ends, ten, request, progress).count, 100000);
}

TEST(Lines, MemoryComesFromThePool)
{
  const std::vector<double> ends(3 * 300000, 1.);
  Request request;
  request.pool = std::make_shared<granular::BlockPool>(std::size_t{ 1 } << 30);
  Progress progress;
  {
    const Lines lines = granular::make_lines(ends, ends, ten, request, progress);
    EXPECT_EQ(lines.points.pool(), request.pool);
    EXPECT_EQ(lines.lengths.pool(), request.pool);
  }
  EXPECT_GT(request.pool->idle_bytes(), 300000 * 48u);
}

// ---- real files --------------------------------------------------------------------------------

Box box_of(const TextFrame& frame)
{
  return box_of({ frame.lo[0], frame.lo[1], frame.lo[2] },
    { frame.hi[0], frame.hi[1], frame.hi[2] }, frame.boundary);
}

/// LIGGGHTS says itself which contacts cross a periodic face: column 9.
TEST(Lines, ContactsOfLiggghts)
{
  std::size_t periodic = 0;
  for (const TextFrame& frame : read_text_frames(GRANULAR_DATA "/good/local/contacts.dump"))
  {
    Points first, second;
    for (const std::vector<double>& row : frame.rows)
    {
      first.push_back({ row[0], row[1], row[2] });
      second.push_back({ row[3], row[4], row[5] });
    }
    const Made made = make(first, second, box_of(frame), PeriodicLines::MinimumImage);
    for (std::size_t row = 0; row < frame.rows.size(); ++row)
    {
      EXPECT_EQ(made.lines[row].end != second[row], frame.rows[row][8] == 1) << frame.timestep;
      EXPECT_LT(made.lengths[row], 0.0071); // the largest two particles
      periodic += frame.rows[row][8] == 1;
    }
    const Made split = make(first, second, box_of(frame), PeriodicLines::Split);
    EXPECT_EQ(split.lines.size(), first.size() + static_cast<std::size_t>(made.moved));
    EXPECT_EQ(split.lengths, made.lengths);
  }
  EXPECT_EQ(periodic, 14u);
}

// All were printed with six digits: where an end is near the origin and the other one across the box, the other counts.
TEST(Lines, LengthsThatAreNotWhatAFileSays)
{
  const auto misfits = [](double length, double dist, double first, double second)
  {
    const double ends[] = { first, 0, 0, second, 0, 0 };
    return granular::count_misfits(
      { &length, 1 }, { &dist, 1 }, { ends, 3 }, { std::begin(ends) + 3, 3 });
  };
  EXPECT_EQ(
    misfits(0.01358456, 0.0135821, 0.00123456, 9.98765), 0); // in a box of 10, from 9.98765249
  EXPECT_EQ(misfits(0.01358456, 0.0135821, 0.00123456, 0.01481902), 1);
  EXPECT_EQ(misfits(1, 1.00008, -1, -2), 0);
  EXPECT_EQ(misfits(1, 1.0002, -1, -2), 1);
  EXPECT_EQ(misfits(0, 0, 0, 0), 0);
  EXPECT_EQ(misfits(0, 1e-9, 0, 0), 1);
  EXPECT_EQ(misfits(nan, 1, 1, 2), 1);
  EXPECT_EQ(granular::count_misfits({}, {}, {}, {}), 0);
}
}
