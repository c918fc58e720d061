// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainShaders_h
#define vtkGranularGrainShaders_h

// Programs of the graphics hardware for vtkGranularGrainMapper. VTK replaces what begins with //VTK:: by colours, lights and selection.
// VC are the coordinates of the camera, which looks along -z; MC those of the buffers: counted from a place in view along the data's axes, or VC. Where HAVE_SHAPES is
// defined, particles are superquadrics; else spheres.
namespace vtkGranularGrainShaders
{
constexpr const char* Vertex = R"(//VTK::System::Dec
//GRANULAR::Shapes
in vec4 vertexMC;
in float radiusMC; // of a sphere around the particle
in vec4 partMC; // of the square around the particle that may be seen: low and high x and y, as parts of it
uniform mat3 bufferVC; // from MC to VC
uniform float scaleVC;
out vec3 centerVCVSOutput; // from the place
out float radiusVCVSOutput;
out vec4 partVSOutput;
#ifdef HAVE_SHAPES
uniform mat3 dataVC;
in vec3 axesMC;
in vec4 turnMC; // w x y z
in vec2 powersMC; // n1 along z, n2 across it
out mat3 turnVCVSOutput;
out vec3 axesVCVSOutput;
out vec2 powersVSOutput;
#endif
//VTK::Color::Dec
//VTK::Picking::Dec

void main()
{
  //VTK::Color::Impl
  radiusVCVSOutput = radiusMC * scaleVC;
  partVSOutput = partMC;
  centerVCVSOutput = bufferVC * vertexMC.xyz;
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
#ifdef HAVE_SHAPES
  float w = turnMC.x;
  vec3 q = turnMC.yzw;
  mat3 turn = mat3(
    1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + w * q.z), 2.0 * (q.x * q.z - w * q.y),
    2.0 * (q.x * q.y - w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z + w * q.x),
    2.0 * (q.x * q.z + w * q.y), 2.0 * (q.y * q.z - w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
  turnVCVSOutput = dataVC * turn / scaleVC;
  axesVCVSOutput = axesMC * scaleVC;
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
in vec3 centerVCVSOutput[];
in float radiusVCVSOutput[];
in vec4 partVSOutput[];
flat out vec3 centerVCGSOutput;
flat out float radiusVCGSOutput;
#ifdef HAVE_SHAPES
in mat3 turnVCVSOutput[];
in vec3 axesVCVSOutput[];
in vec2 powersVSOutput[];
flat out mat3 turnVCGSOutput;
flat out vec3 axesVCGSOutput;
flat out vec2 powersGSOutput;
#endif
//VTK::PrimID::Dec
//VTK::Color::Dec
//VTK::Picking::Dec

void main()
{
  int i = 0;
  vec3 center = placeVC + centerVCVSOutput[0];
  float radius = radiusVCVSOutput[0];
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
    radiusVCGSOutput = radius;
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
