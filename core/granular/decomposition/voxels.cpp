// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/voxels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace granular
{
namespace
{
constexpr std::size_t corners = corners_of_voxel;
constexpr std::size_t subdomains_a_chunk = 16384;

/// Calls task(begin, end) for parts of [0, count).
template <class Task>
void for_parts(const Executor& executor, std::size_t count, Progress& progress, const Task& task)
{
  const std::size_t chunks = (count + subdomains_a_chunk - 1) / subdomains_a_chunk;
  executor.parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t)
    {
      const std::size_t begin = chunk * subdomains_a_chunk;
      task(begin, std::min(begin + subdomains_a_chunk, count));
    },
    progress);
}

Vector3 corner_of(const Subdomain& subdomain, std::size_t number) noexcept
{
  return { number & 4 ? subdomain.hi[0] : subdomain.lo[0],
    number & 2 ? subdomain.hi[1] : subdomain.lo[1],
    number & 1 ? subdomain.hi[2] : subdomain.lo[2] };
}

/// Each subdomain with corners of its own.
void make_separate(std::span<const Subdomain> subdomains, const Vector3& origin,
  const Executor& executor, Progress& progress, Voxels& voxels)
{
  double* const points = static_cast<double*>(voxels.points.data());
  auto* const connectivity = static_cast<std::int64_t*>(voxels.connectivity.data());
  for_parts(executor, subdomains.size(), progress,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t p = begin; p < end; ++p)
      {
        const Vector3& lo = subdomains[p].lo;
        const Vector3& hi = subdomains[p].hi;
        const double x[2] = { lo[0] - origin[0], hi[0] - origin[0] };
        const double y[2] = { lo[1] - origin[1], hi[1] - origin[1] };
        const double z[2] = { lo[2] - origin[2], hi[2] - origin[2] };
        double* const point = points + 3 * corners * p;
        std::int64_t* const cell = connectivity + corners * p;
        for (std::size_t i = 0; i < corners; ++i)
        {
          point[3 * i] = x[i >> 2];
          point[3 * i + 1] = y[i >> 1 & 1];
          point[3 * i + 2] = z[i & 1];
          cell[i] = static_cast<std::int64_t>(corners * p) + voxel_corners[i];
        }
      }
    });
}

bool has_nan(const double* point) noexcept
{
  return std::isnan(point[0]) || std::isnan(point[1]) || std::isnan(point[2]);
}

/// Finds corners again. It keeps where points are, and with each as much of its hash as there is room for, so
/// that a point is looked at only if it is the one, nearly always.
class CornerTable
{
public:
  using Numbers = std::array<std::int64_t, corners>;
  using Hashes = std::array<std::uint64_t, corners>;

  /// points: room for all there may be; subdomains: how many there are.
  CornerTable(double* points, std::size_t subdomains)
    : points_(points)
    , slots_(std::bit_ceil(2 * subdomains + 64), empty)
  {
  }

  std::size_t size() const noexcept { return size_; }

  /// Makes room for the corners of that many subdomains.
  void reserve(std::size_t subdomains)
  {
    if (2 * (size_ + corners * subdomains) > slots_.size())
    {
      this->grow();
    }
  }

  /// Of all corners; begins to fetch where they may be.
  Hashes hashes_of(const Subdomain& subdomain) const noexcept
  {
    const Subdomain& s = subdomain;
    const std::uint64_t x[2] = { mixed(s.lo[0], 1), mixed(s.hi[0], 1) };
    const std::uint64_t y[2] = { mixed(s.lo[1], 3), mixed(s.hi[1], 3) };
    const std::uint64_t z[2] = { mixed(s.lo[2], 5), mixed(s.hi[2], 5) };
    Hashes hashes;
    for (std::size_t i = 0; i < corners; ++i)
    {
      hashes[i] = joined(x[i >> 2], y[i >> 1 & 1], z[i & 1]);
      __builtin_prefetch(&slots_[hashes[i] & (slots_.size() - 1)]);
    }
    return hashes;
  }

  /// Of all corners; those that are new become points.
  Numbers find(const Subdomain& subdomain, const Hashes& hashes) noexcept
  {
    Numbers numbers;
    for (std::size_t i = 0; i < corners; ++i)
    {
      numbers[i] = this->find(corner_of(subdomain, i), hashes[i]);
    }
    return numbers;
  }

private:
  static constexpr std::uint64_t empty = ~std::uint64_t{ 0 };
  static constexpr std::uint64_t number_bits =
    (std::uint64_t{ 1 } << 40) - 1; // 2^31 processes, 8 corners

  static std::uint64_t mixed(double coordinate, std::uint64_t salt) noexcept
  {
    // -0 is 0
    std::uint64_t bits = std::bit_cast<std::uint64_t>(coordinate + 0.0) + salt;
    bits = (bits ^ bits >> 32) * 0xd6e8feb86659fd93;
    return (bits ^ bits >> 32) * 0xd6e8feb86659fd93;
  }

  static std::uint64_t joined(std::uint64_t x, std::uint64_t y, std::uint64_t z) noexcept
  {
    const std::uint64_t sum = x + y + z;
    return sum ^ sum >> 29;
  }

  std::uint64_t hash_of(std::size_t number) const noexcept
  {
    const double* const at = points_ + 3 * number;
    return joined(mixed(at[0], 1), mixed(at[1], 3), mixed(at[2], 5));
  }

