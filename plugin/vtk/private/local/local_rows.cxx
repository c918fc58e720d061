// SPDX-License-Identifier: BSD-3-Clause
#include "private/local/local_rows.h"

#include "private/arrays/arrays.h"
#include "private/dump/input_frames.h"
#include "private/local/lines.h"

#include "granular/common/error.h"
#include "granular/frames/run_index.h"
#include "granular/lines/fetch_particles.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"

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
#include <array>
#include <cstring>
#include <iterator>
#include <numeric>

namespace vtkGranularPrivate
{
namespace
{
std::optional<std::int64_t> TimestepOf(vtkFieldData* data)
{
  vtkDataArray* timestep = data->GetArray("timestep");
  return timestep && timestep->GetNumberOfValues() == 1
    ? std::optional<std::int64_t>(timestep->GetVariantValue(0).ToTypeInt64())
    : std::nullopt;
}
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
  vtkIdType count = 0;
  if (auto* lines = vtkDataSet::SafeDownCast(input))
  {
    count = lines->GetNumberOfCells();
    this->Data = lines->GetCellData();
    this->MayBeSplit = true;
  }
  else if (auto* table = vtkTable::SafeDownCast(input))
  {
    count = table->GetNumberOfRows();
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
  this->AllTuples = count;
  this->FindTuples();
}

void LocalRows::FindTuples()
{
  const char* const name = vtkDataSetAttributes::GhostArrayName();
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(this->Data->GetAbstractArray(name));
  vtkDataArray* parts = this->HasParts() ? this->Data->GetArray(PartArray) : nullptr;
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(ghosts), parts })
  {
    if (array)
    {
      this->Arrays.CheckTuples(array, array->GetName(), this->AllTuples);
      this->AreAll = false;
    }
  }
  for (vtkIdType tuple = 0; !this->AreAll && tuple < this->AllTuples; ++tuple)
  {
    const bool duplicate =
      ghosts && (ghosts->GetValue(tuple) & vtkDataSetAttributes::DUPLICATECELL) != 0;
    if (!duplicate && (!parts || parts->GetComponent(tuple, 0) == 0))
    {
      this->Tuples.push_back(tuple);
    }
  }
}

bool LocalRows::LackPlaces() const
{
  auto* columns = vtkStringArray::SafeDownCast(this->Field->GetAbstractArray("Columns"));
  return this->AllTuples == 0 && this->Data->GetNumberOfArrays() == 0 && columns &&
    columns->GetNumberOfValues() > 0 && columns->LookupValue("x1") < 0;
}

std::vector<vtkIdType> LocalRows::FindBegins() const
{
  if (!this->AreAll)
  {
    return this->Tuples;
  }
  std::vector<vtkIdType> all(static_cast<std::size_t>(this->AllTuples));
  std::iota(all.begin(), all.end(), vtkIdType{ 0 });
  return all;
}

std::vector<vtkIdType> LocalRows::FindEnds() const
{
  std::vector<vtkIdType> ends = this->FindBegins();
  vtkDataArray* parts = this->HasParts() ? this->Data->GetArray(PartArray) : nullptr;
  vtkIdType later = 0; // parts but the first of each line
  for (vtkIdType tuple = 0; parts && tuple < this->AllTuples; ++tuple)
  {
    later += parts->GetComponent(tuple, 0) != 0 ? 1 : 0;
  }
  for (vtkIdType& end : ends)
  {
    while (later > 0 && end + 1 < this->AllTuples &&
      parts->GetComponent(end + 1, 0) == parts->GetComponent(end, 0) + 1)
    {
      ++end;
      --later;
    }
  }
  if (later > 0)
  {
    throw granular::Error("expected the parts of each line one after the other, got " +
      std::to_string(later) +
      " of other lines or places: with PeriodicLines MinimumImage lines are whole");
  }
  return ends;
}

void LocalRows::Keep(std::pair<vtkTypeInt64, vtkTypeInt64> range)
{
  std::vector<vtkIdType> kept;
  for (vtkTypeInt64 row = range.first; row < range.second; ++row)
  {
    kept.push_back(this->TupleOf(row));
  }
  this->AreAll = this->AreAll && std::ssize(kept) == this->AllTuples;
  this->Tuples = std::move(kept);
}

bool LocalRows::Has(const char* name) const
{
  return this->Data->HasArray(name) != 0;
}

bool LocalRows::HasNumbers(const char* name) const
{
  vtkDataArray* array = this->Data->GetArray(name);
  return array && array->GetNumberOfComponents() == 1;
}

