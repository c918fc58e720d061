// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/sphere_cells.h"

#include "granular/euler/sphere_box.h"
#include "granular/euler/sphere_parts.h"

#include <algorithm>
#include <cmath>

namespace granular
{
namespace
{
constexpr std::int64_t no_cell = -1; // in no range

/// A cell of an axis, seen from the centre of a sphere.
struct Slab
{
  double lo, hi, edge;

  double nearest() const { return std::max({ 0.0, lo, -hi }); }
  double farthest() const { return std::max(-lo, hi); }
};

/// face less centre, rounded once: it never falls as the face rises.
double difference(double face, Twofold centre)
{
  const double hi = face - centre.hi;
  const double part = hi - face;
  const double lo = (face - (hi - part)) - (centre.hi + part);
  return std::isfinite(hi) ? hi + (lo - centre.lo) : hi;
}

/// Adds shares with their numbers in a range.
class Shares
{
public:
  Shares(const CellRange& within, std::vector<CellShare>& shares)
    : within_(within)
    , shares_(shares)
  {
  }

  bool is_within(std::size_t axis, std::int64_t cell) const
  {
    return within_.first[axis] <= cell && cell < within_.last[axis];
  }

  void add(const std::array<std::int64_t, 3>& cell, double volume)
  {
    std::int64_t number = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      number =
        number * (within_.last[axis] - within_.first[axis]) + cell[axis] - within_.first[axis];
    }
    shares_.push_back({ number, volume });
  }

private:
  const CellRange& within_;
  std::vector<CellShare>& shares_;
};
}

/// What the faces across an axis do to a sphere.
struct SphereCells::Cut
{
  enum class Kind
  {
    Outside, ///< no cell touches it
    Whole,   ///< it is in one cell
    Two,     ///< one face cuts it
    More
  };
  Kind kind = Kind::Outside;
  double distance = 0; ///< of the face, or the radius
  std::array<std::int64_t, 2> cells = { no_cell,
    no_cell }; ///< that of the centre, that beyond the face
};

SphereCells::SphereCells(const EulerGrid& grid, bool short_cuts)
  : grid_(grid)
  , short_cuts_(short_cuts)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    faces_[axis] = grid.faces(axis);
    per_length_[axis] = 1 / grid.spacing(axis);
  }
}

/// The cell that a coordinate is in, or the nearest one.
std::int64_t SphereCells::cell_of(std::size_t axis, double x) const noexcept
{
  const std::vector<double>& faces = faces_[axis];
  const auto last = static_cast<double>(grid_.counts[axis] - 1);
  const double guess = std::min(last, std::max(0.0, (x - faces.front()) * per_length_[axis]));
  const auto cell = static_cast<std::int64_t>(guess);
  const double* face = faces.data() + cell;
  if (face[0] <= x && x < face[1])
  {
    return cell;
  }
  const auto inner = faces.begin() + 1;
  return std::upper_bound(inner, faces.end() - 1, x) - inner;
}

CellRange SphereCells::range(const Twofold3& centre, double radius) const noexcept
{
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto from_centre = [&](std::int64_t face)
    { return difference(faces_[axis][static_cast<std::size_t>(face)], centre[axis]); };
    const std::int64_t count = grid_.counts[axis];
    std::int64_t first = this->cell_of(axis, centre[axis].hi - radius);
    while (first > 0 && from_centre(first) >= -radius)
    {
      --first;
    }
    while (first < count && from_centre(first + 1) < -radius)
    {
      ++first;
    }
    std::int64_t last = this->cell_of(axis, centre[axis].hi + radius) + 1;
    while (last < count && from_centre(last) <= radius)
    {
      ++last;
    }
    while (last > 0 && from_centre(last - 1) > radius)
    {
      --last;
    }
    if (first >= last)
    {
      return {};
    }
    range.first[axis] = first;
    range.last[axis] = last;
  }
  return range;
}

