// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_progress_h
#define granular_base_progress_h

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
}
#endif
