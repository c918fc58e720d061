// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/lattice.h"

#include "granular/common/error.h"
#include "granular/common/words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
namespace
{
bool is_side(std::string_view word)
{
  const bool known = word.find_first_not_of("pfsm") == word.npos;
  return known && (word.size() == 1 || (word.size() == 2 && (word[0] == 'p') == (word[1] == 'p')));
}

constexpr Vector3 simple_particles[] = { { 0, 0, 0 } };

constexpr Vector3 face_centred_particles[] = { { 0, 0, 0 }, { 0.5, 0.5, 0 }, { 0.5, 0, 0.5 },
  { 0, 0.5, 0.5 } };

constexpr double root_2 = 1.4142135623730951;

constexpr LatticeCell cell_table[] = {
  { "simple cubic lattice", 1, simple_particles, 0 },
  { "face-centred cubic lattice", root_2, face_centred_particles, 0.5 },
};

const LatticeCell& cell_of(LatticeKind kind)
{
  return cell_table[static_cast<std::size_t>(kind)];
}

/// The part of a length that may be missing for a whole number of cells: a box that was made for them may have been
/// rounded.
constexpr double tolerance = 32 * std::numeric_limits<double>::epsilon();
}

BoxShape::BoxShape(const Box& box)
  : origin(values_of(box.origin))
  , vectors{ values_of(box.vectors[0]), values_of(box.vectors[1]), values_of(box.vectors[2]) }
  , periodic{ box.boundary[0] == 'p', box.boundary[3] == 'p', box.boundary[6] == 'p' }
  , aligned(true)
{
  volume = std::abs(dot(vectors[0], cross(vectors[1], vectors[2])));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Vector3 face = cross(vectors[(axis + 1) % 3], vectors[(axis + 2) % 3]);
    heights[axis] = volume / std::sqrt(dot(face, face));
    const double towards = dot(face, vectors[axis]);
    faces[axis] = { face[0] / towards, face[1] / towards, face[2] / towards };
    double least = origin[axis];
    double most = origin[axis];
    for (const Vector3& vector : vectors)
    {
      least += std::min(vector[axis], 0.0);
      most += std::max(vector[axis], 0.0);
    }
    reach = std::max({ reach, -least, most });
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Twofold& edge = box.vectors[axis][k];
      aligned = aligned && edge.lo == 0 && (k == axis ? edge.hi > 0 : edge.hi == 0);
    }
    aligned = aligned && box.origin[axis].lo == 0;
    // nan fails as well
    if (!(heights[axis] > 0) || !std::isfinite(heights[axis]) || !std::isfinite(origin[axis]))
    {
      throw LimitError(
        "expected a box of three finite lengths greater than 0, got one that is flat "
        "or not finite");
    }
  }
}

Vector3 BoxShape::point(const Vector3& scaled) const noexcept
{
  const Vector3 from_origin = this->edge(scaled);
  return { origin[0] + from_origin[0], origin[1] + from_origin[1], origin[2] + from_origin[2] };
}

double BoxShape::rounding() const noexcept
{
  return 8 * std::numeric_limits<double>::epsilon() * reach;
}

bool BoxShape::adds(std::initializer_list<double> numbers) const noexcept
{
  const double unit = std::ldexp(std::numeric_limits<double>::epsilon(), std::ilogb(reach));
  return aligned &&
    std::ranges::all_of(numbers, [unit](double number) { return std::fmod(number, unit) == 0; });
}

std::string checked_boundary(const std::string& boundary)
{
  const std::vector<std::string_view> words = split_words(boundary);
  if (words.size() != 3 || !std::all_of(words.begin(), words.end(), is_side))
  {
    throw LimitError("expected a boundary such as 'pp pp ff', of the letters p, f, s and m and p "
                     "never with another, got '" +
      boundary + "'");
  }
  std::string text;
  for (const std::string_view word : words)
  {
    text += text.empty() ? "" : " ";
    text += word.front();
    text += word.back();
  }
  return text;
}

