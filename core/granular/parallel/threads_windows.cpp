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

/// atomic::wait of the libstdc++ of MinGW may miss a notification.
void Turns::wait(std::size_t chunk) const noexcept
{
  for (std::size_t next = next_.load(); next != chunk; next = next_.load())
  {
    ::WaitOnAddress(const_cast<std::atomic<std::size_t>*>(&next_), &next, sizeof next, INFINITE);
  }
}

void Turns::pass(std::size_t chunk) noexcept
{
  next_.store(chunk + 1);
  ::WakeByAddressAll(&next_);
}
}
