// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing_plan.h"

#include "granular/common/error.h"
#include "granular/common/shares.h"
#include "granular/packing/grain_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t most_grains = 1'000'000'000'000;

/// Of equal spheres the densest packing there is has 0.74; what chance can do shows when it is tried.
constexpr double most_solid = 0.74;

/// Radii that coordinates can still tell apart, in units of what these lose by rounding.
constexpr double least_radius = 1e4;

void expect(bool right, const std::string& what, double got)
{
  if (!right)
  {
    throw LimitError("expected " + what + ", got " + std::to_string(got));
  }
}

void check_numbers(const PackingRequest& request)
{
  check(request.radii);
  expect(request.grains >= 0 && request.grains <= most_grains, "a number of grains from 0 to 10^12",
    static_cast<double>(request.grains));
  expect(request.solid_fraction > 0 && request.solid_fraction <= most_solid,
    "a solid fraction greater than 0 and at most 0.74", request.solid_fraction);
  expect(request.spacing >= 1 && std::isfinite(request.spacing), "a finite spacing of at least 1",
    request.spacing);
  expect(request.grains_per_fibre >= 1 && request.grains_per_fibre <= most_grains,
    "a number of grains per fibre from 1 to 10^12", static_cast<double>(request.grains_per_fibre));
  expect(request.speed >= 0 && std::isfinite(request.speed), "a finite speed of at least 0",
    request.speed);
  expect(request.pieces >= 1, "at least 1 piece", request.pieces);
  expect(request.piece >= 0 && request.piece < request.pieces,
    "a piece from 0 to " + std::to_string(request.pieces - 1), request.piece);
  if (request.grains == 0 && !request.box)
  {
    throw LimitError("expected a number of grains or a box, got neither");
  }
}

enum class Way : std::uint8_t
{
  Random,
  Lattice,
  Fibres
};

/// How each arrangement is made, in the order of Arrangement.
struct Making
{
  Way way;
  LatticeKind lattice = LatticeKind::SimpleCubic;
  Fibres::Kind fibres = Fibres::Kind::One;
};

constexpr Making makings[] = {
  { Way::Random },
  { Way::Lattice, LatticeKind::SimpleCubic },
  { Way::Lattice, LatticeKind::FaceCentredCubic },
  { Way::Lattice, LatticeKind::Hexagonal },
  { Way::Fibres, {}, Fibres::Kind::One },
  { Way::Fibres, {}, Fibres::Kind::Bundle },
};

const Making& making_of(const PackingRequest& request)
{
  return makings[static_cast<std::size_t>(request.arrangement)];
}

double distance_of(const PackingRequest& request)
{
  return request.spacing * 2 * request.radii.largest();
}

/// Of a chain all, of a bundle as asked for if there are so many; 0: as many as the box holds.
std::int64_t grains_a_fibre(const PackingRequest& request)
{
  if (request.arrangement == Arrangement::Chain)
  {
    return request.grains;
  }
  return request.grains > 0 ? std::min(request.grains, request.grains_per_fibre)
                            : request.grains_per_fibre;
}

/// The edge of a cube for random grains. Between walls few of them have less room than the solid fraction
/// says: then at least the cube of a diameter is left to each.
double made_edge(const PackingRequest& request, bool walls)
{
  const double volume = static_cast<double>(request.grains) * request.radii.mean_volume();
  const double diameter = 2 * request.radii.largest();
  const double room = walls && request.grains > 1 ? std::cbrt(volume * 6 / std::numbers::pi) : 0;
  constexpr double apart =
    1 + 1e-3; // no grain touches its own image, as near to it as coordinates may be coarse
  return std::max(std::cbrt(volume / request.solid_fraction), (diameter + room) * apart);
}

/// The box for grains that are so far apart.
Box made_box(const PackingRequest& request, const std::string& boundary, double distance)
{
  const double radius = request.radii.largest();
  const std::array<bool, 3> periodic = { boundary[0] == 'p', boundary[3] == 'p',
    boundary[6] == 'p' };
  const Making& making = making_of(request);
  Vector3 lengths;
  switch (making.way)
  {
    case Way::Random:
      lengths.fill(made_edge(request, boundary != "pp pp pp"));
      break;
    case Way::Lattice:
      lengths = Lattice::lengths_for(making.lattice, periodic, distance, radius, request.grains);
      break;
    case Way::Fibres:
      const std::int64_t each = grains_a_fibre(request);
      lengths = Fibres::lengths_for(
        making.fibres, periodic, distance, radius, each, (request.grains - 1) / each + 1);
      break;
  }
  Box box = Box::from_bounds({}, lengths);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.origin[axis] = { request.corner[axis], 0 };
  }
  box.boundary = boundary;
  return box;
}

/// The distance that no two grains are nearer than in a box: see Lattice and Fibres.
double nearest_in(const BoxShape& box, const PackingRequest& request)
{
  const Making& making = making_of(request);
  const double distance = distance_of(request);
  const double radius = request.radii.largest();
  return making.way == Way::Random ? HUGE_VAL
    : making.way == Way::Lattice
    ? Lattice(making.lattice, box, distance, radius).nearest()
    : Fibres(making.fibres, box, distance, radius, grains_a_fibre(request)).nearest();
}

