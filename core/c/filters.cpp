// SPDX-License-Identifier: BSD-3-Clause
// The function of granular_filters.h, and what its filters share.
#include "caller_ranks.h"
#include "filter.h"
#include "guard.h"
#include "run.h"

#include "granular/averages/chosen_averages.h"
#include "granular/common/words.h"
#include "granular/contacts/chosen_sums.h"
#include "granular/lines/line_columns.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/executor.h"
#include "granular/parallel/pieces.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/known_arrays.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace granular_c
{
using namespace granular;

namespace
{
struct Filter
{
  const char* name;
  Frames (*apply)(FilterTask& task);
  std::span<const MadeArray> arrays = {}; ///< to choose from
};

constexpr Filter filters[] = {
  { "GranularPackingSource", apply_packing },
  { "GranularLocalJoin", apply_local_join },
  { "GranularDecompositionSource", apply_decomposition_source },
  { "GranularDecomposition", apply_decomposition },
  { "GranularContactSums", apply_contact_sums, contact_sum_arrays },
  { "GranularPointAverage", apply_point_average, average_arrays },
  { "GranularEulerAverage", apply_euler_average, average_arrays },
  { "GranularProfile", apply_profile, average_arrays },
  { "GranularCompare", apply_compare },
  { "GranularTrajectories", apply_trajectories },
  { "GranularHistory", apply_history },
};

const Filter& find_filter(const std::string& name)
{
  const auto* const found = std::ranges::find(filters, name, &Filter::name);
  if (found == std::end(filters))
  {
    throw ArgumentError(
      "expected a filter of " + join_words(filters, ", ", &Filter::name) + ", got '" + name + "'");
  }
  return *found;
}

Frames apply(const granular_task& given, Communicator& ranks)
{
  const Filter& filter = find_filter(text_of(given.filter));
  Caller caller(given.progress, given.notice, given.user);
  FilterTask task(given, ranks, caller);
  task.progress.step(0);
  Frames made = filter.apply(task);
  task.settings.expect_known(filter.name);
  task.progress.set_part(1, 1);
  task.progress.step(1);
  if (ranks.rank() == 0 || !task.together)
  {
    caller.tell(task.notices);
  }
  return made;
}
}

// ---- settings ------------------------------------------------------------------------------------
Settings::Settings(std::span<const granular_setting> given)
  : given_(given)
{
  for (const granular_setting& setting : given)
  {
    if (setting.name == nullptr || (setting.text == nullptr) == (setting.numbers == nullptr))
    {
      throw ArgumentError(
        "setting '" + text_of(setting.name) + "': expected a name, and either a text or numbers");
    }
  }
}

const granular_setting* Settings::find(const char* name)
{
  asked_.insert(name);
  const auto found = std::ranges::find_if(
    given_, [&](const granular_setting& each) { return std::strcmp(each.name, name) == 0; });
  return found == given_.end() ? nullptr : &*found;
}

void Settings::find(const char* name, std::span<double> numbers)
{
  const granular_setting* const found = this->find(name);
  if (found == nullptr)
  {
    return;
  }
  if (found->numbers == nullptr || found->count != numbers.size())
  {
    throw ArgumentError(std::string("setting '") + name + "': expected as many numbers as " +
      std::to_string(numbers.size()) + ", got " +
      (found->numbers == nullptr ? "a text" : std::to_string(found->count)));
  }
  std::copy_n(found->numbers, numbers.size(), numbers.begin());
}

std::string Settings::text(const char* name, const char* otherwise)
{
  const granular_setting* const found = this->find(name);
  if (found != nullptr && found->text == nullptr)
  {
    throw ArgumentError(std::string("setting '") + name + "': expected a text, got numbers");
  }
  return found == nullptr ? otherwise : found->text;
}

double Settings::number(const char* name, double otherwise)
{
  this->find(name, { &otherwise, 1 });
  return otherwise;
}

std::int64_t Settings::integer(const char* name, std::int64_t otherwise)
{
  const double found = this->number(name, static_cast<double>(otherwise));
  if (std::trunc(found) != found || std::abs(found) > 0x1p53)
  {
    throw ArgumentError(std::string("setting '") + name +
      "': expected a whole number of up to 2^53, got " + to_text(found));
  }
  return static_cast<std::int64_t>(found);
}

int Settings::choice(const char* name, int choices, int otherwise)
{
  const std::int64_t found = this->integer(name, otherwise);
  if (found < 0 || found >= choices)
  {
    throw ArgumentError(std::string("setting '") + name + "': expected a choice from 0 to " +
      std::to_string(choices - 1) + ", got " + std::to_string(found));
  }
  return static_cast<int>(found);
}

std::vector<double> Settings::list(const char* name)
{
  const granular_setting* const found = this->find(name);
  if (found != nullptr && found->numbers == nullptr)
  {
    throw ArgumentError(std::string("setting '") + name + "': expected numbers, got a text");
  }
  return found == nullptr ? std::vector<double>()
                          : std::vector<double>(found->numbers, found->numbers + found->count);
}

ArrayChoice Settings::arrays(std::span<const MadeArray> known)
{
  std::string usual;
  std::vector<std::string> all;
  for (const MadeArray& array : known)
  {
    all.emplace_back(array.name);
    usual += array.on ? all.back() + ' ' : std::string();
  }
  return { known, names_in(this->text("Arrays", usual.c_str()), all) };
}

void Settings::expect_known(const std::string& filter) const
{
  for (const granular_setting& each : given_)
  {
    if (!asked_.contains(each.name))
    {
      throw ArgumentError("expected a setting of " + filter + ": " +
        join_words(asked_, ", ", [](std::string_view name) { return std::string(name); }) +
        ", got '" + each.name + "'");
    }
  }
}

// ---- tasks ---------------------------------------------------------------------------------------
FilterInput::FilterInput(const granular_content& content)
  : rows(content, RowKind::Cells) // as they are: a writer would name columns
  , view(rows.view)
  , are_lines(rows.ends.has_value())
{
  if (content.timestep != GRANULAR_NO_TIMESTEP)
  {
    timestep = content.timestep;
  }
  view.header.timestep = timestep.value_or(0);
  const auto ghosts = std::ranges::find(view.arrays, GRANULAR_GHOSTS, &ArrayView::name);
  if (ghosts != view.arrays.end())
  {
    if (ghosts->type != ValueType::UInt8 || ghosts->size() != 1)
    {
      throw ArgumentError("array '" GRANULAR_GHOSTS "': expected one uint8 for each row");
    }
    view.ghosts = static_cast<const unsigned char*>(ghosts->components[0]);
    view.arrays.erase(ghosts);
  }
}

std::vector<double> FilterInput::absolute_ends() const
{
  if (!rows.ends)
  {
    return {};
  }
  FrameView points;
  points.header = view.header;
  points.has_box = view.has_box;
  points.coordinates = view.coordinates;
  points.point_origin = view.point_origin;
  points.rows = 2 * view.rows;
  points.points = view_rows(points_name, ValueType::Float64, rows.ends->components[0], 3);
  return absolute_points(points);
}

FilterTask::FilterTask(const granular_task& given, Communicator& all, Progress& caller)
  : settings({ given.settings, given.settings == nullptr ? 0 : given.setting_count })
  , ranks(all)
  , frames(given.frames)
  , times(given.times, given.times + (given.times == nullptr ? 0 : given.frames))
  , shown(given.shown)
  , piece(given.pieces > 0 ? given.piece : all.rank())
  , pieces(given.pieces > 0 ? given.pieces : all.size())
  , together(are_together(piece, pieces, given.input == nullptr, all))
  , group(together ? ranks : alone_)
  , threads(given.threads > 0 ? given.threads : available_cores())
  , progress(caller)
  , given_(given)
{
  if (shown >= frames)
  {
    throw ArgumentError("expected the number of a frame from 0 to " + std::to_string(frames) +
      " - 1, got " + std::to_string(shown));
  }
  if (piece < 0 || piece >= pieces)
  {
    throw ArgumentError("expected a piece from 0 to " + std::to_string(pieces - 1) + ", got " +
      std::to_string(piece));
  }
}

std::unique_ptr<FilterInput> FilterTask::input(std::size_t port, std::size_t frame)
{
  agree(ranks, nullptr); // where one has failed, no other asks and waits there
  return do_together(ranks,
    [&]() -> std::unique_ptr<FilterInput>
    {
      const granular_content* content = nullptr;
      const char* failure = nullptr;
      if (given_.input != nullptr &&
        given_.input(port, frame, &content, &failure, given_.user) != 0)
      {
        if (failure == nullptr)
        {
          throw Cancelled{};
        }
        throw Error(failure);
      }
      return content == nullptr
        ? nullptr
        : std::make_unique<FilterInput>(taken(content, granular_content_init));
    });
}

std::unique_ptr<FilterInput> FilterTask::needed_input(std::size_t port, std::size_t frame)
{
  std::unique_ptr<FilterInput> found = this->input(port, frame);
  if (found == nullptr)
  {
    throw ArgumentError("expected an input " + std::to_string(port) + ", got none");
  }
  return found;
}

std::unique_ptr<FilterInput> FilterTask::particles(std::size_t port, std::size_t frame)
{
  std::unique_ptr<FilterInput> found = this->needed_input(port, frame);
  share_header(found->view, ranks);
  return found;
}

std::pair<std::int64_t, std::int64_t> FilterTask::range_of(std::int64_t count) const
{
  return together ? std::pair(std::int64_t{ 0 }, count) : range_of_piece(count, piece, pieces);
}

TaskContacts::TaskContacts(FilterTask& task, std::size_t frame)
{
  for (std::size_t i = 0; i < 2; ++i)
  {
    inputs_[i] = task.input(i + 1, frame);
    if (const FilterInput* const input = inputs_[i].get())
    {
      rows_[i].emplace(input->view, input->are_lines);
      sources_[i] = { &*rows_[i], [input] { return input->absolute_ends(); }, input->timestep };
    }
  }
}

// ---- results -------------------------------------------------------------------------------------
std::unique_ptr<granular_frame> make_frame(RowKind kind, Table&& table, bool split)
{
  const std::span<const KnownColumn> known =
    kind == RowKind::Lines ? local_known_columns() : known_columns();
  return std::make_unique<granular_frame>(kind, std::move(table), known, split);
}

std::unique_ptr<granular_frame> make_facts(
  const std::vector<std::pair<std::string_view, std::vector<double>>>& facts)
{
  Table table;
  table.rows = 1;
  table.header.has_box = false;
  for (const auto& [name, values] : facts)
  {
    add_array(table, name, ValueType::Float64, static_cast<int>(values.size()), block_of(values));
  }
  return make_frame(RowKind::Cells, std::move(table));
}
}

