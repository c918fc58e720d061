// SPDX-License-Identifier: BSD-3-Clause
#include "private/writing/whole_file.h"

#include "private/dump/dump_input.h"

#include "granular/bytes/byte_sink.h"
#include "granular/common/hash.h"
#include "granular/dump/write/dump_format.h"
#include "granular/parallel/gather.h"

#include "vtkDataObject.h"
#include "vtkPointSet.h"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
SharedFacts ShareFacts(const FrameFacts& own, granular::Communicator& ranks)
{
  SharedFacts shared;
  std::string changed;
  for (const FrameFacts& facts : granular::gather(ranks, own))
  {
    if (changed.empty() || (facts.HasCells && !shared.HasCells))
    {
      static_cast<FrameFacts&>(shared) = facts;
    }
    changed += " " + std::to_string(facts.Changed);
  }
  shared.Key =
    shared.HasTimestep ? "timestep " + std::to_string(shared.Timestep) : "data" + changed;
  return shared;
}

/**
 * Each process' notices become one.
 */
void GatherNotices(
  const granular::Notices& own, granular::Notices& all, granular::Communicator& ranks)
{
  std::string text;
  for (const granular::Notice& notice : own)
  {
    text += (text.empty() ? "" : "\n") + granular::to_string(notice);
  }
  for (const std::string& each : ranks.all_gather(text))
  {
    if (!each.empty())
    {
      all.push_back({ {}, each });
    }
  }
}
}

FrameFacts MakeFacts(
  vtkDataObject* input, vtkPointSet* points, bool hasCells, const FrameTime& time)
{
  granular::Notices ofArrays; // that nobody writes
  const DumpInput data(points, ofArrays);
  const granular::FrameHeader& header = data.View.header;
  FrameFacts facts;
  facts.HasCells = hasCells;
  facts.HasTimestep = data.HasTimestep || time.Step.has_value();
  facts.Timestep = data.HasTimestep ? header.timestep : time.Step.value_or(time.Frame);
  facts.HasTime = data.HasTime || time.Time.has_value();
  facts.Time = data.HasTime ? *header.time : time.Time.value_or(0);
  facts.Changed = input->GetMTime();
  return facts;
}

void WrittenFiles::Write(const std::string& path, const std::string& text, const std::string& keys,
  const std::string& things, bool durable, granular::HeldFiles& held, granular::Notices& notices)
{
  granular::Hash hash;
  hash.add(text.data(), text.size());
  const auto known = this->Files.find(path);
  std::error_code failed; // then it is written
  if (known != this->Files.end() && known->second.Keys == keys &&
    std::filesystem::exists(path, failed))
  {
    const bool same = known->second.Hash == hash.value();
    if (!same)
    {
      notices.push_back({ { path },
        "this writer has written " + keys + " already, with other " + things +
          ": the file is left as it was" });
    }
    if (!same || !durable || known->second.Durable)
    {
      return;
    }
  }
  Entry now = { keys, hash.value(), durable };
  Entry& then = this->Files[path]; // nothing may fail once the file is there
  then = {};                       // an error may come when the new file has its name already
  auto file = std::make_unique<granular::NewFile>(path);
  file->write_at(0, text);
  if (held.finish(std::move(file), durable))
  {
    then = std::move(now);
  }
}

WholeFile::WholeFile(WholeFileForm form, granular::Communicator& ranks,
  const granular::InputFiles& inputs, WrittenFiles& past, granular::Notices& ofFile)
  : Form(std::move(form))
  , Ranks(ranks)
  , Inputs(inputs)
  , Held(&inputs)
  , Past(past)
  , OfFile(ofFile)
  , OneFileAStep(granular::is_name_of_steps(this->Form.Path))
{
}

void WholeFile::Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
  granular::Progress& progress)
{
  granular::Notices ownNotices;
  const FrameFacts own = this->Take(input, time, ownNotices);
  GatherNotices(ownNotices, notices, this->Ranks);
  const SharedFacts facts = ShareFacts(own, this->Ranks);
  if (this->OneFileAStep && !facts.HasTimestep)
  {
    notices.push_back({ {},
      "the input has neither field data 'timestep' nor a time of a whole number: time steps "
      "are counted from 0" });
  }
  this->Gather(notices, progress);
  granular::do_together(this->Ranks,
    [&]
    {
      if (this->Ranks.rank() == 0)
      {
        this->WriteFrame(facts, notices, progress);
      }
    });
}

// Into its file, or it is kept for the file of all.
void WholeFile::WriteFrame(
  const SharedFacts& facts, granular::Notices& notices, granular::Progress& progress)
{
  const std::string key =
    facts.Key + (this->Form.Dialect.empty() ? "" : " as " + this->Form.Dialect);
  const std::string path = granular::name_of_step(this->Form.Path, facts.Timestep);
  this->Inputs.has(path); // throws for a file that may not be replaced
  if (this->OneFileAStep)
  {
    this->Past.Write(path, this->Encode(facts, notices, progress), key, this->Form.Things,
      this->IsDurable(), this->Held, notices);
    return;
  }
  if (this->LastKey == key)
  {
    return; // a timestep is written once
  }
  if (!this->Keys.empty() && !this->Form.TakesAll)
  {
    throw granular::UnsupportedError(
      "expected a '*' in the name, which gives each time step its file: this file holds one",
      { this->Form.Path });
  }
  this->Text += this->Encode(facts, notices, progress);
  this->Keys += (this->Keys.empty() ? "" : ", ") + key;
  this->LastKey = key;
}

bool WholeFile::IsDurable() const
{
  return granular::is_durable(this->Form.Durable, this->Form.Path);
}

void WholeFile::Finish()
{
  granular::do_together(this->Ranks,
    [&]
    {
      if (this->Ranks.rank() == 0 && !this->OneFileAStep)
      {
        this->Past.Write(this->Form.Path, this->Text, this->Keys, this->Form.Things,
          this->IsDurable(), this->Held, this->OfFile);
      }
      this->Held.finish_all(this->IsDurable());
    });
}
}
