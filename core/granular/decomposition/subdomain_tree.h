// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_subdomain_tree_h
#define granular_decomposition_subdomain_tree_h

#include "granular/geometry/box.h"

#include <cstddef>
#include <cstdint>
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
  explicit SubdomainTree(std::vector<Node> leaves);

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
  std::vector<Node> nodes_;
};
}
#endif
