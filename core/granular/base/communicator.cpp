// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/communicator.h"

#include <algorithm>

namespace granular
{
std::vector<std::string> SerialCommunicator::all_gather(std::string_view bytes)
{
  return { std::string(bytes) };
}

void SerialCommunicator::exchange(const char* from, std::span<const std::int64_t> from_bytes,
  char* to, std::span<const std::int64_t>)
{
  std::copy_n(from, from_bytes[0], to);
}

void agree(Communicator&, const std::exception_ptr& failure)
{
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}
}
