// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_progress_h
#define granular_common_progress_h

#include <algorithm>

namespace granular
{
/// Thrown from a long task after Progress::report asked it to stop. Not an Error: nothing is wrong.
struct Cancelled
{
};

/// Reports the progress of a long task to its caller, and learns that it should stop. Called only on the caller's thread, at
/// most once per chunk.
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

  /// Reports, and throws Cancelled if the task should stop.
  void step(double fraction)
  {
    if (!this->report(fraction))
    {
      throw Cancelled{};
    }
  }
};

/// The progress of a part of a task, reported as that of the whole, which never decreases.
class PartialProgress final : public Progress
{
public:
  explicit PartialProgress(Progress& whole)
    : whole_(whole)
  {
  }

  /// Maps later reports to [first, last] of the whole.
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
