// SPDX-License-Identifier: BSD-3-Clause
#include "local_rows.h"

#include "granular/base/error.h"
#include "granular/base/executor.h"
#include "granular/local/id_finder.h"
#include "granular/local/ids.h"
#include "granular/local/particle_values.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace vtkGranularPrivate
{
LocalRows::LocalRows(vtkDataObject* input)
{
  vtkIdType count = 0;
  if (auto* lines = vtkPolyData::SafeDownCast(input))
  {
    count = lines->GetNumberOfCells();
    this->Data = lines->GetCellData();
  }
  else if (auto* table = vtkTable::SafeDownCast(input))
  {
    count = table->GetNumberOfRows();
    this->Data = table->GetRowData();
  }
  else
  {
    throw granular::UnsupportedError(
      "expected lines as vtkPolyData, or a vtkTable with a row for each, got " +
      (input ? std::string("a ") + input->GetClassName() : "nothing") +
      (vtkCompositeDataSet::SafeDownCast(input) ? ": the filter MergeBlocks makes one of it" : ""));
  }
  this->Field = input->GetFieldData();
  this->FindTuples(count);
}

void LocalRows::FindTuples(vtkIdType count)
{
  this->AllTuples = count;
  const auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    this->Data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  if (ghosts)
  {
    this->Arrays.CheckTuples(
      const_cast<vtkUnsignedCharArray*>(ghosts), vtkDataSetAttributes::GhostArrayName(), count);
  }
  const int type =
    this->HasNumbers(RowArray) ? this->Data->GetArray(RowArray)->GetDataType() : VTK_DOUBLE;
  const bool split = type != VTK_FLOAT && type != VTK_DOUBLE;
  granular::Ids numbers;
  if (split)
  {
    granular::Progress progress;
    numbers = granular::Ids(this->See(RowArray), count, granular::Executor(), progress);
  }
  granular::IdTable known;
  for (vtkIdType tuple = 0; tuple < count; ++tuple)
  {
    const bool duplicate =
      ghosts && (ghosts->GetValue(tuple) & vtkDataSetAttributes::DUPLICATECELL) != 0;
    if (!duplicate &&
      (!split || known.add(numbers.values()[static_cast<std::size_t>(tuple)], tuple)))
    {
      this->Tuples.push_back(tuple);
    }
  }
}

void LocalRows::Keep(std::pair<vtkTypeInt64, vtkTypeInt64> range)
{
  this->Tuples.erase(this->Tuples.begin() + range.second, this->Tuples.end());
  this->Tuples.erase(this->Tuples.begin(), this->Tuples.begin() + range.first);
}

bool LocalRows::Has(const char* name) const
{
  return this->Data->HasArray(name) != 0;
}

bool LocalRows::HasNumbers(const char* name) const
{
  vtkDataArray* array = this->Data->GetArray(name);
  return array && array->GetNumberOfComponents() == 1;
}

granular::ArrayView LocalRows::See(const char* name)
{
  vtkAbstractArray* array = this->Data->GetAbstractArray(name);
  if (!array)
  {
    throw granular::Error("expected an array '" + std::string(name) + "' of the lines, got none");
  }
  const auto view = this->Arrays.See(array, name, this->AllTuples);
  if (!view || view->type == granular::ScalarType::Text || view->size() != 1)
  {
    throw granular::Error("expected one number a row in the array '" + std::string(name) +
      "' of the lines, got " +
      (view && view->type != granular::ScalarType::Text
          ? std::to_string(view->size())
          : std::string("the type ") + array->GetDataTypeAsString()));
  }
  return *view;
}

std::vector<std::int64_t> LocalRows::ReadIds(const char* name, granular::Progress& progress)
{
  std::vector<std::int64_t> ids;
  if (this->Count() > 0)
  {
    const granular::Ids all(this->See(name), this->AllTuples, granular::Executor(), progress);
    std::ranges::transform(this->Tuples, std::back_inserter(ids),
      [&](vtkIdType tuple) { return all.values()[static_cast<std::size_t>(tuple)]; });
  }
  return ids;
}

std::vector<double> LocalRows::ReadNumbers(const char* name, const std::vector<std::int64_t>& rows)
{
  std::vector<double> numbers(rows.size());
  if (!rows.empty())
  {
    std::vector<std::int64_t> tuples;
    std::ranges::transform(rows, std::back_inserter(tuples),
      [&](std::int64_t row) { return this->Tuples[static_cast<std::size_t>(row)]; });
    granular::gather_numbers(this->See(name), 0, tuples, numbers.data());
  }
  return numbers;
}

void LocalRows::Pass(const std::vector<std::int64_t>& rows, vtkDataSetAttributes* to) const
{
  vtkNew<vtkIdList> tuples;
  tuples->SetNumberOfIds(static_cast<vtkIdType>(rows.size()));
  bool same = static_cast<vtkIdType>(rows.size()) == this->AllTuples;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const vtkIdType tuple = this->Tuples[static_cast<std::size_t>(rows[i])];
    tuples->SetId(static_cast<vtkIdType>(i), tuple);
    same = same && tuple == static_cast<vtkIdType>(i);
  }
  for (int i = 0; i < this->Data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* from = this->Data->GetAbstractArray(i);
    const char* name = from->GetName();
    if (!name || !*name || std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue;
    }
    this->Arrays.CheckTuples(from, name, this->AllTuples);
    if (same)
    {
      to->AddArray(from);
      continue;
    }
    auto copy = vtkSmartPointer<vtkAbstractArray>::Take(from->NewInstance());
    copy->SetName(name);
    copy->SetNumberOfComponents(from->GetNumberOfComponents());
    copy->CopyComponentNames(from);
    copy->SetNumberOfTuples(tuples->GetNumberOfIds());
    from->GetTuples(tuples, copy);
    to->AddArray(copy);
  }
}
}
