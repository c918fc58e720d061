// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSuperquadrics_h
#define vtkGranularSuperquadrics_h

// The part of vtkGranularGrainFragments.h that only shapes other than spheres need.
namespace vtkGranularGrainShaders
{
constexpr const char* Superquadrics = R"(#ifdef HAVE_SHAPES
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
}

#endif
