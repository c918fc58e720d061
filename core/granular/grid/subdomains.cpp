// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/subdomains.h"

#include "granular/geometry/compensated.h"
#include "granular/grid/subdomain_tree.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace granular
{
namespace
{
/// Two subdomains overlap by more than this part of the box's edge along each axis, gaps have more than this part of its
/// volume: less is rounding.
constexpr double tolerance = 1e-9;

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

void check_bounds(std::span<const Subdomain> subdomains, const Where& where)
{
  std::int64_t without = 0;
  std::string named;
  for (const Subdomain& each : subdomains)
  {
    if (!has_bounds(each) && ++without <= 2)
    {
      named += (without == 1 ? " process " : ", process ") + std::to_string(each.rank) + " from " +
        printed(each.lo) + " to " + printed(each.hi);
    }
  }
  if (without > 0)
  {
    throw FormatError("expected finite bounds, lower ones not above upper ones, got " +
        std::to_string(without) + (without == 1 ? " subdomain" : " subdomains") +
        " without:" + named,
      where);
  }
}

/// The width along each axis that two may share; below 0 where the box is flat, so that all share that.
Vector3 allowed_overlap(const Subdomain& bounds)
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

/// Returns true if two boxes, or one and itself, overlap by more than `allowed`.
bool overlap(const auto& a, const auto& b, const Vector3& allowed)
{
  const auto along = [&](std::size_t axis)
  {
    return !(allowed[axis] >= 0) ||
      (a.lo[axis] < b.hi[axis] - allowed[axis] && b.lo[axis] < a.hi[axis] - allowed[axis]);
  };
  return along(0) && along(1) && along(2);
}

/// Pairs of overlapping subdomains.
struct Overlaps
{
  std::int64_t pairs = 0;
  std::pair<std::size_t, std::size_t> first = {}; ///< the counted pair with the lowest numbers
};

Overlaps find_overlaps(
  std::span<const Subdomain> subdomains, const Vector3& allowed, Progress& progress)
{
  constexpr std::size_t report_interval = 8192;
  std::vector<SubdomainTree::Node> leaves; // thick enough to overlap at all
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    if (overlap(subdomains[i], subdomains[i], allowed))
    {
      leaves.push_back({ subdomains[i].lo, subdomains[i].hi, static_cast<std::int64_t>(i), 0 });
    }
  }
  const SubdomainTree tree(leaves);
  Overlaps found;
  for (std::size_t i = 0; i < leaves.size() && found.pairs < most_overlaps; ++i)
  {
    if (i % report_interval == 0)
    {
      progress.step(static_cast<double>(i) / static_cast<double>(leaves.size()));
    }
    tree.search([&](const auto& node) { return overlap(leaves[i], node, allowed); },
      [&](const auto& other)
      {
        if (other.number > leaves[i].number)
        {
          const std::pair<std::size_t, std::size_t> pair = { leaves[i].number, other.number };
          found.first = found.pairs == 0 ? pair : std::min(found.first, pair);
          ++found.pairs;
        }
        return found.pairs == most_overlaps;
      });
  }
  return found;
}

std::string overlap_text(std::span<const Subdomain> subdomains, const Overlaps& found)
{
  const Subdomain& a = subdomains[found.first.first];
  const Subdomain& b = subdomains[found.first.second];
  Vector3 shared;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    shared[axis] = std::min(a.hi[axis], b.hi[axis]) - std::max(a.lo[axis], b.lo[axis]);
  }
  return "expected subdomains that share no more than faces, got " +
    std::string(found.pairs == most_overlaps ? "at least " : "") + std::to_string(found.pairs) +
    (found.pairs == 1 ? " pair that overlaps" : " pairs that overlap") + ": processes " +
    std::to_string(a.rank) + " and " + std::to_string(b.rank) + " share " + printed(shared);
}

