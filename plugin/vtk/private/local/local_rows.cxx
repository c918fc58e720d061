// SPDX-License-Identifier: BSD-3-Clause
#include "private/local/local_rows.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"
#include "private/dump/input_frames.h"

#include "granular/common/error.h"
#include "granular/frames/run_index.h"

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace vtkGranularPrivate
{
std::optional<std::int64_t> TimestepOf(vtkFieldData* data)
{
  vtkDataArray* timestep = data->GetArray("timestep");
  return timestep && timestep->GetNumberOfValues() == 1
    ? std::optional<std::int64_t>(timestep->GetVariantValue(0).ToTypeInt64())
    : std::nullopt;
}

void CheckLine(vtkDataSet* data, vtkIdType cell)
{
  const int type = data->GetCellType(cell);
  if (type != VTK_LINE && type != VTK_POLY_LINE)
  {
    throw granular::UnsupportedError("expected lines as cells, got a cell of the VTK type " +
      std::to_string(type) + " in row " + std::to_string(cell) + " (the first is 0)");
  }
}

LocalRows::LocalRows(vtkDataObject* input)
{
  auto* lines = vtkDataSet::SafeDownCast(input);
  if (lines)
  {
    this->Cells.rows = lines->GetNumberOfCells();
    this->Data = lines->GetCellData();
  }
  else if (auto* table = vtkTable::SafeDownCast(input))
  {
    this->Cells.rows = table->GetNumberOfRows();
    this->Data = table->GetRowData();
  }
  else
  {
    throw granular::UnsupportedError(
      "expected lines as cells of a vtkDataSet, or a vtkTable with a row for each, got " +
      (input ? std::string("a ") + input->GetClassName() : "nothing") +
      (vtkCompositeDataSet::SafeDownCast(input) ? ": the filter MergeBlocks makes one of it" : ""));
  }
  this->Field = input->GetFieldData();
  const auto box = FindBox(this->Field);
  this->Cells.has_box = box.has_value();
  this->Cells.header.box = box.value_or(granular::Box{});
  auto* columns = vtkStringArray::SafeDownCast(this->Field->GetAbstractArray("Columns"));
  for (vtkIdType i = 0; columns && i < columns->GetNumberOfValues(); ++i)
  {
    this->Cells.columns.push_back(columns->GetValue(i));
  }
  const char* const ghosts = vtkDataSetAttributes::GhostArrayName();
  for (int i = 0; i < this->Data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = this->Data->GetAbstractArray(i);
    const char* name = array->GetName();
    auto* marks = vtkUnsignedCharArray::SafeDownCast(array);
    if (!name || !*name)
    {
      continue;
    }
    auto view = this->Arrays.See(array, name, this->Cells.rows);
    if (marks && std::strcmp(name, ghosts) == 0)
    {
      this->Cells.ghosts = marks->GetPointer(0);
    }
    else if (view && std::strcmp(name, ghosts) != 0)
    {
      this->Cells.arrays.push_back(std::move(*view));
    }
  }
  this->Rows.emplace(this->Cells, lines != nullptr);
}

void LocalRows::PassCells(
  const std::vector<std::int64_t>& cells, vtkDataSetAttributes* to, bool all) const
{
  vtkNew<vtkIdList> tuples;
  tuples->SetNumberOfIds(std::ssize(cells));
  std::ranges::copy(cells, tuples->begin());
  for (int i = 0; i < this->Data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* from = this->Data->GetAbstractArray(i);
    const char* name = from->GetName();
    if (name && *name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) != 0)
    {
      to->AddArray(all ? from : TakeTuples(from, tuples).Get());
    }
  }
}

ChosenCells LocalRows::AddLines(
  vtkPointSet* input, const std::vector<std::int64_t>& rows, vtkPolyData* output) const
{
  ChosenCells cells;
  const std::vector<std::int64_t> begins = this->FindBegins();
  const std::vector<std::int64_t> ends = this->FindEnds();
  for (const std::int64_t row : rows)
  {
    const auto at = static_cast<std::size_t>(row);
    for (vtkIdType cell = begins[at]; cell <= ends[at]; ++cell)
    {
      cells.All.push_back(cell);
      cells.Rows.push_back(row);
    }
  }
  vtkGranularPrivate::AddLines(input, cells.All, output);
  return cells;
}

void AddLines(vtkPointSet* input, const std::vector<std::int64_t>& cells, vtkPolyData* output)
{
  if (!output->GetPoints())
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    output->SetPoints(points);
    output->SetLines(vtkNew<vtkCellArray>());
  }
  vtkNew<vtkIdList> corners;
  for (const std::int64_t cell : cells)
  {
    CheckLine(input, cell);
    input->GetCellPoints(cell, corners);
    output->GetLines()->InsertNextCell(static_cast<int>(corners->GetNumberOfIds()));
    for (const vtkIdType corner : *corners)
    {
      output->GetLines()->InsertCellPoint(
        output->GetPoints()->InsertNextPoint(input->GetPoint(corner)));
    }
  }
}

vtkSmartPointer<vtkDataObject> RowsOfTimestep(vtkAlgorithm* consumer, int port,
  vtkDataObject* particles, const PieceRequest& piece, granular::Communicator& ranks)
{
  constexpr int most = 3; // the first guess may have to do with a timestep of 0
  vtkSmartPointer<vtkDataObject> best = consumer->GetInputDataObject(port, 0);
  const auto wanted = TimestepOf(particles->GetFieldData());
  auto there = TimestepOf(best->GetFieldData());
  std::int64_t differ = wanted && there && *wanted != *there ? 1 : 0;
  ranks.sum({ &differ, 1 });
  if (differ < ranks.size())
  {
    return best;
  }
  InputFrames input(consumer, { piece.Piece, piece.Pieces, 0 }, port);
  const std::vector<double> times = input.GetTimes();
  for (int guess = 0; guess < most; ++guess)
  {
    const auto step = TimestepOf(input.GetData()->GetFieldData());
    const std::optional<double> time = input.GetTime();
    std::string next; // frame, as the first rank guesses
    if (times.size() > 1 && step && time && *step != *wanted)
    {
      const double scale = *step == 0 ? 1 : *time / static_cast<double>(*step);
      const std::size_t frame =
        granular::RunIndex::find(times, static_cast<double>(*wanted) * scale);
      next = times[frame] == *time ? next : std::to_string(frame);
    }
    ranks.broadcast(next, 0);
    if (next.empty())
    {
      break;
    }
    input.Update(times[std::stoul(next)], ranks);
    const auto found = TimestepOf(input.GetData()->GetFieldData());
    if (found && *found <= *wanted && (*there > *wanted || *found > *there))
    {
      there = found;
      best.TakeReference(input.GetData()->NewInstance());
      best->ShallowCopy(input.GetData());
    }
  }
  input.Restore(ranks);
  return best;
}

std::string CompareTimesteps(vtkFieldData* particles, vtkFieldData* rows)
{
  return granular::compare_timesteps(TimestepOf(particles), TimestepOf(rows));
}
}
