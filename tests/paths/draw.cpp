// SPDX-License-Identifier: BSD-3-Clause
// Paths drawn as lines: whole, or cut at the faces of the box.
#include "../support/hard_case.h"
#include "path_checks.h"

#include "granular/lines/lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

using namespace granular;
using namespace path_checks;
using walks::grid;

namespace
{
using Numbers = std::vector<std::int64_t>;
using Doubles = std::vector<double>;

/// Paths of one particle with id 7 in the box from 0 to 10, periodic along x, at these x in these frames.
Paths line_along_x(const Doubles& xs, const std::vector<std::int32_t>& frames, bool crossings)
{
  std::vector<PathFrame> all(static_cast<std::size_t>(frames.back()) + 1);
  for (PathFrame& frame : all)
  {
    frame.loaded = true;
    frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 10, 10, 10 });
    frame.header.box.boundary = "pp pp ff";
  }
  for (std::size_t i = 0; i < xs.size(); ++i)
  {
    all[static_cast<std::size_t>(frames[i])].ids = { 7 };
    all[static_cast<std::size_t>(frames[i])].points = { xs[i], 5, 5 };
  }
  SerialCommunicator alone;
  PathJoin options;
  options.crossings = crossings;
  return join(all, options, alone);
}

Doubles xs_of(const PathLines& lines)
{
  Doubles xs;
  for (std::size_t i = 0; i < lines.points.size(); i += 3)
  {
    xs.push_back(lines.points[i]);
  }
  return xs;
}

double distance(const double* a, const double* b)
{
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// How far a point is outside of a box, in lengths of its vectors.
double outside(const Box& box, const double* point)
{
  const Vector3 origin = values_of(box.origin);
  Vector3 rest = { point[0] - origin[0], point[1] - origin[1], point[2] - origin[2] };
  double most = 0;
  for (const std::size_t axis : { 2U, 1U, 0U })
  {
    const Vector3 vector = values_of(box.vectors[axis]);
    const double part = rest[axis] / vector[axis];
    most = std::max({ most, -part, part - 1 });
    for (std::size_t k = 0; k < 3; ++k)
    {
      rest[k] -= part * vector[k];
    }
  }
  return most;
}
}

TEST(DrawPaths, Whole)
{
  const Paths paths = line_along_x({ 8, 1, 3, 4, 9 }, { 0, 1, 2, 4, 6 }, false);
  const PathLines lines = draw_paths(paths, {});
  EXPECT_EQ(xs_of(lines), (Doubles{ 8, 11, 13, 14, 19 }));
  EXPECT_EQ(lines.begins, (Numbers{ 0, 3, 4, 5 }));
  EXPECT_EQ(lines.places, (Numbers{ 0, 1, 2, 3, 4 }));
  EXPECT_EQ(lines.paths, (Numbers{ 0, 0, 0 }));
  EXPECT_EQ(lines.lengths, (Doubles{ 5, 0, 0 }));
  EXPECT_EQ(Doubles(5), lines.parts);
}

