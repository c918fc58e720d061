// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_id_finder_h
#define granular_local_id_finder_h

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Spreads ids, however regular, over 64 bits. After Mix13 of David Stafford.
inline std::uint64_t hash_of_id(std::int64_t id) noexcept
{
  auto hash = static_cast<std::uint64_t>(id);
  hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9;
  hash = (hash ^ hash >> 27) * 0x94d049bb133111eb;
  return hash ^ hash >> 31;
}

/// Ids, each with a place, in a hash table that grows: any 64-bit integers.
class IdTable
{
public:
  static constexpr std::int64_t nowhere = -1;

  IdTable() noexcept = default;

  /// Room for so many ids, before it must grow. Throws std::bad_alloc.
  explicit IdTable(std::size_t ids);

  /// Gives an id a place >= 0; false: it has one, and keeps it. Throws std::bad_alloc.
  bool add(std::int64_t id, std::int64_t place);

  /// Its place, or nowhere.
  std::int64_t find(std::int64_t id) const noexcept
  {
    return taken_ == 0 ? nowhere : this->slot(id).place;
  }

  /// Brings into the cache what add and find need.
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

  /// That of the id, or the free one where it would be: never more than half of them are taken.
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

/// Finds where an id is in a list of ids. Where these are close together it looks into a plain table, else
/// into a hash table; neither needs more than 64 bytes an id.
class IdFinder
{
public:
  static constexpr std::int64_t nowhere = IdTable::nowhere;

  IdFinder() noexcept = default;

  /// The place of ids[i] is i; of equal ids the first counts. Left out are those of which their ghost value, one an
  /// id or null, says so: FrameView::is_duplicate. Throws std::bad_alloc.
  explicit IdFinder(std::span<const std::int64_t> ids, const unsigned char* ghosts = nullptr);

  /// Ids that an earlier one is equal to.
  std::int64_t repeated() const noexcept { return repeated_; }

  /// The place of each, or nowhere. From any thread.
  void find(std::span<const std::int64_t> ids, std::int64_t* places) const noexcept;

private:
  std::int64_t lowest_ = 0;
  std::vector<std::int64_t>
    direct_; ///< the places of lowest and those that follow; empty: not used
  IdTable table_;
  std::int64_t repeated_ = 0;
};
}
#endif
