// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/particles.h"

#include "private/request/expect_data.h"

#include "granular/common/error.h"
#include "granular/particles/frame_view.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace vtkGranularPrivate
{
Particles::Particles(vtkDataObject* input, granular::Communicator& ranks)
  : DumpInput(ExpectData<vtkPointSet>(input, "a vtkPointSet of particles"))
{
  granular::share_header(this->View, ranks);
}

std::pair<granular::Vector3, granular::Vector3> Particles::FindBounds(
  const double given[6], const char* tilted) const
{
  const granular::FrameView& view = this->View;
  if (std::any_of(given, given + 6, [](double bound) { return std::isnan(bound); }))
  {
    throw granular::Error("expected Bounds of numbers, got nan");
  }
  const bool all = given[0] <= given[1] && given[2] <= given[3] && given[4] <= given[5];
  if (!all && !view.has_box)
  {
    throw granular::Error(
      "expected the box in the field data of the input (BoxOrigin, BoxVectors), "
      "got none: give Bounds");
  }
  const bool fits = !view.header.box.tilted || (!tilted && !view.header.box.general);
  if (!all && !fits)
  {
    throw granular::UnsupportedError("expected a box along the axes, got a tilted one: " +
      std::string(tilted ? tilted : "give Bounds"));
  }
  const granular::BoxBounds box = all ? granular::BoxBounds{} : view.header.box.bounds();
  granular::Vector3 lo = box.lo;
  granular::Vector3 hi = box.hi;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (given[2 * k] <= given[2 * k + 1])
    {
      lo[k] = given[2 * k];
      hi[k] = given[2 * k + 1];
    }
  }
  return { lo, hi };
}
}
