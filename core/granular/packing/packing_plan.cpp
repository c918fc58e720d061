// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/packing_plan.h"

#include "granular/common/error.h"
#include "granular/common/shares.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t most_particles = 1'000'000'000'000;

/// The densest packing of equal spheres has 0.74; what chance can do shows when it is tried.
constexpr double most_solid = 0.74;

/// Radii that coordinates can still tell apart, in units of what these lose by rounding.
constexpr double least_radius = 1e4;

/// Returns how many particles the box holds: whole distances between them, and a radius at both ends.
std::int64_t room_for(const BoxShape& box, double length, double distance, double radius)
{
  constexpr double tolerance = 1e-12; // a box that was made for a chain may have been rounded
  constexpr double most = 1e12;
  const double inside = length * (1 - 2 * radius / box.heights[0]) / distance;
  const double steps = std::floor(inside + tolerance * (1 + length / distance));
  return static_cast<std::int64_t>(std::clamp(steps, 0.0, most)) + 1;
}

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
  expect(request.particles >= 0 && request.particles <= most_particles,
    "a number of grains from 0 to 10^12", static_cast<double>(request.particles));
  expect(request.solid_fraction > 0 && request.solid_fraction <= most_solid,
    "a solid fraction greater than 0 and at most 0.74", request.solid_fraction);
  expect(request.spacing >= 1 && std::isfinite(request.spacing), "a finite spacing of at least 1",
    request.spacing);
  expect(request.speed >= 0 && std::isfinite(request.speed), "a finite speed of at least 0",
    request.speed);
  expect(request.pieces >= 1, "at least 1 piece", request.pieces);
  expect(request.piece >= 0 && request.piece < request.pieces,
    "a piece from 0 to " + std::to_string(request.pieces - 1), request.piece);
  if (request.particles == 0 && !request.box)
  {
    throw LimitError("expected a number of grains or a box, got neither");
  }
}

double distance_of(const PackingRequest& request)
{
  return request.spacing * 2 * request.radii.largest();
}

LatticeKind lattice_of(Arrangement arrangement)
{
  return arrangement == Arrangement::SimpleCubic ? LatticeKind::SimpleCubic
                                                 : LatticeKind::FaceCentredCubic;
}

/// The edge of a cube for random particles. Between walls few of them have less room than the solid fraction
/// says: then at least the cube of a diameter is left to each.
double made_edge(const PackingRequest& request, bool walls)
{
  const double volume = static_cast<double>(request.particles) * request.radii.mean_volume();
  const double diameter = 2 * request.radii.largest();
  const double room = walls && request.particles > 1 ? std::cbrt(volume * 6 / std::numbers::pi) : 0;
  constexpr double apart =
    1 + 1e-3; // no particle touches its own image, as near to it as coordinates may be coarse
  return std::max(std::cbrt(volume / request.solid_fraction), (diameter + room) * apart);
}

/// The box for particles that are so far apart.
Box made_box(const PackingRequest& request, const std::string& boundary, double distance)
{
  const double radius = request.radii.largest();
  const std::array<bool, 3> periodic = { boundary[0] == 'p', boundary[3] == 'p',
    boundary[6] == 'p' };
  Vector3 lengths;
  if (request.arrangement == Arrangement::Random)
  {
    lengths.fill(made_edge(request, boundary != "pp pp pp"));
  }
  else
  {
    lengths = request.arrangement == Arrangement::Chain
      ? Chain::lengths_for(periodic, distance, radius, request.particles)
      : Lattice::lengths_for(
          lattice_of(request.arrangement), periodic, distance, radius, request.particles);
  }
  Box box = Box::from_bounds({}, lengths);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.origin[axis] = { request.corner[axis], 0 };
  }
  box.boundary = boundary;
  return box;
}

/// The distance that no two particles are nearer than in a box: see Lattice and Chain.
double nearest_in(const BoxShape& box, const PackingRequest& request)
{
  const double distance = distance_of(request);
  const double radius = request.radii.largest();
  return request.arrangement == Arrangement::Random ? HUGE_VAL
    : request.arrangement == Arrangement::Chain
    ? Chain(box, distance, radius, request.particles).nearest()
    : Lattice(lattice_of(request.arrangement), box, distance, radius).nearest();
}

/// The box for the particles, with room for the rounding of coordinates where that could make them overlap.
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

