// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionWriter.h"

#include "private/decomposition/voxels.h"
#include "private/decomposition/vtu_file.h"
#include "private/dump/dump_input.h"
#include "private/request/expect_data.h"
#include "private/request/name_file.h"
#include "private/writing/whole_file.h"
#include "private/writing/writer.h"

#include "granular/decomposition/decomposition_text.h"
#include "granular/dump/write/dump_format.h"

#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecompositionWriter);

namespace
{
enum class FileKind
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
  FileKind Kind;
};

constexpr Ending Endings[] = {
  { ".vtk", FileKind::Text },
  { ".vtu", FileKind::Xml },
  { ".decomposition", FileKind::Text },
};

FileKind KindOf(std::string_view path)
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
}

//------------------------------------------------------------------------------
/**
 * A decomposition that is being written.
 */
class vtkGranularDecompositionWriter::File : public WholeFile
{
public:
  File(vtkGranularDecompositionWriter* self, Internals& internals)
    : WholeFile({ self->FileName, static_cast<granular::Durability>(self->Durable), "subdomains",
                  self->Dialect == PUBLIC ? "PUBLIC" : "", self->Dialect == PUBLIC },
        internals.GetRanks(), internals.Inputs, *self->Past, internals.Notices)
    , Self(self)
    , Kind(KindOf(self->FileName))
  {
  }

protected:
  FrameFacts Take(vtkDataObject* input, const FrameTime& time, granular::Notices& notices) override
  {
    auto* grid = this->Check(input);
    NameFile({ this->Form.Path }, [&] { this->All = ReadVoxels(grid, notices); });
    return MakeFacts(grid, grid, grid->GetNumberOfCells() > 0, time);
  }

  void Gather(granular::Notices& notices, granular::Progress& progress) override
  {
    this->All = granular::gather_decomposition(this->All, this->Ranks);
    granular::SubdomainChecks checks; // that a file can be read at all
    checks.overlap = granular::Answer::None;
    checks.gap = granular::Answer::None;
    granular::check_subdomains(
      this->All.subdomains, checks, { .path = this->Form.Path }, notices, progress);
  }

  std::string Encode(
    const SharedFacts& facts, granular::Notices& notices, granular::Progress& progress) override
  {
    if (this->Self->Dialect == PUBLIC)
    {
      std::string text;
      NameFile({ this->Form.Path }, [&] { text = granular::encode_grid(this->All, notices); });
      return text;
    }
    if (this->Kind == FileKind::Text)
    {
      return granular::encode_voxels(this->All, progress);
    }
    return EncodeVtu(
      this->All, facts.HasTime ? std::optional(facts.Time) : std::nullopt, this->Form.Path);
  }

private:
  vtkUnstructuredGrid* Check(vtkDataObject* input) const
  {
    auto* grid = ExpectData<vtkUnstructuredGrid>(
      input, "a vtkUnstructuredGrid of voxels to write", { this->Form.Path });
    const auto box = FindBox(grid->GetFieldData());
    if (box && box->tilted)
    {
      throw granular::UnsupportedError(
        "expected a box along the axes, got a tilted one, whose subdomains are no voxels",
        { this->Form.Path });
    }
    return grid;
  }

  vtkGranularDecompositionWriter* Self;
  const FileKind Kind;
  granular::Decomposition All; ///< until they are gathered those of this process
};

//------------------------------------------------------------------------------
vtkGranularDecompositionWriter::vtkGranularDecompositionWriter()
  : Past(std::make_unique<WrittenFiles>())
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
  this->SetChoice("Dialect", this->Dialect, dialect, { "INL", "PUBLIC" });
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
  if (KindOf(path) == FileKind::Xml && this->Dialect == PUBLIC)
  {
    throw granular::UnsupportedError(
      "expected a name that ends in .vtk or .decomposition: the dialect PUBLIC has no .vtu",
      { path });
  }
  return std::make_unique<File>(this, internals);
}
