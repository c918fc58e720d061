// SPDX-License-Identifier: BSD-3-Clause
// Conversions of coordinates against 113 bits:
// |result - exact| <= ulp(exact) + 2^-100 * sum of |terms| of the fully expanded formula.
#include "granular/geometry/positions.h"

#include "granular/common/words.h"

#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using granular::Box;
using granular::ColumnSchema;
using granular::Coordinates;
using granular::Notices;
using granular::PositionPlan;
using granular::Vector3;
using Exact3 = std::array<Exact, 3>;

/// The forms that coordinates have in files.
enum class Form
{
  Position,
  Scaled,
  Unwrapped,
  ScaledUnwrapped
};

constexpr Form forms[] = { Form::Position, Form::Scaled, Form::Unwrapped, Form::ScaledUnwrapped };
constexpr const char* form_names[] = { "x", "xs", "xu", "xsu" };
constexpr const char* form_columns[] = { "x y z", "xs ys zs", "xu yu zu", "xsu ysu zsu" };
constexpr Coordinates all_coordinates[] = { Coordinates::Absolute, Coordinates::Unwrapped,
  Coordinates::Scaled };

ColumnSchema schema_of(const std::string& names)
{
  const std::vector<std::string_view> words = granular::split_words(names);
  return ColumnSchema(std::vector<std::string>(words.begin(), words.end()));
}

/// A box as the file has it, and as 113 bits have it.
struct Cell
{
  const char* kind = "";
  Box box;
  Exact3 origin;
  std::array<Exact3, 3> vectors;
};

Cell aligned_cell(const Vector3& lo, const Vector3& hi)
{
  Cell cell;
  cell.box = Box::from_bounds(lo, hi);
  for (std::size_t k = 0; k < 3; ++k)
  {
    cell.origin[k] = lo[k];
    cell.vectors[k][k] = Exact(hi[k]) - Exact(lo[k]);
  }
  return cell;
}

Cell tilted_cell(const Vector3& lo, const Vector3& hi, double xy, double xz, double yz)
{
  Cell cell;
  cell.box = Box::from_tilted_bounds(lo, hi, xy, xz, yz);
  const Exact both = Exact(xy) + Exact(xz);
  const Exact low_x = least({ 0.0, xy, xz, both });
  const Exact low_y = least({ 0.0, yz });
  cell.origin = { Exact(lo[0]) - low_x, Exact(lo[1]) - low_y, Exact(lo[2]) };
  cell.vectors[0][0] = Exact(hi[0]) - greatest({ 0.0, xy, xz, both }) - Exact(lo[0]) + low_x;
  cell.vectors[1][1] = Exact(hi[1]) - greatest({ 0.0, yz }) - Exact(lo[1]) + low_y;
  cell.vectors[2][2] = Exact(hi[2]) - Exact(lo[2]);
  cell.vectors[1][0] = xy;
  cell.vectors[2][0] = xz;
  cell.vectors[2][1] = yz;
  return cell;
}

Cell general_cell(const Vector3& origin, const std::array<Vector3, 3>& vectors)
{
  Cell cell;
  cell.box = Box::from_vectors(origin, vectors);
  for (std::size_t k = 0; k < 3; ++k)
  {
    cell.origin[k] = origin[k];
    for (std::size_t j = 0; j < 3; ++j)
    {
      cell.vectors[k][j] = vectors[k][j];
    }
  }
  return cell;
}

Exact dot(const Exact3& a, const Exact3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Exact3 cross(const Exact3& a, const Exact3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Exact3 to_scaled(const Cell& cell, const Exact3& point)
{
  Exact3 offset;
  Exact3 scaled;
  for (std::size_t k = 0; k < 3; ++k)
  {
    offset[k] = point[k] - cell.origin[k];
  }
  const auto& v = cell.vectors;
  if (cell.box.general)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Exact3 normal = cross(v[(k + 1) % 3], v[(k + 2) % 3]);
      scaled[k] = dot(normal, offset) / dot(normal, v[k]);
    }
    return scaled;
  }
  scaled[2] = offset[2] / v[2][2];
  scaled[1] = (offset[1] - scaled[2] * v[2][1]) / v[1][1];
  scaled[0] = (offset[0] - scaled[1] * v[1][0] - scaled[2] * v[2][0]) / v[0][0];
  return scaled;
}

