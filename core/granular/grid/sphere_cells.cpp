// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/sphere_cells.h"

#include "granular/grid/sphere_box.h"

#include <algorithm>
#include <cmath>

namespace granular
{
namespace
{
constexpr std::int64_t no_cell = -1; // in no range

/// The low part: where the first difference is not exact, it part is below its last bit. Never falls as the face rises.
double difference(double face, Twofold centre)
{
  return face - centre.hi - centre.lo;
}

/// A cell of an axis, seen from the centre of a sphere.
struct Slab
{
  double lo, hi, edge;
};

Slab make_slab(const std::vector<double>& faces, std::int64_t cell, Twofold centre)
{
  const double* face = faces.data() + cell;
  return { difference(face[0], centre), difference(face[1], centre), face[1] - face[0] };
}

/// Adds a share if its cell is within a range.
void add(const std::array<std::int64_t, 3>& cell, double volume, const CellRange& within,
  std::vector<CellShare>& shares)
{
  if (const std::int64_t number = within.number(cell); number >= 0)
  {
    shares.push_back({ number, volume });
  }
}
}

/// The cuts that the faces across an axis make in a sphere.
struct SphereCells::Cut
{
  double distance;                   ///< of the face that cuts it, or the radius
  std::array<std::int64_t, 2> cells; ///< that of the centre, that beyond the face
};

SphereCells::SphereCells(const EulerGrid& grid, bool short_cuts)
  : grid_(grid)
  , finder_(grid)
  , short_cuts_(short_cuts)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    faces_[axis] = grid.faces(axis);
  }
}

/// The cell that a coordinate is in, or the nearest one.
std::int64_t SphereCells::cell_of(std::size_t axis, double x) const noexcept
{
  return finder_.find(axis, std::clamp(x, grid_.lo[axis], grid_.hi[axis]));
}

/// By the numbers by which centred_box_volume finds the volume of the nearest cell to be 0.
bool SphereCells::touches(const Twofold3& centre, double radius) const noexcept
{
  double nearest2 = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lo = difference(faces_[axis].front(), centre[axis]);
    const double hi = difference(faces_[axis].back(), centre[axis]);
    const double distance = std::max({ 0.0, lo, -hi });
    nearest2 += distance * distance;
  }
  return nearest2 < radius * radius;
}

CellRange SphereCells::range(const Twofold3& centre, double radius) const noexcept
{
  if (!this->touches(centre, radius))
  {
    return {};
  }
  const double reach = radius * (1 + 0x1p-50); // differences may be wrong by an ulp
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto from_centre = [&](std::int64_t face)
    { return difference(faces_[axis][static_cast<std::size_t>(face)], centre[axis]); };
    const std::int64_t count = grid_.counts[axis];
    std::int64_t first = this->cell_of(axis, centre[axis].hi - reach);
    while (first > 0 && from_centre(first) >= -reach)
    {
      --first;
    }
    while (first < count && from_centre(first + 1) < -reach)
    {
      ++first;
    }
    std::int64_t last = this->cell_of(axis, centre[axis].hi + reach) + 1;
    while (last < count && from_centre(last) <= reach)
    {
      ++last;
    }
    while (last > 0 && from_centre(last - 1) > reach)
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

/// Returns true if no more than one face cuts a sphere that touches this cell, or the one beside it, and tells which. Not where a cap
/// is so flat that its cell may be smaller than what rounding adds: only centred_box_volume looks at that.
bool SphereCells::cut_once(
  std::size_t axis, std::int64_t cell, Twofold centre, double radius, Cut& cut) const noexcept
{
  const auto from_centre = [&](std::int64_t face)
  { return difference(faces_[axis][static_cast<std::size_t>(face)], centre); };
  const std::int64_t count = grid_.counts[axis];
  const double lo = from_centre(cell);
  const double hi = from_centre(cell + 1);
  const bool is_cut_below = lo > -radius;
  const bool is_cut_above = hi < radius;
  cut = { radius, { cell, no_cell } };
  if (!is_cut_below && !is_cut_above)
  {
    return true;
  }
  const std::int64_t face = is_cut_below ? cell : cell + 1;
  if ((is_cut_below && is_cut_above) || (face > 0 && from_centre(face - 1) > -radius) ||
    (face < count && from_centre(face + 1) < radius))
  {
    return false;
  }
  const double plane = is_cut_below ? lo : hi;
  if (std::abs(plane) > radius * (1 - 0x1p-20))
  {
    return false;
  }
  const std::int64_t below = face - 1; // no_cell below the first
  const std::int64_t above = face < count ? face : no_cell;
  cut = { std::abs(plane), { plane > 0 ? below : above, plane > 0 ? above : below } };
  return true;
}

/// Adds the parts of a sphere that no more than one face an axis cuts: the common cases, in which few comparisons tell what faces
/// there are. Otherwise it is not done.
bool SphereCells::add_quickly(const Twofold3& centre, double radius, const CellRange& within,
  std::vector<CellShare>& shares) const
{
  std::array<Cut, 3> cuts;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t near = this->cell_of(axis, centre[axis].hi);
    const double* face = faces_[axis].data() + near;
    if (difference(face[0], centre[axis]) >= radius || difference(face[1], centre[axis]) <= -radius)
    {
      return true;
    }
    if (!this->cut_once(axis, near, centre[axis], radius, cuts[axis]))
    {
      return false;
    }
  }
  const SphereParts parts =
    cut_sphere(radius, { cuts[0].distance, cuts[1].distance, cuts[2].distance });
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    if (parts[part] > 0)
    {
      add({ cuts[0].cells[part & 1], cuts[1].cells[(part >> 1) & 1], cuts[2].cells[part >> 2] },
        parts[part], within, shares);
    }
  }
  return true;
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
  for (std::int64_t k = range.first[2]; k < range.last[2]; ++k)
  {
    const Slab z = make_slab(faces_[2], k, centre[2]);
    for (std::int64_t j = range.first[1]; j < range.last[1]; ++j)
    {
      const Slab y = make_slab(faces_[1], j, centre[1]);
      for (std::int64_t i = range.first[0]; i < range.last[0]; ++i)
      {
        const Slab x = make_slab(faces_[0], i, centre[0]);
        const double volume = centred_box_volume(
          radius, { x.lo, y.lo, z.lo }, { x.hi, y.hi, z.hi }, { x.edge, y.edge, z.edge });
        if (volume > 0)
        {
          add({ i, j, k }, volume, within, shares);
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
  if (!short_cuts_ || !this->add_quickly(centre, radius, within, shares))
  {
    this->add_cells(centre, radius, within, shares);
  }
}
}
