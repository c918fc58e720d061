// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalJoin.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"
#include "private/local/lines.h"
#include "private/local/local_rows.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/lines/join.h"
#include "granular/lines/lines.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/point_forms.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalJoin);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

std::span<double> DoublesIn(const granular::Block& block)
{
  return { static_cast<double*>(block.data()), block.bytes() / sizeof(double) };
}
}

//------------------------------------------------------------------------------
class vtkGranularLocalJoin::Task : public FilterTask<vtkGranularLocalJoin>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    this->Input.emplace(this->GetInput(0), this->Ranks);
    this->Join();
    this->Fill();
    this->TellOfLines();
  }

  /**
   * With the particles and rows that these processes have together.
   */
  void Join()
  {
    granular::JoinRequest request;
    this->ReadRows();
    this->ShareFacts(request);
    this->ShareBox();
    const std::vector<std::int64_t> id1 = this->Rows->ReadIds("id1", this->Progress);
    const std::vector<std::int64_t> id2 = this->Rows->ReadIds("id2", this->Progress);
    request.threads = this->Threads;
    this->Progress.set_part(0, 0.6);
    this->Joined =
      granular::join_lines(this->Input->View, id1, id2, request, this->Group, this->Progress);
    this->Progress.set_part(0.6, 0.95);
    this->MakeLines();
    this->FindElongations();
    this->CountMisfits();
    this->Remarks[0] = this->FindExample(id1, id2);
    // lines of a single time, or none, are those of all times
    if (this->Self->GetInputInformation(1, 0)->Length(Pipeline::TIME_STEPS()) > 1)
    {
      this->Remarks[1] =
        CompareTimesteps(this->GetInput(0)->GetFieldData(), this->Rows->GetFieldData());
    }
    for (std::int64_t* count : { &this->AllRows, &this->Misfits, &this->WithoutRest })
    {
      this->Group.sum({ count, 1 });
    }
    for (std::string& remark : this->Remarks)
    {
      const std::vector<std::string> said = this->Group.all_gather(remark);
      const auto first = std::ranges::find_if(said, [](const auto& text) { return !text.empty(); });
      remark = first == said.end() ? std::string() : *first;
    }
  }

  void ReadRows()
  {
    this->RowData = RowsOfTimestep(
      this->Self, 1, this->GetInput(0), PieceOfInput(this->Wanted, this->Ranks), this->Ranks);
    this->Rows.emplace(this->RowData);
    if (!this->Together)
    {
      const auto range = this->RangeOf(this->Rows->Count());
      this->FirstRow = range.first;
      this->Rows->Keep(range);
    }
    this->AllRows = this->Rows->Count();
    this->RestKnown = this->Rows->Has(this->Self->EquilibriumLengthArray.c_str());
    const double rest = this->Self->EquilibriumLength;
    if (!(rest >= 0 && rest <= std::numeric_limits<double>::max()))
    {
      throw granular::Error(
        "expected an EquilibriumLength of 0 or more, got " + granular::to_text(rest));
    }
  }

  /**
   * Shares the facts that all must know alike, also those who have no particles or no rows, and then perhaps no arrays: the names that
   * "*" stands for, whether there are equilibrium lengths, and where the rows of each begin.
   */
  void ShareFacts(granular::JoinRequest& request)
  {
    const granular::FrameView& view = this->Input->View;
    request.means = ShareNames(this->Self->Averages, view, this->Group);
    request.differences = ShareNames(this->Self->Differences, view, this->Group);
    std::int64_t with = this->RestKnown ? 1 : 0;
    this->Group.sum({ &with, 1 });
    this->RestKnown = with > 0;
    const std::vector<std::int64_t> counts = granular::gather(this->Group, this->AllRows);
    this->FirstRow +=
      std::accumulate(counts.begin(), counts.begin() + this->Group.rank(), std::int64_t{ 0 });
  }

  /**
   * Takes the box of the lines where the particles have lost theirs.
   */
  void ShareBox()
  {
    granular::FrameView& particles = this->Input->View;
    if (particles.has_box)
    {
      return;
    }
    granular::FrameView lines;
    const auto box = FindBox(this->Rows->GetFieldData());
    lines.rows = this->Rows->Count();
    lines.has_box = box.has_value();
    lines.header.box = box.value_or(granular::Box{});
    granular::share_header(lines, this->Group);
    this->BoxIsOfLines = lines.has_box;
    particles.has_box = lines.has_box;
    std::swap(particles.header.box, lines.header.box);
  }

  /**
   * Scaled points: the lines are made where the particles are, and then scaled as these were.
   */
  void MakeLines()
  {
    const granular::FrameView& view = this->Input->View;
    const bool scaled = view.coordinates == granular::Coordinates::Scaled;
    const bool unwrapped = view.coordinates == granular::Coordinates::Unwrapped;
    const granular::Box box = view.has_box ? view.header.box : granular::Box{};
    granular::Request request;
    request.periodic_lines = static_cast<granular::PeriodicLines>(this->Self->PeriodicLines);
    if (unwrapped && this->Self->PeriodicLines == SPLIT)
    {
      request.periodic_lines = granular::PeriodicLines::MinimumImage;
    }
    request.point_origin = scaled ? granular::Vector3{} : view.point_origin;
    request.threads = this->Threads;
    this->Lines = granular::make_lines(
      DoublesIn(this->Joined.first), DoublesIn(this->Joined.second), box, request, this->Progress);
    if (scaled && this->Lines.count > 0)
    {
      granular::check_volume(box);
      granular::convert_positions(
        granular::plan_form(granular::Coordinates::Absolute, granular::ColumnRole::ScaledPosition),
        box, view.point_origin, {}, DoublesIn(this->Lines.points));
    }
  }

  /**
   * Returns the values of the joined particles.
   */
  std::vector<double> ReadNumbers(const char* name)
  {
    if (this->Joined.count == 0)
    {
      return {};
    }
    std::vector<double> own;
    const std::span<const double> all = this->Rows->ReadTuples(name, 1, own);
    std::vector<double> numbers(all.begin(), all.end());
    if (!this->Joined.rows.empty())
    {
      numbers.resize(this->Joined.rows.size());
      std::ranges::transform(this->Joined.rows, numbers.begin(),
        [&](std::int64_t row) { return all[static_cast<std::size_t>(row)]; });
    }
    return numbers;
  }

  void FindElongations()
  {
    const double constant = this->Self->EquilibriumLength;
    std::vector<double> rest;
    if (this->RestKnown)
    {
      rest = this->ReadNumbers(this->Self->EquilibriumLengthArray.c_str());
    }
    else if (constant > 0)
    {
      rest.assign(static_cast<std::size_t>(this->Joined.count), constant);
      this->RestKnown = true;
    }
    const std::span<const double> lengths = DoublesIn(this->Lines.lengths);
    for (std::size_t i = 0; i < rest.size(); ++i)
    {
      const double length = std::abs(rest[i]);
      this->WithoutRest += length == 0 ? 1 : 0;
      const double elongation =
        length == 0 ? std::numeric_limits<double>::quiet_NaN() : lengths[i] - length;
      this->Elongations.push_back(elongation);
      this->Strains.push_back(elongation / length);
    }
  }

  void CountMisfits()
  {
    if (this->Self->PeriodicLines == AS_WRITTEN || !this->Rows->HasNumbers("dist"))
    {
      return;
    }
    this->Misfits = granular::count_misfits(DoublesIn(this->Lines.lengths),
      this->ReadNumbers("dist"), DoublesIn(this->Joined.first), DoublesIn(this->Joined.second));
  }

  /**
   * The ids of the first row that was left out; empty if none was.
   */
  std::string FindExample(
    const std::vector<std::int64_t>& id1, const std::vector<std::int64_t>& id2) const
  {
    const std::vector<std::int64_t>& found = this->Joined.rows;
    if (this->Joined.count == static_cast<std::int64_t>(id1.size()))
    {
      return {};
    }
    std::size_t row = 0;
    while (row < found.size() && found[row] == static_cast<std::int64_t>(row))
    {
      ++row;
    }
    return std::to_string(id1[row]) + " and " + std::to_string(id2[row]);
  }

  /**
   * Passes the arrays of the lines of the input.
   */
  void PassRows(vtkCellData* data) const
  {
    const std::vector<std::int64_t>& joined = this->Joined.rows;
    std::vector<std::int64_t> rows = this->Lines.rows;
    for (std::int64_t& row : rows)
    {
      row = joined.empty() ? row : joined[static_cast<std::size_t>(row)];
    }
    this->Rows->Pass(rows.empty() ? joined : rows, this->Lines.count, data);
  }

  void Fill()
  {
    vtkCellData* data = this->Output->GetCellData();
    this->PassRows(data);
    for (const char* name : { "elongation", "strain" }) // of the input
    {
      data->RemoveArray(name);
    }
    if (this->Rows->HasParts())
    {
      data->RemoveArray(PartArray);
    }
    if (this->RestKnown)
    {
      data->AddArray(
        TakeRows(ArrayOf<vtkDoubleArray>("elongation", this->Elongations), this->Lines));
      data->AddArray(TakeRows(ArrayOf<vtkDoubleArray>("strain", this->Strains), this->Lines));
    }
    vtkPointData* points = vtkPointSet::SafeDownCast(this->GetInput(0))->GetPointData();
    for (granular::EndArray& array : this->Joined.arrays)
    {
      auto made = TakeDoubles(array.name.c_str(), array.values, this->Joined.count, array.size);
      const std::string from = array.name.substr(0, array.name.rfind('_'));
      if (vtkAbstractArray* named = points->GetAbstractArray(from.c_str()))
      {
        made->CopyComponentNames(named);
      }
      data->AddArray(TakeRows(made, this->Lines));
    }
    if (this->Self->PeriodicLines == SPLIT)
    {
      AddParts(this->Output, this->Lines, this->FirstRow, this->Joined.rows);
    }
    this->FillFields(this->Output->GetFieldData());
    FillLines(this->Output, this->Lines, nullptr);
  }

  void FillFields(vtkFieldData* fields) const
  {
    fields->PassData(this->GetInput(0)->GetFieldData());
    fields->RemoveArray("Columns"); // of particles
    std::vector<const char*> ofLines = { "Columns", "RowLabel" };
    if (this->BoxIsOfLines)
    {
      ofLines.insert(ofLines.end(), { "BoxOrigin", "BoxVectors", "BoxBounds", "Boundary" });
    }
    for (const char* name : ofLines)
    {
      if (vtkAbstractArray* array = this->Rows->GetFieldData()->GetAbstractArray(name))
      {
        fields->AddArray(array);
      }
    }
  }

  void TellOfLines()
  {
    this->Tell(this->AllRows == 0 && this->Rows->LackPlaces(), "no places",
      "the input Lines has no lines, as its file does not say where these are: take the rows, the "
      "second output of the reader");
    const std::string ofRows = " of " + std::to_string(this->AllRows) + " lines ";
    this->Tell(this->Joined.missing > 0, "missing",
      std::to_string(this->Joined.missing) + ofRows +
        "are left out: no particle has the id of an end, as in " + this->Remarks[0]);
    this->Tell(this->Joined.repeated > 0, "repeated",
      std::to_string(this->Joined.repeated) +
        " particles have the id of another one: lines go to the first");
    this->Tell(this->WithoutRest > 0, "no rest",
      std::to_string(this->WithoutRest) + ofRows +
        "have an equilibrium length of 0: their elongation and strain are nan");
    this->Tell(this->Misfits > 0, "misfits",
      std::to_string(this->Misfits) + ofRows +
        "are not as long as their array dist says: box or timestep are not those of the particles");
    this->Tell(!this->Remarks[1].empty(), "timesteps", this->Remarks[1]);
    const bool whole = this->Input->View.has_box || this->Self->PeriodicLines == AS_WRITTEN;
    this->Tell(!whole && this->AllRows > this->Joined.missing, "no box",
      "neither the particles nor the lines have a box in their field data (BoxOrigin, "
      "BoxVectors): lines are as written");
  }

  vtkPolyData* const Output = this->GetOutput<vtkPolyData>();
  std::optional<Particles> Input;
  vtkSmartPointer<vtkDataObject> RowData; ///< of the timestep of the particles
  std::optional<LocalRows> Rows;
  std::int64_t FirstRow = 0; ///< of these, among all
  granular::JoinedLines Joined;
  granular::Lines Lines; ///< between the joined
  bool BoxIsOfLines = false;
  bool RestKnown = false;
  std::vector<double> Elongations; ///< of the joined
  std::vector<double> Strains;
  std::int64_t AllRows = 0;           ///< in the end of all processes, like those that follow
  std::int64_t Misfits = 0;           ///< lines that are not as long as their array dist says
  std::int64_t WithoutRest = 0;       ///< lines whose equilibrium length is 0
  std::array<std::string, 2> Remarks; ///< ids that were not found, timesteps that differ; or empty
};

vtkGranularExecuteMacro(vtkGranularLocalJoin);
vtkGranularOutputMacro(vtkGranularLocalJoin, GetOutput, vtkPolyData, 0);

//------------------------------------------------------------------------------
vtkGranularLocalJoin::vtkGranularLocalJoin()
{
  this->SetPorts({ Input::Required, Input::Required }, { "vtkPolyData" });
}

vtkGranularPrintMacro(vtkGranularLocalJoin, PeriodicLines, Averages, Differences,
  EquilibriumLengthArray, EquilibriumLength);
