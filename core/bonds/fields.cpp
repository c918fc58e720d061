// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

#include "granular/formats/restart/bond_record.h"
#include "granular/numbers/number_print.h"

#include <cstring>

namespace granular
{
namespace
{
using enum BondField;

constexpr int image_bits = 21;

constexpr std::size_t doubles_of(BondField field) noexcept
{
  return field <= VMol ? 3 : 1;
}

/// Returns the array of a field.
template <BondField field>
auto* array_of(const granular_bonds_arrays& arrays) noexcept
{
  return arrays.*std::get<static_cast<std::size_t>(field)>(bond_arrays);
}

/// Returns the 32-bit integer that the double holds; an arbitrary integer if the double holds none. Adding the bias puts the
/// nearest integer into the last bits of the sum: a conversion without a branch that is defined for all doubles.
std::int32_t low_integer(double number) noexcept
{
  return static_cast<std::int32_t>(
    static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number + 0x1.8p52)));
}

/// Writes a field of a particle, and goes on to the next one.
template <BondField field>
void put_field(const granular_bonds_arrays& arrays, std::size_t row, double*& to)
{
  const auto* const from = array_of<field>(arrays);
  if constexpr (field <= VMol)
  {
    std::memcpy(to, from + 3 * row, 3 * sizeof(double));
  }
  else if constexpr (field == Image)
  {
    const std::int32_t* const counts = from + 3 * row;
    *to = id_to_number(pack_image({ counts[0], counts[1], counts[2] }, image_bits));
  }
  else if constexpr (field == Tag || field == Molecule)
  {
    *to = id_to_number(from[row]);
  }
  else
  {
    *to = from[row];
  }
  to += doubles_of(field);
}

template <BondField field>
void get_field(const granular_bonds_arrays& arrays, std::size_t row, const double*& from) noexcept
{
  auto* const to = array_of<field>(arrays);
  if constexpr (field <= VMol)
  {
    std::memcpy(to + 3 * row, from, 3 * sizeof(double));
  }
  else if constexpr (field == Image)
  {
    const ImageCounts counts = unpack_image(number_to_id(*from), image_bits);
    std::memcpy(to + 3 * row, &counts, sizeof counts);
  }
  else if constexpr (field == Tag || field == Molecule)
  {
    to[row] = number_to_id(*from);
  }
  else
  {
    to[row] = low_integer(*from);
  }
  from += doubles_of(field);
}

template <BondField field>
void check_field(std::span<const double> buffer, std::size_t particle, std::size_t& at)
{
  if constexpr (field == Type || field == Mask)
  {
    if (!is_int32(buffer[at])) [[unlikely]]
    {
      refuse_number("a whole number of 32 bits", particle, at, buffer[at]);
    }
  }
  else if constexpr (field == Image)
  {
    if (number_to_id(buffer[at]) < 0) [[unlikely]]
    {
      refuse_number("an image of three counts of 21 bits", particle, at, buffer[at]);
    }
  }
  at += doubles_of(field);
}

template <BondField... fields>
struct MessageOf
{
  static void put(const granular_bonds_arrays& arrays, const BondRows& rows, double* to)
  {
    for (std::size_t i = 0; i < rows.count; ++i)
    {
      const std::size_t row = rows[i];
      (put_field<fields>(arrays, row, to), ...);
    }
  }

  static void check(
    std::span<const double> buffer, std::size_t place, std::size_t particle, std::size_t count)
  {
    for (const std::size_t end = particle + count; particle < end; ++particle)
    {
      (check_field<fields>(buffer, particle, place), ...);
    }
  }

  static void get(const granular_bonds_arrays& arrays, std::size_t first, std::size_t count,
    const double* from) noexcept
  {
    for (std::size_t row = first; row < first + count; ++row)
    {
      (get_field<fields>(arrays, row, from), ...);
    }
  }

  static constexpr std::size_t velocity() noexcept
  {
    std::size_t at = 0;
    std::size_t found = 0;
    ((found = fields == V ? at : found, at += doubles_of(fields)), ...);
    return found;
  }

  static constexpr BondMessage message = { (... + doubles_of(fields)), set_of(fields...),
    velocity(), put, check, get };
};

/// Those of PFM, whose particles belong to moving molecules, and of WITH-BONDS, in the order of GRANULAR_BONDS_COMM, ... PFM
/// packs x x_mol v v_mol in one case of a moving periodic box; the table lists what it unpacks.
constexpr BondMessage messages[][2] = {
  { MessageOf<X, XMol, VMol>::message, MessageOf<X>::message },
  { MessageOf<X, V, XMol, VMol>::message, MessageOf<X, V>::message },
  { MessageOf<X, Tag, Type, Mask, Molecule, XMol, VMol>::message,
    MessageOf<X, Tag, Type, Mask, Molecule>::message },
  { MessageOf<X, Tag, Type, Mask, Molecule, V, XMol, VMol>::message,
    MessageOf<X, Tag, Type, Mask, Molecule, V>::message },
  { MessageOf<Molecule>::message, MessageOf<Molecule>::message },
  { MessageOf<F>::message, MessageOf<F>::message },
  // between the length of a record and its number of bonds
  { MessageOf<X, V, Tag, Type, Mask, Image, Molecule, XMol, VMol>::message,
    MessageOf<X, V, Tag, Type, Mask, Image, Molecule>::message },
};
}

const BondMessage& message_of(int kind)
{
  const int routine = routine_of(kind);
  if (routine < GRANULAR_BONDS_COMM || routine > GRANULAR_BONDS_EXCHANGE)
  {
    throw BadBondArgument(
      "expected a kind from 0 to 6, or with 16 added, got " + std::to_string(kind));
  }
  return messages[routine][routine == kind ? 0 : 1];
}

bool is_int32(double number) noexcept
{
  return static_cast<double>(low_integer(number)) == number;
}

void refuse_number(const std::string& expected, std::size_t particle, std::size_t at, double got)
{
  throw FormatError(
    "expected " + expected + " " + buffer_place(particle, at) + ", got " + to_text(got));
}

std::string buffer_place(std::size_t particle, std::size_t at)
{
  return "in double " + std::to_string(at) + " of the buffer, of its particle " +
    std::to_string(particle);
}
}
