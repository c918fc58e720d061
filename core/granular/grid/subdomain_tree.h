// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_subdomain_tree_h
#define granular_grid_subdomain_tree_h

#include "granular/geometry/box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// A tree of bounding boxes. Each subdomain is one leaf, so memory is bounded for any sizes. A node comes before all nodes
/// below it, so a search is one loop that jumps over the nodes whose bounds miss the target.
class SubdomainTree
{
public:
  struct Node
  {
    Vector3 lo; ///< bounds of all leaves below the node
    Vector3 hi;
    std::int64_t number; ///< of the subdomain of a leaf; -1: no leaf
    std::size_t behind;  ///< the first node that is not below this one
  };

  /// Builds the tree in n log n; each leaf has lo <= hi.
  explicit SubdomainTree(std::vector<Node> leaves)
  {
    if (!leaves.empty())
    {
      this->append(leaves);
    }
  }

  /// Calls visit(leaf) for the leaves that `meets` accepts, as it does all nodes above them, until visit returns true.
  template <class Meets, class Visit>
  void search(const Meets& meets, const Visit& visit) const
  {
    for (std::size_t i = 0; i < nodes_.size();)
    {
      const Node& node = nodes_[i];
      const bool met = meets(node);
      if (met && node.number >= 0 && visit(node))
      {
        return;
      }
      i = met ? i + 1 : node.behind;
    }
  }

private:
  /// Appends the node of these leaves and all below it. Leaves are divided along the axis along which their lower faces are
  /// spread most.
  void append(std::span<Node> leaves)
  {
    const std::size_t number = nodes_.size();
    nodes_.push_back(leaves.front());
    if (leaves.size() > 1)
    {
      Node& node = nodes_.back();
      node.number = -1;
      Vector3 last = node.lo;
      for (const Node& leaf : leaves)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          node.lo[axis] = std::min(node.lo[axis], leaf.lo[axis]);
          node.hi[axis] = std::max(node.hi[axis], leaf.hi[axis]);
          last[axis] = std::max(last[axis], leaf.lo[axis]);
        }
      }
      const auto spread = [&](std::size_t axis) { return last[axis] / 2 - node.lo[axis] / 2; };
      std::size_t widest = spread(1) > spread(0) ? 1 : 0;
      widest = spread(2) > spread(widest) ? 2 : widest;
      const std::size_t half = leaves.size() / 2;
      std::ranges::nth_element(leaves, leaves.begin() + static_cast<std::ptrdiff_t>(half), {},
        [widest](const Node& leaf) { return leaf.lo[widest]; });
      this->append(leaves.first(half));
      this->append(leaves.subspan(half));
    }
    nodes_[number].behind = nodes_.size();
  }

  std::vector<Node> nodes_;
};
}
#endif
