// SPDX-License-Identifier: BSD-3-Clause
// The correctly rounded sum of doubles by other means than the library's.
#ifndef granular_tests_euler_exact_sum_h
#define granular_tests_euler_exact_sum_h

#include <cmath>
#include <utility>
#include <vector>

/// Keeps the exact sum as doubles that do not overlap (J. R. Shewchuk, "Adaptive precision floating-point
/// arithmetic", Discrete Comput. Geom. 18, 1997); slow, for sums that do not overflow.
class ExactSum
{
public:
  void add(double x)
  {
    std::size_t kept = 0;
    for (double part : parts_)
    {
      if (std::abs(x) < std::abs(part))
      {
        std::swap(x, part);
      }
      const double hi = x + part;
      const double lo = part - (hi - x);
      if (lo != 0)
      {
        parts_[kept++] = lo;
      }
      x = hi;
    }
    parts_.resize(kept);
    parts_.push_back(x);
  }

  double value() const
  {
    std::size_t n = parts_.size();
    if (n == 0)
    {
      return 0;
    }
    double hi = parts_[--n];
    double lo = 0;
    while (n > 0)
    {
      const double x = hi;
      const double y = parts_[--n];
      hi = x + y;
      lo = y - (hi - x);
      if (lo != 0)
      {
        break;
      }
    }
    // a tie that what is below decides
    if (n > 0 && ((lo < 0 && parts_[n - 1] < 0) || (lo > 0 && parts_[n - 1] > 0)))
    {
      const double twice = lo * 2;
      const double up = hi + twice;
      if (twice == up - hi)
      {
        hi = up;
      }
    }
    return hi;
  }

private:
  std::vector<double> parts_; ///< the smallest first
};
#endif
