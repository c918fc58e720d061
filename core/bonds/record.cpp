// SPDX-License-Identifier: BSD-3-Clause
// The record of a particle in a restart file; see RecordSlots. The sign of a bond's type is kept, although the programs lose it.
#include "packing.h"

#include "granular/formats/restart/bond_record.h"
#include "granular/numbers/number_print.h"

#include <algorithm>

namespace granular
{
namespace
{
using Slots = RecordSlots;

WholeNumbers form_of(int as_bits) noexcept
{
  return as_bits != 0 ? WholeNumbers::Bits : WholeNumbers::Values;
}

void expect_form(const granular_bonds_form& form)
{
  if (form.image_bits != 10 && form.image_bits != 21)
  {
    throw BadBondArgument(
      "expected 10 or 21 bits of an image count, got " + std::to_string(form.image_bits));
  }
}

/// Returns a number in its form. An image may be larger than an id if it is the value of a double.
double to_slot(std::int64_t number, WholeNumbers form, const char* name, bool image = false)
{
  if (form == WholeNumbers::Bits)
  {
    return std::bit_cast<double>(number);
  }
  const auto value = static_cast<double>(number);
  const bool held = image && value < 0x1p63 && static_cast<std::int64_t>(value) == number;
  if (!held && !is_id_value(number))
  {
    throw LimitError("expected " + std::string(name) +
      " of at most 2^53 to write it as a value, got " + std::to_string(number));
  }
  return value;
}

double* put_bonds(const BondedParticles& particles, std::size_t row, double* to)
{
  const std::size_t bonds = particles.bonds(row);
  const auto* const types = particles.bond_types(row);
  const auto* const partners = particles.partners(row);
  *to++ = static_cast<double>(bonds);
  for (std::size_t k = 0; k < bonds; ++k)
  {
    *to++ = types[k];
    *to++ = to_slot(partners[k], WholeNumbers::Values, "a partner");
  }
  const std::size_t values = particles.history_values();
  if (values > 0)
  {
    *to++ = static_cast<double>(values);
  }
  return std::copy_n(particles.history(row), bonds * values, to);
}

double image_slot(const std::int32_t* counts, const granular_bonds_form& form)
{
  const std::int64_t image = pack_image({ counts[0], counts[1], counts[2] }, form.image_bits);
  return to_slot(image, form_of(form.image_as_bits), "an image", true);
}

ImageCounts read_image(double number, const granular_bonds_form& form)
{
  const std::int64_t image = to_whole(number, form_of(form.image_as_bits));
  const ImageCounts counts = unpack_image(image, form.image_bits);
  try
  {
    pack_image(counts, form.image_bits);
  }
  catch (const LimitError&)
  {
    throw FormatError("expected an image of three counts of " + std::to_string(form.image_bits) +
      " bits, got " + std::to_string(image));
  }
  return counts;
}

std::span<const double> find_record(std::span<const double> chunk, std::size_t fix_count)
{
  if (chunk.empty())
  {
    throw FormatError("expected a record, got the end of the chunk");
  }
  const std::size_t doubles = length_of(chunk[0], Slots::first_bond, chunk.size());
  if (doubles == 0)
  {
    throw FormatError("expected the length of a record from " + std::to_string(Slots::first_bond) +
      " to " + std::to_string(chunk.size()) + ", got " + to_text(chunk[0]));
  }
  if (fix_count > doubles)
  {
    throw FormatError("expected " + std::to_string(fix_count) +
      " doubles of fixes in a record of " + std::to_string(doubles));
  }
  return chunk.first(doubles);
}

void add_record(BondedParticles& particles, const granular_bonds_form& form,
  std::span<const double> record, const BondBlock& bonds)
{
  const WholeNumbers numbers = whole_numbers_of(record);
  const std::size_t row =
    particles.add(to_int32(record[Slots::type], numbers, "a type"), &record[Slots::x]);
  const granular_bonds_arrays& arrays = particles.arrays();
  arrays.tag[row] = to_whole(record[Slots::tag], numbers);
  arrays.molecule[row] = to_whole(record[Slots::molecule], WholeNumbers::Values);
  arrays.mask[row] = to_int32(record[Slots::mask], numbers, "a mask");
  const ImageCounts image = read_image(record[Slots::image], form);
  std::ranges::copy(std::array{ image.x, image.y, image.z }, arrays.image + 3 * row);
  std::copy_n(&record[Slots::v], 3, arrays.v + 3 * row);
  particles.set_bonds(row, static_cast<std::size_t>(bonds.bonds));
  for (std::size_t k = 0; k < particles.bonds(row); ++k)
  {
    const double* const pair = bonds.pairs + 2 * k;
    particles.bond_types(row)[k] = to_int32(pair[0], WholeNumbers::Values, "a bond type");
    particles.partners(row)[k] = to_whole(pair[1], WholeNumbers::Values);
  }
  std::copy_n(
    bonds.history, particles.bonds(row) * particles.history_values(), particles.history(row));
}
}

std::size_t record_doubles(const BondedParticles& particles, std::size_t row)
{
  particles.expect_row(row);
  const std::size_t values = particles.history_values();
  const std::size_t bonds = particles.bonds(row);
  return Slots::first_bond + 2 * bonds + (values > 0 ? 1 + values * bonds : 0);
}

void pack_record(const BondedParticles& particles, std::size_t row, const granular_bonds_form& form,
  std::span<const double> fixes, double* record)
{
  expect_form(form);
  const granular_bonds_arrays& arrays = particles.arrays();
  const std::int32_t type = arrays.type[row];
  if (type < 1) // tells a reader the form of the numbers
  {
    throw LimitError("expected a type from 1 of particle " + std::to_string(row) + ", got " +
      std::to_string(type));
  }
  const WholeNumbers integers = form_of(form.integers_as_bits);
  try
  {
    record[Slots::length] = static_cast<double>(record_doubles(particles, row) + fixes.size());
    std::copy_n(arrays.x + 3 * row, 3, record + Slots::x);
    record[Slots::tag] = to_slot(arrays.tag[row], integers, "a tag");
    record[Slots::type] = to_slot(type, integers, "a type");
    record[Slots::mask] = to_slot(arrays.mask[row], integers, "a mask");
    record[Slots::image] = image_slot(arrays.image + 3 * row, form);
    std::copy_n(arrays.v + 3 * row, 3, record + Slots::v);
    record[Slots::molecule] = to_slot(arrays.molecule[row], WholeNumbers::Values, "a molecule");
    std::ranges::copy(fixes, put_bonds(particles, row, record + Slots::bonds));
  }
  catch (const LimitError& error)
  {
    throw LimitError(error.text() + " of particle " + std::to_string(row));
  }
}

std::size_t unpack_record(BondedParticles& particles, const granular_bonds_form& form,
  std::size_t fix_count, std::span<const double> chunk)
{
  expect_form(form);
  const std::size_t old = particles.size();
  try
  {
    const std::span<const double> record = find_record(chunk, fix_count);
    const BondBlock bonds = look_at_bonds(record.first(record.size() - fix_count), false,
      static_cast<std::int64_t>(particles.history_values()),
      static_cast<std::int64_t>(particles.most_bonds()));
    add_record(particles, form, record, bonds);
    return record.size();
  }
  catch (const FormatError& error)
  {
    particles.resize(old);
    throw FormatError(error.text() + ", in the record of particle " + std::to_string(old));
  }
}
}
