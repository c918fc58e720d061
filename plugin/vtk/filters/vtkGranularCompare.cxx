// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularCompare.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"
#include "private/local/local_rows.h"
#include "private/paths/compared_frames.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/averages/particle_loader.h"
#include "granular/grid/sphere_box.h"
#include "granular/lines/fetch_particles.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/known_arrays.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/compare_particles.h"
#include "granular/paths/fragments.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularCompare);

namespace
{
using granular::Change;
using Rows = std::vector<std::int64_t>;

/**
 * Returns the names of the arrays that both frames have alike.
 */
std::vector<std::string> NamesOfBoth(
  const granular::KnownArrays& current, const granular::KnownArrays& reference)
{
  const granular::KnownArrays& known = current.has_particles ? current : reference;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < known.names.size(); ++i)
  {
    const auto other = std::ranges::find(reference.names, known.names[i]);
    const bool both = other != reference.names.end() &&
      reference.sizes[static_cast<std::size_t>(other - reference.names.begin())] == known.sizes[i];
    if (both || !reference.has_particles)
    {
      names.push_back(known.names[i]);
    }
  }
  return names;
}

bool HasArray(vtkDataSetAttributes* data, const char* name)
{
  return data && data->HasArray(name) != 0;
}

/**
 * Returns an array with a value for each of the kept rows, and none for others.
 */
template <class Array, class Value>
vtkSmartPointer<vtkAbstractArray> Spread(
  const char* name, const std::vector<Value>& values, const Rows& kept, vtkIdType rows)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfValues(rows);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    array->SetValue(kept[i], values[i]);
  }
  return array;
}

/**
 * Returns the changes of some rows, and of as many lost ones behind them.
 */
std::vector<Change> PickChanges(
  const std::vector<Change>& changes, const Rows& rows, std::size_t lost)
{
  std::vector<Change> picked(rows.size() + lost, Change::Lost);
  std::ranges::transform(
    rows, picked.begin(), [&](std::int64_t row) { return changes[static_cast<std::size_t>(row)]; });
  return picked;
}

auto MakeChanges(const std::vector<Change>& changes)
{
  return ArrayOf<vtkTypeInt32Array>(
    "change", changes, [](Change change) { return static_cast<vtkTypeInt32>(change); });
}

/**
 * Returns the masses of some rows: those of an array, otherwise of spheres by density and radius. Nothing if a rank with
 * particles has neither, or no rank has particles. Throws Error for arrays of more than one number a particle, or of texts.
 * Collective.
 */
std::optional<std::vector<double>> ReadMasses(const granular::FrameView& view,
  const std::string& name, const Rows& rows, granular::Communicator& ranks)
{
  const auto [velocity, radius, mass, density, stress] =
    granular::find_particle_sources(view, { "", "radius", name, "" });
  const bool known = mass || density;
  std::array<std::int64_t, 2> counts = { view.rows > 0 && known ? 1 : 0,
    view.rows > 0 && !known ? 1 : 0 };
  ranks.sum(counts);
  if (counts[0] == 0 || counts[1] > 0)
  {
    return {};
  }
  std::vector<double> masses(rows.size());
  if (mass)
  {
    granular::load_rows({ &*mass, 1 }, rows, masses.data());
  }
  else if (density)
  {
    std::vector<double> radii(rows.size());
    granular::load_rows({ &*density, 1 }, rows, masses.data());
    granular::load_rows({ &*radius, 1 }, rows, radii.data());
    std::ranges::transform(masses, radii, masses.begin(),
      [](double each, double r) { return each * granular::sphere_volume(r); });
  }
  return masses;
}

ArrayForm FormOf(vtkAbstractArray* array)
{
  return { array->GetName(), array->GetDataType(), array->GetNumberOfComponents() };
}
}

