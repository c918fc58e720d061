// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/regions.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace granular
{
namespace
{
// how near to planes a region is, in radii, by the number of their axes
constexpr double reach[] = { 0, 1, 3, 5 };

constexpr double least_block = 30;   ///< radii: 12 would do, but the thinner, the more is rim
constexpr double least_grains = 256; ///< in a block

// kinds of blocks along an axis
constexpr std::size_t first_block = 0;
constexpr std::size_t inner_block = 1;
constexpr std::size_t last_block = 2;

bool is_on(unsigned planes, std::size_t axis)
{
  return (planes >> axis & 1U) != 0;
}

constexpr double far = 1e9; ///< radii: farther than any plane

/// Layers of half a radius; what is deeper is one.
constexpr int layers = 7;

int layer_at(double depth)
{
  return std::min(static_cast<int>(2 * std::min(depth, far)), layers - 1);
}

std::int64_t share(std::int64_t grains, double part)
{
  return static_cast<std::int64_t>(std::floor(static_cast<double>(grains) * part));
}
}

Regions::Regions(const BoxShape& box, double radius, double inset, std::int64_t grains)
  : radius_(radius)
  , grains_(grains)
{
  this->cut(box, grains);
  this->measure(inset);
}

/// Blocks that are as small as can be, but hold enough grains on average for the work around them.
void Regions::cut(const BoxShape& box, std::int64_t grains)
{
  std::array<double, 3> blocks = {};
  double thickness = least_block * radius_;
  const double most = static_cast<double>(grains) / least_grains + 1;
  do
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      blocks[axis] = std::max(1.0, std::floor(box.heights[axis] / thickness));
    }
    thickness *= 1.25;
  } while (blocks[0] * blocks[1] * blocks[2] > most);
  for (std::size_t k = 0; k < 3; ++k)
  {
    Axis& axis = axes_[k];
    axis.blocks = static_cast<std::int64_t>(blocks[k]);
    axis.planes = axis.blocks > 1;
    axis.periodic = box.periodic[k];
    axis.wraps = axis.periodic && !axis.planes;
    axis.count = blocks[k];
    axis.thickness = box.heights[k] / blocks[k];
    axis.radii = axis.thickness / radius_;
  }
}

/// Volumes of all regions, in closed form.
void Regions::measure(double inset)
{
  for (Axis& axis : axes_)
  {
    if (axis.planes)
    {
      const bool open = !axis.periodic;
      axis.rims = { open ? 1 : 2, 2, open ? 1 : 2 };
      const double outer = axis.thickness - (open ? inset : 0);
      axis.lengths = { outer, axis.thickness, outer };
    }
  }
  for (std::size_t z = 0; z < 3; ++z)
  {
    layer_[z] = 0;
    for (std::size_t y = 0; y < 3; ++y)
    {
      row_[z][y] = 0;
      for (std::size_t x = 0; x < 3; ++x)
      {
        volumes_[z][y][x] = this->volumes_of({ x, y, z });
        double sum = 0;
        for (const double volume : volumes_[z][y][x])
        {
          sum += volume;
        }
        block_[z][y][x] = sum;
        row_[z][y] += this->below(0, x, blocks(0)) * sum;
      }
      layer_[z] += this->below(1, y, blocks(1)) * row_[z][y];
    }
    total_ += this->below(2, z, blocks(2)) * layer_[z];
  }
}

Regions::Volumes Regions::volumes_of(const std::array<std::size_t, 3>& kinds) const noexcept
{
  std::array<double, 3> length = {};
  std::array<double, 3> rims = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    length[axis] = axes_[axis].lengths[kinds[axis]];
    rims[axis] = axes_[axis].rims[kinds[axis]];
  }
  const double face = reach[1] * radius_;
  const double edge = reach[2] * radius_;
  const double corner = reach[3] * radius_;
  Volumes volumes = {};
  double rim = rims[0] * rims[1] * rims[2] * corner * corner * corner; // what is no interior
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    // cut out of a face where three planes meet: it belongs to the vertex
    const double notch = rims[b] * rims[c] * (corner - edge) * (corner - edge);
    const double area = (length[b] - rims[b] * edge) * (length[c] - rims[c] * edge) - notch;
    const double run = edge * edge * (length[a] - rims[a] * corner);
    volumes[1U << a] = 2 * face * area;
    volumes[Regions::vertex - (1U << a)] = 4 * run;
    rim += rims[a] * face * area + rims[b] * rims[c] * run;
  }
  volumes[Regions::vertex] = 8 * corner * corner * corner;
  volumes[Regions::interior] = length[0] * length[1] * length[2] - rim;
  for (unsigned planes = 0; planes < 8; ++planes)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (is_on(planes, axis) && !this->has_low_plane(axis, kinds[axis]))
      {
        volumes[planes] = 0;
      }
    }
  }
  return volumes;
}

