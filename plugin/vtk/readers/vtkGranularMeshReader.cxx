// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularMeshReader.h"

#include "private/readers/series_reader.h"
#include "private/readers/vtk_data.h"
#include "private/request/guard.h"

#include "granular/formats/vtk_files/vtk_series.h"

#include "vtkCellData.h"
#include "vtkDataObjectTypes.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTypeInt64Array.h"

#include <array>
#include <memory>
#include <string>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularMeshReader);

//------------------------------------------------------------------------------
struct vtkGranularMeshReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularMeshReader* reader)
    : vtkGranularSeriesReader::Internals(reader, VtkKind)
  {
  }

  void OfferArrays(vtkDataSet* output, Shown& shown);
  void Show(Shown& shown) override;
};

//------------------------------------------------------------------------------
// A frame without points, such as the first contacts of a run, has no arrays, but those of a later one.
void vtkGranularMeshReader::Internals::OfferArrays(vtkDataSet* output, Shown& shown)
{
  const granular::RunIndex& index = this->Run.index();
  const std::size_t filled = FindFilled(index, shown.Number);
  if (output && output->GetNumberOfPoints() == 0 && filled != shown.Number)
  {
    const auto data = ReadData(index.pieces(filled), true, shown.Progress);
    if (auto* const other = vtkDataSet::SafeDownCast(data))
    {
      output->GetPointData()->CopyAllocate(other->GetPointData(), 1);
      output->GetCellData()->CopyAllocate(other->GetCellData(), 1);
    }
  }
}

//------------------------------------------------------------------------------
void vtkGranularMeshReader::Internals::Show(Shown& shown)
{
  vtkDataObject* const output = vtkDataObject::GetData(shown.Outputs);
  if (shown.Piece.Piece == 0)
  {
    const vtkSmartPointer<vtkDataObject> data = ReadData(shown.Pieces, true, shown.Progress);
    if (data->GetDataObjectType() != output->GetDataObjectType())
    {
      throw granular::UnsupportedError("expected a " + std::string(output->GetClassName()) +
          " as in the first file, got a " + data->GetClassName(),
        shown.Where);
    }
    TakeBlock(data, "Particles");
    TakeBlock(data, "Domain");
    output->ShallowCopy(data);
    this->OfferArrays(vtkDataSet::SafeDownCast(output), shown);
  }
  output->GetFieldData()->AddArray(
    ArrayOf<vtkTypeInt64Array>("timestep", std::array{ shown.Pieces.front().entry.timestep }));
}

//------------------------------------------------------------------------------
vtkGranularMeshReader::vtkGranularMeshReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkDataObject" }); // see RequestDataObject
}

//------------------------------------------------------------------------------
int vtkGranularMeshReader::CanReadFile(const char* fileName)
{
  return granular::is_vtk_mesh(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
// There is an output whatever happens.
int vtkGranularMeshReader::RequestDataObject(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkInformation* const info = outputVector->GetInformationObject(0);
  int type = VTK_POLY_DATA;
  const Outcome outcome = Guard(this, *this->Ranks, outputVector,
    [&]
    {
      this->Series->Update();
      type = FindDataType(this->Series->Run.index().first_piece(0).file.path);
    });
  vtkDataObject* const before = info->Get(vtkDataObject::DATA_OBJECT());
  if (!before || before->GetDataObjectType() != type)
  {
    info->Set(vtkDataObject::DATA_OBJECT(),
      vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type)));
  }
  return this->Ranks->EndRequest(this, outcome);
}
