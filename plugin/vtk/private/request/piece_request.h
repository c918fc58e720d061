// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPieceRequest_h
#define vtkGranularPieceRequest_h

#include "vtkType.h"

#include <utility>

class vtkAlgorithm;
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

/**
 * Lets ParaView's ranks keep the pieces that they request, where a reader finds new frames within an update. Call in
 * RequestInformation.
 *
 * UpdatePipeline of ParaView asks for information, sets the piece of the rank, and updates, which asks for information
 * again. If a file has changed in between, information is made anew, and VTK then sets the request to the whole: each rank
 * would read every particle. A key on the outputs goes downstream with the information, notes the pieces before VTK
 * overwrites them, and sets them again when the time is requested, which is the next step.
 */
void KeepPieces(vtkAlgorithm* self, vtkInformationVector* outputs);

/**
 * Forgets the pieces of earlier requests of an output. Call after UpdateInformation, before another piece is requested.
 */
void ForgetPieces(vtkInformation* output);
}

#endif
