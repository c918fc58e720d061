// SPDX-License-Identifier: BSD-3-Clause
// Sums of the contacts of each particle: time of a contact, against a plain loop that adds the same numbers to arrays of
// the particles.
#include "bench.h"

#include "granular/contacts/contact_sums.h"
#include "granular/local/id_finder.h"
#include "granular/memory/block_pool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bench
{
namespace
{
using namespace granular;
using namespace std::string_literals;

Vector3 minus(const Vector3& a, const Vector3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/// Neighbours in a cube of particles, which are somewhat out of their places, and whose rows and ids follow each other.
struct Contacts
{
  Contacts(std::int64_t per_edge, std::size_t most, bool in_order)
    : edge(per_edge)
    , ids(static_cast<std::size_t>(edge * edge * edge))
    , points(3 * ids.size())
  {
    std::iota(ids.begin(), ids.end(), 1);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::int64_t places[] = { 1, edge, edge * edge };
      points[i] = static_cast<double>(static_cast<std::int64_t>(i / 3) / places[i % 3] % edge) +
        small(random);
    }
    std::vector<std::array<std::uint32_t, 2>> pairs = neighbours(most);
    if (!in_order)
    {
      std::ranges::shuffle(pairs, random);
    }
    for (const auto& [first, second] : pairs)
    {
      add(first, second);
    }
    view.rows = std::ssize(ids);
    view.header.box = Box::from_bounds({ -1, -1, -1 }, { 150, 150, 150 });
    view.header.box.boundary = "pp pp pp";
    view.points = view_rows("points", ValueType::Float64, points.data(), 3);
    view.arrays = { view_rows("id", ValueType::Int64, ids.data()) };
    rows = { id1.size(), id1, id2, ends, force, {}, torque, contact_point, {} };
  }

  /// Of each particle those at the next edges and faces of the lattice, of every fourth also that across the cell: a little
  /// more than six.
  std::vector<std::array<std::uint32_t, 2>> neighbours(std::size_t most) const
  {
    constexpr std::array<Vector3, 7> steps = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 },
      { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 } } };
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::int64_t row = 0; row < std::ssize(ids); ++row)
    {
      const std::array<std::int64_t, 3> at = { row % edge, row / edge % edge, row / edge / edge };
      for (std::size_t i = 0; i < (row % 4 == 0 ? 7 : 6); ++i)
      {
        std::int64_t other = row;
        bool inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const auto step = static_cast<std::int64_t>(steps[i][axis]);
          inside = inside && at[axis] + step < edge;
          other += step * (axis == 0 ? 1 : axis == 1 ? edge : edge * edge);
        }
        if (inside && pairs.size() < most)
        {
          pairs.push_back({ static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(other) });
        }
      }
    }
    return pairs;
  }

  void add(std::size_t first, std::size_t second)
  {
    id1.push_back(ids[first]);
    id2.push_back(ids[second]);
    for (const std::size_t row : { first, second })
    {
      ends.insert(ends.end(), points.data() + 3 * row, points.data() + 3 * row + 3);
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      force.push_back(10 * small(random));
      torque.push_back(small(random));
      contact_point.push_back((points[3 * first + i] + points[3 * second + i]) / 2 + small(random));
    }
  }

  std::mt19937_64 random{ 6 };
  std::uniform_real_distribution<double> small{ -0.1, 0.1 };
  std::int64_t edge;
  std::vector<std::int64_t> ids;
  std::vector<double> points;
  std::vector<std::int64_t> id1;
  std::vector<std::int64_t> id2;
  std::vector<double> ends;
  std::vector<double> force;
  std::vector<double> torque;
  std::vector<double> contact_point;
  FrameView view;
  ContactRows rows;
  std::shared_ptr<BlockPool> pool = std::make_shared<BlockPool>(std::size_t{ 2 } << 30);
};

/// What is asked for.
struct Selection
{
  std::string name;
  bool force;
  bool torque;
  bool fabric;
  bool stress;
};

const std::array<Selection, 3> selections = { { { "all", true, true, true, true },
  { "force", true, false, false, false }, { "coordination", false, false, false, false } } };

ContactSums sum(const Contacts& contacts, const Selection& what, int threads)
{
  ContactSumsRequest request;
  request.force = what.force;
  request.torque = what.torque;
  request.fabric = what.fabric;
  request.stress = what.stress;
  request.threads = threads;
  request.pool = contacts.pool;
  SerialCommunicator alone;
  Progress progress;
  return sum_contacts(contacts.view, { &contacts.rows, 1 }, request, alone, progress);
}

