// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPieceRequest_h
#define vtkGranularPieceRequest_h

#include "vtkType.h"

#include <utility>

class vtkInformation;

namespace vtkGranularPrivate
{
/**
 * The part of a pipeline's piece that an output wants.
 */
struct PieceRequest
{
  int Piece = 0;
  int Pieces = 1;

  static PieceRequest Of(vtkInformation* output);

  /**
   * Those of so many things that belong to the piece: [first, last).
   */
  std::pair<vtkTypeInt64, vtkTypeInt64> RangeOf(vtkTypeInt64 count) const;
};
}

#endif
