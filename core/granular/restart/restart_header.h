// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_restart_header_h
#define granular_restart_restart_header_h

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
}
#endif