/// What images times the vectors add to absolute coordinates.
Exact3 shifted(const Cell& cell, Exact3 point, const Vector3& images)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      point[k] = point[k] + Exact(images[j]) * cell.vectors[j][k];
    }
  }
  return point;
}

Exact3 from_scaled(const Cell& cell, const Exact3& scaled)
{
  Exact3 point = cell.origin;
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      point[k] = point[k] + scaled[j] * cell.vectors[j][k];
    }
  }
  return point;
}

/// One particle: the numbers of its columns.
struct Particle
{
  Vector3 numbers;
  Vector3 images;
};

Exact3 expected(const Cell& cell, Form form, Coordinates wanted, const Particle& particle,
  const Vector3& point_origin)
{
  const bool is_scaled = form == Form::Scaled || form == Form::ScaledUnwrapped;
  const bool is_unwrapped = form == Form::Unwrapped || form == Form::ScaledUnwrapped;
  double sign = 0;
  if (wanted == Coordinates::Unwrapped)
  {
    sign = is_unwrapped ? 0 : 1;
  }
  else
  {
    sign = is_unwrapped ? -1 : 0;
  }
  Exact3 point = { particle.numbers[0], particle.numbers[1], particle.numbers[2] };
  if (wanted == Coordinates::Scaled)
  {
    point = is_scaled ? point : to_scaled(cell, point);
    for (std::size_t k = 0; k < 3; ++k)
    {
      point[k] = point[k] + Exact(sign * particle.images[k]) - Exact(point_origin[k]);
    }
    return point;
  }
  point = is_scaled ? from_scaled(cell, point) : point;
  if (sign != 0)
  {
    const Vector3 images = { sign * particle.images[0], sign * particle.images[1],
      sign * particle.images[2] };
    point = shifted(cell, point, images);
  }
  for (std::size_t k = 0; k < 3; ++k)
  {
    point[k] = point[k] - Exact(point_origin[k]);
  }
  return point;
}

class Cells
{
public:
  double unit() { return unit_(random_); }
  std::uint64_t below(std::uint64_t n) { return random_() % n; }

  Cell next()
  {
    constexpr Make makes[] = { &Cells::ordinary, &Cells::far_from_the_origin, &Cells::thin,
      &Cells::strongly_tilted, &Cells::tilted_far_away, &Cells::general, &Cells::thin_general };
    return (this->*makes[turn_++ % std::size(makes)])();
  }

  /// A particle in the cell, with the numbers of the form as a file would have them.
  Particle particle(const Cell& cell, Form form, bool rounded)
  {
    Particle particle;
    Exact3 scaled;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::uint64_t most = std::uint64_t{ 1 } << this->below(21);
      particle.images[k] =
        static_cast<double>(this->below(2 * most + 1)) - static_cast<double>(most);
      double place =
        this->below(8) == 0 ? static_cast<double>(this->below(2)) : 0.5 + 0.6 * this->unit();
      if (this->below(8) == 0 && !cell.box.tilted)
      {
        // where the coordinate is all but 0
        place = static_cast<double>(-cell.origin[k].value / cell.vectors[k][k].value);
      }
      scaled[k] = rounded ? std::round(place * 1e6) / 1e6 : place;
    }
    const bool is_scaled = form == Form::Scaled || form == Form::ScaledUnwrapped;
    const bool is_unwrapped = form == Form::Unwrapped || form == Form::ScaledUnwrapped;
    Exact3 numbers = scaled;
    if (!is_scaled)
    {
      numbers = from_scaled(cell, scaled);
      numbers = is_unwrapped ? shifted(cell, numbers, particle.images) : numbers;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      particle.numbers[k] = static_cast<double>(numbers[k].value);
      particle.numbers[k] += is_scaled && is_unwrapped ? particle.images[k] : 0;
    }
    return particle;
  }

