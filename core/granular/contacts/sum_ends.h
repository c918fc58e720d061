// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_sum_ends_h
#define granular_contacts_sum_ends_h

#include "granular/contacts/contact_sums.h"
#include "granular/contacts/contact_terms.h"
#include "granular/geometry/rounded_sums.h"
#include "granular/parallel/executor.h"
#include "granular/sorting/block_rows.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Sums of the contacts of some particles.
class EndSums
{
public:
  /// Particles whose sums fit into the cache of a core.
  static constexpr std::int64_t particles_of_block = 512;

  /// rows: particles. Memory comes from the pool of the request.
  EndSums(std::int64_t rows, const ContactTerms& terms, const ContactSumsRequest& request)
    : rows_(rows)
    , terms_(terms)
    , sums_(make(rows, terms, request))
  {
  }

  /// Sums the ends of a source: source.place(end) is the particle, source.load(end) the contact as it feels it,
  /// source.prefetch(end) brings it into the cache. ends: those of each block of particles.
  template <class Source>
  void run(
    const Source& source, const BlockRows& ends, const Executor& executor, Progress& progress)
  {
    const auto blocks = static_cast<std::size_t>(blocks_of(rows_));
    std::vector<Room> rooms(executor.workers(blocks));
    executor.parallel_for(
      blocks,
      [&](std::size_t block, std::size_t worker)
      { this->sum_block(source, ends, static_cast<std::int64_t>(block), rooms[worker]); },
      progress);
  }

  ContactSums& sums() noexcept { return sums_; }

  static std::int64_t blocks_of(std::int64_t rows) noexcept
  {
    return (rows + particles_of_block - 1) / particles_of_block;
  }

private:
  using Sums = RoundedSums<ContactTerms::most>;
  using Terms = std::array<double, ContactTerms::most>;

  /// What a thread works with.
  struct Room
  {
    std::vector<Sums> sums;
    std::vector<std::int32_t> counts;  ///< contacts that count
    std::vector<std::int32_t> normals; ///< those that have a normal
    std::vector<std::int64_t> ends;    ///< of a block
    std::vector<std::int64_t> again;   ///< of one particle
  };

  static ContactSums make(
    std::int64_t rows, const ContactTerms& terms, const ContactSumsRequest& request)
  {
    const auto room = [&](bool wanted, std::size_t bytes)
    { return wanted ? Block(static_cast<std::size_t>(rows) * bytes, request.pool) : Block(); };
    ContactSums sums;
    sums.coordination = room(true, sizeof(std::int32_t));
    sums.force = room(terms.force, 3 * sizeof(double));
    sums.torque = room(terms.torque, 3 * sizeof(double));
    sums.fabric = room(terms.fabric, 6 * sizeof(double));
    sums.stress = room(terms.stress, 6 * sizeof(double));
    return sums;
  }

  template <class Source>
  void sum_block(const Source& source, const BlockRows& block_ends, std::int64_t block, Room& room)
  {
    constexpr std::size_t ahead = 16;
    const std::int64_t first = block * particles_of_block;
    const auto size = static_cast<std::size_t>(std::min(rows_ - first, particles_of_block));
    room.sums.assign(size, {});
    room.counts.assign(size, 0);
    room.normals.assign(size, 0);
    room.ends.resize(static_cast<std::size_t>(block_ends.count(block)));
    const std::span<const std::int64_t> ends =
      block_ends.rows(block, 0, block_ends.count(block), room.ends);
    Terms terms;
    for (std::size_t i = 0; i < ends.size(); ++i)
    {
      source.prefetch(ends[std::min(i + ahead, ends.size() - 1)]);
      const ContactEnd contact = source.load(ends[i]);
      const auto place = static_cast<std::size_t>(source.place(ends[i]) - first);
      terms_.make(contact, terms.data());
      room.sums[place].add(std::span(terms).first(terms_.count));
      room.counts[place] += contact.counts != 0 ? 1 : 0;
      room.normals[place] += contact.counts != 0 && contact.normal != Vector3{} ? 1 : 0;
    }
    for (std::size_t place = 0; place < size; ++place)
    {
      bool all = true;
      for (std::size_t i = 0; i < terms_.count; ++i)
      {
        all = room.sums[place].round(i, terms[i]) && all;
      }
      if (!all)
      {
        this->sum_again(source, ends, first + static_cast<std::int64_t>(place), room, terms);
      }
      this->store(static_cast<std::size_t>(first) + place, room.counts[place], room.normals[place],
        terms.data());
    }
  }

  /// Exactly, where it is not known how a sum is rounded.
  template <class Source>
  void sum_again(const Source& source, std::span<const std::int64_t> ends, std::int64_t particle,
    Room& room, Terms& sums) const
  {
    room.again.clear();
    std::ranges::copy_if(ends, std::back_inserter(room.again),
      [&](std::int64_t end) { return source.place(end) == particle; });
    std::array<ExactSum, ContactTerms::most> exact;
    Terms terms;
    for (const std::int64_t end : room.again)
    {
      terms_.make(source.load(end), terms.data());
      for (std::size_t i = 0; i < terms_.count; ++i)
      {
        exact[i].add(terms[i]);
      }
    }
    for (std::size_t i = 0; i < terms_.count; ++i)
    {
      sums[i] = exact[i].value();
    }
  }

  void store(std::size_t row, std::int32_t count, std::int32_t normals, const double* terms)
  {
    static_cast<std::int32_t*>(sums_.coordination.data())[row] = count;
    const auto take = [&](bool wanted, const Block& block, std::size_t width, double divisor)
    {
      double* const to = static_cast<double*>(block.data()) + width * row;
      for (std::size_t i = 0; wanted && i < width; ++i)
      {
        to[i] = *terms++ / divisor;
      }
    };
    take(terms_.force, sums_.force, 3, 1);
    take(terms_.torque, sums_.torque, 3, 1);
    take(terms_.fabric, sums_.fabric, 6, std::max(normals, 1));
    take(terms_.stress, sums_.stress, 6, 1);
  }

  std::int64_t rows_;
  ContactTerms terms_;
  ContactSums sums_;
};
}
#endif
