// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularEulerWriter
 * @brief   Writes averages over cells in the format of `dump euler/vtk` of LIGGGHTS.
 *
 * Writes a point for each cell: the points of a vtkPointSet with the point arrays v_avg (3), volumefraction, radius and pressure, or
 * the cell centres of a vtkImageData or vtkRectilinearGrid with these cell arrays, or of a composite of such grids. A missing array is
 * an error. Ghost duplicates are left out. Coordinates are written as absolute ones, by the field data of this library's readers and
 * filters (Coordinates, PointOrigin, BoxOrigin, BoxVectors, timestep, time).
 *
 * The first rank writes for all. Cells of a grid are in the order of LIGGGHTS, x fastest and z slowest, whichever rank has them. Points,
 * and the grids of a composite, are in the order of the ranks.
 *
 * The name may have any ending; text is compressed if it ends in `.gz` or `.zst`. A `*` in the name stands for the timestep; without
 * it, a file holds one timestep.
 *
 * vtkGranularWriter describes the rest. ParallelMode and Threads have no effect here.
 */

#ifndef vtkGranularEulerWriter_h
#define vtkGranularEulerWriter_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularWriter.h"

#include <memory> // for std::unique_ptr

class VTKGRANULAR_EXPORT vtkGranularEulerWriter : public vtkGranularWriter
{
public:
  static vtkGranularEulerWriter* New();
  vtkTypeMacro(vtkGranularEulerWriter, vtkGranularWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum DialectType
  {
    LIGGGHTS = 0,
    WIDE = 1,
    AUTOMATIC = 2
  };

  ///@{
  /**
   * Sets how numbers are written. LIGGGHTS: byte for byte like LIGGGHTS, six decimals, type float. WIDE: the fewest digits that
   * read back the same, type double; also the arrays sigma (3) and tau (3) if all ranks with cells have them. AUTOMATIC, the
   * default: LIGGGHTS if its text has the same values and the centres need no warning, as for cells from a file of LIGGGHTS,
   * otherwise WIDE.
   */
  vtkGranularSetChoiceMacro(Dialect, "LIGGGHTS", "Wide", "Automatic");
  vtkGetMacro(Dialect, int);
  ///@}

protected:
  vtkGranularEulerWriter() = default;
  ~vtkGranularEulerWriter() override = default;

  std::unique_ptr<vtkGranularPrivate::FrameWriter> OpenFile(Internals& internals) override;

  int Dialect = AUTOMATIC;

private:
  vtkGranularEulerWriter(const vtkGranularEulerWriter&) = delete;
  void operator=(const vtkGranularEulerWriter&) = delete;

  class File;
};

#endif
