// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularDecompositionSource
 * @brief   Makes the subdomains of a grid of ranks in a box, as voxels, without a file.
 *
 * `nlocal` is 0, because there are no particles; vtkGranularDecomposition counts some. The field data are those of a dump in the same
 * box, without a timestep.
 */

#ifndef vtkGranularDecompositionSource_h
#define vtkGranularDecompositionSource_h

#include "vtkGranularDecompositionAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

class VTKGRANULAR_EXPORT vtkGranularDecompositionSource : public vtkGranularDecompositionAlgorithm
{
public:
  static vtkGranularDecompositionSource* New();
  vtkTypeMacro(vtkGranularDecompositionSource, vtkGranularDecompositionAlgorithm);

protected:
  vtkGranularDecompositionSource();
  ~vtkGranularDecompositionSource() override = default;

  void Execute(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkGranularDecompositionSource(const vtkGranularDecompositionSource&) = delete;
  void operator=(const vtkGranularDecompositionSource&) = delete;

  class Task;
};

#endif
