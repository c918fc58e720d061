// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/contact_sums.h"

#include "granular/common/error.h"
#include "granular/contacts/find_ends.h"
#include "granular/contacts/sum_ends.h"
#include "granular/grid/sphere_box.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <tuple>

namespace granular
{
namespace
{
using Matrix = std::array<Vector3, 3>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Divides a tensor by a power of two, so that nothing over- or underflows. Returns false if it is not finite.
bool scale(SymmetricTensor& tensor, int& power) noexcept
{
  double largest = 0;
  for (const double value : tensor)
  {
    largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : HUGE_VAL;
  }
  power = largest > 0 ? std::ilogb(largest) : 0;
  for (double& value : tensor)
  {
    value = std::ldexp(value, -power);
  }
  return largest < HUGE_VAL;
}

/// Turns the axes p and q so that a[p][q] becomes 0 (C. G. J. Jacobi, J. Reine Angew. Math. 30, 1846).
void rotate(Matrix& a, std::size_t p, std::size_t q) noexcept
{
  if (a[p][q] == 0)
  {
    return;
  }
  const double half = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double tangent = std::copysign(1.0, half) / (std::abs(half) + std::hypot(1.0, half));
  const double cosine = 1 / std::hypot(1.0, tangent);
  const double sine = tangent * cosine;
  const std::size_t r = 3 - p - q;
  const double shift = tangent * a[p][q];
  a[p][p] -= shift;
  a[q][q] += shift;
  a[p][q] = a[q][p] = 0;
  const double rp = a[r][p];
  const double rq = a[r][q];
  a[r][p] = a[p][r] = cosine * rp - sine * rq;
  a[r][q] = a[q][r] = sine * rp + cosine * rq;
}

/// Makes the terms of some ends; those of both ends of a contact at once, where they follow each other.
void read_ends(const FoundEnds& found, const ContactTerms& terms,
  std::span<const std::size_t> wanted, EndTerms* to) noexcept
{
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    const std::size_t contact = wanted[i] / 2;
    const auto [ends, row] = found.at(static_cast<std::int64_t>(contact));
    std::array<EndTerms*, 2> both = {};
    both[wanted[i] % 2] = to + i;
    if (i + 1 < wanted.size() && wanted[i + 1] / 2 == contact)
    {
      ++i;
      both[wanted[i] % 2] = to + i;
    }
    terms.make(ends, row, both);
  }
}

/// Ends of contacts that come from the ranks which have them.
struct SentEnds
{
  std::vector<std::int64_t> rows;
  std::vector<Counted> counted;
  std::vector<double> terms;
};

/// Sends the ends to the ranks of their particles. Collective.
SentEnds send_ends(const FoundEnds& found, const ContactTerms& terms, Communicator& ranks,
  const Executor& executor, Progress& progress)
{
  const std::vector<ParticleHome> homes = found.homes();
  const auto size = static_cast<std::size_t>(ranks.size());
  const auto home_of = [&](std::size_t end)
  {
    const std::int64_t place = found.places()[end];
    return place < 0 ? ParticleHome{} : homes[static_cast<std::size_t>(place)];
  };
  const ByRank sorted = sort_by_rank(found.places().size(), size,
    [&](std::size_t end)
    {
      const std::int64_t rank = home_of(end).rank;
      return rank < 0 ? size : static_cast<std::size_t>(rank);
    });
  std::vector<std::int64_t> rows(sorted.places.size());
  std::vector<Counted> counted(rows.size());
  std::vector<double> all(terms.count * rows.size());
  executor.for_each_stretch(
    rows.size(), 256,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      const std::vector<std::size_t> wanted(
        sorted.places.begin() + static_cast<std::ptrdiff_t>(first),
        sorted.places.begin() + static_cast<std::ptrdiff_t>(first + count));
      std::vector<EndTerms> made(count);
      read_ends(found, terms, wanted, made.data());
      for (std::size_t i = 0; i < count; ++i)
      {
        rows[first + i] = home_of(wanted[i]).row;
        counted[first + i] = made[i].counted;
        std::copy_n(made[i].terms.data(), terms.count, all.data() + terms.count * (first + i));
      }
    },
    progress);
  const std::vector<std::int64_t> come = swap_numbers(sorted.counts, ranks);
  return { trade(rows, sorted.counts, come, ranks), trade(counted, sorted.counts, come, ranks),
    trade(all, sorted.counts, come, ranks, terms.count) };
}

