// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/cell_averaging.h"

#include "granular/numbers/number_print.h"
#include "granular/particles/bounds.h"

#include <string>
#include <tuple>

namespace granular
{
namespace
{
bool are_given(const std::array<double, 6>& bounds)
{
  return bounds[0] <= bounds[1] && bounds[2] <= bounds[3] && bounds[4] <= bounds[5];
}
}

void ChosenCells::expect_extent() const
{
  if (image && grid.by == EulerGridRequest::By::Cutoff)
  {
    throw Error(
      "expected points as output for CellSizeRelative, got an image, whose extent must be "
      "known before the particles");
  }
  if (image && grid.by == EulerGridRequest::By::Size && !are_given(bounds))
  {
    throw Error("expected Bounds for an image of cells of a CellSize, got none: give Bounds, "
                "CellCounts, or output points");
  }
}

EulerGrid ChosenCells::known_grid() const
{
  this->expect_extent();
  EulerGridRequest request = grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    request.lo[axis] = are_given(bounds) ? bounds[2 * axis] : 0;
    request.hi[axis] = are_given(bounds) ? bounds[2 * axis + 1] : 1;
  }
  return make_euler_grid(request);
}

EulerGrid CellAveraging::make_grid(const FrameView& particles) const
{
  EulerGridRequest request = cells_.grid;
  const double largest = request.by == EulerGridRequest::By::Cutoff
    ? largest_radius(particles, chosen_.names, ranks_)
    : 0;
  std::tie(request.lo, request.hi) = find_bounds(particles, cells_.bounds, nullptr);
  if (request.by == EulerGridRequest::By::Cutoff)
  {
    if (!(cells_.relative_size > 0))
    {
      throw Error("expected a CellSizeRelative above 0, got " + to_text(cells_.relative_size));
    }
    request.cutoff = cells_.relative_size * 2 * largest;
  }
  EulerGrid grid = make_euler_grid(request);
  for (int axis = 0; cells_.profile && axis < 3; ++axis)
  {
    std::int64_t& count = grid.counts[static_cast<std::size_t>(axis)];
    count = axis == *cells_.profile ? count : 1;
  }
  return grid;
}

void CellAveraging::add(
  const AverageInput& input, const Want& want, Communicator& all, PartialProgress& whole)
{
  FrameView& view = input.particles;
  EulerAverageRequest request;
  this->choose(input, request);
  if (has_contacts(input) && !request.arrays.stress.empty())
  {
    throw Error("expected a StressArray or contacts (Lines, Walls), got both: contacts would count "
                "twice");
  }
  const std::string boundary = view.header.box.boundary;
  grid_ = request.grid = this->make_grid(view);
  if (!cells_.images)
  {
    view.header.box.boundary.clear();
  }
  this->check_input(input);
  request.wanted = want(request.grid);
  request.cells = this->make_weights(input, cells_.kernel_bounds);
  request.keep_sums = cells_.time_average || request.fields.coordination;
  const bool contacts = needs_contacts(request);
  PartialProgress progress(whole);
  progress.set_part(0, contacts ? 0.5 : 1);
  EulerAverages averages = average_in_cells(view, request, ranks_, executor_, notices_, progress);
  if (contacts)
  {
    progress.set_part(0.5, 1);
    const Box box = view.header.box;
    view.header.box.boundary = boundary; // a contact crosses a face, though nothing has images
    average_contacts(this->find_contacts(input, request.tensors, progress),
      view.has_box ? &box : nullptr, request, ranks_, executor_, progress, averages);
    ends_.reset();
    contacts_.reset();
  }
  outside_ += averages.outside;
  broken_ += averages.broken;
  if (cells_.time_average)
  {
    do_together(all, [&] { sums_.add(averages); });
    return;
  }
  last_ = std::move(averages);
}

EulerFrame CellAveraging::finish()
{
  return cells_.time_average ? Averaging::finish(sums_.cells(), sums_.fields())
                             : Averaging::finish(std::move(last_.cells), std::move(last_.fields));
}
}