private:
  using Make = Cell (Cells::*)();

  Vector3 vector(double size)
  {
    return { size * this->unit(), size * this->unit(), size * this->unit() };
  }

  Cell ordinary()
  {
    const Vector3 lo = this->vector(1);
    Cell cell = aligned_cell(lo, { lo[0] + 1 + this->unit(), lo[1] + 0.3, lo[2] + 7.7 });
    cell.kind = "ordinary";
    return cell;
  }

  /// A box of 1e-2 at 1e6.
  Cell far_from_the_origin()
  {
    const Vector3 lo = this->vector(1e6);
    Cell cell = aligned_cell(lo, { lo[0] + 1e-2, lo[1] + 1e-2 * (2 + this->unit()), lo[2] + 1e-9 });
    cell.kind = "1e-2 at 1e6";
    return cell;
  }

  /// 1e-12 thick, at the origin.
  Cell thin()
  {
    const double half = 1e-12 * (1.5 + this->unit());
    Cell cell = aligned_cell({ -half, -1, 0 }, { half / 3, 1 + this->unit() / 2, half });
    cell.kind = "1e-12 thin at the origin";
    return cell;
  }

  /// Tilts of 1e6 lengths.
  Cell strongly_tilted()
  {
    const Vector3 tilt = this->vector(1e6);
    const double low = std::min({ 0.0, tilt[0], tilt[1], tilt[0] + tilt[1] });
    const double high = std::max({ 0.0, tilt[0], tilt[1], tilt[0] + tilt[1] });
    const double x = this->unit();
    Cell cell = tilted_cell({ x + low, this->unit() + std::min(0.0, tilt[2]), -1 },
      { x + high + 2, 3 + std::max(0.0, tilt[2]), 0.1 }, tilt[0], tilt[1], tilt[2]);
    cell.kind = "tilts of 1e6 lengths";
    return cell;
  }

  Cell tilted_far_away()
  {
    const Vector3 place = this->vector(1e6);
    Cell cell = tilted_cell(place, { place[0] + 4e-2, place[1] + 3e-2, place[2] + 1e-2 },
      1e-2 * this->unit(), 1e-2 * this->unit(), 1e-2 * this->unit());
    cell.kind = "tilted, 1e-2 at 1e6";
    return cell;
  }

  Cell general()
  {
    const double place = this->below(2) == 0 ? 1e6 : 1;
    Cell cell;
    do
    {
      cell =
        general_cell(this->vector(place), { this->vector(1), this->vector(1), this->vector(1) });
    } while (this->badly_shaped(cell));
    cell.kind = "general";
    return cell;
  }

  Cell thin_general()
  {
    Cell cell;
    do
    {
      cell = general_cell({}, { this->vector(1), this->vector(1), this->vector(1e-12) });
    } while (this->badly_shaped(cell));
    cell.kind = "general, 1e-12 thin at the origin";
    return cell;
  }

  /// Where the volume is a difference of large numbers, 113 bits are no measure.
  bool badly_shaped(const Cell& cell)
  {
    const Exact volume = dot(cell.vectors[0], cross(cell.vectors[1], cell.vectors[2]));
    return absolute(volume.value) * 50 < volume.terms;
  }

  std::mt19937_64 random_{ 2024 };
  std::uniform_real_distribution<double> unit_{ -1, 1 };
  std::size_t turn_ = 0;
};

struct Worst
{
  double ratio = 0;
  std::string what = "none";
};

