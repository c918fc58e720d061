// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_dump_format_h
#define granular_formats_dump_write_dump_format_h

#include "granular/frames/frame.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/frame_view.h"
#include "granular/writing/file_names.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The command of the simulation code that would have written the file.
enum class DumpStyle : std::uint8_t
{
  Atom,   ///< dump atom: the columns of an AtomForm
  Custom, ///< dump custom: any columns
  Local   ///< dump local: rows of any arrays, not particles; text only
};

/// The columns of dump atom. With tilted or orthogonal boxes, as text or binary, it has 16 forms.
struct AtomForm
{
  bool scaled = true; ///< xs ys zs; false: x y z
  bool image = false; ///< also ix iy iz
};

/// The format of a dump to write.
struct DumpFormat
{
  DumpStyle style = DumpStyle::Custom;
  std::optional<Dialect> dialect =
    Dialect::Lammps; ///< none: that of the file that the first frame comes from, see choose_dialect
  bool binary = false;
  Compression compression = Compression::None; ///< of text only: no program reads compressed binary
  AtomForm atom;                               ///< of DumpStyle::Atom
  std::vector<std::string>
    columns; ///< not of DumpStyle::Atom; empty: see default_columns, or default_table_columns
  std::string counted;  ///< name of rows; empty: that of the file, or ENTRIES; for DumpStyle::Local
  NumberFormat numbers; ///< of real numbers in text
  bool units = false;   ///< ITEM: UNITS in the first frame of the file; Lammps only
  bool time = false;    ///< ITEM: TIME; Lammps only
  bool sort_by_id = false;

  /// Values per chunk of a binary file, which counts them with 32 bits: less than 2^31 - 1.
  std::int64_t chunk_values = (std::int64_t{ 1 } << 31) - 2;
};

/// Returns the format of a dump of this name, which says whether it is binary and compressed. columns: separated by blanks;
/// numbers: as for parse_number_format, and empty for Automatic. Throws FormatError.
DumpFormat format_of_name(
  std::string_view path, const std::string& columns, const std::string& numbers);

/// Checks that a file can have this format: local data are text, and their rows have no other section's name. Throws Error,
/// and UnsupportedError for binary dumps that are compressed or of local data.
void check_format(const DumpFormat& format, const std::string& path);

/// Returns the dialect of a dump whose first frame has this header: LAMMPS if the other dialect lacks a wanted feature, such
/// as units, a time, or column names in a binary dump made from text.
Dialect choose_dialect(const DumpFormat& format, const FrameHeader& header) noexcept;

/// Returns "id type xs ys zs", "id type x y z ix iy iz", ...
std::vector<std::string> atom_columns(const AtomForm& form);

/// The atoms of one rank, in the arrays of a simulation code.
struct AtomRows
{
  std::int64_t rows = 0;
  const std::int64_t* ids = nullptr;
  const std::int32_t* types = nullptr;
  const double* positions = nullptr;    ///< x y z of each atom, in the box
  const std::int32_t* images = nullptr; ///< three for each atom; null: all are 0
};

/// Returns the frame of these atoms.
FrameView view_atoms(const AtomRows& atoms, const FrameHeader& header);
}
#endif
