// SPDX-License-Identifier: BSD-3-Clause
// Handles of granular.h that end by themselves, and files of real runs.
#ifndef granular_tests_c_handles_h
#define granular_tests_c_handles_h

#include "granular.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using RunHandle = std::unique_ptr<granular_run, decltype(&granular_close)>;
using FrameHandle = std::unique_ptr<granular_frame, decltype(&granular_release)>;

inline std::string message()
{
  return granular_last_error()->message;
}

/// A file of a real run: tests/data/good.
inline std::string good(const std::string& name)
{
  return std::string(GRANULAR_DATA) + "/good/" + name;
}

inline RunHandle open_run(const std::string& path, const granular_open_options* options = nullptr)
{
  granular_run* run = nullptr;
  const char* const name = path.c_str();
  EXPECT_EQ(granular_open(&name, 1, options, &run), GRANULAR_OK) << message();
  return { run, granular_close };
}

inline FrameHandle read_frame(
  const RunHandle& run, std::int64_t number, const granular_request* request = nullptr)
{
  granular_frame* frame = nullptr;
  EXPECT_EQ(granular_read(run.get(), number, request, &frame), GRANULAR_OK) << message();
  return { frame, granular_release };
}

inline granular_array array_of(const FrameHandle& frame, const char* name)
{
  granular_array array = {};
  EXPECT_EQ(granular_array_named(frame.get(), name, &array), GRANULAR_OK) << message();
  return array;
}

/// The values of an array of doubles.
inline std::vector<double> doubles(const FrameHandle& frame, const char* name)
{
  const granular_array array = array_of(frame, name);
  EXPECT_EQ(array.type, GRANULAR_FLOAT64);
  const auto* const values = static_cast<const double*>(array.data);
  return { values, values + array.rows * array.components };
}

inline std::string content(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}
#endif
