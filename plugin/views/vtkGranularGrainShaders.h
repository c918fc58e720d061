// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainShaders_h
#define vtkGranularGrainShaders_h

// Programs of the graphics hardware for vtkGranularGrainMapper. VTK replaces what begins with //VTK:: by colours, lights and selection.
// VC are the coordinates of the camera, which looks along -z; MC those of the buffers: counted from a place in view, along the data's axes.
// With HAVE_SHAPES particles are superquadrics; else spheres. A real is a double where the hardware has them: a float holds too little of
// the depth near a camera. Who lacks them is not asked for them, because ParaView 6.1 shows the warning of the driver. Numbers come as
// floats and what these lack.
namespace vtkGranularGrainShaders
{
constexpr const char* Extensions = R"(//VTK::System::Dec
#ifdef GL_ARB_gpu_shader_fp64
#extension GL_ARB_gpu_shader_fp64 : enable
#endif
#ifdef GL_ARB_shader_bit_encoding
#extension GL_ARB_shader_bit_encoding : enable
#endif
)";

constexpr const char* Reals = R"(
#if defined(GL_ARB_gpu_shader_fp64) && defined(GL_ARB_shader_bit_encoding)
#define HAVE_DOUBLES
#define real double
#define real2 dvec2
#define real3 dvec3
#define real3x3 dmat3
#else
#define real float
#define real2 vec2
#define real3 vec3
#define real3x3 mat3
#endif
)";

constexpr const char* Vertex = R"(//VTK::System::Dec
//GRANULAR::Shapes
in vec4 vertexMC;
in float radiusMC; // of a sphere around the particle
in vec4 lowMC; // what x y z and the radius lack
in vec4 partMC; // of the square around the particle that may be seen: low and high x and y, as parts of it
uniform mat3 dataVC; // from MC to VC
uniform mat3 dataVCLow;
uniform vec2 scaleVC;
out real3 centerVCVSOutput; // from the place
out real radiusVCVSOutput;
out vec4 partVSOutput;
#ifdef HAVE_SHAPES
in vec3 axesMC;
in vec4 axesLowMC;
in vec4 turnMC; // w x y z
in vec4 turnLowMC;
in vec2 powersMC; // n1 along z, n2 across it
out real3x3 turnVCVSOutput;
out real3 axesVCVSOutput;
out vec2 powersVSOutput;
#endif
//VTK::Color::Dec
//VTK::Picking::Dec

// A number, of a float and a byte: 1 to 255 for -1/2 to 1/2 of the float's last place.
real whole(float high, float low)
{
#ifdef HAVE_DOUBLES
  float power = uintBitsToFloat(floatBitsToUint(high) & 0x7F800000u); // of 2
  return real(high) + real(low * 255.0 - 128.0) * real(power) * real(1.0 / (127.0 * 16777216.0));
#else
  return high;
#endif
}

real3 whole3(vec3 high, vec3 low)
{
  return real3(whole(high.x, low.x), whole(high.y, low.y), whole(high.z, low.z));
}

void main()
{
  //VTK::Color::Impl
  real scale = real(scaleVC.x) + real(scaleVC.y);
  radiusVCVSOutput = whole(radiusMC, lowMC.w) * scale;
  partVSOutput = partMC;
  real3x3 toCamera = real3x3(dataVC) + real3x3(dataVCLow);
  centerVCVSOutput = toCamera * whole3(vertexMC.xyz, lowMC.xyz);
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
#ifdef HAVE_SHAPES
  real w = whole(turnMC.x, turnLowMC.x);
  real3 q = whole3(turnMC.yzw, turnLowMC.yzw);
  real3x3 turn = real3x3(
    1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + w * q.z), 2.0 * (q.x * q.z - w * q.y),
    2.0 * (q.x * q.y - w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z + w * q.x),
    2.0 * (q.x * q.z + w * q.y), 2.0 * (q.y * q.z - w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
  turnVCVSOutput = toCamera * turn / scale;
  axesVCVSOutput = whole3(axesMC, axesLowMC.xyz) * scale;
  powersVSOutput = powersMC;
#endif
  //VTK::Picking::Impl
}
)";

