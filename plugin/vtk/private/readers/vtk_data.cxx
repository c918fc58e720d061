// SPDX-License-Identifier: BSD-3-Clause
#include "private/readers/vtk_data.h"

#include "private/arrays/arrays.h"

#include "granular/formats/vtk_files/vtk_series.h"
#include "granular/formats/vtk_files/vtk_surface.h"
#include "granular/frames/file_index.h"

#include "vtkAppendDataSets.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArrayRange.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSTLReader.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkXMLGenericDataObjectReader.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace vtkGranularPrivate
{
constinit const granular::Kind VtkKind = { .number = -1,
  .rows = granular::RowKind::Particles,
  .is_file = granular::is_vtk_particles,
  .format = granular::vtk_format,
  .columns = []() noexcept { return std::span<const granular::KnownColumn>(); },
  .has_pieces = true,
  .looked_at = [](const granular::RunIndex&) { return std::vector<std::size_t>(); },
  .offer = nullptr,
  .read = nullptr };

namespace
{
/**
 * Runs a reader of VTK, and throws its first error.
 */
template <class Reader>
vtkSmartPointer<vtkDataObject> Run(const std::string& path)
{
  vtkNew<Reader> reader;
  std::string error;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&error);
  listener->SetCallback(
    [](vtkObject*, unsigned long, void* told, void* text)
    {
      auto& first = *static_cast<std::string*>(told);
      first = first.empty() && text ? static_cast<const char*>(text) : first;
    });
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  if constexpr (requires { reader->SetParserErrorObserver(listener); })
  {
    reader->SetParserErrorObserver(listener);
    reader->SetReaderErrorObserver(listener);
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkSmartPointer<vtkDataObject> data = reader->GetOutputDataObject(0);
  if (!error.empty() || !data)
  {
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw granular::FormatError("expected a file that VTK can read, got: " + error, { path });
  }
  return data;
}

void AddArrays(vtkPolyData* made, const granular::VtkSurface& surface)
{
  for (const granular::SurfaceArray& array : surface.arrays)
  {
    const char* const name = array.what.name.c_str();
    vtkSmartPointer<vtkDataArray> values = ArrayOf<vtkDoubleArray>(name, array.numbers);
    if (array.what.name == "type" && !array.integers.empty()) // of 32 bits, as in dumps
    {
      values = ArrayOf<vtkTypeInt32Array>(
        name, array.integers, [](std::int64_t value) { return static_cast<int>(value); });
    }
    else if (granular::is_integer(array.what.type))
    {
      values = ArrayOf<vtkTypeInt64Array>(name, array.integers);
    }
    values->SetNumberOfComponents(static_cast<int>(array.what.components));
    made->GetAttributes(array.of_cells ? vtkDataObject::CELL : vtkDataObject::POINT)
      ->AddArray(values);
  }
}

vtkSmartPointer<vtkDataObject> MakeSurface(const granular::VtkSurface& surface)
{
  auto made = vtkSmartPointer<vtkPolyData>::New();
  const auto values = ArrayOf<vtkDoubleArray>("Points", surface.points);
  values->SetNumberOfComponents(3);
  vtkNew<vtkPoints> points;
  points->SetData(values);
  made->SetPoints(points);
  constexpr void (vtkPolyData::*parts[])(vtkCellArray*) = { &vtkPolyData::SetVerts,
    &vtkPolyData::SetLines, &vtkPolyData::SetPolys, &vtkPolyData::SetStrips };
  for (std::size_t i = 0; i < surface.parts.size(); ++i)
  {
    const granular::VtkCells& part = surface.parts[i];
    if (part.offsets.size() > 1)
    {
      vtkNew<vtkCellArray> cells;
      cells->SetData(ArrayOf<vtkTypeInt64Array>(nullptr, part.offsets),
        ArrayOf<vtkTypeInt64Array>(nullptr, part.connectivity));
      (made->*parts[i])(cells);
    }
  }
  AddArrays(made, surface);
  return made;
}

std::string HeadOf(const std::string& path)
{
  constexpr std::int64_t enough = 16;
  return granular::read_up_to(*granular::unpack(granular::open_file(path)), enough);
}

bool IsLegacy(const std::string& head)
{
  return head.starts_with(granular::legacy_vtk_mark);
}

/**
 * VTK does not tell where a legacy file is cut: the core looks through all surfaces.
 */
vtkSmartPointer<vtkDataObject> ReadFile(
  const std::string& path, bool cells, granular::Progress& progress)
{
  const std::string head = HeadOf(path);
  if (head.starts_with('<'))
  {
    return Run<vtkXMLGenericDataObjectReader>(path);
  }
  if (!IsLegacy(head))
  {
    return head.starts_with("ply") ? Run<vtkPLYReader>(path) : Run<vtkSTLReader>(path);
  }
  const auto source = granular::unpack(granular::open_file(path));
  granular::LegacyVtk file(*source, {}, granular::LegacyVtk::no_end, progress);
  const granular::VtkHeader header = file.read_header();
  if (header.dataset == granular::vtk_points)
  {
    file.go_to(header.place);
    const granular::VtkSurface surface = granular::read_surface(
      file, cells ? granular::SurfaceRead::All : granular::SurfaceRead::Points);
    if (!surface.has_others)
    {
      return MakeSurface(surface);
    }
  }
  return Run<vtkGenericDataObjectReader>(path);
}
}

int FindDataType(const std::string& path)
{
  const std::string head = HeadOf(path);
  int type = VTK_POLY_DATA;
  if (head.starts_with('<'))
  {
    bool parallel = false;
    type = vtkNew<vtkXMLGenericDataObjectReader>()->ReadOutputType(path.c_str(), parallel);
  }
  else if (IsLegacy(head))
  {
    vtkNew<vtkGenericDataObjectReader> reader;
    reader->SetFileName(path.c_str());
    type = reader->ReadOutputType();
  }
  return type < 0 ? VTK_POLY_DATA : type; // a compressed file
}

vtkSmartPointer<vtkDataObject> ReadData(
  const std::vector<granular::FramePiece>& pieces, bool cells, granular::Progress& progress)
{
  vtkNew<vtkAppendDataSets> all;
  vtkSmartPointer<vtkDataObject> data;
  for (const granular::FramePiece& piece : pieces)
  {
    data = ReadFile(piece.file.path, cells, progress);
    auto* const set = vtkPointSet::SafeDownCast(data);
    for (const char* name : { "id1", "id2" }) // of contacts, which LIGGGHTS writes as doubles
    {
      if (vtkDataArray* const ids = set ? set->GetCellData()->GetArray(name) : nullptr)
      {
        vtkNew<vtkTypeInt64Array> whole;
        whole->DeepCopy(ids);
        whole->SetName(name);
        set->GetCellData()->AddArray(whole); // instead of the other
      }
    }
    if (set && set->GetNumberOfPoints() > 0) // others may lack arrays
    {
      all->AddInputData(set);
    }
  }
  if (pieces.size() == 1 || all->GetNumberOfInputConnections(0) == 0)
  {
    return data;
  }
  all->SetOutputDataSetType(data->GetDataObjectType());
  all->Update();
  return all->GetOutputDataObject(0);
}

vtkSmartPointer<vtkDataObject> TakeBlock(vtkDataObject* blocks, const char* name)
{
  auto* const set = vtkMultiBlockDataSet::SafeDownCast(blocks);
  for (unsigned int i = set ? set->GetNumberOfBlocks() : 0; i-- > 0;)
  {
    const char* const given =
      set->HasMetaData(i) ? set->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
    if (given && std::string_view(given) == name)
    {
      const vtkSmartPointer<vtkDataObject> block = set->GetBlock(i);
      set->RemoveBlock(i);
      return block;
    }
  }
  return nullptr;
}

std::optional<granular::Box> ReadVtkBox(vtkDataObject* block, const std::string& path)
{
  const std::string file = block ? std::string() : granular::find_box_file(path);
  granular::Progress progress;
  vtkSmartPointer<vtkDataObject> data = block;
  data = file.empty() ? data : ReadFile(file, true, progress);
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    const double* const b = grid->GetBounds();
    return granular::Box::from_bounds({ b[0], b[2], b[4] }, { b[1], b[3], b[5] });
  }
  auto* const cell = vtkPointSet::SafeDownCast(data);
  if (!cell || cell->GetNumberOfPoints() != 8) // no hexahedron
  {
    return {};
  }
  std::array<granular::Vector3, 4> corners; // the first one, and those along its edges
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    constexpr vtkIdType numbers[] = { 0, 1, 3, 4 };
    cell->GetPoint(numbers[i], corners[i].data());
    for (std::size_t axis = 0; i > 0 && axis < 3; ++axis)
    {
      corners[i][axis] -= corners[0][axis];
    }
  }
  return granular::Box::from_edges(corners[0], { corners[1], corners[2], corners[3] });
}

