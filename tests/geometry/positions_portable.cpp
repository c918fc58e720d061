// SPDX-License-Identifier: BSD-3-Clause
// The tests of positions.cpp on the path for processors without fused multiply-add: built here a
// second time, with a processor that has nothing.
#include "granular/common/simd.h"
#undef GRANULAR_X86
#include "granular/geometry/convert_positions.cpp"

#include "positions.cpp" // NOLINT: the same tests