Lattice::Lattice(LatticeKind kind, const BoxShape& box, double distance, double radius)
  : cell_(cell_of(kind))
  , nearest_(distance)
{
  const double clear = distance + 2 * box.rounding(); // no rounding brings such particles too near
  double lacking = this->lay(box, distance, radius, clear);
  if (lacking <= 1)
  {
    return;
  }
  if (lacking <= 1 + tolerance + 4 * box.rounding() / distance)
  {
    this->spread(box, distance * (lacking + tolerance), radius);
    this->settle(box, distance, clear);
    return;
  }
  // cells are sheared, and their particles too near: the least length at which they are not
  double low = distance;
  double high = distance;
  while (lacking > 1)
  {
    low = high;
    high *=
      std::max(lacking, 1 + 1e-5); // at least a little: what lacks may be no more than rounding
    lacking = this->lay(box, high, radius, clear);
  }
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i)
  {
    const double middle = low + (high - low) / 2;
    (this->lay(box, middle, radius, clear) > 1 ? low : high) = middle;
  }
  this->lay(box, high, radius);
}

/// Returns the number of cells that fit along each axis; limited, so that the numbers of three axes multiply.
CellCounts Lattice::cells_for(const BoxShape& box, double length, double radius) const noexcept
{
  constexpr double most = 1 << 20;
  const double cell = cell_.length * length;
  CellCounts cells;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double height = box.heights[axis];
    const double fit =
      box.periodic[axis] ? height / cell : (height - 2 * radius - cell_.last * cell) / cell + 1;
    const double count = std::floor(fit + tolerance * (1 + height / cell));
    cells[axis] = static_cast<std::int64_t>(std::clamp(count, 0.0, most));
  }
  return cells;
}

void Lattice::lay(const BoxShape& box, double length, double radius)
{
  cells_ = this->cells_for(box, length, radius);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double cell = cell_.length * length;
    if (cells_[axis] == 0)
    {
      throw LimitError(std::string("expected a box that holds a cell of the ") + cell_.name +
        ", got one of height " + std::to_string(box.heights[axis]) + " along vector " +
        std::to_string(axis + 1) + ", where a cell needs " +
        std::to_string(box.periodic[axis] ? cell : cell_.last * cell + 2 * radius));
    }
    this->lay_axis(box, axis, length);
  }
}

void Lattice::lay_axis(const BoxShape& box, std::size_t axis, double length)
{
  const auto count = static_cast<double>(cells_[axis]);
  step_[axis] = box.periodic[axis] ? 1 / count : cell_.length * length / box.heights[axis];
  first_[axis] = (1 - (count - 1 + cell_.last) * step_[axis]) / 2;
}

/// Lays larger cells along the axes that have room for as many of them.
void Lattice::spread(const BoxShape& box, double length, double radius)
{
  const CellCounts larger = this->cells_for(box, length, radius);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (larger[axis] == cells_[axis])
    {
      this->lay_axis(box, axis, length);
    }
  }
}

/// Finds out how near particles are where the box holds its cells, and along some axes no larger ones.
void Lattice::settle(const BoxShape& box, double distance, double clear)
{
  const double least = this->nearest(box, 2 * clear);
  if (least >= clear)
  {
    return;
  }
  std::array<bool, 3> exact = {};
  bool all = cell_.particles.size() == 1; // neighbours are along the axes, and others far away
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    exact[axis] = step_[axis] * box.heights[axis] < clear;
    all = all && (!exact[axis] || this->is_exact(box, axis, distance));
  }
  if (all)
  {
    exact_ = exact;
    return;
  }
  nearest_ = least - (clear - distance);
}

/// Returns true if the coordinates of particles at the distance are doubles, and the first one's image is no nearer to the last one.
bool Lattice::is_exact(const BoxShape& box, std::size_t axis, double distance) const noexcept
{
  const double length = box.vectors[axis][axis];
  const double steps = static_cast<double>(cells_[axis] - 1) * distance;
  return box.adds({ box.origin[axis], length, distance, (length - steps) / 2 }) &&
    (!box.periodic[axis] || length - steps == distance);
}

/// Gives by how much particles are nearer than they may.
double Lattice::lay(const BoxShape& box, double length, double radius, double clear)
{
  this->lay(box, length, radius);
  return clear / this->nearest(box, 2 * clear);
}

