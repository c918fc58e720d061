// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_id_directory_h
#define granular_local_id_directory_h

#include "granular/local/id_finder.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace granular
{
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
