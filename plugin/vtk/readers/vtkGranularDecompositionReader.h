// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDecompositionReader
 * @brief   Reads `dump decomposition/vtk` files: the subdomains of a simulation's ranks.
 *
 * - Rectilinear grids in legacy VTK text, of LIGGGHTS-PUBLIC and PFM: one cell per rank. They hold no counts and do not tell which
 *   rank owns which cell. Several grids in one file are timesteps. PFM writes a file per rank (`%`); the reader merges these and then
 *   knows the ranks.
 * - Voxels in unstructured .vtk (ASCII and BINARY) and .vtu files, of LIGGGHTS-INL and vtkGranularDecompositionWriter, with the cell
 *   arrays `nlocal` and `proc`. LIGGGHTS-INL writes mirror images, which have no volume; the reader corrects them, with a warning.
 *
 * The timestep is the last number in the file name that differs between the files. Frames are counted from 0 if a file holds several
 * of them, or if its name has no number. vtkGranularSeriesReader tells which frames there are, and their times.
 *
 * The output and its pieces are those of vtkGranularDecompositionAlgorithm: voxels, with `nlocal` and `proc` if the file has them.
 * Field data: the smallest box around all subdomains as BoxOrigin, BoxVectors and BoxBounds, `timestep`, and with counts `imbalance`,
 * the largest divided by the mean.
 */

#ifndef vtkGranularDecompositionReader_h
#define vtkGranularDecompositionReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

class vtkUnstructuredGrid;

class VTKGRANULAR_EXPORT vtkGranularDecompositionReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularDecompositionReader* New();
  vtkTypeMacro(vtkGranularDecompositionReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the voxels.
   */
  vtkUnstructuredGrid* GetOutput();

  enum AnswerType
  {
    ANSWER_ERROR = 0,
    ANSWER_WARNING = 1,
    ANSWER_NOTHING = 2
  };

  ///@{
  /**
   * Sets the action for wrong subdomains: an error (the default), a warning, or none. CheckOverlap: two subdomains share
   * more than faces, by more than 1e-9 of the box's edge. CheckGaps: together they do not fill the smallest box around them,
   * by more than 1e-9 of its volume.
   */
  vtkGranularSetRangeMacro(CheckOverlap, int, ANSWER_ERROR, ANSWER_NOTHING);
  vtkGetMacro(CheckOverlap, int);
  vtkGranularSetRangeMacro(CheckGaps, int, ANSWER_ERROR, ANSWER_NOTHING);
  vtkGetMacro(CheckGaps, int);
  ///@}

  /**
   * Returns 1 if the contents of the file are those of dump decomposition/vtk, and 0 for other .vtk and .vtu files. Never
   * fails.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularDecompositionReader();
  ~vtkGranularDecompositionReader() override = default;

private:
  vtkGranularDecompositionReader(const vtkGranularDecompositionReader&) = delete;
  void operator=(const vtkGranularDecompositionReader&) = delete;

  int CheckOverlap = ANSWER_ERROR;
  int CheckGaps = ANSWER_ERROR;

  struct Internals;
};

#endif
