// SPDX-License-Identifier: BSD-3-Clause
// Bonds out of restart files: each once, whoever holds it.
#include "restart_runs.h"

#include "granular/lines/line_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace
{
using granular::Request;
using restart_builder::RestartBuilder;

using Bond = std::tuple<std::int64_t, std::int64_t, std::int32_t>; ///< id1 id2 btype

std::vector<Bond> bonds_of(const granular::Tables& frame)
{
  const auto first = values_of<std::int64_t>(frame.bonds, "id1");
  const auto second = values_of<std::int64_t>(frame.bonds, "id2");
  const auto types = values_of<std::int32_t>(frame.bonds, "btype");
  std::vector<Bond> bonds;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    bonds.emplace_back(first[i], second[i], types[i]);
  }
  return bonds;
}

std::vector<Bond> bonds_of(const RestartBuilder& builder)
{
  return bonds_of(read_run(builder).frame);
}

/// 12 values that tell themselves from others.
std::vector<double> history(double begin, double sign = 1, int values = 12)
{
  std::vector<double> numbers;
  for (int i = 0; i < values; ++i)
  {
    numbers.push_back(sign * (begin + i));
  }
  return numbers;
}
}

TEST(RestartBonds, OnceWhereBothHoldThem)
{
  const auto builder =
    bonded_file({ { 3, { { 1, 2, history(20, -1) } }, 0.3 },
                  { 2, { { 1, 3, history(20) }, { 2, 1, history(10, -1) } }, 0.2 },
                  { 1, { { 2, 2, history(10) } }, 0.1 } },
      12);
  const RestartRun run = read_run(builder);
  EXPECT_EQ(bonds_of(run.frame), (std::vector<Bond>{ { 2, 3, 1 }, { 1, 2, 2 } }));
  EXPECT_EQ(run.said(), "");
  EXPECT_EQ(values_of<double>(run.frame.bonds, "force_normal"),
    (std::vector<double>{ 20, 21, 22, 10, 11, 12 }));
  EXPECT_EQ(values_of<double>(run.frame.bonds, "torque_tangential"),
    (std::vector<double>{ 29, 30, 31, 19, 20, 21 }));
  EXPECT_EQ(line_points_of(run.frame.bonds),
    (std::vector<double>{ 0.2, 0.5, 0.5, 0.3, 0.5, 0.5, 0.1, 0.5, 0.5, 0.2, 0.5, 0.5 }));
  EXPECT_EQ(run.frame.bonds.header.rows, 2);
  EXPECT_TRUE(run.frame.bonds.has_lines);
}

TEST(RestartBonds, WhoeverHoldsThem)
{
  // by the lower id, by the higher one
  EXPECT_EQ(
    bonds_of(bonded_file({ { 1, { { 5, 2 } } }, { 2 } })), (std::vector<Bond>{ { 1, 2, 5 } }));
  EXPECT_EQ(
    bonds_of(bonded_file({ { 1 }, { 2, { { 5, 1 } } } })), (std::vector<Bond>{ { 2, 1, 5 } }));
  // stored once: what both hold are two
  RestartBuilder once = bonded_file({ { 1, { { 5, 2 } } }, { 2, { { 6, 1 } } } });
  EXPECT_EQ(bonds_of(once), (std::vector<Bond>{ { 1, 2, 5 } }));
  once.newton_bond = 1;
  EXPECT_EQ(bonds_of(once), (std::vector<Bond>{ { 1, 2, 5 }, { 2, 1, 6 } }));
}

TEST(RestartBonds, ManyBetweenTwo)
{
  const std::vector<HeldBond> three = { { 1, 2 }, { 1, 2 }, { 7, 2 } };
  EXPECT_EQ(bonds_of(bonded_file({ { 1, three }, { 2, { { 7, 1 }, { 1, 1 }, { 1, 1 } } } })),
    (std::vector<Bond>{ { 1, 2, 1 }, { 1, 2, 1 }, { 1, 2, 7 } }));
  // one more at either
  EXPECT_EQ(bonds_of(bonded_file({ { 1, three }, { 2, { { 7, 1 } } } })),
    (std::vector<Bond>{ { 1, 2, 1 }, { 1, 2, 1 }, { 1, 2, 7 } }));
  EXPECT_EQ(bonds_of(bonded_file({ { 1, { { 7, 2 } } }, { 2, { { 1, 1 }, { 7, 1 }, { 1, 1 } } } })),
    (std::vector<Bond>{ { 1, 2, 7 }, { 2, 1, 1 }, { 2, 1, 1 } }));
  // of other types they are still the same bonds
  EXPECT_EQ(bonds_of(bonded_file(
              { { 1, { { 3, 2 }, { 4, 2 } } }, { 2, { { 4, 1 }, { 5, 1 }, { 6, 1 } } } })),
    (std::vector<Bond>{ { 1, 2, 3 }, { 1, 2, 4 }, { 2, 1, 6 } }));
}

