// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_stop_h
#define granular_tests_support_stop_h

#include "granular/common/progress.h"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

/// Expects reports from the thread that made it, from 0 to 1 without a step back. Stops behind so many, or at a fraction.
class Stop final : public granular::Progress
{
public:
  static constexpr int never = std::numeric_limits<int>::max();

  explicit Stop(int most = never, double below = 2)
    : most_(most)
    , below_(below)
  {
  }

  bool report(double fraction) override
  {
    EXPECT_EQ(std::this_thread::get_id(), caller_);
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return ++reports <= most_ && fraction < below_;
  }

  int reports = 0;
  double last = 0;

private:
  std::thread::id caller_ = std::this_thread::get_id();
  int most_;
  double below_;
};

#endif
