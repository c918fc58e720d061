// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularEulerReader
 * @brief   Reads cells: files of `dump euler/vtk`, and of `dump grid` of LAMMPS.
 *
 * LIGGGHTS writes legacy VTK text with a point for each cell of fix ave/euler. Point arrays: `v_avg`, the mass-weighted velocity [m/s],
 * `volumefraction` of solids, `radius`, the mean [m], and `pressure` [Pa]. Its fork PFM also writes `sigma` (xx yy zz) and `tau` (xy xz
 * yz), and grids with the arrays in the cells. Legacy files that VTK made of these are read, too. Numbers are doubles; nan and
 * infinities are accepted. LIGGGHTS before 3.2.1 divided velocities a second time by the number of particles in the cell; the file
 * does not tell.
 *
 * `dump grid` writes a text like other dumps, a row for each cell, which divide the box evenly; granular::read_grid says in which order.
 * Its frames have timesteps, times and names of arrays as other dumps have them. Cells of a tilted box can be shown as points alone.
 *
 * The timestep of `dump euler/vtk` is the last number in the file name that differs between the files. If several files have one timestep, the last file
 * counts, unless SetRepeatedSteps declares them pieces. vtkGranularSeriesReader tells which frames there are, and their times.
 *
 * GetPointDataArraySelection has the arrays of the first frame that has cells: all on. Arrays of other frames are read unless they
 * are off here.
 *
 * The output has one point for each cell (vtkPolyData), or the cells themselves: see SetOutputType. Field data: the smallest box
 * around all points or cells as BoxOrigin, BoxVectors and BoxBounds, and `timestep`. A frame without cells gives an empty output of
 * the same type.
 */

#ifndef vtkGranularEulerReader_h
#define vtkGranularEulerReader_h

#include "vtkGranularModule.h" // For export macro
#include "vtkGranularSeriesReader.h"

class VTKGRANULAR_EXPORT vtkGranularEulerReader : public vtkGranularSeriesReader
{
public:
  static vtkGranularEulerReader* New();
  vtkTypeMacro(vtkGranularEulerReader, vtkGranularSeriesReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputTypes
  {
    POINTS = 0,
    IMAGE_DATA = 1
  };

  ///@{
  /**
   * POINTS, the default: vtkPolyData, a vertex at the centre of each cell, in the order of the file; ranks have equal shares.
   * IMAGE_DATA: the cells, with cell arrays. If they form one regular grid, vtkImageData, of which each rank has the
   * extent that the pipeline asks for. If each process of the simulation had a grid of its own (`parallel yes` of
   * fix ave/euler), vtkPartitionedDataSet with a vtkImageData for each, of which ranks have equal shares: the partitions of others are null. Cells that form no
   * regular grids are an error. The first frame that has cells decides for all: where it is one grid, others must be one
   * with as many cells along each axis.
   */
  vtkGranularSetRangeMacro(OutputType, int, POINTS, IMAGE_DATA);
  vtkGetMacro(OutputType, int);
  ///@}

  /**
   * Returns 1 if the contents of the file are those of dump euler/vtk, and 0 for other .vtk files. Never fails.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkGranularEulerReader();
  ~vtkGranularEulerReader() override = default;

  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularEulerReader(const vtkGranularEulerReader&) = delete;
  void operator=(const vtkGranularEulerReader&) = delete;

  int OutputType = POINTS;

  struct Internals;
};

#endif
