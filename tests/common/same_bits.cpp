// SPDX-License-Identifier: BSD-3-Clause
// Averages, packings, positions and cuts have the same bits however the library is compiled: this build against one for
// processors with fused multiply-add, which compilers would use for a product and a sum.
#include "bits.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>
#include <string>

namespace
{
std::string output_of(const std::string& program)
{
  std::string text;
  FILE* const pipe = popen(("'" + program + "'").c_str(), "r");
  if (!pipe)
  {
    return text;
  }
  char buffer[4096];
  for (std::size_t size = 0; (size = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
  {
    text.append(buffer, size);
  }
  EXPECT_EQ(pclose(pipe), 0) << program;
  return text;
}
}

TEST(SameBits, WithFusedMultiplyAdd)
{
  if (!__builtin_cpu_supports("fma") || !__builtin_cpu_supports("avx2"))
  {
    GTEST_SKIP() << "this processor has no fused multiply-add";
  }
  std::istringstream own(result_bits());
  std::istringstream other(output_of(GRANULAR_BITS_FMA));
  int lines = 0;
  std::string line;
  for (std::string wanted; std::getline(own, wanted); ++lines)
  {
    ASSERT_TRUE(std::getline(other, line)) << wanted;
    EXPECT_EQ(line, wanted);
  }
  EXPECT_FALSE(std::getline(other, line)) << line;
  EXPECT_GT(lines, 100);
}
