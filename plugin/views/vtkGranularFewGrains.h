// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularFewGrains_h
#define vtkGranularFewGrains_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

class vtkPolyData;

namespace vtkGranularFewGrains
{
/// Returns about one point of so many, without cells: those that a hash of the point array `id` chooses, so that they are the same
/// ones in each frame and on any number of ranks; without ids, a hash of the number of the point.
vtkSmartPointer<vtkPolyData> Choose(vtkPolyData* data, vtkIdType every);
}

#endif
