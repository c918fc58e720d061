// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularWeights_h
#define vtkGranularWeights_h

#include "vtkGranularEulerAverage.h"

#include "granular/euler/cell_weights.h"

#include <algorithm>

namespace vtkGranularPrivate
{
/**
 * Returns the weights that the properties of the average give; a width of 0 is the largest diameter.
 */
inline granular::WeightOptions MakeWeights(
  int weights, double width, int bounds, double largestRadius)
{
  using Average = vtkGranularEulerAverage;
  constexpr granular::CellWeights ways[] = { granular::CellWeights::Centre,
    granular::CellWeights::Overlap, granular::CellWeights::Kernel };
  constexpr granular::KernelShape shapes[] = { granular::KernelShape::Gaussian,
    granular::KernelShape::Lucy, granular::KernelShape::Heaviside };
  granular::WeightOptions options;
  options.weights = ways[std::min<int>(weights, Average::GAUSSIAN)];
  options.kernel = shapes[std::max<int>(weights - Average::GAUSSIAN, 0)];
  options.bounds =
    bounds == Average::INSIDE ? granular::KernelBounds::Inside : granular::KernelBounds::None;
  const double diameter = largestRadius > 0 ? 2 * largestRadius : 1; // without particles any does
  options.width = width != 0 ? width : diameter;
  return options;
}
}

#endif
