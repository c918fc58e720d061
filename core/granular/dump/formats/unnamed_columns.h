// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_unnamed_columns_h
#define granular_dump_formats_unnamed_columns_h

#include "granular/frames/frame.h"

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
}
#endif
