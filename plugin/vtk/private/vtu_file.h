// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVtuFile_h
#define vtkGranularVtuFile_h

#include "granular/base/byte_source.h"
#include "granular/decomposition/subdomains.h"
#include "granular/dump/frame.h"

namespace vtkGranularPrivate
{
/**
 * The subdomains in a .vtu file, read by VTK's own reader. Throws FormatError with what that one says.
 */
granular::Decomposition ReadVtu(const granular::ByteSource& source,
  const granular::FrameEntry& entry, granular::Notices& notices);
}

#endif
