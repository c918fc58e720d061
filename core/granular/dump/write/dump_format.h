// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_dump_format_h
#define granular_dump_write_dump_format_h

#include "granular/bytes/byte_sink.h"
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
/// The command of the simulation code that would have written the file.
enum class DumpStyle : std::uint8_t
{
  Atom,   ///< dump atom: the columns of an AtomForm
  Custom, ///< dump custom: any columns
  Local   ///< dump local: rows of any arrays, not particles; text only
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

/// Checks that a file can have this format: local data are text, and their rows have no other section's name. Throws Error,
/// and UnsupportedError for binary dumps that are compressed or of local data.
void check_format(const DumpFormat& format, const std::string& path);

/// Returns the dialect of a dump whose first frame has this header: LAMMPS if the other dialect lacks a wanted feature, such
/// as units, a time, or column names in a binary dump made from text.
Dialect choose_dialect(const DumpFormat& format, const FrameHeader& header) noexcept;

/// Returns true if a name is that of a binary dump: it ends in .bin or .lammpsbin, before an ending for compression.
bool is_binary_name(std::string_view path) noexcept;

/// Returns the compression that a name ends in: .gz, .zst.
Compression compression_of_name(std::string_view path) noexcept;

/// Returns the name with the first '*' replaced by the timestep, as in the dump command; folders are left alone.
std::string name_of_step(const std::string& path, std::int64_t timestep);

/// Returns true if each frame is a file of its own: the name holds '*'.
bool is_name_of_steps(const std::string& path) noexcept;

/// Returns whether the files of this name are made to survive a crash of the system. Automatic: all but those of a series, a
/// file for each frame, where waiting for the disk takes longer than writing.
bool is_durable(Durability durability, const std::string& path) noexcept;

/// Returns true if ranks write files of their own: the name holds '%'.
bool is_name_of_ranks(const std::string& path) noexcept;

/// Returns the name with '%' replaced by the rank.
std::string name_of_rank(const std::string& path, int rank);
}
#endif
