// SPDX-License-Identifier: BSD-3-Clause
// A program outside the project: prints the version it found, and how the core names a place.
#include "granular/base/error.h"

#include <cstdio>

int main()
{
  const granular::FormatError error("expected a number", { "grains.dump", 3, -1, "x" });
  std::printf("Granular %s\n%s\n", GRANULAR_VERSION, error.what());
  return error.where().line == 3 ? 0 : 1;
}
