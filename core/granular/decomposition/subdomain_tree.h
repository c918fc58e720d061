// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_subdomain_tree_h
#define granular_decomposition_subdomain_tree_h

#include "granular/decomposition/subdomains.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Finds the subdomain that has a point among any that do not overlap. Each is in one leaf of a binary tree; a node
/// knows how far the lower half reaches up and the upper half down along one axis, so that memory is bounded
/// whatever the sizes are. A tree of n is made in n log n; a point takes log n where planes divide the subdomains, as
/// after recursive bisection, and a little more where they cut some.
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
  struct Node
  {
    double lower_end = 0;   ///< where the lower half ends
    double upper_begin = 0; ///< where the upper half begins
    std::uint32_t first =
      0; ///< leaf: box; else: node of the upper half, the lower half's is the next one
    std::uint32_t count = 0; ///< leaf: boxes
    std::uint32_t axis = 0;  ///< 3: leaf
  };

  struct Split;
  void build(std::size_t first, std::size_t last, std::size_t level);
  void add_leaf(std::size_t first, std::size_t last);
  Split find_split(std::size_t first, std::size_t last);

  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
  std::vector<double> scratch_;
};
}
#endif
