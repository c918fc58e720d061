// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularPointAverage
 * @brief   Averages particles and their contacts at the points of a data set, by a smoothing kernel.
 *
 * Port 3 has the data set; the output is a copy of it, with point arrays. With the value k of the kernel, which depends on the distance
 * of particle and point, over its integral over all space, and the mass m, radius r, velocity v of each particle:
 * - `v_avg` = sum k m v / sum k m [m/s], `density` = sum k m, `momentum` = sum k m v, `volumefraction` = sum k volume, `radius` =
 *   sum k r / sum k
 * - `sigma` and `tau`, with contacts: -sum k m (v - v_avg)(v - v_avg) + sum K branch_a force_b, with the mean K of k over the line;
 *   `pressure` = -(xx + yy + zz) / 3; both parts, granular_temperature, coordination and fabric as in vtkGranularEulerAverage
 *
 * Particles have images along periodic axes, but not in a general triclinic box. Sums are correctly rounded: the results are the same for any
 * order of particles, threads and ranks. Each rank has its own points; particles may be on any.
 */

#ifndef vtkGranularPointAverage_h
#define vtkGranularPointAverage_h

#include "vtkGranularAverageAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

class VTKGRANULAR_EXPORT vtkGranularPointAverage : public vtkGranularAverageAlgorithm
{
public:
  static vtkGranularPointAverage* New();
  vtkTypeMacro(vtkGranularPointAverage, vtkGranularAverageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the data set: input port 3. Its points are where they are shown: the PointOrigin of the particles is added.
   */
  void SetPointsConnection(vtkAlgorithmOutput* output)
  {
    this->SetInputConnection(POINTS_PORT, output);
  }

  ///@{
  /**
   * Sets the shape of the kernel: GAUSSIAN, the default, LUCY or HEAVISIDE; see SetKernelWidth.
   */
  vtkGranularSetRangeMacro(Kernel, int, GAUSSIAN, HEAVISIDE);
  vtkGetMacro(Kernel, int);
  ///@}

protected:
  vtkGranularPointAverage();
  ~vtkGranularPointAverage() override = default;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkGranularPointAverage(const vtkGranularPointAverage&) = delete;
  void operator=(const vtkGranularPointAverage&) = delete;

  class Task;

  static constexpr int POINTS_PORT = 3;

  int Kernel = GAUSSIAN;
};

#endif
