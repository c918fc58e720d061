// SPDX-License-Identifier: BSD-3-Clause
/**
 * A frame without particles or contacts takes the place of its simulation box, which the field data BoxOrigin and BoxVectors give. The
 * first frame of most runs is empty, and ParaView puts the camera where the first frame wants it.
 */
#ifndef vtkGranularEmptyFrame_h
#define vtkGranularEmptyFrame_h

#include "vtkType.h"

class vtkActor;
class vtkDataObject;
class vtkInformation;
class vtkPVDataRepresentation;

namespace vtkGranularEmptyFrame
{
vtkIdType CountPoints(vtkDataObject* data);

/**
 * Returns the number of points on all ranks. All must ask.
 */
vtkIdType CountOnRanks(vtkDataObject* data);

/**
 * Tells a view the bounds of what a representation draws in the place of its actor: those given or, without points on any rank, those
 * of the box in the data, if this rank has it. Scaled coordinates are in the unit cube.
 */
void SetBounds(vtkInformation* view, vtkPVDataRepresentation* representation, vtkDataObject* data,
  vtkIdType points, vtkActor* actor, const double bounds[6]);
}

#endif