void compare(const Cell& cell, Form form, Coordinates wanted, Cells& cells, Worst& worst)
{
  const ColumnSchema schema =
    schema_of(std::string(form_columns[static_cast<int>(form)]) + " ix iy iz");
  Notices notices;
  const PositionPlan plan = granular::plan_positions(schema, cell.box, wanted, {}, notices);
  ASSERT_TRUE(notices.empty());
  ASSERT_EQ(plan.coordinates, wanted);

  constexpr std::size_t rows = 7;
  std::vector<Particle> particles;
  std::vector<double> points;
  std::vector<double> images;
  const bool rounded = cells.below(2) == 0;
  for (std::size_t row = 0; row < rows; ++row)
  {
    particles.push_back(cells.particle(cell, form, rounded));
    points.insert(points.end(), particles.back().numbers.begin(), particles.back().numbers.end());
    images.insert(images.end(), particles.back().images.begin(), particles.back().images.end());
  }
  Vector3 point_origin = {};
  if (cells.below(2) == 0)
  {
    // next to the first particle: all but nothing is left of it
    const Exact3 first = expected(cell, form, wanted, particles[0], {});
    point_origin = { static_cast<double>(first[0].value), static_cast<double>(first[1].value),
      static_cast<double>(first[2].value) };
  }
  const bool has_images = plan.images[0] >= 0;
  granular::convert_positions(plan, cell.box, point_origin,
    has_images ? std::span<const double>(images) : std::span<const double>(), points);
  for (std::size_t row = 0; row < rows; ++row)
  {
    const Exact3 exact = expected(cell, form, wanted, particles[row], point_origin);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double ratio = error_in_bounds(points[3 * row + k], exact[k]);
      if (!(ratio <= worst.ratio))
      {
        worst.ratio = ratio;
        worst.what = std::string(form_names[static_cast<int>(form)]) + " to " + to_string(wanted) +
          " in a box " + cell.kind + ", axis " + std::to_string(k);
      }
    }
  }
}
}

