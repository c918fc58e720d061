// SPDX-License-Identifier: BSD-3-Clause
#include "private/dump/dump_input.h"

#include "private/request/guard.h"

#include "granular/common/error.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/frame_view.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The values of a field array, if it has just so many.
 */
std::optional<std::vector<double>> FindDoubles(vtkFieldData* data, const char* name, int count)
{
  vtkDataArray* array = data->GetArray(name);
  if (!array || array->GetNumberOfValues() != count)
  {
    return {};
  }
  std::vector<double> values;
  for (vtkIdType i = 0; i < count; ++i)
  {
    values.push_back(array->GetComponent(
      i / array->GetNumberOfComponents(), static_cast<int>(i % array->GetNumberOfComponents())));
  }
  return values;
}

std::vector<std::string> FindTexts(vtkFieldData* data, const char* name)
{
  std::vector<std::string> texts;
  auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    texts.push_back(array->GetValue(i));
  }
  return texts;
}

std::string FindText(vtkFieldData* data, const char* name)
{
  const std::vector<std::string> texts = FindTexts(data, name);
  return texts.empty() ? std::string() : texts.front();
}

/**
 * Returns true if two boxes have the same numbers, once they are rounded.
 */
bool AreAlike(const granular::Box& a, const granular::Box& b)
{
  using granular::Twofold;
  const auto alike = [](const granular::Twofold3& x, const granular::Twofold3& y)
  { return std::ranges::equal(x, y, {}, &Twofold::value, &Twofold::value); };
  return alike(a.origin, b.origin) && std::ranges::equal(a.vectors, b.vectors, alike);
}
}

granular::Box MakeBox(const double origin[3], const double vectors[9])
{
  std::array<granular::Vector3, 3> edges;
  for (std::size_t i = 0; i < 3; ++i)
  {
    edges[i] = { vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2] };
  }
  return granular::Box::from_edges({ origin[0], origin[1], origin[2] }, edges);
}

std::optional<granular::Box> FindBox(vtkFieldData* data)
{
  const auto origin = FindDoubles(data, "BoxOrigin", 3);
  const auto vectors = FindDoubles(data, "BoxVectors", 9);
  if (!origin || !vectors)
  {
    return {};
  }
  const bool tilted = FindDoubles(data, "BoxBounds", 9).has_value();
  granular::Box box = MakeBox(origin->data(), vectors->data());
  if (const auto bounds = FindDoubles(data, "BoxBounds", tilted ? 9 : 6))
  {
    const std::vector<double>& b = *bounds;
    const granular::Vector3 lo = { b[0], b[2], b[4] };
    const granular::Vector3 hi = { b[1], b[3], b[5] };
    const granular::Box exact = tilted ? granular::Box::from_tilted_bounds(lo, hi, b[6], b[7], b[8])
                                       : granular::Box::from_bounds(lo, hi);
    box = AreAlike(exact, box) ? exact : box;
  }
  box.boundary = FindText(data, "Boundary");
  return box;
}

RowsInput::RowsInput(vtkDataObject* input, std::int64_t count, const char* rows)
  : Arrays(rows)
{
  this->View.rows = count;
  this->ReadFieldData(input->GetFieldData());
}

void RowsInput::SeeArrays(vtkDataSetAttributes* data, granular::Notices& notices)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const char* name = array->GetName();
    if (name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue;
    }
    auto view = name && *name ? this->Arrays.See(array, name, this->View.rows) : std::nullopt;
    if (view)
    {
      this->View.arrays.push_back(std::move(*view));
    }
    else
    {
      granular::Notice notice;
      notice.text = name && *name ? "the array '" + std::string(name) + "' of the type " +
          array->GetDataTypeAsString() + " is left out"
                                  : "an array without a name is left out";
      notices.push_back(notice);
    }
  }
}

DumpInput::DumpInput(vtkPointSet* input, granular::Notices& notices)
  : RowsInput(input, input->GetNumberOfPoints(), "points")
{
  if (vtkPoints* points = input->GetPoints())
  {
    this->View.points = this->Arrays.See(points->GetData(), "points", this->View.rows);
  }
  this->SeeArrays(input->GetPointData(), notices);
  static_assert(granular::FrameView::duplicate_row == vtkDataSetAttributes::DUPLICATEPOINT);
  if (vtkUnsignedCharArray* ghosts = input->GetPointGhostArray())
  {
    this->Arrays.CheckTuples(ghosts, vtkDataSetAttributes::GhostArrayName(), this->View.rows);
    this->View.ghosts = ghosts->GetPointer(0);
  }
}

void RowsInput::ReadFieldData(vtkFieldData* data)
{
  granular::FrameHeader& header = this->View.header;
  const auto box = FindBox(data);
  this->View.has_box = box.has_value();
  header.box = box.value_or(granular::Box{});
  header.label = FindText(data, "label");
  if (std::string rows = FindText(data, "RowLabel"); !rows.empty())
  {
    header.counted = std::move(rows);
  }
  header.units = FindText(data, "units");
  this->View.columns = FindTexts(data, "Columns");
  if (const auto digits =
        FindDoubles(data, "ColumnDigits", static_cast<int>(this->View.columns.size())))
  {
    header.digits.assign(digits->begin(), digits->end());
  }
  const std::string dialect = FindText(data, "Dialect");
  if (dialect == "LAMMPS" || dialect == "LIGGGHTS")
  {
    header.dialect = dialect == "LAMMPS" ? granular::Dialect::Lammps : granular::Dialect::Liggghts;
  }
  if (vtkDataArray* timestep = data->GetArray("timestep");
      timestep && timestep->GetNumberOfValues() == 1)
  {
    const double step = timestep->GetComponent(0, 0);
    this->HasTimestep = std::trunc(step) == step && std::abs(step) < 0x1p63;
    header.timestep = this->HasTimestep ? timestep->GetVariantValue(0).ToTypeInt64() : 0;
  }
  if (const auto time = FindDoubles(data, "time", 1))
  {
    header.time = time->front();
    this->HasTime = true;
  }
  const std::string coordinates = FindText(data, "Coordinates");
  for (const auto kind : { granular::Coordinates::Absolute, granular::Coordinates::Unwrapped,
         granular::Coordinates::Scaled })
  {
    this->View.coordinates =
      coordinates == granular::to_string(kind) ? kind : this->View.coordinates;
  }
  if (const auto origin = FindDoubles(data, "PointOrigin", 3))
  {
    std::copy(origin->begin(), origin->end(), this->View.point_origin.begin());
  }
}

std::vector<double> ReadAbsolutePoints(vtkPointSet* input)
{
  return granular::absolute_points(DumpInput(input).View);
}

Particles::Particles(vtkDataObject* input, granular::Communicator& ranks)
  : DumpInput(ExpectData<vtkPointSet>(input, "a vtkPointSet of particles"))
{
  granular::share_header(this->View, ranks);
}
}
