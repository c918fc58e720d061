// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_unnamed_columns_h
#define granular_dump_formats_unnamed_columns_h

#include "granular/frames/frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace granular
{
/// Names for columns that a binary file does not name.
struct UnnamedColumns
{
  std::vector<std::string> names;
  bool named = true; ///< see FrameKind
  bool guessed = false;
};

/// Those of the user. Where there are none, and they cannot be those of dump atom, they get stand-ins: the frames can be listed, and
/// the error comes when one is read.
UnnamedColumns name_columns(std::size_t columns, const std::vector<std::string>& of_user);

/// Whether that is what the columns of a kind of frames are called.
bool is_named_so(const FrameKind& kind, const std::vector<std::string>& of_user);
}
#endif