TEST(Positions, EveryConversionIsWithinItsBound)
{
  HardCase hard("positions, read",
    "all forms, boxes flat, far, tilted and general, images and PointOrigin: error over its bound",
    "bounds", 1);
  Cells cells;
  Worst worst;
  for (int i = 0; i < 7'000 && !HasFatalFailure(); ++i)
  {
    const Cell cell = cells.next();
    for (const Form form : forms)
    {
      for (const Coordinates wanted : all_coordinates)
      {
        compare(cell, form, wanted, cells, worst);
        hard.add(worst.ratio, 3 * 7);
      }
    }
  }
  RecordProperty("worst", std::to_string(worst.ratio));
  EXPECT_LE(worst.ratio, 1) << "in units of the bound, " << worst.what;
  EXPECT_GT(worst.ratio, 0.1) << "the numbers are too easy";
}

namespace
{
/// The outcome for one particle.
Vector3 convert(const std::string& columns, const Box& box, Coordinates wanted,
  const Vector3& numbers, const Vector3& images = {}, const Vector3& point_origin = {})
{
  Notices notices;
  const PositionPlan plan = granular::plan_positions(schema_of(columns), box, wanted, {}, notices);
  Vector3 point = numbers;
  granular::convert_positions(plan, box, point_origin,
    plan.images[0] >= 0 || plan.images[1] >= 0 || plan.images[2] >= 0
      ? std::span<const double>(images)
      : std::span<const double>(),
    point);
  return point;
}

/// All numbers that are none are the same.
std::uint64_t bits_of(double value)
{
  return std::isnan(value) ? ~std::uint64_t{ 0 } : std::bit_cast<std::uint64_t>(value);
}

const double not_a_number = std::nan("");
const double infinity = std::numeric_limits<double>::infinity();
}

// By hand: a box from (1, 2, 3) with the edges (10, 0, 0), (2, 10, 0), (-3, 4, 5).
TEST(Positions, HandComputedInATiltedBox)
{
  const Box box = Box::from_tilted_bounds({ -2, 2, 3 }, { 13, 16, 8 }, 2, -3, 4);
  EXPECT_EQ(
    convert("xs ys zs", box, Coordinates::Absolute, { 0.5, 0.25, 0.5 }), (Vector3{ 5, 6.5, 5.5 }));
  EXPECT_EQ(
    convert("x y z", box, Coordinates::Scaled, { 5, 6.5, 5.5 }), (Vector3{ 0.5, 0.25, 0.5 }));
  EXPECT_EQ(convert("x y z ix iy iz", box, Coordinates::Unwrapped, { 5, 6.5, 5.5 }, { 1, -1, 2 }),
    (Vector3{ 5 + 10 - 2 - 6, 6.5 - 10 + 8, 5.5 + 10 }));
  EXPECT_EQ(
    convert("xu yu zu ix iy iz", box, Coordinates::Absolute, { 7, 4.5, 15.5 }, { 1, -1, 2 }),
    (Vector3{ 5, 6.5, 5.5 }));
  EXPECT_EQ(
    convert("xsu ysu zsu ix iy iz", box, Coordinates::Absolute, { 1.5, -0.75, 2.5 }, { 1, -1, 2 }),
    (Vector3{ 5, 6.5, 5.5 }));
  EXPECT_EQ(
    convert("xsu ysu zsu ix iy iz", box, Coordinates::Scaled, { 1.5, -0.75, 2.5 }, { 1, -1, 2 }),
    (Vector3{ 0.5, 0.25, 0.5 }));
  EXPECT_EQ(convert("xs ys zs", box, Coordinates::Absolute, { 0.5, 0.25, 0.5 }, {}, { 5, 6, 5 }),
    (Vector3{ 0, 0.5, 0.5 }));
}

TEST(Positions, HandComputedInAGeneralBox)
{
  const Box box =
    Box::from_vectors({ 1, 2, 3 }, { Vector3{ 0, 4, 0 }, Vector3{ 0, 0, 2 }, Vector3{ 8, 0, 1 } });
  EXPECT_EQ(
    convert("xs ys zs", box, Coordinates::Absolute, { 0.5, 0.25, 0.5 }), (Vector3{ 5, 4, 4 }));
  EXPECT_EQ(convert("x y z", box, Coordinates::Scaled, { 5, 4, 4 }), (Vector3{ 0.5, 0.25, 0.5 }));
  EXPECT_EQ(convert("x y z ix iy iz", box, Coordinates::Unwrapped, { 5, 4, 4 }, { 1, 1, 1 }),
    (Vector3{ 13, 8, 7 }));
}

// In front of the box, behind it, lost: nothing is clamped or wrapped.
TEST(Positions, TrapScaledCoordinatesOutsideTheBox)
{
  const Box box = Box::from_bounds({ 0, 0, 0 }, { 10, 20, 40 });
  EXPECT_EQ(convert("xs ys zs", box, Coordinates::Absolute, { -0.125, 1.25, 1e6 }),
    (Vector3{ -1.25, 25, 4e7 }));
  EXPECT_EQ(
    convert("x y z", box, Coordinates::Scaled, { -1.25, 25, 4e7 }), (Vector3{ -0.125, 1.25, 1e6 }));
}

TEST(Positions, TrapFlatBoxes)
{
  // a 2d run: nothing is divided by the thickness unless scaled coordinates are asked for
  const Box flat = Box::from_bounds({ 0, 0, 2 }, { 10, 20, 2 });
  EXPECT_EQ(
    convert("xs ys zs", flat, Coordinates::Absolute, { 0.5, 0.5, 0.5 }), (Vector3{ 5, 10, 2 }));
  EXPECT_EQ(convert("x y z ix iy iz", flat, Coordinates::Unwrapped, { 1, 2, 2 }, { 1, 1, 1 }),
    (Vector3{ 11, 22, 2 }));
  const Vector3 scaled = convert("x y z", flat, Coordinates::Scaled, { 5, 10, 2 });
  EXPECT_EQ(scaled[0], 0.5);
  EXPECT_EQ(scaled[1], 0.5);
  EXPECT_FALSE(std::isfinite(scaled[2]));
}

// A particle that was lost on one axis keeps its other coordinates.
TEST(Positions, TrapNanAndInfinityStayOnTheirAxis)
{
  const Box box = Box::from_bounds({ 0, 0, 0 }, { 10, 20, 40 });
  for (const double bad : { not_a_number, infinity, -infinity })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector3 given = { 0.5, 0.5, 0.5 };
      given[axis] = bad;
      const Vector3 absolute = convert("xs ys zs", box, Coordinates::Absolute, given);
      const Vector3 scaled = convert("x y z", box, Coordinates::Scaled, given);
      const Vector3 moved = convert("x y z", box, Coordinates::Absolute, given, {}, { 1, 1, 1 });
      for (std::size_t k = 0; k < 3; ++k)
      {
        if (k == axis)
        {
          EXPECT_TRUE(std::isnan(bad) ? std::isnan(absolute[k]) : absolute[k] == bad);
          EXPECT_TRUE(std::isnan(bad) ? std::isnan(scaled[k]) : scaled[k] == bad);
          EXPECT_TRUE(std::isnan(bad) ? std::isnan(moved[k]) : moved[k] == bad);
        }
        else
        {
          EXPECT_EQ(absolute[k], 0.5 * static_cast<double>(10 << k)) << bad << " on axis " << axis;
          EXPECT_EQ(scaled[k], 0.5 / static_cast<double>(10 << k)) << bad << " on axis " << axis;
          EXPECT_EQ(moved[k], -0.5) << bad << " on axis " << axis;
        }
      }
    }
  }
}

