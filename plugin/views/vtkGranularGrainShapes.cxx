// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainShapes.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
using Arrays = std::vector<vtkDataArray*>;
using Names = std::vector<const char*>;

// Returns the first set of arrays that is there, with as many components together; empty if none is.
Arrays Find(vtkDataSet* data, const std::vector<Names>& sets, int components)
{
  for (const Names& names : sets)
  {
    Arrays found;
    for (const char* name : names)
    {
      vtkDataArray* array = data->GetPointData()->GetArray(name);
      if (array && array->GetNumberOfComponents() * static_cast<int>(names.size()) == components)
      {
        found.push_back(array);
      }
    }
    if (found.size() == names.size())
    {
      return found;
    }
  }
  return {};
}

// Leaves the numbers as they are if there are no arrays.
void GetNumbers(const Arrays& arrays, vtkIdType i, double* numbers)
{
  for (vtkDataArray* array : arrays)
  {
    array->GetTuple(i, numbers);
    numbers += array->GetNumberOfComponents();
  }
}

std::string TextOf(vtkFieldData* fields, const char* name)
{
  vtkAbstractArray* array = fields ? fields->GetAbstractArray(name) : nullptr;
  return array && array->GetNumberOfValues() == 1 ? array->GetVariantValue(0).ToString()
                                                  : std::string();
}

bool AreDiameters(vtkFieldData* fields, int sizes)
{
  const std::string said = TextOf(fields, "ShapeSizes");
  return sizes == vtkGranularGrainShapes::Diameters ||
    (sizes == vtkGranularGrainShapes::AsTheDataSay &&
      (said == "Diameters" || (said.empty() && TextOf(fields, "Dialect") == "LAMMPS")));
}

// Returns the length of the longest vector whose components, by lengths a and b, have powers n that sum up to 1, by Hoelder's inequality.
double Longest(double a, double b, double n)
{
  const double most = std::max(a, b);
  if (n <= 2.0 || most <= 0.0)
  {
    return most;
  }
  const double power = 2.0 * n / (n - 2.0);
  return most * std::pow(1.0 + std::pow(std::min(a, b) / most, power), 1.0 / power);
}
}

vtkGranularGrainShapes::vtkGranularGrainShapes(vtkDataSet* data, int sizes)
  : Turns(Find(data,
      { { "quat" }, { "quatw", "quati", "quatj", "quatk" }, { "quat1", "quat2", "quat3", "quat4" },
        { "c_q" }, { "c_quat" } },
      4))
  , Powers(Find(data,
      { { "blockiness" }, { "blockiness1", "blockiness2" }, { "block1", "block2" }, { "c_block" } },
      2))
  , Factor(AreDiameters(data->GetFieldData(), sizes) ? 0.5 : 1.0)
{
  std::vector<Names> names = { { "shape" }, { "shapex", "shapey", "shapez" } };
  if (!this->Turns.empty())
  {
    names.insert(names.end(), { { "c_shape" }, { "c_s" }, { "c_diameter" } });
  }
  this->Sizes = Find(data, names, 3);
}

vtkGranularGrainShapes::Shape vtkGranularGrainShapes::Get(vtkIdType i, double radius) const
{
  Shape shape{ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0, 0.0 }, { 2.0, 2.0 }, radius, radius };
  auto& axes = shape.Axes;
  GetNumbers(this->Sizes, i, axes.data());
  std::for_each(axes.begin(), axes.end(), [this](double& axis) { axis *= this->Factor; });
  const double least = *std::min_element(axes.begin(), axes.end());
  if (!(least > 0.0 && std::isfinite(axes[0] + axes[1] + axes[2])))
  {
    axes.fill(radius);
    return shape;
  }
  GetNumbers(this->Powers, i, shape.Powers.data());
  for (double& power : shape.Powers)
  {
    power = std::isfinite(power) ? std::max(power, 2.0) : 2.0;
  }
  std::array<double, 4> turn = shape.Turn;
  GetNumbers(this->Turns, i, turn.data());
  const double length =
    std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
  if (length > 0.0 && std::isfinite(length))
  {
    std::transform(
      turn.begin(), turn.end(), shape.Turn.begin(), [=](double part) { return part / length; });
  }
  shape.Outer = Longest(Longest(axes[0], axes[1], shape.Powers[1]), axes[2], shape.Powers[0]);
  shape.Inner = least;
  return shape;
}
