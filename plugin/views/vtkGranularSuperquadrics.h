// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSuperquadrics_h
#define vtkGranularSuperquadrics_h

// The part of vtkGranularGrainFragments.h that only shapes other than spheres need.
namespace vtkGranularGrainShaders
{
constexpr const char* ShapeInputs = R"(
flat in real3x3 turnVCVSOutput;
flat in real3 axesVCVSOutput;
flat in vec2 powersVSOutput;
)";

// The kinds of number that the functions below are made for: both where there are doubles.
constexpr const char* InFloats = R"(
#define number float
#define number2 vec2
#define number3 vec3
#ifdef HAVE_DOUBLES
#define ROUGH
#endif
)";

constexpr const char* InDoubles = R"(
#undef number
#undef number2
#undef number3
#undef ROUGH
#define number double
#define number2 dvec2
#define number3 dvec3
)";

constexpr const char* Superquadrics = R"(
// x^n for x, n >= 0, n below 4096. A step in doubles comes after a search in floats, which then may be rough; else by products and square
// roots, which graphics hardware rounds well.
number power(number x, float n)
{
#ifdef ROUGH
  return pow(x, n);
#else
  number result = 1.0;
  float whole = floor(n);
  float part = n - whole;
  number base = x;
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
#endif
}

// (|x|^n2 + |y|^n2)^(n1/n2) + |z|^n1, which is 1 on the surface, and its gradient by n1. x and y are taken in parts of the larger one:
// near the axis of z their powers would be less than floats hold, but a root of them is not.
number superquadric(number3 p, vec2 n, out number3 gradient)
{
  number3 a = abs(p);
  number most = n.x == n.y ? number(1.0) : max(a.x, a.y);
  number2 part = most > 0.0 ? a.xy / most : number2(0.0);
  number3 b = number3(power(part.x, n.y - 1.0), power(part.y, n.y - 1.0), power(a.z, n.x - 1.0));
  number inner = part.x * b.x + part.y * b.y;
  number outer = 1.0;
  if (n.x != n.y && most > 0.0)
  {
    number mosts = power(most, n.x - 1.0);
    outer = power(inner, n.x / n.y) / inner * mosts;
    inner *= outer * most;
  }
  gradient = sign(p) * b * number3(outer, outer, 1.0);
  return inner + a.z * b.z;
}

// Returns how far a place on a ray is past the surface, in parts of the direction, by Newton's method for the norm whose unit ball is the
// particle. It is convex along the ray, so that steps from outside pass nothing.
number step_of(number3 place, number3 d, vec2 n, out number3 gradient)
{
  number value = superquadric(place, n, gradient);
  number more = value - 1.0;
  number part = abs(more) < 0.02 ? more * (1.0 - 0.5 * (1.0 + 1.0 / n.x) * more) : n.x * (1.0 - pow(float(value), -1.0 / n.x));
  return part * value / (n.x * dot(gradient, d));
}
)";

// Moves t to where the ray o + t d meets the surface, along the ray (side 1) or against it (-1), from a place outside. Returns false
// if it does not.
constexpr const char* Meets = R"(
bool meets(vec3 o, vec3 d, vec2 n, float side, inout float t)
{
  vec3 gradient;
#ifdef ROUGH
  float least = 1e-5 / length(d);
#else
  float least = 1e-7 / length(d);
#endif
  for (int k = 0; k < 48; ++k)
  {
    float move = step_of(o + t * d, d, n, gradient);
    if (dot(gradient, d) * side >= 0.0)
    {
      return false;
    }
    t -= move;
    if (abs(move) <= least)
    {
      break;
    }
  }
  return true;
}
)";
}

#endif
