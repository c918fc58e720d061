// SPDX-License-Identifier: BSD-3-Clause
#include "private/writing/writer.h"

#include "granular/common/pass.h"
#include "granular/parallel/trade.h"
#include "granular/writing/file_names.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The facts that a rank knows about a frame besides its rows.
 */
struct FrameFacts
{
  bool HasRows = false;
  vtkTypeInt64 Timestep = 0;
  std::optional<double> Time;
  granular::Notices Notices;
};

template <typename Archive>
void pass(Archive& archive, typename Archive::template Passed<FrameFacts>& facts)
{
  archive.number(facts.HasRows);
  archive.number(facts.Timestep);
  archive.number(facts.Time);
  pass(archive, facts.Notices);
}
}

FrameWriter::FrameWriter(std::string path, granular::Communicator& ranks)
  : Path(std::move(path))
  , Ranks(ranks)
{
}

void FrameWriter::Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
  granular::Progress& progress)
{
  FrameFacts own;
  const std::unique_ptr<RowsInput> data = this->Take(input, own.Notices);
  granular::FrameHeader& header = data->View.header;
  if (!data->HasTimestep && this->TellsStep(time))
  {
    own.Notices.push_back({ {},
      std::string("the input has no field data 'timestep': ") +
        (time.Step ? "its time is taken for it" : "frames are counted from 0") });
  }
  own.HasRows = data->View.rows > 0;
  own.Timestep = data->HasTimestep ? header.timestep : time.Step.value_or(time.Frame);
  own.Time = data->HasTime ? header.time : time.Time;
  // a rank without rows may have no field data either
  const std::vector<FrameFacts> all = granular::gather(this->Ranks, own);
  const auto found = std::ranges::find(all, true, &FrameFacts::HasRows);
  const FrameFacts& known = found == all.end() ? all.front() : *found;
  for (const FrameFacts& rank : all)
  {
    if (rank.HasRows == known.HasRows)
    {
      notices.insert(notices.end(), rank.Notices.begin(), rank.Notices.end());
    }
  }
  header.timestep = known.Timestep;
  header.time = known.Time;
  this->WriteRows(data->View, notices, progress);
}

RowsFile::RowsFile(const std::string& path, granular::DumpFormat format,
  const granular::WriteOptions& options, granular::Communicator& ranks, TakePart take)
  : FrameWriter(path, ranks)
  , Writer(path, std::move(format), options, ranks)
  , Taking(std::move(take))
{
}

void RowsFile::WriteRows(
  const granular::FrameView& own, granular::Notices& notices, granular::Progress& progress)
{
  this->Writer.write(own, notices, progress);
}

WholeFile::WholeFile(const std::string& path, bool holdsMany, const granular::WriteOptions& options,
  granular::Communicator& ranks)
  : FrameWriter(path, ranks)
  , Writer(path, holdsMany, options, ranks)
{
}

void WholeFile::WriteRows(
  const granular::FrameView& own, granular::Notices& notices, granular::Progress& progress)
{
  this->Gather(notices, progress);
  this->Writer.write(
    own.header.timestep,
    [&](granular::Notices& told) { return this->Encode(own.header.time, told, progress); },
    notices);
}

bool WholeFile::TellsStep(const FrameTime& time) const
{
  return granular::is_name_of_steps(this->Path) && !time.Step;
}

std::optional<granular::Dialect> DialectOf(int property)
{
  return property == 0 ? std::optional(granular::Dialect::Liggghts)
    : property == 1    ? std::optional(granular::Dialect::Lammps)
                       : std::nullopt;
}
}
