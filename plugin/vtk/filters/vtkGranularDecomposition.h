// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDecomposition
 * @brief   Counts the particles in the subdomains of a simulation's ranks and shows the subdomains as voxels.
 *
 * SetMode chooses the subdomains. Each particle counts once: it belongs to the subdomain with lo <= x < hi along each axis, and x <= hi
 * at the upper end of the box. Particles beyond periodic faces count where their images in the box are, on the same side of every face
 * as the exact image. A warning counts the particles outside all subdomains. Ghost duplicates are left out.
 *
 * Positions are absolute, whatever the points are (see the field data of vtkGranularDumpReader: Unwrapped, Scaled, PointOrigin). The
 * voxels are where the points are: scaled with scaled points, and relative to the same origin.
 *
 * Field data: those of the input; `imbalance`, the largest number of particles of a rank divided by the mean; and `outside`, the
 * number of particles outside all subdomains.
 */

#ifndef vtkGranularDecomposition_h
#define vtkGranularDecomposition_h

#include "vtkGranularDecompositionAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <string> // for std::string

class VTKGRANULAR_EXPORT vtkGranularDecomposition : public vtkGranularDecompositionAlgorithm
{
public:
  static vtkGranularDecomposition* New();
  vtkTypeMacro(vtkGranularDecomposition, vtkGranularDecompositionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ModeType
  {
    PROCESSOR_GRID = 0,
    PROCESS_ARRAY = 1,
    SUBDOMAINS = 2,
    RANKS = 3
  };

  ///@{
  /**
   * Sets which subdomains are used. PROCESSOR_GRID, the default: the grid of ProcessorGrid, NumberOfProcesses and the
   * cuts, in the box of the field data, or in Bounds. PROCESS_ARRAY: the bounds of the particles of each rank in the point
   * array ProcessArray (`proc` of a dump). SUBDOMAINS: the voxels of the second input, such as a decomposition file.
   * RANKS: the bounds of the particles that each rank of the Controller (of ParaView) holds now, if any; a warning tells which
   * overlap. The first three do not depend on the ranks of the Controller.
   */
  vtkGranularSetRangeMacro(Mode, int, PROCESSOR_GRID, RANKS);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * Sets the point array for PROCESS_ARRAY: the rank that owns each particle, integers from 0. "proc" by default.
   */
  vtkSetStdStringFromCharMacro(ProcessArray);
  vtkGetCharFromStdStringMacro(ProcessArray);
  ///@}

  /**
   * Sets the voxels for SUBDOMAINS: input port 1. Their nlocal is not used.
   */
  void SetSubdomainsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }

protected:
  vtkGranularDecomposition();
  ~vtkGranularDecomposition() override = default;

  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void Execute(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkGranularDecomposition(const vtkGranularDecomposition&) = delete;
  void operator=(const vtkGranularDecomposition&) = delete;

  class Task;

  int Mode = PROCESSOR_GRID;
  std::string ProcessArray = "proc";
};

#endif