/// The part of the box that is in no subdomain, if no two overlap; nan in a flat box.
double gap_of(std::span<const Subdomain> subdomains, const Subdomain& bounds)
{
  CompensatedSum gap;
  gap.add(1);
  for (const Subdomain& each : subdomains)
  {
    double part = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // half the edges: whole ones may be too large for a double
      part *= (each.hi[axis] / 2 - each.lo[axis] / 2) / (bounds.hi[axis] / 2 - bounds.lo[axis] / 2);
    }
    gap.add(-part);
  }
  return gap.value();
}
}

template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<Decomposition>& decomposition)
{
  archive.number(decomposition.has_particles);
  archive.number(decomposition.has_ranks);
  pass(archive, decomposition.subdomains);
}

Decomposition join(std::span<const Decomposition> parts)
{
  Decomposition all;
  for (const auto& [subdomains, has_particles, has_ranks] : parts)
  {
    const bool is_empty = subdomains.empty(); // nothing is known of arrays where there are no cells
    all.has_particles = all.has_particles && (has_particles || is_empty);
    all.has_ranks = all.has_ranks && (has_ranks || is_empty);
    all.subdomains.insert(all.subdomains.end(), subdomains.begin(), subdomains.end());
  }
  for (std::size_t i = 0; i < all.subdomains.size(); ++i)
  {
    Subdomain& each = all.subdomains[i];
    each.particles = all.has_particles ? each.particles : 0;
    each.rank = all.has_ranks ? each.rank : static_cast<int>(i);
  }
  return all;
}

Decomposition gather_decomposition(const Decomposition& own, Communicator& ranks)
{
  return do_together(ranks, [&] { return join(gather(ranks, own)); });
}

Subdomain bounds_of(std::span<const Subdomain> subdomains) noexcept
{
  Subdomain bounds;
  if (!subdomains.empty())
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    bounds.lo.fill(infinity);
    bounds.hi.fill(-infinity);
  }
  for (const Subdomain& subdomain : subdomains)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // in this order a nan changes nothing
      const double lo = subdomain.lo[axis];
      const double hi = subdomain.hi[axis];
      bounds.lo[axis] = std::min(std::min(bounds.lo[axis], lo), hi);
      bounds.hi[axis] = std::max(std::max(bounds.hi[axis], hi), lo);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (bounds.lo[axis] > bounds.hi[axis]) // nothing but nan
    {
      bounds.lo[axis] = bounds.hi[axis] = 0;
    }
  }
  return bounds;
}

double imbalance_of(std::span<const Subdomain> subdomains, std::int64_t processes) noexcept
{
  std::int64_t largest = 0;
  CompensatedSum total;
  for (const Subdomain& subdomain : subdomains)
  {
    largest = std::max(largest, subdomain.particles);
    total.add(static_cast<double>(subdomain.particles));
  }
  const auto count =
    static_cast<double>(processes > 0 ? processes : static_cast<std::int64_t>(subdomains.size()));
  // the product first: of counts below 2^53 / n it is exact, and the quotient the nearest double
  return largest > 0 ? static_cast<double>(largest) * count / total.value() : 1;
}

void check_subdomains(std::span<const Subdomain> subdomains, const SubdomainChecks& checks,
  const Where& where, Notices& notices, Progress& progress)
{
  check_bounds(subdomains, where);
  if (checks.overlap == Answer::None && checks.gap == Answer::None)
  {
    return;
  }
  const Subdomain bounds = bounds_of(subdomains);
  if (bounds.lo == bounds.hi)
  {
    return;
  }
  const Overlaps found = find_overlaps(subdomains, allowed_overlap(bounds), progress);
  if (found.pairs > 0)
  {
    tell(checks.overlap, overlap_text(subdomains, found), where, notices);
    return;
  }
  const double gap = checks.gap == Answer::None ? 0 : gap_of(subdomains, bounds);
  if (gap > tolerance)
  {
    tell(checks.gap,
      "expected subdomains that fill the box from " + printed(bounds.lo) + " to " +
        printed(bounds.hi) + ", got gaps of " + to_text(gap) + " of its volume",
      where, notices);
  }
}
}
