// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularContactSums.h"

#include "private/arrays/arrays.h"
#include "private/arrays/made_arrays.h"
#include "private/contacts/contact_input.h"
#include "private/dump/dump_input.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/contacts/contact_sums.h"
#include "granular/numbers/number_print.h"

#include "vtkCellData.h"
#include "vtkDataArraySelection.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularContactSums);

namespace
{
constexpr const char* FrictionArray = "mobilised_friction";

constexpr MadeArray Arrays[] = {
  { "coordination", true },
  { "contact_force", true },
  { "contact_torque", true },
  { "fabric", true },
  { "contact_stress", true },
  { "principal_stress", false },
  { "von_mises", false },
  { "rattler", false },
  { "coordination_without_rattlers", false },
  { FrictionArray, false },
};

/**
 * An array of integers, one a row.
 */
template <class Array>
vtkSmartPointer<Array> IntegersOf(const char* name, const granular::Block& block, vtkIdType rows)
{
  using Value = typename Array::ValueType;
  return ArrayOf<Array>(
    name, std::span(static_cast<const Value*>(block.data()), static_cast<std::size_t>(rows)));
}

void ExpectNumber(const char* name, double value, bool zero)
{
  if (!(value >= 0 && (zero || value > 0) && value <= std::numeric_limits<double>::max()))
  {
    throw granular::Error("expected a " + std::string(name) +
      (zero ? " of 0 or more" : " above 0") + ", got " + granular::to_text(value));
  }
}
}

