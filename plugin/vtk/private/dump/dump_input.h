// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularDumpInput_h
#define vtkGranularDumpInput_h

#include "private/arrays/array_views.h"

#include "granular/common/error.h"
#include "granular/geometry/box.h"
#include "granular/particles/frame_view.h"

#include <optional>
#include <vector>

class vtkDataObject;
class vtkDataSetAttributes;
class vtkFieldData;
class vtkPointSet;

namespace vtkGranularPrivate
{
/**
 * The box that field data speak of: BoxOrigin and BoxVectors, to the last bit where BoxBounds are those of the
 * same box. Nothing where there is none.
 */
std::optional<granular::Box> FindBox(vtkFieldData* data);

/**
 * A box from a corner and nine numbers of its edges.
 */
granular::Box MakeBox(const double origin[3], const double vectors[9]);

/**
 * What the core sees of the rows of a data set, where they are. Arrays whose memory is not laid out as VTK's own are
 * copied, and kept until this is gone.
 */
class RowsInput
{
public:
  virtual ~RowsInput() = default;
  RowsInput(const RowsInput&) = delete;
  void operator=(const RowsInput&) = delete;

  granular::FrameView View;
  bool HasTimestep = false; ///< the field data give the timestep
  bool HasTime = false;     ///< and the time

protected:
  /**
   * Reads the field data. What rows are is named in errors: see ArrayViews.
   */
  RowsInput(vtkDataObject* input, const char* rows);

  /**
   * Adds the arrays to the view, but that of ghosts. Those that are no columns, of variants for one, are left out with a
   * notice. Throws Error where an array has not a value for each row.
   */
  void SeeArrays(vtkDataSetAttributes* data, granular::Notices& notices);

  ArrayViews Arrays;

private:
  void ReadFieldData(vtkFieldData* data);
};

/**
 * Points, point arrays and field data.
 */
class DumpInput : public RowsInput
{
public:
  /**
   * Throws what SeeArrays does.
   */
  DumpInput(vtkPointSet* input, granular::Notices& notices);
};

/**
 * Where points are that are no grains, such as corners of cells: x y z of each, with the origin added that was subtracted,
 * and scaled ones multiplied by the box. Unwrapped ones are as they are: grains are unwrapped, cells are not.
 */
std::vector<double> ReadAbsolutePoints(vtkPointSet* input);
}

#endif
