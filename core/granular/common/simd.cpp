// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/simd.h"

#include <array>
#include <cstddef>

namespace granular
{
std::span<const Simd> instruction_sets() noexcept
{
#if GRANULAR_X86
  static constexpr std::array sets{ Simd::Portable, Simd::Avx2, Simd::Avx512 };
  static const std::size_t count = []
  {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("popcnt");
    const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2");
    return std::size_t{ avx2 && avx512 ? 3U : avx2 ? 2U : 1U };
  }();
  return std::span(sets).first(count);
#else
  static constexpr std::array sets{ Simd::Portable };
  return sets;
#endif
}

Simd best_simd() noexcept
{
  return instruction_sets().back();
}

const char* to_string(Simd simd) noexcept
{
  static constexpr std::array names{ "portable", "AVX2", "AVX-512" };
  return names[static_cast<std::size_t>(simd)];
}
}
