// SPDX-License-Identifier: BSD-3-Clause
// GranularCompare, GranularTrajectories and GranularHistory.
#include "filter.h"

#include "granular/parallel/executor.h"
#include "granular/parallel/trade.h"
#include "granular/paths/compare_frames.h"
#include "granular/paths/history.h"
#include "granular/paths/trajectories.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace granular_c
{
using namespace granular;

namespace
{
std::unique_ptr<granular_frame> frame_of(ComparedRows&& rows)
{
  Table table = std::move(rows.made);
  rows.rows.insert(rows.rows.end(), rows.lost.begin(), rows.lost.end());
  table.rows = std::ssize(rows.rows);
  table.header.has_box = false;
  add_array(table, "input_row", ValueType::Int64, 1, block_of(rows.rows));
  return make_frame(RowKind::Cells, std::move(table));
}

/// A frame of the inputs of GranularCompare.
struct ComparedFrame
{
  std::unique_ptr<FilterInput> particles;
  std::unique_ptr<FilterInput> lines;
  std::optional<LineRows> rows;

  void take_lines(FilterTask& task, std::size_t port, std::size_t number)
  {
    lines = task.input(port, number);
    if (lines != nullptr)
    {
      rows.emplace(lines->view, lines->are_lines);
    }
  }

  ComparedInput input(bool of_lines) const
  {
    return { of_lines ? nullptr : &particles->view, rows ? &*rows : nullptr };
  }
};

/// Returns true if no rank has particles with ids, and some rank has lines in their place, which are taken.
bool takes_lines(
  FilterTask& task, std::array<ComparedFrame, 2>& frames, const FrameCompareRequest& request)
{
  std::array<std::int64_t, 2> counts = {};
  for (const ComparedFrame& frame : frames)
  {
    counts[0] += frame.particles->view.find("id") != nullptr ? 1 : 0;
  }
  task.group.sum(counts);
  std::int64_t lack = counts[0] == 0 ? 1 : 0;
  task.ranks.sum({ &lack, 1 });
  if (lack == 0)
  {
    return false;
  }
  std::array<ComparedFrame, 2> others;
  others[0].take_lines(task, 2, request.shown);
  others[1].take_lines(task, 2, request.reference_number);
  for (const ComparedFrame& other : others)
  {
    counts[1] += other.rows && other.rows->has("id1") && other.rows->has("id2") ? 1 : 0;
  }
  task.group.sum({ &counts[1], 1 });
  if (counts[0] > 0 || counts[1] == 0)
  {
    return false;
  }
  if (frames[0].lines != nullptr)
  {
    throw Error("expected particles with the point array 'id' as Input of Lines, got lines");
  }
  for (std::size_t i = 0; i < 2; ++i)
  {
    frames[i].lines = std::move(others[i].lines);
    frames[i].rows = std::move(others[i].rows);
  }
  return true;
}
}

Frames apply_compare(FilterTask& task)
{
  FrameCompareRequest request;
  request.reference = static_cast<ReferenceFrame>(task.settings.choice("Reference", 3));
  request.reference_time = task.settings.number("ReferenceTime", 0);
  request.differences = task.settings.text("Differences", "");
  request.mass_array = task.settings.text("MassArray", "mass");
  request.times = task.times;
  request.shown = task.shown;
  request.threads = task.threads;
  if (!task.together)
  {
    request.piece = task.piece;
    request.pieces = task.pieces;
  }
  std::array<ComparedFrame, 2> frames;
  frames[0].particles = task.needed_input(0, task.shown);
  const auto find_first = [&]() -> std::size_t
  {
    std::int64_t known = frames[0].particles->view.find("id") != nullptr ? 1 : 0;
    task.ranks.sum({ &known, 1 });
    for (std::size_t frame = 0; known > 0 && frame < task.shown; ++frame)
    {
      std::int64_t rows = task.needed_input(0, frame)->view.rows;
      task.ranks.sum({ &rows, 1 });
      if (rows > 0)
      {
        return frame;
      }
    }
    return known > 0 ? task.shown : 0;
  };
  request.reference_number = find_reference(request, find_first);
  frames[1].particles = task.needed_input(0, request.reference_number);
  frames[0].take_lines(task, 1, request.shown);
  frames[1].take_lines(task, 1, request.reference_number);
  const bool of_lines = takes_lines(task, frames, request);
  for (ComparedFrame& frame : frames)
  {
    if (!of_lines)
    {
      share_header(frame.particles->view, task.ranks);
    }
  }
  ComparedFrames compared = compare_frames(frames[0].input(of_lines), frames[1].input(of_lines),
    request, task.group, task.notices, task.progress);
  Frames made;
  made.push_back(frame_of(std::move(compared.particles)));
  made.push_back(frame_of(std::move(compared.lines)));
  made.push_back(make_facts({ { "of_lines", { of_lines ? 1.0 : 0.0 } },
    { "reference", { static_cast<double>(request.reference_number) } } }));
  return made;
}

namespace
{
/// The particles of the first input, frame by frame.
class InputFrames final : public FrameLoader
{
public:
  explicit InputFrames(FilterTask& task)
    : task_(task)
  {
  }

  const std::vector<double>& times() const override { return task_.times; }

  std::vector<PathFrame> load(const std::vector<std::size_t>& numbers, const PathRequest& request,
    Notices& /*notices*/, PartialProgress& progress) override
  {
    std::vector<PathFrame> frames;
    for (const std::size_t number : numbers)
    {
      progress.step(static_cast<double>(frames.size()) / static_cast<double>(numbers.size()));
      Progress quiet;
      frames.push_back(this->pick(number, request, quiet, {}));
    }
    return frames;
  }

  PathFrame load_part(std::size_t number, const PathRequest& request, Notices& /*notices*/,
    PartialProgress& progress, PathFrame spent) override
  {
    return this->pick(number, request, progress, std::move(spent));
  }

private:
  PathFrame pick(
    std::size_t number, const PathRequest& request, Progress& progress, PathFrame spent)
  {
    const auto input = task_.needed_input(0, number);
    return do_together(task_.ranks,
      [&]
      {
        share_header(input->view, task_.group);
        const std::vector<std::int64_t> rows = gather(task_.group, input->view.rows);
        const std::int64_t first =
          std::accumulate(rows.begin(), rows.begin() + task_.group.rank(), std::int64_t{ 0 });
        return pick_particles(
          input->view, request, first, Executor(task_.threads), progress, std::move(spent));
      });
  }

  FilterTask& task_;
};

PathTask path_task_of(FilterTask& task, InputFrames& frames)
{
  Settings& settings = task.settings;
  PathChoice choice;
  choice.ids = settings.text("Ids", "");
  choice.every_nth = std::max<std::int64_t>(settings.integer("EveryNth", 1), 1);
  choice.samples = settings.integer("NumberOfSamples", -1);
  choice.seed = settings.integer("Seed", 0);
  choice.region = settings.numbers<6>("RegionOfInterest", choice.region);
  choice.selection_frame = settings.integer("SelectionFrame", -1);
  choice.window = settings.numbers<2>("TimeWindow", choice.window);
  choice.stride = std::max<std::int64_t>(settings.integer("FrameStride", 1), 1);
  choice.arrays = settings.text("Arrays", "");
  const auto shown = task.particles(0, task.shown);
  return { frames, choice, shown->view, task.group, task.ranks, task.notices, task.progress };
}
}

Frames apply_trajectories(FilterTask& given)
{
  InputFrames frames(given);
  const bool split = given.settings.choice("PeriodicLines", 2) != 0;
  const std::int64_t tail = given.settings.integer("Tail", 0);
  PathTask task = path_task_of(given, frames);
  task.choose_few(40);
  if (tail > 0)
  {
    task.keep_tail(given.times.empty() ? 0 : given.times[given.shown], tail);
  }
  given.progress.set_part(0, 0.8);
  std::vector<PathFrame> loaded = task.load();
  given.progress.set_part(0.8, 1);
  Trajectories made = draw_trajectories(task, std::move(loaded), split, tail == 0,
    given.together ? 0 : given.piece, given.together ? 1 : given.pieces);
  add_array(made.cells, "first_point", ValueType::Int64, 1, block_of(made.firsts));
  add_array(made.cells, "end_point", ValueType::Int64, 1, block_of(made.ends));
  made.cells.header.has_box = false;
  Frames results;
  results.push_back(make_frame(RowKind::Particles, std::move(made.points)));
  results.front()->origin = task.origin;
  results.push_back(make_frame(RowKind::Cells, std::move(made.cells)));
  return results;
}

Frames apply_history(FilterTask& given)
{
  InputFrames frames(given);
  HistoryRequest request;
  request.statistics = given.settings.choice("Output", 2) != 0;
  request.quantiles = given.settings.text("Quantiles", "0.5");
  request.square_displacement = given.settings.flag("MeanSquareDisplacement", false);
  request.threads = given.threads;
  PathTask task = path_task_of(given, frames);
  Table table = make_history(task, request);
  if (given.piece != 0)
  {
    table.arrays.clear();
  }
  Frames results;
  results.push_back(make_frame(RowKind::Cells, std::move(table)));
  return results;
}
}
