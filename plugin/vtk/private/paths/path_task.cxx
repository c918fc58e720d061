// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/path_task.h"

#include "private/dump/dump_input.h"

#include "granular/memory/block.h"
#include "granular/parallel/executor.h"
#include "granular/parallel/trade.h"

#include "vtkAlgorithm.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The memory that frames are decoded in is used again for the next ones.
 */
constexpr std::size_t PoolBytes = std::size_t{ 1 } << 30;

granular::Coordinates FormOf(const granular::Request& shown, const granular::PathRequest& request)
{
  return shown.coordinates == granular::Coordinates::Unwrapped && !request.absolute
    ? granular::Coordinates::Unwrapped
    : granular::Coordinates::Absolute;
}
}

PathFrames::PathFrames(
  vtkAlgorithm* consumer, granular::Communicator& group, granular::Communicator& ranks, int threads)
  : Group(group)
  , Ranks(ranks)
  , Threads(threads)
{
  this->Input.emplace(consumer, InputFrames::Part{ group.rank(), group.size(), 0 });
  this->Times = this->Input->GetTimes();
  CheckTimes(this->Times, ranks);
  this->Reader = ReaderFrames::Find(consumer);
  if (this->Reader && this->Reader->Index->size() != this->size())
  {
    this->Reader.reset();
  }
  // all of them read the files, or none
  std::int64_t readers = this->Reader ? 1 : 0;
  ranks.sum({ &readers, 1 });
  if (readers != ranks.size())
  {
    this->Reader.reset();
  }
  if (this->Reader)
  {
    this->Reader->Request.pool = std::make_shared<granular::BlockPool>(PoolBytes);
  }
}

std::vector<granular::PathFrame> PathFrames::load(const std::vector<std::size_t>& numbers,
  const granular::PathRequest& request, granular::Notices& notices,
  granular::PartialProgress& progress)
{
  std::vector<granular::PathFrame> frames(numbers.size());
  if (!this->Reader)
  {
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      progress.step(static_cast<double>(i) / static_cast<double>(numbers.size()));
      granular::Progress quiet;
      frames[i] = this->Request(numbers[i], request, quiet);
    }
    return frames;
  }
  for (granular::PathFrame& frame : frames)
  {
    for (const std::string& name : request.arrays)
    {
      frame.arrays.push_back({ name });
    }
  }
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (static_cast<int>(i % static_cast<std::size_t>(this->Group.size())) == this->Group.rank())
    {
      own.push_back(i);
    }
  }
  granular::Request base = this->Reader->Request;
  base.coordinates = FormOf(base, request);
  base.threads = std::max(1, this->Threads / std::max(1, static_cast<int>(own.size())));
  std::vector<granular::Notices> said(own.size());
  granular::do_together(this->Ranks,
    [&]
    {
      granular::Executor(this->Threads)
        .parallel_for(
          own.size(),
          [&](std::size_t i, std::size_t)
          {
            granular::Progress quiet; // that of the whole is reported between frames
            frames[own[i]] = granular::read_particles(
              this->Reader->Index->pieces(numbers[own[i]]), request, base, said[i], quiet);
          },
          progress);
    });
  for (const granular::Notices& some : said)
  {
    notices.insert(notices.end(), some.begin(), some.end());
  }
  return frames;
}

granular::PathFrame PathFrames::load_part(std::size_t number, const granular::PathRequest& request,
  granular::Notices& notices, granular::PartialProgress& progress, granular::PathFrame spent)
{
  if (!this->Reader)
  {
    return this->Request(number, request, progress);
  }
  granular::Request base = this->Reader->Request;
  base.coordinates = FormOf(base, request);
  base.threads = this->Threads;
  base.piece = this->Group.rank();
  base.pieces = this->Group.size();
  return granular::do_together(this->Ranks,
    [&]
    {
      return granular::read_particles(
        this->Reader->Index->pieces(number), request, base, notices, progress, std::move(spent));
    });
}

granular::PathFrame PathFrames::Request(
  std::size_t number, const granular::PathRequest& request, granular::Progress& progress)
{
  this->Input->Update(
    this->Times.empty() ? std::nullopt : std::optional(this->Times[number]), this->Ranks);
  return granular::do_together(this->Ranks,
    [&]
    {
      const Particles particles(this->Input->GetData(), this->Group);
      const granular::FrameView& view = particles.View;
      const std::vector<std::int64_t> rows = granular::gather(this->Group, view.rows);
      const std::int64_t first =
        std::accumulate(rows.begin(), rows.begin() + this->Group.rank(), std::int64_t{ 0 });
      return granular::pick_particles(
        view, request, first, granular::Executor(this->Threads), progress);
    });
}

void PathFrames::name_rows(std::int64_t id, std::size_t number) const
{
  if (!this->Reader)
  {
    return;
  }
  granular::PathRequest all;
  all.points = false;
  granular::Request base;
  base.pool = this->Reader->Request.pool;
  granular::Notices notices;
  granular::Progress quiet;
  const std::vector<granular::FramePiece> pieces = this->Reader->Index->pieces(number);
  const granular::PathFrame frame = granular::read_particles(pieces, all, base, notices, quiet);
  const auto first = std::ranges::find(frame.ids, id);
  const auto second = first == frame.ids.end() ? first : std::find(first + 1, frame.ids.end(), id);
  if (second != frame.ids.end())
  {
    granular::throw_repeated(id, frame.header.timestep, first - frame.ids.begin(),
      second - frame.ids.begin(), granular::where_of(pieces.front()));
  }
}
}

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
granular::PathTask vtkGranularPathAlgorithm::PathTask::Choose()
{
  granular::PathChoice choice;
  choice.ids = this->Self->Ids;
  choice.every_nth = this->Self->EveryNth;
  choice.samples = this->Self->NumberOfSamples;
  choice.seed = this->Self->Seed;
  std::copy_n(this->Self->RegionOfInterest, choice.region.size(), choice.region.begin());
  choice.selection_frame = this->Self->SelectionFrame;
  std::copy_n(this->Self->TimeWindow, 2, choice.window.begin());
  choice.stride = this->Self->FrameStride;
  choice.arrays = this->Self->Arrays;
  const Particles shown(this->GetInput(0), this->Ranks);
  return { this->Frames, choice, shown.View, this->Group, this->Ranks, this->Notices,
    this->Progress };
}
