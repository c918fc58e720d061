// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPieceRequest_h
#define vtkGranularPieceRequest_h

#include "granular/common/archive.h"
#include "granular/parallel/communicator.h"

#include "vtkType.h"

#include <functional>
#include <set>
#include <string>
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

/**
 * Returns true if the ranks request the pieces of one thing, each its own; they then read it together. Otherwise each
 * rank is alone, for example if a filter asks one rank for another time. Ranks that read together must agree on the
 * names of the arrays and on everything that form(archive) writes. Collective.
 */
bool AskTogether(granular::Communicator& ranks, const PieceRequest& wanted,
  const std::set<std::string>& arrays, const std::function<void(granular::ArchiveWriter&)>& form);
}

#endif
