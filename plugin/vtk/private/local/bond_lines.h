// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularBondLines_h
#define vtkGranularBondLines_h

#include "granular/packing/bonds.h"

class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * Fills the output with a line for each bond, with two points of its own and the cell data id1, id2, btype,
 * equilibrium_length and length. Takes over the memory of the bonds.
 */
void FillBonds(vtkPolyData* output, granular::GrainBonds& bonds);
}

#endif