// ---- the plain loop -----------------------------------------------------------------------------
void add_products(double* to, const Vector3& a, const Vector3& b)
{
  to[0] += a[0] * b[0];
  to[1] += a[1] * b[1];
  to[2] += a[2] * b[2];
  to[3] += a[0] * b[1];
  to[4] += a[0] * b[2];
  to[5] += a[1] * b[2];
}

/// Adds doubles, one contact after the other, and trusts that all is there.
template <bool with_force, bool with_torque, bool with_fabric, bool with_stress>
struct PlainLoop
{
  explicit PlainLoop(const Contacts& all)
    : contacts(all)
  {
    const auto room = [&](bool wanted, std::size_t width)
    {
      Block block = wanted ? Block(all.ids.size() * width, all.pool) : Block();
      if (wanted)
      {
        std::memset(block.data(), 0, block.bytes());
      }
      return block;
    };
    sums.coordination = room(true, sizeof(std::int32_t));
    sums.force = room(with_force, 3 * sizeof(double));
    sums.torque = room(with_torque, 3 * sizeof(double));
    sums.fabric = room(with_fabric, 6 * sizeof(double));
    sums.stress = room(with_stress, 6 * sizeof(double));
  }

  static Vector3 at(std::span<const double> values, std::size_t i)
  {
    return { values[i], values[i + 1], values[i + 2] };
  }

  static double* of(const Block& block, std::size_t i)
  {
    return static_cast<double*>(block.data()) + i;
  }

  void add_to(std::size_t place, const Vector3& centre, const Vector3& normal, const Vector3& point,
    const Vector3& force, const Vector3& torque) const
  {
    static_cast<std::int32_t*>(sums.coordination.data())[place] += 1;
    for (std::size_t i = 0; with_force && i < 3; ++i)
    {
      *of(sums.force, 3 * place + i) += force[i];
    }
    for (std::size_t i = 0; with_torque && i < 3; ++i)
    {
      *of(sums.torque, 3 * place + i) += torque[i];
    }
    if constexpr (with_fabric)
    {
      add_products(of(sums.fabric, 6 * place), normal, normal);
    }
    if constexpr (with_stress)
    {
      add_products(of(sums.stress, 6 * place), minus(point, centre), force);
    }
  }

  void add(std::size_t row, std::size_t first, std::size_t second) const
  {
    const ContactRows& rows = contacts.rows;
    Vector3 from = {};
    Vector3 to = {};
    Vector3 branch = {};
    Vector3 normal = {};
    Vector3 point = {};
    Vector3 force = {};
    Vector3 torque = {};
    Vector3 other_torque = {};
    if constexpr (with_force || with_torque || with_stress)
    {
      force = at(rows.force, 3 * row);
    }
    if constexpr (with_torque || with_fabric || with_stress)
    {
      from = at(rows.ends, 6 * row);
      to = at(rows.ends, 6 * row + 3);
      branch = minus(to, from);
    }
    if constexpr (with_fabric)
    {
      const double length =
        std::sqrt(branch[0] * branch[0] + branch[1] * branch[1] + branch[2] * branch[2]);
      normal = { branch[0] / length, branch[1] / length, branch[2] / length };
    }
    if constexpr (with_torque)
    {
      torque = at(rows.torque, 3 * row);
      other_torque = { branch[1] * force[2] - branch[2] * force[1] - torque[0],
        branch[2] * force[0] - branch[0] * force[2] - torque[1],
        branch[0] * force[1] - branch[1] * force[0] - torque[2] };
    }
    if constexpr (with_stress)
    {
      point = at(rows.contact_point, 3 * row);
    }
    add_to(first, from, normal, point, force, torque);
    add_to(second, to, normal, point, { -force[0], -force[1], -force[2] }, other_torque);
  }

  ContactSums run()
  {
    const IdFinder finder(contacts.ids);
    constexpr std::size_t stretch = 1024;
    std::array<std::int64_t, stretch> firsts = {};
    std::array<std::int64_t, stretch> seconds = {};
    for (std::size_t row = 0; row < contacts.rows.count; row += stretch)
    {
      const std::size_t count = std::min(stretch, contacts.rows.count - row);
      finder.find(contacts.rows.id1.subspan(row, count), firsts.data());
      finder.find(contacts.rows.id2.subspan(row, count), seconds.data());
      for (std::size_t i = 0; i < count; ++i)
      {
        add(row + i, static_cast<std::size_t>(firsts[i]), static_cast<std::size_t>(seconds[i]));
      }
    }
    const auto* const counts = static_cast<const std::int32_t*>(sums.coordination.data());
    for (std::size_t i = 0; with_fabric && i < 6 * contacts.ids.size(); ++i)
    {
      *of(sums.fabric, i) /= std::max(counts[i / 6], 1);
    }
    return std::move(sums);
  }

