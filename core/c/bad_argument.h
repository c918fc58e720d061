// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_c_bad_argument_h
#define granular_c_bad_argument_h

#include "granular/common/error.h"

namespace granular_c
{
/// An argument of the caller that cannot be used.
class BadArgument : public granular::Error
{
  using Error::Error;
};
}
#endif
