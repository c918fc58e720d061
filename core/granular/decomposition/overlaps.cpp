// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/overlaps.h"

#include "granular/decomposition/subdomain_tree.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace granular
{
namespace
{
using Entry = SubdomainTree::Entry;
using Node = SubdomainTree::Node;

/// Whether two boxes, or one and itself, overlap by more than `allowed`.
bool overlap(const auto& a, const auto& b, const Vector3& allowed)
{
  const auto along = [&](std::size_t axis)
  {
    return !(allowed[axis] >= 0) ||
      (a.lo[axis] < b.hi[axis] - allowed[axis] && b.lo[axis] < a.hi[axis] - allowed[axis]);
  };
  return along(0) && along(1) && along(2);
}

/// Goes down the tree in pairs of nodes that overlap.
class Search
{
public:
  Search(std::vector<Entry> entries, const Vector3& allowed, std::int64_t most, Progress& progress)
    : size_(static_cast<double>(entries.size()))
    , tree_(std::move(entries), false)
    , allowed_(allowed)
    , most_(most)
    , progress_(progress)
  {
  }

  Overlaps run()
  {
    this->search(tree_.root());
    return found_;
  }

private:
  /// Pairs in the node.
  void search(const Node& node)
  {
    auto others = tree_.entries(node);
    while (!others.empty() && !found_.more)
    {
      const Entry& entry = others.front();
      others = others.subspan(1);
      this->compare(entry, others);
    }
    done_ += tree_.entries(node).size();
    if (const auto halves = tree_.halves(node); !halves.empty() && !found_.more)
    {
      this->search(halves[0]);
      this->search(halves[1]);
      this->search(halves[0], halves[1]);
    }
  }

  /// Pairs of one in each node.
  void search(const Node& a, const Node& b)
  {
    constexpr std::size_t report_interval = 8192;
    if (found_.more || !overlap(a, b, allowed_))
    {
      return;
    }
    if (++searched_ % report_interval == 0)
    {
      progress_.step(static_cast<double>(done_) / size_);
    }
    const bool divide_a = !tree_.halves(a).empty();
    for (const Node& half : tree_.halves(divide_a ? a : b))
    {
      this->search(divide_a ? b : a, half);
    }
    for (const Entry& entry : tree_.entries(a))
    {
      this->compare(entry, tree_.entries(b));
    }
  }

  void compare(const Entry& entry, std::span<const Entry> others)
  {
    for (const Entry& other : others)
    {
      if (found_.more || !overlap(entry, other, allowed_))
      {
        continue;
      }
      found_.more = found_.pairs == most_;
      if (!found_.more)
      {
        const std::pair<std::int64_t, std::int64_t> pair = std::minmax(entry.number, other.number);
        found_.first = found_.pairs == 0 ? pair : std::min(found_.first, pair);
        ++found_.pairs;
      }
    }
  }

  double size_;
  SubdomainTree tree_;
  Vector3 allowed_;
  std::int64_t most_;
  Progress& progress_;
  Overlaps found_;
  std::size_t done_ = 0;     ///< entries, compared with those near them
  std::size_t searched_ = 0; ///< pairs of nodes
};
}

Overlaps find_overlaps(std::span<const Subdomain> subdomains, const Vector3& allowed,
  std::int64_t most, Progress& progress)
{
  if (subdomains.size() > std::numeric_limits<std::uint32_t>::max())
  {
    throw LimitError(
      "expected less than 2^32 subdomains, got " + std::to_string(subdomains.size()));
  }
  std::vector<Entry> thick; // enough to overlap at all
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    if (overlap(subdomains[i], subdomains[i], allowed))
    {
      thick.push_back({ subdomains[i].lo, subdomains[i].hi, static_cast<std::int64_t>(i) });
    }
  }
  progress.step(0);
  return Search(std::move(thick), allowed, most, progress).run();
}
}
