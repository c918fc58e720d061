// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPointAverage.h"

#include "private/euler/average_task.h"
#include "private/euler/euler_cells.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/averages/chosen_averages.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <string>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularPointAverage);

using Pipeline = vtkStreamingDemandDrivenPipeline;

//------------------------------------------------------------------------------
class vtkGranularPointAverage::Task : public FilterTask<vtkGranularPointAverage, AverageTask>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    this->Points = ExpectData<vtkDataSet>(this->GetInput(POINTS_PORT), "a vtkDataSet as Points");
    const Frame frame(this->Inputs, this->Ranks);
    granular::PointAveraging averaging(
      this->Choose(this->Self->Kernel), this->Group, this->Notices);
    this->Fill(averaging.average(frame.Input, this->ReadPoints(), this->Progress));
  }

  std::vector<double> ReadPoints() const
  {
    const vtkIdType count = this->Points->GetNumberOfPoints();
    std::vector<double> places(static_cast<std::size_t>(3 * count));
    for (vtkIdType i = 0; i < count; ++i)
    {
      this->Points->GetPoint(i, places.data() + 3 * i);
    }
    return places;
  }

  void Fill(const granular::EulerFrame& averages)
  {
    auto* output = this->GetOutput<vtkDataSet>();
    output->ShallowCopy(this->Points);
    vtkNew<vtkPointData> fields;
    AddArrays(fields, averages, this->Points->GetNumberOfPoints());
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = fields->GetAbstractArray(i);
      if (this->Points->GetPointData()->HasArray(array->GetName()))
      {
        array->SetName((std::string(array->GetName()) + "_avg").c_str());
      }
      output->GetPointData()->AddArray(array);
    }
    for (const char* name : { "timestep", "time" })
    {
      if (vtkAbstractArray* array = this->Inputs[0]->GetFieldData()->GetAbstractArray(name))
      {
        output->GetFieldData()->AddArray(array);
      }
    }
  }

  vtkDataSet* Points = nullptr;
};

vtkGranularExecuteMacro(vtkGranularPointAverage);

//------------------------------------------------------------------------------
vtkGranularPointAverage::vtkGranularPointAverage()
{
  this->SetNumberOfInputPorts(4);
}

//------------------------------------------------------------------------------
int vtkGranularPointAverage::RequestDataObject(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* points = vtkDataObject::GetData(inputVector[POINTS_PORT]);
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (points && (!output || !output->IsA(points->GetClassName())))
  {
    auto made = vtkSmartPointer<vtkDataObject>::Take(points->NewInstance());
    info->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
// Structured points have an extent, and the times are those of the particles.
int vtkGranularPointAverage::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* points = inputVector[POINTS_PORT]->GetInformationObject(0);
  vtkInformation* output = outputVector->GetInformationObject(0);
  output->CopyEntry(points, Pipeline::WHOLE_EXTENT());
  output->CopyEntry(points, vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
  output->CopyEntry(points, vtkDataObject::ORIGIN());
  output->CopyEntry(points, vtkDataObject::SPACING());
  if (output->Has(Pipeline::WHOLE_EXTENT()))
  {
    return 1;
  }
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkGranularPointAverage::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  const PieceRequest wanted = PieceRequest::Of(outputVector->GetInformationObject(0));
  vtkInformation* points = inputVector[POINTS_PORT]->GetInformationObject(0);
  vtkInformation* output = outputVector->GetInformationObject(0);
  points->Set(Pipeline::UPDATE_PIECE_NUMBER(), wanted.Piece);
  points->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), wanted.Pieces);
  if (output->Has(Pipeline::UPDATE_EXTENT()))
  {
    points->CopyEntry(output, Pipeline::UPDATE_EXTENT());
  }
  return 1;
}

vtkGranularPrintMacro(vtkGranularPointAverage, Kernel);
