// SPDX-License-Identifier: BSD-3-Clause
// Places of the parts of a record, by a plan.
#include "granular/formats/restart/record_plan.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <string>

namespace granular
{
namespace
{
// Source: pack_restart of the atom styles of LIGGGHTS-PUBLIC 3.8.0 and its forks; files of 3.8.0.
// Behind the last list of ellipsoid, line and tri, which has one entry at most, comes their shape.
constexpr StyleLayout table[] = {
  // clang-format off
  // name                     columns                                               values lists           bonds  history
  { "atomic",                 "",                                                       11 },
  { "charge",                 "q",                                                      12 },
  { "granular",               "radius mass density omegax omegay omegaz",               17 },
  { "sphere",                 "radius mass density omegax omegay omegaz",               17 },
  { "bond/gran",              "mol",                                                    12, { 2 },          true,  true },
  { "bond",                   "mol",                                                    12, { 2 },          true },
  { "molecular",              "mol",                                                    12, { 2, 4, 5, 5 }, true },
  { "full",                   "q mol",                                                  13, { 2, 4, 5, 5 }, true },
  { "ellipsoid",              "mass angmomx angmomy angmomz",                           15, { 7 } },
  { "line",                   "mol mass omegax omegay omegaz",                          16, { 2 } },
  { "tri",                    "mol mass angmomx angmomy angmomz",                       16, { 16 } },
  { "sph",                    "p rho e vestx vesty vestz",                              17 },
  { "sph/var",                "p rho e radius mass",                                    16 },
  { "superquadric",           "radius mass density omegax omegay omegaz quat1 quat2 quat3 quat4 shapex shapey shapez "
                              "blockiness1 blockiness2 inertiax inertiay inertiaz volume area angmomx angmomy angmomz", 34 },
  { "granular_superquadric",  "radius mass density omegax omegay omegaz quat1 quat2 quat3 quat4 shapex shapey shapez "
                              "blockiness1 blockiness2 inertiax inertiay inertiaz volume area angmomx angmomy angmomz", 34 },
  // clang-format on
};

/// Returns the doubles of a style's part that begins here, up to the end of its lists. Not for styles with history. Throws
/// FormatError, with the double of the part, if it needs more doubles than there are.
std::size_t measure_lists(std::span<const double> block, const StyleLayout& style)
{
  const auto lists =
    std::ranges::count_if(style.lists, [](std::uint8_t width) { return width > 0; });
  const std::size_t least = style.values + static_cast<std::size_t>(lists);
  if (block.size() < least)
  {
    throw FormatError("expected at least " + std::to_string(least) +
      " doubles in the part of style " + std::string(style.name) + ", got " +
      std::to_string(block.size()));
  }
  std::size_t at = style.values;
  if (!style.has_lists())
  {
    return at;
  }
  const WholeNumbers form = whole_numbers_of(block);
  for (const std::size_t width : style.lists)
  {
    if (width == 0)
    {
      break;
    }
    if (at >= block.size())
    {
      throw FormatError("expected more lists in the part of style " + std::string(style.name) +
        ", got its end at double " + std::to_string(at));
    }
    const std::int64_t entries = to_whole(block[at], form);
    const std::size_t room = (block.size() - at - 1) / width;
    if (entries < 0 || static_cast<std::uint64_t>(entries) > room)
    {
      throw FormatError("expected from 0 to " + std::to_string(room) + " entries in double " +
        std::to_string(at) + " of the part of style " + std::string(style.name) + ", got " +
        std::to_string(entries));
    }
    at += 1 + static_cast<std::size_t>(entries) * width;
  }
  return at;
}

/// The bonds of a list.
BondBlock look_at_list(std::span<const double> block, const StyleLayout& style)
{
  BondBlock bonds;
  bonds.form = whole_numbers_of(block);
  bonds.bonds = to_whole(block[style.values], bonds.form);
  bonds.pairs = block.data() + style.values + 1;
  return bonds;
}
}

const StyleLayout* find_style(std::string_view name) noexcept
{
  const auto* const found = std::ranges::find(table, name, &StyleLayout::name);
  return found == std::end(table) ? nullptr : found;
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
  std::span<const double> block, std::size_t part, bool may_have_more, BondBlock& bonds) const
{
  const StyleLayout* const style = parts_[part].style;
  const bool has_bonds = part == bonds_;
  if (!style || (style->history && !has_bonds))
  {
    return block.size();
  }
  if (style->history)
  {
    bonds = look_at_bonds(block, may_have_more, history_values_, parts_[part].most_bonds);
    return bonds.size;
  }
  const std::size_t end = measure_lists(block, *style);
  if (has_bonds)
  {
    bonds = look_at_list(block, *style);
  }
  return end;
}

/// Returns the end of the first part: its length is that of the whole record.
std::size_t RecordPlan::end_of_first(std::span<const double> record, BondBlock& bonds) const
{
  return parts_.front().searched ? search_next(record)
                                 : this->measure_style(record, 0, true, bonds);
}

std::size_t RecordPlan::end_of_part(
  std::span<const double> record, std::size_t at, std::size_t part, BondBlock& bonds) const
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
  std::span<const double> record, std::span<const double*> parts, BondBlock& bonds) const
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
  std::span<const double> record, std::span<const double*> parts, BondBlock& bonds) const
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
