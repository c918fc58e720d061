// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularHistory.h"

#include "private/arrays/arrays.h"
#include "private/paths/path_task.h"
#include "private/request/print.h"

#include "granular/common/words.h"
#include "granular/parallel/executor.h"
#include "granular/parallel/trade.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/paths.h"
#include "granular/paths/statistics.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vtkGranularPrivate
{
/**
 * A column of the table: the numbers of each frame, as many as the largest has; those that lack are nan.
 */
struct Column
{
  std::string Name;
  std::vector<std::vector<double>> Frames;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<Column>& column)
{
  archive.text(column.Name);
  granular::pass(archive, column.Frames);
}
}

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularHistory);

namespace
{
constexpr std::int64_t MostParticles = 1000;
constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/**
 * The quantiles in a list, and the words that give them.
 */
std::vector<std::pair<std::string, double>> QuantilesIn(std::string list)
{
  std::ranges::replace(list, ',', ' ');
  std::vector<std::pair<std::string, double>> quantiles;
  for (const std::string_view word : granular::split_words(list))
  {
    double value = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !(value >= 0 && value <= 1))
    {
      throw granular::Error(
        "expected Quantiles of numbers from 0 to 1, got '" + std::string(word) + "'");
    }
    quantiles.emplace_back(word, value);
  }
  return quantiles;
}

double NumberOf(const granular::PathArray& array, std::size_t word)
{
  return array.integers ? static_cast<double>(array.words[word])
                        : std::bit_cast<double>(array.words[word]);
}

/**
 * The component of an array of a frame, as doubles.
 */
std::vector<double> NumbersOf(const granular::PathArray& array, int component)
{
  std::vector<double> numbers;
  for (std::size_t i = static_cast<std::size_t>(component); i < array.words.size();
       i += static_cast<std::size_t>(array.size))
  {
    numbers.push_back(NumberOf(array, i));
  }
  return numbers;
}
}

