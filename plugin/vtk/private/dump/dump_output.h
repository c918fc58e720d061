// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularDumpOutput_h
#define vtkGranularDumpOutput_h

#include "granular/dump/read/dump_reader.h"

#include <memory>
#include <string>

class vtkFieldData;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace vtkGranularPrivate
{
class VertexCache;

/**
 * What cells the particles get.
 */
enum class VertexCells
{
  None,
  One,
  OnePerPoint
};

/**
 * The particles of a frame: points, vertices and point data. Takes the memory of the frame, and the
 * vertices of the frame before where they are the same.
 */
void FillParticles(vtkPolyData* output, granular::DumpFrame& frame, bool singlePrecision,
  VertexCells cells, VertexCache& cache, const std::shared_ptr<granular::BlockPool>& pool);

/**
 * The box of a frame as one hexahedron less the origin; the unit cube where the points are scaled.
 * False, and no cell, if the box of the file is not finite.
 */
bool FillBox(vtkUnstructuredGrid* output, const granular::Box& box,
  granular::Coordinates coordinates, const granular::Vector3& pointOrigin);

/**
 * What whoever comes after needs to know about points: what they are, box and timestep.
 */
void FillHeader(vtkFieldData* data, const granular::FrameHeader& header,
  granular::Coordinates coordinates, const granular::Vector3& pointOrigin);

/**
 * ParticlesLeftOut: the properties by which a reader leaves out particles, or nothing where it has all. VTK's filters pass field
 * data on, so that filters that need all particles can say that some are missing.
 */
void FillLeftOut(vtkFieldData* data, const granular::DumpRequest& request);
std::string FindLeftOut(vtkFieldData* data); ///< in words: "Stride 10, RegionOfInterest", or empty

/**
 * The same as FillHeader, and the columns.
 */
void FillFieldData(
  vtkFieldData* data, const granular::DumpFrame& frame, const granular::Vector3& pointOrigin);
}

#endif
