// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularEulerAverage
 * @brief   Averages particles over the cells of a regular grid.
 *
 * For each cell of volume V, with the share w of each particle in the cell, its mass m, radius r, velocity v and stress times volume S:
 * - `v_avg` = sum w m v / sum w m [m/s]
 * - `volumefraction` = volume of the particles in the cell / V [-]
 * - `radius` = sum w r / sum w [m]
 * - `pressure` = -(xx + yy + zz) / 3 [Pa] of the stress sum(-w m (v - v_avg)(v - v_avg) + w S) / V; with a StressArray or
 *   contacts also the stress itself, `sigma` (xx yy zz) and `tau` (xy xz yz). Without them the pressure contains only the velocity
 *   fluctuations.
 *
 * Selected arrays besides (see GetArraySelection): `density` = sum w m / V, `momentum` = sum w m v / V, `granular_temperature` =
 * sum w m |v - v_avg|^2 / (3 sum w m) [m2/s2].
 *
 * With contacts (ports 1 and 2) the stress, and with it pressure, sigma and tau,
 * contain their part: branch_a force_b / V, shared among the cells along the line, by its length in each. `sigma_kinetic`,
 * `tau_kinetic`, `sigma_contact`, `tau_contact`: both parts; `coordination`: ends of contacts over particles, both by their parts
 * in the cell; `fabric`: mean product of contact normals, xx yy zz xy xz yz.
 *
 * With a smoothing kernel (see SetWeights), w is its value at the centre of the cell over the sum of its values at the centres of
 * all cells, also beyond the grid: mass and momentum of what is inside stay. Contacts get the mean of the kernel along the line in
 * place of the length. Along an axis with one cell nothing is smoothed.
 *
 * These are the definitions of fix ave/euler of LIGGGHTS, where w is 1 or 0. Empty cells are 0. Where two particles overlap, their
 * common volume counts twice in volumefraction. Particles with one common velocity have a pressure of 0: the rounding of v_avg does
 * not count as fluctuation. The averages are over space at one moment; see SetTimeAverage. Sums are correctly rounded, so the result
 * is the same, bit for bit, for any order of particles and any number of threads and ranks.
 *
 * The output has the PointOrigin of the input. Particles that touch no cell are counted in a warning.
 */

#ifndef vtkGranularEulerAverage_h
#define vtkGranularEulerAverage_h

#include "vtkGranularAverageAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <array>   // for std::array
#include <cstdint> // for std::int64_t
#include <string>  // for std::string

