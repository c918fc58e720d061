// SPDX-License-Identifier: BSD-3-Clause
// Made lines and particles of two frames, spread over ranks, and what a plain search finds in all of them.
#ifndef granular_tests_paths_compare_checks_h
#define granular_tests_paths_compare_checks_h

#include "granular/paths/compare_particles.h"
#include "granular/paths/fragments.h"

#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace compare_checks
{
using granular::Change;
using granular::Communicator;
using Id = std::int64_t;
using Ids = std::vector<Id>;
constexpr Id lowest = std::numeric_limits<Id>::min();
constexpr Id highest = std::numeric_limits<Id>::max();

/// The rank of one of many things.
using Place = std::function<int(std::size_t i, int ranks)>;

inline std::vector<Place> all_places()
{
  return { [](std::size_t i, int ranks)
    { return static_cast<int>(i * 7919 / 3 % static_cast<std::size_t>(ranks)); },
    [](std::size_t, int) { return 0; }, [](std::size_t, int ranks) { return ranks - 1; },
    [](std::size_t i, int ranks) { return static_cast<int>(i / 7) % ranks; } };
}

/// The things of a rank, as their numbers.
inline std::vector<std::size_t> part_of(std::size_t count, const Place& place, int rank, int ranks)
{
  std::vector<std::size_t> part;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (place(i, ranks) == rank)
    {
      part.push_back(i);
    }
  }
  return part;
}

template <class Thing>
std::vector<Thing> pick(const std::vector<Thing>& all, const std::vector<std::size_t>& part)
{
  std::vector<Thing> picked;
  for (const std::size_t i : part)
  {
    picked.push_back(all[i]);
  }
  return picked;
}

// ---- lines -------------------------------------------------------------------------------------

struct Line
{
  Id id1;
  Id id2;
};

using Key = std::array<Id, 2>;

inline Key key_of(const Line& line)
{
  return { std::min(line.id1, line.id2), std::max(line.id1, line.id2) };
}

/// Between few particles, so that many lines repeat in one order or the other.
inline std::vector<Line> make_lines(std::size_t count, const Ids& ids, std::mt19937_64& random)
{
  std::vector<Line> lines;
  for (std::size_t i = 0; i < count; ++i)
  {
    lines.push_back({ ids[random() % ids.size()], ids[random() % ids.size()] });
  }
  return lines;
}

/// How often each key occurs.
inline std::map<Key, int> count_keys(const std::vector<Line>& lines)
{
  std::map<Key, int> counts;
  for (const Line& line : lines)
  {
    ++counts[key_of(line)];
  }
  return counts;
}

/// The changes of the lines of a frame, in the order of ranks and their rows: the first occurrences, as many as the other
/// frame has, are kept.
inline std::vector<Change> expected_changes(const std::vector<Line>& lines, const Place& place,
  int ranks, std::map<Key, int> others, Change alone)
{
  std::vector<Change> changes(lines.size());
  for (int rank = 0; rank < ranks; ++rank)
  {
    for (const std::size_t i : part_of(lines.size(), place, rank, ranks))
    {
      changes[i] = others[key_of(lines[i])]-- > 0 ? Change::Kept : alone;
    }
  }
  return changes;
}

/// The columns of the lines of a rank.
struct Columns
{
  explicit Columns(const std::vector<Line>& lines)
  {
    for (const Line& line : lines)
    {
      id1.push_back(line.id1);
      id2.push_back(line.id2);
    }
  }

  granular::LineEnds ends() const { return { id1, id2 }; }

  Ids id1, id2;
};

