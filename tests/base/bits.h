// SPDX-License-Identifier: BSD-3-Clause
// What is the same on all machines: results as text, to compare those of several builds.
#ifndef tests_base_bits_h
#define tests_base_bits_h

#include <string>

/// A line for each result: what it is, and a hash of its bits.
std::string result_bits();
#endif
