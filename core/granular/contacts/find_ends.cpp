// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/find_ends.h"

#include "granular/common/error.h"
#include "granular/parallel/trade.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

namespace granular
{
namespace
{
constexpr std::size_t rows_of_stretch = 65536;

/// A span of the rows: whether it is known, its size and name.
struct Part
{
  const char* name;
  std::size_t size; ///< values
  std::size_t width;
  bool ContactKinds::*known;
};

std::array<Part, 7> parts_of(const ContactRows& rows) noexcept
{
  return { { { "id1", rows.id1.size(), 1, &ContactKinds::walls },
    { "ends", rows.ends.size(), 6, &ContactKinds::ends },
    { "force", rows.force.size(), 3, &ContactKinds::force },
    { "tangential", rows.tangential.size(), 3, &ContactKinds::tangential },
    { "torque", rows.torque.size(), 3, &ContactKinds::torque },
    { "contact_point", rows.contact_point.size(), 3, &ContactKinds::contact_point },
    { "overlap", rows.overlap.size(), 1, &ContactKinds::overlap } } };
}

constexpr double largest_usable = 0x1.fffffffffffffp289;

/// Returns true for a number that sums can have: it is finite, and not too large to multiply (below 2^290).
bool is_usable(double number) noexcept
{
  return std::abs(number) <= largest_usable;
}

bool are_usable(
  std::span<const double> values, std::size_t first, std::size_t count, std::size_t width) noexcept
{
  // by the bits, whose order is that of the numbers, infinities and nan above them: many at once
  constexpr auto most = std::bit_cast<std::uint64_t>(largest_usable);
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  std::uint64_t rest = 0;
  for (std::size_t i = first * width; !values.empty() && i < (first + count) * width; ++i)
  {
    rest |= most - (std::bit_cast<std::uint64_t>(values[i]) & ~sign);
  }
  return (rest & sign) == 0;
}

/// Returns what the ranks that have rows know. Throws Error if they differ, or if a span has another size than the rows need.
/// Collective.
ContactKinds share_kinds(const ContactRows& rows, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      if (rows.id2.size() != rows.count)
      {
        throw Error("expected an id2 of each contact, got " + std::to_string(rows.id2.size()) +
          " for " + std::to_string(rows.count) + " contacts");
      }
      const std::array<Part, 7> parts = parts_of(rows);
      std::array<int, 8> own = { rows.count > 0 ? 1 : 0 };
      for (std::size_t i = 0; i < parts.size(); ++i)
      {
        own[i + 1] = parts[i].size > 0 ? 1 : 0;
        if (parts[i].size > 0 && parts[i].size != parts[i].width * rows.count)
        {
          throw Error("expected " + std::to_string(parts[i].width) + " values a contact in '" +
            parts[i].name + "', got " + std::to_string(parts[i].size) + " for " +
            std::to_string(rows.count) + " contacts");
        }
      }
      ContactKinds kinds;
      bool told = false;
      for (const std::array<int, 8>& each : gather(ranks, own))
      {
        for (std::size_t i = 0; each[0] != 0 && i < parts.size(); ++i)
        {
          const bool known = each[i + 1] != 0;
          if (told && kinds.*parts[i].known != known)
          {
            throw Error("expected the same arrays of contacts on all processes, got '" +
              std::string(parts[i].name) + "' on some");
          }
          kinds.*parts[i].known = known;
        }
        told = told || each[0] != 0;
      }
      kinds.walls = told && !kinds.walls;
      return kinds;
    });
}

/// Returns true if one of some rows is left out, as a number of it is not usable.
bool is_broken(const ContactRows& rows, std::size_t first, std::size_t count) noexcept
{
  return !(are_usable(rows.ends, first, count, 6) && are_usable(rows.force, first, count, 3) &&
    are_usable(rows.tangential, first, count, 3) && are_usable(rows.torque, first, count, 3) &&
    are_usable(rows.contact_point, first, count, 3) && are_usable(rows.overlap, first, count, 1));
}

/// Values of particles that contacts need.
struct Needs
{
  bool points = false;
  bool radii = false;      ///< if they are known
  bool must_radii = false; ///< or else nothing tells the overlap
};

Needs find_needs(const ContactKinds& kind, const ContactOptions& options, bool has_box)
{
  return { !kind.ends || has_box,
    !kind.walls && !kind.contact_point && options.arm == LeverArm::ContactPoint,
    options.least_overlap > 0 && !kind.overlap };
}

