// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_progress_h
#define granular_common_progress_h

#include <algorithm>

namespace granular
{
/// Thrown out of a long task after Progress::report asked it to stop. Not an Error: nothing is wrong.
struct Cancelled
{
};

/// How a long task tells its caller how far it is, and hears that it should stop.
/// Called on the caller's thread only, at most once a chunk.
class Progress
{
public:
  virtual ~Progress() = default;

  /// fraction is in [0, 1]. Returns false to stop the task, which then throws Cancelled.
  virtual bool report(double fraction)
  {
    static_cast<void>(fraction);
    return true;
  }

  /// Reports, and throws Cancelled if the answer is to stop.
  void step(double fraction)
  {
    if (!this->report(fraction))
    {
      throw Cancelled{};
    }
  }
};

/// The progress of a part of a task, as that of the whole, which never goes back.
class PartialProgress final : public Progress
{
public:
  explicit PartialProgress(Progress& whole)
    : whole_(whole)
  {
  }

  /// What is reported from now on lies in [first, last] of the whole.
  void set_part(double first, double last) noexcept
  {
    first_ = first;
    last_ = last;
  }

  bool report(double fraction) override
  {
    reported_ = std::max(reported_, first_ + fraction * (last_ - first_));
    return whole_.report(reported_);
  }

private:
  Progress& whole_;
  double first_ = 0;
  double last_ = 1;
  double reported_ = 0;
};
}
#endif