//------------------------------------------------------------------------------
class vtkGranularCompare::Task : public FilterTask<vtkGranularCompare>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    this->ReadFrames();
    this->Compare();
    for (vtkPolyData* output : this->Outputs)
    {
      output->GetFieldData()->PassData(this->Current[0]->GetFieldData());
    }
    this->TellOfFrames();
  }

  void ReadFrames()
  {
    KeptFrames& frames = *this->Self->Frames;
    frames.Begin(this->Self, { this->Group.rank(), this->Group.size(), 0 }, this->Ranks);
    this->Current = frames.GetShown();
    const std::size_t reference = this->FindReference(frames);
    this->Reference = frames.Get(this->Self, reference, this->Ranks);
    const std::vector<double>& times = frames.GetTimes();
    this->Passed = times.empty() ? 0 : times[frames.GetShownNumber()] - times[reference];
    frames.End(this->Self->Reference == PREVIOUS);
  }

  std::size_t FindReference(KeptFrames& frames)
  {
    const std::vector<double>& times = frames.GetTimes();
    const std::size_t shown = frames.GetShownNumber();
    const double time = this->Self->ReferenceTime;
    if (this->Self->Reference == PREVIOUS)
    {
      return shown > 0 ? shown - 1 : 0;
    }
    if (this->Self->Reference == FIRST)
    {
      return this->FindFirst(frames);
    }
    if (!std::isfinite(time))
    {
      throw granular::Error("expected a finite ReferenceTime, got " + granular::to_text(time));
    }
    const auto after = std::ranges::upper_bound(times, time) - times.begin();
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0));
  }

  /**
   * Returns the first frame; for particles the first one that has any.
   */
  std::size_t FindFirst(KeptFrames& frames)
  {
    auto* shown = vtkDataSet::SafeDownCast(this->Current[0]);
    std::int64_t particles = shown && HasArray(shown->GetPointData(), "id") ? 1 : 0;
    this->Ranks.sum({ &particles, 1 });
    const std::size_t first = particles > 0 ? frames.FindFirst(this->Self, this->Ranks) : 0;
    this->LateFirst = first > 0 ? granular::to_text(frames.GetTimes()[first]) : "";
    return first;
  }

  void Compare()
  {
    const bool hasLines = this->Current.size() > 1;
    if (this->IsOfLines())
    {
      if (hasLines)
      {
        throw granular::Error(
          "expected particles with the point array 'id' as Input of Lines, got lines");
      }
      this->CompareLines(0);
      return;
    }
    this->CompareParticles();
    if (hasLines)
    {
      this->CompareLines(1);
      this->FindFragments();
    }
    this->FillParticles();
    this->Group.sum({ &this->Kept, 1 });
    this->Group.sum({ &this->Lines, 1 });
  }

  /**
   * Returns true if some rank has lines at the first input, in either frame, and none has particles.
   */
  bool IsOfLines() const
  {
    std::array<std::int64_t, 2> counts = {};
    for (vtkDataObject* data : { this->Current[0].Get(), this->Reference[0].Get() })
    {
      if (auto* set = vtkDataSet::SafeDownCast(data))
      {
        vtkCellData* cells = set->GetCellData();
        counts[0] += HasArray(set->GetPointData(), "id") ? 1 : 0;
        counts[1] += HasArray(cells, "id1") && HasArray(cells, "id2") ? 1 : 0;
      }
    }
    this->Group.sum(counts);
    return counts[0] == 0 && counts[1] > 0;
  }

  /**
   * The rows of a frame that this process puts out, of those that it has compared.
   */
  Rows PartOf(const Rows& rows) const
  {
    const auto [first, last] = this->RangeOf(static_cast<vtkTypeInt64>(rows.size()));
    return Rows(rows.begin() + first, rows.begin() + last);
  }

  void CompareParticles()
  {
    this->Particles[0].emplace(this->Current[0], this->Ranks);
    this->Particles[1].emplace(this->Reference[0], this->Ranks);
    const granular::FrameView& view = this->Particles[0]->View;
    const granular::FrameView& reference = this->Particles[1]->View;
    granular::ParticleCompareRequest request;
    request.threads = this->Threads;
    request.differences = granular::names_in(this->Self->Differences,
      NamesOfBoth(
        granular::share_arrays(view, this->Group), granular::share_arrays(reference, this->Group)));
    this->Progress.set_part(0.1, 0.6);
    this->Compared =
      granular::compare_particles(view, reference, request, this->Group, this->Progress);
    for (std::int64_t row = 0; row < view.rows; ++row)
    {
      if (!view.is_duplicate(row))
      {
        this->ParticleRows.push_back(row);
        this->Kept += this->Compared.changes[static_cast<std::size_t>(row)] == Change::Kept ? 1 : 0;
      }
    }
  }

  void CompareLines(std::size_t port)
  {
    this->Progress.set_part(0.6, 0.7);
    std::array<vtkPointSet*, 2> inputs;
    std::array<std::optional<LocalRows>, 2> rows;
    for (std::size_t i = 0; i < 2; ++i)
    {
      const FrameData& frame = i == 0 ? this->Current : this->Reference;
      inputs[i] = ExpectData<vtkPointSet>(
        frame[port], "lines with points (GranularLocalJoin makes them of a table)");
      rows[i].emplace(inputs[i]);
      this->Ends[i] = { rows[i]->ReadIds("id1", this->Progress),
        rows[i]->ReadIds("id2", this->Progress) };
    }
    this->LackPlaces = rows[0]->LackPlaces();
    this->Lines = rows[0]->Count();
    const granular::LineChanges changes = granular::compare_lines(
      { this->Ends[0][0], this->Ends[0][1] }, { this->Ends[1][0], this->Ends[1][1] }, this->Group);
    Rows all(static_cast<std::size_t>(rows[0]->Count()));
    std::iota(all.begin(), all.end(), 0);
    Rows lost;
    for (std::int64_t row = 0; row < rows[1]->Count(); ++row)
    {
      if (changes.reference[static_cast<std::size_t>(row)] == Change::Lost)
      {
        lost.push_back(row);
      }
    }
    vtkPolyData* output = this->Outputs[port];
    const ChosenCells now = rows[0]->AddLines(inputs[0], this->PartOf(all), output);
    const ChosenCells before = rows[1]->AddLines(inputs[1], this->PartOf(lost), output);
    vtkCellData* data = output->GetCellData();
    ChangedRows(now.All, before.All)
      .Pass(inputs[0]->GetCellData(), inputs[1]->GetCellData(), this->Group, data);
    const std::vector<Change> both = PickChanges(changes.current, now.Rows, before.All.size());
    data->AddArray(MakeChanges(both));
    // lines that were kept are as old as the reference frame, at least
    data->AddArray(ArrayOf<vtkDoubleArray>("age", both,
      [this](Change change)
      {
        return change == Change::Kept ? this->Passed
          : change == Change::New     ? 0
                                      : std::numeric_limits<double>::quiet_NaN();
      }));
  }

  void FindFragments()
  {
    const granular::FrameView& view = this->Particles[0]->View;
    this->Progress.set_part(0.7, 0.8);
    std::vector<std::int64_t> ids;
    if (const granular::ArrayView* array = view.find("id"))
    {
      const granular::Ids all(*array, view.rows, granular::Executor(), this->Progress);
      std::ranges::transform(this->ParticleRows, std::back_inserter(ids),
        [&](std::int64_t row) { return all.values()[static_cast<std::size_t>(row)]; });
    }
    const auto masses = ReadMasses(view, this->Self->MassArray, this->ParticleRows, this->Group);
    this->Progress.set_part(0.8, 0.9);
    this->Progress.step(0);
    const granular::Fragments found = granular::find_fragments(ids,
      masses ? std::optional(std::span<const double>(*masses)) : std::nullopt, this->Ends[0][0],
      this->Ends[0][1], this->Group);
    this->Unconnected = found.missing;
    const Rows& rows = this->ParticleRows;
    this->Made.push_back(Spread<vtkTypeInt64Array>("fragment", found.labels, rows, view.rows));
    this->Made.push_back(Spread<vtkTypeInt64Array>("fragment_size", found.sizes, rows, view.rows));
    if (masses)
    {
      this->Made.push_back(Spread<vtkDoubleArray>("fragment_mass", found.masses, rows, view.rows));
    }
  }

  void FillParticles()
  {
    auto* current = vtkPointSet::SafeDownCast(this->Current[0]);
    auto* reference = vtkPointSet::SafeDownCast(this->Reference[0]);
    const granular::FrameView& view = this->Particles[0]->View;
    const Rows rows = this->PartOf(this->ParticleRows);
    const Rows lost = this->PartOf(this->Compared.lost);
    const ChangedRows both(rows, lost);
    vtkPointData* data = this->Outputs[0]->GetPointData();
    both.Pass(current->GetPointData(), reference->GetPointData(), this->Group, data);
    data->AddArray(MakeChanges(PickChanges(this->Compared.changes, rows, lost.size())));
    std::vector<vtkSmartPointer<vtkAbstractArray>> made = { TakeDoubles(
      "displacement", this->Compared.displacements, view.rows, 3) };
    for (granular::DifferenceArray& array : this->Compared.differences)
    {
      made.push_back(TakeDoubles(array.name.c_str(), array.values, view.rows, array.size));
    }
    made.insert(made.end(), this->Made.begin(), this->Made.end());
    for (const auto& array : made)
    {
      data->AddArray(both.Combine(FormOf(array), array, nullptr));
    }
    this->FillPoints(both, current->GetPoints(), reference->GetPoints());
  }

  void FillPoints(const ChangedRows& both, vtkPoints* current, vtkPoints* reference) const
  {
    vtkDataArray* now = current ? current->GetData() : nullptr;
    vtkDataArray* before = reference ? reference->GetData() : nullptr;
    const bool single = now && now->GetNumberOfTuples() > 0
      ? now->GetDataType() == VTK_FLOAT
      : before && before->GetDataType() == VTK_FLOAT;
    vtkNew<vtkPoints> points;
    points->SetData(vtkDataArray::SafeDownCast(
      both.Combine({ "Points", single ? VTK_FLOAT : VTK_DOUBLE, 3 }, now, before)));
    this->Outputs[0]->SetPoints(points);
    this->Outputs[0]->SetVerts(MakeCells(both.Count(), 1));
  }

  void TellOfFrames()
  {
    this->Tell(this->Compared.far > 0, "far",
      std::to_string(this->Compared.far) +
        " particles moved more than a quarter of a period of the box: their displacement may be "
        "wrong by periods. Unwrapped points, or ix iy iz in the dump, make it exact");
    const bool boxless = this->Particles[0] && !this->Compared.unwrapped &&
      !this->Particles[0]->View.has_box && !this->Particles[1]->View.has_box;
    this->Tell(boxless && this->Kept > 0, "no box",
      "neither frame has a box in its field data (BoxOrigin, BoxVectors): displacements across "
      "periodic faces are those of the points");
    this->Tell(this->Unconnected > 0, "unconnected",
      std::to_string(this->Unconnected) + " of " + std::to_string(this->Lines) +
        " lines name a particle that is not there: they connect no fragments");
    this->Tell(!this->LateFirst.empty() && this->Kept > 0, "first frame",
      "the first frame has no particles: the reference is the frame of time " + this->LateFirst);
    this->Tell(this->LackPlaces, "no places",
      "the input Lines has no lines, as its file does not say where these are: draw the rows, the "
      "second output of the reader, with GranularLocalJoin");
  }

  const std::array<vtkPolyData*, 2> Outputs = { this->GetOutput<vtkPolyData>(0),
    this->GetOutput<vtkPolyData>(1) };
  FrameData Current;
  FrameData Reference;
  double Passed = 0;                                                     ///< time between both
  std::array<std::optional<vtkGranularPrivate::Particles>, 2> Particles; ///< of both frames
  Rows ParticleRows; ///< of the current frame, that are no duplicates
  granular::ComparedParticles Compared;
  std::array<std::array<std::vector<std::int64_t>, 2>, 2> Ends; ///< of the lines of both frames
  std::vector<vtkSmartPointer<vtkAbstractArray>> Made;          ///< of fragments
  bool LackPlaces = false;
  std::string LateFirst;        ///< time of the reference, if frames before it have no particles
  std::int64_t Kept = 0;        ///< particles, in the end of all processes
  std::int64_t Lines = 0;       ///< of the current frame, the same
  std::int64_t Unconnected = 0; ///< of these, without a particle at an end
};

vtkGranularExecuteMacro(vtkGranularCompare);
vtkGranularOutputMacro(vtkGranularCompare, GetOutput, vtkPolyData, 0);
vtkGranularOutputMacro(vtkGranularCompare, GetLinesOutput, vtkPolyData, 1);

//------------------------------------------------------------------------------
vtkGranularCompare::vtkGranularCompare()
  : Frames(std::make_unique<KeptFrames>())
{
  this->SetPorts({ Input::Required, Input::Optional }, { "vtkPolyData", "vtkPolyData" });
}

//------------------------------------------------------------------------------
vtkGranularCompare::~vtkGranularCompare() = default;

vtkGranularPrintMacro(vtkGranularCompare, Reference, ReferenceTime, Differences, MassArray);
