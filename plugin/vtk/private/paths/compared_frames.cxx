// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/compared_frames.h"

#include "granular/common/error.h"
#include "granular/common/pass.h"
#include "granular/parallel/trade.h"

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkIdList.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <list>
#include <optional>

namespace vtkGranularPrivate
{
template <class Archive>
static void pass(Archive& archive, typename Archive::template Passed<ArrayForm>& form)
{
  granular::pass(archive, form.Name);
  archive.number(form.Type);
  archive.number(form.Components);
}

namespace
{
std::vector<int> FindInputs(vtkAlgorithm* consumer)
{
  std::vector<int> inputs;
  for (int port = 0; port < consumer->GetNumberOfInputPorts(); ++port)
  {
    if (consumer->GetNumberOfInputConnections(port) > 0)
    {
      inputs.push_back(port);
    }
  }
  return inputs;
}

/**
 * When the pipelines of the inputs were changed last.
 */
std::vector<vtkMTimeType> FindChanged(vtkAlgorithm* consumer)
{
  std::vector<vtkMTimeType> changed;
  for (const int port : FindInputs(consumer))
  {
    auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(consumer->GetInputExecutive(port, 0));
    changed.push_back(pipeline ? pipeline->GetPipelineMTime() : 0);
  }
  return changed;
}

vtkSmartPointer<vtkDataObject> Copy(vtkDataObject* data)
{
  auto copy = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}

/**
 * The arrays that a rank knows, and how well.
 */
struct KnownForms
{
  int Rows = 0; ///< 2: it has current rows, 1: only rows of the reference frame
  std::vector<ArrayForm> Forms;
};

template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<KnownForms>& known)
{
  archive.number(known.Rows);
  granular::pass(archive, known.Forms);
}

bool Has(const ArrayForm& form, vtkAbstractArray* array)
{
  return array && array->GetDataType() == form.Type &&
    array->GetNumberOfComponents() == form.Components;
}

/**
 * Gives rows [first, last) what stands for no value; texts are empty anyway.
 */
void FillNone(vtkAbstractArray* array, vtkIdType first, vtkIdType last)
{
  auto* numbers = vtkDataArray::SafeDownCast(array);
  if (!numbers)
  {
    return;
  }
  const bool real = array->GetDataType() == VTK_DOUBLE || array->GetDataType() == VTK_FLOAT;
  const double none = real ? std::numeric_limits<double>::quiet_NaN() : 0;
  for (vtkIdType row = first; row < last; ++row)
  {
    for (int k = 0; k < numbers->GetNumberOfComponents(); ++k)
    {
      numbers->SetComponent(row, k, none);
    }
  }
}

void SetAll(vtkIdList* list, const std::vector<std::int64_t>& rows)
{
  list->SetNumberOfIds(static_cast<vtkIdType>(rows.size()));
  std::ranges::copy(rows, list->GetPointer(0));
}

/**
 * Copies tuples, or fills the place where there are none; first is the place of the first one.
 */
void CopyTuples(const ArrayForm& form, vtkAbstractArray* from, vtkIdList* rows, vtkIdType first,
  vtkAbstractArray* to)
{
  if (!Has(form, from))
  {
    FillNone(to, first, first + rows->GetNumberOfIds());
    return;
  }
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(rows->GetNumberOfIds());
  for (vtkIdType i = 0; i < rows->GetNumberOfIds(); ++i)
  {
    places->SetId(i, first + i);
  }
  to->InsertTuples(places, rows, from);
}

/**
 * Returns the arrays of the first rank with current rows, else of the first with rows of the reference frame.
 */
std::vector<ArrayForm> ShareForms(
  vtkDataSetAttributes* current, vtkDataSetAttributes* reference, granular::Communicator& ranks)
{
  KnownForms own;
  own.Rows = current->GetNumberOfTuples() > 0 ? 2 : reference->GetNumberOfTuples() > 0 ? 1 : 0;
  vtkDataSetAttributes* const data = own.Rows == 1 ? reference : current;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const char* name = array->GetName();
    if (name && *name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) != 0)
    {
      own.Forms.push_back({ name, array->GetDataType(), array->GetNumberOfComponents() });
    }
  }
  const std::vector<KnownForms> all = granular::gather(ranks, own);
  return std::ranges::max_element(all, {}, &KnownForms::Rows)->Forms;
}
}

