// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/fragments.h"

#include "granular/common/error.h"
#include "granular/geometry/reproducible_sum.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/trade.h"
#include "granular/paths/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;
using Ids = std::span<const std::int64_t>;

/// Two particles in the same fragment.
using Edge = std::array<std::int64_t, 2>;

/// Joins particles to fragments, each of which is a tree whose root has the smallest id.
class Forest
{
public:
  /// Joins the fragments of two particles. Returns false if they are the same.
  bool join(const Edge& ends)
  {
    std::size_t low = this->root_of(this->place_of(ends[0]));
    std::size_t high = this->root_of(this->place_of(ends[1]));
    if (low == high)
    {
      return false;
    }
    if (ids_[low] > ids_[high])
    {
      std::swap(low, high);
    }
    parents_[high] = low;
    return true;
  }

  std::size_t size() const noexcept { return ids_.size(); }
  std::int64_t id(std::size_t place) const noexcept { return ids_[place]; }

  std::size_t root_of(std::size_t place) noexcept
  {
    while (parents_[place] != place)
    {
      parents_[place] = parents_[parents_[place]]; // shortens the way for those that follow
      place = parents_[place];
    }
    return place;
  }

private:
  std::size_t place_of(std::int64_t id)
  {
    if (table_.add(id, static_cast<std::int64_t>(ids_.size())))
    {
      parents_.push_back(ids_.size());
      ids_.push_back(id);
    }
    return static_cast<std::size_t>(table_.find(id));
  }

  IdTable table_;
  Numbers ids_;
  std::vector<std::size_t> parents_;
};

/// The fragments of all ranks that have lines, as the first rank tells them.
struct Components
{
  Numbers ids;   ///< of all particles in them
  Numbers which; ///< the number of the fragment of each
  Numbers labels;
  Numbers sizes; ///< of each fragment
};

/// Which lines of this rank count, by the ids that any rank has.
std::vector<Edge> find_edges(
  const IdDirectory& directory, Ids id1, Ids id2, Communicator& ranks, std::int64_t& missing)
{
  const Numbers ends = distinct_ids(id1, id2);
  const std::vector<ParticleHome> homes = directory.find(ends, ranks);
  IdTable known;
  for (std::size_t i = 0; i < ends.size(); ++i)
  {
    if (homes[i].rank >= 0)
    {
      known.add(ends[i], 0);
    }
  }
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < id1.size(); ++i)
  {
    if (known.find(id1[i]) == IdTable::nowhere || known.find(id2[i]) == IdTable::nowhere)
    {
      ++missing;
    }
    else if (id1[i] != id2[i])
    {
      edges.push_back({ id1[i], id2[i] });
    }
  }
  return edges;
}

/// Joins the edges of all ranks on the first one. Collective.
Forest merge_forests(const std::vector<Edge>& own, Communicator& ranks)
{
  Forest forest;
  std::vector<Edge> spanning; // those that join fragments: fewer than particles
  std::ranges::copy_if(
    own, std::back_inserter(spanning), [&](const Edge& edge) { return forest.join(edge); });
  Numbers out(static_cast<std::size_t>(ranks.size()));
  out[0] = ranks.rank() == 0 ? 0 : std::ssize(spanning);
  for (const Edge& edge : trade(spanning, out, swap_numbers(out, ranks), ranks))
  {
    forest.join(edge);
  }
  return forest;
}

Components number_components(Forest& forest)
{
  Components all;
  Numbers number(forest.size(), -1);
  for (std::size_t place = 0; place < forest.size(); ++place)
  {
    const std::size_t root = forest.root_of(place);
    if (number[root] < 0)
    {
      number[root] = static_cast<std::int64_t>(all.labels.size());
      all.labels.push_back(forest.id(root));
      all.sizes.push_back(0);
    }
    all.ids.push_back(forest.id(place));
    all.which.push_back(number[root]);
    ++all.sizes[static_cast<std::size_t>(number[root])];
  }
  return all;
}

