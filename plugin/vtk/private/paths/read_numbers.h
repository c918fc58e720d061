// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularReadNumbers_h
#define vtkGranularReadNumbers_h

#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include "vtkType.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vtkGranularPrivate
{
/**
 * Returns the ids of some rows. Throws what granular::Ids throws.
 */
std::vector<std::int64_t> ReadIds(const granular::ArrayView& array, std::int64_t allRows,
  const std::vector<vtkIdType>& rows, granular::Progress& progress);

/**
 * Returns the masses of some rows: those of an array, otherwise of spheres by density and radius. Nothing if a rank with
 * particles has neither, or no rank has particles. Throws Error for arrays of more than one number a particle, or of texts.
 * Collective.
 */
std::optional<std::vector<double>> ReadMasses(const granular::FrameView& view,
  const std::string& name, const std::vector<vtkIdType>& rows, granular::Communicator& ranks);
}

#endif
