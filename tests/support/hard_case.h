// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_hard_case_h
#define granular_tests_support_hard_case_h

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

/// A row of the table of hard cases in docs/measurements/hard_cases.md: what is promised for a quantity where it is difficult, and the
/// worst of many trials. The test fails where the worst is above the bound, or where nothing was tried.
///
/// tests/lint/hard_cases.py finds each of these in the sources: subject, quantity and unit are literals on one or several
/// lines, and the bound is a literal too. Where GRANULAR_HARD_CASES names a folder, the figures are written to a file there,
/// named after the test.
class HardCase
{
public:
  HardCase(std::string subject, std::string quantity, std::string unit, double bound)
    : subject_(std::move(subject))
    , quantity_(std::move(quantity))
    , unit_(std::move(unit))
    , bound_(bound)
  {
  }

  HardCase(const HardCase&) = delete;
  HardCase& operator=(const HardCase&) = delete;

  /// Adds the error of so many trials, the largest of them. No number is the worst of all.
  void add(double error, std::int64_t trials = 1)
  {
    worst_ = std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(worst_, error);
    trials_ += trials;
  }

  ~HardCase()
  {
    EXPECT_GT(trials_, 0) << subject_ << ": " << quantity_;
    EXPECT_LE(worst_, bound_) << subject_ << ": " << quantity_ << " [" << unit_ << "]";
    const char* const folder = std::getenv("GRANULAR_HARD_CASES");
    if (folder == nullptr)
    {
      return;
    }
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::ranges::replace(name, '/', '_'); // of tests with parameters
    std::ofstream out(std::string(folder) + "/" + name, std::ios::app);
    out.precision(17);
    out << subject_ << '\t' << quantity_ << '\t' << unit_ << '\t' << bound_ << '\t' << worst_
        << '\t' << trials_ << '\n';
    EXPECT_TRUE(out.good()) << folder;
  }

private:
  std::string subject_, quantity_, unit_;
  double bound_;
  double worst_ = 0;
  std::int64_t trials_ = 0;
};
#endif
