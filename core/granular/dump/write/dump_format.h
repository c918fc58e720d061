// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_dump_format_h
#define granular_dump_write_dump_format_h

#include "granular/bytes/compression.h"
#include "granular/dump/write/atom_rows.h"
#include "granular/frames/frame.h"
#include "granular/numbers/number_print.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Which command of the simulation code would have written the file.
enum class DumpStyle : std::uint8_t
{
  Atom,   ///< dump atom: the columns of an AtomForm
  Custom, ///< dump custom: any columns
  Local   ///< dump local: rows of any arrays, which are no particles; text only
};

/// How a dump is written.
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
  std::string counted = "ENTRIES"; ///< what rows are called; of DumpStyle::Local
  NumberFormat numbers;            ///< of real numbers in text
  bool units = false;              ///< ITEM: UNITS in the first frame of the file; Lammps only
  bool time = false;               ///< ITEM: TIME; Lammps only
  bool sort_by_id = false;

  /// Values of a chunk of a binary file, which counts them with 32 bits: less than 2^31 - 1.
  std::int64_t chunk_values = (std::int64_t{ 1 } << 31) - 2;
};

/// Makes sure that a file can have such a format: local data that are text, and are not called as something else is in a dump.
/// Throws Error, UnsupportedError for binary dumps that are compressed or of local data.
void check_format(const DumpFormat& format, const std::string& path);

/// The dialect of a dump whose first frame has this header. That of LAMMPS where the other lacks what is wanted: units, a time, or,
/// in a binary dump of a text, names of columns.
Dialect choose_dialect(const DumpFormat& format, const FrameHeader& header) noexcept;

/// Whether a name is that of a binary dump: it ends in .bin or .lammpsbin, as LAMMPS has it, but for the end that
/// says that it is compressed.
bool is_binary_name(std::string_view path) noexcept;

/// What the end of a name says: .gz, .zst.
Compression compression_of_name(std::string_view path) noexcept;

/// The name with '*' replaced by the timestep, as the dump command has it; the first '*' only, and none in
/// folders.
std::string name_of_step(const std::string& path, std::int64_t timestep);

/// Whether each frame is a file of its own: the name of the file holds '*'.
bool is_name_of_steps(const std::string& path) noexcept;

/// Whether ranks write files of their own: the name of the file holds '%'.
bool is_name_of_ranks(const std::string& path) noexcept;

/// The name with '%' replaced by the rank.
std::string name_of_rank(const std::string& path, int rank);
}
#endif
