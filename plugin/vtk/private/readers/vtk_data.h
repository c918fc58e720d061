// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVtkData_h
#define vtkGranularVtkData_h

#include "granular/geometry/box.h"
#include "granular/runs/kind.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkPointSet;
class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * VTK, STL and PLY files as a run: frames and times. Their contents become data of VTK, not tables of the core.
 */
extern const granular::Kind VtkKind;

/**
 * Returns the type of data that a file holds, such as VTK_POLY_DATA.
 */
int FindDataType(const std::string& path);

/**
 * Returns the contents of the pieces of a frame as one; cells: with those of surfaces. Surfaces in legacy files are read by the core, all
 * else by VTK. Throws, also where VTK's readers tell errors.
 */
vtkSmartPointer<vtkDataObject> ReadData(
  const std::vector<granular::FramePiece>& pieces, bool cells, granular::Progress& progress);

/**
 * Takes the block of a name, or null, out of a multi-block data set.
 */
vtkSmartPointer<vtkDataObject> TakeBlock(vtkDataObject* blocks, const char* name);

/**
 * Returns the box of the particles in a file: from a block, if it is not null, or a file of its own.
 */
std::optional<granular::Box> ReadVtkBox(vtkDataObject* block, const std::string& path);

/**
 * Fills rows [first, last) of points, and their arrays: `id` of 64 bits, `type` of 32, and `radius` made of `diameter` if there is none.
 */
void FillVtkParticles(vtkPolyData* output, vtkPointSet* from, vtkIdType first, vtkIdType last);

/**
 * Returns the next frame whose first file is larger than that of a frame without arrays, or that frame.
 */
std::size_t FindFilled(const granular::RunIndex& index, std::size_t frame);
}

#endif