TEST(Positions, NanInATiltedBoxReachesOnlyWhatItIsATermOf)
{
  const Box box = Box::from_tilted_bounds({ 0, 0, 0 }, { 12, 10, 10 }, 2, 0, 0);
  // y = ylo + ly * b + yz * c: no a in it
  const Vector3 absolute =
    convert("xs ys zs", box, Coordinates::Absolute, { not_a_number, 0.5, 0.5 });
  EXPECT_TRUE(std::isnan(absolute[0]));
  EXPECT_EQ(absolute[1], 5);
  EXPECT_EQ(absolute[2], 5);
  const Vector3 scaled = convert("x y z", box, Coordinates::Scaled, { not_a_number, 5, 5 });
  EXPECT_TRUE(std::isnan(scaled[0]));
  EXPECT_EQ(scaled[1], 0.5);
  EXPECT_EQ(scaled[2], 0.5);
}

TEST(Positions, InfiniteBoundsDoNotTouchAbsoluteCoordinates)
{
  const Box box = Box::from_bounds({ -infinity, not_a_number, 0 }, { infinity, not_a_number, 1 });
  EXPECT_EQ(convert("x y z", box, Coordinates::Absolute, { 1, 2, 3 }), (Vector3{ 1, 2, 3 }));
  EXPECT_EQ(convert("x y z", box, Coordinates::Absolute, { 1, 2, 3 }, {}, { 1, 1, 1 }),
    (Vector3{ 0, 1, 2 }));
}

TEST(Positions, LargeNumbersBecomeInfinityNotNan)
{
  const Box box = Box::from_bounds({ 0, 0, 0 }, { 1e200, 1e200, 1e200 });
  const Vector3 point = convert("xs ys zs", box, Coordinates::Absolute, { 1e200, -1e200, 0.5 });
  EXPECT_EQ(point, (Vector3{ infinity, -infinity, 5e199 }));
}

TEST(Positions, NumbersThatStayAsTheyAreStayToTheBit)
{
  const Box box = Box::from_bounds({ 0.1, 0.1, 0.1 }, { 0.3, 0.3, 0.3 });
  const Vector3 point = convert("x y z", box, Coordinates::Absolute, { -0.0, 5e-324, 0.1 });
  EXPECT_TRUE(std::signbit(point[0]));
  EXPECT_EQ(point[1], 5e-324);
  EXPECT_EQ(point[2], 0.1);
}

