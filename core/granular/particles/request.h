// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_request_h
#define granular_particles_request_h

#include "granular/columns/column.h"
#include "granular/frames/frame.h"
#include "granular/geometry/positions.h"
#include "granular/memory/block.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

namespace granular
{
/// The drawing of lines across periodic faces.
enum class PeriodicLines : std::uint8_t
{
  MinimumImage, ///< short, from the first end out of the box
  Split,        ///< from both ends to the faces between them: one more line for each crossed face
  AsWritten     ///< from end to end, wherever they are
};

/// The wanted part of a frame. Coordinates, order, stride and region are for dumps and data files.
struct Request
{
  /// Returns true for a wanted array; is_usual: it is wanted unless the user chooses. Empty: usual ones.
  using Choice = std::function<bool(std::string_view name, bool is_usual)>;

  Coordinates coordinates = Coordinates::Absolute;
  bool points = true;            ///< false: no points, and coordinates are columns like others
  bool single_precision = false; ///< dumps: points as float instead of double
  Vector3 point_origin = {}; ///< subtracted from the points in double before any rounding; finite
  bool sort_by_id = false;
  std::int64_t stride = 1; ///< at least 1; n keeps id mod n = 0, or every n-th row without ids
  std::array<double, 6> region = { 1, -1, 1, -1, 1, -1 }; ///< xlo xhi ylo yhi zlo zhi, closed, in
    ///< absolute coordinates; an axis with lo > hi, or of 0 0, is not restricted
  std::function<bool(std::int64_t)>
    keep_id = {}; ///< particles to keep, by id; called on any thread; empty: all. Without ids none is kept
  PeriodicLines periodic_lines = PeriodicLines::MinimumImage;
  Choice wanted = {};       ///< arrays of Tables::rows
  bool bonds = true;        ///< false: Tables::bonds stays empty
  Choice wanted_bonds = {}; ///< arrays of Tables::bonds
  bool ranges = false; ///< true: the ranges of points and arrays of dumps and data files are found
  int piece = 0; ///< part of the rows, of `pieces` in all. Cells and subdomains are read whole
  int pieces = 1;
  int threads = 1;                                  ///< at least 1; changes no result
  std::shared_ptr<BlockPool> pool = {};             ///< source of the memory; may be null
  std::size_t chunk_bytes = std::size_t{ 1 } << 18; ///< of a file, decoded by a thread at a time

  // Set by formats whose rows are read as those of a dump:
  std::optional<ColumnSchema>
    schema = {}; ///< meaning of the columns, if their names do not give it
  std::optional<FrameHeader>
    header = {}; ///< header for rows without one, such as a section of a file; rows are counted
};

/// Returns true if a choice wants an array.
bool is_wanted(const Request::Choice& choice, std::string_view name, bool is_usual = true);

/// Returns true if an array is wanted: by its own name, or by that of the vector that its columns would form if none held texts. A user
/// could only choose that vector before the texts were seen. Usual are all but position forms.
bool is_wanted(const Request::Choice& choice, const ArrayInfo& array);
}
#endif