/// Returns the number of random particles.
std::int64_t random_count(const PackingRequest& request, const BoxShape& box)
{
  const double mean = request.radii.mean_volume();
  const double room = box.volume / mean;
  const double count = request.particles > 0 ? static_cast<double>(request.particles)
                                             : std::floor(request.solid_fraction * room + 1e-9);
  expect(count >= 1, "a box that holds a grain at the solid fraction asked for", count);
  if (count > static_cast<double>(RandomPacking::most_particles))
  {
    throw LimitError("expected at most 10^7 random grains, got " + std::to_string(count) +
      ": a lattice, SimpleCubic or FaceCentredCubic, can have more");
  }
  expect(count <= most_solid * room * (1 + 1e-9) || count == 1, "a solid fraction of at most 0.74",
    count / room);
  return static_cast<std::int64_t>(count);
}

/// Returns the number of particles on a lattice.
std::int64_t lattice_count(const PackingRequest& request, const Lattice& lattice)
{
  const std::int64_t room = std::min(lattice.capacity(), most_particles);
  if (request.particles > room)
  {
    throw LimitError("expected at most " + std::to_string(room) +
      " grains, which the box holds in this lattice, got " + std::to_string(request.particles));
  }
  return request.particles > 0 ? request.particles : room;
}
}

Chain::Chain(const BoxShape& box, double distance, double radius, std::int64_t particles)
  : first_(radius / box.heights[0])
  , nearest_(distance)
{
  const double length = length_of(box.vectors[0]);
  const std::int64_t room = room_for(box, length, distance, radius);
  if (particles > room)
  {
    throw LimitError("expected at most " + std::to_string(room) +
      " grains, which the box holds along its first vector, got " + std::to_string(particles));
  }
  particles_ = particles > 0 ? particles : room;
  step_ = distance / length;
  const double rounding = 2 * box.rounding();
  const auto steps = static_cast<double>(particles_ - 1);
  const double rest = length - steps * distance; // at both ends
  if (box.adds({ box.origin[0], length, distance, radius }) && rest >= 2 * radius)
  {
    exact_first_ = box.origin[0] + radius;
    exact_step_ = distance;
  }
  else if (rest - steps * rounding >= length * 2 * radius / box.heights[0] + rounding)
  {
    step_ = (distance + rounding) / length;
  }
  else
  {
    nearest_ = std::min(distance, rest) - rounding;
  }
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    if (box.periodic[axis])
    {
      nearest_ = std::min(nearest_, box.heights[axis] - (box.aligned ? 0 : rounding));
    }
  }
}

Vector3 Chain::point(std::int64_t row, const BoxShape& box) const noexcept
{
  const auto steps = static_cast<double>(row);
  Vector3 point = box.point({ first_ + steps * step_, 0.5, 0.5 });
  if (exact_step_ > 0)
  {
    point[0] = exact_first_ + steps * exact_step_;
  }
  return point;
}

Vector3 Chain::lengths_for(
  const std::array<bool, 3>& periodic, double distance, double radius, std::int64_t particles)
{
  Vector3 lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = periodic[axis] ? distance : 2 * radius;
  }
  lengths[0] += static_cast<double>(particles - 1) * distance;
  return lengths;
}

PackingPlan::PackingPlan(const PackingRequest& wanted, Progress& progress)
  : request(wanted)
  , box(checked_box(request))
  , shape(box)
  , radii_(request.radii, 0, request.seed)
{
  check_room(shape, request.radii, request.arrangement == Arrangement::Random);
  const double radius = request.radii.largest();
  const double distance = distance_of(request);
  if (request.arrangement == Arrangement::Random)
  {
    particles = random_count(request, shape);
  }
  else if (request.arrangement == Arrangement::Chain)
  {
    chain_.emplace(shape, distance, radius, request.particles);
    nearest_ = chain_->nearest();
    particles = chain_->particles();
  }
  else
  {
    lattice_.emplace(lattice_of(request.arrangement), shape, distance, radius);
    nearest_ = lattice_->nearest();
    particles = lattice_count(request, *lattice_);
  }
  radii_ = Radii(request.radii, particles, request.seed);
  first = begin_of_part(particles, request.piece, request.pieces);
  last = begin_of_part(particles, request.piece + 1, request.pieces);
  if (request.arrangement == Arrangement::Random)
  {
    random_.emplace(shape, radii_, request.seed, progress);
  }
}

PlacedParticle PackingPlan::particle(std::int64_t row) const noexcept
{
  return random_
    ? random_->particle(row)
    : PlacedParticle{ lattice_ ? lattice_->point(row, shape) : chain_->point(row, shape),
        std::min(radii_.radius(row), nearest_ / 2), radii_.type(row) };
}

void PackingPlan::visit_near(std::int64_t row, double distance, const VisitNear& visit) const
{
  if (random_)
  {
    random_->visit_near(row, distance, visit);
  }
  else
  {
    lattice_->visit_near(row, shape, distance, visit);
  }
}
}
