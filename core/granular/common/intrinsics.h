// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_intrinsics_h
#define granular_common_intrinsics_h

// The intrinsics of x86, for sources that use many of them: warnings that come from inside them are off in the rest of the source.

// GCC 12 takes the deliberately undefined operands inside its own intrinsics for a mistake of the
// caller (GCC bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
// Without optimisation its intrinsics are macros, so the conversions inside them stand where they are used.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif

#include <immintrin.h>
#endif
