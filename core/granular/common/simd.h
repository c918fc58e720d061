// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_simd_h
#define granular_common_simd_h

#include <cstdint>

#if defined(__x86_64__) && defined(__GNUC__)
#define GRANULAR_X86 1
#endif

namespace granular
{
/// Instruction sets that text is decoded with; results do not depend on the choice.
enum class Simd : std::uint8_t
{
  Portable,
  Avx2,
  Avx512
};

/// The best one this processor has.
Simd best_simd() noexcept;
}
#endif
