// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include "granular/bytes/find_files.h"
#include "granular/common/words.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/executor.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace granular_c
{
using namespace granular;

namespace
{
const Kind& find_kind(granular_kind wanted, const std::string& path)
{
  for (const Kind& kind : kinds())
  {
    if (wanted == GRANULAR_KIND_AUTOMATIC ? kind.is_file(path) : kind.kind == wanted)
    {
      return kind;
    }
  }
  if (wanted != GRANULAR_KIND_AUTOMATIC)
  {
    throw BadArgument("expected a kind of granular_kind, got " + std::to_string(wanted));
  }
  return kinds().front(); // which says what it expected
}

IndexOptions index_options(const granular_open_options& options, const Kind& kind)
{
  IndexOptions made;
  made.format = &kind.format();
  if (options.repeated_steps < 0 || options.repeated_steps > 2)
  {
    throw BadArgument(
      "expected repeated_steps from 0 to 2, got " + std::to_string(options.repeated_steps));
  }
  made.repeated_steps = kind.has_pieces ? static_cast<RepeatedSteps>(options.repeated_steps)
                                        : RepeatedSteps::Last; // no file is a piece of another
  std::string names = text_of(options.column_names);
  std::ranges::replace(names, ',', ' ');
  for (const std::string_view name : split_words(names))
  {
    made.column_names.emplace_back(name);
  }
  made.threads = options.threads > 0 ? options.threads : available_cores();
  return made;
}
}

void Caller::tell(const Notices& notices) const
{
  for (const Notice& notice : notices)
  {
    if (notice_ != nullptr)
    {
      notice_(to_string(notice).c_str(), user_);
    }
  }
}

Wanted::Wanted(const granular_request& given)
  : request(given)
{
  if (request.stride < 1)
  {
    throw BadArgument("expected a stride of at least 1, got " + std::to_string(request.stride));
  }
  if (request.coordinates < GRANULAR_ABSOLUTE || request.coordinates > GRANULAR_SCALED)
  {
    throw BadArgument(
      "expected coordinates from 0 to 2, got " + std::to_string(request.coordinates));
  }
  if (request.arrays == nullptr && request.array_count > 0)
  {
    throw BadArgument("expected names of arrays, got null");
  }
  all = request.arrays == nullptr;
  for (std::size_t i = 0; i < request.array_count; ++i)
  {
    if (request.arrays[i] == nullptr)
    {
      throw BadArgument("expected names of arrays, got null");
    }
    names.emplace_back(request.arrays[i]);
  }
  threads = request.threads > 0 ? request.threads : available_cores();
}

bool Wanted::is_wanted(std::string_view name, bool is_usual) const
{
  return all ? is_usual : std::ranges::find(names, name) != names.end();
}
}

using namespace granular;
using namespace granular_c;

namespace
{
/// Frames with the timestep of an earlier one in the same file.
std::int64_t count_repeated(const FileIndex& file)
{
  std::vector<std::int64_t> steps;
  for (const FrameEntry& frame : file.frames)
  {
    steps.push_back(frame.timestep);
  }
  std::ranges::sort(steps);
  return steps.end() - std::unique(steps.begin(), steps.end());
}

/// The runs that this thread reads or refreshes. A function for progress must not refresh them: it would wait for itself.
thread_local std::vector<const granular_run*> runs_at_work;

class AtWork
{
public:
  explicit AtWork(const granular_run& run) { runs_at_work.push_back(&run); }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
  ~AtWork() { runs_at_work.pop_back(); }
};
}

granular_run::granular_run(std::vector<std::string> patterns, const granular_open_options& options)
  : timestep_size(options.timestep_size)
  , preset(text_of(options.preset))
  , column_map(text_of(options.column_map))
  , atom_style(text_of(options.atom_style))
  , patterns_(std::move(patterns))
{
  if (!(timestep_size > 0) || !std::isfinite(timestep_size))
  {
    throw BadArgument("expected a timestep_size greater than 0, got " + to_text(timestep_size));
  }
  kind_ = &find_kind(options.kind, find_files(patterns_).front());
  options_ = index_options(options, *kind_);
  Caller caller(options.progress, options.notice, options.user);
  this->refresh(caller);
}

