// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_error_of_h
#define granular_tests_support_error_of_h

#include "granular/common/error.h"

#include <string>

/// Returns what() of the error of this kind that a call throws, or "".
template <class Kind = granular::Error, class Call>
std::string error_of(const Call& call)
{
  try
  {
    call();
  }
  catch (const Kind& error)
  {
    return error.what();
  }
  return "";
}

#endif
