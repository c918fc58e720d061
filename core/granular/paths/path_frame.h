// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_path_frame_h
#define granular_paths_path_frame_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/common/value_type.h"
#include "granular/frames/frame.h"
#include "granular/frames/run_index.h"
#include "granular/geometry/box.h"
#include "granular/geometry/positions.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/request.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
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

  /// The ids that the text names by themselves, and not in ranges.
  const std::vector<std::int64_t>& named() const noexcept { return named_; }

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
  std::vector<std::int64_t> named_;
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

/// Values that are collected of each frame.
struct PathRequest
{
  IdSelection selection;
  std::vector<std::string> arrays = {}; ///< names of arrays of numbers; frames may lack them
  bool points = true;                   ///< positions, too
  bool absolute = false; ///< positions in the box also where a frame in memory has unwrapped ones
  Vector3 origin = {};   ///< subtracted from the positions
};

/// An array of selected particles: 64-bit integers, or doubles by their bits.
struct PathArray
{
  std::string name;
  int size = 0; ///< numbers a particle; 0: the frame does not have the array
  bool integers = true;
  std::vector<std::int64_t> words = {}; ///< size numbers a particle
};

/// The selected particles of a frame, or those of them that a rank has, in any order.
struct PathFrame
{
  bool loaded = false; ///< this rank knows the header
  FrameHeader header = {};
  Coordinates coordinates = Coordinates::Absolute; ///< of the points: Absolute or Unwrapped
  std::vector<std::int64_t> ids = {};
  bool has_rows = false;                 ///< the rows are known
  std::vector<std::int64_t> rows = {};   ///< of each particle in its frame, from 0
  std::vector<double> points = {};       ///< x y z a particle, less the origin of the request
  bool has_images = false;               ///< the image counts of absolute points are known
  std::vector<std::int64_t> images = {}; ///< three a particle
  std::vector<PathArray> arrays = {};    ///< in the order of the request
};

/// Picks the selected particles of a frame in memory, with their rows counted from first_row. Ghost duplicates are left out.
/// Throws Error if there are particles without an array `id`, with an id that is not an integer, or with texts in a wanted
/// array; Cancelled. spent: a frame that is no longer needed, whose memory is used again.
PathFrame pick_particles(const FrameView& frame, const PathRequest& request, std::int64_t first_row,
  const Executor& executor, Progress& progress, PathFrame spent = {});

/// Reads the selected particles of a frame of a dump, or of part base.piece of base.pieces of it: only the columns that this
/// takes. base also has the form of the points (Absolute or Unwrapped), region, stride, threads and memory pool. Throws what
/// read_dump and pick_particles throw.
PathFrame read_particles(const std::vector<FramePiece>& pieces, const PathRequest& request,
  const Request& base, Notices& notices, Progress& progress, PathFrame spent = {});

/// Returns the ids of the particles whose points are in a region.
std::vector<std::int64_t> ids_in_region(const PathFrame& frame, Region region);

/// Throws Error on all ranks if an id repeats in a frame, of which each rank has some particles: with both rows. name_rows is
/// called on one rank before, and throws if it can name the file; it may be empty. Collective.
void expect_distinct_ids(const PathFrame& frame,
  const std::function<void(std::int64_t id)>& name_rows, Communicator& ranks);

/// Throws Error that names the id and its first two rows among the particles of a frame.
[[noreturn]] void throw_repeated(std::int64_t id, std::int64_t timestep, std::int64_t first_row,
  std::int64_t second_row, const Where& where = {});

/// Gives all ranks the headers of all frames, and the same arrays in each: their sizes and kinds. Frames without particles
/// take what others have. Returns the names of the arrays that no frame with particles has; they are one nan a particle. Throws
/// Error on all ranks if frames differ in the size of an array. Collective.
std::vector<std::string> share_kinds(std::vector<PathFrame>& frames, Communicator& ranks);

/// Throws Error with the first name, if there is any.
void expect_none(const std::vector<std::string>& lacking);

/// Returns the first ids of all ranks but the first, among which particles of such frames are shared evenly: lower ranks have
/// smaller ids. The same on all ranks. Collective.
std::vector<std::int64_t> share_out(const std::vector<PathFrame>& frames, Communicator& ranks);

/// Moves particles to the ranks that have them in all frames. Particles of a frame keep their order: by rank, then as they
/// were. Collective.
void exchange_frames(
  std::vector<PathFrame>& frames, const std::vector<std::int64_t>& first_ids, Communicator& ranks);
}
#endif
