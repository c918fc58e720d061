// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularMeshReader
 * @brief   Reads walls and contacts that LIGGGHTS writes as VTK and STL files, with the timesteps of the run.
 *
 * Reads `dump mesh/stl`, `mesh/vtk`, `mesh/vtm`, `mesh/gran/VTK`, `stl` and `local/gran/vtk` of LIGGGHTS, and any other VTK, STL and PLY
 * files, one a timestep, which the name tells as in vtkGranularVTKParticleReader. vtkGranularSeriesReader tells which frames there are, and
 * their times: another time shows the last frame before. Only the wanted frame is read. Files that are not whole are errors or left out.
 *
 * The output is what VTK makes of the file, with all arrays, and the field data `timestep`; its type is that of the first file. Numbers of
 * surfaces in legacy files are doubles and 64-bit integers, and id1 and id2 of contacts are integers. The blocks Particles and Domain of
 * `dump custom/vtm` are left out. A frame without points has the arrays of a later one. Piece 0 has the whole.
 */

#ifndef vtkGranularMeshReader_h
#define vtkGranularMeshReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

class VTKGRANULAR_EXPORT vtkGranularMeshReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularMeshReader* New();
  vtkTypeMacro(vtkGranularMeshReader, vtkGranularSeriesReader);

  /**
   * Returns 1 if the file has a number in its name and is a mesh or contacts of LIGGGHTS by its title, which legacy VTK and STL files have.
   * Never fails.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularMeshReader();
  ~vtkGranularMeshReader() override = default;

  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularMeshReader(const vtkGranularMeshReader&) = delete;
  void operator=(const vtkGranularMeshReader&) = delete;

  struct Internals;
};

#endif