bool Regions::has_low_plane(std::size_t axis, std::size_t kind) const noexcept
{
  return axes_[axis].planes && (axes_[axis].periodic || kind != first_block);
}

std::size_t Regions::kind(std::size_t axis, std::int64_t block) const noexcept
{
  const std::int64_t last = blocks(axis) - 1;
  const std::size_t open = block == 0 ? first_block : block == last ? last_block : inner_block;
  return axes_[axis].periodic || !axes_[axis].planes ? inner_block : open;
}

/// How many blocks of a kind there are below one.
double Regions::below(std::size_t axis, std::size_t kind, std::int64_t block) const noexcept
{
  if (axes_[axis].periodic || !axes_[axis].planes)
  {
    return kind == inner_block ? static_cast<double>(block) : 0;
  }
  const std::int64_t all = blocks(axis);
  const std::int64_t counts[] = { std::min<std::int64_t>(block, 1),
    std::clamp<std::int64_t>(block - 1, 0, all - 2), block == all ? 1 : 0 };
  return static_cast<double>(counts[kind]);
}

Regions::Region Regions::region(std::int64_t index) const noexcept
{
  const std::int64_t block = index / 8;
  const std::int64_t row = block / blocks(0);
  return { { block % blocks(0), row % blocks(1), row / blocks(1) },
    static_cast<unsigned>(index % 8) };
}

/// The number of the first grain in a block.
std::int64_t Regions::first_of_block(std::int64_t block) const noexcept
{
  if (8 * block >= this->size())
  {
    return grains_;
  }
  const Region at = this->region(8 * block);
  const std::size_t y = this->kind(1, at.block[1]);
  const std::size_t z = this->kind(2, at.block[2]);
  double volume = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    volume += this->below(2, k, at.block[2]) * layer_[k];
    volume += this->below(1, k, at.block[1]) * row_[z][k];
    volume += this->below(0, k, at.block[0]) * block_[z][y][k];
  }
  return share(grains_, volume / total_);
}

/// Within its block a region without volume has no grains, however sums of volumes are rounded.
std::int64_t Regions::first(std::int64_t index) const noexcept
{
  const std::int64_t block = index / 8;
  const std::int64_t start = this->first_of_block(block);
  const Region at = this->region(index);
  if (at.planes == interior)
  {
    return start;
  }
  const std::size_t y = this->kind(1, at.block[1]);
  const std::size_t z = this->kind(2, at.block[2]);
  const std::size_t x = this->kind(0, at.block[0]);
  double volume = 0;
  for (unsigned planes = 0; planes < at.planes; ++planes)
  {
    volume += volumes_[z][y][x][planes];
  }
  return start + share(this->first_of_block(block + 1) - start, volume / block_[z][y][x]);
}

std::int64_t Regions::find(std::int64_t grain) const noexcept
{
  std::int64_t low = 0; // first(low) <= grain < first(high)
  std::int64_t high = this->size();
  while (high - low > 1)
  {
    const std::int64_t middle = low + (high - low) / 2;
    (this->first(middle) <= grain ? low : high) = middle;
  }
  return low;
}

Regions::Bounds Regions::bounds(const Region& region) const noexcept
{
  const double width = reach[std::popcount(region.planes)] * radius_;
  Bounds bounds = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Axis& axis = axes_[k];
    const auto count = static_cast<double>(axis.blocks);
    const auto block = static_cast<double>(region.block[k]);
    const double part = width / (axis.thickness * count);
    const bool on = is_on(region.planes, k);
    bounds.low[k] = on ? block / count - part : block / count;
    bounds.high[k] = on ? block / count + part : (block + 1) / count;
  }
  return bounds;
}

