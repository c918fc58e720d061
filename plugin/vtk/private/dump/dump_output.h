// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularDumpOutput_h
#define vtkGranularDumpOutput_h

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/runs/kind.h"

#include <memory>
#include <string>

class vtkAbstractArray;
class vtkFieldData;
class vtkInformationVector;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace vtkGranularPrivate
{
/**
 * Adds an array that describes a frame, such as its box: ParaView's lists of colours leave it out.
 */
void AddFact(vtkFieldData* data, vtkAbstractArray* fact);

class VertexCache;

/**
 * The kind of cells that particles get.
 */
enum class VertexCells
{
  None,
  One,
  OnePerPoint
};

/**
 * Fills the output with the particles of a frame: points, vertices and point data. Takes over the memory of the frame,
 * and reuses the vertices of the frame before if they are equal.
 */
void FillParticles(vtkPolyData* output, granular::Table& frame, bool singlePrecision,
  VertexCells cells, VertexCache& cache, const std::shared_ptr<granular::BlockPool>& pool);

/**
 * Makes the box of a frame as one hexahedron minus the origin; the unit cube if the points are scaled. Returns false,
 * without a cell, if the box in the file is not finite.
 */
bool FillBox(vtkUnstructuredGrid* output, const granular::Box& box,
  granular::Coordinates coordinates, const granular::Vector3& pointOrigin);

/**
 * Adds field data that later filters need: the kind of points, box and timestep.
 */
void FillHeader(vtkFieldData* data, const granular::FrameHeader& header,
  granular::Coordinates coordinates, const granular::Vector3& pointOrigin);

/**
 * Adds ParticlesLeftOut to all outputs, which names the properties by which a reader leaves out particles; nothing if all are present.
 * VTK's filters pass field data on, so filters that need all particles can report missing ones.
 */
void FillLeftOut(vtkInformationVector* outputs, const granular::Request& request);
std::string FindLeftOut(vtkFieldData* data); ///< in words: "Stride 10, RegionOfInterest", or empty

/**
 * Adds what FillHeader adds, and the columns.
 */
void FillFieldData(
  vtkFieldData* data, const granular::Table& frame, const granular::Vector3& pointOrigin);
}

#endif