/// Sums the ends of all ranks for the particles of this one. Collective.
ContactSums sum_all_ends(const FoundEnds& found, const ContactTerms& terms, std::int64_t rows,
  const ContactSumsRequest& request, Communicator& ranks, const Executor& executor,
  PartialProgress& parts)
{
  parts.set_part(0.4, 0.5);
  SentEnds sent;
  EndSource source;
  source.places = found.places();
  source.read = [&](std::span<const std::size_t> wanted, EndTerms* to)
  { read_ends(found, terms, wanted, to); };
  if (ranks.size() > 1)
  {
    sent = send_ends(found, terms, ranks, executor, parts);
    source.places = sent.rows;
    source.read = [&](std::span<const std::size_t> wanted, EndTerms* to)
    {
      for (const std::size_t end : wanted)
      {
        to->counted = sent.counted[end];
        std::copy_n(sent.terms.data() + terms.count * end, terms.count, to->terms.data());
        ++to;
      }
    };
  }
  parts.set_part(0.5, 0.9);
  return sum_ends(source, rows, terms, request, executor, parts);
}

std::span<const std::int32_t> integers_in(const Block& block) noexcept
{
  return { static_cast<const std::int32_t*>(block.data()), block.bytes() / sizeof(std::int32_t) };
}

template <class Value>
Block block_of(const std::vector<Value>& values, const std::shared_ptr<BlockPool>& pool)
{
  Block block(values.size() * sizeof(Value), pool);
  if (!values.empty())
  {
    std::memcpy(block.data(), values.data(), values.size() * sizeof(Value));
  }
  return block;
}

std::vector<double> radii_of_volumes(const FrameView& particles, const std::string& name)
{
  std::vector<double> radii = load_radii(particles, name);
  if (radii.size() != static_cast<std::size_t>(particles.rows))
  {
    throw Error("expected an array '" + name +
      "' of the particles, whose volume stresses are divided by, got none");
  }
  return radii;
}

/// By the volume of spheres.
void add_principal(
  std::span<const double> radii, const ContactSumsRequest& request, ContactSums& sums)
{
  const std::size_t rows = radii.size();
  const auto room = [&](bool wanted, std::size_t width)
  { return wanted ? Block(width * rows * sizeof(double), request.pool) : Block(); };
  sums.principal_stress = room(request.principal_stress, 3);
  sums.von_mises = room(request.von_mises, 1);
  const auto* const stresses = static_cast<const double*>(sums.stress.data());
  for (std::size_t row = 0; row < rows; ++row)
  {
    const double volume = sphere_volume(radii[row]);
    SymmetricTensor stress = {};
    for (std::size_t i = 0; i < stress.size(); ++i)
    {
      const double value = stresses[6 * row + i];
      stress[i] = value == 0 ? 0 : value / volume;
    }
    if (request.principal_stress)
    {
      const Vector3 values = principal_values(stress);
      std::ranges::copy(values, static_cast<double*>(sums.principal_stress.data()) + 3 * row);
    }
    if (request.von_mises)
    {
      static_cast<double*>(sums.von_mises.data())[row] = von_mises(stress);
    }
  }
  if (!request.stress)
  {
    sums.stress = Block();
  }
}

std::vector<Block> find_friction(const FoundEnds& found, std::span<const ContactRows> inputs,
  const ContactSumsRequest& request, const Executor& executor, Progress& progress)
{
  std::vector<Block> friction;
  std::size_t begin = 0;
  for (const ContactRows& rows : inputs)
  {
    friction.emplace_back(rows.count * sizeof(double), request.pool);
    auto* const to = static_cast<double*>(friction.back().data());
    executor.for_each_stretch(
      rows.count, 65536,
      [&](std::size_t first, std::size_t count, std::size_t)
      {
        for (std::size_t row = first; row < first + count; ++row)
        {
          const auto [ends, at] = found.at(static_cast<std::int64_t>(begin + row));
          to[row] =
            ends.has_line(at) ? ends.friction(at) : std::numeric_limits<double>::quiet_NaN();
        }
      },
      progress);
    begin += rows.count;
  }
  return friction;
}

