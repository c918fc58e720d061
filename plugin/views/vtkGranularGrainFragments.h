// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainFragments_h
#define vtkGranularGrainFragments_h

// The part of vtkGranularGrainShaders.h that is done for each pixel.
namespace vtkGranularGrainShaders
{
constexpr const char* FragmentInputs = R"(
//GRANULAR::Shapes
flat in vec4 centerVCVSOutput;
flat in float radiusVCVSOutput;
uniform vec4 pixelVC; // what leads from pixels to x and y of VC at z = -1, or at any z if parallel
uniform int cameraParallel;
uniform float nearVC; // z of the near plane
uniform vec3 depthVC; // of the place, its change with z there, and that of w with z by w
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

#ifdef HAVE_SHAPES
flat in mat3 turnVCVSOutput;
flat in vec3 axesVCVSOutput;
flat in vec2 powersVSOutput;

// x^n for x, n >= 0 by products and square roots, which graphics hardware rounds well, for n below 4096
float power(float x, float n)
{
  float result = 1.0;
  float whole = floor(n);
  float part = n - whole;
  float base = x;
  for (int k = 0; k < 12 && whole > 0.0; ++k)
  {
    float half_whole = floor(0.5 * whole);
    if (whole > 2.0 * half_whole)
    {
      result *= base;
    }
    base *= base;
    whole = half_whole;
  }
  base = x;
  for (int k = 0; k < 24 && part > 0.0; ++k)
  {
    base = sqrt(base);
    part *= 2.0;
    if (part >= 1.0)
    {
      result *= base;
      part -= 1.0;
    }
  }
  return result;
}

// (|x|^n2 + |y|^n2)^(n1/n2) + |z|^n1, which is 1 on the surface, and its gradient by n1. x and y are taken in parts of the larger one:
// near the axis of z their powers would be less than floats hold, but a root of them is not.
float superquadric(vec3 p, vec2 n, out vec3 gradient)
{
  vec3 a = abs(p);
  float most = n.x == n.y ? 1.0 : max(a.x, a.y);
  vec2 part = most > 0.0 ? a.xy / most : vec2(0.0);
  vec3 b = vec3(power(part.x, n.y - 1.0), power(part.y, n.y - 1.0), power(a.z, n.x - 1.0));
  float inner = part.x * b.x + part.y * b.y;
  float outer = 1.0;
  if (n.x != n.y && most > 0.0)
  {
    float mosts = power(most, n.x - 1.0);
    outer = power(inner, n.x / n.y) / inner * mosts;
    inner *= outer * most;
  }
  gradient = sign(p) * b * vec3(outer, outer, 1.0);
  return inner + a.z * b.z;
}

// Moves t to where the ray o + t d meets the surface, along the ray (side 1) or against it (-1), from a place outside. Returns false
// if it does not. The particle is the unit ball of a norm, which is convex along the ray, so Newton's method passes nothing.
bool meets(vec3 o, vec3 d, vec2 n, float side, inout float t, out vec3 gradient)
{
  float enough = 1e-7 / length(d);
  for (int k = 0; k < 48; ++k)
  {
    float value = superquadric(o + t * d, n, gradient);
    float slope = n.x * dot(gradient, d);
    if (slope * side >= 0.0)
    {
      return false;
    }
    float more = value - 1.0;
    float part = abs(more) < 0.02 ? more * (1.0 - 0.5 * (1.0 + 1.0 / n.x) * more) : n.x * (1.0 - pow(value, -1.0 / n.x));
    float move = part * value / slope;
    t -= move;
    if (abs(move) <= enough)
    {
      break;
    }
  }
  return true;
}
#endif
)";

// Finds the point of the surface on the ray: in front, or behind if the front is cut away.
constexpr const char* FragmentSurface = R"(
  // from the centre to a point of the ray near it, from where the numbers are small
  float radiusVC = radiusVCVSOutput;
  float awayVC = max(radiusVC, -centerVCVSOutput.z);
  vec2 tangentVC = gl_FragCoord.xy * pixelVC.xy + pixelVC.zw;
  vec3 offsetVC = vec3(tangentVC - centerVCVSOutput.xy, 0.0);
  vec3 rayVC = vec3(0.0, 0.0, -radiusVC);
  if (cameraParallel == 0)
  {
    rayVC = vec3(tangentVC * awayVC, -awayVC);
    offsetVC = vec3(rayVC.xy - centerVCVSOutput.xy, -awayVC - centerVCVSOutput.z);
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
      found = isLeft(centerVCVSOutput.xyz + surfaceVC);
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
    if (!isLeft(centerVCVSOutput.xyz + surfaceVC))
    {
      t = (sqrt(rayD) - rayB) / rayA;
      unit = -(from + t * along);
      surfaceVC = offsetVC + t * rayVC;
      if (!isLeft(centerVCVSOutput.xyz + surfaceVC))
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
  vertexVC = vec4(centerVCVSOutput.xyz + surfaceVC, 1.0);
  float fromPlace = centerVCVSOutput.w + surfaceVC.z;
  gl_FragDepth = depthVC.x + fromPlace * depthVC.y / (1.0 + fromPlace * depthVC.z);
  if (gl_FragDepth > 1.0)
  {
    discard;
  }
)";
}

#endif
