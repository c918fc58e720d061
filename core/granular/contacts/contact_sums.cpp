// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/contact_sums.h"

#include "granular/common/error.h"
#include "granular/contacts/find_ends.h"
#include "granular/contacts/rattlers.h"
#include "granular/contacts/sum_ends.h"
#include "granular/geometry/symmetric_tensor.h"
#include "granular/grid/sphere_box.h"
#include "granular/parallel/by_rank.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
/// Ends of contacts that all are known here.
class EndsHere
{
public:
  explicit EndsHere(const FoundEnds& found)
    : found_(found)
  {
  }

  std::size_t size() const noexcept { return 2 * found_.rows(); }

  std::int64_t place(std::int64_t end) const noexcept
  {
    const auto [ends, row] = found_.at(end / 2);
    return ends.place(row, static_cast<std::size_t>(end % 2));
  }
  ContactEnd load(std::int64_t end) const noexcept
  {
    const auto [ends, row] = found_.at(end / 2);
    return ends.load(row, static_cast<std::size_t>(end % 2));
  }
  void prefetch(std::int64_t end) const noexcept
  {
    const auto [ends, row] = found_.at(end / 2);
    ends.prefetch(row);
  }

private:
  const FoundEnds& found_;
};

/// Ends of contacts that come from the ranks which have them.
class SentEnds
{
public:
  /// Sends the ends to the ranks of their particles. Collective.
  SentEnds(const FoundEnds& found, Communicator& ranks)
  {
    const EndsHere ends(found);
    const std::vector<ParticleHome> homes = found.homes();
    const auto size = static_cast<std::size_t>(ranks.size());
    const auto home_of = [&](std::size_t end)
    {
      const std::int64_t place = ends.place(static_cast<std::int64_t>(end));
      return place < 0 ? ParticleHome{} : homes[static_cast<std::size_t>(place)];
    };
    const ByRank sorted = sort_by_rank(ends.size(), size,
      [&](std::size_t end)
      {
        const std::int64_t rank = home_of(end).rank;
        return rank < 0 ? size : static_cast<std::size_t>(rank);
      });
    std::vector<std::int64_t> rows;
    std::vector<ContactEnd> loaded;
    for (const std::int64_t end : sorted.places)
    {
      rows.push_back(home_of(static_cast<std::size_t>(end)).row);
      loaded.push_back(ends.load(end));
    }
    const std::vector<std::int64_t> come = swap_numbers(sorted.counts, ranks);
    rows_ = trade(rows, sorted.counts, come, ranks);
    ends_ = trade(loaded, sorted.counts, come, ranks);
  }

  std::size_t size() const noexcept { return rows_.size(); }
  std::int64_t place(std::int64_t end) const noexcept
  {
    return rows_[static_cast<std::size_t>(end)];
  }
  const ContactEnd& load(std::int64_t end) const noexcept
  {
    return ends_[static_cast<std::size_t>(end)];
  }
  void prefetch(std::int64_t end) const noexcept
  {
    __builtin_prefetch(&ends_[static_cast<std::size_t>(end)]);
  }

private:
  std::vector<std::int64_t> rows_;
  std::vector<ContactEnd> ends_;
};

/// The ends of the particles of each block.
template <class Source>
BlockRows sort_ends(
  const Source& source, std::int64_t rows, const Executor& executor, Progress& progress)
{
  constexpr std::size_t ends_of_chunk = 131072;
  std::vector<std::vector<BlockRows::Entry>> entries(
    (source.size() + ends_of_chunk - 1) / ends_of_chunk);
  executor.for_each_stretch(
    source.size(), ends_of_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      std::vector<BlockRows::Entry>& own = entries[first / ends_of_chunk];
      own.reserve(count);
      for (std::size_t i = 0; i < count; ++i)
      {
        const std::int64_t place = source.place(static_cast<std::int64_t>(first + i));
        if (place >= 0)
        {
          own.push_back({ static_cast<std::uint32_t>(place / EndSums::particles_of_block),
            static_cast<std::uint32_t>(i) });
        }
      }
    },
    progress);
  return BlockRows::sorted(
    entries, static_cast<std::int64_t>(ends_of_chunk), EndSums::blocks_of(rows));
}

template <class Source>
ContactSums sum_source(const Source& source, std::int64_t rows, const ContactTerms& terms,
  const ContactSumsRequest& request, const Executor& executor, PartialProgress& progress)
{
  progress.set_part(0.4, 0.6);
  const BlockRows ends = sort_ends(source, rows, executor, progress);
  EndSums sums(rows, terms, request);
  progress.set_part(0.6, 0.9);
  sums.run(source, ends, executor, progress);
  return std::move(sums.sums());
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

/// By the volume of spheres.
void add_principal(const FrameView& particles, const ContactSumsRequest& request, ContactSums& sums)
{
  const std::vector<double> radii = load_radii(particles, request.radius);
  const auto rows = static_cast<std::size_t>(particles.rows);
  if (radii.size() != rows)
  {
    throw Error("expected an array '" + request.radius +
      "' of the particles, whose volume stresses are divided by, got none");
  }
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
          to[row] = ends.place(at, 0) < 0 && ends.place(at, 1) < 0
            ? std::numeric_limits<double>::quiet_NaN()
            : ends.friction(at);
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
        particles, inputs, request.radius, request.options, ranks, executor, parts);
      const ContactTerms terms(request, found.have_forces());
      ContactSums sums = ranks.size() == 1
        ? sum_source(EndsHere(found), particles.rows, terms, request, executor, parts)
        : sum_source(SentEnds(found, ranks), particles.rows, terms, request, executor, parts);
      const std::span<const std::int32_t> counts = integers_in(sums.coordination);
      for (std::int64_t row = 0; row < particles.rows; ++row)
      {
        const bool own = !particles.is_duplicate(row);
        sums.particles += own ? 1 : 0;
        sums.contacts += own ? counts[static_cast<std::size_t>(row)] : 0;
      }
      parts.set_part(0.9, 1);
      if (terms.stress && (request.principal_stress || request.von_mises))
      {
        add_principal(particles, request, sums);
      }
      if (request.friction && found.have_forces())
      {
        sums.friction = find_friction(found, inputs, request, executor, parts);
      }
      if (request.least_contacts > 0)
      {
        add_rattlers(found, particles, request, ranks, parts, sums);
      }
      std::array<std::int64_t, 7> all = { sums.particles, sums.contacts, sums.rattling,
        sums.bearing, found.missing(), found.broken(), found.repeated() };
      ranks.sum(all);
      std::tie(sums.particles, sums.contacts, sums.rattling, sums.bearing, sums.missing,
        sums.broken, sums.repeated) = std::tuple_cat(all);
      return sums;
    });
}
}
