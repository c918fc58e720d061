// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/record_walker.h"

#include "granular/bonds/bond_record.h"

#include <cmath>
#include <cstddef>

namespace granular
{
namespace
{
constexpr auto least_doubles = static_cast<std::int64_t>(RecordSlots::common);
constexpr std::int64_t records_a_report = 65536;

const char* slot(const char* record, std::size_t number) noexcept
{
  return record + number * sizeof(double);
}

bool is_whole(double number) noexcept
{
  return number == std::floor(number) && std::abs(number) < 0x1p63;
}
}

RecordWalker::RecordWalker(const ByteSource& source, bool swapped, const RestartHeader& header,
  bool in_box, Progress& progress)
  : bytes_(source, swapped)
  , header_(header)
  , progress_(progress)
{
  if (!in_box)
  {
    return;
  }
  BoxBounds bounds = header.box.bounds();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = bounds.hi[axis] - bounds.lo[axis];
    bounds.lo[axis] -= length;
    bounds.hi[axis] += length;
  }
  bounds_ = bounds;
}

bool RecordWalker::walk(std::int64_t offset, std::int64_t doubles, SearchBudget& budget)
{
  const std::int64_t end = offset + doubles * 8;
  const std::int64_t read_before = bytes_.read_bytes();
  const std::int64_t may_read = budget.bytes;
  for (at_ = offset; at_ < end;)
  {
    const std::int64_t left = (end - at_) / 8;
    const std::string_view record = bytes_.view(at_, least_doubles * 8);
    budget.bytes = may_read - (bytes_.read_bytes() - read_before);
    --budget.steps;
    if (budget.spent() || left < least_doubles || record.size() < least_doubles * 8)
    {
      return false;
    }
    const double length = bytes_.double_in(slot(record.data(), RecordSlots::length));
    if (!(length >= least_doubles && length <= static_cast<double>(left)) || !is_whole(length) ||
      !this->is_record(record.data()))
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
  const std::int64_t type_bits = bytes_.int64_in(slot(record, RecordSlots::type));
  if (type_bits >= 1 && type_bits <= header_.types)
  {
    return bytes_.int64_in(slot(record, RecordSlots::tag)) >= 0 && this->near_box(record);
  }
  const double type = bytes_.double_in(slot(record, RecordSlots::type));
  const double tag = bytes_.double_in(slot(record, RecordSlots::tag));
  return type >= 1 && type <= header_.types && is_whole(type) && tag >= 0 && is_whole(tag) &&
    is_whole(bytes_.double_in(slot(record, RecordSlots::mask))) && this->near_box(record);
}

bool RecordWalker::near_box(const char* record) const noexcept
{
  for (std::size_t axis = 0; bounds_ && axis < 3; ++axis)
  {
    const double x = bytes_.double_in(slot(record, RecordSlots::x + axis));
    if (!(x >= bounds_->lo[axis] && x <= bounds_->hi[axis])) // nor is it nan
    {
      return false;
    }
  }
  return true;
}
}
