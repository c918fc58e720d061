// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionWriter.h"

#include "private/dump_input.h"
#include "private/voxels.h"
#include "private/vtu_file.h"
#include "private/writer.h"

#include "granular/base/byte_sink.h"
#include "granular/base/hash.h"
#include "granular/decomposition/decomposition_text.h"
#include "granular/dump/dump_format.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecompositionWriter);

namespace
{
enum class Form
{
  Text,
  Xml
};

/**
 * The form of a file by the end of its name.
 */
struct Ending
{
  std::string_view Text;
  Form Kind;
};

constexpr Ending Endings[] = {
  { ".vtk", Form::Text },
  { ".vtu", Form::Xml },
  { ".decomposition", Form::Text },
};

Form FormOf(std::string_view path)
{
  const auto* found = std::find_if(std::begin(Endings), std::end(Endings),
    [&](const Ending& ending) { return path.ends_with(ending.Text); });
  if (found == std::end(Endings))
  {
    throw granular::UnsupportedError(
      "expected a name that ends in .vtk, .vtu or .decomposition", { std::string(path) });
  }
  return found->Kind;
}

/**
 * What a process knows of a frame beside its cells.
 */
struct FrameFacts
{
  bool HasCells = false;
  bool HasTimestep = false;
  bool HasTime = false;
  vtkTypeInt64 Timestep = 0; ///< or the number of the frame
  double Time = 0;
  vtkMTimeType Changed = 0; ///< when the data were
};

/**
 * What all know: the word of the first who has cells, or of the first.
 */
struct SharedFacts : FrameFacts
{
  std::string Key; ///< tells frames apart: one of the same key is the same
};

SharedFacts ShareFacts(const FrameFacts& own, granular::Communicator& ranks)
{
  const std::vector<std::string> all =
    ranks.all_gather({ reinterpret_cast<const char*>(&own), sizeof own });
  SharedFacts shared;
  granular::do_together(ranks,
    [&]
    {
      std::string changed;
      for (const std::string& bytes : all)
      {
        FrameFacts facts;
        std::memcpy(&facts, bytes.data(), sizeof facts);
        if (changed.empty() || (facts.HasCells && !shared.HasCells))
        {
          static_cast<FrameFacts&>(shared) = facts;
        }
        changed += " " + std::to_string(facts.Changed);
      }
      shared.Key =
        shared.HasTimestep ? "timestep " + std::to_string(shared.Timestep) : "data" + changed;
    });
  return shared;
}
}

//------------------------------------------------------------------------------
/**
 * What this writer has written. Of the first process alone.
 */
struct vtkGranularDecompositionWriter::History
{
  struct Entry
  {
    std::string Keys; ///< of the frames in the file
    std::uint64_t Hash = 0;
  };

  std::map<std::string, Entry> Files;

  /**
   * Writes a file, or leaves it if it is there and has these frames.
   */
  void Write(const std::string& path, const std::string& text, const std::string& keys,
    granular::Notices& notices)
  {
    granular::Hash hash;
    hash.add(text.data(), text.size());
    const auto known = this->Files.find(path);
    std::error_code failed; // then it is written
    if (known != this->Files.end() && known->second.Keys == keys &&
      std::filesystem::exists(path, failed))
    {
      if (known->second.Hash != hash.value())
      {
        notices.push_back({ { path },
          "this writer has written " + keys +
            " already, with other subdomains: the file is left as it was" });
      }
      return;
    }
    granular::write_file(path, text);
    this->Files[path] = { keys, hash.value() };
  }
};

//------------------------------------------------------------------------------
/**
 * A decomposition that is being written.
 */
class vtkGranularDecompositionWriter::File : public FrameWriter
{
public:
  File(vtkGranularDecompositionWriter* self, Internals& internals)
    : Self(self)
    , Shared(internals)
    , Ranks(internals.GetRanks())
    , Path(self->FileName)
    , Kind(FormOf(Path))
    , OneFileAStep(granular::is_name_of_steps(Path))
  {
  }

