// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularPool_h
#define vtkGranularPool_h

#include "granular/common/error.h"
#include "granular/memory/block_pool.h"

#include <memory>

namespace vtkGranularPrivate
{
/**
 * Returns the memory pool of a reader. The environment variable GRANULAR_POOL_MIB sets how many MiB the pool may keep.
 * If it is not set, or is not a number, which gives a notice, the limit is an eighth of the memory that the process may
 * use. Returns null for 0: no pool.
 */
std::shared_ptr<granular::BlockPool> MakePool(granular::Notices& notices);
}

#endif
