// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainFragments_h
#define vtkGranularGrainFragments_h

// The part of vtkGranularGrainShaders.h that is done for each pixel.
namespace vtkGranularGrainShaders
{
constexpr const char* FragmentInputs = R"(
//GRANULAR::Shapes
flat in real3 centerVCVSOutput; // from the place
flat in real radiusVCVSOutput;
uniform vec3 placeVC;
uniform vec3 placeVCLow;
uniform vec2 axisPixel; // where the picture shows the line of sight
uniform vec2 axisPixelLow;
uniform vec2 pixelVC; // the size of a pixel at z = -1, or at any z if parallel
uniform vec2 pixelVCLow;
uniform int cameraParallel;
uniform float nearVC; // z of the near plane
uniform vec2 farVC; // z of the place from the far plane, and the change of depth with z there, times w
uniform vec2 farVCLow;
#ifdef CLIPS
uniform vec4 clipVC[CLIPS];
#endif

// Returns true if nothing is cut away at a place in front of the far plane.
bool isLeft(vec3 place)
{
  bool left = place.z <= nearVC;
#ifdef CLIPS
  for (int i = 0; i < CLIPS; ++i)
  {
    left = left && dot(clipVC[i], vec4(place, 1.0)) >= 0.0;
  }
#endif
  return left;
}

)";

// Finds the point of the surface on the ray: in front, or behind if the front is cut away.
constexpr const char* FragmentSurface = R"(
  // From the centre to a point of the ray near it: so numbers are small, and digits are kept.
  real radiusVC = radiusVCVSOutput;
  real3 centerVC = real3(placeVC) + real3(placeVCLow) + centerVCVSOutput;
  real2 tangentVC = (real2(gl_FragCoord.xy) - real2(axisPixel) - real2(axisPixelLow)) * (real2(pixelVC) + real2(pixelVCLow));
  real3 offsetVC = real3(tangentVC - centerVC.xy, 0.0);
  real3 rayVC = real3(0.0, 0.0, -radiusVC);
  if (cameraParallel == 0)
  {
    real awayVC = max(radiusVC, -centerVC.z);
    rayVC = real3(tangentVC, -1.0) * awayVC;
    offsetVC = rayVC - centerVC;
  }
  real3 surfaceVC = real3(0.0);
  vec3 normalVCVSOutput = vec3(0.0, 0.0, 1.0);
#ifdef HAVE_SHAPES
  real3 from = offsetVC * turnVCVSOutput / axesVCVSOutput;
  real3 along = rayVC * turnVCVSOutput / axesVCVSOutput;
  if (powersVSOutput != vec2(2.0))
  {
    vec3 o = vec3(from), d = vec3(along);
    d = mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    vec3 low = (-1.0 - o) / d, high = (1.0 - o) / d;
    vec3 first = min(low, high), last = max(low, high);
    float enter = max(first.x, max(first.y, first.z)), leave = min(last.x, min(last.y, last.z));
    bool found = false; // nor beside the cube around the particle, where powers could be more than floats hold
    for (float side = 1.0; side >= -1.0 && enter <= leave && !found; side -= 2.0)
    {
      float near = side > 0.0 ? enter : leave;
      if (!meets(o, d, powersVSOutput, side, near))
      {
        break;
      }
      real3 gradient;
      real step = step_of(from + near * along, along, powersVSOutput, gradient);
      real t = near - clamp(step, -1e-4 / length(d), 1e-4 / length(d)); // where a ray only touches, steps are of any length
      surfaceVC = offsetVC + t * rayVC;
      normalVCVSOutput = vec3(side * normalize(turnVCVSOutput * (gradient / axesVCVSOutput)));
      found = isLeft(vec3(centerVC + surfaceVC));
    }
    if (!found)
    {
      discard;
    }
  }
  else
#else
  real3 from = offsetVC / radiusVC;
  real3 along = rayVC / radiusVC;
#endif
  {
    real rayA = dot(along, along);
    real rayB = dot(from, along);
    real rayD = rayB * rayB - rayA * (dot(from, from) - 1.0);
    if (rayD < 0.0)
    {
      discard;
    }
    real t = -(rayB + sqrt(rayD)) / rayA;
    real3 unit = from + t * along;
    surfaceVC = offsetVC + t * rayVC;
    if (!isLeft(vec3(centerVC + surfaceVC)))
    {
      t = (sqrt(rayD) - rayB) / rayA;
      unit = -(from + t * along);
      surfaceVC = offsetVC + t * rayVC;
      if (!isLeft(vec3(centerVC + surfaceVC)))
      {
        discard;
      }
    }
#ifdef HAVE_SHAPES
    normalVCVSOutput = vec3(normalize(turnVCVSOutput * (unit / axesVCVSOutput)));
#else
    normalVCVSOutput = vec3(unit);
#endif
  }
  vertexVC = vec4(centerVC + surfaceVC, 1.0);
  real w = cameraParallel != 0 ? real(1.0) : -(centerVC.z + surfaceVC.z);
  real2 end = real2(farVC) + real2(farVCLow);
  real depth = 1.0 + (end.x + centerVCVSOutput.z + surfaceVC.z) * end.y / w;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = float(depth);
)";
}

#endif
