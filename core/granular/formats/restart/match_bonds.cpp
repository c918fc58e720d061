// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/match_bonds.h"

#include "granular/lines/id_finder.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace granular
{
namespace
{
/// Difference that copies of a history value may have, in parts of it: programs compute both where a bond crosses a periodic face or one
/// between processes.
constexpr double rounding = 1e-6;

/// The kind of a history value: numbers of which the sizes can be compared.
std::size_t kind_of(std::size_t value, std::size_t count) noexcept
{
  constexpr std::size_t forces = 6;
  constexpr std::size_t known = 12; // with the torques
  return count < known || value >= known ? value : value / forces;
}

/// Two copies of a bond that are not the same by themselves: numbers near zero may have been rounded to others.
struct Doubtful
{
  const double* lower;
  const double* higher;
};

/// Returns true if the values are the same but for their signs, and for rounding of numbers of the largest size of each kind or,
/// if these are not known, of their own sizes.
bool same_values(
  const Doubtful& copies, std::size_t count, std::span<const double> largest) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const double one = std::abs(copies.lower[i]);
    const double other = std::abs(copies.higher[i]);
    const double size = largest.empty() ? std::max(one, other) : largest[kind_of(i, count)];
    const double difference = std::abs(one - other);
    const bool near = std::isfinite(difference) && difference <= rounding * size;
    if (!near && one != other && !(std::isnan(one) && std::isnan(other)))
    {
      return false;
    }
  }
  return true;
}

/// A copy of a bond, seen from the particle with the lower id.
struct Copy
{
  std::int64_t other; ///< the row of the particle with the higher one
  std::int32_t type;
  std::uint32_t block;
  std::size_t place; ///< in its block

  /// Copies of bonds between the same particles together, those of a type together there.
  friend bool operator<(const Copy& a, const Copy& b) noexcept
  {
    return std::tie(a.other, a.type, a.block, a.place) <
      std::tie(b.other, b.type, b.block, b.place);
  }
};

class Matcher
{
public:
  Matcher(
    std::vector<BondCopies>& blocks, std::span<const std::int64_t> ids, std::size_t history_values)
    : blocks_(blocks)
    , ids_(ids)
    , history_values_(history_values)
  {
  }

  BondCounts find_partners(bool once, const Executor& executor, Progress& progress)
  {
    const IdFinder finder(ids_);
    std::vector<BondCounts> counts(blocks_.size());
    executor.parallel_for(
      blocks_.size(),
      [&](std::size_t block, std::size_t)
      { counts[block] = this->find_partners(blocks_[block], finder, once); },
      progress);
    BondCounts sum;
    sum.repeated_ids = finder.repeated();
    for (const BondCounts& of_block : counts)
    {
      sum.without_partner += of_block.without_partner;
      sum.of_itself += of_block.of_itself;
    }
    return sum;
  }

  /// Sorts the copies held by the particle with the higher id to the other one.
  void sort_higher()
  {
    begins_.assign(ids_.size() + 1, 0);
    this->for_higher([&](std::int64_t lower, const Copy&) { ++begins_[index(lower) + 1]; });
    for (std::size_t row = 0; row < ids_.size(); ++row)
    {
      begins_[row + 1] += begins_[row];
    }
    higher_.resize(begins_.back());
    this->for_higher(
      [&](std::int64_t lower, const Copy& copy) { higher_[begins_[index(lower)]++] = copy; });
    // each begin has become the end, that is the next one's begin
  }

  void match(const Executor& executor, Progress& progress)
  {
    scratch_.resize(executor.workers(blocks_.size()));
    executor.parallel_for(
      blocks_.size(),
      [&](std::size_t block, std::size_t worker) { this->match_block(block, scratch_[worker]); },
      progress);
  }

  /// Returns the number of bonds that were matched, but have copies that differ.
  std::int64_t count_differing(const Executor& executor, Progress& progress) const
  {
    const auto has = [](const Scratch& scratch) { return !scratch.doubtful.empty(); };
    if (std::ranges::none_of(scratch_, has))
    {
      return 0;
    }
    const std::vector<double> largest = this->find_largest(executor, progress);
    std::int64_t sum = 0;
    for (const Scratch& scratch : scratch_)
    {
      sum += std::ranges::count_if(scratch.doubtful,
        [&](const Doubtful& copies) { return !same_values(copies, history_values_, largest); });
    }
    return sum;
  }

private:
  struct Scratch
  {
    std::vector<Doubtful> doubtful; ///< at most one of each bond
    std::vector<Copy> lower;
  };

  static std::size_t index(std::int64_t row) noexcept { return static_cast<std::size_t>(row); }

  /// The largest size of each kind of history value in all copies.
  std::vector<double> find_largest(const Executor& executor, Progress& progress) const
  {
    using Sizes = std::vector<double>;
    std::vector<Sizes> largest(executor.workers(blocks_.size()), Sizes(history_values_));
    executor.parallel_for(
      blocks_.size(),
      [&](std::size_t block, std::size_t worker)
      {
        const double* number = blocks_[block].values();
        for (std::size_t copy = 0; copy < blocks_[block].size(); ++copy)
        {
          for (std::size_t value = 0; value < history_values_; ++value, ++number)
          {
            double& size = largest[worker][kind_of(value, history_values_)];
            size = std::isfinite(*number) ? std::max(size, std::abs(*number)) : size;
          }
        }
      },
      progress);
    for (const Sizes& sizes : largest)
    {
      std::ranges::transform(sizes, largest.front(), largest.front().begin(),
        [](double one, double other) { return std::max(one, other); });
    }
    return largest.front();
  }

