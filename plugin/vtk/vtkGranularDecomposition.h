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
   * PROCESSOR_GRID, the default: the grid of ProcessorGrid, NumberOfProcesses and the cuts, in the box of the field
   * data, or in Bounds. PROCESS_ARRAY: for each process that the point array ProcessArray names (`proc` of a
   * dump) the bounds of its particles. SUBDOMAINS: the voxels of the second input, such as a
   * decomposition that was read. RANKS: for each process of the Controller, which is to say of ParaView, that has
   * particles now the bounds of these. The results of the first three do not depend on the processes of the Controller.
   */
  vtkSetClampMacro(Mode, int, PROCESSOR_GRID, RANKS);
  vtkGetMacro(Mode, int);
  ///@}

  ///@{
  /**
   * The point array of PROCESS_ARRAY: the rank of the process that owns the particle, a whole number from 0. "proc"
   * by default.
   */
  vtkSetStringMacro(ProcessArray);
  vtkGetStringMacro(ProcessArray);
  ///@}

  /**
   * The voxels of SUBDOMAINS: input port 1. nlocal need not be there, and is not used.
   */
  void SetSubdomainsConnection(vtkAlgorithmOutput* output);

protected:
  vtkGranularDecomposition();
  ~vtkGranularDecomposition() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void Execute(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkGranularDecomposition(const vtkGranularDecomposition&) = delete;
  void operator=(const vtkGranularDecomposition&) = delete;

  class Counter;

  int Mode = PROCESSOR_GRID;
  char* ProcessArray = nullptr;
};

#endif