using namespace granular_c;

extern "C"
{
  const char* granular_made_array(const char* filter, size_t number, int* on)
  {
    const auto* const found = std::ranges::find(filters, text_of(filter), &Filter::name);
    if (found == std::end(filters) || number >= found->arrays.size())
    {
      return nullptr;
    }
    if (on != nullptr)
    {
      *on = found->arrays[number].on ? 1 : 0;
    }
    return found->arrays[number].name;
  }

  void granular_task_init(granular_task* task)
  {
    if (task != nullptr)
    {
      *task = {};
      task->size = sizeof(*task);
      task->filter = "";
      task->frames = 1;
    }
  }

  granular_status granular_apply(
    const granular_task* task, granular_frame** results, size_t most, size_t* count)
  {
    return guarded(
      [&]
      {
        needed(count, "count") = 0;
        const granular_task given = taken(&needed(task, "a task"), granular_task_init);
        const std::unique_ptr<granular::Communicator> ranks = make_ranks(given.ranks);
        Frames made = granular::do_together(*ranks,
          [&]
          {
            Frames all = apply(given, *ranks);
            if (all.size() > most)
            {
              throw granular::ArgumentError("expected room for " + std::to_string(all.size()) +
                " results, got " + std::to_string(most));
            }
            needed(results, "results");
            return all;
          });
        *count = made.size();
        for (std::size_t i = 0; i < made.size(); ++i)
        {
          results[i] = made[i].release();
        }
      });
  }
}