//------------------------------------------------------------------------------
class vtkGranularHistory::Task : public FilterTask<vtkGranularHistory, PathTask>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    this->Choose();
    const bool msd = this->Self->MeanSquareDisplacement;
    const bool statistics = this->Self->OutputType == STATISTICS;
    std::vector<Column> columns;
    if (!statistics)
    {
      this->Progress.set_part(0, msd ? 0.5 : 1);
      const granular::PathRequest all = this->Request;
      this->ChooseFew(10);
      columns = this->FollowParticles();
      this->Request = all;
    }
    if (msd || statistics)
    {
      this->Progress.set_part(statistics ? 0 : 0.5, 1);
      this->GoThrough(columns, msd, statistics);
    }
    this->Fill(columns);
  }

  /**
   * The columns of all particles: of this rank's, then those of the next ranks, which have larger ids.
   */
  std::vector<Column> FollowParticles()
  {
    const granular::Paths paths = this->Join(
      this->Frames.Load(this->Numbers, this->Request, this->Notices, this->Progress), false);
    this->NoteAbsent(paths.ids);
    this->Headers = paths.headers;
    std::int64_t count = static_cast<std::int64_t>(paths.ids.size());
    this->Group.sum({ &count, 1 });
    if (count > MostParticles)
    {
      throw granular::LimitError("expected at most " + std::to_string(MostParticles) +
        " particles for columns of their own, got " + std::to_string(count) +
        ": select fewer by Ids, EveryNth or NumberOfSamples, or take the Output Statistics");
    }
    std::vector<Column> columns;
    for (std::size_t path = 0; path < paths.ids.size(); ++path)
    {
      const std::string of = " (id " + std::to_string(paths.ids[path]) + ")";
      columns.push_back(MakeColumn(
        paths, path, "position" + of, 3, [&](std::size_t word) { return paths.points[word]; }));
      for (const granular::PathArray& array : paths.arrays)
      {
        columns.push_back(MakeColumn(paths, path, array.name + of, array.size,
          [&](std::size_t word) { return NumberOf(array, word); }));
      }
    }
    std::vector<Column> all;
    for (std::vector<Column>& some : granular::gather(this->Group, columns))
    {
      std::ranges::move(some, std::back_inserter(all));
    }
    return all;
  }

  /**
   * A column of a path; at() gives the numbers of its places one after the other.
   */
  template <typename At>
  static Column MakeColumn(
    const granular::Paths& paths, std::size_t path, const std::string& name, int size, const At& at)
  {
    const auto width = static_cast<std::size_t>(size);
    Column column{ name, std::vector<std::vector<double>>(paths.headers.size()) };
    for (std::int64_t place = paths.begins[path]; place < paths.begins[path + 1]; ++place)
    {
      const auto from = static_cast<std::size_t>(place);
      std::vector<double>& values = column.Frames[static_cast<std::size_t>(paths.frames[from])];
      for (std::size_t i = 0; i < width; ++i)
      {
        values.push_back(at(from * width + i));
      }
    }
    return column;
  }

  /**
   * One frame after the other, of which no more than one is in memory.
   */
  void GoThrough(std::vector<Column>& columns, bool msd, bool statistics)
  {
    granular::PathRequest request = this->Request;
    request.points = msd;
    if (!statistics)
    {
      request.arrays.clear();
    }
    const granular::Executor executor(this->Threads);
    granular::SquareDisplacements squares(this->Group, executor, this->Origin);
    this->Headers.clear();
    this->Lacking = request.arrays;
    const std::size_t before = columns.size();
    std::vector<granular::PathFrame> frames(1); // one, as share_kinds wants it
    granular::PathFrame& frame = frames.front();
    for (std::size_t i = 0; i < this->Numbers.size(); ++i)
    {
      this->Part.set_part(static_cast<double>(i) / static_cast<double>(this->Numbers.size()),
        static_cast<double>(i + 1) / static_cast<double>(this->Numbers.size()));
      frame = this->Frames.LoadPart(
        this->Numbers[i], request, this->Notices, this->Part, std::move(frame));
      std::size_t at = before;
      const auto add = [&](const std::string& name, const std::vector<double>& values)
      {
        if (i == 0)
        {
          columns.push_back({ name, {} });
        }
        columns[at++].Frames.push_back(values);
      };
      this->Headers.push_back(frame.header);
      const auto nameRows = [&](std::int64_t id) { this->Frames.NameRows(id, this->Numbers[i]); };
      if (!msd) // otherwise they are looked up anyway
      {
        granular::expect_distinct_ids(frame, nameRows, this->Group);
      }
      if (statistics)
      {
        this->AddStatistics(frames, add);
      }
      if (msd)
      {
        frame.arrays.clear();
        const auto means = squares.add(frame, nameRows, this->Part);
        add("msd", { means.total });
        add("msd_xyz", { means.axes[0], means.axes[1], means.axes[2] });
        add("msd_particles", { static_cast<double>(means.count) });
      }
    }
    if (this->HadParticles)
    {
      granular::expect_none(this->Lacking);
    }
    if (const std::size_t empty = squares.empty_frames(); empty > 0 && empty < this->Headers.size())
    {
      this->Notices.push_back({ {},
        "frames before timestep " + std::to_string(this->Headers[empty].timestep) +
          " have no particles: msd begins there" });
    }
    const std::int64_t longSteps = squares.count_long_steps();
    if (longSteps > 0)
    {
      this->Notices.push_back(granular::note_long_steps(longSteps));
    }
  }

  template <typename Add>
  void AddStatistics(std::vector<granular::PathFrame>& frames, const Add& add)
  {
    const std::vector<std::string> lacking = granular::share_kinds(frames, this->Group);
    const granular::PathFrame& frame = frames.front();
    std::int64_t count = static_cast<std::int64_t>(frame.ids.size());
    this->Group.sum({ &count, 1 });
    add("particles", { static_cast<double>(count) });
    this->NoteLacking(lacking, count);
    std::vector<std::string> suffixes = { "_mean", "_min", "_max" };
    std::vector<double> parts;
    for (const auto& [word, value] : QuantilesIn(this->Self->Quantiles))
    {
      suffixes.push_back("_" + word);
      parts.push_back(value);
    }
    for (const granular::PathArray& array : frame.arrays)
    {
      std::vector<std::vector<double>> values(suffixes.size());
      for (int component = 0; component < array.size; ++component)
      {
        const granular::Statistics found =
          granular::find_statistics(NumbersOf(array, component), parts, this->Group);
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

  /**
   * Leaves the arrays that no frame with particles has, so far.
   */
  void NoteLacking(const std::vector<std::string>& lacking, std::int64_t particles)
  {
    if (particles > 0)
    {
      this->HadParticles = true;
      std::erase_if(this->Lacking,
        [&](const std::string& name) { return std::ranges::find(lacking, name) == lacking.end(); });
    }
  }

  void Fill(const std::vector<Column>& columns)
  {
    // one table: that of the first rank or piece
    if (this->Wanted.Piece != 0)
    {
      return;
    }
    auto* output = this->GetOutput<vtkTable>();
    output->AddColumn(ArrayOf<vtkDoubleArray>("time", this->GetTimes()));
    output->AddColumn(
      ArrayOf<vtkTypeInt64Array>("timestep", this->Headers, &granular::FrameHeader::timestep));
    for (const Column& column : columns)
    {
      std::size_t size = 1; // a frame without particles may know of none
      for (const std::vector<double>& numbers : column.Frames)
      {
        size = std::max(size, numbers.size());
      }
      vtkNew<vtkDoubleArray> array;
      array->SetName(column.Name.c_str());
      array->SetNumberOfComponents(static_cast<int>(size));
      for (std::vector<double> numbers : column.Frames)
      {
        numbers.resize(size, Nothing);
        array->InsertNextTuple(numbers.data());
      }
      output->AddColumn(array);
    }
  }

  granular::Progress& Whole = this->Progress;    ///< a PartialProgress would be copied
  granular::PartialProgress Part{ this->Whole }; ///< of a frame
  std::vector<granular::FrameHeader> Headers;    ///< of the frames
  bool HadParticles = false;
  std::vector<std::string> Lacking; ///< arrays that no frame with particles has, so far
};

vtkGranularExecuteMacro(vtkGranularHistory);
vtkGranularOutputMacro(vtkGranularHistory, GetOutput, vtkTable, 0);

//------------------------------------------------------------------------------
vtkGranularHistory::vtkGranularHistory()
{
  this->SetPorts({ Input::Required }, { "vtkTable" });
}

vtkGranularPrintMacro(vtkGranularHistory, OutputType, Quantiles, MeanSquareDisplacement);
