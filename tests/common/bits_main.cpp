// SPDX-License-Identifier: BSD-3-Clause
// Prints the results of a build of its own, for same_bits.cpp.
#include "bits.h"

#include <cstdio>

int main()
{
  std::fputs(result_bits().c_str(), stdout);
  return 0;
}