/// Gives all ranks the numbers of the first one. Collective.
void broadcast(Numbers& numbers, Communicator& ranks)
{
  std::string bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * 8);
  ranks.broadcast(bytes, 0);
  numbers.resize(bytes.size() / 8);
  if (!bytes.empty())
  {
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
  }
}

/// A particle without lines is no part of a numbered fragment.
constexpr std::int64_t alone = -1;

bool is_usable(double mass) noexcept
{
  return std::abs(mass) < 0x1p900;
}

/// Returns the mass of the fragment of each particle of this rank. which: the numbers of the fragments, or alone. The sums of
/// eight fragments are in each cell of a SumScale. Collective.
std::vector<double> sum_masses(
  std::span<const double> masses, const Numbers& which, std::size_t fragments, Communicator& ranks)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> found(masses.begin(), masses.end());
  std::ranges::replace_if(
    found, [](double mass) { return !is_usable(mass); }, 0.0);
  const SumScale scale = make_scale(terms_of(found), 1, ranks);
  Numbers sums(scale.size() * ((fragments + SumScale::lanes - 1) / SumScale::lanes));
  Numbers broken(fragments); // masses that cannot be added
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    if (which[i] != alone)
    {
      const auto fragment = static_cast<std::size_t>(which[i]);
      broken[fragment] += is_usable(masses[i]) ? 0 : 1;
      SumScale::Terms terms = {};
      terms[fragment % SumScale::lanes] = found[i];
      const auto cell = static_cast<std::int64_t>(fragment / SumScale::lanes);
      scale.add({ &terms, 1 }, &cell, sums.data());
    }
  }
  ranks.sum(sums);
  ranks.sum(broken);
  std::vector<double> of_fragments;
  for (std::size_t at = 0; at < sums.size(); at += scale.size())
  {
    const SumScale::Terms values = scale.values(sums.data() + at);
    of_fragments.insert(of_fragments.end(), values.begin(), values.end());
  }
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    const auto fragment = static_cast<std::size_t>(which[i]);
    const bool usable = which[i] == alone ? is_usable(masses[i]) : broken[fragment] == 0;
    found[i] = !usable ? none : which[i] == alone ? masses[i] : of_fragments[fragment];
  }
  return found;
}
}

Fragments find_fragments(
  Ids ids, std::optional<std::span<const double>> masses, Ids id1, Ids id2, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      if (id1.size() != id2.size() || (masses && masses->size() != ids.size()))
      {
        throw Error("expected as many first as second ends, and as many masses as particles");
      }
      const IdDirectory directory(ids, nullptr, ranks);
      directory.expect_distinct("particles", ranks);
      Fragments found;
      const std::vector<Edge> edges = find_edges(directory, id1, id2, ranks, found.missing);
      ranks.sum({ &found.missing, 1 });
      Forest forest = merge_forests(edges, ranks);
      Components all = ranks.rank() == 0 ? number_components(forest) : Components{};
      for (Numbers* const numbers : { &all.ids, &all.which, &all.labels, &all.sizes })
      {
        broadcast(*numbers, ranks);
      }
      const IdFinder finder(all.ids);
      Numbers which(ids.size());
      finder.find(ids, which.data());
      found.labels.assign(ids.begin(), ids.end());
      found.sizes.assign(ids.size(), 1);
      for (std::size_t i = 0; i < ids.size(); ++i)
      {
        if (which[i] == IdFinder::nowhere)
        {
          which[i] = alone;
          continue;
        }
        which[i] = all.which[static_cast<std::size_t>(which[i])];
        found.labels[i] = all.labels[static_cast<std::size_t>(which[i])];
        found.sizes[i] = all.sizes[static_cast<std::size_t>(which[i])];
      }
      if (masses)
      {
        found.masses = sum_masses(*masses, which, all.labels.size(), ranks);
      }
      return found;
    });
}
}
