// SPDX-License-Identifier: BSD-3-Clause
// Made particles and lines between them, and what joining them gives, found with a std::map.
#ifndef granular_tests_local_join_checks_h
#define granular_tests_local_join_checks_h

#include "granular/lines/join.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace join_checks
{
using Id = std::int64_t;

/// Multiples of 1/1024 below 2^20: sums and halves of them are exact in double.
inline double exact_number(std::mt19937_64& random)
{
  return static_cast<double>(static_cast<std::int64_t>(random() % 2'000'000'001) - 1'000'000'000) /
    1024;
}

struct Particle
{
  Id id;
  double x[3];
  double v[3];
  float radius;
  std::int32_t type;
  unsigned char ghost;
};

struct Line
{
  Id id1;
  Id id2;
};

/// Particles as the arrays of one process.
struct Arrays
{
  explicit Arrays(const std::vector<Particle>& particles)
  {
    for (const Particle& one : particles)
    {
      ids.push_back(one.id);
      points.insert(points.end(), one.x, one.x + 3);
      velocities.insert(velocities.end(), one.v, one.v + 3);
      radii.push_back(one.radius);
      types.push_back(one.type);
      ghosts.push_back(one.ghost);
    }
  }

  granular::FrameView view() const
  {
    using granular::ValueType;
    granular::FrameView frame;
    frame.has_box = false;
    if (ids.empty())
    {
      return frame; // a process without particles may know of no arrays
    }
    frame.rows = static_cast<std::int64_t>(ids.size());
    frame.points = granular::view_rows("points", ValueType::Float64, points.data(), 3);
    frame.arrays = { granular::view_rows("id", ValueType::Int64, ids.data()),
      granular::view_rows("v", ValueType::Float64, velocities.data(), 3),
      granular::view_rows("radius", ValueType::Float32, radii.data()),
      granular::view_rows("type", ValueType::Int32, types.data()) };
    frame.ghosts = ghosts.data();
    return frame;
  }

  std::vector<Id> ids;
  std::vector<double> points;
  std::vector<double> velocities;
  std::vector<float> radii;
  std::vector<std::int32_t> types;
  std::vector<unsigned char> ghosts;
};

inline Particle make_particle(Id id, std::mt19937_64& random)
{
  const auto next = [&] { return exact_number(random); };
  return { id, { next(), next(), next() }, { next(), next(), next() },
    static_cast<float>(random() % 4096) / 64, static_cast<std::int32_t>(random() % 7), 0 };
}

/// Ways to give particles ids, all different.
struct IdKind
{
  std::string name;
  std::function<Id(Id i, std::mt19937_64& random)> make;
};

inline std::vector<IdKind> id_kinds()
{
  constexpr Id lowest = std::numeric_limits<Id>::min();
  constexpr Id highest = std::numeric_limits<Id>::max();
  return {
    { "from 1", [](Id i, auto&) { return i + 1; } },
    { "around 0", [](Id i, auto&) { return i - 50; } },
    { "every seventh", [](Id i, auto&) { return 7 * i; } },
    { "from 2^53", [](Id i, auto&) { return (Id{ 1 } << 53) + i; } },
    { "steps of 2^32", [](Id i, auto&) { return i * (Id{ 1 } << 32); } },
    { "both ends", [](Id i, auto&) { return i % 2 == 0 ? lowest + i : highest - i; } },
    { "anywhere",
      [](Id i, auto& random)
      { return static_cast<Id>((random() << 12) + static_cast<std::uint64_t>(i)); } },
  };
}

inline std::vector<Particle> make_particles(const IdKind& kind, Id count, std::mt19937_64& random)
{
  std::vector<Particle> particles;
  for (Id i = 0; i < count; ++i)
  {
    particles.push_back(make_particle(kind.make(i, random), random));
  }
  std::ranges::shuffle(particles, random);
  return particles;
}

/// Between any two particles; one end in twenty is an id that may belong to nobody.
inline std::vector<Line> make_lines(
  const std::vector<Particle>& particles, Id count, std::mt19937_64& random)
{
  const auto end = [&]
  {
    const bool stray = particles.empty() || random() % 20 == 0;
    return stray ? static_cast<Id>(random() % 2000) - 1000
                 : particles[random() % particles.size()].id;
  };
  std::vector<Line> lines;
  for (Id i = 0; i < count; ++i)
  {
    const Id first = end();
    lines.push_back({ first, end() });
  }
  return lines;
}

/// What everybody has, by id; of the same ids the first counts, ghosts do not.
using Known = std::map<Id, Particle>;

struct Expected
{
  Known known;
  std::int64_t repeated = 0;

  void add(const std::vector<Particle>& particles)
  {
    for (const Particle& one : particles)
    {
      if ((one.ghost & 1) == 0 && !known.emplace(one.id, one).second)
      {
        ++repeated;
      }
    }
  }
};

inline bool same_doubles(const granular::Block& block, const std::vector<double>& expected)
{
  return block.bytes() == expected.size() * sizeof(double) &&
    (expected.empty() || std::memcmp(block.data(), expected.data(), block.bytes()) == 0);
}

inline granular::JoinRequest request_of_all(int threads)
{
  return { { "v", "radius", "v" }, { "type", "v" }, threads, nullptr };
}

inline granular::JoinedLines join(const granular::FrameView& particles,
  const std::vector<Line>& lines, const granular::JoinRequest& request,
  granular::Communicator& ranks)
{
  std::vector<Id> id1;
  std::vector<Id> id2;
  for (const Line& line : lines)
  {
    id1.push_back(line.id1);
    id2.push_back(line.id2);
  }
  granular::Progress progress;
  return join_lines(particles, id1, id2, request, ranks, progress);
}

/// The lines of one process, of which `request_of_all` was wanted.
inline void expect_joined(
  const Known& known, const std::vector<Line>& lines, const granular::JoinedLines& joined)
{
  std::vector<std::int64_t> rows;
  std::vector<double> first;
  std::vector<double> second;
  std::vector<double> values[4]; // v_mean, radius_mean, type_difference, v_difference
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const auto a = known.find(lines[i].id1);
    const auto b = known.find(lines[i].id2);
    if (a == known.end() || b == known.end())
    {
      continue;
    }
    const Particle& p = a->second;
    const Particle& q = b->second;
    rows.push_back(static_cast<std::int64_t>(i));
    first.insert(first.end(), p.x, p.x + 3);
    second.insert(second.end(), q.x, q.x + 3);
    values[1].push_back((double{ p.radius } + double{ q.radius }) / 2);
    values[2].push_back(q.type - p.type);
    for (std::size_t k = 0; k < 3; ++k)
    {
      values[0].push_back((p.v[k] + q.v[k]) / 2);
      values[3].push_back(q.v[k] - p.v[k]);
    }
  }
  EXPECT_EQ(joined.count, static_cast<std::int64_t>(rows.size()));
  EXPECT_EQ(joined.rows, rows.size() == lines.size() ? std::vector<std::int64_t>() : rows);
  EXPECT_TRUE(same_doubles(joined.first, first));
  EXPECT_TRUE(same_doubles(joined.second, second));
  const char* const names[] = { "v_mean", "radius_mean", "type_difference", "v_difference" };
  ASSERT_EQ(joined.arrays.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(joined.arrays[i].name, names[i]);
    EXPECT_TRUE(same_doubles(joined.arrays[i].values, values[i])) << names[i];
  }
}

/// Where one of many goes: to the rank that this says.
using Place = std::function<int(std::size_t i, int ranks)>;

template <class Thing>
std::vector<Thing> part_of(const std::vector<Thing>& all, const Place& place, int rank, int ranks)
{
  std::vector<Thing> part;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (place(i, ranks) == rank)
    {
      part.push_back(all[i]);
    }
  }
  return part;
}

