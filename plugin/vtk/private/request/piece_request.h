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

/**
 * Whether the ranks want the pieces of one thing, each its own: then they read it together. Else each is alone, such as where a
 * filter asks one rank for another time. What must be the same on ranks that read together are the names of the arrays, and all that
 * form(archive) writes. Collective.
 */
bool AskTogether(granular::Communicator& ranks, const PieceRequest& wanted,
  const std::set<std::string>& arrays, const std::function<void(granular::ArchiveWriter&)>& form);
}

#endif
