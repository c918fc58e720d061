// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVtuFile_h
#define vtkGranularVtuFile_h

#include "granular/decomposition/subdomains.h"

#include <optional>
#include <string>

namespace vtkGranularPrivate
{
/**
 * The text of a .vtu file, by VTK's own writer: voxels with the arrays nlocal and proc, as far as they are known,
 * nlocal with 32 bits where all fit, else 64, and the field TimeValue if there is a time. path is for errors. Throws Error.
 */
std::string EncodeVtu(const granular::Decomposition& decomposition, std::optional<double> time,
  const std::string& path);
}

#endif
