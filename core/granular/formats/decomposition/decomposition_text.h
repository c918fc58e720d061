// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_decomposition_decomposition_text_h
#define granular_formats_decomposition_decomposition_text_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/grid/subdomains.h"

#include <optional>
#include <string>

namespace granular
{
/// Returns a legacy VTK file (version 3.0, ASCII) with an unstructured grid of voxels, like LIGGGHTS-INL: points in that
/// order, cell arrays nlocal and proc if known. The corners are in the right order, coordinates are doubles with the fewest
/// digits that read back the same, and counts of 2^31 and more are vtktypeint64. Throws Cancelled.
std::string encode_voxels(const Decomposition& decomposition, Progress& progress);

/// Returns the same voxels and arrays as a .vtu file of text, with the field TimeValue if the time is known; nlocal has 64 bits if a
/// count needs them. Throws Cancelled.
std::string encode_vtu(
  const Decomposition& decomposition, std::optional<double> time, Progress& progress);

/// Returns the rectilinear grid of LIGGGHTS-PUBLIC, byte for byte (%f: six decimals). A notice tells if these are too few:
/// different cuts become equal, or one moves by more than a thousandth of the thinnest slab. Throws Error if the box would
/// become flat, and UnsupportedError if the subdomains do not form a grid, which is all that such a file can hold.
std::string encode_grid(const Decomposition& decomposition, Notices& notices);
}
#endif