void KeptFrames::Begin(
  vtkAlgorithm* consumer, const InputFrames::Part& part, granular::Communicator& ranks)
{
  const std::vector<vtkMTimeType> changed = FindChanged(consumer);
  const bool same =
    changed == this->Changed && part.Piece == this->Part.Piece && part.Pieces == this->Part.Pieces;
  std::int64_t others = same ? 0 : 1;
  ranks.sum({ &others, 1 });
  if (others > 0)
  {
    this->Kept.clear();
    this->Empty = 0;
  }
  this->Changed = changed;
  this->Part = part;
  this->Shown.clear();
  for (const int port : FindInputs(consumer))
  {
    vtkDataObject* data = consumer->GetInputDataObject(port, 0);
    this->Shown.push_back(data ? Copy(data) : nullptr);
  }
  const InputFrames frames(consumer, part);
  this->Times = frames.GetTimes();
  CheckTimes(this->Times, ranks);
  const std::optional<double> time = frames.GetTime() ? frames.GetTime() : frames.GetShownTime();
  const auto after = time ? std::ranges::upper_bound(this->Times, *time) : this->Times.begin();
  this->ShownNumber =
    static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - this->Times.begin() - 1, 0));
}

FrameData KeptFrames::Get(vtkAlgorithm* consumer, std::size_t number, granular::Communicator& ranks)
{
  this->Last = number;
  if (number == this->ShownNumber)
  {
    return this->Shown;
  }
  const double time = this->Times[number];
  std::int64_t missing = this->Kept.contains(time) ? 0 : 1;
  ranks.sum({ &missing, 1 });
  if (missing > 0)
  {
    this->Kept[time] = this->Read(consumer, time, ranks);
  }
  return this->Kept[time];
}

std::size_t KeptFrames::FindFirst(vtkAlgorithm* consumer, granular::Communicator& ranks)
{
  for (; this->Empty < this->ShownNumber; ++this->Empty)
  {
    const FrameData data = this->Get(consumer, this->Empty, ranks);
    auto* points = vtkPointSet::SafeDownCast(data[0]);
    std::int64_t count = points ? points->GetNumberOfPoints() : 1; // others are refused later
    ranks.sum({ &count, 1 });
    if (count > 0)
    {
      break;
    }
    this->Kept.erase(this->Times[this->Empty]);
  }
  return std::min(this->Empty, this->ShownNumber);
}

FrameData KeptFrames::Read(vtkAlgorithm* consumer, double time, granular::Communicator& ranks) const
{
  FrameData frame;
  std::list<InputFrames> inputs; // which make the shown time the current one again at the end
  for (const int port : FindInputs(consumer))
  {
    InputFrames& input = inputs.emplace_back(consumer, this->Part, port);
    input.Update(time, ranks);
    frame.push_back(Copy(input.GetData()));
  }
  for (InputFrames& input : inputs)
  {
    input.Restore(ranks);
  }
  return frame;
}

void KeptFrames::End(bool keepShown)
{
  if (!this->Times.empty())
  {
    std::erase_if(
      this->Kept, [&](const auto& frame) { return frame.first != this->Times[this->Last]; });
    if (keepShown || this->Last == this->ShownNumber)
    {
      this->Kept[this->Times[this->ShownNumber]] = this->Shown;
    }
  }
  this->Shown.clear();
}

ChangedRows::ChangedRows(
  const std::vector<std::int64_t>& rows, const std::vector<std::int64_t>& lost)
{
  SetAll(this->Rows, rows);
  SetAll(this->Lost, lost);
}

vtkIdType ChangedRows::Count() const
{
  return this->Rows->GetNumberOfIds() + this->Lost->GetNumberOfIds();
}

vtkSmartPointer<vtkAbstractArray> ChangedRows::Combine(
  const ArrayForm& form, vtkAbstractArray* current, vtkAbstractArray* reference) const
{
  if (Has(form, current) && current->GetNumberOfTuples() == this->Rows->GetNumberOfIds() &&
    this->Lost->GetNumberOfIds() == 0)
  {
    return current;
  }
  vtkAbstractArray* const model = Has(form, current) ? current : reference;
  auto made = vtkSmartPointer<vtkAbstractArray>::Take(
    Has(form, model) ? model->NewInstance() : vtkAbstractArray::CreateArray(form.Type));
  made->SetName(form.Name.c_str());
  made->SetNumberOfComponents(form.Components);
  made->SetNumberOfTuples(this->Count());
  if (model)
  {
    made->CopyComponentNames(model);
  }
  CopyTuples(form, current, this->Rows, 0, made);
  CopyTuples(form, reference, this->Lost, this->Rows->GetNumberOfIds(), made);
  return made;
}

void ChangedRows::Pass(vtkDataSetAttributes* current, vtkDataSetAttributes* reference,
  granular::Communicator& ranks, vtkDataSetAttributes* output) const
{
  for (const ArrayForm& form : ShareForms(current, reference, ranks))
  {
    const char* const name = form.Name.c_str();
    output->AddArray(
      this->Combine(form, current->GetAbstractArray(name), reference->GetAbstractArray(name)));
  }
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = current->GetAbstractAttribute(type);
    const char* const name = active ? active->GetName() : nullptr;
    if (name && output->HasArray(name))
    {
      output->SetActiveAttribute(name, type);
    }
  }
}
}