inline void check_two(Communicator& ranks, const std::vector<Line>& current, const Place& here,
  const std::vector<Line>& reference, const Place& there)
{
  const int size = ranks.size();
  const auto own = part_of(current.size(), here, ranks.rank(), size);
  const auto old = part_of(reference.size(), there, ranks.rank(), size);
  const Columns now(pick(current, own));
  const Columns before(pick(reference, old));
  const granular::LineChanges found = compare_lines(now.ends(), before.ends(), ranks);
  EXPECT_EQ(found.current,
    pick(expected_changes(current, here, size, count_keys(reference), Change::New), own));
  EXPECT_EQ(found.reference,
    pick(expected_changes(reference, there, size, count_keys(current), Change::Lost), old));
}

inline void check_lines(Communicator& ranks)
{
  const std::vector<Ids> pools = { { 1, 2, 3, 4, 5 }, { lowest, -1, 0, 7, highest },
    { 0, Id{ 1 } << 32, Id{ 1 } << 53, (Id{ 1 } << 53) + 1, -(Id{ 1 } << 62) } };
  std::mt19937_64 random(3);
  for (const Ids& pool : pools)
  {
    const auto lines = make_lines(200, pool, random);
    const auto others = make_lines(150, pool, random);
    for (const Place& place : all_places())
    {
      check_two(ranks, lines, place, others, all_places()[0]);
      check_two(ranks, lines, all_places()[3], others, place);
      check_two(ranks, lines, place, {}, place);
      check_two(ranks, {}, place, others, place);
    }
  }
  check_two(ranks, {}, all_places()[0], {}, all_places()[0]);
}

// ---- fragments ---------------------------------------------------------------------------------

/// Particles and the lines between them.
struct Net
{
  std::string name;
  Ids ids;
  std::vector<double> masses;
  std::vector<Line> lines;
};

struct ExpectedFragment
{
  Id label;
  Id size;
  double mass;
};

__extension__ using Wide = __int128;

/// Masses are multiples of this, with at most 24 bits.
constexpr int mass_unit = -60;

/// The sum of masses, rounded once by the conversion of an integer.
inline double exact_sum(const std::vector<double>& masses)
{
  Wide sum = 0;
  for (const double mass : masses)
  {
    sum += static_cast<Wide>(std::ldexp(mass, -mass_unit));
  }
  return std::ldexp(static_cast<double>(sum), mass_unit);
}

/// By a search from particle to particle.
inline std::map<Id, ExpectedFragment> expected_fragments(const Net& net)
{
  std::map<Id, double> mass_of;
  for (std::size_t i = 0; i < net.ids.size(); ++i)
  {
    mass_of[net.ids[i]] = net.masses[i];
  }
  std::map<Id, Ids> partners;
  for (const Line& line : net.lines)
  {
    if (mass_of.contains(line.id1) && mass_of.contains(line.id2))
    {
      partners[line.id1].push_back(line.id2);
      partners[line.id2].push_back(line.id1);
    }
  }
  std::map<Id, ExpectedFragment> fragments;
  for (const auto& [start, own] : mass_of) // from the lowest id on
  {
    if (fragments.contains(start))
    {
      continue;
    }
    Ids members = { start };
    std::set<Id> seen = { start };
    for (std::size_t i = 0; i < members.size(); ++i)
    {
      for (const Id partner : partners[members[i]])
      {
        if (seen.insert(partner).second)
        {
          members.push_back(partner);
        }
      }
    }
    std::vector<double> masses;
    for (const Id member : members)
    {
      masses.push_back(mass_of[member]);
    }
    const double mass = exact_sum(masses);
    for (const Id member : members)
    {
      fragments[member] = { start, std::ssize(members), mass };
    }
  }
  return fragments;
}

/// Between 2^-60 and 2^40.
inline double random_mass(std::mt19937_64& random)
{
  const int exponent = static_cast<int>(random() % 77) + mass_unit;
  return std::ldexp(static_cast<double>(random() % (1 << 24)), exponent);
}

inline Net make_net(std::string name, Ids ids, std::vector<Line> lines, std::mt19937_64& random)
{
  Net net{ std::move(name), std::move(ids), {}, std::move(lines) };
  std::ranges::shuffle(net.ids, random);
  std::ranges::shuffle(net.lines, random);
  for (std::size_t i = 0; i < net.ids.size(); ++i)
  {
    net.masses.push_back(random_mass(random));
  }
  return net;
}

