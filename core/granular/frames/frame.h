// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_frame_h
#define granular_frames_frame_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/geometry/box.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace granular
{
/// Whose bytes a dump has.
enum class Dialect : std::uint8_t
{
  Liggghts, ///< box with six digits, or all where these are too few; binary without names, dump custom with trailing blanks
  Lammps    ///< box with 17 digits, binary of revision 2 with names
};

/// What the header of one frame of a dump says.
struct FrameHeader
{
  std::int64_t timestep = 0;
  std::optional<double> time; ///< ITEM: TIME, in the units of the simulation
  std::string label; ///< ITEM: LABEL, LIGGGHTS' `dump_modify label`: any words of the user's
  std::string units; ///< ITEM: UNITS of this frame or an earlier one of the file
  std::int64_t rows = 0;
  Box box;
  std::string counted = "ATOMS";       ///< what rows are: ITEM: NUMBER OF ...
  bool has_box = true;                 ///< false: the box is none, of no size
  std::optional<Dialect> dialect = {}; ///< of the header, where it can be told
  std::vector<int>
    digits = {}; ///< of a text: the most that a real number of each column has in the first rows, 0 if none is seen
};

/// What many frames have in common.
struct FrameKind
{
  static constexpr int text = -1;
  static constexpr int bare = -2; ///< text, too, rows without a header

  ColumnSchema schema;
  std::string units;
  int layout = text; ///< below FileFormat::layouts: which of them; or text, or bare
  bool named = true; ///< false: nobody has named the columns of a binary file, these are stand-ins
  bool guessed = false;         ///< nobody has, and they are taken for those of dump atom
  std::uint64_t names_hash = 0; ///< of the columns; set where the kind is shared

  bool is_text() const noexcept { return layout < 0; }
  bool operator==(const FrameKind&) const = default;
};

/// The kinds of the frames of a run, each held once. Several threads may share them.
class FrameKinds
{
public:
  std::shared_ptr<const FrameKind> share(FrameKind kind);

  /// The one that was shared last, or null: the next frame is mostly of the same kind.
  std::shared_ptr<const FrameKind> last() const;

private:
  mutable std::mutex mutex_;
  std::shared_ptr<const FrameKind> last_;
  std::vector<std::shared_ptr<const FrameKind>> kinds_;
};

/// Where a frame lies in its file, and what is needed to find it among others. There may be millions:
/// all else is read again from the frame's header when the frame is.
struct FrameEntry
{
  static constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::uint64_t whole = 0; ///< shape of what is no piece by what is in the file

  std::int64_t timestep = 0;
  std::int64_t rows = 0;
  std::int64_t offset = 0; ///< of the header
  std::int64_t end = 0;
  std::int64_t line = 0;       ///< of the header, from 1; binary: 0
  double time = no_time;       ///< of the header
  std::uint64_t shape = whole; ///< hash of the box and the names of the columns: see hash_shape
  std::shared_ptr<const FrameKind> kind;
};

/// What frames of one timestep must share to be pieces of one: a hash of the box and the column names.
std::uint64_t hash_shape(const FrameHeader& header, const FrameKind& kind);

/// The place of a frame: the line of its header, or the byte in a binary file.
Where where_of(const std::string& path, const FrameEntry& entry);

/// Makes sure that the header found at the place of a frame is the one that was there when the file
/// was indexed; columns are the names in it, or none if it names none; units are its own, or empty. Throws IoError.
void check_header(const std::string& path, const FrameEntry& entry, const FrameHeader& header,
  const std::vector<std::string>& columns);

/// The same of cells, which frames of other files have instead of rows.
void check_cells(const FrameEntry& entry, std::int64_t cells, const Where& where);
}
#endif
