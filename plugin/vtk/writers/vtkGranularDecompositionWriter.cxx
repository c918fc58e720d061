// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDecompositionWriter.h"

#include "private/decomposition/voxels.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/writing/writer.h"

#include "granular/formats/decomposition/decomposition_text.h"
#include "granular/writing/file_names.h"

#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDecompositionWriter);

namespace
{
/**
 * Returns true for a file in XML, false for legacy text, by the end of its name.
 */
bool IsXml(std::string_view path)
{
  const bool xml = path.ends_with(".vtu");
  if (!xml && !path.ends_with(".vtk") && !path.ends_with(".decomposition"))
  {
    throw granular::UnsupportedError(
      "expected a name that ends in .vtk, .vtu or .decomposition", { std::string(path) });
  }
  return xml;
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
    : WholeFile(
        self->FileName, self->Dialect == PUBLIC, internals.MakeOptions(self), internals.GetRanks())
    , IsPublic(self->Dialect == PUBLIC)
  {
  }

protected:
  std::unique_ptr<RowsInput> Take(vtkDataObject* input, granular::Notices& notices) override
  {
    auto* grid = this->Check(input);
    NameFile({ this->Path }, [&] { this->All = ReadVoxels(grid, notices); });
    return std::make_unique<RowsInput>(grid, grid->GetNumberOfCells());
  }

  void Gather(granular::Notices& notices, granular::Progress& progress) override
  {
    this->All = granular::gather_decomposition(this->All, this->Ranks);
    granular::SubdomainChecks checks; // that a file can be read at all
    checks.overlap = granular::Answer::None;
    checks.gap = granular::Answer::None;
    granular::check_subdomains(
      this->All.subdomains, checks, { .path = this->Path }, notices, progress);
  }

  std::string Encode(
    std::optional<double> time, granular::Notices& notices, granular::Progress& progress) override
  {
    if (this->IsPublic)
    {
      return granular::encode_grid(this->All, notices);
    }
    return IsXml(this->Path) ? granular::encode_vtu(this->All, time, progress)
                             : granular::encode_voxels(this->All, progress);
  }

private:
  vtkUnstructuredGrid* Check(vtkDataObject* input) const
  {
    auto* grid = ExpectData<vtkUnstructuredGrid>(
      input, "a vtkUnstructuredGrid of voxels to write", { this->Path });
    const auto box = FindBox(grid->GetFieldData());
    if (box && box->tilted)
    {
      throw granular::UnsupportedError(
        "expected a box along the axes, got a tilted one, whose subdomains are no voxels",
        { this->Path });
    }
    return grid;
  }

  const bool IsPublic;         ///< the dialect
  granular::Decomposition All; ///< until they are gathered those of this process
};

vtkGranularPrintMacro(vtkGranularDecompositionWriter, Dialect);

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularDecompositionWriter::OpenFile(Internals& internals)
{
  const std::string path = this->FileName;
  if (granular::is_name_of_ranks(path))
  {
    throw granular::UnsupportedError(
      "expected a name without '%': one file holds the subdomains of all processes", { path });
  }
  if (IsXml(path) && this->Dialect == PUBLIC)
  {
    throw granular::UnsupportedError(
      "expected a name that ends in .vtk or .decomposition: the dialect PUBLIC has no .vtu",
      { path });
  }
  return std::make_unique<File>(this, internals);
}
