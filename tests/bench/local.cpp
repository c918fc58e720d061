// SPDX-License-Identifier: BSD-3-Clause
// Lines joined with the particles at their ends: time of a line, against a plain gather of as many positions by
// rows that are known.
#include "bench.h"
#include "local_read.h"

#include "granular/local/join.h"
#include "granular/memory/block_pool.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace bench
{
namespace
{
using namespace granular;

struct JoinCase
{
  std::string name;
  std::int64_t particles;
  std::int64_t lines;
  bool from_1;   ///< ids, in no order; else any of 64 bits
  bool in_order; ///< the ends of lines are neighbours, one line after the other; else any
  bool arrays;   ///< a mean of one number and one of three, a difference of three
};

/// Everything of a case.
struct Joining
{
  explicit Joining(const JoinCase& each)
    : ids(static_cast<std::size_t>(each.particles))
    , velocities(3 * ids.size())
    , radii(ids.size())
  {
    std::iota(ids.begin(), ids.end(), 1);
    std::ranges::shuffle(ids, random);
    for (std::int64_t& id : ids)
    {
      id = each.from_1
        ? id
        : static_cast<std::int64_t>((random() << 24) + static_cast<std::uint64_t>(id));
    }
    std::uniform_real_distribution<double> anywhere(-1, 1);
    points.resize(velocities.size());
    for (std::vector<double>* const one : { &points, &velocities, &radii })
    {
      std::ranges::generate(*one, [&] { return anywhere(random); });
    }
    this->make_lines(each);
    view.rows = each.particles;
    view.has_box = false;
    view.points = view_rows("points", ValueType::Float64, points.data(), 3);
    view.arrays = { view_rows("id", ValueType::Int64, ids.data()),
      view_rows("v", ValueType::Float64, velocities.data(), 3),
      view_rows("radius", ValueType::Float64, radii.data()) };
    if (each.arrays)
    {
      request.means = { "radius", "v" };
      request.differences = { "v" };
    }
    request.pool = std::make_shared<BlockPool>(std::size_t{ 4 } << 30);
  }

  void make_lines(const JoinCase& each)
  {
    const auto particles = static_cast<std::uint64_t>(each.particles);
    for (std::int64_t i = 0; i < each.lines; ++i)
    {
      const auto near =
        static_cast<std::uint64_t>(i) * particles / static_cast<std::uint64_t>(each.lines);
      const std::uint64_t first = each.in_order ? near : random() % particles;
      const std::uint64_t second =
        each.in_order ? (first + random() % 100) % particles : random() % particles;
      firsts.push_back(first);
      seconds.push_back(second);
      id1.push_back(ids[first]);
      id2.push_back(ids[second]);
    }
  }

  /// Positions alone, by rows that are known.
  bool gather() const
  {
    for (const std::vector<std::uint64_t>* const rows : { &firsts, &seconds })
    {
      const Block block(rows->size() * 3 * sizeof(double), request.pool);
      auto* to = static_cast<double*>(block.data());
      for (const std::uint64_t row : *rows)
      {
        std::memcpy(to, points.data() + 3 * row, 3 * sizeof(double));
        to += 3;
      }
      benchmark::DoNotOptimize(*static_cast<double*>(block.data()));
    }
    return true;
  }

  JoinedLines joined() const
  {
    SerialCommunicator alone;
    Progress progress;
    return join_lines(view, id1, id2, request, alone, progress);
  }

  bool join() const { return joined().count == std::ssize(id1); }

  bool is_right() const
  {
    const JoinedLines lines = joined();
    const auto* const first = static_cast<const double*>(lines.first.data());
    const auto* const second = static_cast<const double*>(lines.second.data());
    for (std::size_t i = 0; i < firsts.size(); ++i)
    {
      if (std::memcmp(first + 3 * i, points.data() + 3 * firsts[i], 3 * sizeof(double)) != 0 ||
        std::memcmp(second + 3 * i, points.data() + 3 * seconds[i], 3 * sizeof(double)) != 0)
      {
        return false;
      }
    }
    return lines.count == std::ssize(firsts) && lines.rows.empty() && lines.missing == 0 &&
      lines.repeated == 0;
  }

  std::mt19937_64 random{ 3 };
  std::vector<std::int64_t> ids;
  std::vector<double> points;
  std::vector<double> velocities;
  std::vector<double> radii;
  std::vector<std::uint64_t> firsts; ///< rows
  std::vector<std::uint64_t> seconds;
  std::vector<std::int64_t> id1;
  std::vector<std::int64_t> id2;
  FrameView view;
  JoinRequest request;
};

void measure_join(benchmark::State& state, const JoinCase& each)
{
  const Joining data(each);
  if (!data.is_right())
  {
    fail(state, "a line without the particles at its ends");
    return;
  }
  Rounds rounds;
  rounds.add("gather", [&] { return data.gather(); });
  rounds.add("join", [&] { return data.join(); });
  const int repeats = static_cast<int>(std::clamp<std::int64_t>(1'000'000 / each.lines, 1, 20));
  if (!rounds.run_all(state, "lines are left out", static_cast<double>(each.lines), repeats))
  {
    return;
  }
  const Samples& base = rounds.of("gather");
  tell(state, "gather", 1e9 * median(base), "ns/line");
  tell(state, "join", 1e9 * median(rounds.of("join")), "ns/line");
  tell(state, "join, time against gather", median_ratio(rounds.of("join"), base), "1");
  tell(state, "spread", spread_of_ratio(rounds.of("join"), base), "1");
}

/// Ten lines a particle, ever more of both.
void measure_growth(benchmark::State& state, const std::vector<std::int64_t>& counts, bool in_order)
{
  std::vector<std::unique_ptr<Joining>> all;
  Rounds rounds;
  for (const std::int64_t lines : counts)
  {
    all.push_back(
      std::make_unique<Joining>(JoinCase{ "", lines / 10, lines, true, in_order, false }));
    const Joining& data = *all.back();
    const std::int64_t passes = counts.back() / lines;
    const auto add = [&](const std::string& name, bool (Joining::*run)() const)
    {
      rounds.add(name + std::to_string(std::lround(std::log10(lines))),
        [&data, passes, run]
        {
          bool right = true;
          for (std::int64_t i = 0; i < passes; ++i)
          {
            right = (data.*run)() && right;
          }
          return right;
        });
    };
    add("gather, 10^", &Joining::gather);
    add("join, 10^", &Joining::join);
  }
  if (!rounds.run_all(state, "lines are left out", static_cast<double>(counts.back())))
  {
    return;
  }
  Samples times;
  for (const std::int64_t lines : counts)
  {
    const std::string power = "10^" + std::to_string(std::lround(std::log10(lines)));
    times.push_back(median(rounds.of("join, " + power)));
    tell(state, "gather, " + power, 1e9 * median(rounds.of("gather, " + power)), "ns/line");
    tell(state, "join, " + power, 1e9 * times.back(), "ns/line");
  }
  const auto [least, largest] = std::ranges::minmax_element(times);
  tell(state, "join, slowest against fastest", *largest / *least, "1");
}
}

void add_benchmarks(const Size& size)
{
  add_reading(size);
  const std::int64_t particles = size.pick(1'000'000, 1'000);
  const std::int64_t lines = size.pick(10'000'000, 3'000'000, 10'000);
  const JoinCase cases[] = {
    { "ids from 1", particles, lines, true, false, false },
    { "ids from 1, in order", particles, lines, true, true, false },
    { "ids from 1, 7 values", particles, lines, true, false, true },
    { "any ids", particles, lines, false, false, false },
    { "any ids, in order", particles, lines, false, true, false },
    { "any ids, 7 values", particles, lines, false, false, true },
  };
  for (const JoinCase& each : cases)
  {
    add("local/join, " + each.name, size.pick(5, 1),
      [each](benchmark::State& state) { measure_join(state, each); });
  }
  std::vector<std::int64_t> counts = { 1'000, 10'000 };
  if (size.full)
  {
    counts = { 10'000, 100'000, 1'000'000 };
  }
  if (size.large)
  {
    counts.push_back(10'000'000);
  }
  for (const bool in_order : { true, false })
  {
    add(std::string("local/more lines and particles") + (in_order ? ", in order" : ""),
      size.pick(3, 1),
      [counts, in_order](benchmark::State& state) { measure_growth(state, counts, in_order); });
  }
}
}
