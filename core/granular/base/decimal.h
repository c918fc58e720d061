// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_decimal_h
#define granular_base_decimal_h

#include <cstdint>

namespace granular
{
/// The double nearest to digits * 10^power, ties to even. 0 < digits.
///
/// One multiplication of 64 by 64 bits, rarely two, with a power of five of 128 bits tells the
/// double in almost all cases (D. Lemire, "Number parsing at a gigabyte per second", Software:
/// Practice and Experience 51, 2021). Returns false, and leaves value alone, in the others: where
/// the product is too near to the middle between two doubles, for subnormal numbers, and for powers
/// outside -64 to 64.
bool nearest_double(std::uint64_t digits, std::int64_t power, double& value) noexcept;
}
#endif
