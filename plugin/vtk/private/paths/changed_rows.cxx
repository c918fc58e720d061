// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/changed_rows.h"

#include "granular/common/pass.h"
#include "granular/parallel/gather.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"

#include <algorithm>
#include <cstring>
#include <limits>

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
