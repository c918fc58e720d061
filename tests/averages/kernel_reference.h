// SPDX-License-Identifier: BSD-3-Clause
// The values of mpmath that make_kernels.py has made.
#ifndef granular_tests_kernels_kernel_reference_h
#define granular_tests_kernels_kernel_reference_h

#include "granular/averages/smooth_cells.h"
#include "granular/bytes/byte_source.h"
#include "granular/geometry/box.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

struct LineCase
{
  granular::KernelShape shape;
  double width;
  granular::Vector3 point;
  granular::Vector3 branch;
  double mean;
};

struct NormCase
{
  granular::KernelShape shape;
  double width;
  double volume;
};

struct Reference
{
  std::vector<LineCase> lines;
  std::vector<NormCase> norms;
};

inline granular::KernelShape shape_of(const std::string& name)
{
  return name == "gaussian" ? granular::KernelShape::Gaussian
    : name == "lucy"        ? granular::KernelShape::Lucy
                            : granular::KernelShape::Heaviside;
}

/// The numbers are hexadecimal.
inline double next_number(std::istringstream& words)
{
  std::string word;
  words >> word;
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  EXPECT_TRUE(!word.empty() && *end == 0) << word;
  return number;
}

inline granular::Vector3 next_vector(std::istringstream& words)
{
  granular::Vector3 vector;
  for (double& component : vector)
  {
    component = next_number(words);
  }
  return vector;
}

inline Reference read_reference()
{
  const auto source =
    granular::unpack(granular::open_file(GRANULAR_DATA "/good/kernels/kernels.txt.gz"));
  std::istringstream lines(granular::read_up_to(*source, std::numeric_limits<std::int64_t>::max()));
  Reference reference;
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name == "norm")
    {
      words >> name;
      const double width = next_number(words);
      reference.norms.push_back({ shape_of(name), width, next_number(words) });
      continue;
    }
    LineCase one = { shape_of(name), next_number(words), {}, {}, 0 };
    one.point = next_vector(words);
    one.branch = next_vector(words);
    one.mean = next_number(words);
    reference.lines.push_back(one);
  }
  EXPECT_EQ(reference.lines.size(), 1820U);
  EXPECT_EQ(reference.norms.size(), 27U);
  return reference;
}
#endif