// The smallest rectangle of the picture around the sphere that is around a particle, or a part of it. Its depth is in the middle, so
// that neither plane cuts it off. Where the plane of the camera cuts the sphere, its picture has no end on one side; from inside the
// sphere all rays may meet the particle.
constexpr const char* Geometry = R"(//VTK::System::Dec
//GRANULAR::Shapes
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;
uniform vec4 pictureVC; // x y of the picture are pictureVC.xy times x y of VC at z = -1, or at any z if parallel, and pictureVC.zw
uniform int cameraParallel;
uniform vec3 placeVC;
in real3 centerVCVSOutput[];
in real radiusVCVSOutput[];
in vec4 partVSOutput[];
flat out real3 centerVCGSOutput;
flat out real radiusVCGSOutput;
#ifdef HAVE_SHAPES
in real3x3 turnVCVSOutput[];
in real3 axesVCVSOutput[];
in vec2 powersVSOutput[];
flat out real3x3 turnVCGSOutput;
flat out real3 axesVCGSOutput;
flat out vec2 powersGSOutput;
#endif
//VTK::PrimID::Dec
//VTK::Color::Dec
//VTK::Picking::Dec

void main()
{
  int i = 0;
  vec3 center = placeVC + vec3(centerVCVSOutput[0]);
  float radius = float(radiusVCVSOutput[0]);
  if (!(radius > 0.0))
  {
    return;
  }
  float away = cameraParallel != 0 ? 1.0 : -center.z;
  float ratio = cameraParallel != 0 ? 0.0 : radius / away;
  vec2 low = (vec2(-1.0) - pictureVC.zw) / pictureVC.xy;
  vec2 high = (vec2(1.0) - pictureVC.zw) / pictureVC.xy;
  if (away > 1.01 * radius || cameraParallel != 0)
  {
    vec2 at = center.xy / away;
    float inverse = 1.0 / ((1.0 - ratio) * (1.0 + ratio));
    vec2 middle = at * inverse;
    vec2 size = radius / away * sqrt(1.0 + (cameraParallel != 0 ? vec2(0.0) : at * at - ratio * ratio)) * inverse;
    low = max(low, middle + (2.0 * partVSOutput[0].xy - 1.0) * size);
    high = min(high, middle + (2.0 * partVSOutput[0].zw - 1.0) * size);
  }
  else
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      // along an axis, the directions in which the sphere is seen, if the camera is not between its ends
      float distance = length(vec2(center[axis], away));
      float direction = atan(center[axis], away);
      float half_angle = 1.001 * asin(min(radius / distance, 1.0)) + 0.001;
      if (distance > 1.01 * radius && direction - half_angle > -1.569)
      {
        low[axis] = max(low[axis], tan(min(direction - half_angle, 1.569)));
      }
      if (distance > 1.01 * radius && direction + half_angle < 1.569)
      {
        high[axis] = min(high[axis], tan(max(direction + half_angle, -1.569)));
      }
    }
  }
  if (!(low.x < high.x && low.y < high.y))
  {
    return;
  }
  for (int k = 0; k < 4; ++k)
  {
    vec2 at = vec2(k % 2 == 0 ? low.x : high.x, k / 2 == 0 ? low.y : high.y);
    radiusVCGSOutput = radiusVCVSOutput[0];
    gl_Position = vec4(at * pictureVC.xy + pictureVC.zw, 0.0, 1.0);
    centerVCGSOutput = centerVCVSOutput[0];
#ifdef HAVE_SHAPES
    turnVCGSOutput = turnVCVSOutput[0];
    axesVCGSOutput = axesVCVSOutput[0];
    powersGSOutput = powersVSOutput[0];
#endif
    //VTK::PrimID::Impl
    //VTK::Color::Impl
    //VTK::Picking::Impl
    EmitVertex();
  }
  EndPrimitive();
}
)";
}

#endif