bool LocalRows::HasParts() const
{
  const int type = this->MayBeSplit && this->HasNumbers(PartArray)
    ? this->Data->GetArray(PartArray)->GetDataType()
    : VTK_DOUBLE;
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

granular::ArrayView LocalRows::See(const char* name, int numbers)
{
  vtkAbstractArray* array = this->Data->GetAbstractArray(name);
  if (!array)
  {
    throw granular::Error("expected an array '" + std::string(name) + "' of the lines, got none");
  }
  const auto view = this->Arrays.See(array, name, this->AllTuples);
  if (!view || view->type == granular::ValueType::Text || view->size() != numbers)
  {
    throw granular::Error("expected " + std::string(numbers == 1 ? "one number" : "3 numbers") +
      " a row in the array '" + std::string(name) + "' of the lines, got " +
      (view && view->type != granular::ValueType::Text
          ? std::to_string(view->size())
          : std::string("the type ") + array->GetDataTypeAsString()));
  }
  return *view;
}

std::span<const double> LocalRows::ReadTuples(
  const char* name, int numbers, std::vector<double>& own)
{
  const auto rows = static_cast<std::size_t>(this->Count());
  const auto width = static_cast<std::size_t>(numbers);
  if (rows == 0)
  {
    return {};
  }
  const granular::ArrayView view = this->See(name, numbers);
  const auto* const first = static_cast<const double*>(view.components[0]);
  if (this->AreAll && view.type == granular::ValueType::Float64 && view.step == numbers &&
    (numbers == 1 || view.are_triples()))
  {
    return { first, rows * width };
  }
  own.resize(rows * width);
  std::array<std::int64_t, 1024> tuples; // at once, which stay in the cache
  std::array<double, 1024> values;
  for (std::size_t begin = 0; begin < rows; begin += tuples.size())
  {
    const std::size_t some = std::min(tuples.size(), rows - begin);
    for (std::size_t i = 0; i < some; ++i)
    {
      tuples[i] = this->TupleOf(static_cast<std::int64_t>(begin + i));
    }
    for (std::size_t k = 0; k < width; ++k)
    {
      granular::load_numbers(
        granular::component_of(view, static_cast<int>(k)), { tuples.data(), some }, values.data());
      for (std::size_t i = 0; i < some; ++i)
      {
        own[(begin + i) * width + k] = values[i];
      }
    }
  }
  return own;
}

std::vector<std::int64_t> LocalRows::ReadIds(const char* name, granular::Progress& progress)
{
  std::vector<std::int64_t> ids;
  if (this->Count() == 0)
  {
    return ids;
  }
  const granular::Ids all(this->See(name), this->AllTuples, granular::Executor(), progress);
  if (this->AreAll)
  {
    ids.assign(all.values().begin(), all.values().end());
    return ids;
  }
  std::ranges::transform(this->Tuples, std::back_inserter(ids),
    [&](vtkIdType tuple) { return all.values()[static_cast<std::size_t>(tuple)]; });
  return ids;
}

void LocalRows::Pass(
  const std::vector<std::int64_t>& rows, vtkIdType count, vtkDataSetAttributes* to) const
{
  const bool same = this->AreAll && rows.empty() && count == this->AllTuples;
  vtkNew<vtkIdList> tuples;
  tuples->SetNumberOfIds(same ? 0 : count);
  for (vtkIdType i = 0; i < tuples->GetNumberOfIds(); ++i)
  {
    tuples->SetId(i, this->TupleOf(rows.empty() ? i : rows[static_cast<std::size_t>(i)]));
  }
  this->PassTuples(same ? nullptr : tuples.Get(), to);
}

void LocalRows::PassCells(const std::vector<std::int64_t>& cells, vtkDataSetAttributes* to) const
{
  vtkNew<vtkIdList> tuples;
  tuples->SetNumberOfIds(std::ssize(cells));
  std::ranges::copy(cells, tuples->begin());
  this->PassTuples(tuples, to);
}

ChosenCells LocalRows::AddLines(
  vtkPointSet* input, const std::vector<std::int64_t>& rows, vtkPolyData* output) const
{
  ChosenCells cells;
  const std::vector<vtkIdType> begins = this->FindBegins();
  const std::vector<vtkIdType> ends = this->FindEnds();
  for (const std::int64_t row : rows)
  {
    const auto at = static_cast<std::size_t>(row);
    for (vtkIdType cell = begins[at]; cell <= ends[at]; ++cell)
    {
      cells.All.push_back(cell);
      cells.Rows.push_back(row);
    }
  }
  if (!output->GetPoints())
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    output->SetPoints(points);
    output->SetLines(vtkNew<vtkCellArray>());
  }
  vtkNew<vtkIdList> corners;
  for (const std::int64_t cell : cells.All)
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
  return cells;
}

/**
 * Null: all.
 */
void LocalRows::PassTuples(vtkIdList* tuples, vtkDataSetAttributes* to) const
{
  for (int i = 0; i < this->Data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* from = this->Data->GetAbstractArray(i);
    const char* name = from->GetName();
    if (!name || !*name || std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue;
    }
    this->Arrays.CheckTuples(from, name, this->AllTuples);
    to->AddArray(tuples ? TakeTuples(from, tuples).Get() : from);
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
  const auto ofParticles = TimestepOf(particles);
  const auto ofRows = TimestepOf(rows);
  return !ofParticles || !ofRows || *ofParticles == *ofRows ? std::string()
                                                            : "the particles are of timestep " +
      std::to_string(*ofParticles) + ", the lines of " + std::to_string(*ofRows);
}
}
