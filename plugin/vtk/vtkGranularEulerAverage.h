// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularEulerAverage
 * @brief   Averages particles over the cells of a regular grid.
 *
 * For each cell of volume V, with the share w of each particle in the cell, its mass m, radius r, velocity v and stress times volume S:
 * - `v_avg` = sum w m v / sum w m [m/s]
 * - `volumefraction` = volume of the particles in the cell / V [-]
 * - `radius` = sum w r / sum w [m]
 * - `pressure` = -(xx + yy + zz) / 3 [Pa] of the stress sum(-w m (v - v_avg)(v - v_avg) + w S) / V; with a StressArray also the
 *   stress itself, `sigma` (xx yy zz) and `tau` (xy xz yz). Without a StressArray the pressure contains only the velocity
 *   fluctuations, not the contacts.
 *
 * These are the definitions of fix ave/euler of LIGGGHTS, where w is 1 or 0. Empty cells are 0. Where two particles overlap, their
 * common volume counts twice in volumefraction. Particles with one common velocity have a pressure of 0: the rounding of v_avg does
 * not count as fluctuation. The averages are over space at one moment; see SetTimeAverage. Sums are correctly rounded, so the result
 * is the same, bit for bit, for any order of particles and any number of threads and ranks.
 *
 * Positions are absolute, whatever the points are (see the field data of vtkGranularDumpReader: Unwrapped, Scaled, PointOrigin). The
 * output has the same PointOrigin. Ghost duplicates are left out. Particles that touch no cell, have a nan or infinite number, or a
 * negative mass or radius, are left out with a warning that counts them. Another warning tells that the reader left out particles by
 * Stride or RegionOfInterest (field data `ParticlesLeftOut` of the input).
 */

#ifndef vtkGranularEulerAverage_h
#define vtkGranularEulerAverage_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

class VTKGRANULAR_EXPORT vtkGranularEulerAverage : public vtkGranularAlgorithm
{
public:
  static vtkGranularEulerAverage* New();
  vtkTypeMacro(vtkGranularEulerAverage, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputTypes
  {
    POINTS = 0,
    IMAGE_DATA = 1
  };

  enum CellsByType
  {
    COUNTS = 0,
    SIZE = 1,
    RELATIVE_SIZE = 2
  };

  enum WeightsType
  {
    CENTRE = 0,
    OVERLAP = 1
  };

  enum PeriodicType
  {
    BOUNDARY = 0,
    NONE = 1
  };

  ///@{
  /**
   * Sets the type of the output. IMAGE_DATA, the default: vtkImageData with cell data; each rank has an extent. POINTS:
   * vtkPolyData with a vertex at the centre of each cell and point data, as LIGGGHTS writes it.
   */
  vtkSetClampMacro(OutputType, int, POINTS, IMAGE_DATA);
  vtkGetMacro(OutputType, int);
  ///@}

  ///@{
  /**
   * What cells there are, by what CellsBy says.
   * COUNTS, the default: CellCounts, how many along x, y and z, 1 and more; 10 10 10 by default.
   * SIZE: CellSize, the least edges along x, y and z [m], above 0: as many cells as fit fill the bounds, and are as large
   * as that or larger. For IMAGE_DATA the Bounds must be given. 0.01 0.01 0.01 by default.
   * RELATIVE_SIZE: CellSizeRelative, the least edge in units of the largest diameter, above 0: cell_size_relative of fix
   * ave/euler, where LIGGGHTS' granular pair styles cut off at that distance. For POINTS only. 3 by default, as there.
   */
  vtkSetClampMacro(CellsBy, int, COUNTS, RELATIVE_SIZE);
  vtkGetMacro(CellsBy, int);
  vtkSetVector3Macro(CellCounts, int);
  vtkGetVector3Macro(CellCounts, int);
  vtkSetVector3Macro(CellSize, double);
  vtkGetVector3Macro(CellSize, double);
  vtkSetMacro(CellSizeRelative, double);
  vtkGetMacro(CellSizeRelative, double);
  ///@}

  ///@{
  /**
   * Sets the box that is divided: xlo xhi ylo yhi zlo zhi. An axis with lo above hi, the default for all, uses the box in
   * the field data of the input; of a tilted box its smallest bounds.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * To which cells a particle belongs. OVERLAP, the default: to each, by the volume of the sphere in it. CENTRE: to that of
   * its centre, whole, as in LIGGGHTS: quick, but the volume fraction may exceed 1, and jumps when particles pass faces.
   * Periodic: BOUNDARY, the default: along axes that the flags of the input's box say to be periodic (`pp`) particles have
   * images, and what sticks out of a face comes in at the opposite one. NONE: particles are where they are.
   */
  vtkSetClampMacro(Weights, int, CENTRE, OVERLAP);
  vtkGetMacro(Weights, int);
  vtkSetClampMacro(Periodic, int, BOUNDARY, NONE);
  vtkGetMacro(Periodic, int);
  ///@}

  ///@{
  /**
   * The point arrays that are averaged: velocities, three components ("v" by default; without it v_avg is 0, with a
   * warning); masses ("mass"; without it they are made from the array `density` and the radii, or are 1, with a warning);
   * radii ("radius"; OVERLAP needs them, CENTRE warns); and the stress of particles times their volume, six components xx
   * yy zz xy xz yz as `compute stress/atom` gives them, which becomes the array c_ID of dumps (none by default).
   */
  vtkSetStringMacro(VelocityArray);
  vtkGetStringMacro(VelocityArray);
  vtkSetStringMacro(MassArray);
  vtkGetStringMacro(MassArray);
  vtkSetStringMacro(RadiusArray);
  vtkGetStringMacro(RadiusArray);
  vtkSetStringMacro(StressArray);
  vtkGetStringMacro(StressArray);
  ///@}

  ///@{
  /**
   * On: the average over all timesteps of the input: the sums above are over the particles of all of them, and V is the
   * volume of the cell times the number of timesteps, including those in which it is empty. v_avg is that of all
   * timesteps, so stress and pressure contain the changes of a cell's mean velocity over time. The output then has no
   * time; cells must not change with time. Off by default.
   */
  vtkSetMacro(TimeAverage, bool);
  vtkGetMacro(TimeAverage, bool);
  ///@}

protected:
  vtkGranularEulerAverage();
  ~vtkGranularEulerAverage() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularEulerAverage(const vtkGranularEulerAverage&) = delete;
  void operator=(const vtkGranularEulerAverage&) = delete;

  class Averager;

  int OutputType = IMAGE_DATA;
  int CellsBy = COUNTS;
  int CellCounts[3] = { 10, 10, 10 };
  double CellSize[3] = { 0.01, 0.01, 0.01 };
  double CellSizeRelative = 3;
  double Bounds[6] = { 1, -1, 1, -1, 1, -1 };
  int Weights = OVERLAP;
  int Periodic = BOUNDARY;
  char* VelocityArray = nullptr;
  char* MassArray = nullptr;
  char* RadiusArray = nullptr;
  char* StressArray = nullptr;
  bool TimeAverage = false;
};

#endif
