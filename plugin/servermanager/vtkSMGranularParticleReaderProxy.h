// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularParticleReaderProxy
 * @brief   Keeps the list of arrays of particle readers up to date.
 *
 * Made for elements GranularParticleReaderProxy of the server manager's XML.
 */

#ifndef vtkSMGranularParticleReaderProxy_h
#define vtkSMGranularParticleReaderProxy_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkSMSourceProxy.h"

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularParticleReaderProxy : public vtkSMSourceProxy
{
public:
  static vtkSMGranularParticleReaderProxy* New();
  vtkTypeMacro(vtkSMGranularParticleReaderProxy, vtkSMSourceProxy);

  /**
   * Chooses anew from the arrays if none that was chosen is there any more: the user has named the
   * columns of a binary file, or opened other files.
   */
  void UpdatePipelineInformation() override;

protected:
  vtkSMGranularParticleReaderProxy() = default;
  ~vtkSMGranularParticleReaderProxy() override = default;

  /**
   * Asks for the arrays that the update has found, as after AtomStyle or ColumnNames has changed.
   */
  void PostUpdateData(bool usingCache) override;

private:
  vtkSMGranularParticleReaderProxy(const vtkSMGranularParticleReaderProxy&) = delete;
  void operator=(const vtkSMGranularParticleReaderProxy&) = delete;
};

#endif
