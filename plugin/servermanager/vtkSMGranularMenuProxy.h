// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularMenuProxy
 * @brief   Has another name in menus than in scripts.
 *
 * ParaView makes the functions of Python, and traces, of a proxy's label. Menus and the search for filters take the label, too, but that of
 * the prototype, which they find by the name of the proxy. The label of the prototype here is the text of the hint ShowInMenu:
 *
 *   <ShowInMenu category="Granular" text="Paths of particles (trajectories)"/>
 *
 * Made for elements GranularMenuProxy of the server manager's XML.
 */

#ifndef vtkSMGranularMenuProxy_h
#define vtkSMGranularMenuProxy_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkSMSourceProxy.h"

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularMenuProxy : public vtkSMSourceProxy
{
public:
  static vtkSMGranularMenuProxy* New();
  vtkTypeMacro(vtkSMGranularMenuProxy, vtkSMSourceProxy);

  /**
   * Takes the label for menus, if this becomes the prototype.
   */
  void SetPrototype(bool isPrototype) override;

protected:
  vtkSMGranularMenuProxy() = default;
  ~vtkSMGranularMenuProxy() override = default;

private:
  vtkSMGranularMenuProxy(const vtkSMGranularMenuProxy&) = delete;
  void operator=(const vtkSMGranularMenuProxy&) = delete;
};

#endif
