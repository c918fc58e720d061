// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_regions_h
#define granular_packing_regions_h

#include "granular/packing/box_shape.h"
#include "granular/packing/row_range.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// A box cut into regions that are filled with grains one after the other, so that each depends on a few
/// others only and whoever fills it, on whatever rank, comes to the same.
///
/// Planes parallel to the faces of the box cut it into blocks. What is near to planes of three axes is
/// a vertex, of two an edge, of one a face; the rest of each block is its interior. How near that is,
/// in units of the largest radius R:
///
///     vertex    nearer than 5 R to planes of all three axes
///     edge      nearer than 3 R to planes of two axes, and no vertex: 5 R or more from those of the third
///     face      nearer than   R to planes of one axis, and neither: 3 R or more from those of the others
///     interior  all else: R or more from each plane
///
/// The distance to a plane changes by no more than one moves, so two different regions of the same kind
/// are at least 2 R apart - planes of an axis are 12 R apart or more - and so is each region from all of
/// lower dimension but those on the rim of its part of the box. Filled in the order vertices, edges, faces,
/// interiors, regions of a kind do not see each other, and an interior needs 6 faces, 12 edges and 8
/// vertices alone. That holds in tilted boxes too, distances being those to planes.
///
/// Regions that come first are filled as if nothing were around them: grains would be rare just outside of
/// them, and planes would show. So each grain is dealt a layer of its region in the beginning, by
/// depth, and finds its place there.
///
/// An axis that is too short for two blocks has no planes, and all of it is in each region.
class Regions
{
public:
  /// Planes of a region: bit k says that it is on the lower plane of its block across axis k.
  static constexpr unsigned interior = 0;
  static constexpr unsigned vertex = 7;

  struct Region
  {
    std::array<std::int64_t, 3> block = {};
    unsigned planes = interior;
  };

  /// What a region fills, and maybe more, in scaled coordinates: below 0 across a periodic face.
  struct Bounds
  {
    Vector3 low;
    Vector3 high;
  };

  /// radius: half of what two grains may need between them. inset: how near to a face that is not
  /// periodic grains come on average. grains: of the whole box.
  Regions(const BoxShape& box, double radius, double inset, std::int64_t grains);

  /// Regions are numbered block by block, x fastest. Those on a plane that is not there have no grains.
  std::int64_t size() const noexcept { return 8 * blocks(0) * blocks(1) * blocks(2); }
  Region region(std::int64_t index) const noexcept;

  /// The number of the first grain in a region; first(size()) is the number of all. Grains are shared out
  /// by volume, exactly.
  std::int64_t first(std::int64_t index) const noexcept;

  /// The region that holds a grain.
  std::int64_t find(std::int64_t grain) const noexcept;

  Bounds bounds(const Region& region) const noexcept;

  /// Rows after some, in order, that have all those later ones that may be nearer to one of them than six
  /// radii: what is left of their blocks, and later blocks beside these, which are thick enough.
  std::vector<RowRange> rows_near(const RowRange& rows) const;

  static constexpr int outside = -1;

  /// How deep in a region a place within its bounds is, seen from the regions before and after it: the
  /// number of a layer, or outside.
  int layer(const Region& region, const Vector3& scaled) const noexcept;

  /// Cuts the bounds of a region to what is about as far from the nearest planes as a place in it: its
  /// layer fills most of that.
  void narrow(const Region& region, const Vector3& scaled, Bounds& bounds) const noexcept;

  /// Whether the axis is periodic and has no planes: then grains meet their own images.
  bool wraps(std::size_t axis) const noexcept { return axes_[axis].wraps; }

  /// Calls visit(index, shift) for all regions to be filled before this one that are near it, with
  /// their shift as periodic images, in units of the box vectors.
  template <class Visit>
  void visit_rim(const Region& region, const Visit& visit) const;

private:
  struct Axis
  {
    std::int64_t blocks = 1;
    bool planes = false;
    bool periodic = false;
    bool wraps = false;
    double count = 1;             ///< of blocks
    double thickness = 0;         ///< of a block
    double radii = 0;             ///< the same in radii
    std::array<int, 3> rims = {}; ///< planes around a block that is the first, inside, the last
    std::array<double, 3> lengths = { 1, 1, 1 }; ///< of these, less the inset
  };

  /// How a region near a block may lie along an axis.
  struct Choice
  {
    std::int64_t block;
    bool on_plane;
    double shift;
  };

  struct Choices
  {
    std::array<Choice, 3> all;
    std::size_t count = 0;

    void add(const Choice& choice) { all[count++] = choice; }
  };

  using Volumes = std::array<double, 8>; ///< of the regions of a block, by planes

  std::int64_t blocks(std::size_t axis) const noexcept { return axes_[axis].blocks; }
  Vector3 away(const Vector3& scaled, Vector3& planes) const noexcept;
  void narrow(
    std::size_t axis, double plane, double place, double first, Bounds& bounds) const noexcept;
  std::int64_t first_of_block(std::int64_t block) const noexcept;
  void add_later_neighbours(
    std::int64_t block, std::int64_t last, std::vector<std::int64_t>& found) const;
  void cut(const BoxShape& box, std::int64_t grains);
  void measure(double inset);
  Volumes volumes_of(const std::array<std::size_t, 3>& kinds) const noexcept;
  bool has_low_plane(std::size_t axis, std::size_t kind) const noexcept;
  std::size_t kind(std::size_t axis, std::int64_t block) const noexcept;
  double below(std::size_t axis, std::size_t kind, std::int64_t block) const noexcept;
  Choices choices(std::size_t axis, const Region& region) const noexcept;

  double radius_;
  std::int64_t grains_;
  std::array<Axis, 3> axes_;
  // of each kind of block, first, inside, last along each axis
  std::array<std::array<std::array<Volumes, 3>, 3>, 3> volumes_; ///< by z, y, x
  std::array<std::array<std::array<double, 3>, 3>, 3> block_;    ///< sums of these
  std::array<std::array<double, 3>, 3> row_;                     ///< sums along x
  std::array<double, 3> layer_;                                  ///< along x and y
  double total_ = 0;
};

template <class Visit>
void Regions::visit_rim(const Region& region, const Visit& visit) const
{
  const Choices across[] = { this->choices(0, region), this->choices(1, region),
    this->choices(2, region) };
  for (std::size_t z = 0; z < across[2].count; ++z)
  {
    for (std::size_t y = 0; y < across[1].count; ++y)
    {
      for (std::size_t x = 0; x < across[0].count; ++x)
      {
        const Choice choice[] = { across[0].all[x], across[1].all[y], across[2].all[z] };
        const unsigned planes = (choice[0].on_plane ? 1U : 0U) | (choice[1].on_plane ? 2U : 0U) |
          (choice[2].on_plane ? 4U : 0U);
        if (planes != region.planes)
        {
          const std::int64_t block =
            (choice[2].block * blocks(1) + choice[1].block) * blocks(0) + choice[0].block;
          visit(8 * block + planes, Vector3{ choice[0].shift, choice[1].shift, choice[2].shift });
        }
      }
    }
  }
}
}
#endif