void add_rattlers(const FoundEnds& found, const FrameView& particles,
  const ContactSumsRequest& request, Communicator& ranks, Progress& progress, ContactSums& sums)
{
  std::vector<ContactPair> pairs;
  for (std::size_t i = 0; i < found.rows(); ++i)
  {
    const auto [ends, row] = found.at(static_cast<std::int64_t>(i));
    const ContactPair pair = { ends.place(row, 0), ends.place(row, 1) };
    if ((pair[0] >= 0 || pair[1] >= 0) && ends.counts(row) != 0)
    {
      pairs.push_back(pair);
    }
  }
  const std::vector<ParticleHome> homes = found.homes();
  const Rattlers rattlers = find_rattlers(
    homes, pairs, integers_in(sums.coordination), request.least_contacts, ranks, progress);
  for (std::size_t row = 0; row < rattlers.are.size(); ++row)
  {
    if (!particles.is_duplicate(static_cast<std::int64_t>(row)))
    {
      sums.rattling += rattlers.are[row];
      sums.bearing += rattlers.contacts[row];
    }
  }
  sums.rattlers = block_of(rattlers.are, request.pool);
  sums.backbone = block_of(rattlers.contacts, request.pool);
}
}

Vector3 principal_values(SymmetricTensor tensor) noexcept
{
  int power = 0;
  if (!scale(tensor, power))
  {
    return { nan, nan, nan };
  }
  const auto& [xx, yy, zz, xy, xz, yz] = tensor;
  Matrix a = { { { xx, xy, xz }, { xy, yy, yz }, { xz, yz, zz } } };
  for (int sweep = 0; sweep < 12 && (a[0][1] != 0 || a[0][2] != 0 || a[1][2] != 0); ++sweep)
  {
    rotate(a, 0, 1);
    rotate(a, 0, 2);
    rotate(a, 1, 2);
  }
  Vector3 values = { std::ldexp(a[0][0], power), std::ldexp(a[1][1], power),
    std::ldexp(a[2][2], power) };
  std::ranges::sort(values, std::greater<>());
  return values;
}

double von_mises(SymmetricTensor tensor) noexcept
{
  int power = 0;
  if (!scale(tensor, power))
  {
    return nan;
  }
  const auto& [xx, yy, zz, xy, xz, yz] = tensor;
  const double normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
  return std::ldexp(std::sqrt(normal / 2 + 3 * (xy * xy + xz * xz + yz * yz)), power);
}

ContactSums sum_contacts(const FrameView& particles, std::span<const ContactRows> inputs,
  const ContactSumsRequest& request, Communicator& ranks, Progress& progress)
{
  SharedProgress shared(progress, ranks);
  PartialProgress parts(shared);
  return do_together(ranks,
    [&]
    {
      const Executor executor(request.threads);
      parts.set_part(0, 0.4);
      const FoundEnds found(
        particles, inputs, request.radius, request.options, ranks, executor, parts, request.pool);
      const ContactTerms terms(request, found.have_forces());
      const bool principal = terms.stress && (request.principal_stress || request.von_mises);
      const std::vector<double> radii =
        principal ? radii_of_volumes(particles, request.radius) : std::vector<double>();
      ContactSums sums =
        sum_all_ends(found, terms, particles.rows, request, ranks, executor, parts);
      const std::span<const std::int32_t> counts = integers_in(sums.coordination);
      for (std::int64_t row = 0; row < particles.rows; ++row)
      {
        const bool own = !particles.is_duplicate(row);
        sums.particles += own ? 1 : 0;
        sums.contacts += own ? counts[static_cast<std::size_t>(row)] : 0;
      }
      parts.set_part(0.9, 1);
      if (principal)
      {
        add_principal(radii, request, sums);
      }
      if (request.friction && found.have_forces())
      {
        sums.friction = find_friction(found, inputs, request, executor, parts);
      }
      if (request.least_contacts > 0)
      {
        add_rattlers(found, particles, request, ranks, parts, sums);
      }
      std::array<std::int64_t, 8> all = { sums.particles, sums.contacts, sums.rattling,
        sums.bearing, found.missing(), found.unplaced(), found.broken(), found.repeated() };
      ranks.sum(all);
      std::tie(sums.particles, sums.contacts, sums.rattling, sums.bearing, sums.missing,
        sums.unplaced, sums.broken, sums.repeated) = std::tuple_cat(all);
      return sums;
    });
}
}
