// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/subdomain_tree.h"

#include <algorithm>
#include <span>

namespace granular
{
namespace
{
using Node = SubdomainTree::Node;

/// Appends the node of these leaves and all below it. Leaves are divided along the axis along which their lower faces are
/// spread most.
void append(std::span<Node> leaves, std::vector<Node>& nodes)
{
  const std::size_t number = nodes.size();
  nodes.push_back(leaves.front());
  if (leaves.size() > 1)
  {
    Node& node = nodes.back();
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
    append(leaves.first(half), nodes);
    append(leaves.subspan(half), nodes);
  }
  nodes[number].behind = nodes.size();
}
}

SubdomainTree::SubdomainTree(std::vector<Node> leaves)
{
  if (!leaves.empty())
  {
    append(leaves, nodes_);
  }
}
}
