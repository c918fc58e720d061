// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/dump_output.h"

#include "private/arrays/arrays.h"

#include "granular/geometry/box.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cmath>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The corners of a cube in the order of a VTK_HEXAHEDRON.
 */
constexpr int HexahedronCorners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
  { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

std::vector<double> Values(const granular::Twofold3& vector)
{
  std::vector<double> values;
  for (const granular::Twofold& component : vector)
  {
    values.push_back(std::isfinite(component.hi) ? component.value() : component.hi);
  }
  return values;
}

/**
 * The numbers of the header: six, and the tilts of a tilted box. The vectors are rounded, these are not.
 */
std::vector<double> Bounds(const granular::Box& box)
{
  const granular::BoxBounds b = box.bounds();
  std::vector<double> values = { b.lo[0], b.hi[0], b.lo[1], b.hi[1], b.lo[2], b.hi[2] };
  if (box.tilted)
  {
    values.insert(values.end(), { b.xy, b.xz, b.yz });
  }
  return values;
}

void FillBoxData(vtkFieldData* data, const granular::Box& box)
{
  std::vector<double> vectors;
  for (const granular::Twofold3& vector : box.vectors)
  {
    const std::vector<double> values = Values(vector);
    vectors.insert(vectors.end(), values.begin(), values.end());
  }
  AddFact(data, MakeDoubles("BoxOrigin", Values(box.origin)));
  AddFact(data, MakeDoubles("BoxVectors", vectors));
  if (!box.general)
  {
    AddFact(data, MakeDoubles("BoxBounds", Bounds(box)));
  }
  AddFact(data, MakeStrings("Boundary", { box.boundary }));
}
}

void AddFact(vtkFieldData* data, vtkAbstractArray* fact)
{
  fact->GetInformation()->Set(vtkAbstractArray::GUI_HIDE(), 1);
  data->AddArray(fact);
}

void FillParticles(vtkPolyData* output, granular::Table& frame, bool singlePrecision,
  VertexCells cells, VertexCache& cache, const std::shared_ptr<granular::BlockPool>& pool)
{
  const auto rows = static_cast<vtkIdType>(frame.rows);
  output->SetPoints(TakePoints(frame.points, rows, singlePrecision, frame.points_range));
  if (cells != VertexCells::None && rows > 0)
  {
    output->SetVerts(cache.Get(rows, cells == VertexCells::OnePerPoint, pool));
  }
  vtkPointData* data = output->GetPointData();
  data->AllocateArrays(static_cast<int>(frame.arrays.size()));
  for (granular::TableArray& from : frame.arrays)
  {
    if (from.info.role == granular::ColumnRole::Id)
    {
      data->SetPedigreeIds(TakeArray(from, rows, frame.schema.columns()));
    }
    else
    {
      AddTaken(data, from, rows, frame.schema.columns());
    }
  }
}

bool FillBox(vtkUnstructuredGrid* output, const granular::Box& box,
  granular::Coordinates coordinates, const granular::Vector3& pointOrigin)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(8);
  for (int i = 0; i < 8; ++i)
  {
    const auto& corner = HexahedronCorners[i];
    granular::Vector3 position = box.corner(corner[0], corner[1], corner[2], pointOrigin);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (coordinates == granular::Coordinates::Scaled)
      {
        position[axis] = corner[axis] - pointOrigin[axis];
      }
      if (!std::isfinite(position[axis]))
      {
        return false;
      }
    }
    points->SetPoint(i, position.data());
  }
  constexpr vtkIdType corners[] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  output->SetPoints(points);
  output->Allocate(1);
  output->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
  return true;
}

void FillHeader(vtkFieldData* data, const granular::FrameHeader& header,
  granular::Coordinates coordinates, const granular::Vector3& pointOrigin)
{
  AddFact(data, MakeStrings("Coordinates", { granular::to_string(coordinates) }));
  AddFact(
    data, MakeDoubles("PointOrigin", std::vector<double>(pointOrigin.begin(), pointOrigin.end())));
  if (header.has_box)
  {
    FillBoxData(data, header.box);
  }
  AddFact(data, ArrayOf<vtkTypeInt64Array>("timestep", std::array{ header.timestep }));
  if (!header.label.empty())
  {
    AddFact(data, MakeStrings("label", { header.label }));
  }
  if (!header.counted.empty() && header.counted != "ATOMS")
  {
    AddFact(data, MakeStrings("RowLabel", { header.counted }));
  }
  if (!header.units.empty())
  {
    AddFact(data, MakeStrings("units", { header.units }));
  }
  if (header.time)
  {
    AddFact(data, MakeDoubles("time", { *header.time }));
  }
  if (header.dialect)
  {
    const bool lammps = *header.dialect == granular::Dialect::Lammps;
    AddFact(data, MakeStrings("Dialect", { lammps ? "LAMMPS" : "LIGGGHTS" }));
  }
}

void FillLeftOut(vtkInformationVector* outputs, const granular::Request& request)
{
  std::vector<std::string> names;
  if (request.stride > 1)
  {
    names.push_back("Stride " + std::to_string(request.stride));
  }
  if (granular::restricts(request.region))
  {
    names.emplace_back("RegionOfInterest");
  }
  for (int port = 0; !names.empty() && port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    AddFact(vtkDataObject::GetData(outputs, port)->GetFieldData(),
      MakeStrings("ParticlesLeftOut", names));
  }
}

std::string FindLeftOut(vtkFieldData* data)
{
  std::string text;
  auto* names = vtkStringArray::SafeDownCast(data->GetAbstractArray("ParticlesLeftOut"));
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    text += (text.empty() ? "" : ", ") + names->GetValue(i);
  }
  return text;
}

void FillFieldData(
  vtkFieldData* data, const granular::Table& frame, const granular::Vector3& pointOrigin)
{
  FillHeader(data, frame.header, frame.coordinates, pointOrigin);
  if (!frame.type_names.empty())
  {
    AddFact(data, MakeStrings("TypeNames", frame.type_names));
  }
  const granular::ShapeSizes sizes =
    granular::find_shape_sizes(frame.schema, frame.header.dialect == granular::Dialect::Lammps);
  if (sizes != granular::ShapeSizes::None)
  {
    const bool half = sizes == granular::ShapeSizes::HalfAxes;
    AddFact(data, MakeStrings("ShapeSizes", { half ? "HalfAxes" : "Diameters" }));
  }
  std::vector<std::string> names;
  for (const granular::ColumnInfo& column : frame.schema.columns())
  {
    names.push_back(column.name);
  }
  AddFact(data, MakeStrings("Columns", names));
  if (frame.header.digits.size() == names.size())
  {
    AddFact(data, ArrayOf<vtkIntArray>("ColumnDigits", frame.header.digits));
  }
}
}
