// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_simd_h
#define granular_common_simd_h

#include <cstdint>
#include <span>

#if defined(__x86_64__) && defined(__GNUC__)
#define GRANULAR_X86 1
#endif

namespace granular
{
/// Instruction sets for text and sums; the results are the same for all.
enum class Simd : std::uint8_t
{
  Portable,
  Avx2,
  Avx512
};

/// Returns those of this processor, the best one last.
std::span<const Simd> instruction_sets() noexcept;

/// Returns the best one of this processor.
Simd best_simd() noexcept;

/// Returns its name: "portable", "AVX2" or "AVX-512".
const char* to_string(Simd simd) noexcept;
}
#endif
