// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMGranularChartDomain
 * @brief   Makes charts of tables begin with what they are made for.
 *
 * ParaView's charts begin with all columns against the number of the row. A filter's hint in the XML tells better ones:
 *
 *   <Chart x="time" show="^position .*_Z$" hide="^(timestep|position .*)$"/>
 *
 * x: the column of the axis. show and hide: regular expressions of names of series; ParaView decides on others. otherwise: those that are
 * shown if no other is. label: a text for the series that show finds, instead of its name.
 *
 * Made for elements GranularChartDomain of the server manager's XML, of a property that charts have for it; the property Input is required.
 */

#ifndef vtkSMGranularChartDomain_h
#define vtkSMGranularChartDomain_h

#include "vtkGranularServerManagerModule.h" // For export macro
#include "vtkSMDomain.h"

class VTKGRANULARSERVERMANAGER_EXPORT vtkSMGranularChartDomain : public vtkSMDomain
{
public:
  static vtkSMGranularChartDomain* New();
  vtkTypeMacro(vtkSMGranularChartDomain, vtkSMDomain);

  /**
   * Sets other properties of the proxy. The given property stays as it is.
   */
  int SetDefaultValues(vtkSMProperty* property, bool useUncheckedValues) override;

protected:
  vtkSMGranularChartDomain() = default;
  ~vtkSMGranularChartDomain() override = default;

private:
  vtkSMGranularChartDomain(const vtkSMGranularChartDomain&) = delete;
  void operator=(const vtkSMGranularChartDomain&) = delete;
};

#endif
