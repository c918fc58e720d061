// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/record_walker.h"

#include "granular/restart/bond_record.h"

#include <cstddef>
#include <limits>

namespace granular
{
namespace
{
constexpr auto least_doubles = static_cast<std::int64_t>(RecordSlots::common);
constexpr std::int64_t records_a_report = 65536;
constexpr std::int64_t most_int = std::numeric_limits<std::int32_t>::max();

bool in_range(std::int64_t number, std::int64_t low, std::int64_t high) noexcept
{
  return number >= low && number <= high;
}

/// All of these have doubles of their own.
bool is_whole_in(double number, std::int64_t low, std::int64_t high) noexcept
{
  return number >= static_cast<double>(low) && number <= static_cast<double>(high) &&
    number == static_cast<double>(static_cast<std::int64_t>(number));
}
}

RecordWalker::RecordWalker(const ByteSource& source, bool swapped, const RestartHeader& header,
  SearchBudget& budget, Progress& progress)
  : bytes_(source, swapped, &budget)
  , header_(header)
  , budget_(budget)
  , bounds_(header.box.bounds())
  , progress_(progress)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = bounds_.hi[axis] - bounds_.lo[axis];
    bounds_.lo[axis] -= length;
    bounds_.hi[axis] += length;
  }
}

bool RecordWalker::walk(std::int64_t offset, std::int64_t doubles)
{
  const std::int64_t end = offset + doubles * 8;
  for (at_ = offset; at_ < end;)
  {
    const std::int64_t left = (end - at_) / 8;
    const std::string_view record = bytes_.view(at_, least_doubles * 8);
    --budget_.steps;
    if (budget_.spent() || left < least_doubles || record.size() < least_doubles * 8)
    {
      return false;
    }
    const std::size_t length = length_of(
      bytes_.load<double>(record.data()), RecordSlots::common, static_cast<std::size_t>(left));
    if (length == 0 || !this->is_record(record.data()))
    {
      return false;
    }
    if (++records_ % records_a_report == 0)
    {
      progress_.step(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
    }
    at_ += static_cast<std::int64_t>(length) * 8;
  }
  return true;
}

/// Whole numbers are bits, or values: the type, which is at least 1, tells.
bool RecordWalker::is_record(const char* record) const noexcept
{
  constexpr std::int64_t least_int = -most_int - 1;
  constexpr std::int64_t most_value = std::int64_t{ 1 } << 53;
  using Slots = RecordSlots;
  const auto bits = [&](std::size_t slot) { return this->load<std::int64_t>(record, slot); };
  const auto value = [&](std::size_t slot) { return this->load<double>(record, slot); };
  if (in_range(bits(Slots::type), 1, header_.types))
  {
    return (header_.tag_bytes == 8 || in_range(bits(Slots::tag), least_int, most_int)) &&
      in_range(bits(Slots::mask), least_int, most_int) && this->near_box(record);
  }
  return is_whole_in(value(Slots::type), 1, header_.types) &&
    is_whole_in(value(Slots::tag), -most_value, most_value) &&
    is_whole_in(value(Slots::mask), least_int, most_int) && this->near_box(record);
}

bool RecordWalker::near_box(const char* record) const noexcept
{
  for (std::size_t axis = 0; in_box_ && axis < 3; ++axis)
  {
    const auto x = this->load<double>(record, RecordSlots::x + axis);
    if (!(x >= bounds_.lo[axis] && x <= bounds_.hi[axis])) // nor is it nan
    {
      return false;
    }
  }
  return true;
}
}