/// Returns the values that all contacts need together.
Needs find_needs(std::span<const ContactKinds> kinds, std::span<const std::int64_t> counts,
  const ContactOptions& options, bool has_box)
{
  Needs all;
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    if (counts[i] == 0)
    {
      continue;
    }
    if (kinds[i].walls && !kinds[i].ends && !kinds[i].contact_point)
    {
      throw Error("expected lines or an array 'contact_point' of contacts with walls, got neither");
    }
    const Needs needs = find_needs(kinds[i], options, has_box);
    all.points = all.points || needs.points;
    all.radii = all.radii || needs.radii;
    all.must_radii = all.must_radii || needs.must_radii;
  }
  return all;
}

/// Returns the box whose periods the contacts cross.
Box box_of(const FrameView& particles, std::span<const ContactRows> inputs)
{
  const auto known =
    std::ranges::find_if(inputs, [](const ContactRows& rows) { return rows.box.has_value(); });
  const bool tells = particles.has_box && !particles.header.box.boundary.empty();
  return tells ? particles.header.box : known != inputs.end() ? *known->box : Box{};
}

/// Returns true if a needed number of a particle, or of none, is not usable.
bool is_broken(const ContactParticles& particles, std::int64_t place, const Needs& needs) noexcept
{
  if (place < 0)
  {
    return false;
  }
  const bool radius = (needs.radii || needs.must_radii) && particles.radii;
  if (radius && !is_usable(particles.radius(place)))
  {
    return true;
  }
  if (!needs.points)
  {
    return false;
  }
  const double* const point = particles.points + place * particles.point_step;
  return !std::all_of(point, point + 3, is_usable);
}

/// Contacts of each input, of all ranks.
std::vector<std::int64_t> count_all(std::span<const ContactRows> inputs, Communicator& ranks)
{
  std::vector<std::int64_t> counts;
  for (const ContactRows& rows : inputs)
  {
    counts.push_back(static_cast<std::int64_t>(rows.count));
  }
  ranks.sum(counts);
  return counts;
}

/// Forces of all contacts, or of none.
bool check_forces(std::span<const ContactKinds> kinds, std::span<const std::int64_t> counts,
  const ContactOptions& options)
{
  std::optional<bool> forces;
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    if (counts[i] > 0)
    {
      if (forces.value_or(kinds[i].force) != kinds[i].force)
      {
        throw Error("expected forces of all contacts, with particles and with walls, got those of "
                    "one kind alone");
      }
      forces = kinds[i].force;
    }
  }
  if (options.least_force > 0 && !forces.value_or(true))
  {
    throw Error("expected forces of the contacts for MinimumForce, got none");
  }
  return forces.value_or(true);
}

/// Each id of the rows once.
std::vector<std::int64_t> list_ids(std::span<const ContactRows> inputs)
{
  std::vector<std::int64_t> all;
  for (const ContactRows& rows : inputs)
  {
    all.insert(all.end(), rows.id1.begin(), rows.id1.end());
    all.insert(all.end(), rows.id2.begin(), rows.id2.end());
  }
  return distinct_ids(all, all);
}
}

std::vector<double> load_radii(const FrameView& particles, const std::string& name)
{
  std::vector<double> radii;
  const std::optional<ValueSource> source = find_values(particles, name);
  if (!source || particles.rows == 0)
  {
    return radii;
  }
  if (source->type == ValueType::Text)
  {
    throw Error("expected an array '" + name + "' of numbers, got texts");
  }
  radii.reserve(static_cast<std::size_t>(particles.rows));
  for_each_number(*source, particles.rows, [&](double radius) { radii.push_back(radius); });
  return radii;
}

