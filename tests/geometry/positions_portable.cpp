// SPDX-License-Identifier: BSD-3-Clause
// The tests of positions.cpp on the path for processors without fused multiply-add: built here a
// second time, with a processor that has nothing.
#define __builtin_cpu_supports(feature) false
#include "granular/geometry/convert_positions.cpp"
#undef __builtin_cpu_supports

#include "positions.cpp" // NOLINT: the same tests
