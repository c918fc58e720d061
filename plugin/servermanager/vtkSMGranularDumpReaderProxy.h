// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularDumpReaderProxy
 * @brief   Suggests the representation Grains only where it fits.
 *
 * Grains draws the radii of the point array `radius` in the unit of the points. Where that array is
 * not among those to be read, and where the points are scaled coordinates, GetHints() leaves the
 * suggestion out, and ParaView chooses a representation as for any other points.
 *
 * Made for elements GranularDumpReaderProxy of the server manager's XML.
 */

#ifndef vtkSMGranularDumpReaderProxy_h
#define vtkSMGranularDumpReaderProxy_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularDumpReaderProxy : public vtkSMSourceProxy
{
public:
  static vtkSMGranularDumpReaderProxy* New();
  vtkTypeMacro(vtkSMGranularDumpReaderProxy, vtkSMSourceProxy);
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
  vtkSMGranularDumpReaderProxy();
  ~vtkSMGranularDumpReaderProxy() override;

  /**
   * Asks for the arrays and what is chosen of them, too: GetHints() speaks of what was read last.
   */
  void PostUpdateData(bool usingCache) override;

private:
  vtkSMGranularDumpReaderProxy(const vtkSMGranularDumpReaderProxy&) = delete;
  void operator=(const vtkSMGranularDumpReaderProxy&) = delete;

  bool HasRadii();

  vtkSmartPointer<vtkPVXMLElement> HintsWithoutGrains;
};

#endif