/// The box for the grains, with room for the rounding of coordinates where that could make them overlap.
Box made_box(const PackingRequest& request, const std::string& boundary)
{
  const double distance = distance_of(request);
  const Box box = made_box(request, boundary, distance);
  const BoxShape shape(box);
  constexpr double some = 64 * std::numeric_limits<double>::epsilon();
  return nearest_in(shape, request) >= 2 * request.radii.largest()
    ? box
    : made_box(request, boundary, distance * (1 + some) + 8 * shape.rounding());
}

/// The box, when all numbers of the request were checked.
Box checked_box(const PackingRequest& request)
{
  check_numbers(request);
  const std::string boundary = checked_boundary(request.boundary);
  Box box = request.box ? *request.box : made_box(request, boundary);
  box.boundary = boundary;
  return box;
}

void check_room(const BoxShape& box, const RadiusChoice& radii, bool random)
{
  const double diameter = 2 * radii.largest();
  const double height = *std::min_element(box.heights.begin(), box.heights.end());
  expect(height >= diameter * (1 - 1e-12),
    "a box of at least the largest diameter, " + std::to_string(diameter) +
      ", between any two opposite faces",
    height);
  for (std::size_t axis = 0; random && axis < 3; ++axis)
  {
    expect(!box.periodic[axis] || box.heights[axis] > diameter + 4 * box.rounding(),
      "a box in which no grain touches its own periodic image, of diameter " +
        std::to_string(diameter),
      box.heights[axis]);
  }
  if (radii.smallest() < least_radius * box.rounding())
  {
    throw LimitError("expected grains that coordinates of " + std::to_string(box.reach) +
      " can place, got a radius of " + std::to_string(radii.smallest()));
  }
}

/// How many random grains there are.
std::int64_t random_count(const PackingRequest& request, const BoxShape& box)
{
  const double mean = request.radii.mean_volume();
  const double room = box.volume / mean;
  const double count = request.grains > 0 ? static_cast<double>(request.grains)
                                          : std::floor(request.solid_fraction * room + 1e-9);
  expect(count >= 1, "a box that holds a grain at the solid fraction asked for", count);
  expect(count <= static_cast<double>(most_grains),
    "a box that holds at most 10^12 grains at this solid fraction", count);
  expect(count <= most_solid * room * (1 + 1e-9) || count == 1, "a solid fraction of at most 0.74",
    count / room);
  return static_cast<std::int64_t>(count);
}

/// How many grains there are of those that there are places for.
std::int64_t count_of(const PackingRequest& request, std::int64_t places, const char* where)
{
  const std::int64_t room = std::min(places, most_grains);
  if (request.grains > room)
  {
    throw LimitError("expected at most " + std::to_string(room) +
      " grains, which the box holds in " + where + ", got " + std::to_string(request.grains));
  }
  return request.grains > 0 ? request.grains : room;
}
}

PackingPlan::PackingPlan(const PackingRequest& wanted, Communicator& ranks, Progress& progress)
  : request(wanted)
  , box(checked_box(request))
  , shape(box)
  , radii(request.radii, 0, request.seed)
{
  const Making& making = making_of(request);
  check_room(shape, request.radii, making.way == Way::Random);
  const double radius = request.radii.largest();
  switch (making.way)
  {
    case Way::Random:
      grains = random_count(request, shape);
      break;
    case Way::Lattice:
      lattice_.emplace(making.lattice, shape, distance_of(request), radius);
      nearest = lattice_->nearest();
      grains = count_of(request, lattice_->capacity(), "this lattice");
      break;
    case Way::Fibres:
      fibres.emplace(making.fibres, shape, distance_of(request), radius, grains_a_fibre(request));
      nearest = fibres->nearest();
      grains = count_of(request, fibres->capacity(), "these fibres");
      break;
  }
  radii = Radii(request.radii, grains, request.seed);
  if (making.way == Way::Random)
  {
    random_.emplace(shape, radii, request.seed, ranks, request.threads, progress);
  }
}

RowRange PackingPlan::rows() const noexcept
{
  return { begin_of_part(grains, request.piece, request.pieces),
    begin_of_part(grains, request.piece + 1, request.pieces) };
}

void PackingPlan::place_rows(const GrainRows& rows, Progress& progress) const
{
  if (random_)
  {
    random_->place(rows, request.threads, progress);
    return;
  }
  for_row_chunks(rows.count(), request.threads, progress,
    [&](std::int64_t begin, std::int64_t end, std::size_t)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t row = rows.first + i;
        const Vector3 place = lattice_ ? lattice_->point(row, shape) : fibres->point(row, shape);
        std::copy(place.begin(), place.end(), rows.points + 3 * i);
        rows.radius[i] = std::min(radii.radius(row), nearest / 2);
        rows.type[i] = radii.type(row);
      }
    });
}

std::vector<RowRange> PackingPlan::rows_near(const RowRange& rows, double distance) const
{
  std::vector<RowRange> ranges =
    lattice_ ? lattice_->rows_near(rows, shape, distance) : random_->rows_near(rows, distance);
  for (RowRange& range : ranges)
  {
    range.last = std::min(range.last, grains); // a lattice may have room for more
  }
  std::erase_if(ranges, [](const RowRange& range) { return range.count() <= 0; });
  return ranges;
}
}