  void Write(vtkDataObject* input, const FrameTime& time, granular::Notices& notices,
    granular::Progress& progress) override
  {
    granular::Decomposition own;
    FrameFacts facts;
    granular::Notices ownNotices;
    granular::do_together(this->Ranks,
      [&]
      {
        auto* grid = this->Check(input);
        facts = MakeFacts(grid, time);
        this->NameFile([&] { own = ReadVoxels(grid, ownNotices); });
      });
    this->GatherNotices(ownNotices, notices);
    const SharedFacts shared = ShareFacts(facts, this->Ranks);
    const granular::Decomposition all = granular::gather_decomposition(own, this->Ranks);
    granular::do_together(this->Ranks,
      [&]
      {
        if (this->OneFileAStep && !shared.HasTimestep)
        {
          notices.push_back({ {},
            "the input has neither field data 'timestep' nor a time of a whole number: time steps "
            "are counted "
            "from 0" });
        }
        granular::SubdomainChecks checks; // that a file can be read at all
        checks.overlap = granular::Answer::None;
        checks.gap = granular::Answer::None;
        granular::check_subdomains(
          all.subdomains, checks, { .path = this->Path }, notices, progress);
        if (this->Ranks.rank() == 0)
        {
          this->WriteFrame(all, shared, notices, progress);
        }
      });
  }

  void Finish() override
  {
    granular::do_together(this->Ranks,
      [&]
      {
        if (this->Ranks.rank() == 0 && !this->OneFileAStep)
        {
          this->Self->Past->Write(this->Path, this->Text, this->Keys, this->Shared.Notices);
        }
      });
  }

private:
  /**
   * Says in errors which file was to be written.
   */
  template <typename Work>
  void NameFile(const Work& work) const
  {
    try
    {
      work();
    }
    catch (const granular::UnsupportedError& error)
    {
      throw granular::UnsupportedError(error.text(), { this->Path });
    }
    catch (const granular::FormatError& error)
    {
      throw granular::FormatError(
        error.text(), { .path = this->Path, .column = error.where().column });
    }
  }

  vtkUnstructuredGrid* Check(vtkDataObject* input) const
  {
    auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
    if (!grid)
    {
      throw granular::UnsupportedError("expected a vtkUnstructuredGrid of voxels to write, got a " +
          std::string(input->GetClassName()) +
          (vtkCompositeDataSet::SafeDownCast(input) ? ": the filter MergeBlocks makes one of it"
                                                    : ""),
        { this->Path });
    }
    const auto box = FindBox(grid->GetFieldData());
    if (box && box->tilted)
    {
      throw granular::UnsupportedError(
        "expected a box along the axes, got a tilted one, whose subdomains are no voxels",
        { this->Path });
    }
    return grid;
  }

  static FrameFacts MakeFacts(vtkUnstructuredGrid* grid, const FrameTime& time)
  {
    granular::Notices ofArrays; // that nobody writes
    const DumpInput data(grid, ofArrays);
    const granular::FrameHeader& header = data.View.header;
    FrameFacts facts;
    facts.HasCells = grid->GetNumberOfCells() > 0;
    facts.HasTimestep = data.HasTimestep || time.Step.has_value();
    facts.Timestep = data.HasTimestep ? header.timestep : time.Step.value_or(time.Frame);
    facts.HasTime = data.HasTime || time.Time.has_value();
    facts.Time = data.HasTime ? *header.time : time.Time.value_or(0);
    facts.Changed = grid->GetMTime();
    return facts;
  }

