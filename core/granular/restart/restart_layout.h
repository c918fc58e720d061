// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_restart_layout_h
#define granular_restart_restart_layout_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/restart/restart_header.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// A fix that adds to the records of particles.
struct RestartFix
{
  std::string id;
  std::string style;
  std::int64_t most = 0; ///< doubles in a record, at most
};

/// The records of one process.
struct RestartChunk
{
  std::string path; ///< of a file of its own (`%` in the name); empty: in the restart file itself
  std::int64_t offset = 0; ///< byte of the first record, behind the count, unpacked
  std::int64_t doubles = 0;
  FileStamp stamp = {}; ///< of a file of its own, when it was opened
};

/// Where things are in a restart file.
struct RestartLayout
{
  RestartHeader header;
  bool swapped = false;            ///< the order of its bytes is not this machine's
  std::vector<std::string> groups; ///< by their bit in a mask; empty names are free bits
  std::vector<double> masses;      ///< of types 1, 2, ...; nan if the file has none
  bool has_fixes = false;          ///< false: what fixes have in records was not found
  /// In the order of the file. LIGGGHTS writes what they add to records in another order once a fix of the same id was defined again:
  /// where these parts do not fit, their lengths tell whose they are if they can; of fixes that add as many doubles nobody can.
  std::vector<RestartFix> fixes;
  std::vector<RestartChunk>
    chunks; ///< of processes 0, 1, ..., some without records; none if there are no particles and meshes follow
  std::int64_t records = 0; ///< in all chunks
  std::int64_t begin = 0;   ///< byte of the count of the first chunk; of a `base` file its end
  std::int64_t size = 0;    ///< bytes of the file, unpacked
};

/// Finds out where things are. The payload of force fields cannot be known: each byte from there on is tried as the beginning of
/// the particles, and taken if as many chunks of records as there were processes lead to the end of the file (INL, which has
/// meshes behind: to as many particles as the header says, all in or near the box). Of a file with `base` in its name
/// which has no particles the chunks are in files with 0, 1, 2, ... there; where there are none at all these are looked for first.
/// What fixes have stored is right before the particles, and found by what it is made of; a notice says so where it is not and there are particles.
/// All records are walked once, from length to length. Content that is packed is held in memory meanwhile.
/// Allocates nothing on a file's word, but for the masses of at most a million types; what a search may read is a few times the size of
/// the file. Throws FormatError that says which parts were understood and where the search began, and
/// what of files of processes is missing; UnsupportedError; IoError; Cancelled.
RestartLayout read_layout(const ByteSource& source, Notices& notices, Progress& progress);
}
#endif
