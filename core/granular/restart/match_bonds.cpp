// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/match_bonds.h"

#include "granular/local/id_finder.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace granular
{
namespace
{
/// What copies of a history value may differ by, in parts of it: programs compute both where a bond crosses a periodic face.
constexpr double rounding = 1e-6;

/// Whether numbers are the same but for their signs and for rounding.
bool same_values(const double* a, const double* b, std::size_t count) noexcept
{
  const auto same = [](double one, double other)
  {
    const double size = std::max(std::abs(one), std::abs(other));
    return std::abs(std::abs(one) - std::abs(other)) <= rounding * size ||
      std::abs(one) == std::abs(other) || (std::isnan(one) && std::isnan(other));
  };
  return std::equal(a, a + count, b, same);
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
      sum += of_block;
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

  std::int64_t match(const Executor& executor, Progress& progress)
  {
    std::vector<std::int64_t> differing(blocks_.size());
    std::vector<Scratch> scratch(executor.workers(blocks_.size()));
    executor.parallel_for(
      blocks_.size(),
      [&](std::size_t block, std::size_t worker)
      { differing[block] = this->match_block(block, scratch[worker]); },
      progress);
    std::int64_t sum = 0;
    for (const std::int64_t of_block : differing)
    {
      sum += of_block;
    }
    return sum;
  }

private:
  struct Scratch
  {
    std::vector<Copy> lower;
    std::vector<Copy> left[2]; ///< of a pair of particles, without one of the same type
  };

  static std::size_t index(std::int64_t row) noexcept { return static_cast<std::size_t>(row); }

  BondCounts find_partners(BondCopies& copies, const IdFinder& finder, bool once) const
  {
    BondCounts counts;
    finder.find(copies.partners, copies.partners.data());
    copies.states.resize(copies.size());
    for (std::size_t row = 0; row < copies.rows(); ++row)
    {
      const std::int64_t id = ids_[index(copies.first_row) + row];
      for (auto i = index(copies.begins[row]); i < index(copies.begins[row + 1]); ++i)
      {
        const std::int64_t partner = copies.partners[i];
        const bool there = partner != IdFinder::nowhere;
        const std::int64_t other = there ? ids_[index(partner)] : id;
        counts.without_partner += there ? 0 : 1;
        counts.of_itself += there && other == id ? 1 : 0;
        copies.states[i] = !there ? BondCopies::Left
          : !once && other < id   ? BondCopies::Higher
                                  : BondCopies::Kept;
      }
    }
    return counts;
  }

  template <class Visit>
  void for_higher(const Visit& visit) const
  {
    for (std::size_t block = 0; block < blocks_.size(); ++block)
    {
      const BondCopies& copies = blocks_[block];
      for (std::size_t row = 0; row < copies.rows(); ++row)
      {
        for (auto i = index(copies.begins[row]); i < index(copies.begins[row + 1]); ++i)
        {
          if (copies.states[i] == BondCopies::Higher)
          {
            visit(copies.partners[i],
              Copy{ copies.first_row + static_cast<std::int64_t>(row), copies.types[i],
                static_cast<std::uint32_t>(block), i });
          }
        }
      }
    }
  }

  std::int64_t match_block(std::size_t block, Scratch& scratch)
  {
    const BondCopies& copies = blocks_[block];
    std::int64_t differing = 0;
    for (std::size_t row = 0; row < copies.rows(); ++row)
    {
      const std::size_t of_all = index(copies.first_row) + row;
      const std::size_t first = of_all == 0 ? 0 : begins_[of_all - 1];
      const auto higher = std::span(higher_).subspan(first, begins_[of_all] - first);
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
      differing += this->match_row(scratch, higher);
    }
    return differing;
  }

  /// The end of the copies between the same particles, from a place on.
  static std::size_t end_of_pair(std::span<const Copy> copies, std::size_t begin) noexcept
  {
    std::size_t end = begin + 1;
    while (end < copies.size() && copies[end].other == copies[begin].other)
    {
      ++end;
    }
    return end;
  }

  std::int64_t match_row(Scratch& scratch, std::span<const Copy> higher)
  {
    const std::span<const Copy> lower = scratch.lower;
    std::int64_t differing = 0;
    for (std::size_t i = 0, j = 0; i < lower.size() && j < higher.size();)
    {
      if (lower[i].other != higher[j].other)
      {
        (lower[i].other < higher[j].other ? i : j) += 1;
        continue;
      }
      const std::size_t i_end = end_of_pair(lower, i);
      const std::size_t j_end = end_of_pair(higher, j);
      differing +=
        this->match_pair(scratch, lower.subspan(i, i_end - i), higher.subspan(j, j_end - j));
      i = i_end;
      j = j_end;
    }
    return differing;
  }

  /// Of two particles.
  std::int64_t match_pair(
    Scratch& scratch, std::span<const Copy> lower, std::span<const Copy> higher)
  {
    if (lower.size() == 1 && higher.size() == 1)
    {
      return this->take(lower[0], higher[0]);
    }
    scratch.left[0].clear();
    scratch.left[1].clear();
    std::int64_t differing = 0;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < lower.size() || j < higher.size())
    {
      const bool both = i < lower.size() && j < higher.size();
      if (both && lower[i].type == higher[j].type)
      {
        differing += this->take(lower[i++], higher[j++]);
      }
      else if (j == higher.size() || (both && lower[i].type < higher[j].type))
      {
        scratch.left[0].push_back(lower[i++]);
      }
      else
      {
        scratch.left[1].push_back(higher[j++]);
      }
    }
    const std::size_t pairs = std::min(scratch.left[0].size(), scratch.left[1].size());
    for (std::size_t pair = 0; pair < pairs; ++pair)
    {
      differing += this->take(scratch.left[0][pair], scratch.left[1][pair]);
    }
    return differing;
  }

  /// Two copies of one bond. Returns whether they differ.
  std::int64_t take(const Copy& lower, const Copy& higher)
  {
    BondCopies& left = blocks_[higher.block];
    left.states[higher.place] = BondCopies::Left;
    return same_values(blocks_[lower.block].history.get() + lower.place * history_values_,
             left.history.get() + higher.place * history_values_, history_values_)
      ? 0
      : 1;
  }

  std::vector<BondCopies>& blocks_;
  std::span<const std::int64_t> ids_;
  std::size_t history_values_;
  std::vector<std::size_t> begins_; ///< in higher_, of each row
  std::vector<Copy> higher_;
};
}

BondCounts& BondCounts::operator+=(const BondCounts& other) noexcept
{
  without_partner += other.without_partner;
  of_itself += other.of_itself;
  differing += other.differing;
  repeated_ids += other.repeated_ids;
  return *this;
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
    part.set_part(0.5, 1);
    counts.differing = matcher.match(executor, part);
  }
  return counts;
}
}