  const Contacts& contacts;
  ContactSums sums;
};

ContactSums sum_plainly(const Contacts& contacts, const Selection& what)
{
  return what.stress ? PlainLoop<true, true, true, true>(contacts).run()
    : what.force     ? PlainLoop<true, false, false, false>(contacts).run()
                     : PlainLoop<false, false, false, false>(contacts).run();
}

// ---- what is right ------------------------------------------------------------------------------
bool are_near(const Block& a, const Block& b)
{
  const auto* const x = static_cast<const double*>(a.data());
  return a.bytes() == b.bytes() &&
    std::equal(x, x + a.bytes() / sizeof(double), static_cast<const double*>(b.data()),
      [](double one, double other) { return std::abs(one - other) < 1e-13; });
}

bool are_same(const Block& a, const Block& b)
{
  return a.bytes() == b.bytes() &&
    (a.bytes() == 0 || std::memcmp(a.data(), b.data(), a.bytes()) == 0);
}

/// Sums of up to fourteen numbers that are at most 1.
bool is_right(const Contacts& contacts, const Selection& what)
{
  const ContactSums plain = sum_plainly(contacts, what);
  const ContactSums ours = sum(contacts, what, 1);
  const ContactSums threaded = sum(contacts, what, 2);
  bool right = are_same(ours.coordination, plain.coordination) &&
    are_same(ours.coordination, threaded.coordination);
  for (const auto block :
    { &ContactSums::force, &ContactSums::torque, &ContactSums::fabric, &ContactSums::stress })
  {
    right = right && are_near(ours.*block, plain.*block) && are_same(ours.*block, threaded.*block);
  }
  return right && ours.missing == 0 && ours.broken == 0 &&
    ours.contacts == 2 * static_cast<std::int64_t>(contacts.rows.count);
}

// ---- the cases ----------------------------------------------------------------------------------
/// Of the order that was asked for last; each takes more than a GB.
const Contacts& contacts_of(const Size& size, bool in_order)
{
  static std::unique_ptr<Contacts> made;
  static bool ordered = false;
  if (!made || ordered != in_order)
  {
    made = nullptr;
    made = std::make_unique<Contacts>(
      size.pick(118, 12), static_cast<std::size_t>(size.pick(10'000'000, 100'000)), in_order);
    ordered = in_order;
  }
  return *made;
}

/// Where threads is 2, also with one, and all of it on the wall.
void measure(benchmark::State& state, const Contacts& contacts, const Selection& what, int threads)
{
  if (!is_right(contacts, what))
  {
    fail(state, "sums other than those of a plain loop, or of another number of threads");
    return;
  }
  const auto are_all = [&](const ContactSums& sums)
  { return sums.coordination.bytes() == contacts.ids.size() * sizeof(std::int32_t); };
  Rounds rounds(threads > 1 ? wall : now);
  rounds.add("plain", [&] { return are_all(sum_plainly(contacts, what)); });
  for (int some = 1; some <= threads; ++some)
  {
    rounds.add(std::to_string(some), [&, some] { return are_all(sum(contacts, what, some)); });
  }
  if (!rounds.run_all(state, "sums are missing", static_cast<double>(contacts.rows.count)))
  {
    return;
  }
  const Samples& plain = rounds.of("plain");
  const Samples& best = rounds.of(std::to_string(threads));
  tell(state, "plain", 1e9 * median(plain), "ns/contact");
  tell(state, "ours", 1e9 * median(best), "ns/contact");
  tell(state, "time against plain", median_ratio(best, plain), "1");
  tell(state, "spread", spread_of_ratio(best, plain), "1");
  if (threads > 1)
  {
    tell(state, "speed of 2 threads", median_ratio(rounds.of("1"), best), "1");
  }
}
}

void add_benchmarks(const Size& size)
{
  for (const bool in_order : { true, false })
  {
    const std::string order = in_order ? "in order" : "shuffled";
    for (const Selection& what : selections)
    {
      add("contacts/" + what.name + ", " + order, size.pick(in_order ? 5 : 3, 1),
        [=](benchmark::State& state) { measure(state, contacts_of(size, in_order), what, 1); });
    }
    add("contacts/two threads, all, " + order, size.pick(in_order ? 5 : 3, 1),
      [=](benchmark::State& state)
      { measure(state, contacts_of(size, in_order), selections[0], 2); });
  }
}
}
