// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularContactsRepresentation
 * @brief   Lines of contacts and bonds, as ParaView's Surface draws them.
 *
 * A frame without lines, on any rank, has the bounds of its simulation box, as in vtkGranularGrainsRepresentation.
 */

#ifndef vtkGranularContactsRepresentation_h
#define vtkGranularContactsRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkGranularViewsModule.h" // For export macro

class VTKGRANULARVIEWS_EXPORT vtkGranularContactsRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkGranularContactsRepresentation* New();
  vtkTypeMacro(vtkGranularContactsRepresentation, vtkGeometryRepresentationWithFaces);

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

protected:
  vtkGranularContactsRepresentation() = default;
  ~vtkGranularContactsRepresentation() override = default;

private:
  vtkGranularContactsRepresentation(const vtkGranularContactsRepresentation&) = delete;
  void operator=(const vtkGranularContactsRepresentation&) = delete;
};

#endif
