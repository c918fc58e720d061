// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVtuFile_h
#define vtkGranularVtuFile_h

#include "granular/decomposition/subdomains.h"

#include <optional>
#include <string>

namespace vtkGranularPrivate
{
/**
 * Returns the text of a .vtu file from VTK's own writer: voxels with the arrays nlocal and proc, as far as they are
 * known, nlocal with 32 bits if all values fit and 64 otherwise, and the field TimeValue if the time is known. path is
 * used in errors. Throws Error.
 */
std::string EncodeVtu(const granular::Decomposition& decomposition, std::optional<double> time,
  const std::string& path);
}

#endif
