// SPDX-License-Identifier: BSD-3-Clause
// Which calls of many a test lets fail.
#ifndef granular_tests_faults_fault_numbers_h
#define granular_tests_faults_fault_numbers_h

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

/// The environment asks for all calls: GRANULAR_FAULTS=all.
inline bool all_faults_wanted()
{
  const char* const wanted = std::getenv("GRANULAR_FAULTS");
  return wanted != nullptr && std::string(wanted) == "all";
}

/// The number of the call that fails after call `number` has: the next one, or of many calls the first and then some, spread over
/// all, about `most` of each.
inline long next_number(long number, long calls, long most)
{
  const long step = all_faults_wanted() ? 1 : std::max(1L, calls / most);
  return number + (number < std::min(step, most) ? 1 : step);
}

/// Counts the faults of a test, and prints their number at its end.
class FaultCount
{
public:
  void add(bool fired = true) { faults_ += fired ? 1 : 0; }

  explicit FaultCount(bool says = true)
    : says_(says)
  {
  }
  FaultCount(const FaultCount&) = delete;
  ~FaultCount()
  {
    if (says_)
    {
      std::printf("faults: %ld\n", faults_);
    }
  }

private:
  bool says_;
  long faults_ = 0;
};
#endif
