// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_memory_error_h
#define granular_common_memory_error_h

#include "granular/common/error.h"

namespace granular
{
/// Lack of memory on some rank: the same request may succeed another time, unlike other limits.
class MemoryError : public LimitError
{
  using LimitError::LimitError;
};
}
#endif
