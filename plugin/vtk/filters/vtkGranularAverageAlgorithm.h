// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularAverageAlgorithm
 * @brief   Base class of filters that average particles and their contacts.
 *
 * Port 0 has the particles, a vtkPointSet. Ports 1 and 2, both optional, have contacts between particles and contacts with walls:
 * lines or rows as vtkGranularContactSums takes them. Their stress is branch_a force_b over a volume, shared along the line.
 *
 * Positions are absolute, whatever the points are (see the field data of vtkGranularDumpReader: Unwrapped, Scaled, PointOrigin). Ghost
 * duplicates are left out. Particles with a nan or infinite number, or a negative mass or radius, are left out with a warning that
 * counts them. Another warning tells that the reader left out particles by Stride or RegionOfInterest (field data `ParticlesLeftOut`
 * of the input).
 */

#ifndef vtkGranularAverageAlgorithm_h
#define vtkGranularAverageAlgorithm_h

#include "vtkGranularAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <string> // for std::string

class vtkAlgorithmOutput;
class vtkDataArraySelection;

class VTKGRANULAR_EXPORT vtkGranularAverageAlgorithm : public vtkGranularAlgorithm
{
public:
  vtkTypeMacro(vtkGranularAverageAlgorithm, vtkGranularAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum WeightsType
  {
    CENTRE = 0,
    OVERLAP = 1,
    GAUSSIAN = 2,
    LUCY = 3,
    HEAVISIDE = 4
  };

  ///@{
  /**
   * Sets the contacts between particles, and those with walls: input ports 1 and 2, both optional.
   */
  void SetLinesConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  void SetWallsConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(2, output); }
  ///@}

  /**
   * Returns the selection of the arrays that are made. Those that are off cost nothing. v_avg, volumefraction, radius, pressure,
   * sigma and tau are on by default.
   */
  virtual vtkDataArraySelection* GetArraySelection() { return this->ArraySelection; }

  ///@{
  /**
   * Turns an array of GetArraySelection on or off, or all off.
   */
  void SetArrayStatus(const char* name, int status);
  void ClearArrays();
  ///@}

  ///@{
  /**
   * Sets the width w of the kernel [m]: GAUSSIAN is exp(-r^2 / 2 w^2), cut at 3 w; LUCY (1 + 3 q)(1 - q)^3 with q = r / 2 w;
   * HEAVISIDE 1 within w. 0, the default: the largest diameter of the particles.
   */
  vtkSetMacro(KernelWidth, double);
  vtkGetMacro(KernelWidth, double);
  ///@}

  ///@{
  /**
   * Sets the point arrays that are averaged: velocities, three components ("v" by default; without it v_avg is 0, with a
   * warning); masses ("mass"; without it they are made from the array `density` and the radii, or are 1, with a warning);
   * radii ("radius").
   */
  vtkSetStdStringFromCharMacro(VelocityArray);
  vtkGetCharFromStdStringMacro(VelocityArray);
  vtkSetStdStringFromCharMacro(MassArray);
  vtkGetCharFromStdStringMacro(MassArray);
  vtkSetStdStringFromCharMacro(RadiusArray);
  vtkGetCharFromStdStringMacro(RadiusArray);
  ///@}

protected:
  vtkGranularAverageAlgorithm();
  ~vtkGranularAverageAlgorithm() override;

  double KernelWidth = 0;
  std::string VelocityArray = "v";
  std::string MassArray = "mass";
  std::string RadiusArray = "radius";
  vtkDataArraySelection* const ArraySelection;

  class AverageTask; ///< from which the tasks of the filters derive

private:
  vtkGranularAverageAlgorithm(const vtkGranularAverageAlgorithm&) = delete;
  void operator=(const vtkGranularAverageAlgorithm&) = delete;
};

#endif
