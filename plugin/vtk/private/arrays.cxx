// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <numeric>

namespace vtkGranularPrivate
{
namespace
{
template <typename Array>
vtkSmartPointer<Array> TakeBlock(granular::Block& block, vtkIdType tuples, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  if (tuples > 0)
  {
    auto* values = static_cast<typename Array::ValueType*>(block.release());
    array->SetArray(values, tuples * components, 0, vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
    array->SetArrayFreeFunction(granular::Block::free);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> TakeTexts(const granular::DumpArray& texts, vtkIdType rows)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetNumberOfValues(rows);
  const auto* indices = static_cast<const vtkTypeInt32*>(texts.block.data());
  for (vtkIdType i = 0; i < rows; ++i)
  {
    array->SetValue(i, texts.words[indices[i]]);
  }
  return array;
}

/**
 * Components of three are axes, and shown as X, Y and Z anyway; others keep the file's names.
 */
void NameComponents(vtkAbstractArray* array, const granular::ArrayInfo& info,
  const std::vector<granular::ColumnInfo>& columns)
{
  const std::string& first = columns[info.columns.front()].name;
  if (info.components() == 1 || (info.components() == 3 && first.find('[') == std::string::npos))
  {
    return;
  }
  for (int i = 0; i < info.components(); ++i)
  {
    array->SetComponentName(i, columns[info.columns[i]].name.c_str());
  }
}

template <typename Index>
vtkSmartPointer<vtkCellArray> MakeVerticesOf(vtkIdType points, bool onePerPoint)
{
  const vtkIdType cells = onePerPoint ? points : 1;
  auto offsets = vtkSmartPointer<Index>::New();
  auto connectivity = vtkSmartPointer<Index>::New();
  offsets->SetNumberOfValues(cells + 1);
  connectivity->SetNumberOfValues(points);
  auto* first = offsets->GetPointer(0);
  if (onePerPoint)
  {
    std::iota(first, first + cells + 1, 0);
  }
  else
  {
    first[0] = 0;
    first[1] = static_cast<typename Index::ValueType>(points);
  }
  auto* index = connectivity->GetPointer(0);
  std::iota(index, index + points, 0);
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets.Get(), connectivity.Get());
  return vertices;
}
}

vtkSmartPointer<vtkAbstractArray> TakeArray(
  granular::DumpArray& array, vtkIdType rows, const std::vector<granular::ColumnInfo>& columns)
{
  const granular::ArrayInfo& info = array.info;
  vtkSmartPointer<vtkAbstractArray> taken;
  switch (info.type)
  {
    case granular::ValueType::Int32:
      taken = TakeBlock<vtkTypeInt32Array>(array.block, rows, info.components());
      break;
    case granular::ValueType::Int64:
      taken = TakeBlock<vtkTypeInt64Array>(array.block, rows, info.components());
      break;
    case granular::ValueType::Float64:
      taken = TakeBlock<vtkDoubleArray>(array.block, rows, info.components());
      break;
    case granular::ValueType::Text:
      taken = TakeTexts(array, rows);
      break;
  }
  taken->SetName(info.name.c_str());
  NameComponents(taken, info, columns);
  return taken;
}

vtkSmartPointer<vtkPoints> TakePoints(granular::Block& block, vtkIdType rows, bool single)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  vtkSmartPointer<vtkDataArray> values;
  if (single)
  {
    values = TakeBlock<vtkFloatArray>(block, rows, 3);
  }
  else
  {
    values = TakeBlock<vtkDoubleArray>(block, rows, 3);
  }
  values->SetName("Points");
  points->SetData(values);
  return points;
}

vtkSmartPointer<vtkAbstractArray> MakeDoubles(const char* name, const std::vector<double>& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTuple(values.data());
  return array;
}

vtkSmartPointer<vtkAbstractArray> MakeInteger(const char* name, vtkTypeInt64 value)
{
  auto array = vtkSmartPointer<vtkTypeInt64Array>::New();
  array->SetName(name);
  array->InsertNextValue(value);
  return array;
}

vtkSmartPointer<vtkAbstractArray> MakeStrings(
  const char* name, const std::vector<std::string>& values)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (const std::string& value : values)
  {
    array->InsertNextValue(value);
  }
  return array;
}

vtkSmartPointer<vtkCellArray> MakeVertices(vtkIdType points, bool onePerPoint)
{
  if (points == 0)
  {
    return vtkSmartPointer<vtkCellArray>::New();
  }
  return points < VTK_TYPE_INT32_MAX ? MakeVerticesOf<vtkTypeInt32Array>(points, onePerPoint)
                                     : MakeVerticesOf<vtkTypeInt64Array>(points, onePerPoint);
}
}
