// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_caught_exception_h
#define granular_common_caught_exception_h

#include <exception>

namespace granular
{
/// Returns the exception that a catch-all has caught, to be thrown again later. The end of a thread, as by pthread_exit in a function
/// for progress, is no exception, and goes on at once.
inline std::exception_ptr caught_exception()
{
  std::exception_ptr caught = std::current_exception();
  if (!caught)
  {
    throw;
  }
  return caught;
}
}
#endif
