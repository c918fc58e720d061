// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/overlaps.h"
#include "granular/decomposition/process_grid.h"
#include "granular/decomposition/subdomains.h"

#include "granular/geometry/compensated.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace granular
{
namespace
{
/// Pairs beyond this are not counted: there may be n^2 of them.
constexpr std::int64_t most_overlaps = 1'000'000;

std::string printed(const Vector3& values)
{
  return to_text(values[0]) + ' ' + to_text(values[1]) + ' ' + to_text(values[2]);
}

void tell(Answer answer, const std::string& text, const Where& where, Notices& notices)
{
  if (answer == Answer::Error)
  {
    throw FormatError(text, where);
  }
  if (answer == Answer::Notice)
  {
    notices.push_back({ where, text });
  }
}

bool has_bounds(const Subdomain& subdomain)
{
  bool right = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    right = right && std::isfinite(subdomain.lo[axis]) && std::isfinite(subdomain.hi[axis]) &&
      subdomain.lo[axis] <= subdomain.hi[axis];
  }
  return right;
}

std::string bounds_text(std::span<const Subdomain> subdomains, std::int64_t without)
{
  std::string text = "expected finite bounds, lower ones not above upper ones, got " +
    std::to_string(without) + (without == 1 ? " subdomain" : " subdomains") + " without:";
  int named = 0;
  for (const Subdomain& each : subdomains)
  {
    if (!has_bounds(each) && named < 2)
    {
      text += std::string(named == 0 ? "" : ",") + " process " + std::to_string(each.rank) +
        " from " + printed(each.lo) + " to " + printed(each.hi);
      ++named;
    }
  }
  return text;
}

std::string overlap_text(std::span<const Subdomain> subdomains, const Overlaps& found)
{
  const Subdomain& a = subdomains[static_cast<std::size_t>(found.first.first)];
  const Subdomain& b = subdomains[static_cast<std::size_t>(found.first.second)];
  Vector3 shared;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    shared[axis] = std::min(a.hi[axis], b.hi[axis]) - std::max(a.lo[axis], b.lo[axis]);
  }
  return "expected subdomains that share no more than faces, got " +
    std::string(found.more ? "at least " : "") + std::to_string(found.pairs) +
    (found.pairs == 1 ? " pair that overlaps" : " pairs that overlap") + ": processes " +
    std::to_string(a.rank) + " and " + std::to_string(b.rank) + " share " + printed(shared);
}

/// What two may share along each axis; below 0 where the box is flat, so that all share that.
Vector3 allowed_overlap(const Subdomain& bounds, double tolerance)
{
  Vector3 allowed;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // not the edge times the tolerance: the edge may be too large for a double
    const bool flat = bounds.lo[axis] == bounds.hi[axis];
    allowed[axis] = flat ? -1 : tolerance * bounds.hi[axis] - tolerance * bounds.lo[axis];
  }
  return allowed;
}

/// Powers of two that make all coordinates about 1, so that no volume is too large or too small for a double.
Vector3 scales_for(const Subdomain& bounds)
{
  Vector3 scales;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double reach = std::max(std::abs(bounds.lo[axis]), std::abs(bounds.hi[axis]));
    scales[axis] = std::ldexp(1, std::clamp(-std::ilogb(reach), -1022, 1022));
  }
  return scales;
}

/// Adds the volume, to about 100 bits.
void add_volume(CompensatedSum& sum, const Subdomain& subdomain, const Vector3& scales)
{
  std::array<Twofold, 3> edges;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    CompensatedSum edge;
    edge.add(scales[axis] * subdomain.hi[axis]);
    edge.add(-scales[axis] * subdomain.lo[axis]);
    edges[axis] = edge.twofold();
  }
  CompensatedSum area;
  area.add_product(edges[0], edges[1]);
  sum.add_product(area.twofold(), edges[2]);
}

