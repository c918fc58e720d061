// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVtuFile_h
#define vtkGranularVtuFile_h

#include "granular/base/byte_source.h"
#include "granular/decomposition/subdomains.h"
#include "granular/dump/frame.h"

#include <optional>
#include <string>

namespace vtkGranularPrivate
{
/**
 * The subdomains in a .vtu file, read by VTK's own reader. Throws FormatError with what that one says.
 */
granular::Decomposition ReadVtu(const granular::ByteSource& source,
  const granular::FrameEntry& entry, granular::Notices& notices);

/**
 * The text of a .vtu file, by VTK's own writer: voxels with the arrays nlocal and proc, as far as they are known,
 * and the field TimeValue if there is a time. path is for errors. Throws Error.
 */
std::string EncodeVtu(const granular::Decomposition& decomposition, std::optional<double> time,
  const std::string& path);
}

#endif
