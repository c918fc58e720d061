// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainFragments_h
#define vtkGranularGrainFragments_h

// The part of vtkGranularGrainShaders.h that is done for each pixel.
namespace vtkGranularGrainShaders
{
constexpr const char* FragmentInputs = R"(
//GRANULAR::Shapes
flat in vec3 centerVCVSOutput; // from the place
flat in float radiusVCVSOutput;
uniform vec3 placeVC;
uniform vec2 placeTangent; // x and y of VC where the line from the camera to the place meets z = -1
uniform vec4 placePixel; // where the picture shows the place: whole pixels, and parts of one
uniform vec2 pixelVC; // the size of a pixel at z = -1, or at any z if parallel
uniform int cameraParallel;
uniform float nearVC; // z of the near plane
uniform vec2 middleVC; // z of the place from where the depth is 1/2, and the change of depth with z there, times w
uniform vec2 farVC; // the same for where it is 1
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
  // From the centre to a point of the ray near it. All is counted from the place, so that numbers are small and digits are kept.
  float radiusVC = radiusVCVSOutput;
  vec3 centerVC = placeVC + centerVCVSOutput;
  vec2 tangentVC = ((gl_FragCoord.xy - placePixel.xy) - placePixel.zw) * pixelVC; // from that of the place
  vec3 offsetVC = vec3(tangentVC - centerVCVSOutput.xy, 0.0);
  vec3 rayVC = vec3(0.0, 0.0, -radiusVC);
  if (cameraParallel == 0)
  {
    float awayVC = max(radiusVC, -centerVC.z);
    rayVC = vec3((placeTangent + tangentVC) * awayVC, -awayVC);
    offsetVC.z = -awayVC - centerVC.z;
    offsetVC.xy = tangentVC * awayVC - placeTangent * (centerVCVSOutput.z + offsetVC.z) - centerVCVSOutput.xy;
  }
  vec3 surfaceVC = vec3(0.0);
  vec3 normalVCVSOutput = vec3(0.0, 0.0, 1.0);
#ifdef HAVE_SHAPES
  vec3 from = offsetVC * turnVCVSOutput / axesVCVSOutput;
  vec3 along = rayVC * turnVCVSOutput / axesVCVSOutput;
  if (powersVSOutput != vec2(2.0))
  {
    along = mix(along, vec3(1e-20), lessThan(abs(along), vec3(1e-20)));
    vec3 low = (-1.0 - from) / along, high = (1.0 - from) / along;
    vec3 first = min(low, high), last = max(low, high);
    float enter = max(first.x, max(first.y, first.z)), leave = min(last.x, min(last.y, last.z));
    vec3 gradient = vec3(0.0);
    bool found = false; // nor beside the cube around the particle, where powers could be more than floats hold
    for (float side = 1.0; side >= -1.0 && enter <= leave && !found; side -= 2.0)
    {
      float t = side > 0.0 ? enter : leave;
      if (!meets(from, along, powersVSOutput, side, t, gradient))
      {
        break;
      }
      surfaceVC = offsetVC + t * rayVC;
      normalVCVSOutput = side * normalize(turnVCVSOutput * (gradient / axesVCVSOutput));
      found = isLeft(centerVC + surfaceVC);
    }
    if (!found)
    {
      discard;
    }
  }
  else
#else
  vec3 from = offsetVC / radiusVC;
  vec3 along = rayVC / radiusVC;
#endif
  {
    float rayA = dot(along, along);
    float rayB = dot(from, along);
    float rayD = rayB * rayB - rayA * (dot(from, from) - 1.0);
    if (rayD < 0.0)
    {
      discard;
    }
    float t = -(rayB + sqrt(rayD)) / rayA;
    vec3 unit = from + t * along;
    surfaceVC = offsetVC + t * rayVC;
    if (!isLeft(centerVC + surfaceVC))
    {
      t = (sqrt(rayD) - rayB) / rayA;
      unit = -(from + t * along);
      surfaceVC = offsetVC + t * rayVC;
      if (!isLeft(centerVC + surfaceVC))
      {
        discard;
      }
    }
#ifdef HAVE_SHAPES
    normalVCVSOutput = normalize(turnVCVSOutput * (unit / axesVCVSOutput));
#else
    normalVCVSOutput = unit;
#endif
  }
  vertexVC = vec4(centerVC + surfaceVC, 1.0);
  float w = cameraParallel != 0 ? 1.0 : -vertexVC.z;
  float fromMiddle = middleVC.x + centerVCVSOutput.z + surfaceVC.z;
  gl_FragDepth = 0.5 + fromMiddle * middleVC.y / w;
  if (gl_FragDepth > 0.875) // digits are lost with the distance from where a depth is known
  {
    float fromFar = farVC.x + centerVCVSOutput.z + surfaceVC.z;
    gl_FragDepth = 1.0 + fromFar * farVC.y / w;
  }
  if (gl_FragDepth > 1.0)
  {
    discard;
  }
)";
}

#endif
