// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_subdomain_tree_h
#define granular_decomposition_subdomain_tree_h

#include "granular/decomposition/subdomains.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// A tree of bounding boxes. A node has two halves, or is a leaf with a few entries. A search skips each node whose
/// bounds miss the target. Each subdomain is in exactly one leaf, so memory is bounded for any sizes. Building takes
/// time proportional to n log n. Halves overlap little where planes divide the subdomains, as after recursive
/// bisection.
class SubdomainTree
{
public:
  struct Entry
  {
    Vector3 lo;
    Vector3 hi;
    std::int64_t number; ///< of the subdomain
  };

  struct Node
  {
    Vector3 lo; ///< bounds of all entries below the node
    Vector3 hi;
    std::uint32_t halves; ///< the first of two; 0: a leaf
    std::uint32_t first;  ///< entry of a leaf
    std::uint32_t last;   ///< behind its entries
    std::uint32_t axis;   ///< along which the halves mostly differ
  };

  /// Builds the tree; each entry has lo <= hi. drop_equal: of equal entries in a leaf (empty subdomains may be equal)
  /// keep only the last.
  SubdomainTree(std::vector<Entry> entries, bool drop_equal);

  const Node& root() const noexcept { return nodes_.front(); }

  /// Returns the two halves of a node, or none for a leaf.
  std::span<const Node> halves(const Node& node) const noexcept
  {
    return { nodes_.data() + node.halves, node.halves > 0 ? 2U : 0U };
  }

  std::span<const Entry> entries(const Node& node) const noexcept
  {
    return { entries_.data() + node.first, entries_.data() + node.last };
  }

private:
  void build(std::size_t node, std::size_t first, std::size_t last, bool drop_equal);

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
};
}
#endif
