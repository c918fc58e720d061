// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_id_finder_h
#define granular_lines_id_finder_h

#include "granular/parallel/communicator.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// Returns a 64-bit hash that spreads even regular ids. After Mix13 of David Stafford.
inline std::uint64_t hash_of_id(std::int64_t id) noexcept
{
  auto hash = static_cast<std::uint64_t>(id);
  hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9;
  hash = (hash ^ hash >> 27) * 0x94d049bb133111eb;
  return hash ^ hash >> 31;
}

/// A growing hash table from ids, which may be any 64-bit integers, to places.
class IdTable
{
public:
  static constexpr std::int64_t nowhere = -1;

  IdTable() noexcept = default;

  /// Reserves room for this many ids. Throws std::bad_alloc.
  explicit IdTable(std::size_t ids);

  /// Stores a place >= 0 for an id. Returns false if the id has a place, which stays. Throws std::bad_alloc.
  bool add(std::int64_t id, std::int64_t place);

  /// Returns the place of an id, or nowhere.
  std::int64_t find(std::int64_t id) const noexcept
  {
    return taken_ == 0 ? nowhere : this->slot(id).place;
  }

  /// Prefetches the memory that add and find need.
  void prefetch(std::int64_t id) const noexcept
  {
    __builtin_prefetch(slots_.data() + (hash_of_id(id) & mask_));
  }

private:
  struct Slot
  {
    std::int64_t id = 0;
    std::int64_t place = nowhere;
  };

  /// Returns the slot of an id, or the free slot where it would be. At most half of the slots are taken.
  const Slot& slot(std::int64_t id) const noexcept
  {
    std::size_t i = hash_of_id(id) & mask_;
    while (slots_[i].place != nowhere && slots_[i].id != id)
    {
      i = (i + 1) & mask_;
    }
    return slots_[i];
  }

  void grow();

  std::vector<Slot> slots_; ///< none, or a power of two
  std::size_t mask_ = 0;
  std::size_t taken_ = 0;
};

/// Finds the index of an id in a list of ids. Dense ids use a plain table, others a hash table; both take at most 64
/// bytes per id.
class IdFinder
{
public:
  static constexpr std::int64_t nowhere = IdTable::nowhere;

  IdFinder() noexcept = default;

  /// The place of ids[i] is i; of equal ids the first counts. Ids whose ghost value (one per id, or null) marks a
  /// duplicate are left out: FrameView::is_duplicate. Throws std::bad_alloc.
  explicit IdFinder(std::span<const std::int64_t> ids, const unsigned char* ghosts = nullptr);

  /// Returns the number of ids that repeat an earlier one.
  std::int64_t repeated() const noexcept { return repeated_; }

  /// Stores the place of each id, or nowhere. May be called from any thread.
  void find(std::span<const std::int64_t> ids, std::int64_t* places) const noexcept;

private:
  std::int64_t lowest_ = 0;
  std::vector<std::int32_t>
    direct_; ///< the places of lowest and those that follow; empty: not used
  IdTable table_;
  std::int64_t repeated_ = 0;
};

/// Returns the ids in two lists of the same size, each once, in the order in which they first occur: first[0], second[0],
/// first[1] and so on. Throws std::bad_alloc.
std::vector<std::int64_t> distinct_ids(
  std::span<const std::int64_t> first, std::span<const std::int64_t> second);

/// The rank that owns a particle, and the row there; rank -1: no rank owns it.
struct ParticleHome
{
  std::int64_t rank = -1;
  std::int64_t row = 0;
};

/// An id that repeats, and the rows of both particles, counted from 0 over all ranks in rank order.
struct RepeatedId
{
  std::int64_t id = 0;
  std::int64_t first_row = 0;
  std::int64_t second_row = 0;
};

/// The homes of the particles of all ranks. Each id is assigned to a rank by its hash; that rank keeps the home. No rank needs
/// memory for more than its own particles, its share of the ids, and its questions.
class IdDirectory
{
public:
  /// ids: of the particles of this rank, one a row. Ids whose ghost value (one per id, or null) marks a duplicate are left
  /// out. Of particles with the same id, the first of the lowest rank counts. Collective.
  IdDirectory(std::span<const std::int64_t> ids, const unsigned char* ghosts, Communicator& ranks);

  /// Returns the number of ids kept on this rank that repeat an earlier one.
  std::int64_t repeated() const noexcept { return finder_.repeated(); }

  /// Returns, on all ranks, the id whose second row is the first that has an id again. Collective.
  std::optional<RepeatedId> find_repeated(Communicator& ranks) const;

  /// Throws Error on all ranks if an id repeats: names the id and both rows. whose: "particles". Collective.
  void expect_distinct(const std::string& whose, Communicator& ranks) const;

  /// Returns the home of each id. Collective.
  std::vector<ParticleHome> find(std::span<const std::int64_t> ids, Communicator& ranks) const;

private:
  std::vector<ParticleHome> find_kept(const std::vector<std::int64_t>& ids) const;
  ParticleHome home(std::int64_t place) const;

  std::vector<std::int64_t> ids_; ///< kept here, in the order of ranks and their rows
  IdFinder finder_;
  std::vector<std::int64_t> rows_;   ///< of each id
  std::vector<std::int64_t> ends_;   ///< behind the ids of each rank
  std::vector<std::int64_t> begins_; ///< number of the first row of each rank
};
}
#endif
