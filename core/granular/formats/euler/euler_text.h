// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_euler_euler_text_h
#define granular_formats_euler_euler_text_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/grid/cells.h"

#include <cstdint>
#include <string>

namespace granular
{
/// Dialects of the file of dump euler/vtk.
enum class EulerDialect : std::uint8_t
{
  Liggghts, ///< byte for byte as LIGGGHTS: %f, which has six decimals, of type float
  Wide,     ///< the same lines, but of type double with the fewest digits that read back the same
  Automatic ///< Liggghts if that text has the same values and centres worth no notice, otherwise Wide
};

/// Returns the file: points and the arrays v_avg, volumefraction, radius, pressure; Wide also has sigma and tau if they are known.
/// One notice tells how much %f loses, if that is too much, see RoundingLoss, or centres become equal; values other than radii
/// are compared with the largest of their array. Throws Error if all centres along an axis would become equal; Cancelled.
std::string encode_euler(
  const EulerCells& cells, EulerDialect dialect, Notices& notices, Progress& progress);
}
#endif
