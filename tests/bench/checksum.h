// SPDX-License-Identifier: BSD-3-Clause
// What other programs tell of the values that they have.
#ifndef tests_bench_checksum_h
#define tests_bench_checksum_h

#include "dump_text.h"

#include <cstdint>
#include <string>

namespace bench
{
/// CRC-32 of each array, in decimal, separated by blanks; of the rows from one on, and then of those
/// before it.
std::string checksums(const Output& output, std::int64_t rows, std::int64_t first_row = 0);
}
#endif
