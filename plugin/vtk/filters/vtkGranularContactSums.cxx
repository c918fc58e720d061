// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularContactSums.h"

#include "private/arrays/arrays.h"
#include "private/arrays/made_arrays.h"
#include "private/contacts/contact_input.h"
#include "private/dump/dump_input.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/contacts/chosen_sums.h"

#include "vtkCellData.h"
#include "vtkDataArraySelection.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnsignedCharArray.h"

#include <numeric>
#include <span>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularContactSums);

namespace
{
/**
 * Returns an array that takes over the values of a sum.
 */
vtkSmartPointer<vtkDataArray> ArrayOfSum(granular::SummedArray& sum, vtkIdType rows)
{
  const auto integers = [&]<class Array>(Array*)
  {
    const auto* const values = static_cast<const typename Array::ValueType*>(sum.values.data());
    return ArrayOf<Array>(sum.name, std::span(values, static_cast<std::size_t>(rows)));
  };
  if (sum.type == granular::ValueType::Int32)
  {
    return integers(static_cast<vtkTypeInt32Array*>(nullptr));
  }
  if (sum.type == granular::ValueType::UInt8)
  {
    return integers(static_cast<vtkUnsignedCharArray*>(nullptr));
  }
  auto array = TakeDoubles(sum.name, sum.values, rows, sum.components);
  for (int i = 0; sum.components == 6 && i < 6; ++i)
  {
    array->SetComponentName(i, granular::tensor_components[i]);
  }
  return array;
}
}

//------------------------------------------------------------------------------
class vtkGranularContactSums::Task : public FilterTask<vtkGranularContactSums>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    const vtkGranularContactSums& self = *this->Self;
    const Particles particles(this->Given, this->Ranks);
    const GivenContacts contacts({ this->Lines, this->GetInput(2) });
    granular::ChosenSumsRequest request{ ChoiceOf(
      self.ArraySelection, granular::contact_sum_arrays) };
    request.half_branch = self.LeverArm == HALF_BRANCH;
    request.least_force = self.MinimumForce;
    request.least_overlap = self.MinimumOverlap;
    request.rattler_contacts = self.RattlerContacts;
    request.friction_coefficient = self.FrictionCoefficient;
    request.radius = self.RadiusArray;
    request.threads = this->Threads;
    request.timestep = TimestepOf(this->Given->GetFieldData());
    this->Sums = granular::sum_chosen(
      particles.View, contacts.Sources, request, this->Group, this->Notices, this->Progress);
    this->FillParticles();
    if (auto* const lines = vtkPointSet::SafeDownCast(this->Lines); lines && this->Sums.friction)
    {
      this->FillLines(lines, *contacts.Rows[0]);
    }
  }

  void FillParticles()
  {
    auto* input = vtkPointSet::SafeDownCast(this->Given);
    vtkNew<vtkPolyData> all;
    const vtkIdType rows = input->GetNumberOfPoints();
    all->SetPoints(input->GetPoints());
    all->GetPointData()->PassData(input->GetPointData());
    for (granular::SummedArray& sum : this->Sums.arrays)
    {
      all->GetPointData()->AddArray(ArrayOfSum(sum, rows));
    }
    auto* output = this->GetOutput<vtkPolyData>();
    auto* cells = vtkPolyData::SafeDownCast(input);
    if (this->Together && cells)
    {
      output->CopyStructure(cells);
      output->GetCellData()->PassData(cells->GetCellData());
      output->GetPointData()->PassData(all->GetPointData());
    }
    else if (this->Together)
    {
      output->SetPoints(input->GetPoints());
      output->SetVerts(MakeCells(rows, 1));
      output->GetPointData()->PassData(all->GetPointData());
    }
    else
    {
      this->FillPiece(all, output);
    }
    vtkFieldData* fields = output->GetFieldData();
    fields->PassData(input->GetFieldData());
    for (const auto& [name, value] : this->Sums.means)
    {
      fields->AddArray(MakeDoubles(name, { value }));
    }
  }

  /**
   * Fills the output with a piece of the whole, which each rank has made.
   */
  void FillPiece(vtkPolyData* all, vtkPolyData* output)
  {
    const auto [first, last] = this->RangeOf(all->GetNumberOfPoints());
    vtkNew<vtkIdList> tuples;
    tuples->SetNumberOfIds(last - first);
    std::iota(tuples->begin(), tuples->end(), first);
    if (vtkPoints* const given = all->GetPoints())
    {
      vtkNew<vtkPoints> points;
      points->SetData(vtkDataArray::SafeDownCast(TakeTuples(given->GetData(), tuples)));
      output->SetPoints(points);
    }
    output->SetVerts(MakeCells(last - first, 1));
    for (int i = 0; i < all->GetPointData()->GetNumberOfArrays(); ++i)
    {
      output->GetPointData()->AddArray(
        TakeTuples(all->GetPointData()->GetAbstractArray(i), tuples));
    }
  }

  /**
   * Lines with their mobilised friction.
   */
  void FillLines(vtkPointSet* input, const LocalRows& rows)
  {
    auto* output = this->GetOutput<vtkPolyData>(1);
    const auto [first, last] = this->RangeOf(rows.Count());
    std::vector<std::int64_t> wanted(static_cast<std::size_t>(last - first));
    std::iota(wanted.begin(), wanted.end(), first);
    const ChosenCells cells = rows.AddLines(input, wanted, output);
    rows.PassCells(cells.All, output->GetCellData());
    const std::vector<double>& friction = *this->Sums.friction;
    output->GetCellData()->AddArray(ArrayOf<vtkDoubleArray>(granular::friction_array, cells.Rows,
      [&](std::int64_t row) { return friction[static_cast<std::size_t>(row)]; }));
    output->GetFieldData()->PassData(input->GetFieldData());
  }

  vtkDataObject* const Given = this->GetInput(0);
  vtkDataObject* const Lines = this->GetInput(1);
  granular::ChosenSums Sums;
};

vtkGranularExecuteMacro(vtkGranularContactSums);
vtkGranularOutputMacro(vtkGranularContactSums, GetOutput, vtkPolyData, 0);
vtkGranularOutputMacro(vtkGranularContactSums, GetLinesOutput, vtkPolyData, 1);

//------------------------------------------------------------------------------
vtkGranularContactSums::vtkGranularContactSums()
  : ArraySelection(MakeSelection(this, granular::contact_sum_arrays))
{
  this->SetPorts(
    { Input::Required, Input::Optional, Input::Optional }, { "vtkPolyData", "vtkPolyData" });
}

//------------------------------------------------------------------------------
vtkGranularContactSums::~vtkGranularContactSums()
{
  this->ArraySelection->Delete();
}

//------------------------------------------------------------------------------
void vtkGranularContactSums::SetArrayStatus(const char* name, int status)
{
  this->ArraySelection->SetArraySetting(name, status);
}

//------------------------------------------------------------------------------
void vtkGranularContactSums::ClearArrays()
{
  this->ArraySelection->DisableAllArrays();
}

vtkGranularPrintMacro(vtkGranularContactSums, LeverArm, MinimumForce, MinimumOverlap,
  RattlerContacts, FrictionCoefficient, RadiusArray, ArraySelection);
