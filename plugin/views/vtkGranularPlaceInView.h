// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPlaceInView_h
#define vtkGranularPlaceInView_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <algorithm> // For std::clamp
#include <array>     // For places
#include <cmath>     // For floating point

// Places from which coordinates are counted before they become floats.
namespace vtkGranularPlaceInView
{
using Place = std::array<double, 3>;

constexpr double MostSizes = 64.0; // of the particles together, in halves of the view's height

// Returns the distance of what the camera looks at, between the clipping planes: the focal point may be anywhere on the line of sight.
inline double DistanceInView(vtkCamera* camera)
{
  return std::clamp(
    camera->GetDistance(), camera->GetClippingRange()[0], camera->GetClippingRange()[1]);
}

// Returns half the height of the view there.
inline double HalfHeight(vtkCamera* camera)
{
  return camera->GetParallelProjection()
    ? camera->GetParallelScale()
    : DistanceInView(camera) * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
}

// Returns a place near what the camera looks at, from which points are counted before they become floats.
// It depends on the camera alone, so that all ranks find the same one. It lies on a lattice with a spacing of
// 32 to 256 times half the height of the view. So it seldom changes, and a float holds points in view, up to
// 2^8 such halves away, to 2^-16 of a half: some hundredths of a pixel.
inline Place PlaceInView(vtkCamera* camera)
{
  Place position;
  Place place;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(place.data());
  const double distance = DistanceInView(camera);
  const double half = HalfHeight(camera);
  int exponent = 0;
  std::frexp(32.0 * half, &exponent);
  const double spacing = std::ldexp(1.0, 3 * static_cast<int>(std::ceil(exponent / 3.0)));
  const double along = distance / camera->GetDistance();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    place[axis] = position[axis] + along * (place[axis] - position[axis]);
    place[axis] = spacing * std::round(place[axis] / spacing);
    if (!std::isfinite(place[axis]))
    {
      return Place{};
    }
  }
  return place;
}

// Returns where a place is in the coordinates of the data that an actor moves.
inline Place InData(const Place& place, vtkActor* actor)
{
  if (actor->vtkProp3D::GetIsIdentity())
  {
    return place;
  }
  vtkNew<vtkMatrix4x4> inverse;
  vtkMatrix4x4::Invert(actor->GetMatrix(), inverse);
  double moved[4] = { place[0], place[1], place[2], 1.0 };
  inverse->MultiplyPoint(moved, moved);
  return { moved[0], moved[1], moved[2] };
}
}

#endif