  BondCounts find_partners(BondCopies& copies, const IdFinder& finder, bool once) const
  {
    BondCounts counts;
    finder.find(copies.partners, copies.partners.data());
    copies.states.resize(copies.size());
    copies.for_each(0, std::ssize(ids_),
      [&](std::int64_t row, std::size_t i)
      {
        const std::int64_t id = ids_[index(row)];
        const bool there = copies.partners[i] != IdFinder::nowhere;
        const std::int64_t other = there ? ids_[index(copies.partners[i])] : id;
        counts.without_partner += there ? 0 : 1;
        counts.of_itself += there && other == id ? 1 : 0;
        copies.states[i] = !there ? BondCopies::Left
          : !once && other < id   ? BondCopies::Higher
                                  : BondCopies::Kept;
      });
    return counts;
  }

  template <class Visit>
  void for_higher(const Visit& visit) const
  {
    for (std::size_t block = 0; block < blocks_.size(); ++block)
    {
      const BondCopies& copies = blocks_[block];
      copies.for_each(0, std::ssize(ids_),
        [&](std::int64_t row, std::size_t i)
        {
          if (copies.states[i] == BondCopies::Higher)
          {
            visit(copies.partners[i],
              Copy{ row, copies.types[i], static_cast<std::uint32_t>(block), i });
          }
        });
    }
  }

  void match_block(std::size_t block, Scratch& scratch)
  {
    const BondCopies& copies = blocks_[block];
    for (std::size_t row = 0; row < copies.rows(); ++row)
    {
      const std::size_t of_all = index(copies.first_row) + row;
      const std::size_t first = of_all == 0 ? 0 : begins_[of_all - 1];
      auto higher = std::span(higher_).subspan(first, begins_[of_all] - first);
      if (higher.empty())
      {
        continue;
      }
      scratch.lower.clear();
      for (auto i = index(copies.begins[row]); i < index(copies.begins[row + 1]); ++i)
      {
        // by the ids, not the states, which other threads are changing
        const std::int64_t partner = copies.partners[i];
        if (partner != IdFinder::nowhere && ids_[index(partner)] > ids_[of_all])
        {
          scratch.lower.push_back(
            { copies.partners[i], copies.types[i], static_cast<std::uint32_t>(block), i });
        }
      }
      std::sort(scratch.lower.begin(), scratch.lower.end());
      std::sort(higher.begin(), higher.end());
      // those of the same type go together first
      std::span<Copy> lower = scratch.lower;
      this->take_pairs(
        scratch, lower, higher, [](const Copy& copy) { return std::pair(copy.other, copy.type); });
      this->take_pairs(scratch, lower, higher, [](const Copy& copy) { return copy.other; });
    }
  }

  /// Takes two copies of the same key for one bond, as often as there are two. Both are in the order of the key; what is left is kept
  /// in its order.
  template <class Key>
  void take_pairs(Scratch& scratch, std::span<Copy>& lower, std::span<Copy>& higher, const Key& key)
  {
    std::size_t lower_left = 0;
    std::size_t higher_left = 0;
    for (std::size_t i = 0, j = 0; i < lower.size() || j < higher.size();)
    {
      const bool both = i < lower.size() && j < higher.size();
      if (both && key(lower[i]) == key(higher[j]))
      {
        this->take(scratch, lower[i++], higher[j++]);
      }
      else if (j == higher.size() || (both && key(lower[i]) < key(higher[j])))
      {
        lower[lower_left++] = lower[i++];
      }
      else
      {
        higher[higher_left++] = higher[j++];
      }
    }
    lower = lower.first(lower_left);
    higher = higher.first(higher_left);
  }

  /// Two copies of one bond.
  void take(Scratch& scratch, const Copy& lower, const Copy& higher)
  {
    BondCopies& left = blocks_[higher.block];
    left.states[higher.place] = BondCopies::Left;
    const Doubtful copies = { blocks_[lower.block].values() + lower.place * history_values_,
      left.values() + higher.place * history_values_ };
    if (!same_values(copies, history_values_, {}))
    {
      scratch.doubtful.push_back(copies);
    }
  }

  std::vector<BondCopies>& blocks_;
  std::span<const std::int64_t> ids_;
  std::size_t history_values_;
  std::vector<std::size_t> begins_; ///< in higher_, of each row
  std::vector<Copy> higher_;
  std::vector<Scratch> scratch_; ///< of each worker
};
}

BondCounts match_bonds(std::vector<BondCopies>& blocks, std::span<const std::int64_t> ids,
  bool once, std::size_t history_values, const Executor& executor, Progress& progress)
{
  PartialProgress part(progress);
  part.set_part(0, 0.5);
  Matcher matcher(blocks, ids, history_values);
  BondCounts counts = matcher.find_partners(once, executor, part);
  if (!once)
  {
    matcher.sort_higher();
    part.set_part(0.5, 0.9);
    matcher.match(executor, part);
    part.set_part(0.9, 1);
    counts.differing = matcher.count_differing(executor, part);
  }
  return counts;
}
}
