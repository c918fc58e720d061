// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/view_frame.h"

#include <cstddef>
#include <utility>

namespace granular
{
FrameView view_frame(const DumpFrame& frame, const Vector3& point_origin)
{
  FrameView view;
  view.header = frame.header;
  view.has_box = frame.header.has_box;
  view.rows = frame.rows;
  if (frame.points.data())
  {
    view.points =
      view_rows("", ValueType::Float64, static_cast<const double*>(frame.points.data()), 3);
  }
  view.coordinates = frame.coordinates;
  view.point_origin = point_origin;
  for (const DumpArray& array : frame.arrays)
  {
    if (array.info.type != ValueType::Text)
    {
      const int size = array.info.components();
      const auto* const bytes = static_cast<const char*>(array.block.data());
      ArrayView values{ array.info.name, array.info.type, {}, size };
      for (int i = 0; i < size; ++i)
      {
        values.components.push_back(bytes + static_cast<std::size_t>(i) * size_of(array.info.type));
      }
      view.arrays.push_back(std::move(values));
    }
  }
  return view;
}
}
