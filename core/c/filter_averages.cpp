// SPDX-License-Identifier: BSD-3-Clause
// GranularPointAverage, GranularEulerAverage and GranularProfile.
#include "filter.h"

#include "granular/averages/cell_averaging.h"
#include "granular/averages/chosen_averages.h"
#include "granular/frames/frame_times.h"
#include "granular/parallel/pieces.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <tuple>

namespace granular_c
{
using namespace granular;

namespace
{
ChosenAverages averages_of(FilterTask& task, ChosenWeights weights)
{
  Settings& settings = task.settings;
  ChosenAverages chosen{ settings.arrays(average_arrays) };
  chosen.names = { settings.text("VelocityArray", "v"), settings.text("RadiusArray", "radius"),
    settings.text("MassArray", "mass"), "" };
  chosen.weights = weights;
  chosen.kernel_width = settings.number("KernelWidth", 0);
  chosen.threads = task.threads;
  return chosen;
}

/// The averages, a row for each cell or point.
std::unique_ptr<granular_frame> frame_of(EulerFrame&& averages, Table&& table)
{
  table.rows = averages.cells;
  for (EulerValues& values : averages.arrays)
  {
    add_array(table, values.name, ValueType::Float64, values.components, block_of(values.values));
  }
  auto frame = make_frame(RowKind::Cells, std::move(table));
  for (FrameArray& array : frame->arrays)
  {
    const auto* const tensor = std::ranges::find(tensor_arrays, array.name, &TensorArray::name);
    if (tensor != std::end(tensor_arrays))
    {
      array.columns = tensor->components;
    }
  }
  return frame;
}

ChosenCells cells_of(Settings& settings, bool profile)
{
  ChosenCells cells;
  cells.bounds = settings.numbers<6>("Bounds", { 1, -1, 1, -1, 1, -1 });
  cells.kernel_bounds = static_cast<KernelBounds>(settings.choice("KernelBounds", 2));
  cells.images = settings.choice("Periodic", 2) == 0;
  cells.time_average = settings.flag("TimeAverage", false);
  if (profile)
  {
    cells.profile = settings.choice("ProfileAxis", 3, 2);
    cells.grid.counts.fill(settings.integer("Layers", 20));
    const double thickness = settings.number("Thickness", 0);
    cells.grid.size = { thickness, thickness, thickness };
    cells.grid.by = thickness == 0 ? EulerGridRequest::By::Counts : EulerGridRequest::By::Size;
    return cells;
  }
  cells.grid.by = static_cast<EulerGridRequest::By>(settings.choice("CellsBy", 3));
  const auto counts = settings.numbers<3>("CellCounts", { 10, 10, 10 });
  std::ranges::transform(counts, cells.grid.counts.begin(),
    [](double count) { return static_cast<std::int64_t>(std::clamp(count, -0x1p53, 0x1p53)); });
  cells.grid.size = settings.numbers<3>("CellSize", { 0.01, 0.01, 0.01 });
  cells.relative_size = settings.number("CellSizeRelative", 3);
  settings.choice("Output", 2, 1); // the same rows
  return cells;
}

std::unique_ptr<granular_frame> facts_of(const EulerGrid& grid)
{
  std::vector<double> spacing;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    spacing.push_back(grid.spacing(axis));
  }
  return make_facts({ { "lo", { grid.lo.begin(), grid.lo.end() } }, { "spacing", spacing },
    { "counts", { grid.counts.begin(), grid.counts.end() } } });
}

WantedCells wanted_in(
  const EulerGrid& grid, const std::optional<std::array<double, 6>>& range, const FilterTask& task)
{
  WantedCells wanted = WantedCells::all(grid);
  if (!range)
  {
    std::tie(wanted.first, wanted.last) = range_of_piece(grid.size(), task.piece, task.pieces);
    return wanted;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    wanted.range.first[axis] = static_cast<std::int64_t>((*range)[2 * axis]);
    wanted.range.last[axis] =
      std::max(wanted.range.first[axis], static_cast<std::int64_t>((*range)[2 * axis + 1]));
  }
  return wanted;
}
}

Frames apply_point_average(FilterTask& task)
{
  const int kernel = task.settings.choice("Kernel", 5, 2);
  PointAveraging averaging(
    averages_of(task, static_cast<ChosenWeights>(std::max(kernel, 2))), task.group, task.notices);
  const std::string left_out = task.settings.text("LeftOut", "");
  const auto given = task.needed_input(3);
  const auto particles = task.particles(0);
  const TaskContacts contacts(task);
  const std::int64_t count = given->view.rows;
  std::vector<double> points(static_cast<std::size_t>(3 * count));
  if (count > 0)
  {
    std::vector<std::int64_t> rows(static_cast<std::size_t>(count));
    std::iota(rows.begin(), rows.end(), std::int64_t{ 0 });
    load_point_rows(given->view, rows, points.data());
  }
  Table table;
  table.header.has_box = false;
  Frames frames;
  frames.push_back(frame_of(
    averaging.average({ particles->view, particles->timestep, left_out, contacts.sources() },
      std::move(points), task.progress),
    std::move(table)));
  return frames;
}

namespace
{
Frames average_in_cells(FilterTask& task, bool profile)
{
  Settings& settings = task.settings;
  const ChosenCells cells = cells_of(settings, profile);
  ChosenAverages chosen =
    averages_of(task, static_cast<ChosenWeights>(settings.choice("Weights", 5, 1)));
  chosen.names.stress = settings.text("StressArray", "");
  const std::string left_out = settings.text("LeftOut", "");
  const auto window = settings.numbers<2>("TimeWindow", { 1, -1 });
  std::array<double, 6> none = {};
  none.fill(-1);
  const auto range = settings.numbers<6>("CellRange", none);
  Frames frames;
  if (settings.flag("GridOnly", false))
  {
    const auto particles = cells.need_frame() ? task.particles(0) : nullptr;
    frames.push_back(
      facts_of(cells.make_grid(particles ? &particles->view : nullptr, chosen.names, task.group)));
    return frames;
  }
  CellAveraging averaging(std::move(chosen), cells, task.group, task.notices);
  std::vector<std::size_t> numbers = { 0 };
  if (cells.time_average)
  {
    numbers = frames_in_window(window, std::max<std::size_t>(task.frames, 1), task.times);
  }
  Table table;
  Vector3 origin = {};
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const auto particles = task.particles(0, numbers[i]);
    const TaskContacts contacts(task, numbers[i]);
    FrameView& view = particles->view;
    const auto count = static_cast<double>(numbers.size());
    task.progress.set_part(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    averaging.add(
      { view, particles->timestep, left_out, contacts.sources() },
      [&](const EulerGrid& grid)
      { return wanted_in(grid, range == none ? std::nullopt : std::optional(range), task); },
      task.ranks, task.progress);
    table.header = view.header;
    table.header.has_box = view.has_box;
    table.header.timestep = particles->timestep.value_or(0);
    origin = view.coordinates == Coordinates::Scaled ? Vector3{} : view.point_origin;
  }
  EulerFrame made = averaging.finish();
  for (std::size_t i = 0; i < made.centres.size() && !cells.profile; ++i)
  {
    made.centres[i] -= origin[i % 3];
  }
  table.points = block_of(made.centres);
  frames.push_back(frame_of(std::move(made), std::move(table)));
  frames.back()->origin = origin;
  frames.push_back(facts_of(averaging.grid()));
  return frames;
}
}

Frames apply_euler_average(FilterTask& task)
{
  return average_in_cells(task, false);
}

Frames apply_profile(FilterTask& task)
{
  return average_in_cells(task, true);
}
}
