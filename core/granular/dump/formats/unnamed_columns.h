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

/// Returns the names that the user gave. Without names, and if the columns cannot be those of dump atom, returns
/// placeholders: frames can be listed, and reading one is an error.
UnnamedColumns name_columns(std::size_t columns, const std::vector<std::string>& of_user);

/// Returns true if the columns of a kind of frames have these names.
bool is_named_so(const FrameKind& kind, const std::vector<std::string>& of_user);
}
#endif
