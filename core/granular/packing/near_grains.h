// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_near_grains_h
#define granular_packing_near_grains_h

#include "granular/memory/block.h"
#include "granular/packing/box_shape.h"
#include "granular/packing/grain_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// Particles at given positions; points are three coordinates per row.
struct PlacedGrains
{
  RowRange rows;
  const double* points;
  const double* radius;

  Vector3 point(std::int64_t i) const noexcept
  {
    return { points[3 * i], points[3 * i + 1], points[3 * i + 2] };
  }
};

/// Finds the particles and periodic images that are nearer to given particles than a factor times the sum of the radii.
/// Particles of different sizes are on levels: radii on a level are up to twice those on the next one, and cells are as
/// large as two of its particles.
class NearGrains
{
public:
  struct Grain
  {
    Vector3 centre; ///< in the box
    double radius;
    std::int64_t row;
    std::array<std::int8_t, 3>
      image; ///< how many of each box vector the image is away from the centre
  };

  /// own: the particles whose neighbours are requested; not empty. others: further particles that may be near them.
  NearGrains(const BoxShape& box, double factor, const PlacedGrains& own,
    const std::vector<PlacedGrains>& others);

  /// Returns the largest distance of near centres for a sum of two radii, with an allowance for rounding.
  double limit(double sum_of_radii) const noexcept
  {
    return sum_of_radii * factor_ + 2 * box_.rounding();
  }

  /// Returns the rounded position of an image.
  Vector3 point(const Grain& grain) const noexcept
  {
    const Vector3& at = grain.centre;
    if (grain.image == std::array<std::int8_t, 3>{})
    {
      return at;
    }
    const Vector3 edge = box_.edge({ static_cast<double>(grain.image[0]),
      static_cast<double>(grain.image[1]), static_cast<double>(grain.image[2]) });
    return { at[0] + edge[0], at[1] + edge[1], at[2] + edge[2] };
  }

  /// Calls visit(number, particle) for a set of particles that contains all near ones, once per image.
  template <class Visit>
  void visit(const Vector3& point, double radius, const Visit& visit) const;

  /// Returns the particle with a number that visit received.
  const Grain& operator[](std::uint32_t number) const noexcept { return grains()[number]; }

private:
  struct Level
  {
    double radius = 0; ///< the largest
    std::int64_t grains = 0;
    std::array<std::int64_t, 3> cells = {};
    Vector3 scale = {};                    ///< cells per scaled coordinate
    std::vector<std::uint32_t> first = {}; ///< grain of each cell, x fastest, and the end
  };

  Vector3 scaled(const Vector3& point) const noexcept;
  double margin(double distance, std::size_t axis) const noexcept;
  void bound(const PlacedGrains& own);
  Level& level_of(double radius) noexcept;
  void lay(Level& level) const;
  std::size_t cell_of(const Level& level, const Vector3& scaled) const noexcept;
  void add_up();
  template <class Visit>
  void visit_images(const std::vector<PlacedGrains>& all, const Visit& visit);
  template <class Visit>
  void visit_images(const PlacedGrains& grains, std::int64_t i, const Visit& visit) const;
  Grain* grains() const noexcept { return static_cast<Grain*>(block_.data()); }

  const BoxShape& box_;
  double factor_;
  std::array<Vector3, 3> faces_; ///< of a vector from the origin they make scaled coordinates
  double largest_ = 0;           ///< radius
  Vector3 low_;                  ///< of what is kept, in scaled coordinates
  Vector3 high_;
  std::vector<Level> levels_; ///< from large to small
  Block block_;               ///< the grains of all levels, in the order of cells
};

template <class Visit>
void NearGrains::visit(const Vector3& point, double radius, const Visit& visit) const
{
  const Vector3 place = this->scaled(point);
  for (const Level& level : levels_)
  {
    std::array<std::int64_t, 3> from = {};
    std::array<std::int64_t, 3> to = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double reach = this->margin(this->limit(radius + level.radius), k);
      const double begin = (place[k] - reach - low_[k]) * level.scale[k];
      const double end = (place[k] + reach - low_[k]) * level.scale[k];
      from[k] = static_cast<std::int64_t>(std::max(begin, 0.0));
      to[k] = std::min(static_cast<std::int64_t>(end), level.cells[k] - 1);
    }
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
    {
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
      {
        const std::int64_t row = (z * level.cells[1] + y) * level.cells[0];
        const std::uint32_t end = level.first[static_cast<std::size_t>(row + to[0]) + 1];
        for (std::uint32_t i = level.first[static_cast<std::size_t>(row + from[0])]; i < end; ++i)
        {
          visit(i, grains()[i]);
        }
      }
    }
  }
}
}
#endif
