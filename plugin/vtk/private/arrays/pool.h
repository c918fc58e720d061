// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPool_h
#define vtkGranularPool_h

#include "granular/common/error.h"
#include "granular/memory/block_pool.h"

#include <memory>

namespace vtkGranularPrivate
{
/**
 * The pool of a reader. The environment variable GRANULAR_POOL_MIB says how many MiB of memory it may
 * keep; an eighth of what the process may have where it is not set, or not a number, of which there is
 * a notice. Null for 0: no pool.
 */
std::shared_ptr<granular::BlockPool> MakePool(granular::Notices& notices);
}

#endif
