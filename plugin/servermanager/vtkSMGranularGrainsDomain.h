// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularGrainsDomain
 * @brief   Makes particles come up as Grains.
 *
 * The readers' hints tell ParaView to show particles as Grains, and what filters make of them it shows as a surface: specks where
 * particles are. This domain, of a property that representations have for it, sets their property Representation to Grains when they are
 * made for data that still are particles: points of particles, as the field data of the readers tell (`Coordinates` and `PointOrigin`),
 * with radii or shapes, and with as many cells as points, or none; and so must be all data between the reader and these.
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the property Representation of the proxy. The given property stays as it is.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMGranularGrainsDomain();
  ~vtkSMGranularGrainsDomain() override;

private:
  vtkSMGranularGrainsDomain(const vtkSMGranularGrainsDomain&) = delete;
  void operator=(const vtkSMGranularGrainsDomain&) = delete;
};

#endif