void granular_run::refresh(Caller& caller)
{
  if (std::ranges::find(runs_at_work, this) != runs_at_work.end())
  {
    throw BadArgument(
      "expected a refresh between the other calls of a run, got one from a function "
      "for progress or notices of the same run");
  }
  const AtWork at_work(*this);
  const std::lock_guard refreshing(
    refresh_mutex_); // others, and functions for progress, see the run as it was meanwhile
  Notices notices;
  RunIndex updated = index; // after an error the run is as it was
  updated.update(find_files(patterns_), options_, notices, caller);
  std::vector<double> new_times = updated.times(timestep_size, notices);
  std::vector<LeftOut> new_left_out;
  for (const FileIndex& file : updated.files())
  {
    new_left_out.push_back({ file.defect ? to_string(*file.defect) : "", count_repeated(file) });
  }
  {
    const std::unique_lock lock(mutex);
    shared_index = std::make_shared<const RunIndex>(updated);
    index = std::move(updated);
    times = std::move(new_times);
    left_out = std::move(new_left_out);
    const std::lock_guard guard(offers_mutex_);
    offers_.clear();
  }
  caller.tell(notices);
}

std::size_t granular_run::number_of(std::int64_t frame) const
{
  const auto count = static_cast<std::int64_t>(index.size());
  const std::int64_t number = frame < 0 ? frame + count : frame;
  if (number < 0 || number >= count)
  {
    throw BadArgument("expected a frame from " + std::to_string(-count) + " to " +
      std::to_string(count - 1) + ", got " + std::to_string(frame));
  }
  return static_cast<std::size_t>(number);
}

const std::vector<OfferedArray>& granular_run::arrays(std::size_t frame, int table)
{
  if (table < 0 || table > (kind_->has_bonds ? 1 : 0))
  {
    throw BadArgument(std::string("expected table 0") + (kind_->has_bonds ? " or 1" : "") +
      ", got " + std::to_string(table));
  }
  const FramePiece piece = index.first_piece(frame);
  // frames of one kind have the same columns; other files are looked into one by one
  const bool is_shared = kind_->kind == GRANULAR_KIND_DUMP || kind_->kind == GRANULAR_KIND_LOCAL;
  const std::string key =
    is_shared && piece.entry.kind ? piece.entry.kind->schema.text() : "#" + std::to_string(frame);
  const std::lock_guard guard(offers_mutex_);
  const auto known = offers_.find({ key, table });
  if (known != offers_.end())
  {
    return known->second;
  }
  return offers_[{ key, table }] = kind_->arrays(*this, frame, table);
}

std::unique_ptr<granular_frame> granular_run::read(
  std::size_t frame, const Wanted& wanted, Caller& caller)
{
  const AtWork at_work(*this);
  const std::vector<OfferedArray>& there = this->arrays(frame, wanted.request.table);
  for (const std::string& name : wanted.names)
  {
    if (name != points_name && name != ends_name && name != "length" &&
      std::ranges::find(there, name, &OfferedArray::name) == there.end())
    {
      throw BadArgument("expected an array of " + join_words(there, ", ", &OfferedArray::name) +
          ", got '" + name + "'",
        where_of(index.first_piece(frame)));
    }
  }
  const granular_request& given = wanted.request;
  if (std::ranges::any_of(given.region, [](double bound) { return std::isnan(bound); }))
  {
    throw BadArgument("expected bounds of a region that are numbers, got NaN");
  }
  const auto is_bounded = [&](int axis)
  { return given.region[2 * axis] <= given.region[2 * axis + 1]; };
  if (!kind_->has_parts &&
    (given.stride != 1 || given.coordinates != GRANULAR_ABSOLUTE || given.sort_by_id != 0 ||
      is_bounded(0) || is_bounded(1) || is_bounded(2)))
  {
    throw BadArgument(
      "expected a dump or a data file for stride, region, coordinates and sort_by_id, got "
      "another kind of file",
      where_of(index.first_piece(frame)));
  }
  auto made = std::make_unique<granular_frame>();
  Notices notices;
  kind_->read(*this, frame, wanted, notices, caller, *made);
  made->time = times[frame];
  made->index = shared_index;
  caller.tell(notices);
  return made;
}
