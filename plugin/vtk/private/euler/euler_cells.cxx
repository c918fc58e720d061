// SPDX-License-Identifier: BSD-3-Clause
#include "private/euler/euler_cells.h"

#include "private/arrays/arrays.h"
#include "private/request/request_task.h"

#include "granular/common/error.h"
#include "granular/common/words.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <string>
#include <string_view>

namespace vtkGranularPrivate
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{
vtkSmartPointer<vtkDoubleArray> MakeArray(const granular::EulerValues& values, vtkIdType cells)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(values.name.c_str());
  array->SetNumberOfComponents(values.components);
  array->SetNumberOfTuples(cells);
  const auto* const tensor =
    std::ranges::find(granular::tensor_arrays, values.name, &granular::TensorArray::name);
  if (tensor != std::end(granular::tensor_arrays))
  {
    int component = 0;
    for (const std::string_view name : granular::split_words(tensor->components))
    {
      if (component < values.components)
      {
        array->SetComponentName(component++, std::string(name).c_str());
      }
    }
  }
  return array;
}

/**
 * Adds an array; which one is shown first and which is a vector is as in VTK's own reader of such files.
 */
void AddArray(vtkDataSetAttributes* data, vtkDoubleArray* array)
{
  data->AddArray(array);
  if (array->GetNumberOfComponents() == 1 && std::string_view(array->GetName()) == "volumefraction")
  {
    data->SetActiveScalars(array->GetName());
  }
  if (array->GetNumberOfComponents() == 3 && std::string_view(array->GetName()) == "v_avg")
  {
    data->SetActiveVectors(array->GetName());
  }
}

bool IsEmpty(const CellExtent& extent)
{
  return extent[0] >= extent[1] || extent[2] >= extent[3] || extent[4] >= extent[5];
}
}

CellExtent ExtentOf(const granular::EulerGrid& grid)
{
  CellExtent extent = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (grid.counts[axis] >= VTK_INT_MAX)
    {
      throw granular::LimitError("expected fewer than " + std::to_string(VTK_INT_MAX) +
        " cells along each axis, got " + std::to_string(grid.counts[axis]) + " along " +
        "xyz"[axis]);
    }
    extent[2 * axis + 1] = static_cast<int>(grid.counts[axis]);
  }
  return extent;
}

void OfferExtent(vtkInformation* output, const CellExtent& whole)
{
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  output->Set(Pipeline::WHOLE_EXTENT(), whole.data(), 6);
  output->Set(Pipeline::UNRESTRICTED_UPDATE_EXTENT(), 1);
}

CellExtent AskedExtent(vtkInformation* output, const CellExtent& whole)
{
  CellExtent asked = whole;
  if (output->Has(Pipeline::UPDATE_EXTENT()))
  {
    output->Get(Pipeline::UPDATE_EXTENT(), asked.data());
  }
  bool within = true;
  for (std::size_t k = 0; k < 6; k += 2)
  {
    within = within && asked[k] >= whole[k] && asked[k + 1] <= whole[k + 1];
  }
  if (!within)
  {
    const PieceRequest piece = PieceRequest::Of(output);
    const int ghosts = output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
    CellExtent all = whole;
    vtkNew<vtkExtentTranslator>()->PieceToExtentThreadSafe(piece.Piece, piece.Pieces, ghosts,
      all.data(), asked.data(), vtkExtentTranslator::BLOCK_MODE, 0);
  }
  return asked;
}

void AddArrays(vtkDataSetAttributes* data, const granular::EulerFrame& frame, vtkIdType count,
  vtkTypeInt64 begin)
{
  for (const granular::EulerValues& values : frame.arrays)
  {
    const auto array = MakeArray(values, count);
    std::copy_n(values.values.begin() + begin * values.components, count * values.components,
      array->GetPointer(0));
    AddArray(data, array);
  }
}

void FillPoints(vtkPolyData* output, const granular::EulerFrame& frame, vtkTypeInt64 begin,
  vtkTypeInt64 end, const granular::Vector3& pointOrigin)
{
  const vtkIdType count = end - begin;
  vtkNew<vtkDoubleArray> centres;
  centres->SetName("Points");
  centres->SetNumberOfComponents(3);
  centres->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < 3 * count; ++i)
  {
    centres->SetValue(i, frame.centres[3 * begin + i] - pointOrigin[i % 3]);
  }
  vtkNew<vtkPoints> points;
  points->SetData(centres);
  output->SetPoints(points);
  output->SetVerts(MakeCells(count, 1));
  AddArrays(output->GetPointData(), frame, count, begin);
}

void FillTable(vtkTable* output, const granular::EulerFrame& frame, vtkTypeInt64 begin,
  vtkTypeInt64 end, int axis)
{
  output->GetRowData()->AddArray(ArrayOf<vtkDoubleArray>("position", std::views::iota(begin, end),
    [&](vtkTypeInt64 cell) { return frame.centres[static_cast<std::size_t>(3 * cell + axis)]; }));
  AddArrays(output->GetRowData(), frame, end - begin, begin);
}

void FillImage(vtkImageData* output, const granular::EulerGrid& grid, const CellExtent& extent,
  const granular::EulerFrame& frame, const HeldCells& held, const granular::Vector3& pointOrigin)
{
  const bool empty = IsEmpty(extent);
  if (!empty)
  {
    output->SetOrigin(
      grid.lo[0] - pointOrigin[0], grid.lo[1] - pointOrigin[1], grid.lo[2] - pointOrigin[2]);
    output->SetSpacing(grid.spacing(0), grid.spacing(1), grid.spacing(2));
    output->SetExtent(const_cast<int*>(extent.data()));
  }
  const vtkIdType nx = empty ? 0 : extent[1] - extent[0];
  const vtkIdType ny = empty ? 0 : extent[3] - extent[2];
  const vtkIdType nz = empty ? 0 : extent[5] - extent[4];
  const vtkTypeInt64 heldX = held.Extent[1] - held.Extent[0];
  const vtkTypeInt64 heldY = held.Extent[3] - held.Extent[2];
  for (const granular::EulerValues& values : frame.arrays)
  {
    const auto array = MakeArray(values, nx * ny * nz);
    double* to = array->GetPointer(0);
    for (vtkIdType line = 0; line < ny * nz; ++line)
    {
      const vtkTypeInt64 y = extent[2] - held.Extent[2] + line % ny;
      const vtkTypeInt64 z = extent[4] - held.Extent[4] + line / ny;
      const vtkTypeInt64 first = held.First + (z * heldY + y) * heldX + extent[0] - held.Extent[0];
      to =
        std::copy_n(values.values.begin() + first * values.components, nx * values.components, to);
    }
    AddArray(output->GetCellData(), array);
  }
}
}
