// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_atom_fit_h
#define granular_formats_dump_grammar_atom_fit_h

#include "granular/bytes/byte_source.h"
#include "granular/formats/dump/grammar/binary_header.h"
#include "granular/frames/file_index.h"

#include <cstddef>
#include <string>
#include <vector>

namespace granular
{
/// Names for the columns of a binary file that does not name them.
struct UnnamedColumns
{
  std::vector<std::string> names;
  bool named = true; ///< see FrameKind
  bool guessed = false;
};

/// The coordinates that the columns of dump atom may hold in a frame: see fit_atom.
struct AtomFit
{
  bool scaled = false;   ///< xs ys zs
  bool absolute = false; ///< x y z

  bool operator==(const AtomFit&) const = default;
};

/// Returns true if dump atom writes so many columns.
bool is_atom(std::size_t columns) noexcept;

/// Returns the names that the user gave. Without these, returns the names of dump atom if one kind of coordinates fits.
/// Otherwise returns placeholders: frames can be listed, and reading one is an error.
UnnamedColumns name_columns(
  std::size_t columns, const std::vector<std::string>& of_user, AtomFit fit);

/// Returns which coordinates lie in the box of a frame, if its columns are those of dump atom: scaled and absolute ones are
/// told apart by the first rows, at most 4096 of them. Four rows in five must lie in the box, or beside it by 2 % of
/// its length: particles leave it for a while. In a frame without rows, and in the unit box, where both are the same, the
/// coordinates count as scaled.
AtomFit fit_atom(const ByteSource& source, const BinaryHeader& header, const BinaryLayout& layout);

/// Returns "; " and why the columns of dump atom are none.
std::string describe_fit(std::size_t columns, AtomFit fit);

/// FileFormat::lacks and FileFormat::complete for frames of dump atom without names, whose rows do not tell the coordinates, or
/// that have none: they are named as the other frames of the run, if these agree.
bool lack_atom_names(const std::vector<FileIndex>& files);
void complete_atom_names(std::vector<FileIndex>& files, Notices& notices);
}
#endif
