// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEulerWriter.h"

#include "private/euler/euler_input.h"
#include "private/request/errors.h"
#include "private/writing/writer.h"

#include "granular/euler/euler_text.h"
#include "granular/writing/file_names.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularEulerWriter);

namespace
{
static_assert(
  vtkGranularEulerWriter::LIGGGHTS == static_cast<int>(granular::EulerDialect::Liggghts) &&
  vtkGranularEulerWriter::WIDE == static_cast<int>(granular::EulerDialect::Wide) &&
  vtkGranularEulerWriter::AUTOMATIC == static_cast<int>(granular::EulerDialect::Automatic));
}

//------------------------------------------------------------------------------
/**
 * Cells that are being written.
 */
class vtkGranularEulerWriter::File : public WholeFile
{
public:
  File(vtkGranularEulerWriter* self, Internals& internals)
    : WholeFile(self->FileName, false, internals.MakeOptions(self), internals.GetRanks())
    , Dialect(static_cast<granular::EulerDialect>(self->Dialect))
  {
  }

protected:
  std::unique_ptr<RowsInput> Take(
    vtkDataObject* input, granular::Notices& vtkNotUsed(notices)) override
  {
    NameFile({ this->Path }, [&] { this->Own = ReadCells(input); });
    return std::make_unique<RowsInput>(this->Own.Points, this->Own.Cells.count());
  }

  void Gather(granular::Notices&, granular::Progress&) override
  {
    NameFile(
      { this->Path }, [&] { this->All = GatherCells(std::exchange(this->Own, {}), this->Ranks); });
  }

  std::string Encode(
    std::optional<double>, granular::Notices& notices, granular::Progress& progress) override
  {
    return granular::encode_euler(this->All, this->Dialect, notices, progress);
  }

private:
  const granular::EulerDialect Dialect;
  EulerInput Own;
  granular::EulerCells All;
};

//------------------------------------------------------------------------------
void vtkGranularEulerWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dialect: " << this->Dialect << "\n";
}

//------------------------------------------------------------------------------
void vtkGranularEulerWriter::SetDialect(int dialect)
{
  this->SetChoice("Dialect", this->Dialect, dialect, { "LIGGGHTS", "Wide", "Automatic" });
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameWriter> vtkGranularEulerWriter::OpenFile(Internals& internals)
{
  const std::string path = this->FileName;
  if (granular::is_name_of_ranks(path))
  {
    throw granular::UnsupportedError(
      "expected a name without '%': one file holds the cells of all processes", { path });
  }
  return std::make_unique<File>(this, internals);
}
