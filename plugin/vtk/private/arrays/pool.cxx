// SPDX-License-Identifier: BSD-3-Clause
#include "private/arrays/pool.h"

#include "granular/numbers/number.h"

#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

namespace vtkGranularPrivate
{
namespace
{
constexpr const char* Variable = "GRANULAR_POOL_MIB";

/**
 * More than the arrays of a frame that fits in memory together with what is made from it, so that all of
 * it comes back; and little enough to wait for a next frame. 0 if the system does not say what it has.
 */
std::size_t DefaultLimit()
{
  vtksys::SystemInformation system;
  const long long kib = system.GetProcMemoryAvailable();
  return static_cast<std::size_t>(std::max(kib, 0LL)) / 8 * 1024;
}

std::size_t Limit(granular::Notices& notices)
{
  const char* value = std::getenv(Variable);
  if (!value || !*value)
  {
    return DefaultLimit();
  }
  const std::string text = value;
  std::int64_t mib = -1;
  if (!granular::parse_int64(text.data(), text.data() + text.size(), mib) || mib < 0)
  {
    granular::Notice notice;
    notice.text = std::string("expected a number of MiB in ") + Variable + ", got '" + text +
      "'; memory is kept as if it were not set";
    notices.push_back(notice);
    return DefaultLimit();
  }
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() >> 20;
  return static_cast<std::size_t>(std::min(mib, most)) << 20;
}
}

std::shared_ptr<granular::BlockPool> MakePool(granular::Notices& notices)
{
  const std::size_t limit = Limit(notices);
  return limit > 0 ? std::make_shared<granular::BlockPool>(limit) : nullptr;
}
}
