// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_restart_layout_h
#define granular_formats_restart_restart_layout_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/geometry/box.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace granular
{
class RestartBytes;

/// An atom style: the only one, or one of a hybrid.
struct RestartStyle
{
  std::string name;       ///< as written: granular, sphere, bond/gran
  int bond_types = 0;     ///< of bond/gran
  int bonds_per_atom = 0; ///< of bond/gran: the most bonds that a particle may hold
};

/// The header of a restart file.
struct RestartHeader
{
  std::string version; ///< of the program, in its words
  int tag_bytes = 4;   ///< of an id: 4, or 8 (BIGBIG)
  int count_bytes = 8; ///< of counts of particles and steps: 8, or 4 (SMALLSMALL)
  std::string units;
  std::int64_t timestep = 0;
  std::optional<double> time; ///< INL only
  int dimension = 3;
  int processes = 1;
  bool newton_bond = false; ///< true: a bond is stored once, with either particle
  std::int64_t atoms = 0;
  std::int64_t bonds = 0;
  int types = 0;
  std::string atom_style;           ///< as written
  std::vector<RestartStyle> styles; ///< those of a hybrid, or the one
  Box box;                          ///< with its boundary flags
  std::int64_t end = 0;             ///< byte behind the header

  /// Returns the bits of a count in an image.
  int image_bits() const noexcept { return tag_bytes == 8 ? 21 : 10; }
};

/// Reads the header, from byte 0. Throws FormatError with the byte and the name of the wrong value; UnsupportedError for
/// files of LAMMPS, with a way to convert them to a dump.
RestartHeader read_header(RestartBytes& bytes);

/// A fix that adds to the records of particles.
struct RestartFix
{
  std::string id;
  std::string style;
  std::int64_t most = 0; ///< doubles in a record, at most
};

/// The records of one rank.
struct RestartChunk
{
  std::string path; ///< of a file of its own (`%` in the name); empty: in the restart file itself
  std::int64_t offset = 0; ///< byte of the first record, behind the count, unpacked
  std::int64_t doubles = 0;
  FileStamp stamp = {}; ///< of a file of its own, when it was opened
};

/// Records of a chunk, one behind the other, that a thread reads at a time.
struct RecordBlock
{
  std::string path = {};      ///< as that of the chunk
  std::int64_t offset = 0;    ///< byte of the first
  std::int64_t doubles = 0;   ///< of all
  std::int64_t first_row = 0; ///< number of the first, from 0, in all chunks
  std::int64_t records = 0;
};

/// The positions of all parts of a restart file.
struct RestartLayout : FileLayout
{
  RestartHeader header;
  bool swapped = false;            ///< the order of its bytes is not this machine's
  std::vector<std::string> groups; ///< by their bit in a mask; empty names are free bits
  std::vector<double> masses;      ///< of types 1, 2, ...; none if the file has none
  bool has_fixes = false;          ///< false: the data of fixes in records were not found
  /// In the order of the file. LIGGGHTS writes their parts of records in another order once a fix of the same id was defined
  /// again. If the parts do not fit then, their lengths identify the fixes; fixes with equal lengths cannot be told apart.
  std::vector<RestartFix> fixes;
  std::vector<RestartChunk>
    chunks; ///< of ranks 0, 1, ..., some without records; none if there are no particles and meshes follow
  std::vector<RecordBlock> blocks; ///< all records, in order
  std::int64_t records = 0;        ///< in all chunks
  std::int64_t begin = 0; ///< byte of the count of the first chunk; of a `base` file its end
  std::int64_t size = 0;  ///< bytes of the file, unpacked
};

/// Finds all parts. The length of the force fields' data is unknown, so each byte from there on is tried as the start of the
/// particles. The reader picks the offset from which exactly one chunk of records per rank reaches the end of the file (INL,
/// with meshes behind: as many particles as the header says, all in or near the box). If a file with `base` in its name has
/// no particles, the chunks are in files with 0, 1, 2, ... there; if it has no chunks at all, those files are looked for
/// first. The data of fixes end directly before the particles and are recognised by their structure; a notice tells if they
/// are not found although there are particles. All records are visited once, from length to length. Compressed contents are
/// held in memory meanwhile. Memory depends on the bytes of the file, not on its claims; a search reads at most a few times
/// the size of the file. Throws FormatError that tells which parts were
/// understood, where the search began, and which files of ranks are missing; UnsupportedError; IoError; Cancelled.
RestartLayout read_layout(const ByteSource& source, Notices& notices, Progress& progress);

/// Adds the notice of read_layout on a layout that is known already.
void note_fixes(const RestartLayout& layout, const std::string& path, Notices& notices);
}
#endif