class VTKGRANULAR_EXPORT vtkGranularEulerAverage : public vtkGranularAverageAlgorithm
{
public:
  static vtkGranularEulerAverage* New();
  vtkTypeMacro(vtkGranularEulerAverage, vtkGranularAverageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputTypes
  {
    POINTS = 0,
    IMAGE_DATA = 1,
    PROFILE = 2
  };

  enum CellsByType
  {
    COUNTS = 0,
    SIZE = 1,
    RELATIVE_SIZE = 2
  };

  enum KernelBoundsType
  {
    ALL_SPACE = 0,
    INSIDE = 1
  };

  enum PeriodicType
  {
    BOUNDARY = 0,
    NONE = 1
  };

  ///@{
  /**
   * Sets the type of the output. IMAGE_DATA, the default: vtkImageData with cell data; each rank has an extent. POINTS:
   * vtkPolyData with a vertex at the centre of each cell and point data, as LIGGGHTS writes it. PROFILE: vtkTable with a row for
   * each layer of cells along ProfileAxis (0, 1 or 2; 2 by default), of which the other axes have one cell each, and the
   * `position` of its centre along the axis; see SetCellsBy for the number of layers.
   */
  vtkGranularSetRangeMacro(OutputType, int, POINTS, PROFILE);
  vtkGetMacro(OutputType, int);
  vtkGranularSetRangeMacro(ProfileAxis, int, 0, 2);
  vtkGetMacro(ProfileAxis, int);
  ///@}

  ///@{
  /**
   * Sets the meaning of the numbers that choose the cells.
   * COUNTS, the default: CellCounts, how many along x, y and z, 1 and more; 10 10 10 by default.
   * SIZE: CellSize, the least edges along x, y and z [m], above 0: as many cells as fit fill the bounds, and are as large
   * as that or larger. 0.01 0.01 0.01 by default.
   * RELATIVE_SIZE: CellSizeRelative, the least edge in units of the largest diameter, above 0: cell_size_relative of fix
   * ave/euler, where LIGGGHTS' granular pair styles cut off at that distance. 3 by default, as there.
   * IMAGE_DATA has as many cells at all times: where the box and the largest diameter decide, those of the last time.
   */
  vtkGranularSetRangeMacro(CellsBy, int, COUNTS, RELATIVE_SIZE);
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
   * Sets the box that is divided: xlo xhi ylo yhi zlo zhi. An axis of 0 0, or with lo above hi, the default for all, uses the box in
   * the field data of the input; of a tilted box its smallest bounds.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * To which cells a particle belongs. OVERLAP, the default: to each, by the volume of the sphere in it. CENTRE: to that of
   * its centre, whole, as in LIGGGHTS: quick, but the volume fraction may exceed 1, and jumps when particles pass faces.
   * GAUSSIAN, LUCY, HEAVISIDE: to each, by a smoothing kernel around its centre, of the KernelWidth.
   * Periodic: BOUNDARY, the default: along axes that the flags of the input's box say to be periodic (`pp`) particles have
   * images, and what sticks out of a face comes in at the opposite one. NONE: particles are where they are.
   */
  vtkGranularSetRangeMacro(Weights, int, CENTRE, HEAVISIDE);
  vtkGetMacro(Weights, int);
  vtkGranularSetRangeMacro(Periodic, int, BOUNDARY, NONE);
  vtkGetMacro(Periodic, int);
  ///@}

  ///@{
  /**
   * Sets what happens at faces of the grid, with a kernel. ALL_SPACE, the default: a kernel that reaches beyond the cells loses what is there. INSIDE: along axes that are
   * not periodic it ends at the faces of the grid, and each particle inside belongs to the cells as a whole; for walls there.
   */
  vtkGranularSetRangeMacro(KernelBounds, int, ALL_SPACE, INSIDE);
  vtkGetMacro(KernelBounds, int);
  ///@}

  ///@{
  /**
   * Sets the point array of the stress of particles times their volume, six components xx yy zz xy xz yz as `compute stress/atom`
   * gives them, which becomes the array c_ID of dumps; none by default. Not together with contacts, which would count twice.
   */
  vtkSetStdStringFromCharMacro(StressArray);
  vtkGetCharFromStdStringMacro(StressArray);
  ///@}

  ///@{
  /**
   * On: the average over all timesteps of the input: the sums above are over the particles of all of them, and V is the
   * volume of the cell times the number of timesteps, including those in which it is empty. v_avg is that of all
   * timesteps, so stress and pressure contain the changes of a cell's mean velocity over time. The output then has no
   * time; cells must not change with time. Off by default.
   * TimeWindow: the first and last time; (1, -1), the default, or any others with first > last: all.
   */
  vtkSetMacro(TimeAverage, bool);
  vtkGetMacro(TimeAverage, bool);
  vtkSetVector2Macro(TimeWindow, double);
  vtkGetVector2Macro(TimeWindow, double);
  ///@}

protected:
  vtkGranularEulerAverage() = default;
  ~vtkGranularEulerAverage() override = default;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularEulerAverage(const vtkGranularEulerAverage&) = delete;
  void operator=(const vtkGranularEulerAverage&) = delete;

  class Task;

  int OutputType = IMAGE_DATA;
  int CellsBy = COUNTS;
  int CellCounts[3] = { 10, 10, 10 };
  double CellSize[3] = { 0.01, 0.01, 0.01 };
  double CellSizeRelative = 3;
  double Bounds[6] = { 1, -1, 1, -1, 1, -1 };
  int ProfileAxis = 2;
  int Weights = OVERLAP;
  int KernelBounds = ALL_SPACE;
  int Periodic = BOUNDARY;
  std::string StressArray;
  bool TimeAverage = false;
  double TimeWindow[2] = { 1, -1 };
  std::array<std::int64_t, 3> Counts = {}; ///< of an image
};

#endif
