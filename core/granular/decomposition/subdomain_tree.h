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
/// A tree of bounds: a node has two halves, or is a leaf of a few entries. A search leaves out each node whose bounds
/// do not meet what it looks for. Each subdomain is in one leaf, so that memory is bounded whatever the sizes are. Building
/// takes n log n. Halves share little room where planes divide the subdomains, as after recursive bisection.
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

  /// Each entry has lo <= hi. drop_equal: of equal entries in a leaf (empty subdomains may be equal) only the last one is
  /// kept.
  SubdomainTree(std::vector<Entry> entries, bool drop_equal);

  const Node& root() const noexcept { return nodes_.front(); }

  /// Two, or none.
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