/// Several points are converted at once where the plan allows it: the bits must be those of each alone.
TEST(Positions, ManyAtOnceAreThoseOfEach)
{
  const Box boxes[] = { Box::from_bounds({ 0.1, -0.2, 0.3 }, { 0.3, 0.4, 0.5 }),
    Box::from_bounds({ 1e6, -1e9, 0 }, { 1e6 + 1, -1e9 + 0.1, 5e-324 }),
    Box::from_bounds({ -0.0, 0, 0 }, { infinity, 1e300, 1 }),
    Box::from_tilted_bounds({ 0.1, 0.2, 0.3 }, { 1, 2, 3 }, 0.3, -0.2, 0.1) };
  std::mt19937_64 random(3);
  std::vector<double> numbers = { -0.0, 0, infinity, -infinity, not_a_number, 1, 1e308, 5e-324 };
  while (numbers.size() < 3 * 41)
  {
    numbers.push_back(2 * std::generate_canonical<double, 53>(random) - 0.5);
  }
  for (const Box& box : boxes)
  {
    for (const char* const columns : { "xs ys zs", "x y z", "xsu ysu zsu" })
    {
      for (const Vector3& origin : { Vector3{}, Vector3{ 0.1, 1e6, -3 } })
      {
        Notices notices;
        const PositionPlan plan =
          granular::plan_positions(schema_of(columns), box, Coordinates::Absolute, {}, notices);
        for (std::size_t count = 0; count <= 41; ++count)
        {
          std::vector<double> many(
            numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(3 * count));
          granular::convert_positions(plan, box, origin, {}, many);
          for (std::size_t i = 0; i < count; ++i)
          {
            Vector3 one = { numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2] };
            granular::convert_positions(plan, box, origin, {}, one);
            for (std::size_t k = 0; k < 3; ++k)
            {
              ASSERT_EQ(bits_of(many[3 * i + k]), bits_of(one[k]))
                << columns << ", point " << i << " of " << count;
            }
          }
        }
      }
    }
  }
}

// ---- which columns -----------------------------------------------------------------------------

namespace
{
/// "column[s][+|-]" of each axis, what the points are, and what was said.
std::string plan(const std::string& columns, Coordinates wanted, bool tilted = false)
{
  Box box = Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 });
  if (tilted)
  {
    box = Box::from_tilted_bounds({ 0, 0, 0 }, { 1, 1, 1 }, 0.1, 0, 0);
  }
  const ColumnSchema schema = schema_of(columns);
  Notices notices;
  const PositionPlan plan = granular::plan_positions(schema, box, wanted, { "file", 7 }, notices);
  std::string text;
  for (const PositionPlan::Axis& axis : plan.axes)
  {
    text += axis.column < 0 ? "0" : schema.columns()[static_cast<std::size_t>(axis.column)].name;
    text += axis.shift > 0 ? "+ " : axis.shift < 0 ? "- " : " ";
  }
  text += to_string(plan.coordinates);
  for (const granular::Notice& notice : notices)
  {
    text += "; " + granular::to_string(notice);
  }
  return text;
}

constexpr Coordinates absolute_wanted = Coordinates::Absolute;
constexpr Coordinates unwrapped_wanted = Coordinates::Unwrapped;
constexpr Coordinates scaled_wanted = Coordinates::Scaled;
}

TEST(PositionPlan, AbsoluteFromEveryForm)
{
  EXPECT_EQ(plan("x y z", absolute_wanted), "x y z Absolute");
  EXPECT_EQ(plan("xs ys zs", absolute_wanted), "xs ys zs Absolute");
  EXPECT_EQ(plan("xu yu zu ix iy iz", absolute_wanted), "xu- yu- zu- Absolute");
  EXPECT_EQ(plan("xsu ysu zsu ix iy iz", absolute_wanted), "xsu- ysu- zsu- Absolute");
  EXPECT_EQ(plan("xs ys zs x y z xu yu zu", absolute_wanted), "x y z Absolute");
  EXPECT_EQ(plan("z x y", absolute_wanted), "x y z Absolute");
}