/// In the common case, one face or none, a few comparisons tell.
SphereCells::Cut SphereCells::cut_along(
  std::size_t axis, Twofold centre, double radius) const noexcept
{
  const auto from_centre = [&](std::int64_t face)
  { return difference(faces_[axis][static_cast<std::size_t>(face)], centre); };
  const std::int64_t count = grid_.counts[axis];
  const std::int64_t cell = this->cell_of(axis, centre.hi);
  const double lo = from_centre(cell);
  const double hi = from_centre(cell + 1);
  if (lo >= radius || hi <= -radius)
  {
    return {};
  }
  const bool is_cut_below = lo > -radius;
  const bool is_cut_above = hi < radius;
  if (!is_cut_below && !is_cut_above)
  {
    return { Cut::Kind::Whole, radius, { cell, no_cell } };
  }
  const std::int64_t face = is_cut_below ? cell : cell + 1;
  if ((is_cut_below && is_cut_above) || (face > 0 && from_centre(face - 1) > -radius) ||
    (face < count && from_centre(face + 1) < radius))
  {
    return { Cut::Kind::More };
  }
  const double plane = is_cut_below ? lo : hi;
  const std::int64_t below = face - 1; // no_cell below the first
  const std::int64_t above = face < count ? face : no_cell;
  return { Cut::Kind::Two, std::abs(plane),
    { plane > 0 ? below : above, plane > 0 ? above : below } };
}

void SphereCells::add_cells(const Twofold3& centre, double radius, const CellRange& within,
  std::vector<CellShare>& shares) const
{
  CellRange range = this->range(centre, radius);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    range.first[axis] = std::max(range.first[axis], within.first[axis]);
    range.last[axis] = std::min(range.last[axis], within.last[axis]);
  }
  const auto slab = [&](std::size_t axis, std::int64_t cell)
  {
    const auto at = static_cast<std::size_t>(cell);
    const std::vector<double>& faces = faces_[axis];
    return Slab{ difference(faces[at], centre[axis]), difference(faces[at + 1], centre[axis]),
      faces[at + 1] - faces[at] };
  };
  Shares found(within, shares);
  for (std::int64_t k = range.first[2]; k < range.last[2]; ++k)
  {
    const Slab z = slab(2, k);
    for (std::int64_t j = range.first[1]; j < range.last[1]; ++j)
    {
      const Slab y = slab(1, j);
      for (std::int64_t i = range.first[0]; i < range.last[0]; ++i)
      {
        const Slab x = slab(0, i);
        const double volume = centred_box_volume(
          radius, { x.lo, y.lo, z.lo }, { x.hi, y.hi, z.hi }, { x.edge, y.edge, z.edge });
        if (volume > 0)
        {
          found.add({ i, j, k }, volume);
        }
      }
    }
  }
}

void SphereCells::find(const Twofold3& centre, double radius, const CellRange& within,
  std::vector<CellShare>& shares) const
{
  if (!(sphere_volume(radius) > 0))
  {
    return;
  }
  std::array<Cut, 3> cuts;
  auto most = short_cuts_ ? Cut::Kind::Whole : Cut::Kind::More;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cuts[axis] = this->cut_along(axis, centre[axis], radius);
    if (cuts[axis].kind == Cut::Kind::Outside)
    {
      return;
    }
    most = std::max(most, cuts[axis].kind);
  }
  if (most == Cut::Kind::More)
  {
    this->add_cells(centre, radius, within, shares);
    return;
  }
  const SphereParts parts =
    cut_sphere(radius, { cuts[0].distance, cuts[1].distance, cuts[2].distance });
  Shares found(within, shares);
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    const std::array<std::int64_t, 3> cell = { cuts[0].cells[part & 1],
      cuts[1].cells[(part >> 1) & 1], cuts[2].cells[part >> 2] };
    if (parts[part] > 0 && found.is_within(0, cell[0]) && found.is_within(1, cell[1]) &&
      found.is_within(2, cell[2]))
    {
      found.add(cell, parts[part]);
    }
  }
}
}
