// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include "caller_ranks.h"

#include "granular/bytes/find_files.h"
#include "granular/common/archive.h"
#include "granular/common/pass.h"
#include "granular/common/words.h"
#include "granular/geometry/box.h"
#include "granular/lines/line_columns.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/executor.h"

#include <cmath>
#include <type_traits>
#include <utility>

namespace granular_c
{
using namespace granular;

namespace
{
const Kind& choose_kind(const granular_open_options& options, const std::string& path)
{
  if (options.kind != GRANULAR_KIND_AUTOMATIC)
  {
    return kind_of_number(options.kind);
  }
  const Kind* const found = find_kind(path, text_of(options.column_map));
  return found == nullptr ? dump_kind : *found; // whose error says what was expected
}

template <class Choice>
void take_choice(Choice& made, int given, int most, const char* name)
{
  if (given < 0 || given > most)
  {
    throw ArgumentError("expected " + std::string(name) + " from 0 to " + std::to_string(most) +
      ", got " + std::to_string(given));
  }
  made = static_cast<Choice>(given);
}

template <class Count>
Count at_least(std::type_identity_t<Count> least, Count given, const char* name)
{
  if (given < least)
  {
    throw ArgumentError("expected " + std::string(name) + " of at least " + std::to_string(least) +
      ", got " + std::to_string(given));
  }
  return given;
}

RunOptions run_options(const granular_open_options& given)
{
  RunOptions made;
  made.column_names = text_of(given.column_names);
  made.preset = text_of(given.preset);
  made.column_map = text_of(given.column_map);
  made.atom_style = text_of(given.atom_style);
  made.boundary = text_of(given.boundary);
  take_choice(made.history_layout, given.history_layout, 5, "history_layout");
  take_choice(made.repeated_steps, given.repeated_steps, 2, "repeated_steps");
  made.threads = given.threads > 0 ? given.threads : available_cores();
  return made;
}

void take(Request& made, const granular_request& given)
{
  std::copy_n(given.region, 6, made.region.begin());
  made.stride = at_least(1, given.stride, "stride");
  take_choice(made.coordinates, given.coordinates, 2, "coordinates");
  take_choice(made.single_precision, given.single_precision, 1, "single_precision");
  std::copy_n(given.origin, 3, made.point_origin.begin());
  made.sort_by_id = given.sort_by_id != 0;
  take_choice(made.periodic_lines, given.periodic_lines, 2, "periodic_lines");
  made.piece = at_least(0, given.piece, "piece");
  made.pieces = at_least(0, given.pieces, "pieces");
  made.threads = given.threads > 0 ? given.threads : available_cores();
}
}

void Caller::tell(const Notices& notices, Communicator& ranks) const
{
  ArchiveWriter packer;
  pass(packer, notices);
  ranks.broadcast(packer.bytes, 0);
  ArchiveReader unpacker{ packer.bytes };
  Notices of_first;
  pass(unpacker, of_first);
  this->tell(of_first);
}

void Caller::tell(const Notices& notices) const
{
  for (const Notice& notice : notices)
  {
    const std::string message = to_string(notice);
    const granular_error remark = { GRANULAR_OK, message.c_str(), notice.text.c_str(),
      notice.where.path.c_str(), notice.where.line, notice.where.byte, notice.where.column.c_str(),
      0, notice.topic.c_str() };
    if (notice_ != nullptr)
    {
      notice_(&remark, user_);
    }
  }
}

Wanted::Wanted(const granular_request& given, const Communicator& ranks)
  : table(given.table)
{
  if (given.arrays == nullptr && given.array_count > 0)
  {
    throw ArgumentError("expected names of arrays, got null");
  }
  for (std::size_t i = 0; i < given.array_count; ++i)
  {
    if (given.arrays[i] == nullptr)
    {
      throw ArgumentError("expected names of arrays, got null");
    }
    names.emplace_back(given.arrays[i]);
  }
  const bool all = given.arrays == nullptr;
  const Request::Choice choice = [all, list = names](std::string_view name, bool is_usual)
  { return all ? is_usual : std::ranges::find(list, name) != list.end(); };
  take(request, given);
  if (request.pieces == 0 && request.piece == 0)
  {
    request.piece = ranks.rank();
    request.pieces = ranks.size();
  }
  if (request.piece >= request.pieces)
  {
    throw ArgumentError("expected a piece below the number of pieces, " +
      std::to_string(request.pieces) + ", got " + std::to_string(request.piece));
  }
  request.ranges = given.ranges != 0;
  request.points = given.points != 0 && choice(points_name, true);
  request.bonds = table == 1;
  request.wanted = request.bonds ? [](std::string_view, bool) { return false; } : choice;
  request.wanted_bonds = choice;
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
  : ranks_(make_ranks(options.ranks))
  , timestep_size_(options.timestep_size)
  , patterns_(std::move(patterns))
{
  do_together(*ranks_,
    [&]
    {
      run_ = Run(kind_of_first(*ranks_,
        [&]() -> const Kind& { return choose_kind(options, find_files(patterns_).front()); }));
      if (!(timestep_size_ > 0) || !std::isfinite(timestep_size_))
      {
        throw ArgumentError(
          "expected a timestep_size greater than 0, got " + to_text(timestep_size_));
      }
      run_.set_options(run_options(options));
      Caller caller(options.progress, options.notice, options.user);
      this->refresh(caller);
    });
}

void granular_run::expect_idle() const
{
  if (std::ranges::find(runs_at_work, this) != runs_at_work.end())
  {
    throw ArgumentError("expected a refresh between the other calls of a run, and with ranks also "
                        "reading, got one from a function for progress or notices "
                        "of the same run");
  }
}

void granular_run::refresh(Caller& caller)
{
  const AtWork at_work(*this);
  const std::lock_guard refreshing(
    refresh_mutex_); // others, and functions for progress, see the run as it was meanwhile
  Notices notices;
  Run updated = run_.without_offers();    // after an error the run is as it was
  const bool first = ranks_->rank() == 0; // which looks for all
  do_together(*ranks_,
    [&]
    {
      updated.refresh(first ? find_files(patterns_) : std::vector<std::string>(), run_.options(),
        *ranks_, notices, caller);
    });
  std::vector<double> new_times = updated.index().times(timestep_size_, notices);
  std::vector<LeftOut> new_left_out;
  for (const FileIndex& file : updated.index().files())
  {
    new_left_out.push_back({ file.defect ? to_string(*file.defect) : "", count_repeated(file) });
  }
  {
    const std::unique_lock lock(mutex);
    shared_index = std::make_shared<const RunIndex>(updated.index());
    run_ = std::move(updated);
    std::ranges::for_each(every_array_, &std::vector<OfferedArray>::clear);
    times = std::move(new_times);
    left_out = std::move(new_left_out);
  }
  caller.tell(this->news(std::move(notices), true), *ranks_);
}

Notices granular_run::news(Notices notices, bool of_files)
{
  const std::lock_guard guard(told_mutex_);
  std::erase_if(notices,
    [&](const Notice& notice) { return !told_.insert(subject_of(notice, of_files)).second; });
  return notices;
}

std::size_t granular_run::number_of(std::int64_t frame) const
{
  const auto count = static_cast<std::int64_t>(this->index().size());
  const std::int64_t number = frame < 0 ? frame + count : frame;
  if (number < 0 || number >= count)
  {
    throw ArgumentError("expected a frame from " + std::to_string(-count) + " to " +
      std::to_string(count - 1) + ", got " + std::to_string(frame));
  }
  return static_cast<std::size_t>(number);
}

void granular_run::expect_table(int table) const
{
  if (table < 0 || table > (this->kind().has_bonds ? 1 : 0))
  {
    throw ArgumentError(std::string("expected table 0") + (this->kind().has_bonds ? " or 1" : "") +
      ", got " + std::to_string(table));
  }
}

const Offer& granular_run::offer(std::size_t frame, int table)
{
  this->expect_table(table);
  const std::lock_guard guard(offers_mutex_);
  Progress progress;
  return run_.offer(frame, progress);
}

const std::vector<OfferedArray>& granular_run::every_array(int table)
{
  this->expect_table(table);
  const std::lock_guard guard(offers_mutex_);
  Progress progress;
  run_.look(*ranks_, progress);
  std::vector<OfferedArray>& known = every_array_[static_cast<std::size_t>(table)];
  for (OfferedArray& array : run_.arrays(static_cast<std::size_t>(table)))
  {
    if (std::ranges::find(known, array.name, &OfferedArray::name) == known.end())
    {
      known.push_back(std::move(array));
    }
  }
  return known;
}

std::unique_ptr<granular_frame> granular_run::read(
  std::int64_t number, const granular_request& given)
{
  const AtWork at_work(*this);
  const std::size_t frame = this->number_of(number);
  const Wanted wanted(given, *ranks_);
  Caller caller(given.progress, given.notice, given.user);
  const Offer& told = this->offer(frame, wanted.table);
  if (!told.error.empty())
  {
    throw FormatError(told.error, told.where);
  }
  const std::vector<OfferedArray>& there = told.tables[static_cast<std::size_t>(wanted.table)];
  for (const std::string& name : wanted.names)
  {
    if (name != points_name && name != ends_name && name != "length" &&
      std::ranges::find(there, name, &OfferedArray::name) == there.end())
    {
      throw ArgumentError("expected an array of " + join_words(there, ", ", &OfferedArray::name) +
          ", got '" + name + "'",
        where_of(this->index().first_piece(frame)));
    }
  }
  const Request& asked = wanted.request;
  if (std::ranges::any_of(asked.region, [](double bound) { return std::isnan(bound); }))
  {
    throw ArgumentError("expected bounds of a region that are numbers, got NaN");
  }
  if (!this->kind().has_parts &&
    (asked.stride != 1 || asked.coordinates != Coordinates::Absolute || asked.sort_by_id ||
      restricts(asked.region)))
  {
    throw ArgumentError(
      "expected a dump or a data file for stride, region, coordinates and sort_by_id, got "
      "another kind of file",
      where_of(this->index().first_piece(frame)));
  }
  if (given.pieces > 1 &&
    (this->kind().rows == RowKind::Cells || this->kind().rows == RowKind::Subdomains))
  {
    throw ArgumentError("expected no pieces of cells or subdomains, which are read whole, got " +
        std::to_string(given.pieces),
      where_of(this->index().first_piece(frame)));
  }
  Request request = asked;
  request.points = asked.points && told.has_points;
  request.pool = given.take == 0 ? pool : std::make_shared<BlockPool>(0);
  pool->next_frame();
  std::vector<std::string> names = wanted.names;
  names.push_back(given.arrays == nullptr ? "all" : "named");
  Communicator& group = run_.group(frame, request, names, *ranks_, alone_);
  Notices notices;
  SharedProgress progress(caller, group);
  Tables read = run_.read(frame, request, told, group, notices, progress);
  const bool split = request.periodic_lines == PeriodicLines::Split;
  repeat_rows(request.bonds ? read.bonds : read.rows);
  auto made = request.bonds ? std::make_unique<granular_frame>(
                                RowKind::Lines, std::move(read.bonds), local_known_columns(), split)
                            : std::make_unique<granular_frame>(this->kind().rows,
                                std::move(read.rows), this->kind().columns(), split, read.groups);
  if (made->kind != RowKind::Subdomains) // which are where the file has them
  {
    made->origin = request.point_origin;
  }
  made->time = times[frame];
  made->where = where_of(this->index().first_piece(frame));
  made->index = shared_index;
  caller.tell(this->news(std::move(notices), false), group);
  return made;
}
