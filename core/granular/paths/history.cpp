// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/history.h"

#include "granular/common/pass.h"
#include "granular/common/words.h"
#include "granular/parallel/executor.h"
#include "granular/parallel/trade.h"
#include "granular/paths/paths.h"
#include "granular/paths/statistics.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
/// A column of the table: the numbers of each frame, as many as the largest
/// has; those that lack are nan.
struct Column
{
  std::string name;
  std::vector<std::vector<double>> frames;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<Column>& column)
{
  archive.text(column.name);
  granular::pass(archive, column.frames);
}

constexpr std::int64_t most_particles = 1000;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The quantiles in a list, and the words that give them.
std::vector<std::pair<std::string, double>> quantiles_in(std::string list)
{
  std::ranges::replace(list, ',', ' ');
  std::vector<std::pair<std::string, double>> quantiles;
  for (const std::string_view word : split_words(list))
  {
    double value = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !(value >= 0 && value <= 1))
    {
      throw Error("expected Quantiles of numbers from 0 to 1, got '" + std::string(word) + "'");
    }
    quantiles.emplace_back(word, value);
  }
  return quantiles;
}

double number_of(const PathArray& array, std::size_t word)
{
  return array.integers ? static_cast<double>(array.words[word])
                        : std::bit_cast<double>(array.words[word]);
}

/// The component of an array of a frame, as doubles.
std::vector<double> numbers_of(const PathArray& array, int component)
{
  std::vector<double> numbers;
  for (std::size_t i = static_cast<std::size_t>(component); i < array.words.size();
       i += static_cast<std::size_t>(array.size))
  {
    numbers.push_back(number_of(array, i));
  }
  return numbers;
}

class History
{
public:
  History(PathTask& task, const HistoryRequest& request)
    : task_(task)
    , request_(request)
    , part_(static_cast<Progress&>(task.progress)) // not a copy
  {
  }

  Table make()
  {
    const bool msd = request_.square_displacement;
    std::vector<Column> columns;
    if (!request_.statistics)
    {
      task_.progress.set_part(0, msd ? 0.5 : 1);
      const PathRequest all = task_.request;
      task_.choose_few(10);
      columns = this->follow_particles();
      task_.request = all;
    }
    if (msd || request_.statistics)
    {
      task_.progress.set_part(request_.statistics ? 0 : 0.5, 1);
      this->go_through(columns, msd, request_.statistics);
    }
    return this->fill(columns);
  }

private:
  /// The columns of all particles: of this rank's, then those of the next ranks, which have larger ids.
  std::vector<Column> follow_particles()
  {
    const Paths paths = task_.join(task_.load(), false);
    task_.note_absent(paths.ids);
    headers_ = paths.headers;
    std::int64_t count = static_cast<std::int64_t>(paths.ids.size());
    task_.group.sum({ &count, 1 });
    if (count > most_particles)
    {
      throw LimitError("expected at most " + std::to_string(most_particles) +
        " particles for columns of their own, got " + std::to_string(count) +
        ": select fewer by Ids, EveryNth or NumberOfSamples, or take the Output Statistics");
    }
    std::vector<Column> columns;
    for (std::size_t path = 0; path < paths.ids.size(); ++path)
    {
      const std::string of = " (id " + std::to_string(paths.ids[path]) + ")";
      columns.push_back(make_column(
        paths, path, "position" + of, 3, [&](std::size_t word) { return paths.points[word]; }));
      for (const PathArray& array : paths.arrays)
      {
        columns.push_back(make_column(paths, path, array.name + of, array.size,
          [&](std::size_t word) { return number_of(array, word); }));
      }
    }
    std::vector<Column> all;
    for (std::vector<Column>& some : gather(task_.group, columns))
    {
      std::ranges::move(some, std::back_inserter(all));
    }
    return all;
  }

  /// A column of a path; at() gives the numbers of its places one after the other.
  template <typename At>
  static Column make_column(
    const Paths& paths, std::size_t path, const std::string& name, int size, const At& at)
  {
    const auto width = static_cast<std::size_t>(size);
    Column column{ name, std::vector<std::vector<double>>(paths.headers.size()) };
    for (std::int64_t place = paths.begins[path]; place < paths.begins[path + 1]; ++place)
    {
      const auto from = static_cast<std::size_t>(place);
      std::vector<double>& values = column.frames[static_cast<std::size_t>(paths.frames[from])];
      for (std::size_t i = 0; i < width; ++i)
      {
        values.push_back(at(from * width + i));
      }
    }
    return column;
  }