/// The part of the box that is in no subdomain, if no two overlap; 0 where no more than rounding is left.
double gap_of(std::span<const Subdomain> subdomains, const Subdomain& bounds, Progress& progress)
{
  constexpr std::size_t lot = 65536;
  const Vector3 scales = scales_for(bounds);
  CompensatedSum volume;
  add_volume(volume, bounds, scales);
  CompensatedSum rest = volume;
  CompensatedSum taken;
  const auto n = static_cast<double>(subdomains.size());
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    if (i % lot == 0)
    {
      progress.step(static_cast<double>(i) / n);
    }
    add_volume(taken, subdomains[i], scales);
  }
  const Twofold sum = taken.twofold();
  rest.add(Twofold{ -sum.hi, -sum.lo });
  const double gap = rest.value() / volume.value();
  return gap > std::ldexp(n * n, -100) ? gap : 0;
}

bool is_flat(const Subdomain& bounds)
{
  return bounds.lo[0] == bounds.hi[0] || bounds.lo[1] == bounds.hi[1] ||
    bounds.lo[2] == bounds.hi[2];
}

/// Whether those that are not empty form a grid in the bounds: no two overlap then, and there are no gaps.
bool is_grid(std::span<const Subdomain> subdomains, const Subdomain& bounds)
{
  const auto is_empty = [&](const Subdomain& each)
  {
    const auto is_empty_along = [&](std::size_t axis)
    { return each.lo[axis] == each.hi[axis] && bounds.lo[axis] < bounds.hi[axis]; };
    return is_empty_along(0) || is_empty_along(1) || is_empty_along(2);
  };
  std::vector<Subdomain> others;
  if (std::ranges::any_of(subdomains, is_empty))
  {
    std::ranges::remove_copy_if(subdomains, std::back_inserter(others), is_empty);
    subdomains = others;
  }
  const std::optional<ProcessGrid> grid = find_process_grid(subdomains);
  if (!grid)
  {
    return false;
  }
  const auto reaches = [&](std::size_t axis)
  {
    return grid->cuts[axis].front() == bounds.lo[axis] &&
      grid->cuts[axis].back() == bounds.hi[axis];
  };
  return reaches(0) && reaches(1) && reaches(2);
}
}

void check_subdomains(std::span<const Subdomain> subdomains, const SubdomainChecks& checks,
  const Where& where, Notices& notices, Progress& progress)
{
  progress.step(0);
  const auto without = static_cast<std::int64_t>(std::count_if(
    subdomains.begin(), subdomains.end(), [](const Subdomain& each) { return !has_bounds(each); }));
  std::vector<Subdomain> others;
  if (without > 0)
  {
    tell(checks.bounds, bounds_text(subdomains, without), where, notices);
    std::copy_if(subdomains.begin(), subdomains.end(), std::back_inserter(others), has_bounds);
    subdomains = others;
  }
  if (checks.overlap == Answer::None && checks.gap == Answer::None)
  {
    return;
  }
  const Subdomain bounds = bounds_of(subdomains);
  if (bounds.lo == bounds.hi || is_grid(subdomains, bounds))
  {
    return;
  }
  PartialProgress part(progress);
  part.set_part(0.1, 0.9);
  const Overlaps found =
    find_overlaps(subdomains, allowed_overlap(bounds, checks.tolerance), most_overlaps, part);
  if (found.pairs > 0)
  {
    tell(checks.overlap, overlap_text(subdomains, found), where, notices);
  }
  else if (without == 0 && checks.gap != Answer::None && !is_flat(bounds))
  {
    part.set_part(0.9, 1);
    const double gap = gap_of(subdomains, bounds, part);
    if (gap > checks.tolerance)
    {
      tell(checks.gap,
        "expected subdomains that fill the box from " + printed(bounds.lo) + " to " +
          printed(bounds.hi) + ", got gaps of " + to_text(gap) + " of its volume",
        where, notices);
    }
  }
}
}
