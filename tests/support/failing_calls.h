// SPDX-License-Identifier: BSD-3-Clause
// Makes the calls fail by which this process opens, asks and reads files. A program that has failing_calls.cpp among its sources
// calls that in place of the system, and so do the libraries that it uses.
#ifndef granular_tests_support_failing_calls_h
#define granular_tests_support_failing_calls_h

#include <limits>

/// What becomes of a call.
enum class CallFault
{
  None,
  Short,       ///< a read gives one byte
  Interrupted, ///< EINTR of a read, or of opening a file
  End,         ///< a read gives nothing, as at the end of the file
  Shortened,   ///< the file is cut in two before the read
  Zeros,       ///< a read gives other bytes: zeros
  Ones,        ///< bits that are all set
  Letters,     ///< x
  Moved,       ///< the bytes in the other order
  Error        ///< EIO of any call
};

/// Which calls fail: `count` of them from call `first` on, where each call counts for which there is such a fault.
struct FailingCalls
{
  static constexpr long always = std::numeric_limits<long>::max();

  CallFault fault = CallFault::None;
  long first = 1;
  long count = 1;
};

/// From now on; calls are counted anew.
void make_fail(const FailingCalls& calls);

/// How many calls there were since then: those that could fail so, or all of them.
long calls_that_may_fail();
long all_calls();
#endif
