// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPieceRequest_h
#define vtkGranularPieceRequest_h

#include "vtkType.h"

#include <utility>

class vtkInformation;
class vtkInformationVector;

namespace vtkGranularPrivate
{
/**
 * The part of a pipeline's piece that an output requests.
 */
struct PieceRequest
{
  int Piece = 0;
  int Pieces = 1;

  static PieceRequest Of(vtkInformation* output);

  /**
   * Returns the part that the output requests through which a request came.
   */
  static PieceRequest Of(vtkInformation* request, vtkInformationVector* outputs);

  /**
   * Returns the part [first, last) of `count` things that belongs to the piece.
   */
  std::pair<vtkTypeInt64, vtkTypeInt64> RangeOf(vtkTypeInt64 count) const;
};
}

#endif
