// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_frame_view_h
#define granular_particles_frame_view_h

#include "granular/common/value_type.h"
#include "granular/frames/frame.h"
#include "granular/geometry/positions.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
class Communicator;

/// An array in someone else's memory: rows of one or more values.
struct ArrayView
{
  std::string name = {};
  ValueType type = ValueType::Float64;      ///< up to Text, std::string
  std::vector<const void*> components = {}; ///< the first row's value of each
  std::int64_t step = 1;                    ///< values from one row to the next
  std::vector<std::string> columns = {};    ///< in local data: names of its components
  bool places = false;                      ///< in local data: x y z of an end of each line

  int size() const noexcept { return static_cast<int>(components.size()); }

  /// Returns true if each row is doubles x y z, and the rows are contiguous.
  bool are_triples() const noexcept
  {
    const auto* const first = static_cast<const double*>(components[0]);
    return type == ValueType::Float64 && size() == 3 && components[1] == first + 1 &&
      components[2] == first + 2;
  }
};

/// Returns an array whose rows are contiguous, `size` values each; those of a Text are std::string.
ArrayView view_rows(std::string name, ValueType type, const void* values, int size = 1);

/// The rows of one rank of a frame to be written. Nothing is copied: the viewed data must stay until the frame is written.
struct FrameView
{
  FrameHeader header; ///< of the frame; rows are counted when it is written, box counts if has_box
  bool has_box =
    true; ///< false: the box is made from the bounds of the particles, and local data have none
  std::int64_t rows = 0; ///< of this rank
  std::optional<ArrayView>
    points = {}; ///< three numbers a row; needed where there are rows, but of local data
  Coordinates coordinates = Coordinates::Absolute; ///< form of the points
  Vector3 point_origin = {};                       ///< subtracted from the points
  std::vector<ArrayView> arrays = {};
  std::vector<std::string> columns = {}; ///< of the file that the rows come from; may be empty
  const unsigned char* ghosts = nullptr; ///< a value a row, or null; see duplicate_row

  /// The bit of a ghost value that marks a duplicate of another rank's row, which is left out.
  static constexpr unsigned char duplicate_row = 1;

  /// Returns true if another rank has the row, too.
  bool is_duplicate(std::int64_t row) const noexcept { return is_duplicate(ghosts, row); }

  /// Returns the same by ghost values, one per row, or null.
  static bool is_duplicate(const unsigned char* ghosts, std::int64_t row) noexcept
  {
    return ghosts && (ghosts[row] & duplicate_row) != 0;
  }

  /// Returns the first array of that name, or null.
  const ArrayView* find(std::string_view name) const noexcept
  {
    const auto found = std::ranges::find(arrays, name, &ArrayView::name);
    return found == arrays.end() ? nullptr : &*found;
  }
};

/// Gives ranks without rows, whose frame may lack everything, the header, box and form of points of the first rank that has
/// rows. If no rank has rows, the first one with a box counts. Throws Error, on all ranks, if ranks with rows have different
/// boxes. Collective.
void share_header(FrameView& frame, Communicator& ranks);
}
#endif