/// Joins lines with particles that are spread over the ranks, each in its way.
inline void check_spread(granular::Communicator& ranks, const std::vector<Particle>& particles,
  const Place& particle_place, const std::vector<Line>& lines, const Place& line_place)
{
  Expected expected;
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    expected.add(part_of(particles, particle_place, rank, ranks.size()));
  }
  std::int64_t missing = 0;
  for (const Line& line : lines)
  {
    missing += expected.known.count(line.id1) == 0 || expected.known.count(line.id2) == 0 ? 1 : 0;
  }
  const Arrays arrays(part_of(particles, particle_place, ranks.rank(), ranks.size()));
  const auto own = part_of(lines, line_place, ranks.rank(), ranks.size());
  for (const int threads : { 1, 3 })
  {
    const granular::JoinedLines joined = join(arrays.view(), own, request_of_all(threads), ranks);
    EXPECT_EQ(joined.missing, missing);
    EXPECT_EQ(joined.repeated, expected.repeated);
    if (particles.empty())
    {
      EXPECT_EQ(joined.count, 0); // nobody knows the arrays
      EXPECT_EQ(joined.arrays.size(), 4U);
      continue;
    }
    EXPECT_EQ(joined.arrays[0].size, 3);
    EXPECT_EQ(joined.arrays[1].size, 1);
    expect_joined(expected.known, own, joined);
  }
}

