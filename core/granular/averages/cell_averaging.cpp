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
  return is_given(&bounds[0]) && is_given(&bounds[2]) && is_given(&bounds[4]);
}
}

bool ChosenCells::need_frame() const
{
  return grid.by == EulerGridRequest::By::Cutoff ||
    (grid.by == EulerGridRequest::By::Size && !are_given(bounds));
}

EulerGrid ChosenCells::make_grid(
  const FrameView* particles, const ParticleArrayNames& names, Communicator& ranks) const
{
  EulerGridRequest request = grid;
  if (particles != nullptr)
  {
    std::tie(request.lo, request.hi) = find_bounds(*particles, bounds, nullptr);
  }
  for (std::size_t axis = 0; axis < 3 && particles == nullptr; ++axis)
  {
    request.lo[axis] = are_given(bounds) ? bounds[2 * axis] : 0;
    request.hi[axis] = are_given(bounds) ? bounds[2 * axis + 1] : 1;
  }
  if (particles != nullptr && request.by == EulerGridRequest::By::Cutoff)
  {
    const double largest = largest_radius(*particles, names, ranks);
    if (!(relative_size > 0))
    {
      throw Error("expected a CellSizeRelative above 0, got " + to_text(relative_size));
    }
    request.cutoff = relative_size * 2 * largest;
  }
  for (std::size_t axis = 0; profile && axis < 3;
       ++axis) // one cell along the others, which so have no limits
  {
    const double length = request.hi[axis] - request.lo[axis];
    const bool other = axis != static_cast<std::size_t>(*profile);
    request.counts[axis] = other ? 1 : request.counts[axis];
    request.size[axis] = other && length > 0 ? length : request.size[axis];
  }
  EulerGrid made = make_euler_grid(request);
  for (int axis = 0; profile && axis < 3; ++axis)
  {
    std::int64_t& count = made.counts[static_cast<std::size_t>(axis)];
    count = axis == *profile ? count : 1;
  }
  return made;
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
  grid_ = request.grid = cells_.make_grid(&view, chosen_.names, ranks_);
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