inline std::vector<Net> make_nets()
{
  std::mt19937_64 random(11);
  std::vector<Net> nets;
  nets.push_back(make_net("no particles", {}, { { 1, 2 } }, random));
  nets.push_back(make_net("no lines", { 5, -3, lowest, highest }, {}, random));
  for (const std::size_t lines : { 30U, 80U, 150U })
  {
    Ids ids(200);
    std::iota(ids.begin(), ids.end(), -70);
    auto some = make_lines(lines, ids, random);
    some.push_back({ 1, 1'000'000 }); // which nobody has
    some.push_back({ 3, 3 });
    nets.push_back(make_net("random lines " + std::to_string(lines), ids, some, random));
  }
  Ids anywhere;
  for (int i = 0; i < 300; ++i)
  {
    anywhere.push_back(static_cast<Id>((random() << 9) + static_cast<std::uint64_t>(i)));
  }
  anywhere.insert(anywhere.end(), { lowest, highest });
  const auto far_lines = make_lines(200, anywhere, random);
  nets.push_back(make_net("ids anywhere", anywhere, far_lines, random));
  return nets;
}

/// A chain of particles in random order, which is in one piece at the end only.
inline Net make_chain(Id bonds)
{
  std::mt19937_64 random(12);
  Ids ids(static_cast<std::size_t>(bonds) + 1);
  std::iota(ids.begin(), ids.end(), Id{ -17 });
  std::ranges::shuffle(ids, random);
  std::vector<Line> lines;
  for (std::size_t i = 0; i + 1 < ids.size(); ++i)
  {
    lines.push_back({ ids[i], ids[i + 1] });
  }
  return make_net("chain", ids, lines, random);
}

/// Returns how many masses are not the exact ones.
inline std::int64_t check_net(Communicator& ranks, const Net& net,
  const std::map<Id, ExpectedFragment>& expected, const Place& particles, const Place& lines)
{
  SCOPED_TRACE(net.name);
  const auto own = part_of(net.ids.size(), particles, ranks.rank(), ranks.size());
  const Ids ids = pick(net.ids, own);
  const std::vector<double> masses = pick(net.masses, own);
  const Columns ends(pick(net.lines, part_of(net.lines.size(), lines, ranks.rank(), ranks.size())));
  const granular::Fragments found = find_fragments(ids, masses, ends.id1, ends.id2, ranks);
  const auto missing = std::ranges::count_if(net.lines,
    [&](const Line& line) { return !expected.contains(line.id1) || !expected.contains(line.id2); });
  EXPECT_EQ(found.missing, missing);
  EXPECT_EQ(found.labels.size(), ids.size());
  EXPECT_EQ(found.masses.size(), ids.size());
  std::int64_t wrong = 0;
  std::int64_t others = 0;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const ExpectedFragment& fragment = expected.at(ids[i]);
    others += found.labels[i] != fragment.label || found.sizes[i] != fragment.size ? 1 : 0;
    wrong += found.masses[i] != fragment.mass ? 1 : 0;
  }
  EXPECT_EQ(others, 0);
  const granular::Fragments without = find_fragments(ids, {}, ends.id1, ends.id2, ranks);
  EXPECT_EQ(without.labels, found.labels);
  EXPECT_TRUE(without.masses.empty());
  return wrong;
}

inline void check_fragments(Communicator& ranks)
{
  for (const Net& net : make_nets())
  {
    const auto expected = expected_fragments(net);
    for (const Place& place : all_places())
    {
      EXPECT_EQ(check_net(ranks, net, expected, place, all_places()[0]), 0);
      EXPECT_EQ(check_net(ranks, net, expected, all_places()[3], place), 0);
    }
  }
}
}
#endif
