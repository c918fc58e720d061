// SPDX-License-Identifier: BSD-3-Clause
// Arrays of VTK from lists of numbers, and back.
#ifndef granular_tests_support_vtk_arrays_h
#define granular_tests_support_vtk_arrays_h

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <vector>

using Values = std::vector<double>;

template <class Array = vtkDoubleArray>
vtkSmartPointer<Array> MakeArray(const char* name, const Values& values, int components = 1)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const double value : values)
  {
    array->InsertNextValue(static_cast<typename Array::ValueType>(value));
  }
  return array;
}

/// Returns all numbers of an array, tuple by tuple; none of null and of texts.
inline Values ValuesOf(vtkAbstractArray* array)
{
  Values values;
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  for (vtkIdType i = 0; numbers && i < numbers->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < numbers->GetNumberOfComponents(); ++k)
    {
      values.push_back(numbers->GetComponent(i, k));
    }
  }
  return values;
}
#endif