TEST(PositionPlan, UnwrappedFromEveryForm)
{
  EXPECT_EQ(plan("xu yu zu", unwrapped_wanted), "xu yu zu Unwrapped");
  EXPECT_EQ(plan("xsu ysu zsu", unwrapped_wanted), "xsu ysu zsu Unwrapped");
  EXPECT_EQ(plan("x y z ix iy iz", unwrapped_wanted), "x+ y+ z+ Unwrapped");
  EXPECT_EQ(plan("xs ys zs ix iy iz", unwrapped_wanted), "xs+ ys+ zs+ Unwrapped");
}

TEST(PositionPlan, ScaledFromEveryForm)
{
  EXPECT_EQ(plan("xs ys zs", scaled_wanted), "xs ys zs Scaled");
  EXPECT_EQ(plan("x y z", scaled_wanted), "x y z Scaled");
  EXPECT_EQ(plan("xu yu zu ix iy iz", scaled_wanted), "xu- yu- zu- Scaled");
  EXPECT_EQ(plan("xsu ysu zsu ix iy iz", scaled_wanted), "xsu- ysu- zsu- Scaled");
}

TEST(PositionPlan, MissingImagesAreSaid)
{
  EXPECT_EQ(plan("x y z", unwrapped_wanted),
    "x y z Absolute; file:7: expected image counts ix iy iz to make Unwrapped coordinates, got "
    "none; "
    "the points are Absolute");
  EXPECT_EQ(plan("xu yu zu", absolute_wanted),
    "xu yu zu Unwrapped; file:7: expected image counts ix iy iz to make Absolute coordinates, got "
    "none; the points are Unwrapped");
  EXPECT_EQ(plan("xsu ysu zsu", scaled_wanted),
    "xsu ysu zsu Scaled; file:7: expected image counts ix iy iz to make Scaled coordinates, got "
    "none; "
    "the points are Scaled and unwrapped");
  // one count moves one axis of an aligned box, and all of a tilted one
  EXPECT_NE(plan("xu yu zu ix iy", absolute_wanted).find("; file:7: "), std::string::npos);
  EXPECT_NE(plan("xu yu zu ix iy", absolute_wanted, true).find("; file:7: "), std::string::npos);
}

TEST(PositionPlan, TrapMixedAndMissingAxes)
{
  EXPECT_EQ(plan("x ys z", absolute_wanted), "x ys z Absolute");
  EXPECT_EQ(plan("x y", absolute_wanted),
    "x y 0 Absolute; file:7: no column for the coordinate z; it is set to 0");
  EXPECT_EQ(plan("z", absolute_wanted),
    "0 0 z Absolute; file:7: no column for the coordinate x y; it is set to 0");
  EXPECT_EQ(plan("x yu z ix iy iz", unwrapped_wanted), "x+ yu z+ Unwrapped");
}

TEST(PositionPlan, WhatCannotBeMade)
{
  const auto error = [](const std::string& columns, bool tilted)
  {
    try
    {
      plan(columns, absolute_wanted, tilted);
    }
    catch (const granular::Error& e)
    {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error("id vx", false),
    "file:7: expected columns of coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu), got 'id "
    "vx'");
  EXPECT_EQ(error("x ys z", true),
    "file:7: expected all coordinates of a tilted box in one form, got 'x ys z'");
  EXPECT_EQ(error("x ys z", false), "");
  // one image count moves all coordinates of a tilted box
  EXPECT_EQ(error("xu y z ix iy iz", true),
    "file:7: expected all coordinates of a tilted box in one form, got 'xu y z ix iy iz'");
  EXPECT_EQ(error("x yu zu", true),
    "file:7: expected all coordinates of a tilted box in one form, got 'x yu zu'");
}
