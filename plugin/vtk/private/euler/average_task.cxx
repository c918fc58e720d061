// SPDX-License-Identifier: BSD-3-Clause
#include "private/euler/average_task.h"

#include "private/dump/dump_output.h"
#include "private/euler/euler_cells.h"

#include "granular/averages/average.h"

#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"

#include <algorithm>
#include <functional>
#include <utility>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::AverageTask::Execute()
{
  this->Average();
  const std::pair<std::int64_t, const char*> counts[] = {
    { this->Outside, " particles are outside of all cells, and in none" },
    { this->Broken,
      " particles are left out: a position, velocity, mass, radius or stress of theirs is no "
      "number, infinite or too large, or a mass or radius is negative" },
    { this->LeftOut[0],
      " contacts name a particle that is not there: their stress counts as far as it is known" },
    { this->LeftOut[1],
      " contacts name a particle that is not there, and have no line: they are left out" },
    { this->LeftOut[2],
      " contacts are left out: a number of theirs is no number, infinite or too large" },
  };
  for (const auto& [count, text] : counts)
  {
    this->Tell(count > 0, text, std::to_string(count) + text);
  }
  const std::string unknown = TellOfUnknown(this->Self->ArraySelection, AverageArrays);
  this->Tell(!unknown.empty(), "unknown arrays", unknown);
  this->Fill();
}

//------------------------------------------------------------------------------
bool vtkGranularAverageAlgorithm::AverageTask::IsOn(const char* name) const
{
  return this->Self->ArraySelection->ArrayIsEnabled(name) != 0;
}

//------------------------------------------------------------------------------
bool vtkGranularAverageAlgorithm::AverageTask::IsStressOn() const
{
  constexpr std::array arrays = { "pressure", "sigma", "tau", "sigma_kinetic", "tau_kinetic",
    "sigma_contact", "tau_contact" };
  return std::ranges::any_of(arrays, [this](const char* name) { return this->IsOn(name); });
}

//------------------------------------------------------------------------------
granular::EulerFieldSet vtkGranularAverageAlgorithm::AverageTask::ChooseFields() const
{
  granular::EulerFieldSet fields;
  fields.density = this->IsOn("density");
  fields.momentum = this->IsOn("momentum");
  fields.temperature = this->IsOn("granular_temperature");
  fields.coordination = this->HaveContacts() && this->IsOn("coordination");
  fields.fabric = this->HaveContacts() && this->IsOn("fabric");
  return fields;
}

//------------------------------------------------------------------------------
granular::WeightOptions vtkGranularAverageAlgorithm::AverageTask::MakeWeights(
  int weights, granular::KernelBounds bounds, const granular::ParticleArrayNames& arrays)
{
  constexpr granular::CellWeights ways[] = { granular::CellWeights::Centre,
    granular::CellWeights::Overlap, granular::CellWeights::Kernel };
  constexpr granular::KernelShape shapes[] = { granular::KernelShape::Gaussian,
    granular::KernelShape::Lucy, granular::KernelShape::Heaviside };
  granular::WeightOptions options;
  options.weights = ways[std::min<int>(weights, GAUSSIAN)];
  options.kernel = shapes[std::max<int>(weights - GAUSSIAN, 0)];
  options.bounds = bounds;
  options.width = this->Self->KernelWidth;
  if (options.width == 0)
  {
    const double largest =
      weights >= GAUSSIAN ? granular::largest_radius(this->Grains->View, arrays, this->Group) : 0;
    options.width = largest > 0 ? 2 * largest : 1; // without particles any does
  }
  return options;
}

//------------------------------------------------------------------------------
void vtkGranularAverageAlgorithm::AverageTask::CheckInput(vtkDataObject* input)
{
  const std::string leftOut = FindLeftOut(input->GetFieldData());
  if (!leftOut.empty())
  {
    this->Notices.push_back({ {},
      "particles are missing that the reader left out (" + leftOut +
        "): averages count the particles that are there, volume fraction and stress are too "
        "small" });
  }
  const granular::FrameView& view = this->Grains->View;
  const granular::Box& box = view.header.box;
  if (view.has_box && box.general && box.boundary.find('p') != std::string::npos)
  {
    this->Notices.push_back({ {},
      "the box is a general triclinic one: particles have no periodic images, and cells at its "
      "faces lack their parts" });
  }
}

//------------------------------------------------------------------------------
const granular::FoundEnds& vtkGranularAverageAlgorithm::AverageTask::FindContacts(
  const FrameInputs& inputs, bool forces, const granular::Executor& executor,
  granular::Progress& progress)
{
  ContactArrays wanted;
  wanted.Force = forces;
  const ContactInputs& found =
    this->Contacts.emplace(std::array{ inputs[1], inputs[2] }, wanted, progress);
  for (const std::optional<ContactInput>& input : found.Each)
  {
    const std::string text = input
      ? CompareTimesteps(inputs[0]->GetFieldData(), input->GetLines().GetFieldData())
      : std::string();
    if (!text.empty())
    {
      this->Notices.push_back({ {}, text });
    }
  }
  granular::ContactOptions options;
  options.arm = granular::LeverArm::Half; // nobody asks where forces act: radii are not needed
  granular::PartialProgress parts(progress);
  const granular::FoundEnds& ends =
    this->Ends.emplace(this->Grains->View, found.Rows, "", options, this->Group, executor, parts);
  if (forces && !ends.have_forces())
  {
    this->Notices.push_back({ {},
      "the contacts have neither an array 'force' nor 'force_normal': stress and pressure lack "
      "their part" });
  }
  std::array<std::int64_t, 3> leftOut = { ends.missing() - ends.unplaced(), ends.unplaced(),
    ends.broken() };
  this->Group.sum(leftOut);
  std::ranges::transform(this->LeftOut, leftOut, this->LeftOut.begin(), std::plus<>());
  return ends;
}

//------------------------------------------------------------------------------
granular::EulerFrame vtkGranularAverageAlgorithm::AverageTask::TakeFrame()
{
  if (!this->Fields.contact_normal.empty())
  {
    granular::add_contact_stress(this->Cells, this->Fields);
  }
  granular::EulerFrame frame = MakeFrame(std::move(this->Cells), std::move(this->Fields));
  std::erase_if(frame.arrays,
    [&](const granular::EulerValues& values) { return !this->IsOn(values.name.c_str()); });
  return frame;
}
