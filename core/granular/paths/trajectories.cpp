// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/trajectories.h"

#include "granular/parallel/pieces.h"
#include "granular/paths/paths.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace granular
{
namespace
{
/// Fills what is drawn of some lines.
class Filler
{
public:
  Filler(const Paths& paths, const PathLines& lines, Trajectories& made, int piece, int pieces)
    : paths_(paths)
    , lines_(lines)
    , made_(made)
    , last_line_(lines.paths.size())
  {
    const auto [first, last] = range_of_piece(std::ssize(paths.ids), piece, pieces);
    const auto begin_of = [&](std::int64_t path)
    {
      return static_cast<std::size_t>(
        std::ranges::lower_bound(lines.paths, path) - lines.paths.begin());
    };
    first_line_ = begin_of(first);
    last_line_ = begin_of(last);
    first_ = lines.begins[first_line_];
    last_ = lines.begins[last_line_];
    made.points.rows = last_ - first_;
  }

  /// The cells: vertices come first, as VTK counts them.
  void fill_cells()
  {
    std::vector<std::int64_t> ids;
    std::vector<double> lengths;
    for (const bool single : { true, false })
    {
      for (std::size_t line = first_line_; line < last_line_; ++line)
      {
        const std::int64_t first = lines_.begins[line];
        const std::int64_t end = lines_.begins[line + 1];
        if ((end - first == 1) == single)
        {
          made_.vertices += single ? 1 : 0;
          made_.firsts.push_back(first - first_);
          made_.ends.push_back(end - first_);
          ids.push_back(paths_.ids[static_cast<std::size_t>(lines_.paths[line])]);
          lengths.push_back(lines_.lengths[line]);
        }
      }
    }
    made_.cells.rows = std::ssize(ids);
    add_array(made_.cells, "id", ValueType::Int64, 1, block_of(ids));
    add_array(made_.cells, "length", ValueType::Float64, 1, block_of(lengths));
  }

  void fill_points(const std::vector<double>& times)
  {
    made_.points.points = block_of(
      std::vector<double>(lines_.points.begin() + 3 * first_, lines_.points.begin() + 3 * last_));
    const std::vector<double> speeds = find_speeds(paths_, times);
    const auto frame_of = [&](std::int64_t place)
    { return static_cast<std::size_t>(paths_.frames[static_cast<std::size_t>(place)]); };
    this->add_numbers("time", 1, [&](std::int64_t place, int) { return times[frame_of(place)]; });
    this->add_integers("timestep", 1,
      [&](std::int64_t place, int) { return paths_.headers[frame_of(place)].timestep; });
    this->add_numbers(
      "speed", 1, [&](std::int64_t place, int) { return speeds[static_cast<std::size_t>(place)]; });
    const std::vector<std::int64_t> firsts = this->find_firsts();
    this->add_numbers("displacement", 3,
      [&](std::int64_t place, int axis)
      {
        const double* const all = paths_.points.data() + axis;
        return all[3 * place] - all[3 * firsts[static_cast<std::size_t>(place)]];
      });
    for (const PathArray& array : paths_.arrays)
    {
      const auto word = [&](std::int64_t place, int i)
      { return array.words[static_cast<std::size_t>(place * array.size + i)]; };
      if (array.integers)
      {
        this->add_integers(array.name, array.size, word);
      }
      else
      {
        this->add_numbers(array.name, array.size,
          [&](std::int64_t place, int i) { return std::bit_cast<double>(word(place, i)); });
      }
    }
  }

private:
  /// Returns for each place the first one of its path.
  std::vector<std::int64_t> find_firsts() const
  {
    std::vector<std::int64_t> firsts(paths_.frames.size());
    for (std::size_t path = 0; path < paths_.ids.size(); ++path)
    {
      std::fill(firsts.begin() + paths_.begins[path], firsts.begin() + paths_.begins[path + 1],
        paths_.begins[path]);
    }
    return firsts;
  }

  /// Adds an array of numbers, which at() gives for places; between two places they are interpolated.
  template <typename At>
  void add_numbers(const std::string& name, int size, const At& at)
  {
    this->add<double>(name, ValueType::Float64, size,
      [&](std::int64_t place, double part, int i)
      { return part == 0 ? at(place, i) : (1 - part) * at(place, i) + part * at(place + 1, i); });
  }

  template <typename At>
  void add_integers(const std::string& name, int size, const At& at)
  {
    this->add<std::int64_t>(name, ValueType::Int64, size,
      [&](std::int64_t place, double, int i) { return at(place, i); });
  }

  template <typename Value, typename At>
  void add(const std::string& name, ValueType type, int size, const At& at)
  {
    Block block(static_cast<std::size_t>((last_ - first_) * size) * sizeof(Value));
    auto* to = static_cast<Value*>(block.data());
    for (std::int64_t point = first_; point < last_; ++point)
    {
      const auto from = static_cast<std::size_t>(point);
      for (int i = 0; i < size; ++i)
      {
        *to++ = at(lines_.places[from], lines_.parts[from], i);
      }
    }
    add_array(made_.points, name, type, size, std::move(block));
  }

  const Paths& paths_;
  const PathLines& lines_;
  Trajectories& made_;
  std::size_t first_line_ = 0;
  std::size_t last_line_ = 0;
  std::int64_t first_ = 0; ///< point
  std::int64_t last_ = 0;
};
}

Trajectories draw_trajectories(
  PathTask& task, std::vector<PathFrame> frames, bool split, bool whole, int piece, int pieces)
{
  const Paths paths = task.join(std::move(frames), split);
  if (whole)
  {
    task.note_absent(paths.ids);
  }
  Trajectories made;
  const PathLines lines = draw_paths(paths, task.origin);
  Filler filler(paths, lines, made, piece, pieces);
  filler.fill_cells();
  filler.fill_points(task.times());
  made.points.header = paths.headers.back();
  made.points.coordinates = split ? Coordinates::Absolute : Coordinates::Unwrapped;
  return made;
}
}
