// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDecompositionWriter
 * @brief   Writes subdomains as `dump decomposition/vtk` of LIGGGHTS does.
 *
 * Writes the voxels of a vtkUnstructuredGrid - or hexahedra, if they lie along the axes - with the cell arrays nlocal,
 * how many particles a process has, and proc (or procID), which process it is, as far as there are any. Each
 * process has a part of the cells, or none: they are written in the order of the processes, by the first one, so that the
 * bytes do not depend on the number of processes. Cells that are duplicates of another process' are left out. The field data
 * of this library's readers and filters (Coordinates, PointOrigin, BoxOrigin, BoxVectors, timestep, time) are
 * heeded: absolute coordinates are written.
 *
 * The name says the form: `.vtk` and `.decomposition` legacy text, `.vtu` XML, also text. A `*` in the name stands for
 * the timestep. Subdomains that overlap or leave gaps are written as they are.
 *
 * A timestep is written once, as LIGGGHTS does by its lasttimestep: who asks for it again, with the same name and Dialect,
 * leaves the file as it was, and Written is true. Without a timestep that goes for data that have not changed.
 *
 * See vtkGranularWriter for the rest. ParallelMode changes nothing here.
 */

#ifndef vtkGranularDecompositionWriter_h
#define vtkGranularDecompositionWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularWriter.h"

#include <memory> // for std::unique_ptr

namespace vtkGranularPrivate
{
class WrittenFiles;
}

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
   * Whose files they are like. INL, the default: voxels with arrays, one time step a file. PUBLIC: the rectilinear grid of
   * LIGGGHTS-PUBLIC, byte for byte: coordinates with six decimals, no arrays; legacy text only; subdomains must form a
   * grid. Several time steps come one after the other in one file if there is no `*` in its name.
   */
  void SetDialect(int dialect);
  vtkGetMacro(Dialect, int);
  ///@}

  ///@{
  /**
   * Off. On is an error of Write(): the format is text.
   */
  vtkSetMacro(Binary, bool);
  vtkGetMacro(Binary, bool);
  vtkBooleanMacro(Binary, bool);
  ///@}

protected:
  vtkGranularDecompositionWriter();
  ~vtkGranularDecompositionWriter() override;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Dialect = INL;
  bool Binary = false;

private:
  vtkGranularDecompositionWriter(const vtkGranularDecompositionWriter&) = delete;
  void operator=(const vtkGranularDecompositionWriter&) = delete;

  class File;

  std::unique_ptr<vtkGranularPrivate::WrittenFiles> Past;
};

#endif
