// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/contact_rows.h"

#include "granular/common/error.h"
#include "granular/parallel/trade.h"

#include <array>
#include <bit>

namespace granular
{
namespace
{
/// A span of the rows: whether it is known, its size and name.
struct Part
{
  const char* name;
  std::size_t size; ///< values
  std::size_t width;
  bool ContactKinds::*known;
};

std::array<Part, 7> parts_of(const ContactRows& rows) noexcept
{
  return { { { "id1", rows.id1.size(), 1, &ContactKinds::walls },
    { "ends", rows.ends.size(), 6, &ContactKinds::ends },
    { "force", rows.force.size(), 3, &ContactKinds::force },
    { "tangential", rows.tangential.size(), 3, &ContactKinds::tangential },
    { "torque", rows.torque.size(), 3, &ContactKinds::torque },
    { "contact_point", rows.contact_point.size(), 3, &ContactKinds::contact_point },
    { "overlap", rows.overlap.size(), 1, &ContactKinds::overlap } } };
}

bool are_usable(
  std::span<const double> values, std::size_t first, std::size_t count, std::size_t width) noexcept
{
  // by the bits, whose order is that of the numbers, infinities and nan above them: many at once
  constexpr auto most = std::bit_cast<std::uint64_t>(largest_usable);
  constexpr std::uint64_t sign = std::uint64_t{ 1 } << 63;
  std::uint64_t rest = 0;
  for (std::size_t i = first * width; !values.empty() && i < (first + count) * width; ++i)
  {
    rest |= most - (std::bit_cast<std::uint64_t>(values[i]) & ~sign);
  }
  return (rest & sign) == 0;
}
}

ContactKinds share_kinds(const ContactRows& rows, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      if (rows.id2.size() != rows.count)
      {
        throw Error("expected an id2 of each contact, got " + std::to_string(rows.id2.size()) +
          " for " + std::to_string(rows.count) + " contacts");
      }
      const std::array<Part, 7> parts = parts_of(rows);
      std::array<int, 8> own = { rows.count > 0 ? 1 : 0 };
      for (std::size_t i = 0; i < parts.size(); ++i)
      {
        own[i + 1] = parts[i].size > 0 ? 1 : 0;
        if (parts[i].size > 0 && parts[i].size != parts[i].width * rows.count)
        {
          throw Error("expected " + std::to_string(parts[i].width) + " values a contact in '" +
            parts[i].name + "', got " + std::to_string(parts[i].size) + " for " +
            std::to_string(rows.count) + " contacts");
        }
      }
      ContactKinds kinds;
      bool told = false;
      for (const std::array<int, 8>& each : gather(ranks, own))
      {
        for (std::size_t i = 0; each[0] != 0 && i < parts.size(); ++i)
        {
          const bool known = each[i + 1] != 0;
          if (told && kinds.*parts[i].known != known)
          {
            throw Error("expected the same arrays of contacts on all processes, got '" +
              std::string(parts[i].name) + "' on some");
          }
          kinds.*parts[i].known = known;
        }
        told = told || each[0] != 0;
      }
      kinds.walls = told && !kinds.walls;
      return kinds;
    });
}

bool is_broken(const ContactRows& rows, std::size_t first, std::size_t count) noexcept
{
  return !(are_usable(rows.ends, first, count, 6) && are_usable(rows.force, first, count, 3) &&
    are_usable(rows.tangential, first, count, 3) && are_usable(rows.torque, first, count, 3) &&
    are_usable(rows.contact_point, first, count, 3) && are_usable(rows.overlap, first, count, 1));
}
}
