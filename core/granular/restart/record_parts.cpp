// SPDX-License-Identifier: BSD-3-Clause
// Places of the parts of a record, by a plan.
#include "granular/numbers/number_print.h"
#include "granular/restart/record_places.h"
#include "granular/restart/record_plan.h"

#include <algorithm>

namespace granular
{
namespace
{
/// The bonds of a list.
FoundBonds look_at_list(std::span<const double> block, const StyleLayout& style)
{
  FoundBonds bonds;
  bonds.form = whole_numbers_of(block);
  bonds.block.bonds = to_whole(block[style.values], bonds.form);
  bonds.block.pairs = block.data() + style.values + 1;
  return bonds;
}
}

std::size_t RecordPlan::find_next(std::span<const double> record) noexcept
{
  for (std::size_t at = RecordSlots::common; at + RecordSlots::common <= record.size(); ++at)
  {
    if (begins_part(record, at))
    {
      return at;
    }
  }
  return 0;
}

std::size_t RecordPlan::search_next(std::span<const double> record)
{
  const std::size_t at = find_next(record);
  if (at == 0)
  {
    throw FormatError("expected the position of the particle again where the part of a second "
                      "atom style begins, got none");
  }
  return at;
}

/// Returns the length of a part that tells it itself.
std::size_t RecordPlan::length_of_part(
  std::span<const double> record, std::size_t at, std::size_t part) const
{
  const auto rest = record.subspan(at);
  if (rest.size() < RecordSlots::common)
  {
    throw FormatError("expected at least " + std::to_string(RecordSlots::common) +
      " doubles in the part of style " + parts_[part].name + ", got " +
      std::to_string(rest.size()));
  }
  const std::size_t length = length_of(rest[0], RecordSlots::common, rest.size());
  if (length == 0)
  {
    throw FormatError("expected the length of the part of style " + parts_[part].name + ", from " +
      std::to_string(RecordSlots::common) + " to " + std::to_string(rest.size()) + ", in double " +
      std::to_string(at) + ", got " + to_text(rest[0]));
  }
  if (!has_position_of(rest, record))
  {
    throw FormatError("expected the position of the particle again behind double " +
      std::to_string(at) + ", where the part of style " + parts_[part].name +
      " begins, got another one");
  }
  return length;
}

/// Returns the end of the values that a style has in a part, and its bonds if they are those that are read. may_have_more: other parts
/// may be behind it.
std::size_t RecordPlan::measure_style(
  std::span<const double> block, std::size_t part, bool may_have_more, FoundBonds& bonds) const
{
  const StyleLayout* const style = parts_[part].style;
  const bool has_bonds = part == bonds_;
  if (!style || (style->history && !has_bonds))
  {
    return block.size();
  }
  if (style->history)
  {
    bonds = { look_at_bonds(block, may_have_more, history_values_, parts_[part].most_bonds) };
    return bonds.block.size;
  }
  const std::size_t end = measure_lists(block, *style);
  if (has_bonds)
  {
    bonds = look_at_list(block, *style);
  }
  return end;
}

/// Returns the end of the first part: its length is that of the whole record.
std::size_t RecordPlan::end_of_first(std::span<const double> record, FoundBonds& bonds) const
{
  return parts_.front().searched ? search_next(record)
                                 : this->measure_style(record, 0, true, bonds);
}

std::size_t RecordPlan::end_of_part(
  std::span<const double> record, std::size_t at, std::size_t part, FoundBonds& bonds) const
{
  const std::size_t length = this->length_of_part(record, at, part);
  const std::size_t end = this->measure_style(record.subspan(at, length), part, false, bonds);
  if (end != length)
  {
    throw FormatError("expected " + std::to_string(end) + " doubles in the part of style " +
      parts_[part].name + ", got " + std::to_string(length));
  }
  return at + length;
}

std::size_t RecordPlan::find_styles(
  std::span<const double> record, std::span<const double*> parts, FoundBonds& bonds) const
{
  parts[0] = record.data();
  std::size_t at = this->end_of_first(record, bonds);
  for (std::size_t part = 1; part < parts_.size(); ++part)
  {
    parts[part] = record.data() + at;
    at = this->end_of_part(record, at, part, bonds);
  }
  return at;
}

void RecordPlan::find_parts(
  std::span<const double> record, std::span<const double*> parts, FoundBonds& bonds) const
{
  const std::size_t end = this->find_styles(record, parts, bonds);
  if (fix_lengths_.empty())
  {
    return;
  }
  bool same = true;
  const auto of_fixes = parts.subspan(parts_.size());
  const bool found = walk_fixes(record, end, known_fixes_,
    [&](std::size_t part, std::size_t begin, std::size_t length)
    {
      const std::size_t fix = fix_order_[part];
      of_fixes[fix] = record.data() + begin;
      same = same && (fix_lengths_[fix] == 0 || fix_lengths_[fix] == length);
    });
  if (!found || !same)
  {
    std::ranges::fill(of_fixes, nullptr);
  }
}
}