TEST(DrawPaths, CutAtTheFaces)
{
  const Paths paths = line_along_x({ 8, 1, 3, 4, 9, 8 }, { 0, 1, 2, 4, 5, 6 }, true);
  const PathLines lines = draw_paths(paths, { 1, 0, 0 });
  EXPECT_EQ(xs_of(lines), (Doubles{ 7, 9, -1, 0, 2, 3, 8, 7 }));
  EXPECT_EQ(lines.begins, (Numbers{ 0, 2, 5, 8 }));
  EXPECT_EQ(lines.places, (Numbers{ 0, 0, 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ(lines.paths, (Numbers{ 0, 0, 0 }));
  EXPECT_EQ(lines.lengths, (Doubles{ 5, 5, 6 }));
  const double part = 2. / 3;
  ASSERT_EQ(lines.parts.size(), 8U);
  EXPECT_NEAR(lines.parts[1], part, 1e-15);
  EXPECT_NEAR(lines.parts[2], part, 1e-15);
  for (const std::size_t i : { 0U, 3U, 4U, 5U, 6U, 7U })
  {
    EXPECT_EQ(lines.parts[i], 0) << i;
  }
}

/// A step from a face or to one goes on at the opposite face.
TEST(DrawPaths, PlacesInTheFaces)
{
  const PathLines from = draw_paths(line_along_x({ 0, 9, 8 }, { 0, 1, 2 }, true), {});
  EXPECT_EQ(xs_of(from), (Doubles{ 0, 10, 9, 8 }));
  EXPECT_EQ(from.begins, (Numbers{ 0, 1, 4 }));
  EXPECT_EQ(from.places, (Numbers{ 0, 0, 1, 2 }));
  EXPECT_EQ(from.parts, Doubles(4));
  const PathLines to = draw_paths(line_along_x({ 8, 9, 0, 1 }, { 0, 1, 2, 3 }, true), {});
  EXPECT_EQ(xs_of(to), (Doubles{ 8, 9, 10, 0, 1 }));
  EXPECT_EQ(to.begins, (Numbers{ 0, 3, 5 }));
  EXPECT_EQ(to.places, (Numbers{ 0, 1, 1, 2, 3 }));
  EXPECT_EQ(to.parts, (Doubles{ 0, 0, 1, 0, 0 }));
  // along the face, and from one to the other
  Paths paths = line_along_x({ 0, 0, 2 }, { 0, 1, 2 }, true);
  paths.crossings[3] = -1;
  const PathLines over = draw_paths(paths, { 0.1, 0, 0 });
  for (std::size_t i = 1; i < over.places.size(); ++i)
  {
    const bool starts =
      std::ranges::find(over.begins, static_cast<std::int64_t>(i)) != over.begins.end();
    EXPECT_TRUE(starts || std::abs(xs_of(over)[i] - xs_of(over)[i - 1]) <= 10) << i;
  }
  EXPECT_EQ(xs_of(over).back(), 1.9);
}

TEST(DrawPaths, NothingAtAll)
{
  const PathLines lines = draw_paths({}, {});
  EXPECT_EQ(lines.begins, Numbers{ 0 });
  EXPECT_TRUE(lines.points.empty() && lines.paths.empty() && lines.lengths.empty());
}

/// Walks in boxes of all kinds: lines end where others begin, on opposite faces.
TEST(DrawPaths, StaysInTheBox)
{
  HardCase inside("trajectories", "split lines: points outside the box", "box vectors", 1e-13);
  HardCase whole("trajectories",
    "split lines: parts of a step, together longer or shorter than the step", "relative", 1e-11);
  for (const walks::GridBox& kind :
    { walks::straight_box(), walks::tilted_box(), walks::leaning_box() })
  {
    for (const int absent : { 0, 30 })
    {
      // steps of less than a vector along each of them
      const bool leans = kind.vectors[1][0] > grid;
      const walks::Run run = walks::make_run(
        { kind }, { .longest = leans ? grid / 40 : grid / 3, .images = 3, .absent = absent }, 51);
      SerialCommunicator alone;
      PathJoin options;
      options.crossings = true;
      const Paths paths = join(walks::frames_of(run, {}), options, alone);
      const Vector3 origin = { 0.5, -3, 0.25 };
      const PathLines lines = draw_paths(paths, origin);
      const Box box = kind.box();
      const MinimumImage images(box);

      std::map<std::int64_t, double> lengths; // of steps, by the place where they begin
      std::size_t stretches = 0;
      std::size_t cuts = 0;
      ASSERT_EQ(lines.begins.size(), lines.paths.size() + 1);
      for (std::size_t line = 0; line < lines.paths.size(); ++line)
      {
        const auto begin = static_cast<std::size_t>(lines.begins[line]);
        const auto end = static_cast<std::size_t>(lines.begins[line + 1]);
        ASSERT_LT(begin, end);
        for (std::size_t i = begin; i < end; ++i)
        {
          const Vector3 point = { lines.points[3 * i] + origin[0],
            lines.points[3 * i + 1] + origin[1], lines.points[3 * i + 2] + origin[2] };
          inside.add(outside(box, point.data()));
          ASSERT_TRUE(lines.parts[i] >= 0 && lines.parts[i] <= 1);
          ASSERT_TRUE(i == begin || lines.places[i] > lines.places[i - 1] ||
            lines.parts[i] >= lines.parts[i - 1]);
          if (i > begin)
          {
            lengths[lines.places[i - 1]] +=
              distance(lines.points.data() + 3 * (i - 1), lines.points.data() + 3 * i);
          }
        }
        // does it go on where the one before has ended?
        const bool goes_on = lines.parts[begin] > 0;
        stretches += goes_on ? 0 : 1;
        if (goes_on)
        {
          ++cuts;
          ASSERT_EQ(lines.places[begin], lines.places[begin - 1]);
          ASSERT_EQ(lines.parts[begin], lines.parts[begin - 1]);
          ASSERT_EQ(lines.paths[line], lines.paths[line - 1]);
          ASSERT_EQ(lines.lengths[line], lines.lengths[line - 1]);
          Vector3 jump;
          for (std::size_t k = 0; k < 3; ++k)
          {
            jump[k] = lines.points[3 * begin + k] - lines.points[3 * (begin - 1) + k];
          }
          const Vector3 rest = images.moved(jump, images.find(jump), {});
          EXPECT_LT(std::hypot(rest[0], rest[1], rest[2]), 1e-13);
        }
      }
      EXPECT_GT(cuts, 50U);
      std::size_t expected = 0;
      for (std::size_t path = 0; path < paths.ids.size(); ++path)
      {
        for (auto i = static_cast<std::size_t>(paths.begins[path]);
             i < static_cast<std::size_t>(paths.begins[path + 1]); ++i)
        {
          const bool first = i == static_cast<std::size_t>(paths.begins[path]) ||
            paths.frames[i] != paths.frames[i - 1] + 1;
          expected += first ? 1 : 0;
          if (!first)
          {
            const double step =
              distance(paths.points.data() + 3 * (i - 1), paths.points.data() + 3 * i);
            whole.add(std::abs(lengths[static_cast<std::int64_t>(i) - 1] - step) / step);
          }
        }
      }
      EXPECT_EQ(stretches, expected);
    }
  }
}

/// Each place is a point of a line, once, and as its frame has it.
TEST(DrawPaths, HasAllPlaces)
{
  const walks::Run run =
    walks::make_run({ walks::leaning_box() }, { .longest = grid / 3, .absent = 20 }, 52);
  SerialCommunicator alone;
  for (const bool crossings : { false, true })
  {
    PathJoin options;
    options.crossings = crossings;
    const Paths paths = join(walks::frames_of(run, {}), options, alone);
    const PathLines lines = draw_paths(paths, {});
    const Doubles& points = crossings ? paths.shown : paths.points;
    std::int64_t next = 0;
    for (std::size_t i = 0; i < lines.places.size(); ++i)
    {
      if (lines.parts[i] == 0)
      {
        ASSERT_EQ(lines.places[i], next++);
        for (std::size_t k = 0; k < 3; ++k)
        {
          ASSERT_EQ(
            lines.points[3 * i + k], points[3 * static_cast<std::size_t>(lines.places[i]) + k]);
        }
      }
    }
    EXPECT_EQ(next, paths.places());
    // lengths are those of stretches
    for (std::size_t line = 0; line < lines.paths.size(); ++line)
    {
      auto first =
        static_cast<std::size_t>(lines.places[static_cast<std::size_t>(lines.begins[line])]);
      auto last = first;
      const auto path = static_cast<std::size_t>(lines.paths[line]);
      while (first > static_cast<std::size_t>(paths.begins[path]) &&
        paths.frames[first - 1] == paths.frames[first] - 1)
      {
        --first;
      }
      while (last + 1 < static_cast<std::size_t>(paths.begins[path + 1]) &&
        paths.frames[last + 1] == paths.frames[last] + 1)
      {
        ++last;
      }
      double length = 0;
      for (std::size_t i = first; i < last; ++i)
      {
        length += distance(paths.points.data() + 3 * i, paths.points.data() + 3 * (i + 1));
      }
      ASSERT_NEAR(lines.lengths[line], length, 1e-12 * length);
    }
  }
}

/// A step over several boxes goes through each of them, and keeps its length; one over very many is not drawn.
TEST(DrawPaths, StepsOverSeveralBoxes)
{
  Paths paths = line_along_x({ 9, 1 }, { 0, 1 }, true);
  paths.crossings = { 0, 0, 0, 3, 0, 0 };
  paths.points[3] = 31;
  const PathLines lines = draw_paths(paths, {});
  EXPECT_EQ(xs_of(lines), (Doubles{ 9, 10, 0, 4.5, 10, 0, 5.5, 10, 0, 1 }));
  EXPECT_EQ(lines.lengths, (Doubles{ 22, 22, 22, 22 }));
  EXPECT_TRUE(std::ranges::is_sorted(lines.parts.begin(), lines.parts.end() - 1));

  paths.crossings[3] = -PathLines::most_periods;
  paths.points[3] = 1 - 10. * static_cast<double>(PathLines::most_periods);
  const PathLines many = draw_paths(paths, {});
  double way = 0;
  for (std::size_t line = 0; line < many.paths.size(); ++line)
  {
    for (std::int64_t i = many.begins[line]; i + 1 < many.begins[line + 1]; ++i)
    {
      way += std::abs(many.points[static_cast<std::size_t>(3 * i + 3)] -
        many.points[static_cast<std::size_t>(3 * i)]);
    }
  }
  EXPECT_NEAR(way, many.lengths[0], 1e-10);
  for (const double x : xs_of(many))
  {
    EXPECT_GE(x, -1e-12);
    EXPECT_LE(x, 10 + 1e-12);
  }
  --paths.crossings[3];
  EXPECT_EQ(xs_of(draw_paths(paths, {})), (Doubles{ 9, 1 }));
  EXPECT_EQ(draw_paths(paths, {}).begins, (std::vector<std::int64_t>{ 0, 1, 2 }));
}

// ---- speeds ------------------------------------------------------------------------------------

TEST(PathSpeeds, OfStepsOnBothSides)
{
  const Paths paths = line_along_x({ 8, 1, 3, 4, 9, 8 }, { 0, 1, 2, 4, 5, 6 }, false);
  const Doubles times = { 0, 1, 3, 4, 5, 5.5, 6 };
  // 3 in 1, 5 in 3, 2 in 2; alone in the gap: 5 in 0.5, 6 in 1, 1 in 0.5
  EXPECT_EQ(find_speeds(paths, times), (Doubles{ 3, 5. / 3, 1, 10, 6, 2 }));
}

TEST(PathSpeeds, SinglePlacesAndTimesThatStand)
{
  EXPECT_EQ(find_speeds(line_along_x({ 8, 9, 5 }, { 0, 2, 4 }, false), Doubles{ 0, 1, 2, 3, 4 }),
    Doubles(3));
  EXPECT_EQ(
    find_speeds(line_along_x({ 8, 9, 5 }, { 0, 1, 2 }, false), Doubles{ 2, 2, 2 }), Doubles(3));
  EXPECT_TRUE(find_speeds({}, {}).empty());
}
