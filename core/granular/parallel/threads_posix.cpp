// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/executor.h"

#include <algorithm>

#include <sched.h>
#include <unistd.h>

namespace granular
{
int machine_cores() noexcept
{
  return std::max(1, static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN)));
}

int available_cores() noexcept
{
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
  {
    return std::max(1, CPU_COUNT(&set));
  }
  return machine_cores();
}

void Turns::wait(std::size_t chunk) const noexcept
{
  for (std::size_t next = next_.load(); next != chunk; next = next_.load())
  {
    next_.wait(next);
  }
}

void Turns::pass(std::size_t chunk) noexcept
{
  next_.store(chunk + 1);
  next_.notify_all();
}
}
