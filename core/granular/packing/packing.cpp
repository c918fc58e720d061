// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing.h"

#include "granular/base/error.h"
#include "granular/base/executor.h"
#include "granular/dump/exchange_rows.h"
#include "granular/packing/grain_rows.h"
#include "granular/packing/lattice.h"
#include "granular/packing/random_grains.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

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

LatticeKind lattice_of(Arrangement arrangement)
{
  return static_cast<LatticeKind>(static_cast<int>(arrangement) - 1);
}

/// The edge of a cube for random grains. Between walls few of them have less room than the solid fraction
/// says: then at least the cube of a diameter is left to each.
double made_edge(const PackingRequest& request, bool walls)
{
  const double volume = static_cast<double>(request.grains) * request.radii.mean_volume();
  const double diameter = 2 * request.radii.largest();
  const double room = walls && request.grains > 1 ? std::cbrt(volume * 6 / std::numbers::pi) : 0;
  return std::max(std::cbrt(volume / request.solid_fraction), diameter + room);
}

/// The box at 0 0 0 for the grains.
Box made_box(const PackingRequest& request, const std::string& boundary)
{
  const double radius = request.radii.largest();
  Vector3 lengths;
  if (request.arrangement == Arrangement::Random)
  {
    lengths.fill(made_edge(request, boundary != "pp pp pp"));
  }
  else
  {
    const std::array<bool, 3> periodic = { boundary[0] == 'p', boundary[3] == 'p',
      boundary[6] == 'p' };
    lengths = Lattice::lengths_for(lattice_of(request.arrangement), periodic,
      request.spacing * 2 * radius, radius, request.grains);
  }
  return Box::from_bounds({}, lengths);
}

Box box_of(const PackingRequest& request)
{
  const std::string boundary = checked_boundary(request.boundary);
  Box box = request.box ? *request.box : made_box(request, boundary);
  box.boundary = boundary;
  return box;
}

void check_room(const BoxShape& box, const RadiusChoice& radii)
{
  const double diameter = 2 * radii.largest();
  const double height = *std::min_element(box.heights.begin(), box.heights.end());
  expect(height >= diameter * (1 - 1e-12),
    "a box of at least the largest diameter, " + std::to_string(diameter) +
      ", between any two opposite faces",
    height);
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

std::int64_t lattice_count(const PackingRequest& request, const Lattice& lattice)
{
  const std::int64_t room = std::min(lattice.capacity(), most_grains);
  if (request.grains > room)
  {
    throw LimitError("expected at most " + std::to_string(room) +
      " grains, which the box holds in this lattice, got " + std::to_string(request.grains));
  }
  return request.grains > 0 ? request.grains : room;
}

GrainRows piece_of(std::int64_t grains, const PackingRequest& request)
{
  return { begin_of_part(grains, request.piece, request.pieces),
    begin_of_part(grains, request.piece + 1, request.pieces) };
}

/// The frame, with memory for the rows.
DumpFrame empty_frame(const Box& box, std::int64_t grains, std::int64_t rows)
{
  DumpFrame frame;
  frame.rows = rows;
  frame.header.rows = grains;
  frame.header.box = box;
  frame.schema = ColumnSchema({ "id", "type", "x", "y", "z", "radius", "vx", "vy", "vz" });
  const auto count = static_cast<std::size_t>(rows);
  frame.points = Block(count * 3 * sizeof(double));
  for (const ArrayInfo& info : frame.schema.arrays())
  {
    if (!info.position_form)
    {
      const std::size_t bytes =
        size_of(info.type) * static_cast<std::size_t>(info.components()) * count;
      frame.arrays.push_back({ info, Block(bytes), {}, {} });
    }
  }
  return frame;
}

void place_on(const Lattice& lattice, const Radii& radii, const GrainRows& rows, int threads,
  Progress& progress)
{
  for_row_chunks(rows.count(), threads, progress,
    [&](std::int64_t begin, std::int64_t end, std::size_t)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vector3 place = lattice.scaled(rows.first + i);
        std::copy(place.begin(), place.end(), rows.scaled + 3 * i);
        rows.radius[i] = radii.radius(rows.first + i);
      }
    });
}
}

DumpFrame make_packing(const PackingRequest& request, Progress& progress)
{
  progress.step(0);
  check_numbers(request);
  const Box box = box_of(request);
  const BoxShape shape(box);
  check_room(shape, request.radii);
  std::optional<Lattice> lattice;
  if (request.arrangement != Arrangement::Random)
  {
    const double diameter = 2 * request.radii.largest();
    lattice.emplace(
      lattice_of(request.arrangement), shape, request.spacing * diameter, diameter / 2);
  }
  const std::int64_t grains =
    lattice ? lattice_count(request, *lattice) : random_count(request, shape);
  const Radii radii(request.radii, grains, request.seed);
  GrainRows rows = piece_of(grains, request);
  DumpFrame frame = empty_frame(box, grains, rows.count());
  rows.scaled = static_cast<double*>(frame.points.data());
  rows.radius = array_of<double>(frame, "radius");
  PartialProgress part(progress);
  part.set_part(0, lattice ? 0.3 : 0.9);
  if (lattice)
  {
    place_on(*lattice, radii, rows, request.threads, part);
  }
  else
  {
    place({ shape, radii, grains, request.seed }, rows, request.threads, part);
  }
  part.set_part(lattice ? 0.3 : 0.9, 1);
  fill_arrays(frame, shape, radii, rows, request, part);
  progress.step(1);
  return frame;
}
}