/// The distance of the nearest two particles of the lattice without end, or one that is enough. Along
/// no axis is a cell lower than the distance, so that nearer particles are in neighbouring cells.
double Lattice::nearest(const BoxShape& box, double enough) const noexcept
{
  double least = enough * enough;
  for (const Vector3& from : cell_.particles)
  {
    for (const Vector3& to : cell_.particles)
    {
      for (int neighbour = 0; neighbour < 125; ++neighbour)
      {
        const Vector3 cells = { to[0] - from[0] + neighbour % 5 - 2,
          to[1] - from[1] + neighbour / 5 % 5 - 2, to[2] - from[2] + neighbour / 25 - 2.0 };
        const Vector3 edge =
          box.edge({ cells[0] * step_[0], cells[1] * step_[1], cells[2] * step_[2] });
        const double square = edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2];
        least = cells == Vector3{} ? least : std::min(least, square);
      }
    }
  }
  return std::sqrt(least);
}

std::int64_t Lattice::capacity() const noexcept
{
  return cells_[0] * cells_[1] * cells_[2] * static_cast<std::int64_t>(cell_.particles.size());
}

CellCounts Lattice::place_of(std::int64_t row) const noexcept
{
  const std::int64_t cell = row / static_cast<std::int64_t>(cell_.particles.size());
  const std::int64_t line = cell / cells_[0];
  return { cell % cells_[0], line % cells_[1], line / cells_[1] };
}

const Vector3& Lattice::part_of(std::int64_t row) const noexcept
{
  return cell_.particles[static_cast<std::size_t>(row) % cell_.particles.size()];
}

Vector3 Lattice::point(std::int64_t row, const BoxShape& box) const noexcept
{
  const CellCounts index = this->place_of(row);
  const Vector3& part = this->part_of(row);
  Vector3 scaled;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    scaled[axis] = first_[axis] + (static_cast<double>(index[axis]) + part[axis]) * step_[axis];
  }
  Vector3 point = box.point(scaled);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (exact_[axis])
    {
      const double length = box.vectors[axis][axis];
      const double rest = length - static_cast<double>(cells_[axis] - 1) * nearest_;
      point[axis] = box.origin[axis] + rest / 2 + static_cast<double>(index[axis]) * nearest_;
    }
  }
  return point;
}

void Lattice::visit_near(
  std::int64_t row, const BoxShape& box, double distance, const VisitNear& visit) const
{
  const CellCounts own = this->place_of(row);
  const Vector3& from = this->part_of(row);
  const double most = distance * (1 + 1e-9) + 16 * box.rounding();
  CellCounts low;
  CellCounts high;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto reach =
      static_cast<std::int64_t>(most / (step_[axis] * box.heights[axis]) + cell_.last);
    low[axis] = own[axis] - reach;
    high[axis] = own[axis] + reach;
  }
  for_cells(low, high, cells_, box.periodic,
    [&](const CellCounts& place, const PeriodicImage& image)
    {
      const std::int64_t first = ((place[2] * cells_[1] + place[1]) * cells_[0] + place[0]) *
        static_cast<std::int64_t>(cell_.particles.size());
      for (std::size_t i = 0; i < cell_.particles.size(); ++i)
      {
        Vector3 way;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const std::int64_t cell = place[axis] + image[axis] * cells_[axis];
          way[axis] =
            (static_cast<double>(cell - own[axis]) + cell_.particles[i][axis] - from[axis]) *
            step_[axis];
        }
        const Vector3 edge = box.edge(way);
        if (dot(edge, edge) <= most * most)
        {
          visit(first + static_cast<std::int64_t>(i), image);
        }
      }
    });
}

Vector3 Lattice::lengths_for(LatticeKind kind, const std::array<bool, 3>& periodic, double distance,
  double radius, std::int64_t particles)
{
  const LatticeCell& cell = cell_of(kind);
  const double cells =
    std::ceil(static_cast<double>(particles) / static_cast<double>(cell.particles.size()));
  const double edge = std::max(1.0, std::floor(std::cbrt(cells)));
  Vector3 counts = { edge, edge, edge };
  while (counts[0] * counts[1] * counts[2] < cells)
  {
    ++*std::ranges::min_element(counts);
  }
  Vector3 lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = cell.length * distance;
    lengths[axis] =
      periodic[axis] ? counts[axis] * length : (counts[axis] - 1 + cell.last) * length + 2 * radius;
  }
  return lengths;
}
}