  std::int64_t find(const Vector3& corner, std::uint64_t hash) noexcept
  {
    const std::uint64_t tag = hash & ~number_bits;
    std::size_t at = hash & (slots_.size() - 1);
    if (has_nan(corner.data())) // equal to none: it would only be in the way of others
    {
      std::copy(corner.begin(), corner.end(), points_ + 3 * size_);
      return static_cast<std::int64_t>(size_++);
    }
    for (; slots_[at] != empty; at = (at + 1) & (slots_.size() - 1))
    {
      if ((slots_[at] & ~number_bits) == tag)
      {
        const std::uint64_t number = slots_[at] & number_bits;
        if (std::equal(corner.begin(), corner.end(), points_ + 3 * number))
        {
          return static_cast<std::int64_t>(number);
        }
      }
    }
    std::copy(corner.begin(), corner.end(), points_ + 3 * size_);
    slots_[at] = tag | size_;
    return static_cast<std::int64_t>(size_++);
  }

  void grow()
  {
    std::vector<std::uint64_t> slots(2 * slots_.size(), empty);
    slots_.swap(slots);
    for (std::size_t number = 0; number < size_; ++number)
    {
      if (has_nan(points_ + 3 * number))
      {
        continue;
      }
      const std::uint64_t hash = this->hash_of(number);
      std::size_t at = hash & (slots_.size() - 1);
      while (slots_[at] != empty)
      {
        at = (at + 1) & (slots_.size() - 1);
      }
      slots_[at] = (hash & ~number_bits) | number;
    }
  }

  double* points_;
  std::vector<std::uint64_t> slots_; ///< a power of two, at least half of them empty
  std::size_t size_ = 0;
};

/// Corners that are equal become one. Some subdomains are hashed ahead, while memory fetches their slots.
std::size_t make_shared_corners(
  std::span<const Subdomain> subdomains, Progress& progress, Voxels& voxels)
{
  constexpr std::size_t ahead = 16;
  std::array<CornerTable::Hashes, ahead> hashes;
  auto* connectivity = static_cast<std::int64_t*>(voxels.connectivity.data());
  CornerTable table(static_cast<double*>(voxels.points.data()), subdomains.size());
  const std::size_t all = subdomains.size();
  for (std::size_t done = 0; done < all; done += ahead)
  {
    if (done % subdomains_a_chunk == 0)
    {
      progress.step(static_cast<double>(done) / static_cast<double>(all));
    }
    const std::size_t count = std::min(ahead, all - done);
    table.reserve(count);
    for (std::size_t p = 0; p < count; ++p)
    {
      hashes[p] = table.hashes_of(subdomains[done + p]);
    }
    for (std::size_t p = 0; p < count; ++p, connectivity += corners)
    {
      const CornerTable::Numbers numbers = table.find(subdomains[done + p], hashes[p]);
      for (std::size_t i = 0; i < corners; ++i)
      {
        connectivity[i] = numbers[static_cast<std::size_t>(voxel_corners[i])];
      }
    }
  }
  return table.size();
}

void subtract(const Vector3& origin, const Executor& executor, Progress& progress, Voxels& voxels)
{
  double* const points = static_cast<double*>(voxels.points.data());
  for_parts(executor, static_cast<std::size_t>(voxels.number_of_points), progress,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = 3 * begin; i < 3 * end; ++i)
      {
        points[i] -= origin[i % 3];
      }
    });
}

/// The corners of a box in an order of cells: of each corner which bound it has along x (1), y (2) and z (4).
struct KnownOrder
{
  CornerOrder order;
  std::array<unsigned, corners> sides;
};

bool is_same(double a, double b) noexcept
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

constexpr KnownOrder known_orders[] = {
  { CornerOrder::Voxel, { 0, 1, 2, 3, 4, 5, 6, 7 } },
  { CornerOrder::Reflected, { 0, 4, 2, 6, 1, 5, 3, 7 } },
  { CornerOrder::Hexahedron, { 0, 1, 3, 2, 4, 5, 7, 6 } },
};
}

Voxels make_voxels(std::span<const Subdomain> subdomains, const Vector3& origin,
  bool shared_corners, const Executor& executor, Progress& progress,
  const std::shared_ptr<BlockPool>& pool)
{
  const std::size_t most_points = corners * subdomains.size();
  Voxels voxels;
  voxels.points = Block(most_points * sizeof(Vector3), pool);
  voxels.connectivity = Block(most_points * sizeof(std::int64_t), pool);
  voxels.number_of_points = static_cast<std::int64_t>(most_points);
  if (!shared_corners)
  {
    make_separate(subdomains, origin, executor, progress, voxels);
    return voxels;
  }
  PartialProgress part(progress);
  part.set_part(0, 0.9);
  const std::size_t points = make_shared_corners(subdomains, part, voxels);
  voxels.number_of_points = static_cast<std::int64_t>(points);
  voxels.points.shrink(points * sizeof(Vector3));
  if (origin != Vector3{})
  {
    part.set_part(0.9, 1);
    subtract(origin, executor, part, voxels);
  }
  return voxels;
}

CornerOrder bounds_of_cell(
  std::span<const Vector3, corners_of_voxel> points, Subdomain& subdomain) noexcept
{
  for (const KnownOrder& known : known_orders)
  {
    Subdomain box;
    for (std::size_t i = 0; i < corners; ++i)
    {
      box.lo = known.sides[i] == 0 ? points[i] : box.lo;
      box.hi = known.sides[i] == 7 ? points[i] : box.hi;
    }
    bool right = true;
    for (std::size_t i = 0; i < corners; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const bool high = (known.sides[i] >> axis & 1) != 0;
        right = right && is_same(points[i][axis], (high ? box.hi : box.lo)[axis]);
      }
    }
    if (right)
    {
      subdomain.lo = box.lo;
      subdomain.hi = box.hi;
      return known.order;
    }
  }
  return CornerOrder::None;
}
}
