// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDecompositionWriter
 * @brief   Writes subdomains in the format of `dump decomposition/vtk` of LIGGGHTS.
 *
 * Writes the voxels of a vtkUnstructuredGrid, or hexahedra along the axes, with the cell arrays nlocal (number of particles) and proc
 * or procID (the rank), if present. Each rank of ParaView has a part of the cells, or none. The first one writes all cells in the order
 * of proc, so the bytes do not depend on the number of ranks. Ghost duplicates are left out. Coordinates are written as absolute
 * ones, by the field data of this library's readers and filters (Coordinates, PointOrigin, BoxOrigin, BoxVectors, timestep, time).
 *
 * The ending chooses the format: legacy text for `.vtk` and `.decomposition`, XML text for `.vtu`. A `*` in the name stands for the
 * timestep. Overlaps and gaps of subdomains are not checked.
 *
 * vtkGranularWriter describes the rest. ParallelMode has no effect here.
 */

#ifndef vtkGranularDecompositionWriter_h
#define vtkGranularDecompositionWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularWriter.h"

#include <memory> // for std::unique_ptr

class VTKGRANULAR_EXPORT vtkGranularDecompositionWriter : public vtkGranularWriter
{
public:
  static vtkGranularDecompositionWriter* New();
  vtkTypeMacro(vtkGranularDecompositionWriter, vtkGranularWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum DialectType
  {
    INL = 0,
    PUBLIC = 1
  };

  ///@{
  /**
   * Sets the program whose format is written. INL, the default: voxels with arrays, one timestep per file. PUBLIC: the
   * rectilinear grid of LIGGGHTS-PUBLIC, byte for byte: coordinates with six decimals, no arrays, legacy text only; the
   * subdomains must form a grid. Without a `*` in the name, several timesteps go into one file.
   */
  vtkGranularSetChoiceMacro(Dialect, "INL", "PUBLIC");
  vtkGetMacro(Dialect, int);
  ///@}

protected:
  vtkGranularDecompositionWriter() = default;
  ~vtkGranularDecompositionWriter() override = default;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Dialect = INL;

private:
  vtkGranularDecompositionWriter(const vtkGranularDecompositionWriter&) = delete;
  void operator=(const vtkGranularDecompositionWriter&) = delete;

  class File;
};

#endif
