// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/history_layout.h"

#include <cstddef>
#include <iterator>

namespace granular
{
namespace
{
constexpr std::size_t most_values = 14;

/// Names that all have, then the length, then the damage. Bonds act on their first particle (bond_gran.cpp of each program).
constexpr std::string_view pfm[] = { "force_normalx", "force_normaly", "force_normalz",
  "force_tangentialx", "force_tangentialy", "force_tangentialz", "torque_normalx", "torque_normaly",
  "torque_normalz", "torque_tangentialx", "torque_tangentialy", "torque_tangentialz",
  "initial_length" };

constexpr std::string_view fibers[most_values] = { pfm[0], pfm[1], pfm[2], pfm[3], pfm[4], pfm[5],
  pfm[6], pfm[7], pfm[8], pfm[9], pfm[10], pfm[11], "equilibrium_length", "damage" };

constexpr HistoryLayout layouts[] = {
  { "WITH-BONDS", "", std::span(pfm).first(12) },
  { "PFM", "LIGGGHTS-PFM", pfm },
  { "FlexibleFibers", "", std::span(fibers).first(13) },
  { "FlexibleFibersDamage", "", fibers },
};
}

std::span<const HistoryLayout> history_layouts() noexcept
{
  return layouts;
}

const HistoryLayout* find_history_layout(
  int layout, std::string_view version, std::int64_t values) noexcept
{
  const HistoryLayout* found = nullptr;
  int place = 0;
  for (const HistoryLayout& candidate : layouts)
  {
    const bool asked = layout == automatic_history || layout == place++;
    const bool says_so =
      found && !found->version.empty() && version.find(found->version) != version.npos;
    found = asked && std::ssize(candidate.columns) == values && !says_so ? &candidate : found;
  }
  return found;
}

std::vector<std::string> history_columns(int layout, std::string_view version, std::int64_t values)
{
  if (const HistoryLayout* const found = find_history_layout(layout, version, values))
  {
    return { found->columns.begin(), found->columns.end() };
  }
  std::vector<std::string> names;
  for (std::int64_t i = 1; i <= values; ++i)
  {
    names.push_back("history" + std::to_string(i));
  }
  return names;
}
}
