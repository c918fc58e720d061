// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/executor.h"

#include <algorithm>
#include <bit>

#include <windows.h>

namespace granular
{
/// Counts the group of up to 64 processors that the process begins in: before Windows 11 its threads do not leave that.
int machine_cores() noexcept
{
  SYSTEM_INFO info;
  ::GetSystemInfo(&info);
  return std::max(1, static_cast<int>(info.dwNumberOfProcessors));
}

int available_cores() noexcept
{
  DWORD_PTR own = 0;
  DWORD_PTR all = 0;
  return ::GetProcessAffinityMask(::GetCurrentProcess(), &own, &all) && own != 0
    ? std::popcount(own)
    : machine_cores();
}
}
