// SPDX-License-Identifier: BSD-3-Clause
// What makes an output of a reader safe for the filters after it.
#ifndef granular_tests_faults_valid_outputs_h
#define granular_tests_faults_valid_outputs_h

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <string>

/// What nobody needs, but no compiler may leave out.
inline volatile unsigned touched = 0;

/// Reads every value: a memory checker sees those that are not there.
inline void TouchAll(vtkAbstractArray* array)
{
  unsigned sum = 0;
  if (auto* const texts = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
    {
      sum += static_cast<unsigned>(texts->GetValue(i).size());
    }
    touched = sum;
    return;
  }
  const auto* const bytes = static_cast<const unsigned char*>(array->GetVoidPointer(0));
  for (vtkIdType i = 0; i < array->GetNumberOfValues() * array->GetDataTypeSize(); ++i)
  {
    sum += bytes[i];
  }
  touched = sum;
}

/// What is wrong; empty: nothing.
inline std::string WrongArrays(vtkFieldData* arrays, vtkIdType rows, const char* of)
{
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = arrays->GetAbstractArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    if (!array || name.empty())
    {
      return std::string("an array of ") + of + " without a name";
    }
    if (rows >= 0 && array->GetNumberOfTuples() != rows)
    {
      return std::string(of) + ": " + std::to_string(array->GetNumberOfTuples()) + " tuples of " +
        name + ", expected " + std::to_string(rows);
    }
    TouchAll(array);
  }
  return {};
}

inline std::string WrongCells(vtkCellArray* cells, vtkIdType points)
{
  const auto each = vtk::TakeSmartPointer(cells->NewIterator());
  for (each->GoToFirstCell(); !each->IsDoneWithTraversal(); each->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    each->GetCurrentCell(count, ids);
    for (vtkIdType i = 0; i < count; ++i)
    {
      if (ids[i] < 0 || ids[i] >= points)
      {
        return "a cell of point " + std::to_string(ids[i]) + " of " + std::to_string(points);
      }
    }
  }
  return {};
}

inline std::string WrongIn(vtkDataObject* output, bool empty);

/// What is wrong with the blocks of an output; empty: nothing.
inline std::string WrongBlocks(vtkCompositeDataSet* blocks, bool empty)
{
  std::string wrong;
  const auto each = vtk::TakeSmartPointer(blocks->NewIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
  {
    wrong += WrongIn(each->GetCurrentDataObject(), empty);
  }
  return wrong;
}

/// What is wrong with an output, or, where it must be empty, what it has; empty: nothing.
inline std::string WrongIn(vtkDataObject* output, bool empty)
{
  if (!output)
  {
    return empty ? "" : "no output";
  }
  std::string wrong = WrongArrays(output->GetFieldData(), -1, "field data");
  if (auto* const table = vtkTable::SafeDownCast(output))
  {
    wrong += WrongArrays(table->GetRowData(), table->GetNumberOfRows(), "rows");
    return wrong + (empty && table->GetNumberOfRows() > 0 ? "rows after an error" : "");
  }
  if (auto* const blocks = vtkCompositeDataSet::SafeDownCast(output))
  {
    return wrong + WrongBlocks(blocks, empty);
  }
  auto* const data = vtkDataSet::SafeDownCast(output);
  if (!data)
  {
    return "not a data set";
  }
  const vtkIdType points = data->GetNumberOfPoints();
  wrong += WrongArrays(data->GetPointData(), points, "points");
  wrong += WrongArrays(data->GetCellData(), data->GetNumberOfCells(), "cells");
  if (auto* const set = vtkPointSet::SafeDownCast(output); set && set->GetPoints())
  {
    TouchAll(set->GetPoints()->GetData());
  }
  if (auto* const poly = vtkPolyData::SafeDownCast(output))
  {
    for (vtkCellArray* cells : { poly->GetVerts(), poly->GetLines(), poly->GetPolys() })
    {
      wrong += WrongCells(cells, points);
    }
  }
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(output); grid && grid->GetCells())
  {
    wrong += WrongCells(grid->GetCells(), points);
  }
  return wrong + (empty && points > 0 ? "points after an error" : "");
}

#endif
