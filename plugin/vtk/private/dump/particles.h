// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularParticles_h
#define vtkGranularParticles_h

#include "private/dump/dump_input.h"

#include "granular/geometry/box.h"
#include "granular/parallel/communicator.h"

#include <utility>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The particles that filters on several ranks work on.
 */
class Particles : public DumpInput
{
public:
  /**
   * Reads the particles of this rank from a data object; the header of the View is what all ranks share: see
   * granular::share_header. Throws on all ranks if it is not a vtkPointSet, and what DumpInput and share_header throw.
   * Collective.
   */
  Particles(vtkDataObject* input, granular::Communicator& ranks);

  /**
   * Returns the box: the given bounds if each lower one is below its upper one, otherwise the box in the field data.
   * Throws Error if there is none; UnsupportedError for a tilted box, with the text `tilted`, or, if tilted is null,
   * for a box without axis-aligned bounds.
   */
  std::pair<granular::Vector3, granular::Vector3> FindBounds(
    const double given[6], const char* tilted) const;
};
}

#endif
