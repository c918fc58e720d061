// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/average.h"

#include "granular/averages/average_passes.h"
#include "granular/memory/block.h"
#include "granular/parallel/trade.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <optional>
#include <string>

namespace granular
{
namespace
{
/// The values of EulerCells in a cell: x y z u v w phi r p.
constexpr double values_of_cell = 9;

/// The sums of a frame, and what TimeAverage keeps of a cell.
constexpr double values_of_time_average = 6 + 44;

std::string mebibytes(double bytes)
{
  return std::to_string(static_cast<std::int64_t>(bytes / 1048576)) + " MiB";
}

/// Values of a cell.
double fields_of(const EulerFieldSet& fields)
{
  return (fields.density ? 1 : 0) + (fields.momentum ? 3 : 0) + (fields.temperature ? 1 : 0) +
    (fields.coordination ? 1 : 0) + (fields.fabric ? 6 : 0);
}

/// Checks the memory for the wanted cells: their faces, what is known of blocks of cells, and the sums of some of these.
void check_memory(const EulerAverageRequest& request)
{
  const auto& [nx, ny, nz] = request.grid.counts;
  const auto cells = static_cast<double>(request.grid.size());
  const double values = values_of_cell +
    (request.arrays.stress.empty() && !request.tensors ? 0 : 6) + fields_of(request.fields) +
    (request.keep_sums ? values_of_time_average : 0);
  const double bytes = 8 *
      (static_cast<double>(request.wanted.count(request.grid)) * values + cells / 1024 +
        static_cast<double>(nx) + static_cast<double>(ny) + static_cast<double>(nz)) +
    static_cast<double>(BlockSums::bytes_of_group);
  const auto available = static_cast<double>(available_memory());
  if (bytes > available)
  {
    throw LimitError("expected cells that fit into memory, got " + std::to_string(nx) + " x " +
      std::to_string(ny) + " x " + std::to_string(nz) + " cells, which take " + mebibytes(bytes) +
      "; " + mebibytes(available) + " are available");
  }
}

/// Counts over the ranks: particles, ranks that have any, and how many of these ranks know something of theirs.
enum Count : std::size_t
{
  Rows,
  Holders,
  Velocity,
  Radius,
  Mass,
  CountKinds
};
using Counts = std::array<std::int64_t, CountKinds>;

/// Tells what is not known of the particles. The same on all ranks: particles speak for those who have none.
void check_known(
  const Counts& known, const ParticleArrayNames& arrays, bool need_radius, Notices& notices)
{
  struct Missing
  {
    Count count;
    std::string what;
    const char* then;
  };
  const Missing all[] = {
    { Velocity, "no array '" + arrays.velocity + "' of velocities", "v_avg is 0" },
    { Radius, "no array '" + arrays.radius + "' of radii", "radius and volumefraction are 0" },
    { Mass, "neither an array '" + arrays.mass + "' nor density and radius",
      "the mass of each grain is taken as 1" },
  };
  for (const Missing& missing : all)
  {
    const std::int64_t count = known[missing.count];
    if (count == 0 && known[Holders] > 0)
    {
      notices.push_back({ {}, missing.what + ": " + missing.then });
    }
    else if (count < known[Holders])
    {
      throw Error("expected the same arrays on all processes, got some with " + missing.what);
    }
  }
  if (need_radius && known[Radius] == 0 && known[Holders] > 0)
  {
    throw Error("expected an array '" + arrays.radius +
      "' of radii, which the weights Overlap need, got none");
  }
}
}

std::int64_t check_particles(const FrameView& frame, const ParticleSources& sources,
  const ParticleArrayNames& arrays, bool need_radius, Communicator& ranks, Notices& notices)
{
  if (frame.rows > 0 && !frame.points)
  {
    throw Error("expected points to average, got none");
  }
  const std::int64_t holds = frame.rows > 0 ? 1 : 0;
  Counts known = { frame.rows, holds, sources.velocity[0] ? holds : 0, sources.radius ? holds : 0,
    sources.mass || sources.density ? holds : 0 };
  ranks.sum(known);
  check_known(known, arrays, need_radius, notices);
  return known[Rows];
}

WantedCells WantedCells::all(const EulerGrid& grid) noexcept
{
  return { { {}, grid.counts }, 0, grid.size() };
}

std::int64_t WantedCells::count(const EulerGrid& grid) const noexcept
{
  const std::int64_t cells = range.size();
  return cells == grid.size() ? std::max<std::int64_t>(last - first, 0) : cells;
}

std::int64_t WantedCells::place(
  const EulerGrid& grid, const std::array<std::int64_t, 3>& cell) const noexcept
{
  const auto& [nx, ny, nz] = grid.counts;
  const std::int64_t number = (cell[2] * ny + cell[1]) * nx + cell[0];
  const std::int64_t place = range.number(cell);
  return place >= 0 && number >= first && number < last ? place - first : -1;
}

void EulerAverages::make_room(std::int64_t count, bool tensors, const EulerFieldSet& wanted)
{
  const auto room = [&](bool asked, std::int64_t width)
  { return asked ? static_cast<std::size_t>(width * count) : 0; };
  cells.resize(count);
  cells.normal_stress.resize(room(tensors, 3));
  cells.shear_stress.resize(room(tensors, 3));
  fields.density.resize(room(wanted.density, 1));
  fields.momentum.resize(room(wanted.momentum, 3));
  fields.temperature.resize(room(wanted.temperature, 1));
}

void EulerAverages::make_contact_room(std::int64_t count, bool stress, const EulerFieldSet& wanted)
{
  const auto room = static_cast<std::size_t>(count);
  fields.contact_normal.resize(stress ? 3 * room : 0);
  fields.contact_shear.resize(stress ? 3 * room : 0);
  fields.coordination.resize(wanted.coordination ? room : 0);
  fields.fabric.resize(wanted.fabric ? 6 * room : 0);
}

void EulerAverages::store_means(
  std::size_t cell, const double* all, const Vector3& mean, double of_volume)
{
  const double share = all[0];
  std::ranges::copy(mean, cells.velocities.data() + 3 * cell);
  cells.radius[cell] = share > 0 ? all[5] / share : 0;
  cells.volume_fraction[cell] = all[6] / of_volume;
  if (!fields.density.empty())
  {
    fields.density[cell] = all[1] / of_volume;
  }
  for (std::size_t axis = 0; !fields.momentum.empty() && axis < 3; ++axis)
  {
    fields.momentum[3 * cell + axis] = all[2 + axis] / of_volume;
  }
}

void EulerAverages::store_fluctuations(
  std::size_t cell, const double* all, double mass, double of_volume)
{
  cells.pressure[cell] = (0 - (all[0] + all[1] + all[2])) / (3 * of_volume); // 0, not -0
  for (std::size_t k = 0; !cells.normal_stress.empty() && k < 3; ++k)
  {
    cells.normal_stress[3 * cell + k] = all[k] / of_volume;
    cells.shear_stress[3 * cell + k] = all[3 + k] / of_volume;
  }
  if (!fields.temperature.empty())
  {
    fields.temperature[cell] = mass > 0 ? all[6] / (3 * mass) : 0;
  }
}

void EulerAverages::store_contacts(
  std::size_t cell, const double* all, double share, double of_volume)
{
  for (std::size_t k = 0; !fields.contact_normal.empty() && k < 3; ++k)
  {
    fields.contact_normal[3 * cell + k] = all[k] / of_volume;
    fields.contact_shear[3 * cell + k] = all[3 + k] / of_volume;
  }
  if (!fields.coordination.empty())
  {
    fields.coordination[cell] = share > 0 ? all[6] / share : 0;
  }
}

void EulerAverages::store_fabric(std::size_t cell, const double* all, double contacts)
{
  for (std::size_t k = 0; !fields.fabric.empty() && k < 6; ++k)
  {
    fields.fabric[6 * cell + k] = contacts > 0 ? all[k] / contacts : 0;
  }
}

EulerAverages average_in_cells(const FrameView& frame, const EulerAverageRequest& request,
  Communicator& ranks, const Executor& executor, Notices& notices, Progress& progress)
{
  return do_together(ranks,
    [&]
    {
      const ParticleSources sources = find_particle_sources(frame, request.arrays);
      const std::int64_t rows = check_particles(frame, sources, request.arrays,
        request.cells.weights == CellWeights::Overlap, ranks, notices);
      check_memory(request);
      return AveragePasses(frame, sources, rows, request, ranks, executor, progress).run();
    });
}

double largest_radius(const FrameView& frame, const ParticleArrayNames& arrays, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      double largest = 0;
      const std::optional<ValueSource> radius = find_particle_sources(frame,
        { .velocity = {},
          .radius = arrays.radius,
          .mass = {} }).radius;
      if (frame.rows > 0 && !radius)
      {
        throw Error("expected an array '" + arrays.radius + "' of radii, got none");
      }
      const auto include = [&](double value)
      { largest = std::isfinite(value) ? std::max(largest, value) : largest; };
      for_each_number(radius.value_or(ValueSource{}), frame.rows, include);
      return std::ranges::max(gather(ranks, largest));
    });
}
}
