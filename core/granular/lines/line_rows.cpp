// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/line_rows.h"

#include "granular/common/error.h"
#include "granular/lines/fetch_particles.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace granular
{
namespace
{
constexpr const char* part_name = "part";

bool is_text(const ArrayView& array)
{
  return array.type == ValueType::Text;
}
}

LineRows::LineRows(const FrameView& cells, bool are_lines)
  : cells_(&cells)
  , are_lines_(are_lines)
{
  const std::vector<double> parts = this->parts();
  are_all_ = cells.ghosts == nullptr && parts.empty();
  for (std::int64_t cell = 0; !are_all_ && cell < cells.rows; ++cell)
  {
    if (!cells.is_duplicate(cell) && (parts.empty() || parts[static_cast<std::size_t>(cell)] == 0))
    {
      own_.push_back(cell);
    }
  }
}

/// The parts of all cells; none where lines are whole.
std::vector<double> LineRows::parts() const
{
  std::vector<double> parts(this->has_parts() ? static_cast<std::size_t>(cells_->rows) : 0);
  if (!parts.empty())
  {
    std::vector<std::int64_t> all(parts.size());
    std::iota(all.begin(), all.end(), std::int64_t{ 0 });
    load_numbers(component_of(*cells_->find(part_name), 0), all, parts.data());
  }
  return parts;
}

std::vector<std::int64_t> LineRows::find_begins() const
{
  if (!are_all_)
  {
    return own_;
  }
  std::vector<std::int64_t> all(static_cast<std::size_t>(cells_->rows));
  std::iota(all.begin(), all.end(), std::int64_t{ 0 });
  return all;
}

std::vector<std::int64_t> LineRows::find_ends() const
{
  std::vector<std::int64_t> ends = this->find_begins();
  const std::vector<double> parts = this->parts();
  // parts but the first of each line
  std::int64_t later = std::ssize(parts) - std::ranges::count(parts, 0);
  for (std::int64_t& end : ends)
  {
    while (later > 0 && end + 1 < cells_->rows &&
      parts[static_cast<std::size_t>(end + 1)] == parts[static_cast<std::size_t>(end)] + 1)
    {
      ++end;
      --later;
    }
  }
  if (later > 0)
  {
    throw Error("expected the parts of each line one after the other, got " +
      std::to_string(later) +
      " of other lines or places: with PeriodicLines MinimumImage lines are whole");
  }
  return ends;
}

void LineRows::keep(std::pair<std::int64_t, std::int64_t> range)
{
  std::vector<std::int64_t> kept;
  for (std::int64_t row = range.first; row < range.second; ++row)
  {
    kept.push_back(this->cell_of(row));
  }
  are_all_ = are_all_ && std::ssize(kept) == cells_->rows;
  own_ = std::move(kept);
}

bool LineRows::has_numbers(std::string_view name) const
{
  const ArrayView* const array = cells_->find(name);
  return array != nullptr && !is_text(*array) && array->size() == 1;
}

bool LineRows::has_parts() const
{
  return are_lines_ && this->has_numbers(part_name) &&
    cells_->find(part_name)->type < ValueType::Float32;
}

bool LineRows::lack_places() const
{
  return cells_->rows == 0 && cells_->arrays.empty() && !cells_->columns.empty() &&
    std::ranges::count(cells_->columns, "x1") == 0;
}

const ArrayView& LineRows::see(const std::string& name, int numbers) const
{
  const ArrayView* const array = cells_->find(name);
  if (array == nullptr)
  {
    throw Error("expected an array '" + name + "' of the lines, got none");
  }
  if (is_text(*array) || array->size() != numbers)
  {
    throw Error("expected " + std::string(numbers == 1 ? "one number" : "3 numbers") +
      " a row in the array '" + name + "' of the lines, got " +
      (is_text(*array) ? std::string("the type string") : std::to_string(array->size())));
  }
  return *array;
}

std::span<const double> LineRows::read_tuples(
  const std::string& name, int numbers, std::vector<double>& own) const
{
  const auto rows = static_cast<std::size_t>(this->count());
  const auto width = static_cast<std::size_t>(numbers);
  if (rows == 0)
  {
    return {};
  }
  const ArrayView& view = this->see(name, numbers);
  if (are_all_ && view.type == ValueType::Float64 && view.step == numbers &&
    (numbers == 1 || view.are_triples()))
  {
    return { static_cast<const double*>(view.components[0]), rows * width };
  }
  own.resize(rows * width);
  std::array<std::int64_t, 1024> cells; // at once, which stay in the cache
  std::array<double, 1024> values;
  for (std::size_t begin = 0; begin < rows; begin += cells.size())
  {
    const std::size_t some = std::min(cells.size(), rows - begin);
    for (std::size_t i = 0; i < some; ++i)
    {
      cells[i] = this->cell_of(static_cast<std::int64_t>(begin + i));
    }
    for (std::size_t k = 0; k < width; ++k)
    {
      load_numbers(component_of(view, static_cast<int>(k)), { cells.data(), some }, values.data());
      for (std::size_t i = 0; i < some; ++i)
      {
        own[(begin + i) * width + k] = values[i];
      }
    }
  }
  return own;
}

std::vector<std::int64_t> LineRows::read_ids(const std::string& name, Progress& progress) const
{
  std::vector<std::int64_t> ids;
  if (this->count() == 0)
  {
    return ids;
  }
  const Ids all(this->see(name), cells_->rows, Executor(), progress);
  if (are_all_)
  {
    ids.assign(all.values().begin(), all.values().end());
    return ids;
  }
  std::ranges::transform(own_, std::back_inserter(ids),
    [&](std::int64_t cell) { return all.values()[static_cast<std::size_t>(cell)]; });
  return ids;
}

std::string compare_timesteps(
  std::optional<std::int64_t> particles, std::optional<std::int64_t> rows)
{
  return !particles || !rows || *particles == *rows ? std::string()
                                                    : "the particles are of timestep " +
      std::to_string(*particles) + ", the lines of " + std::to_string(*rows);
}
}
