// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/particle_cells.h"

#include <cmath>

namespace granular
{
ParticleCells::ParticleCells(const EulerGrid& grid, const WeightOptions& options, const Box* box)
  : grid_(grid)
  , weights_(options.weights)
  , spheres_(grid)
  , finder_(grid)
  , images_(grid, box)
{
  if (weights_ == CellWeights::Kernel)
  {
    check_width(options.width);
    smooth_.emplace(grid_, Kernel(options.kernel, options.width), options.bounds, images_);
  }
}

bool ParticleCells::is_direct() const noexcept
{
  return weights_ == CellWeights::Centre && !images_.of_centres();
}

Vector3 ParticleCells::reach(double radius) const noexcept
{
  return smooth_ ? smooth_->reach({}) : Vector3{ radius, radius, radius };
}

void ParticleCells::set_largest_volume(double largest_volume) noexcept
{
  constexpr int bits = 64;
  quantum_ = weights_ == CellWeights::Kernel ? -bits : 0;
  if (weights_ == CellWeights::Overlap && largest_volume > 0)
  {
    double cell = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cell *= grid_.spacing(axis) / 2; // one ulp may be missing of cells that are a few thick
    }
    const double ratio = std::min(cell / largest_volume, 1.0);
    quantum_ = (ratio > 0 ? std::max(std::ilogb(ratio), -500) : -500) - bits;
  }
  share_shift_ = std::ldexp(1.5, 52 + quantum_);
}

std::int64_t ParticleCells::check(double radius) const
{
  if (smooth_)
  {
    smooth_->check(0);
  }
  const double reach = std::ranges::max(this->reach(weights_ == CellWeights::Centre ? 0 : radius));
  images_.check(reach);
  return images_.most_in_cell(reach);
}

std::array<std::int64_t, 3> ParticleCells::cell_of(const Twofold3& image) const noexcept
{
  std::array<std::int64_t, 3> cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double x = floor_of(image[axis]); // below a face where the image is
    cell[axis] = images_.is_twice(axis, x) ? -1 : finder_.find(axis, x);
  }
  return cell;
}
}
