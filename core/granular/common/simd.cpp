// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/simd.h"

namespace granular
{
Simd best_simd() noexcept
{
#if GRANULAR_X86
  static const Simd best = []
  {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("popcnt");
    const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2");
    return avx2 && avx512 ? Simd::Avx512 : avx2 ? Simd::Avx2 : Simd::Portable;
  }();
  return best;
#else
  return Simd::Portable;
#endif
}
}
