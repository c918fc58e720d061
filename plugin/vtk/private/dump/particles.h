// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularParticles_h
#define vtkGranularParticles_h

#include "private/dump/dump_input.h"
#include "private/request/piece_request.h"

#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"

#include <optional>
#include <utility>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The particles that filters on several processes work on.
 */
class Particles
{
public:
  /**
   * What this process has of a data object. Throws, on all, if it is no vtkPointSet, and what DumpInput and
   * share_header throw. Collective.
   */
  Particles(vtkDataObject* input, granular::Communicator& ranks);

  /**
   * What all know: see granular::share_header.
   */
  granular::FrameView& View() { return this->Input->View; }
  const granular::FrameView& View() const { return this->Input->View; }

  /**
   * The box: bounds that are given where the lower one is not above the upper one, else those of the field data. Throws
   * Error where there are none; UnsupportedError for a tilted box, with what follows from it, or, where tilted is null, for one
   * that has no bounds along the axes.
   */
  std::pair<granular::Vector3, granular::Vector3> FindBounds(
    const double given[6], const char* tilted) const;

private:
  std::optional<DumpInput> Input;
};

/**
 * Whether a process asks for the part of the whole that is its own. Who asks for another one gets it from the whole.
 */
bool IsOwn(const PieceRequest& wanted, const granular::Communicator& ranks);

/**
 * True: each process has asked for its own part of a whole. False: each has asked for all, or is alone. Throws
 * UnsupportedError where some have and some have not, if they must not. Collective.
 */
bool AreTogether(const PieceRequest& wanted, bool mayDiffer, granular::Communicator& ranks);
}

#endif
