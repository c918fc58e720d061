// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_subdomain_tree_h
#define granular_decomposition_subdomain_tree_h

#include "granular/decomposition/subdomains.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Finds the subdomain that has a point among any that do not overlap. Each is a leaf of a binary tree; a node
/// knows how far the lower half reaches up and the upper half down along one axis, so that memory is bounded
/// whatever the sizes are. A tree of n is made in n log n; a point takes log n where planes divide the subdomains, as
/// after recursive bisection, and a little more where they cut some. A coarse grid says how far down a point may
/// begin, which is near the leaves where sizes are alike.
class SubdomainTree
{
public:
  /// A subdomain as the tree holds it.
  struct Box
  {
    Vector3 lo;
    Vector3 hi;
    std::int64_t number; ///< of the subdomain

    /// How many axes have lo <= x < hi; -1 where not all have lo <= x <= hi.
    int inside(const double* x) const noexcept;
  };

  /// Those that are empty or no boxes hold nothing.
  explicit SubdomainTree(std::span<const Subdomain> subdomains);

  /// Of the closed boxes that have the point, the one with the most axes along which lo <= x < hi; of these
  /// (flat ones among them) the one that begins last along x, then y, then z, then the last. Null: none.
  const Box* find(const double* x) const noexcept;

private:
  /// A box, if is_box is set in it, else a node.
  using Place = std::uint32_t;
  static constexpr Place is_box = Place{ 1 } << 31;

  struct Node
  {
    double lower_end = 0;   ///< where the lower half ends
    double upper_begin = 0; ///< where the upper half begins
    std::array<Place, 2> halves = {};
    std::uint32_t axis = 0;
  };

  /// Cells of the coarse grid along each axis, [first, last).
  struct Cells
  {
    std::array<std::uint32_t, 3> first = {};
    std::array<std::uint32_t, 3> last = {};
  };

  struct Split;
  Place build(std::size_t first, std::size_t last, std::size_t level);
  static Split find_split(std::span<const Box> boxes);
  static Split find_median(std::span<const Box> boxes);
  void make_starts();
  void set_starts(Place at, const Cells& cells);

  /// Never falls as x grows, however it is rounded.
  std::uint32_t cell_of(double x, std::size_t axis) const noexcept
  {
    const double cell = (x - origin_[axis]) * scale_[axis];
    return static_cast<std::uint32_t>(std::min(last_cell_, std::max(0.0, cell)));
  }

  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
  Place root_ = 0;
  std::uint32_t cells_ = 1; ///< along each axis
  double last_cell_ = 0;
  Vector3 origin_ = {};
  Vector3 scale_ = {}; ///< cells a unit of length
  std::vector<Place>
    starts_; ///< of each cell: below it are all subdomains that reach into the cell
};
}
#endif
