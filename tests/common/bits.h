// SPDX-License-Identifier: BSD-3-Clause
// What is the same on all machines: results as text, to compare those of several builds.
#ifndef granular_tests_common_bits_h
#define granular_tests_common_bits_h

#include <string>

/// A line for each result: what it is, and a hash of its bits.
std::string result_bits();
#endif