inline int dealt(std::size_t i, int ranks)
{
  return static_cast<int>(i * 7919 / 3 % static_cast<std::size_t>(ranks));
}

inline int first_rank(std::size_t, int)
{
  return 0;
}

inline int last_rank(std::size_t, int ranks)
{
  return ranks - 1;
}

/// All kinds of ids, and particles and lines in all places.
inline void check_joins(granular::Communicator& ranks)
{
  for (const IdKind& kind : id_kinds())
  {
    SCOPED_TRACE(kind.name);
    std::mt19937_64 random(5);
    const auto particles = make_particles(kind, 500, random);
    const auto lines = make_lines(particles, 3000, random);
    check_spread(ranks, particles, dealt, lines, dealt);
    check_spread(ranks, particles, last_rank, lines, first_rank);
    check_spread(ranks, particles, first_rank, lines, dealt);
    check_spread(ranks, particles, dealt, {}, dealt);
  }
  std::mt19937_64 random(6);
  check_spread(ranks, {}, dealt, make_lines({}, 100, random), dealt);
  check_spread(ranks, {}, dealt, {}, dealt);
}

/// Copies of particles of other processes, told as such, count neither as particles nor as repeated; some are of
/// particles that nobody has.
inline void check_ghosts(granular::Communicator& ranks)
{
  std::mt19937_64 random(7);
  auto particles = make_particles(id_kinds()[0], 400, random);
  for (std::size_t i = 0; i < 400; i += 3)
  {
    Particle copy = make_particle(particles[i].id, random);
    copy.ghost = 1;
    particles.insert(particles.begin() + static_cast<std::ptrdiff_t>(i / 2), copy);
  }
  for (std::size_t i = 0; i < particles.size(); i += 11)
  {
    particles[i].ghost |= 1;                          // now some are ghosts only
    particles[(i + 5) % particles.size()].ghost |= 2; // means something else
  }
  const auto lines = make_lines(particles, 2000, random);
  check_spread(ranks, particles, dealt, lines, dealt);
  check_spread(ranks, particles, last_rank, lines, first_rank);
}

/// Of the same ids the first of the lowest rank.
inline void check_repeated(granular::Communicator& ranks)
{
  for (const IdKind& kind : { id_kinds()[0], id_kinds()[6] })
  {
    std::mt19937_64 random(8);
    auto particles = make_particles(kind, 300, random);
    for (std::size_t i = 0; i < 200; ++i)
    {
      particles.push_back(make_particle(particles[i / 2].id, random));
    }
    std::ranges::shuffle(particles, random);
    const auto lines = make_lines(particles, 2000, random);
    check_spread(ranks, particles, dealt, lines, dealt);
    check_spread(ranks, particles, first_rank, lines, last_rank);
  }
}

/// One particle that all others touch.
inline void check_hub(granular::Communicator& ranks)
{
  std::mt19937_64 random(9);
  const auto particles = make_particles(id_kinds()[6], 1000, random);
  std::vector<Line> lines;
  for (int i = 0; i < 100'000; ++i)
  {
    lines.push_back({ particles[3].id, particles[random() % 1000].id });
  }
  check_spread(ranks, particles, dealt, lines, dealt);
}
}
#endif