TEST(RestartBonds, OfItselfAndOfNobody)
{
  const RestartRun run =
    read_run(bonded_file({ { 1, { { 1, 1 }, { 1, 9 }, { 1, 2 } } }, { 2, { { 1, 1 } } } }));
  EXPECT_EQ(bonds_of(run.frame), (std::vector<Bond>{ { 1, 1, 1 }, { 1, 2, 1 } }));
  EXPECT_EQ(run.notices.size(), 2u);
  EXPECT_NE(run.said().find("bonds that are left out, as their partner is not in the file: 1"),
    std::string::npos);
  EXPECT_NE(run.said().find("bonds of a particle with itself: 1"), std::string::npos);
}

TEST(RestartBonds, CopiesThatDiffer)
{
  const auto said = [](std::vector<double> lower, std::vector<double> higher)
  {
    return read_run(
      bonded_file(
        { { 1, { { 1, 2, std::move(lower) } } }, { 2, { { 1, 1, std::move(higher) } } } }, 12))
      .said();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(said(history(1), history(1)), "");
  EXPECT_EQ(said(history(1), history(1, -1)), "");
  EXPECT_EQ(said(history(nan), history(nan)), "");
  EXPECT_NE(said(history(1), history(2))
              .find("do not hold the same history, of which that of the lower id is taken: 1"),
    std::string::npos);
}

// Zero may be another number in the other copy, small beside all of its kind in the file, whichever bond has it.
TEST(RestartBonds, CopiesThatAreRounded)
{
  using Change = std::vector<std::pair<std::size_t, double>>;
  const auto differing = [](int values, const Change& lower, const Change& higher)
  {
    const auto change = [&](const Change& numbers)
    {
      std::vector<double> changed(static_cast<std::size_t>(values));
      for (const auto& [i, number] : numbers)
      {
        changed[i] = number;
      }
      return changed;
    };
    // forces up to 8, torques up to 2^-10, all others 1
    std::vector<double> large(static_cast<std::size_t>(values), 1);
    std::fill_n(large.begin(), std::min(values, 12), 0x1p-10);
    large[values < 12 ? 0 : 5] = -8;
    const std::string said =
      read_run(bonded_file({ { 1, { { 1, 2, change(lower) } }, 0.1 },
                             { 2, { { 1, 1, change(higher) } }, 0.2 }, { 3, { { 1, 4, large } } },
                             { 4, { { 1, 3, large } } } },
                 values))
        .said();
    EXPECT_EQ(said.find("history") == said.npos, said.empty()) << said;
    return !said.empty();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(differing(12, { { 0, -4e-16 } }, {}));
  EXPECT_FALSE(differing(12, {}, { { 0, 7.9e-6 }, { 1, -7.9e-6 }, { 11, 9e-10 } }));
  EXPECT_FALSE(differing(12, { { 0, nan } }, { { 0, nan } }));
  EXPECT_FALSE(differing(14, { { 12, 0.9e-6 } }, { { 13, 0.9e-6 } }));
  // more than rounding
  EXPECT_TRUE(differing(12, { { 0, 8.1e-6 } }, {}));
  EXPECT_TRUE(differing(12, {}, { { 11, 1e-9 } }));
  EXPECT_TRUE(differing(14, { { 12, 1.1e-6 } }, {}));
  EXPECT_TRUE(differing(14, {}, { { 13, 1.1e-6 } }));
  EXPECT_TRUE(differing(12, { { 0, nan } }, {}));
  EXPECT_TRUE(differing(12, { { 0, infinity } }, { { 0, 1 } }));
  EXPECT_FALSE(differing(12, { { 0, infinity } }, { { 0, -infinity } }));
  // of fewer nobody knows which are forces
  EXPECT_FALSE(differing(11, { { 0, 7.9e-6 } }, {}));
  EXPECT_TRUE(differing(11, { { 1, 7.9e-6 } }, {}));
}

TEST(RestartBonds, HistoryWithoutSign)
{
  const auto builder = bonded_file(
    { { 1, { { 1, 2, history(-20, 1, 14) } } }, { 2, { { 1, 1, history(20, 1, 14) } } } }, 14);
  const RestartRun run = read_run(builder);
  EXPECT_EQ(values_of<double>(run.frame.bonds, "equilibrium_length"), std::vector<double>{ 8 });
  EXPECT_EQ(values_of<double>(run.frame.bonds, "damage"), std::vector<double>{ 7 });
  EXPECT_EQ(
    values_of<double>(run.frame.bonds, "force_normal"), (std::vector<double>{ -20, -19, -18 }));
  const RestartRun unnamed = read_run(builder, {}, 3); // has 13
  EXPECT_EQ(values_of<double>(unnamed.frame.bonds, "history13"), std::vector<double>{ -8 });
  EXPECT_EQ(array_of(unnamed.frame.bonds, "damage"), nullptr);
  EXPECT_NE(unnamed.said().find("expected 13 history values of a bond, as PFM has them, got 14"),
    std::string::npos);
}

TEST(RestartBonds, Layouts)
{
  const auto last = [](int layout, std::int64_t values, std::string_view version = "LIGGGHTS 3.8")
  {
    const auto columns = granular::make_bond_schema(layout, version, values).columns();
    EXPECT_EQ(static_cast<std::int64_t>(columns.size()), 3 + values);
    return columns.back().name;
  };
  EXPECT_EQ(last(0, 12), "torque_tangentialz");
  EXPECT_EQ(last(0, 13), "equilibrium_length");
  EXPECT_EQ(last(0, 13, "Version LIGGGHTS-PFM 24.01, compiled"), "initial_length");
  EXPECT_EQ(last(0, 14, "Version LIGGGHTS-PFM 24.01, compiled"), "damage");
  EXPECT_EQ(last(4, 13, "Version LIGGGHTS-PFM 24.01, compiled"), "equilibrium_length");
  EXPECT_EQ(last(3, 13), "initial_length");
  EXPECT_EQ(last(4, 13), "equilibrium_length");
  EXPECT_EQ(last(0, 14), "damage");
  EXPECT_EQ(last(2, 14), "history14");
  EXPECT_EQ(last(0, 2), "history2");
  EXPECT_EQ(last(99, 12), "history12");
  EXPECT_EQ(last(0, 0), "btype");
  for (const auto& [layout, values] :
    std::vector<std::pair<int, std::int64_t>>{ { 2, 12 }, { 3, 13 }, { 4, 13 }, { 5, 14 } })
  {
    const auto columns = granular::make_bond_schema(layout, {}, values).columns();
    for (std::size_t i = 3; i < columns.size(); ++i)
    {
      const std::string& name = columns[i].name;
      const granular::KnownColumn* const known =
        granular::find_known_column(name, granular::local_known_columns());
      ASSERT_NE(known, nullptr) << name;
      EXPECT_EQ(known->type, granular::ValueType::Float64) << name;
      EXPECT_NE(known->unit, "") << name;
    }
  }
}

TEST(RestartBonds, AnyIds)
{
  constexpr std::int64_t large = std::int64_t{ 1 } << 53; // the last that is a value
  for (const auto& [low, high] : std::vector<std::pair<std::int64_t, std::int64_t>>{ { 0, 1 },
         { -7, 0 }, { -9, -3 }, { 1, std::int64_t{ 1 } << 31 }, { 4'000'000'000, large } })
  {
    auto builder = bonded_file({ { high, { { 1, low } } }, { low, { { 1, high } } } });
    builder.tag_bytes = 8;
    const RestartRun run = read_run(builder);
    EXPECT_EQ(bonds_of(run.frame), (std::vector<Bond>{ { low, high, 1 } })) << low << " " << high;
    EXPECT_EQ(
      values_of<std::int64_t>(run.frame.rows, "id"), (std::vector<std::int64_t>{ high, low }));
  }
}

TEST(RestartBonds, TypesThatBreak)
{
  EXPECT_EQ(bonds_of(bonded_file({ { 1, { { -3, 2 } } }, { 2, { { -3, 1 } } } })),
    (std::vector<Bond>{ { 1, 2, -3 } }));
  EXPECT_EQ(bonds_of(bonded_file({ { 1, { { 0, 2 } } }, { 2, { { 0, 1 } } } })),
    (std::vector<Bond>{ { 1, 2, 0 } }));
}

TEST(RestartBonds, AcrossAFace)
{
  const RestartRun run =
    read_run(bonded_file({ { 1, { { 1, 2 } }, 0.125 }, { 2, { { 1, 1 } }, 0.875 } }));
  const auto* const lengths = static_cast<const double*>(run.frame.bonds.lines.lengths.data());
  EXPECT_EQ(lengths[0], 0.25);
  EXPECT_EQ(
    line_points_of(run.frame.bonds), (std::vector<double>{ 0.125, 0.5, 0.5, -0.125, 0.5, 0.5 }));
}

TEST(RestartBonds, NoneAndNobody)
{
  const RestartRun none = read_run(bonded_file({ { 1 }, { 2 } }, 12));
  EXPECT_EQ(none.frame.bonds.rows, 0);
  EXPECT_NE(array_of(none.frame.bonds, "force_normal"), nullptr);
  const RestartRun nobody = read_run(bonded_file({}));
  EXPECT_EQ(nobody.frame.rows.rows, 0);
  EXPECT_NE(array_of(nobody.frame.rows, "radius"), nullptr);
  EXPECT_NE(array_of(nobody.frame.bonds, "id1"), nullptr);
  EXPECT_EQ(nobody.frame.bonds.lines.count, 0);
}

TEST(RestartBonds, WithoutAnotherStyle)
{
  // alone, and first of a hybrid, its length is found
  RestartBuilder alone =
    bonded_file({ { 1, { { 4, 2, history(1) } } }, { 2, { { 4, 1, history(1) } } }, { 3 } }, 12);
  RestartBuilder first = alone;
  alone.atom_style = "bond/gran";
  alone.styles.clear();
  first.styles = { "bond/gran", "granular" };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto& both = alone.chunks[0][i];
    const restart_builder::Record sphere(both.begin(), both.begin() + 17);
    const restart_builder::Record bonds(both.begin() + 17, both.end());
    alone.chunks[0][i] = bonds;
    restart_builder::Record own_length = sphere;
    own_length[0] = 17;
    first.chunks[0][i] = restart_builder::join({ bonds, own_length });
  }
  for (const RestartBuilder& builder : { alone, first })
  {
    const RestartRun run = read_run(builder);
    EXPECT_EQ(bonds_of(run.frame), (std::vector<Bond>{ { 1, 2, 4 } }));
    EXPECT_EQ(values_of<double>(run.frame.bonds, "force_normal"), (std::vector<double>{ 1, 2, 3 }));
    EXPECT_EQ(
      values_of<std::int64_t>(run.frame.rows, "id"), (std::vector<std::int64_t>{ 1, 2, 3 }));
  }
  EXPECT_EQ(values_of<double>(read_run(first).frame.rows, "radius"),
    (std::vector<double>{ 0.1, 0.1, 0.1 }));
}

// Records that are longer than what is known of the style, from the first with bonds on.
TEST(RestartBonds, LongerThanTheTable)
{
  for (const bool first_has : { true, false })
  {
    const std::vector<HeldBond> held = { { 4, 2, history(1) } };
    RestartBuilder builder = bonded_file(
      { { 1, first_has ? held : std::vector<HeldBond>{} }, { 2, { { 4, 1, history(1) } } } }, 12);
    builder.atom_style = "bond/gran";
    builder.styles.clear();
    for (auto& record : builder.chunks[0])
    {
      record = { record.begin() + 17, record.end() };
    }
    EXPECT_EQ(bonds_of(builder).size(), 1u);
    EXPECT_EQ(read_run(builder).said(), "");
    for (auto& record : builder.chunks[0])
    {
      restart_builder::append(record, { 7.5, 8.5 });
    }
    const RestartRun run = read_run(builder);
    EXPECT_NE(run.said().find("'bond/gran' have in restart files is not known of this program"),
      std::string::npos)
      << run.said();
    EXPECT_FALSE(run.frame.bonds.has_lines);
    EXPECT_EQ(array_of(run.frame.rows, "mol"), nullptr);
    EXPECT_EQ(values_of<std::int64_t>(run.frame.rows, "id"), (std::vector<std::int64_t>{ 1, 2 }));
  }
}

// Against all copies, counted by pair.
TEST(RestartBonds, LikeBruteForce)
{
  std::mt19937 random(5);
  for (int run = 0; run < 100; ++run)
  {
    const std::int64_t particles = 1 + static_cast<std::int64_t>(random() % 9);
    std::vector<BondedParticle> all;
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> held;
    for (std::int64_t id = particles; id > 0; --id)
    {
      BondedParticle particle{ id };
      for (auto bond = random() % 6; bond > 0; --bond)
      {
        const std::int64_t partner = 1 + static_cast<std::int64_t>(random() % 9);
        particle.bonds.push_back({ static_cast<std::int64_t>(1 + random() % 2), partner });
        ++held[{ id, partner }];
      }
      all.push_back(particle);
    }
    std::shuffle(all.begin(), all.end(), random);
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> expected;
    for (const auto& [pair, count] : held)
    {
      const auto [id, partner] = pair;
      const auto other = held.find({ partner, id });
      const std::int64_t theirs = id == partner || other == held.end() ? 0 : other->second;
      if (partner <= particles)
      {
        expected[{ std::min(id, partner), std::max(id, partner) }] = std::max(count, theirs);
      }
    }
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> found;
    for (const auto& [id1, id2, type] : bonds_of(bonded_file(all)))
    {
      ++found[{ std::min(id1, id2), std::max(id1, id2) }];
    }
    EXPECT_EQ(found, expected);
  }
}

TEST(RestartBonds, AnyThreadsAndPieces)
{
  std::mt19937 random(7);
  std::vector<BondedParticle> particles;
  constexpr std::int64_t count = 12000; // of several blocks
  for (std::int64_t i = 0; i < count; ++i)
  {
    BondedParticle particle{ i * 7919 % count, {}, 0.25 + static_cast<double>(i) / (2 * count) };
    for (auto bond = random() % 3; bond > 0; --bond)
    {
      particle.bonds.push_back(
        { 1, static_cast<std::int64_t>(random() % count), history(static_cast<double>(bond)) });
    }
    particles.push_back(particle);
  }
  RestartBuilder builder = bonded_file(particles, 12);
  auto& all = builder.chunks[0];
  builder.chunks = { { all.begin(), all.begin() + 5000 }, {}, { all.begin() + 5000, all.end() } };
  builder.grid = { 1, 3, 1 };
  const std::string bytes = builder.file();
  const auto source = granular::open_memory(bytes);
  const RestartRun whole = read_run(*source);
  ASSERT_GT(whole.frame.bonds.rows, count / 2);
  for (const int threads : { 1, 3 })
  {
    for (int pieces = 1; pieces <= 5; ++pieces)
    {
      std::vector<Bond> bonds;
      std::vector<double> points;
      std::vector<double> lines;
      std::int64_t rows = 0;
      for (int piece = 0; piece < pieces; ++piece)
      {
        Request request;
        request.threads = threads;
        request.piece = piece;
        request.pieces = pieces;
        const RestartRun part = read_run(*source, request);
        EXPECT_EQ(part.frame.bonds.first_row, static_cast<std::int64_t>(bonds.size()));
        EXPECT_EQ(part.frame.bonds.header.rows, whole.frame.bonds.rows);
        EXPECT_EQ(part.said(), whole.said());
        rows += part.frame.rows.rows;
        const auto more = bonds_of(part.frame);
        bonds.insert(bonds.end(), more.begin(), more.end());
        const auto more_points = points_of(part.frame.rows);
        points.insert(points.end(), more_points.begin(), more_points.end());
        const auto more_lines = line_points_of(part.frame.bonds);
        lines.insert(lines.end(), more_lines.begin(), more_lines.end());
        if (pieces == 1)
        {
          EXPECT_EQ(bytes_of(part.frame), bytes_of(whole.frame));
        }
      }
      EXPECT_EQ(rows, count);
      EXPECT_EQ(bonds, bonds_of(whole.frame));
      EXPECT_EQ(points, points_of(whole.frame.rows));
      EXPECT_EQ(lines, line_points_of(whole.frame.bonds));
    }
  }
}

// One with very many bonds, in linear time: with a quadratic one this would not end.
TEST(RestartBonds, AMillionOfOneParticle)
{
  constexpr std::int64_t many = 1'000'000;
  std::vector<BondedParticle> particles = { { many + 1 }, { 1 } };
  particles[0].bonds.reserve(many);
  for (std::int64_t i = 0; i < many; ++i)
  {
    particles[0].bonds.push_back({ 1, 1 + i % 2 * many });
  }
  particles[1].bonds.assign(many / 2, { 1, many + 1 });
  const RestartRun run = read_run(bonded_file(particles));
  EXPECT_EQ(run.frame.bonds.rows, many);
  EXPECT_NE(run.said().find("bonds of a particle with itself: 500000"), std::string::npos);

  std::vector<BondedParticle> star = { { 0 } };
  for (std::int64_t id = 1; id <= many / 10; ++id)
  {
    star[0].bonds.push_back({ 1, id });
    star.push_back({ id, { { 1, 0 } } });
  }
  EXPECT_EQ(read_run(bonded_file(star)).frame.bonds.rows, many / 10);
}
