// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularParticleReaderProxy
 * @brief   Suggests the representation Grains only where it fits.
 *
 * Grains draws the radii of the point array `radius` in the unit of the points. Where that array is
 * not among those to be read, and where the points are scaled coordinates, GetHints() leaves the
 * suggestion out, and ParaView chooses a representation as for any other points.
 *
 * Made for elements GranularParticleReaderProxy of the server manager's XML.
 */

#ifndef vtkSMGranularParticleReaderProxy_h
#define vtkSMGranularParticleReaderProxy_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularParticleReaderProxy : public vtkSMSourceProxy
{
public:
  static vtkSMGranularParticleReaderProxy* New();
  vtkTypeMacro(vtkSMGranularParticleReaderProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The hints of the XML; without those for Grains where that does not fit what was read last.
   */
  vtkPVXMLElement* GetHints() override;

  /**
   * Chooses anew from the arrays if none that was chosen is there any more: the user has named the
   * columns of a binary file, or opened other files.
   */
  void UpdatePipelineInformation() override;

protected:
  vtkSMGranularParticleReaderProxy();
  ~vtkSMGranularParticleReaderProxy() override;

  /**
   * Asks for the arrays and what is chosen of them, too: GetHints() speaks of what was read last.
   */
  void PostUpdateData(bool usingCache) override;

private:
  vtkSMGranularParticleReaderProxy(const vtkSMGranularParticleReaderProxy&) = delete;
  void operator=(const vtkSMGranularParticleReaderProxy&) = delete;

  bool HasRadii();

  vtkSmartPointer<vtkPVXMLElement> HintsWithoutGrains;
};

#endif