//------------------------------------------------------------------------------
class vtkGranularContactSums::Task : public FilterTask<vtkGranularContactSums>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    this->Input.emplace(this->Particles, this->Ranks);
    this->Read();
    this->Sum();
    this->FillParticles();
    this->FillLines();
    this->TellOfContacts();
  }

  bool IsOn(const char* name) const
  {
    return this->Self->ArraySelection->ArrayIsEnabled(name) != 0;
  }

  void Read()
  {
    if (!this->Contacts[0] && !this->Contacts[1])
    {
      throw granular::Error("expected contacts: the input Lines, Walls, or both, got none");
    }
    ExpectNumber("MinimumForce", this->Self->MinimumForce, true);
    ExpectNumber("MinimumOverlap", this->Self->MinimumOverlap, true);
    ExpectNumber("FrictionCoefficient", this->Self->FrictionCoefficient, false);
    const bool arms = this->IsOn("contact_torque") || this->IsOn("contact_stress") ||
      this->IsOn("principal_stress") || this->IsOn("von_mises");
    ContactArrays wanted;
    wanted.Force = arms || this->IsOn("contact_force") || this->IsOn(FrictionArray) ||
      this->Self->MinimumForce > 0;
    wanted.Tangential = this->IsOn(FrictionArray);
    wanted.Torque = this->IsOn("contact_torque");
    wanted.Point = arms && this->Self->LeverArm == CONTACT_POINT;
    wanted.Overlap = this->Self->MinimumOverlap > 0;
    this->Rows.emplace(this->Contacts, wanted, this->Progress);
    for (std::size_t port = 0; port < 2; ++port)
    {
      if (const std::optional<ContactInput>& input = this->Rows->Each[port])
      {
        this->All[port] = input->GetLines().Count();
        this->LackForces = this->LackForces ||
          (wanted.Force && this->All[port] > 0 && input->GetRows().force.empty());
        this->LackPlaces = this->LackPlaces || input->GetLines().LackPlaces();
        const std::string remark =
          CompareTimesteps(this->Particles->GetFieldData(), input->GetLines().GetFieldData());
        this->Remark = this->Remark.empty() ? remark : this->Remark;
      }
    }
  }

  void Sum()
  {
    granular::ContactSumsRequest request;
    request.force = this->IsOn("contact_force");
    request.torque = this->IsOn("contact_torque");
    request.fabric = this->IsOn("fabric");
    request.stress = this->IsOn("contact_stress");
    request.principal_stress = this->IsOn("principal_stress");
    request.von_mises = this->IsOn("von_mises");
    request.friction = this->IsOn(FrictionArray);
    const bool rattlers = this->IsOn("rattler") || this->IsOn("coordination_without_rattlers");
    request.least_contacts = rattlers ? this->Self->RattlerContacts : 0;
    request.options.arm = this->Self->LeverArm == HALF_BRANCH ? granular::LeverArm::Half
                                                              : granular::LeverArm::ContactPoint;
    request.options.least_force = this->Self->MinimumForce;
    request.options.least_overlap = this->Self->MinimumOverlap;
    request.radius = this->Self->RadiusArray;
    request.threads = this->Threads;
    this->Progress.set_part(0.1, 0.95);
    this->Sums = granular::sum_contacts(
      this->Input->View, this->Rows->Rows, request, this->Group, this->Progress);
    this->Group.sum(this->All);
  }

  /**
   * Adds the arrays that were made, with a tuple for each particle.
   */
  void AddArrays(vtkPointData* data)
  {
    const vtkIdType rows = this->Input->View.rows;
    granular::ContactSums& sums = this->Sums;
    if (this->IsOn("coordination"))
    {
      data->AddArray(IntegersOf<vtkTypeInt32Array>("coordination", sums.coordination, rows));
    }
    const auto add = [&](const char* name, granular::Block& block, int components)
    {
      if (block.data())
      {
        auto array = TakeDoubles(name, block, rows, components);
        constexpr const char* parts[] = { "XX", "YY", "ZZ", "XY", "XZ", "YZ" };
        for (int i = 0; components == 6 && i < 6; ++i)
        {
          array->SetComponentName(i, parts[i]);
        }
        data->AddArray(array);
      }
    };
    add("contact_force", sums.force, 3);
    add("contact_torque", sums.torque, 3);
    add("fabric", sums.fabric, 6);
    add("contact_stress", sums.stress, 6);
    add("principal_stress", sums.principal_stress, 3);
    add("von_mises", sums.von_mises, 1);
    if (this->IsOn("rattler"))
    {
      data->AddArray(IntegersOf<vtkUnsignedCharArray>("rattler", sums.rattlers, rows));
    }
    if (this->IsOn("coordination_without_rattlers"))
    {
      data->AddArray(
        IntegersOf<vtkTypeInt32Array>("coordination_without_rattlers", sums.backbone, rows));
    }
  }

  void FillParticles()
  {
    auto* input = vtkPointSet::SafeDownCast(this->Particles);
    vtkNew<vtkPolyData> all;
    const vtkIdType rows = input->GetNumberOfPoints();
    all->SetPoints(input->GetPoints());
    all->GetPointData()->PassData(input->GetPointData());
    this->AddArrays(all->GetPointData());
    auto* output = this->GetOutput<vtkPolyData>();
    auto* cells = vtkPolyData::SafeDownCast(input);
    if (this->Together && cells)
    {
      output->CopyStructure(cells);
      output->GetCellData()->PassData(cells->GetCellData());
      output->GetPointData()->PassData(all->GetPointData());
    }
    else if (this->Together)
    {
      output->SetPoints(input->GetPoints());
      output->SetVerts(MakeCells(rows, 1));
      output->GetPointData()->PassData(all->GetPointData());
    }
    else
    {
      this->FillPiece(all, output);
    }
    vtkFieldData* fields = output->GetFieldData();
    fields->PassData(input->GetFieldData());
    const auto mean = [&](const char* name, vtkTypeInt64 contacts, vtkTypeInt64 particles)
    {
      fields->AddArray(MakeDoubles(name,
        { particles > 0 ? static_cast<double>(contacts) / static_cast<double>(particles) : 0.0 }));
    };
    mean("mean_coordination", this->Sums.contacts, this->Sums.particles);
    if (this->Sums.rattlers.data() || this->Sums.backbone.data())
    {
      mean("mean_coordination_without_rattlers", this->Sums.bearing,
        this->Sums.particles - this->Sums.rattling);
    }
  }

  /**
   * Fills the output with a piece of the whole, which each rank has made.
   */
  void FillPiece(vtkPolyData* all, vtkPolyData* output)
  {
    const auto [first, last] = this->RangeOf(all->GetNumberOfPoints());
    vtkNew<vtkIdList> tuples;
    tuples->SetNumberOfIds(last - first);
    std::iota(tuples->begin(), tuples->end(), first);
    if (vtkPoints* const given = all->GetPoints())
    {
      vtkNew<vtkPoints> points;
      points->SetData(vtkDataArray::SafeDownCast(TakeTuples(given->GetData(), tuples)));
      output->SetPoints(points);
    }
    output->SetVerts(MakeCells(last - first, 1));
    for (int i = 0; i < all->GetPointData()->GetNumberOfArrays(); ++i)
    {
      output->GetPointData()->AddArray(
        TakeTuples(all->GetPointData()->GetAbstractArray(i), tuples));
    }
  }

  /**
   * Lines with their mobilised friction.
   */
  void FillLines()
  {
    auto* output = this->GetOutput<vtkPolyData>(1);
    auto* input = vtkPointSet::SafeDownCast(this->Contacts[0]);
    if (this->Sums.friction.empty() || !input)
    {
      return;
    }
    const LocalRows& rows = this->Rows->Each[0]->GetLines();
    const auto [first, last] = this->RangeOf(rows.Count());
    std::vector<std::int64_t> wanted(static_cast<std::size_t>(last - first));
    std::iota(wanted.begin(), wanted.end(), first);
    const ChosenCells cells = rows.AddLines(input, wanted, output);
    rows.PassCells(cells.All, output->GetCellData());
    const auto* const friction = static_cast<const double*>(this->Sums.friction[0].data());
    output->GetCellData()->AddArray(ArrayOf<vtkDoubleArray>(FrictionArray, cells.Rows,
      [&](std::int64_t row) { return friction[row] / this->Self->FrictionCoefficient; }));
    output->GetFieldData()->PassData(input->GetFieldData());
  }

  void TellOfContacts()
  {
    const std::string ofAll = " of " + std::to_string(this->All[0] + this->All[1]) + " contacts ";
    this->Tell(this->LackPlaces && this->All[0] + this->All[1] == 0, "no places",
      "an input has no lines, as its file does not say where these are: take the rows, the second "
      "output of the reader");
    this->Tell(this->Sums.missing > 0, "missing",
      std::to_string(this->Sums.missing) + ofAll +
        "name a particle that is not there: they count for the other one alone" +
        (this->Sums.unplaced > 0 ? "; " + std::to_string(this->Sums.unplaced) +
              " of these have no line, and count for coordination and force alone"
                                 : ""));
    this->Tell(this->Sums.broken > 0, "broken",
      std::to_string(this->Sums.broken) + ofAll +
        "are left out: a number of theirs is no number, infinite or too large");
    this->Tell(this->Sums.repeated > 0, "repeated",
      std::to_string(this->Sums.repeated) +
        " particles have the id of another one: contacts go to the first");
    this->Tell(!this->Remark.empty(), "timesteps", this->Remark);
    const std::string unknown = TellOfUnknown(this->Self->ArraySelection, Arrays);
    this->Tell(!unknown.empty(), "unknown arrays", unknown);
    this->Tell(this->LackForces, "no forces",
      "the contacts have neither an array 'force' nor 'force_normal': what needs forces is not "
      "made");
  }

  vtkDataObject* const Particles = this->GetInput(0);
  /// between particles, with walls
  const std::array<vtkDataObject*, 2> Contacts = { this->GetInput(1), this->GetInput(2) };
  std::optional<vtkGranularPrivate::Particles> Input;
  std::optional<ContactInputs> Rows;
  granular::ContactSums Sums;
  std::array<std::int64_t, 2> All = {}; ///< contacts of all processes
  std::string Remark;
  bool LackForces = false;
  bool LackPlaces = false;
};

vtkGranularExecuteMacro(vtkGranularContactSums);
vtkGranularOutputMacro(vtkGranularContactSums, GetOutput, vtkPolyData, 0);
vtkGranularOutputMacro(vtkGranularContactSums, GetLinesOutput, vtkPolyData, 1);

//------------------------------------------------------------------------------
vtkGranularContactSums::vtkGranularContactSums()
  : ArraySelection(MakeSelection(this, Arrays))
{
  this->SetPorts(
    { Input::Required, Input::Optional, Input::Optional }, { "vtkPolyData", "vtkPolyData" });
}

//------------------------------------------------------------------------------
vtkGranularContactSums::~vtkGranularContactSums()
{
  this->ArraySelection->Delete();
}

//------------------------------------------------------------------------------
void vtkGranularContactSums::SetArrayStatus(const char* name, int status)
{
  this->ArraySelection->SetArraySetting(name, status);
}

//------------------------------------------------------------------------------
void vtkGranularContactSums::ClearArrays()
{
  this->ArraySelection->DisableAllArrays();
}

vtkGranularPrintMacro(vtkGranularContactSums, LeverArm, MinimumForce, MinimumOverlap,
  RattlerContacts, FrictionCoefficient, RadiusArray, ArraySelection);