FoundEnds::FoundEnds(const FrameView& particles, std::span<const ContactRows> inputs,
  const std::string& radius, const ContactOptions& options, Communicator& ranks,
  const Executor& executor, Progress& progress, const std::shared_ptr<BlockPool>& pool)
  : images_(box_of(particles, inputs))
{
  std::vector<ContactKinds> kinds;
  for (const ContactRows& rows : inputs)
  {
    kinds.push_back(share_kinds(rows, ranks));
    rows_ += rows.count;
  }
  const std::vector<std::int64_t> counts = count_all(inputs, ranks);
  forces_ = check_forces(kinds, counts, options);
  const Needs needs = find_needs(kinds, counts, options, particles.has_box);
  PartialProgress parts(progress);
  parts.set_part(0, 0.3);
  const Ids ids = load_ids(particles, "particles", executor, parts);
  if (needs.radii || needs.must_radii)
  {
    radii_ = load_radii(particles, radius);
  }
  std::array<std::int64_t, 2> known = { particles.rows > 0 ? 1 : 0, radii_.empty() ? 0 : 1 };
  ranks.sum(known);
  if (known[1] > 0 && known[1] < known[0])
  {
    throw Error("expected the same arrays on all processes, got some without an array '" + radius +
      "' of radii");
  }
  if (needs.must_radii && known[0] > 0 && known[1] == 0)
  {
    throw Error("expected an array 'delta' of the contacts, or '" + radius +
      "' of the particles, for MinimumOverlap, got neither");
  }
  const bool alone = ranks.size() == 1;
  if (needs.points || !alone)
  {
    parts.set_part(0.3, 0.4);
    own_ = view_particles(particles, {}, executor, parts);
  }
  if (known[1] > 0)
  {
    own_.arrays.push_back(view_rows("radius", ValueType::Float64, radii_.data()));
  }
  if (alone)
  {
    own_rows_ = particles.rows;
  }
  else
  {
    const IdDirectory directory(ids.values(), particles.ghosts, ranks);
    fetched_ = fetch_particles(own_, directory, list_ids(inputs), ranks);
    homes_ = directory.find(fetched_.ids, ranks);
  }
  const IdFinder finder(alone ? ids.values() : fetched_.ids, alone ? particles.ghosts : nullptr);
  repeated_ = alone ? finder.repeated() : fetched_.repeated;
  const ParticleValues& here = alone ? own_ : fetched_.values;
  ContactParticles ends = { here.points, here.point_step };
  if (!here.arrays.empty())
  {
    ends.radii = static_cast<const double*>(here.arrays[0].components[0]);
    ends.radius_step = here.arrays[0].step;
  }
  places_ = Block(2 * rows_ * sizeof(std::int64_t), pool);
  const std::span all_places(static_cast<std::int64_t*>(places_.data()), 2 * rows_);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const auto places = all_places.subspan(begin, 2 * inputs[i].count);
    const auto all = static_cast<double>(std::max<std::size_t>(all_places.size(), 1));
    parts.set_part(0.4 + 0.6 * static_cast<double>(begin) / all,
      0.4 + 0.6 * static_cast<double>(begin + places.size()) / all);
    ContactParticles own = ends;
    own.points = kinds[i].ends && !particles.has_box ? nullptr : ends.points;
    this->find_places(finder, inputs[i], kinds[i], own, options, places, executor, parts);
    inputs_.emplace_back(inputs[i], kinds[i], own, places, images_, options);
    begin += places.size();
  }
}

/// Finds the particle of each row; nowhere where it is left out.
void FoundEnds::find_places(const IdFinder& finder, const ContactRows& rows,
  const ContactKinds& kinds, const ContactParticles& particles, const ContactOptions& options,
  std::span<std::int64_t> places, const Executor& executor, Progress& progress)
{
  constexpr std::size_t at_once = 1024;
  const Needs needs = find_needs(kinds, options, particles.points != nullptr);
  std::atomic<std::int64_t> missing = 0;
  std::atomic<std::int64_t> broken = 0;
  std::atomic<std::int64_t> unplaced = 0;
  const auto find = [&](std::size_t first, std::size_t count)
  {
    std::array<std::array<std::int64_t, at_once>, 2> found;
    found[0].fill(IdFinder::nowhere);
    if (!kinds.walls)
    {
      finder.find(rows.id1.subspan(first, count), found[0].data());
    }
    finder.find(rows.id2.subspan(first, count), found[1].data());
    const bool sound = !is_broken(rows, first, count);
    std::int64_t lost = 0;
    std::int64_t bad = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      auto [one, other] = std::array{ found[0][i], found[1][i] };
      const bool lacks = other < 0 || (!kinds.walls && one < 0);
      const bool breaks = (!sound && is_broken(rows, first + i, 1)) ||
        is_broken(particles, one, needs) || is_broken(particles, other, needs);
      lost += lacks ? 1 : 0;
      bad += breaks ? 1 : 0;
      places[2 * (first + i)] = breaks ? IdFinder::nowhere : one;
      places[2 * (first + i) + 1] = breaks ? IdFinder::nowhere : other;
    }
    missing += lost;
    unplaced += kinds.ends ? 0 : lost;
    broken += bad;
  };
  executor.for_each_stretch(
    rows.count, rows_of_stretch,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      for (std::size_t done = 0; done < count; done += at_once)
      {
        find(first + done, std::min(at_once, count - done));
      }
    },
    progress);
  missing_ += missing;
  unplaced_ += unplaced;
  broken_ += broken;
}

std::vector<ParticleHome> FoundEnds::homes() const
{
  if (!homes_.empty() || own_rows_ == 0)
  {
    return homes_;
  }
  std::vector<ParticleHome> own(static_cast<std::size_t>(own_rows_));
  for (std::size_t row = 0; row < own.size(); ++row)
  {
    own[row] = { 0, static_cast<std::int64_t>(row) };
  }
  return own;
}
}
