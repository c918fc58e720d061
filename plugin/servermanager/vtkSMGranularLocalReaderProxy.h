// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularLocalReaderProxy
 * @brief   Shows the rows of contacts and bonds as a table where they are no lines.
 *
 * Made for elements GranularLocalReaderProxy of the server manager's XML.
 */

#ifndef vtkSMGranularLocalReaderProxy_h
#define vtkSMGranularLocalReaderProxy_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkNew.h"                         // For RowsHints
#include "vtkPVXMLElement.h"                // For RowsHints
#include "vtkSMSourceProxy.h"

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularLocalReaderProxy : public vtkSMSourceProxy
{
public:
  static vtkSMGranularLocalReaderProxy* New();
  vtkTypeMacro(vtkSMGranularLocalReaderProxy, vtkSMSourceProxy);

  /**
   * Returns the hints of the XML. Those for views, by which the table opens none, are left out if the file does not place the ends.
   */
  vtkPVXMLElement* GetHints() override;

protected:
  vtkSMGranularLocalReaderProxy() = default;
  ~vtkSMGranularLocalReaderProxy() override = default;

private:
  vtkSMGranularLocalReaderProxy(const vtkSMGranularLocalReaderProxy&) = delete;
  void operator=(const vtkSMGranularLocalReaderProxy&) = delete;

  vtkNew<vtkPVXMLElement> RowsHints;
};

#endif