void FillVtkParticles(vtkPolyData* output, vtkPointSet* from, vtkIdType first, vtkIdType last)
{
  const auto take = [&](vtkAbstractArray* array)
  {
    auto made = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    auto* const numbers = vtkAOSDataArrayTemplate<int>::FastDownCast(array);
    if (numbers && array == from->GetPointData()->GetAbstractArray("id"))
    {
      made = ArrayOf<vtkTypeInt64Array>(
        "id", std::span(numbers->GetPointer(first), static_cast<std::size_t>(last - first)));
    }
    else if (last - first == array->GetNumberOfTuples())
    {
      made = array;
    }
    else
    {
      made->SetName(array->GetName());
      made->SetNumberOfComponents(array->GetNumberOfComponents());
      made->InsertTuples(0, last - first, first, array);
    }
    return made;
  };
  vtkNew<vtkPoints> points;
  if (from->GetPoints())
  {
    points->SetData(vtkDataArray::SafeDownCast(take(from->GetPoints()->GetData())));
  }
  output->SetPoints(points);
  vtkPointData* const data = output->GetPointData();
  for (int i = 0; i < from->GetPointData()->GetNumberOfArrays(); ++i)
  {
    data->AddArray(take(from->GetPointData()->GetAbstractArray(i)));
  }
  data->SetActivePedigreeIds("id");
  vtkDataArray* const diameter = data->GetArray("diameter");
  if (diameter && !data->GetArray("radius"))
  {
    data->AddArray(ArrayOf<vtkDoubleArray>(
      "radius", vtk::DataArrayValueRange<1>(diameter), [](double value) { return value / 2; }));
  }
}

std::size_t FindFilled(const granular::RunIndex& index, std::size_t frame)
{
  std::size_t next = frame;
  while (++next < index.size())
  {
    if (index.first_piece(next).entry.end > index.first_piece(frame).entry.end)
    {
      return next;
    }
  }
  return frame;
}
}
