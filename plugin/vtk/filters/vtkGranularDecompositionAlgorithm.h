// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDecompositionAlgorithm
 * @brief   Base class of the source and the filter of decompositions: a grid of ranks, and voxels.
 *
 * The output holds a VTK_VOXEL for each subdomain, with the cell arrays `nlocal` (number of particles, vtkTypeInt64Array; the scalars)
 * and `proc` (the rank, vtkTypeInt32Array). Points are double. Point 8p + 4i + 2j + k is the corner (i, j, k) of subdomain p, each 0
 * (low) or 1 (high) along x, y, z; cell p has the points 8p + {0, 4, 2, 6, 1, 5, 3, 7}.
 *
 * A pipeline may ask for any piece of any number. The pieces hold equal numbers of subdomains, in their order.
 */

#ifndef vtkGranularDecompositionAlgorithm_h
#define vtkGranularDecompositionAlgorithm_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <vector> // for std::vector

class vtkUnstructuredGrid;

namespace granular
{
struct GridRequest;
}

class VTKGRANULAR_EXPORT vtkGranularDecompositionAlgorithm : public vtkGranularAlgorithm
{
public:
  vtkTypeMacro(vtkGranularDecompositionAlgorithm, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns the subdomains.
   */
  vtkUnstructuredGrid* GetOutput();

  ///@{
  /**
   * Sets the box that is divided, xlo xhi ylo yhi zlo zhi, in the simulation's unit of length. For the source: finite, lo
   * <= hi, (0, 1, 0, 1, 0, 1) by default. For the filter: an axis of 0 0, or with lo > hi, uses the box in the field data of
   * the input; (1, -1, 1, -1, 1, -1) by default.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Sets the total number of ranks, which must be px py pz of ProcessorGrid. 0, the default: as many as the grid has.
   */
  vtkSetMacro(NumberOfProcesses, int);
  vtkGetMacro(NumberOfProcesses, int);
  ///@}

  ///@{
  /**
   * Sets the numbers of ranks along x, y and z, px py pz; (1, 1, 1) by default. A 0 stands for the `*` of the command
   * `processors`: the number follows from the cuts, or is chosen for the smallest area between subdomains. Rank (i py + j)
   * pz + k has the i-th subdomain along x, the j-th along y and the k-th along z, as in LIGGGHTS and LAMMPS.
   */
  vtkSetVector3Macro(ProcessorGrid, int);
  vtkGetVector3Macro(ProcessorGrid, int);
  ///@}

  ///@{
  /**
   * Adds a cut along an axis: p - 1 positions inside the bounds, ascending. None, the default: equal parts.
   */
  void AddXCut(double position) { this->AddCut(0, position); }
  void AddYCut(double position) { this->AddCut(1, position); }
  void AddZCut(double position) { this->AddCut(2, position); }
  void ClearXCuts() { this->ClearCuts(0); }
  void ClearYCuts() { this->ClearCuts(1); }
  void ClearZCuts() { this->ClearCuts(2); }
  int GetNumberOfCuts(int axis);
  ///@}

protected:
  vtkGranularDecompositionAlgorithm() = default;
  ~vtkGranularDecompositionAlgorithm() override = default;

  /**
   * Returns the grid that the properties describe, without its bounds.
   */
  granular::GridRequest DescribeGrid() const;

  double Bounds[6] = { 0, 1, 0, 1, 0, 1 };
  int NumberOfProcesses = 0;
  int ProcessorGrid[3] = { 1, 1, 1 };
  std::vector<double> Cuts[3];

private:
  vtkGranularDecompositionAlgorithm(const vtkGranularDecompositionAlgorithm&) = delete;
  void operator=(const vtkGranularDecompositionAlgorithm&) = delete;

  void AddCut(int axis, double position);
  void ClearCuts(int axis);
};

#endif