/// Distances to the nearest planes, in radii; and these planes, by their number.
Vector3 Regions::away(const Vector3& scaled, Vector3& planes) const noexcept
{
  Vector3 away;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Axis& axis = axes_[k];
    const double place = scaled[k] * axis.count;
    planes[k] = static_cast<double>(static_cast<std::int64_t>(place + 1.5) - 1);
    const bool there = axis.planes && (axis.periodic || (planes[k] > 0 && planes[k] < axis.count));
    away[k] = there ? std::abs(place - planes[k]) * axis.radii : far;
  }
  return away;
}

/// With the distances to planes in order a place is in a vertex if the largest is less than 5 R, else on an
/// edge if the second is less than 3 R, else on a face if the least is less than R. So from the inside
/// of a region it is as far to those that come later as the limit it is below of, and to those before
/// as the nearest of the limits it is above of.
int Regions::layer(const Region& region, const Vector3& scaled) const noexcept
{
  Vector3 planes;
  const Vector3 away = this->away(scaled, planes);
  const double least = std::min(away[0], away[1]);
  const double more = std::max(away[0], away[1]);
  const Vector3 sorted = { std::min(least, away[2]), std::max(least, std::min(more, away[2])),
    std::max(more, away[2]) };
  const unsigned on = sorted[2] < reach[3] ? 3
    : sorted[1] < reach[2]                 ? 2
    : sorted[0] < reach[1]                 ? 1
                                           : 0;
  const unsigned found = (away[0] < reach[on] ? 1U : 0U) | (away[1] < reach[on] ? 2U : 0U) |
    (away[2] < reach[on] ? 4U : 0U);
  if (found != region.planes)
  {
    return outside;
  }
  double before = far;
  for (std::size_t i = on; i < 3; ++i)
  {
    before = std::min(before, sorted[i] - reach[i + 1]);
  }
  const double after = on > 0 ? reach[on] - sorted[on - 1] : far;
  return layer_at(before) * layers + layer_at(after);
}

void Regions::narrow(const Region& region, const Vector3& scaled, Bounds& bounds) const noexcept
{
  Vector3 planes;
  const Vector3 away = this->away(scaled, planes);
  std::array<std::size_t, 3> near = { 0, 1, 2 }; // axes, the nearest plane first
  std::sort(
    near.begin(), near.end(), [&away](std::size_t a, std::size_t b) { return away[a] < away[b]; });
  const auto on = static_cast<std::size_t>(std::popcount(region.planes));
  std::size_t nearest = 3;
  double before = far;
  for (std::size_t i = on; i < 3; ++i)
  {
    const double depth = away[near[i]] - reach[i + 1];
    nearest = depth < before ? i : nearest;
    before = std::min(before, depth);
  }
  if (layer_at(before) < layers - 1)
  {
    const std::size_t k = near[nearest];
    this->narrow(k, planes[k], scaled[k], reach[nearest + 1] + 0.5 * layer_at(before), bounds);
  }
  if (on > 0)
  {
    const std::size_t k = near[on - 1];
    const int after = layer_at(reach[on] - away[k]);
    if (after < layers - 1)
    {
      this->narrow(k, planes[k], scaled[k], reach[on] - 0.5 * (after + 1), bounds);
    }
  }
}

/// To half a radius, from so many radii on, on that side of a plane where the place is.
void Regions::narrow(
  std::size_t axis, double plane, double place, double first, Bounds& bounds) const noexcept
{
  const double sign = place * axes_[axis].count < plane ? -1 : 1;
  const double ends[] = { (plane + sign * first / axes_[axis].radii) / axes_[axis].count,
    (plane + sign * (first + 0.5) / axes_[axis].radii) / axes_[axis].count };
  bounds.low[axis] = std::max(bounds.low[axis], std::min(ends[0], ends[1]));
  bounds.high[axis] = std::min(bounds.high[axis], std::max(ends[0], ends[1]));
}

Regions::Choices Regions::choices(std::size_t axis, const Region& region) const noexcept
{
  const std::int64_t block = region.block[axis];
  const Axis& along = axes_[axis];
  Choices found;
  found.add({ block, is_on(region.planes, axis), 0 });
  if (along.wraps)
  {
    found.add({ block, false, -1 });
    found.add({ block, false, 1 });
  }
  else if (along.planes && !is_on(region.planes, axis))
  {
    const bool last = block + 1 == along.blocks;
    if (along.periodic || block > 0)
    {
      found.add({ block, true, 0 });
    }
    if (along.periodic || !last)
    {
      found.add({ last ? 0 : block + 1, true, last ? 1.0 : 0.0 });
    }
  }
  return found;
}
}
