// SPDX-License-Identifier: BSD-3-Clause
// What a case under load costs, and how large it is.
#ifndef granular_tests_faults_load_h
#define granular_tests_faults_load_h

#include "../support/resident_memory.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>

/// Returns the size of a case: the long form has GRANULAR_LOAD=full in its environment.
inline std::int64_t size_of_load(std::int64_t quick, std::int64_t full)
{
  const char* const load = std::getenv("GRANULAR_LOAD");
  return load != nullptr && std::string(load) == "full" ? full : quick;
}

inline std::int64_t open_descriptors()
{
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return std::distance(begin(all), end(all)) - 1; // without that of the question
}

constexpr std::int64_t mebibyte = std::int64_t{ 1 } << 20;

/// Measures a case from its beginning, and tells at its end.
class Load
{
public:
  explicit Load(std::string what)
    : what_(std::move(what))
  {
    before_ = restart_peak();
    descriptors_ = open_descriptors();
    start_ = std::chrono::steady_clock::now();
  }

  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

  /// Expects no more than so much memory, and tells what the case took.
  void end(std::int64_t most)
  {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    const std::int64_t peak = peak_bytes() - before_;
    std::printf("load | %s | %.1f s | %.0f MiB of %.0f | %lld descriptors more\n", what_.c_str(),
      seconds.count(), static_cast<double>(peak) / mebibyte, static_cast<double>(most) / mebibyte,
      static_cast<long long>(open_descriptors() - descriptors_));
    EXPECT_LE(peak, most) << what_;
  }

  /// Expects as many open descriptors as at the beginning.
  void expect_closed() const { EXPECT_EQ(open_descriptors(), descriptors_) << what_; }

private:
  std::string what_;
  std::int64_t before_ = 0;
  std::int64_t descriptors_ = 0;
  std::chrono::steady_clock::time_point start_;
};

#endif
