// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_point_average_h
#define granular_averages_point_average_h

#include "granular/averages/average.h"
#include "granular/averages/kernel.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/contacts/find_ends.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <span>

namespace granular
{
struct PointAverageRequest
{
  Kernel kernel{ KernelShape::Gaussian, 1 };
  ParticleArrayNames arrays;
  bool pressure = true; ///< false, without tensors or a temperature: no fluctuations are looked at
  bool tensors = false; ///< fill normal_stress and shear_stress
  EulerFieldSet fields;
};

/// Averages the particles of a frame, and their contacts, at any points by a smoothing kernel: as average_in_cells does, with
/// kernel / volume of the kernel in place of w / V, and the mean of the kernel over the line for contacts. The integral of the
/// density over all space is the mass. Particles and contacts have periodic images, but not in a general box.
///
/// points: x y z of each, absolute, of this rank; the result has an entry for each, in order, and no centres. A point that is
/// not finite gets zeros. Sums are correctly rounded, of terms that are rounded doubles: the same for any order of rows,
/// threads and ranks. Throws Error, LimitError, Cancelled, on all ranks. Collective.
EulerAverages average_at_points(const FrameView& frame, std::span<const double> points,
  const FoundEnds* contacts, const PointAverageRequest& request, Communicator& ranks,
  const Executor& executor, Notices& notices, Progress& progress);
}
#endif
