// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_step_clock_h
#define granular_numbers_step_clock_h

#include <cstdint>

namespace granular
{
/// Computes times from timesteps.
class StepClock
{
public:
  /// step_size: the time of one step; finite, greater than 0.
  explicit StepClock(double step_size) noexcept;

  /// Returns the double nearest to step times the shortest decimal number that reads back as step_size, ties to even;
  /// infinite if the product is too large. Three steps of 1e-05 give 3e-05, whereas the product of the two doubles is
  /// 3.0000000000000004e-05.
  double time(std::int64_t step) const noexcept;

private:
  std::uint64_t digits_; ///< at most 17
  int power_;            ///< of ten
};
}
#endif
