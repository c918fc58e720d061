// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/frame_view.h"

#include <algorithm>

namespace granular
{
const ArrayView* FrameView::find(std::string_view name) const noexcept
{
  const auto found = std::find_if(
    arrays.begin(), arrays.end(), [name](const ArrayView& array) { return array.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}
}
