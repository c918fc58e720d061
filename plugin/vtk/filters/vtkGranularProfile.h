// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularProfile
 * @brief   Averages particles over layers along an axis.
 *
 * vtkGranularEulerAverage with the output PROFILE: a vtkTable with a row for each layer, the `position` of its centre along the axis, and the
 * averages. SetOutputType is not for this class.
 */

#ifndef vtkGranularProfile_h
#define vtkGranularProfile_h

#include "vtkGranularEulerAverage.h"
#include "vtkGranularModule.h" // For export macro

class VTKGRANULAR_EXPORT vtkGranularProfile : public vtkGranularEulerAverage
{
public:
  static vtkGranularProfile* New();
  vtkTypeMacro(vtkGranularProfile, vtkGranularEulerAverage);

  /**
   * Sets the number of layers, which counts while the thickness is 0: CellCounts. 20 by default.
   */
  void SetLayers(int layers);

  /**
   * Sets the least thickness of layers [m]: CellSize, and CellsBy SIZE. 0: the number of layers counts.
   */
  void SetThickness(double thickness);

protected:
  vtkGranularProfile();
  ~vtkGranularProfile() override = default;

private:
  vtkGranularProfile(const vtkGranularProfile&) = delete;
  void operator=(const vtkGranularProfile&) = delete;
};

#endif
