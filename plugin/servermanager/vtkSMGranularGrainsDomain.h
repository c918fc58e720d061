// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularGrainsDomain
 * @brief   Makes particles come up as Grains.
 *
 * The readers' hints tell ParaView to show particles as Grains. Without this domain, ParaView shows a filter's output as a surface: specks
 * where particles are. The domain belongs to a property that representations have for it. It sets their property Representation to Grains
 * when they are made for particles: data with the field data `Coordinates` and `PointOrigin` of the readers and as many cells as points,
 * and so must be all data between the reader and these. Data without cells are particles if the reader or one of some filters made them.
 * The window then hides the particles that the filter was given.
 *
 * Hints of our own sources for their outputs are followed here, too: ParaView does so later, when it has taken the colours from
 * images, which it would show as outlines.
 *
 * Made for elements GranularGrainsDomain of the server manager's XML; the property Input is required.
 */

#ifndef vtkSMGranularGrainsDomain_h
#define vtkSMGranularGrainsDomain_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkSMDomain.h"

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularGrainsDomain : public vtkSMDomain
{
public:
  static vtkSMGranularGrainsDomain* New();
  vtkTypeMacro(vtkSMGranularGrainsDomain, vtkSMDomain);

  /**
   * Sets the property Representation of the proxy. The given property stays as it is.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMGranularGrainsDomain() = default;
  ~vtkSMGranularGrainsDomain() override = default;

private:
  vtkSMGranularGrainsDomain(const vtkSMGranularGrainsDomain&) = delete;
  void operator=(const vtkSMGranularGrainsDomain&) = delete;
};

#endif
