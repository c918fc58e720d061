// SPDX-License-Identifier: BSD-3-Clause
#include "private/arrays/array_views.h"

#include "granular/common/error.h"

#include "vtkDataArray.h"
#include "vtkStringArray.h"

#include <string>

namespace vtkGranularPrivate
{
namespace
{
using granular::ValueType;

static_assert(sizeof(vtkStdString) == sizeof(std::string), "texts are viewed as std::string");

/**
 * The type of the core for a type of VTK, by kind and size.
 */
std::optional<ValueType> TypeOf(int type)
{
  if (type == VTK_FLOAT || type == VTK_DOUBLE)
  {
    return type == VTK_FLOAT ? ValueType::Float32 : ValueType::Float64;
  }
  struct Integer
  {
    int Bytes;
    ValueType Signed;
    ValueType Unsigned;
  };
  constexpr Integer integers[] = { { 1, ValueType::Int8, ValueType::UInt8 },
    { 2, ValueType::Int16, ValueType::UInt16 }, { 4, ValueType::Int32, ValueType::UInt32 },
    { 8, ValueType::Int64, ValueType::UInt64 } };
  for (const Integer& integer : integers)
  {
    if (vtkDataArray::GetDataTypeSize(type) == integer.Bytes)
    {
      return vtkDataArray::GetDataTypeMin(type) < 0 ? integer.Signed : integer.Unsigned;
    }
  }
  return {};
}
}

void ArrayViews::CheckTuples(vtkAbstractArray* array, const char* name, vtkIdType tuples) const
{
  if (array->GetNumberOfTuples() != tuples)
  {
    throw granular::Error("expected a value for each of " + std::to_string(tuples) + " " +
        this->Owners + ", got " + std::to_string(array->GetNumberOfTuples()),
      { .column = name });
  }
}

std::optional<granular::ArrayView> ArrayViews::See(
  vtkAbstractArray* array, const char* name, vtkIdType tuples)
{
  this->CheckTuples(array, name, tuples);
  granular::ArrayView view;
  const int size = array->GetNumberOfComponents();
  if (auto* texts = vtkStringArray::SafeDownCast(array))
  {
    const std::string* first = array->GetNumberOfValues() > 0 ? texts->GetPointer(0) : nullptr;
    view = granular::view_rows(name, ValueType::Text, first, size);
    return view;
  }
  auto* numbers = vtkDataArray::SafeDownCast(array);
  const bool bits = numbers && numbers->GetDataType() == VTK_BIT;
  const auto type = bits ? ValueType::UInt8
    : numbers            ? TypeOf(numbers->GetDataType())
                         : std::nullopt;
  if (!type || size == 0)
  {
    return {};
  }
  if (bits || !numbers->HasStandardMemoryLayout())
  {
    auto copy = vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(bits ? VTK_UNSIGNED_CHAR : numbers->GetDataType()));
    copy->DeepCopy(numbers);
    this->Copies.push_back(copy);
    numbers = copy;
  }
  view.name = name;
  view.type = *type;
  view.step = size;
  const char* first = static_cast<const char*>(numbers->GetVoidPointer(0));
  for (int i = 0; i < size; ++i)
  {
    view.components.push_back(first + i * numbers->GetDataTypeSize());
  }
  return view;
}
}
