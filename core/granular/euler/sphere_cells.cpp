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
constexpr std::int64_t no_cell = -1;

/// A cell of an axis, seen from the centre of a sphere.
struct Slab
{
  double lo, hi, edge;

  double nearest() const { return std::max({ 0.0, lo, -hi }); }
  double farthest() const { return std::max(-lo, hi); }
};

/// face less centre, rounded once.
double difference(double face, Twofold centre)
{
  const double hi = face - centre.hi;
  const double part = hi - face;
  const double lo = (face - (hi - part)) - (centre.hi + part);
  return std::isfinite(hi) ? hi + (lo - centre.lo) : hi;
}
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
  double distance = 0;                              ///< of the face, or the radius
  std::array<std::int64_t, 2> cells = { no_cell, no_cell }; ///< that of the centre, the one beyond the face
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

double SphereCells::from_centre(
  std::size_t axis, std::int64_t face, Twofold centre) const noexcept
{
  return difference(faces_[axis][static_cast<std::size_t>(face)], centre);
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
  return std::upper_bound(faces.begin() + 1, faces.end() - 1, x) - (faces.begin() + 1);
}

CellRange SphereCells::range(const Twofold3& centre, double radius) const noexcept
{
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& faces = faces_[axis];
    const auto end_below = [&](double offset, auto compare) {
      return std::partition_point(faces.begin(), faces.end(),
               [&](double face) { return compare(difference(face, centre[axis]), offset); }) -
        faces.begin();
    };
    const std::int64_t below = end_below(-radius, std::less<>()); // faces
    const std::int64_t not_above = end_below(radius, std::less_equal<>());
    range.first[axis] = std::max<std::int64_t>(0, below - 1);
    range.last[axis] = std::min(not_above, grid_.counts[axis]);
    if (range.first[axis] >= range.last[axis])
    {
      return {};
    }
  }
  return range;
}

/// One face, or none: the common case, found without a search.
SphereCells::Cut SphereCells::cut_along(
  std::size_t axis, Twofold centre, double radius) const noexcept
{
  const std::int64_t cell = this->cell_of(axis, centre.hi);
  const double lo = this->from_centre(axis, cell, centre);
  const double hi = this->from_centre(axis, cell + 1, centre);
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
  const std::int64_t below = is_cut_below ? cell - 1 : cell; // the face
  const std::int64_t above = below + 1;
  const bool is_more = (is_cut_below && is_cut_above) ||
    (is_cut_below && below >= 0 && this->from_centre(axis, below, centre) > -radius) ||
    (is_cut_above && above < grid_.counts[axis] &&
      this->from_centre(axis, above + 1, centre) < radius);
  const double plane = is_cut_below ? lo : hi;
  const std::int64_t lower = below;
  const std::int64_t upper = above < grid_.counts[axis] ? above : no_cell;
  return { is_more ? Cut::Kind::More : Cut::Kind::Two, std::abs(plane),
    { plane > 0 ? lower : upper, plane > 0 ? upper : lower } };
}

void SphereCells::add_parts(
  const std::array<Cut, 3>& cuts, double radius, std::vector<CellShare>& shares) const
{
  const SphereParts parts =
    cut_sphere(radius, { cuts[0].distance, cuts[1].distance, cuts[2].distance });
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    const std::int64_t i = cuts[0].cells[part & 1];
    const std::int64_t j = cuts[1].cells[(part >> 1) & 1];
    const std::int64_t k = cuts[2].cells[part >> 2];
    if (parts[part] > 0 && i != no_cell && j != no_cell && k != no_cell)
    {
      shares.push_back({ (k * grid_.counts[1] + j) * grid_.counts[0] + i, parts[part] });
    }
  }
}

void SphereCells::add_cells(
  const Twofold3& centre, double radius, std::vector<CellShare>& shares) const
{
  const CellRange range = this->range(centre, radius);
  const auto slab = [&](std::size_t axis, std::int64_t cell) {
    const auto at = static_cast<std::size_t>(cell);
    const std::vector<double>& faces = faces_[axis];
    return Slab{ difference(faces[at], centre[axis]), difference(faces[at + 1], centre[axis]),
      faces[at + 1] - faces[at] };
  };
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
          shares.push_back({ (k * grid_.counts[1] + j) * grid_.counts[0] + i, volume });
        }
      }
    }
  }
}

void SphereCells::find(
  const Twofold3& centre, double radius, std::vector<CellShare>& shares) const
{
  if (!(sphere_volume(radius) > 0))
  {
    return;
  }
  if (short_cuts_)
  {
    std::array<Cut, 3> cuts;
    auto most = Cut::Kind::Whole;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cuts[axis] = this->cut_along(axis, centre[axis], radius);
      if (cuts[axis].kind == Cut::Kind::Outside)
      {
        return;
      }
      most = std::max(most, cuts[axis].kind);
    }
    if (most != Cut::Kind::More)
    {
      this->add_parts(cuts, radius, shares);
      return;
    }
  }
  this->add_cells(centre, radius, shares);
}
}
