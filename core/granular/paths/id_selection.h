// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_id_selection_h
#define granular_paths_id_selection_h

#include "granular/lines/id_finder.h"
#include "granular/parallel/communicator.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace granular
{
/// A list of ids, made for asking often: where they are near each other each has a bit, otherwise they are hashed.
class IdSet
{
public:
  IdSet() = default;

  explicit IdSet(std::span<const std::int64_t> ids);

  bool contains(std::int64_t id) const noexcept
  {
    // without a sign: below the lowest is more than there are
    const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(lowest_);
    return at < 64 * bits_.size() ? (bits_[at / 64] >> at % 64 & 1) != 0
                                  : table_.find(id) != IdTable::nowhere;
  }

private:
  std::int64_t lowest_ = 0;
  std::vector<std::uint64_t> bits_;
  IdTable table_;
};

/// A choice of ids.
class IdSelection
{
public:
  /// Selects all ids.
  IdSelection() = default;

  /// Selects the ids in a text: ids and ranges, separated by blanks or commas. 10-20 is a range with both ends, 100-900:50
  /// every fiftieth id from 100 on. An empty text selects all ids. Throws Error with the word that is neither.
  explicit IdSelection(std::string_view text);

  /// Leaves only the multiples of n, at least 1.
  void keep_multiples(std::int64_t n) noexcept { multiple_ = n; }

  /// Leaves only the ids of a list.
  void keep_only(std::span<const std::int64_t> ids);

  bool is_all() const noexcept { return !listed_ && !narrowed_ && multiple_ == 1; }

  bool holds(std::int64_t id) const noexcept
  {
    return (multiple_ == 1 || id % multiple_ == 0) && (!listed_ || this->is_listed(id)) &&
      (!narrowed_ || narrow_.contains(id));
  }

private:
  struct Range
  {
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::int64_t step = 1;
  };

  static Range read_range(std::string_view word);
  bool is_listed(std::int64_t id) const noexcept;

  bool listed_ = false;
  IdSet ids_;                 ///< of short ranges
  std::vector<Range> ranges_; ///< the long ones
  bool narrowed_ = false;
  IdSet narrow_;
  std::int64_t multiple_ = 1;
};

/// Returns the different ids of all ranks, ascending, on all ranks. Collective; for selected ones.
std::vector<std::int64_t> share_ids(std::span<const std::int64_t> ids, Communicator& ranks);

/// Returns at most `count` of the different ids of all ranks, ascending: those with the smallest hashes, which depend on
/// the seed. Hence the ranks on which particles are, and their order, do not matter. Collective.
std::vector<std::int64_t> sample_ids(
  std::span<const std::int64_t> ids, std::size_t count, std::int64_t seed, Communicator& ranks);
}
#endif
