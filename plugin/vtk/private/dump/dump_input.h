// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularDumpInput_h
#define vtkGranularDumpInput_h

#include "private/arrays/array_views.h"

#include "granular/common/error.h"
#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkDataSetAttributes;
class vtkFieldData;
class vtkPointSet;

namespace vtkGranularPrivate
{
/**
 * Returns the box in the field data, from BoxOrigin and BoxVectors; exact to the last bit if BoxBounds describe the
 * same box. Nothing if there is none.
 */
std::optional<granular::Box> FindBox(vtkFieldData* data);

/**
 * Returns a box from a corner and the nine numbers of its edges.
 */
granular::Box MakeBox(const double origin[3], const double vectors[9]);

/**
 * Views of the rows of a data set for the core, in place. Arrays with another memory layout than VTK's own are copied;
 * the copies live as long as this object.
 */
class RowsInput
{
public:
  /**
   * Reads the field data; so many rows are read in another way. `rows` names the rows in errors: see ArrayViews.
   */
  explicit RowsInput(vtkDataObject* input, std::int64_t count = 0, const char* rows = "rows");
  virtual ~RowsInput() = default;
  RowsInput(const RowsInput&) = delete;
  void operator=(const RowsInput&) = delete;

  granular::FrameView View;
  bool HasTimestep = false; ///< the field data give the timestep
  bool HasTime = false;     ///< and the time

protected:
  /**
   * Adds all arrays but ghosts to the view. Arrays that cannot be columns, such as variants, are left out with a
   * notice. Throws Error if an array does not have a value for each row.
   */
  void SeeArrays(vtkDataSetAttributes* data, granular::Notices& notices);

  ArrayViews Arrays;

private:
  void ReadFieldData(vtkFieldData* data);
};

/**
 * Views of points, point arrays and field data.
 */
class DumpInput : public RowsInput
{
public:
  /**
   * Throws what SeeArrays throws.
   */
  DumpInput(vtkPointSet* input, granular::Notices& notices);
  explicit DumpInput(vtkPointSet* input, granular::Notices&& unwanted = {})
    : DumpInput(input, unwanted)
  {
  }
};

/**
 * Returns the positions of points that are not particles, such as corners of cells: x y z of each. A subtracted origin
 * is added, and scaled points are multiplied by the box. Unwrapped points are unchanged: particles are unwrapped, cells
 * are not.
 */
std::vector<double> ReadAbsolutePoints(vtkPointSet* input);

/**
 * The particles that filters on several ranks work on.
 */
class Particles : public DumpInput
{
public:
  /**
   * Reads the particles of this rank from a data object; the header of the View is what all ranks share: see
   * granular::share_header. Throws on all ranks if it is not a vtkPointSet, and what DumpInput and share_header throw.
   * Collective.
   */
  Particles(vtkDataObject* input, granular::Communicator& ranks);
};
}

#endif
