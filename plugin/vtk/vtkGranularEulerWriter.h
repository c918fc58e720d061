// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularEulerWriter
 * @brief   Writes averages over cells of space as `dump euler/vtk` of LIGGGHTS does.
 *
 * Writes a point for each cell: the points of a vtkPointSet with the point arrays v_avg (3), volumefraction, radius and
 * pressure, or the middles of the cells of a vtkImageData or vtkRectilinearGrid with these cell arrays, or of a composite
 * of such. A missing array is an error. Cells that are duplicates of another process' are left out. The field data of this library's
 * readers and filters (Coordinates, PointOrigin, BoxOrigin, BoxVectors, timestep, time) are heeded: absolute coordinates are
 * written.
 *
 * The first process writes for all. Cells of a grid are in the order of LIGGGHTS, x fastest and z slowest, whichever process
 * has them; points, and the grids of a composite, are in the order of the processes.
 *
 * Any name will do; text is compressed where it ends in `.gz` or `.zst`. A `*` in the name stands for the timestep;
 * without one a file holds one time step.
 *
 * A timestep is written once, as LIGGGHTS does: who asks for it again, with the same name and Dialect, leaves the file as it
 * was, and Written is true. Without a timestep that goes for data that have not changed.
 *
 * See vtkGranularWriter for the rest. ParallelMode and Threads change nothing here.
 */

#ifndef vtkGranularEulerWriter_h
#define vtkGranularEulerWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularWriter.h"

#include <memory> // for std::unique_ptr

namespace vtkGranularPrivate
{
class WrittenFiles;
}

class VTKGRANULAR_EXPORT vtkGranularEulerWriter : public vtkGranularWriter
{
public:
  static vtkGranularEulerWriter* New();
  vtkTypeMacro(vtkGranularEulerWriter, vtkGranularWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum DialectType
  {
    LIGGGHTS = 0,
    WIDE = 1
  };

  ///@{
  /**
   * How numbers are written. LIGGGHTS, the default: byte for byte as it does, with six decimals, of type float. WIDE: the fewest
   * digits that read back the same, of type double, and the arrays sigma (3) and tau (3), too, if all processes that
   * have cells have them.
   */
  void SetDialect(int dialect);
  vtkGetMacro(Dialect, int);
  ///@}

protected:
  vtkGranularEulerWriter();
  ~vtkGranularEulerWriter() override;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Dialect = LIGGGHTS;

private:
  vtkGranularEulerWriter(const vtkGranularEulerWriter&) = delete;
  void operator=(const vtkGranularEulerWriter&) = delete;

  class File;

  std::unique_ptr<vtkGranularPrivate::WrittenFiles> Past;
};

#endif
