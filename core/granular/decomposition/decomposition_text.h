// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_decomposition_text_h
#define granular_decomposition_decomposition_text_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/decomposition/subdomains.h"

#include <string>

namespace granular
{
/// A legacy VTK file (version 3.0, ASCII) with an unstructured grid of voxels: as LIGGGHTS-INL writes it - points in
/// that order, cell arrays nlocal and proc, as far as they are known - but with the right order of corners, coordinates
/// as doubles with the fewest digits that read back the same, and counts of 2^31 and more as vtktypeint64. Throws
/// Cancelled.
std::string encode_voxels(const Decomposition& decomposition, Progress& progress);

/// The rectilinear grid that LIGGGHTS-PUBLIC writes, byte for byte (%f: six decimals). A notice says where these are
/// too few: cuts that differ become equal, or one moves by more than a thousandth of the thinnest slab. Throws Error
/// where the box would become flat, and
/// UnsupportedError where the subdomains do not form a grid, which is all that such a file can hold.
std::string encode_grid(const Decomposition& decomposition, Notices& notices);
}
#endif
