// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularBondLines_h
#define vtkGranularBondLines_h

#include "granular/packing/bonds.h"

class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * A line a bond, with two points of its own, and cell data: id1, id2, btype, equilibrium_length and length.
 * Takes the memory of the bonds.
 */
void FillBonds(vtkPolyData* output, granular::GrainBonds& bonds);
}

#endif
