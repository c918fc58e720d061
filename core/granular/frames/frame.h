// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_frame_h
#define granular_frames_frame_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace granular
{
/// The program whose format a dump has.
enum class Dialect : std::uint8_t
{
  Liggghts, ///< box with six digits, or all where these are too few; binary without names, dump custom with trailing blanks
  Lammps    ///< box with 17 digits, binary of revision 2 with names
};

/// The header of one frame of a dump.
struct FrameHeader
{
  std::int64_t timestep = 0;
  std::optional<double> time; ///< ITEM: TIME, in the units of the simulation
  std::string label; ///< ITEM: LABEL, LIGGGHTS' `dump_modify label`: any words of the user's
  std::string units; ///< ITEM: UNITS of this frame or an earlier one of the file
  std::int64_t rows = 0;
  Box box;
  Vector3
    box_rounding = {}; ///< how far bounds may be off along each axis by the digits of a text; round numbers are not
  std::string counted = "ATOMS";       ///< name of rows: ITEM: NUMBER OF ...
  bool has_box = true;                 ///< false: there is no box, and its size is 0
  std::optional<Dialect> dialect = {}; ///< of the header, if known
  std::vector<int>
    digits = {}; ///< in text, the largest number of digits in a real number of each column in the first rows; 0: none was seen
  std::array<std::int64_t, 3>
    cells = {}; ///< of a grid, along each edge of the box; rows are all of them
};

/// Returns the schema of a binary dump, in which an element is written as its type.
ColumnSchema binary_schema(const std::vector<std::string>& names);

/// Properties that many frames share.
struct FrameKind
{
  static constexpr int text = -1;
  static constexpr int bare = -2; ///< text, too, rows without a header

  ColumnSchema schema;
  std::string units;
  int layout = text;    ///< which of binary_layouts(); or text, or bare
  bool named = true;    ///< false: the columns of a binary file have no names, only stand-ins
  bool guessed = false; ///< the columns have no names and are taken for those of dump atom
  std::uint64_t names_hash =
    0; ///< of the columns, of guessed ones of their number; set where the kind is shared
  bool loose = false; ///< rows of a text may have more words than there are columns

  bool is_text() const noexcept { return layout < 0; }
  bool operator==(const FrameKind&) const = default;
};

/// The kinds of frames in a run, each stored once. Several threads may share them.
class FrameKinds
{
public:
  std::shared_ptr<const FrameKind> share(FrameKind kind);

  /// Returns the kind that was shared last, or null: the next frame is mostly of the same kind.
  std::shared_ptr<const FrameKind> last() const;

private:
  mutable std::mutex mutex_;
  std::shared_ptr<const FrameKind> last_;
  std::vector<std::shared_ptr<const FrameKind>> kinds_;
};

/// The position of a frame in its file, and what is needed to find it among others. There may be millions of entries; the
/// rest is read again from the header together with the frame.
struct FrameEntry
{
  static constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  static constexpr std::uint64_t whole = 0; ///< shape of a frame that its file marks as whole

  std::int64_t timestep = 0;
  std::int64_t rows = 0;
  std::int64_t offset = 0; ///< of the header
  std::int64_t end = 0;
  std::int64_t line = 0;       ///< of the header, from 1; binary: 0
  double time = no_time;       ///< of the header
  std::uint64_t shape = whole; ///< hash of the box and the names of the columns: see hash_shape
  std::shared_ptr<const FrameKind> kind = {};
};

/// Returns what pieces of one frame must share: a hash of the box and the column names.
std::uint64_t hash_shape(const FrameHeader& header, const FrameKind& kind);

/// Returns the position of a frame: the line of its header, or the byte in a binary file.
Where where_of(const std::string& path, const FrameEntry& entry);

/// Checks that the header at the position of a frame is the one that was indexed. `columns` are its names, or empty if it has
/// none; `units` are its own, or empty. Throws IoError.
void check_header(const std::string& path, const FrameEntry& entry, const FrameHeader& header,
  const std::vector<std::string>& columns);

/// Checks the same for cells, which frames of other files have instead of rows.
void check_cells(const FrameEntry& entry, std::int64_t cells, const Where& where);
}
#endif
