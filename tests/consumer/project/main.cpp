// SPDX-License-Identifier: BSD-3-Clause
// A program outside the project: prints the version it found and how the core names a place, and
// unpacks a few bytes.
#include "granular/granular.h"

#include <cstddef>
#include <cstdio>
#include <string_view>

namespace
{
/// A Zstandard frame around three bytes: the libraries that the core stands on are linked, too.
bool unpacks()
{
  constexpr std::string_view packed("\x28\xb5\x2f\xfd\0\x50\x19\0\0abc", 12);
  char content[4] = {};
  const std::size_t got =
    granular::unpack(granular::open_memory(packed))->read(0, content, sizeof content);
  return std::string_view(content, got) == "abc";
}
}

int main()
{
  const granular::FormatError error("expected a number", { "grains.dump", 3, -1, "x" });
  std::printf("Granular %s\n%s\n", GRANULAR_VERSION, error.what());
  return error.where().line == 3 && unpacks() ? 0 : 1;
}