  /**
   * One thing that was noticed by several is told once.
   */
  void GatherNotices(const granular::Notices& own, granular::Notices& all)
  {
    std::string text;
    granular::do_together(this->Ranks,
      [&]
      {
        for (const granular::Notice& notice : own)
        {
          text += (text.empty() ? "" : "\n") + granular::to_string(notice);
        }
      });
    const std::vector<std::string> texts = this->Ranks.all_gather(text);
    granular::do_together(this->Ranks,
      [&]
      {
        for (const std::string& each : texts)
        {
          if (!each.empty())
          {
            all.push_back({ {}, each });
          }
        }
      });
  }

  /**
   * Writes a frame into its file, or keeps it for the file of all.
   */
  void WriteFrame(const granular::Decomposition& decomposition, const SharedFacts& facts,
    granular::Notices& notices, granular::Progress& progress)
  {
    const std::string key = facts.Key + (this->Self->Dialect == PUBLIC ? " as PUBLIC" : "");
    if (this->OneFileAStep)
    {
      const std::string path = granular::name_of_step(this->Path, facts.Timestep);
      this->Self->Past->Write(
        path, this->Encode(decomposition, facts, notices, progress), key, notices);
      return;
    }
    if (this->LastKey == key)
    {
      return; // a timestep is written once
    }
    if (!this->Keys.empty() && this->Self->Dialect == INL)
    {
      throw granular::UnsupportedError(
        "expected a '*' in the name, which gives each time step its file: this file holds one",
        { this->Path });
    }
    this->Text += this->Encode(decomposition, facts, notices, progress);
    this->Keys += (this->Keys.empty() ? "" : ", ") + key;
    this->LastKey = key;
  }

  std::string Encode(const granular::Decomposition& decomposition, const SharedFacts& facts,
    granular::Notices& notices, granular::Progress& progress) const
  {
    if (this->Self->Dialect == PUBLIC)
    {
      std::string text;
      this->NameFile([&] { text = granular::encode_grid(decomposition, notices); });
      return text;
    }
    if (this->Kind == Form::Text)
    {
      return granular::encode_voxels(decomposition, progress);
    }
    return EncodeVtu(
      decomposition, facts.HasTime ? std::optional(facts.Time) : std::nullopt, this->Path);
  }

  vtkGranularDecompositionWriter* Self;
  Internals& Shared;
  granular::Communicator& Ranks;
  const std::string Path;
  const Form Kind;
  const bool OneFileAStep;
  std::string Text; ///< of the file of all frames, so far
  std::string Keys;
  std::string LastKey;
};

//------------------------------------------------------------------------------
vtkGranularDecompositionWriter::vtkGranularDecompositionWriter()
  : Past(std::make_unique<History>())
{
}

//------------------------------------------------------------------------------
vtkGranularDecompositionWriter::~vtkGranularDecompositionWriter() = default;

//------------------------------------------------------------------------------
void vtkGranularDecompositionWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dialect: " << this->Dialect << "\n";
  os << indent << "Binary: " << this->Binary << "\n";
}

//------------------------------------------------------------------------------
void vtkGranularDecompositionWriter::SetDialect(int dialect)
{
  if (dialect != INL && dialect != PUBLIC)
  {
    vtkErrorMacro("expected Dialect 0 (INL) or 1 (PUBLIC), got " << dialect);
    return;
  }
  if (this->Dialect != dialect)
  {
    this->Dialect = dialect;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGranularDecompositionWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject"); // see File::Check
  return 1;
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularDecompositionWriter::OpenFile(Internals& internals)
{
  const std::string path = this->FileName;
  if (this->Binary)
  {
    throw granular::UnsupportedError("expected Binary off: decompositions are text", { path });
  }
  if (granular::is_name_of_ranks(path))
  {
    throw granular::UnsupportedError(
      "expected a name without '%': one file holds the subdomains of all processes", { path });
  }
  if (FormOf(path) == Form::Xml && this->Dialect == PUBLIC)
  {
    throw granular::UnsupportedError(
      "expected a name that ends in .vtk or .decomposition: the dialect PUBLIC has no .vtu",
      { path });
  }
  return std::make_unique<File>(this, internals);
}
