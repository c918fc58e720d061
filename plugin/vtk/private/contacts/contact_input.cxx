// SPDX-License-Identifier: BSD-3-Clause
#include "private/contacts/contact_input.h"

#include "private/dump/dump_input.h"

#include "granular/common/error.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

namespace vtkGranularPrivate
{
namespace
{
/**
 * Adds what a cell spans to the way from the first end to the second; sets the first end for the first cell of a line.
 */
void AddCell(vtkPointSet* lines, const std::vector<double>& points, vtkIdType cell, bool first,
  vtkIdList* ids, double* ends)
{
  CheckLine(lines, cell);
  lines->GetCellPoints(cell, ids);
  const double* const from = points.data() + 3 * ids->GetId(0);
  const double* const to = points.data() + 3 * ids->GetId(ids->GetNumberOfIds() - 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    ends[axis] = first ? from[axis] : ends[axis];
    ends[3 + axis] = first ? to[axis] : ends[3 + axis] + (to[axis] - from[axis]);
  }
}

/**
 * Returns true if the points are the ends of one line after the other, as those who draw lines leave them.
 */
bool AreEndsInOrder(vtkPointSet* input)
{
  auto* data = vtkPolyData::SafeDownCast(input);
  vtkCellArray* const lines = data ? data->GetLines() : nullptr;
  const vtkIdType points = input->GetNumberOfPoints();
  if (!lines || lines->GetNumberOfCells() != input->GetNumberOfCells() ||
    points != 2 * lines->GetNumberOfCells() || lines->IsHomogeneous() != 2)
  {
    return false;
  }
  const auto isOrdered = [&](const auto& ids)
  {
    vtkIdType next = 0;
    while (next < points && ids[next] == next)
    {
      ++next;
    }
    return next == points;
  };
  vtkDataArray* const ids = lines->GetConnectivityArray();
  if (auto* const narrow = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(ids))
  {
    return isOrdered(narrow->GetPointer(0));
  }
  if (auto* const wide = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(ids))
  {
    return isOrdered(wide->GetPointer(0));
  }
  return isOrdered(vtk::DataArrayValueRange<1>(ids)); // from VTK 9.6 on there may be others
}
}

ContactInput::ContactInput(
  vtkDataObject* input, bool walls, const ContactArrays& wanted, granular::Progress& progress)
  : Rows(input)
{
  this->View.count = static_cast<std::size_t>(this->Rows.Count());
  this->View.box = FindBox(input->GetFieldData());
  if (this->View.count == 0)
  {
    return;
  }
  if (!walls)
  {
    this->Ids[0] = this->Rows.ReadIds("id1", progress);
    this->View.id1 = this->Ids[0];
  }
  else if (this->Rows.Has("id1"))
  {
    throw granular::Error("expected contacts with walls as Walls, got an array 'id1' of a second "
                          "particle: contacts between particles are Lines");
  }
  this->Ids[1] = this->Rows.ReadIds("id2", progress);
  this->View.id2 = this->Ids[1];
  this->ReadEnds(input);
  this->ReadForces(wanted);
  const auto read = [&](
                      bool is, const char* name, int numbers, std::vector<double>& own, auto member)
  {
    if (is && this->Rows.Has(name))
    {
      this->View.*member = this->Rows.ReadTuples(name, numbers, own);
    }
  };
  using View = granular::ContactRows;
  read(wanted.Tangential, "force_tangential", 3, this->Tangential, &View::tangential);
  read(wanted.Torque, "torque", 3, this->Torque, &View::torque);
  const bool place = wanted.Point || (walls && this->Ends.empty());
  read(place, "contact_point", 3, this->Point, &View::contact_point);
  read(wanted.Overlap, "delta", 1, this->Overlap, &View::overlap);
}

void ContactInput::ReadEnds(vtkDataObject* input)
{
  auto* lines = vtkPointSet::SafeDownCast(input);
  if (!lines)
  {
    return;
  }
  std::vector<double> points = ReadAbsolutePoints(lines);
  if (this->Rows.AreAllCells() && AreEndsInOrder(lines))
  {
    this->Ends = std::move(points);
    this->View.ends = this->Ends;
    return;
  }
  const std::vector<std::int64_t> begins = this->Rows.FindBegins();
  const std::vector<std::int64_t> ends = this->Rows.FindEnds();
  this->Ends.resize(6 * begins.size());
  vtkNew<vtkIdList> ids;
  for (std::size_t row = 0; row < begins.size(); ++row)
  {
    for (vtkIdType cell = begins[row]; cell <= ends[row]; ++cell)
    {
      AddCell(lines, points, cell, cell == begins[row], ids, this->Ends.data() + 6 * row);
    }
  }
  this->View.ends = this->Ends;
}

void ContactInput::ReadForces(const ContactArrays& wanted)
{
  if (wanted.Force && this->Rows.Has("force"))
  {
    this->View.force = this->Rows.ReadTuples("force", 3, this->Force);
  }
  else if (wanted.Force && this->Rows.Has("force_normal"))
  {
    std::vector<double> own;
    const std::span<const double> normal = this->Rows.ReadTuples("force_normal", 3, own);
    this->Force.assign(normal.begin(), normal.end());
    if (this->Rows.Has("force_tangential"))
    {
      const std::span<const double> across = this->Rows.ReadTuples("force_tangential", 3, own);
      std::ranges::transform(this->Force, across, this->Force.begin(), std::plus<>());
    }
    else if (wanted.Tangential)
    {
      throw granular::Error("expected an array 'force_tangential' or 'force' of the contacts for "
                            "mobilised_friction, got 'force_normal' alone");
    }
    this->View.force = this->Force;
  }
}

ContactInputs::ContactInputs(const std::array<vtkDataObject*, 2>& inputs,
  const ContactArrays& wanted, granular::Progress& progress)
{
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    if (inputs[port])
    {
      this->Rows.push_back(
        this->Each[port].emplace(inputs[port], port == 1, wanted, progress).GetRows());
    }
  }
}
}
