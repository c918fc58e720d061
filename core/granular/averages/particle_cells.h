// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_particle_cells_h
#define granular_averages_particle_cells_h

#include "granular/averages/smooth_cells.h"
#include "granular/geometry/box.h"
#include "granular/grid/cell_finder.h"
#include "granular/grid/euler_grid.h"
#include "granular/grid/periodic_images.h"
#include "granular/grid/sphere_box.h"
#include "granular/grid/sphere_cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace granular
{
/// Finds the cells of particles and of their periodic images.
class ParticleCells
{
public:
  /// box: of which particles have images along its periodic axes, wherever the grid reaches; null, or a general one: none have.
  ParticleCells(const EulerGrid& grid, const WeightOptions& options, const Box* box);
  ParticleCells(const ParticleCells&) = delete;
  ParticleCells& operator=(const ParticleCells&) = delete;

  /// Returns true if each particle has at most one cell, that of its centre: see CellFinder.
  bool is_direct() const noexcept;
  const CellFinder& finder() const noexcept { return finder_; }

  /// Working memory of a thread.
  struct Shares
  {
    std::vector<CellShare> of_sphere;
    SmoothCells::Room of_kernel;
  };

  /// Calls visit(range) with the cells that each image of a particle may belong to, if any.
  template <class Visit>
  void each_range(const double* centre, double radius, const Visit& visit) const
  {
    if (this->is_point(radius))
    {
      this->each_cell(centre,
        [&](const std::array<std::int64_t, 3>& cell) {
          visit({ cell, { cell[0] + 1, cell[1] + 1, cell[2] + 1 } });
        });
      return;
    }
    images_.each(centre, this->reach(radius),
      [&](const Twofold3& image)
      {
        const CellRange range = smooth_ ? smooth_->range(values_of(image), {}, floors_of(image))
                                        : spheres_.range(image, radius);
        if (range.size() > 0)
        {
          visit(range);
        }
      });
  }

  /// Calls add(cell, share, volume) for each cell in a range that a particle belongs to: its number in the range, the
  /// particle's part in it, in (0, 1] and a multiple of 2^quantum(), and the volume of that part.
  template <class Add>
  void each_share(const double* centre, double radius, const CellRange& within, Shares& shares,
    const Add& add) const
  {
    const double volume = sphere_volume(radius);
    if (this->is_point(radius))
    {
      this->each_cell(centre,
        [&](const std::array<std::int64_t, 3>& cell)
        {
          if (const std::int64_t number = within.number(cell); number >= 0)
          {
            add(number, 1.0, volume);
          }
        });
      return;
    }
    if (smooth_)
    {
      this->each_smooth(centre, within, shares.of_kernel,
        [&](std::int64_t cell, double share) { add(cell, share, volume * share); });
      return;
    }
    std::int64_t whole = 0;
    if (images_.alone(centre, radius) && finder_.find_whole(centre, radius, within, whole))
    {
      add(whole, 1.0, volume);
      return;
    }
    shares.of_sphere.clear();
    images_.each(centre, radius,
      [&](const Twofold3& image) { spheres_.find(image, radius, within, shares.of_sphere); });
    for (const CellShare& share : shares.of_sphere)
    {
      const double part = share.volume / volume;
      const double rounded = part + share_shift_ - share_shift_;
      if (rounded > 0)
      {
        add(share.cell, std::min(rounded, 1.0), share.volume);
      }
    }
  }

  /// Checks that particles up to that radius can be divided; throws LimitError. Returns the largest number of shares that one
  /// may have in one cell: those of its images. Call it before asking for ranges or shares.
  std::int64_t check(double radius) const;

  /// largest_volume: of all particles. Call it before each_share if weights are Overlap.
  void set_largest_volume(double largest_volume) noexcept;

  /// Shares are multiples of 2^quantum: with Overlap 2^-64 of a particle or of the smallest cell, whatever is less, with a kernel
  /// of a particle; 0 for Centre.
  int quantum() const noexcept { return quantum_; }

private:
  /// Returns true if the particle belongs to one cell as a whole; so do particles without volume.
  bool is_point(double radius) const noexcept
  {
    return weights_ == CellWeights::Centre ||
      (weights_ == CellWeights::Overlap && sphere_volume(radius) == 0);
  }

  Vector3 reach(double radius) const noexcept;

  template <class Add>
  void each_smooth(
    const double* centre, const CellRange& within, SmoothCells::Room& room, const Add& add) const
  {
    images_.each(centre, smooth_->reach({}),
      [&](const Twofold3& image)
      {
        const bool found = smooth_->each(values_of(image), {}, floors_of(image), within, room,
          [&](std::int64_t cell, double part)
          {
            const double rounded = part + share_shift_ - share_shift_;
            if (rounded > 0)
            {
              add(cell, std::min(rounded, 1.0));
            }
          });
        const std::int64_t number = found ? -1 : within.number(this->cell_of(image));
        if (number >= 0)
        {
          add(number, 1.0);
        }
      });
  }

  /// The cell of an image, or -1 along axes where it is in none.
  std::array<std::int64_t, 3> cell_of(const Twofold3& image) const noexcept;

  template <class Visit>
  void each_cell(const double* centre, const Visit& visit) const
  {
    if (!images_.of_centres())
    {
      const std::array<std::int64_t, 3> cell = { finder_.find(0, centre[0]),
        finder_.find(1, centre[1]), finder_.find(2, centre[2]) };
      if ((cell[0] | cell[1] | cell[2]) >= 0)
      {
        visit(cell);
      }
      return;
    }
    images_.each(centre, 0,
      [&](const Twofold3& image)
      {
        const std::array<std::int64_t, 3> cell = this->cell_of(image);
        if ((cell[0] | cell[1] | cell[2]) >= 0)
        {
          visit(cell);
        }
      });
  }

  EulerGrid grid_;
  CellWeights weights_;
  SphereCells spheres_;
  CellFinder finder_;
  PeriodicImages images_;
  std::optional<SmoothCells> smooth_; ///< with a kernel
  int quantum_ = 0;
  double share_shift_ = 0; ///< 1.5 * 2^(52 + quantum)
};
}
#endif