  /// One frame after the other, of which no more than one is in memory.
  void go_through(std::vector<Column>& columns, bool msd, bool statistics)
  {
    PathRequest request = task_.request;
    request.points = msd;
    if (!statistics)
    {
      request.arrays.clear();
    }
    const Executor executor(request_.threads);
    SquareDisplacements squares(task_.group, executor, task_.origin);
    headers_.clear();
    lacking_ = request.arrays;
    const std::size_t before = columns.size();
    std::vector<PathFrame> frames(1); // one, as share_kinds wants it
    PathFrame& frame = frames.front();
    for (std::size_t i = 0; i < task_.numbers.size(); ++i)
    {
      part_.set_part(static_cast<double>(i) / static_cast<double>(task_.numbers.size()),
        static_cast<double>(i + 1) / static_cast<double>(task_.numbers.size()));
      frame =
        task_.frames.load_part(task_.numbers[i], request, task_.notices, part_, std::move(frame));
      std::size_t at = before;
      const auto add = [&](const std::string& name, const std::vector<double>& values)
      {
        if (i == 0)
        {
          columns.push_back({ name, {} });
        }
        columns[at++].frames.push_back(values);
      };
      headers_.push_back(frame.header);
      const auto name_rows = [&](std::int64_t id) { task_.frames.name_rows(id, task_.numbers[i]); };
      if (!msd) // otherwise they are looked up anyway
      {
        expect_distinct_ids(frame, name_rows, task_.group);
      }
      if (statistics)
      {
        this->add_statistics(frames, add);
      }
      if (msd)
      {
        frame.arrays.clear();
        const auto means = squares.add(frame, name_rows, part_);
        add("msd", { means.total });
        add("msd_xyz", { means.axes[0], means.axes[1], means.axes[2] });
        add("msd_particles", { static_cast<double>(means.count) });
      }
    }
    if (had_particles_)
    {
      expect_none(lacking_);
    }
    if (const std::size_t empty = squares.empty_frames(); empty > 0 && empty < headers_.size())
    {
      task_.notices.push_back({ {},
        "frames before timestep " + std::to_string(headers_[empty].timestep) +
          " have no particles: msd begins there" });
    }
    const std::int64_t long_steps = squares.count_long_steps();
    if (long_steps > 0)
    {
      task_.notices.push_back(note_long_steps(long_steps));
    }
  }

  template <typename Add>
  void add_statistics(std::vector<PathFrame>& frames, const Add& add)
  {
    const std::vector<std::string> lacking = share_kinds(frames, task_.group);
    const PathFrame& frame = frames.front();
    std::int64_t count = static_cast<std::int64_t>(frame.ids.size());
    task_.group.sum({ &count, 1 });
    add("particles", { static_cast<double>(count) });
    this->note_lacking(lacking, count);
    std::vector<std::string> suffixes = { "_mean", "_min", "_max" };
    std::vector<double> parts;
    for (const auto& [word, value] : quantiles_in(request_.quantiles))
    {
      suffixes.push_back("_" + word);
      parts.push_back(value);
    }
    for (const PathArray& array : frame.arrays)
    {
      std::vector<std::vector<double>> values(suffixes.size());
      for (int component = 0; component < array.size; ++component)
      {
        const Statistics found = find_statistics(numbers_of(array, component), parts, task_.group);
        std::vector<double> numbers = { found.mean, found.least, found.greatest };
        numbers.insert(numbers.end(), found.quantiles.begin(), found.quantiles.end());
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          values[i].push_back(numbers[i]);
        }
      }
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        add(array.name + suffixes[i], values[i]);
      }
    }
  }

  /// Leaves the arrays that no frame with particles has, so far.
  void note_lacking(const std::vector<std::string>& lacking, std::int64_t particles)
  {
    if (particles > 0)
    {
      had_particles_ = true;
      std::erase_if(lacking_,
        [&](const std::string& name) { return std::ranges::find(lacking, name) == lacking.end(); });
    }
  }

  Table fill(const std::vector<Column>& columns) const
  {
    Table table;
    table.rows = std::ssize(headers_);
    table.header.has_box = false;
    std::vector<std::int64_t> timesteps;
    std::ranges::transform(headers_, std::back_inserter(timesteps), &FrameHeader::timestep);
    add_array(table, "time", ValueType::Float64, 1, block_of(task_.times()));
    add_array(table, "timestep", ValueType::Int64, 1, block_of(timesteps));
    for (const Column& column : columns)
    {
      std::size_t size = 1; // a frame without particles may know of none
      for (const std::vector<double>& numbers : column.frames)
      {
        size = std::max(size, numbers.size());
      }
      std::vector<double> all;
      for (std::vector<double> numbers : column.frames)
      {
        numbers.resize(size, none);
        all.insert(all.end(), numbers.begin(), numbers.end());
      }
      add_array(table, column.name, ValueType::Float64, static_cast<int>(size), block_of(all));
    }
    return table;
  }

  PathTask& task_;
  const HistoryRequest& request_;
  PartialProgress part_;             ///< of a frame
  std::vector<FrameHeader> headers_; ///< of the frames
  bool had_particles_ = false;
  std::vector<std::string> lacking_; ///< arrays that no frame with particles has, so far
};
} // namespace

Table make_history(PathTask& task, const HistoryRequest& request)
{
  return History(task, request).make();
}
} // namespace granular
