// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/bond_record.h"

#include "granular/numbers/number_print.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace granular
{
namespace
{
bool is_whole(double number) noexcept
{
  return number >= -0x1p63 && number < 0x1p63 && std::trunc(number) == number;
}

[[noreturn]] void refuse(const std::string& expected, std::size_t at, const std::string& got)
{
  throw FormatError("expected " + expected + " in double " + std::to_string(at) +
    " of the bond/gran part of a record, got " + got);
}

/// Returns the number of history values that each of some bonds has, of which the number may stand first behind them; 0: it does not. There
/// it is a whole number that fits the values behind it.
std::int64_t find_history(std::span<const double> behind, std::int64_t bonds, bool may_have_more,
  std::int64_t history_values)
{
  if (behind.empty() || (history_values < 0 && bonds == 0 && may_have_more))
  {
    return 0;
  }
  if (history_values >= 0)
  {
    return behind[0] == static_cast<double>(history_values) ? history_values : 0;
  }
  const auto room = static_cast<std::int64_t>(behind.size()) - 1;
  const auto values = static_cast<std::int64_t>(length_of(behind[0], 1, 0x7fffffff));
  const bool fits = bonds == 0 || values <= room / bonds;
  return fits && (may_have_more || values * bonds == room) ? values : 0;
}
}

WholeNumbers whole_numbers_of(std::span<const double> block)
{
  const double type = block[RecordSlots::type];
  if (type >= 1 && type <= std::numeric_limits<std::int32_t>::max())
  {
    return WholeNumbers::Values;
  }
  const auto bits = std::bit_cast<std::int64_t>(type);
  if (bits >= 1 && bits <= std::numeric_limits<std::int32_t>::max())
  {
    return WholeNumbers::Bits;
  }
  throw FormatError("expected the type of a particle, from 1, in double " +
    std::to_string(RecordSlots::type) + " of a record, got " + to_text(type));
}

std::int64_t to_whole(double number, WholeNumbers form)
{
  if (form == WholeNumbers::Bits)
  {
    return std::bit_cast<std::int64_t>(number);
  }
  if (!is_whole(number))
  {
    throw FormatError("expected a whole number of 64 bits, got " + to_text(number));
  }
  return static_cast<std::int64_t>(number);
}

std::int32_t to_int32(double number, WholeNumbers form, const char* name)
{
  const std::int64_t value = to_whole(number, form);
  if (value != static_cast<std::int32_t>(value))
  {
    throw FormatError(
      "expected " + std::string(name) + " of 32 bits, got " + std::to_string(value));
  }
  return static_cast<std::int32_t>(value);
}

ImageCounts unpack_image(std::int64_t image, int field_bits) noexcept
{
  const std::int64_t range = std::int64_t{ 1 } << field_bits;
  const std::int64_t half = range / 2;
  return { static_cast<std::int32_t>((image & (range - 1)) - half),
    static_cast<std::int32_t>((image >> field_bits & (range - 1)) - half),
    static_cast<std::int32_t>((image >> 2 * field_bits) - half) };
}

std::int64_t pack_image(const ImageCounts& counts, int field_bits)
{
  const std::int64_t half = std::int64_t{ 1 } << (field_bits - 1);
  std::int64_t image = 0;
  int shift = 0;
  for (const std::int32_t count : { counts.x, counts.y, counts.z })
  {
    if (count < -half || count >= half)
    {
      throw LimitError("expected an image count from " + std::to_string(-half) + " to " +
        std::to_string(half - 1) + ", got " + std::to_string(count));
    }
    image |= (count + half) << shift;
    shift += field_bits;
  }
  return image;
}

BondBlock look_at_bonds(std::span<const double> block, bool may_have_more,
  std::int64_t history_values, std::int64_t most_bonds)
{
  if (block.size() < RecordSlots::first_bond)
  {
    throw FormatError("expected at least " + std::to_string(RecordSlots::first_bond) +
      " doubles in the bond/gran part of a record, got " + std::to_string(block.size()));
  }
  BondBlock found;
  const double bonds = block[RecordSlots::bonds];
  if (!is_whole(bonds) || bonds < 0 || bonds > static_cast<double>(most_bonds))
  {
    refuse("a number of bonds from 0 to " + std::to_string(most_bonds), RecordSlots::bonds,
      to_text(bonds));
  }
  found.bonds = static_cast<std::int64_t>(bonds);
  const std::size_t behind = block.size() - RecordSlots::first_bond;
  if (static_cast<std::uint64_t>(found.bonds) > behind / 2)
  {
    refuse("at most " + std::to_string(behind / 2) + " bonds, for which there is room,",
      RecordSlots::bonds, std::to_string(found.bonds));
  }
  found.pairs = block.data() + RecordSlots::first_bond;
  found.size = RecordSlots::first_bond + 2 * static_cast<std::size_t>(found.bonds);
  const std::size_t at = found.size;
  const std::int64_t values =
    find_history(block.subspan(at), found.bonds, may_have_more, history_values);
  if (values == 0 && history_values > 0 && found.bonds > 0)
  {
    refuse("the number of history values of a bond, " + std::to_string(history_values) +
        " as in other records,",
      at, at < block.size() ? to_text(block[at]) : "the end of that part");
  }
  if (values > 0)
  {
    const std::size_t room = block.size() - at - 1;
    if (found.bonds > 0 &&
      static_cast<std::uint64_t>(values) > room / static_cast<std::uint64_t>(found.bonds))
    {
      refuse("at most " + std::to_string(room) + " history values, for which there is room,", at,
        std::to_string(found.bonds) + " times " + std::to_string(values));
    }
    found.history_values = values;
    found.history = block.data() + at + 1;
    found.size = at + 1 + static_cast<std::size_t>(values * found.bonds);
  }
  if (!may_have_more && found.size != block.size())
  {
    throw FormatError("expected " + std::to_string(found.size) +
      " doubles in the bond/gran part of a record, got " + std::to_string(block.size()));
  }
  return found;
}
}
