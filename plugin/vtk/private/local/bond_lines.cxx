// SPDX-License-Identifier: BSD-3-Clause
#include "private/local/bond_lines.h"

#include "private/arrays/arrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <utility>

namespace vtkGranularPrivate
{
namespace
{
vtkSmartPointer<vtkAbstractArray> TakeValues(
  const char* name, granular::ValueType type, granular::Block& block, vtkIdType bonds)
{
  granular::DumpArray array;
  array.info.name = name;
  array.info.type = type;
  array.info.columns = { 0 };
  array.block = std::move(block);
  return TakeArray(array, bonds, { { name, type } });
}
}

void FillBonds(vtkPolyData* output, granular::GrainBonds& bonds)
{
  const auto count = static_cast<vtkIdType>(bonds.count);
  output->SetPoints(TakePoints(bonds.points, 2 * count, false, {}));
  output->SetLines(MakeCells(count, 2));
  const auto length =
    TakeValues("equilibrium_length", granular::ValueType::Float64, bonds.equilibrium_length, count);
  vtkNew<vtkDoubleArray> present;
  present->DeepCopy(length);
  present->SetName("length");
  vtkCellData* data = output->GetCellData();
  data->AddArray(TakeValues("id1", granular::ValueType::Int64, bonds.id1, count));
  data->AddArray(TakeValues("id2", granular::ValueType::Int64, bonds.id2, count));
  data->AddArray(TakeValues("btype", granular::ValueType::Int32, bonds.btype, count));
  data->AddArray(length);
  data->AddArray(present);
}
}
