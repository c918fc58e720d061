// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bonds/restart_record.h"

#include "granular/bonds/id_numbers.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <bit>
#include <string>

namespace granular
{
namespace
{
using Slots = RecordSlots;

/// A number in its form. An image may be larger than an id if it is the value of a double.
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

void append_bonds(const BondedParticles& particles, std::size_t i, std::vector<double>& record)
{
  const auto types = particles.bond_types(i);
  const auto partners = particles.partners(i);
  record.push_back(static_cast<double>(types.size()));
  for (std::size_t k = 0; k < types.size(); ++k)
  {
    record.push_back(types[k]);
    record.push_back(to_slot(partners[k], WholeNumbers::Values, "a partner"));
  }
  if (particles.history_values() > 0)
  {
    const auto history = particles.history(i);
    record.push_back(particles.history_values());
    record.insert(record.end(), history.begin(), history.end());
  }
}

ImageCounts read_image(double number, const RecordForm& form)
{
  const std::int64_t image = to_whole(number, form.image);
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

std::span<const double> find_record(std::span<const double> chunk, std::size_t place)
{
  if (place >= chunk.size())
  {
    throw FormatError("expected a record, got the end of the chunk");
  }
  const std::size_t room = chunk.size() - place;
  const double length = chunk[place];
  const std::size_t doubles = length_of(length, Slots::first_bond, room);
  if (doubles == 0)
  {
    throw FormatError("expected the length of a record from " + std::to_string(Slots::first_bond) +
      " to " + std::to_string(room) + ", got " + to_text(length));
  }
  return chunk.subspan(place, doubles);
}

RecordRead add_record(std::span<const double> record, const RecordForm& form,
  std::size_t fix_doubles, BondedParticles& particles)
{
  if (fix_doubles > record.size())
  {
    throw FormatError("expected " + std::to_string(fix_doubles) +
      " doubles of fixes in a record of " + std::to_string(record.size()));
  }
  const BondBlock bonds = look_at_bonds(record.first(record.size() - fix_doubles), false,
    particles.history_values(), particles.most_bonds());
  const WholeNumbers numbers = whole_numbers_of(record);
  const std::size_t i = particles.add(0, { record[1], record[2], record[3] });
  particles.tag()[i] = to_whole(record[Slots::tag], numbers);
  particles.molecule()[i] = to_whole(record[Slots::molecule], WholeNumbers::Values);
  particles.type()[i] = to_int32(record[Slots::type], numbers, "a type");
  particles.mask()[i] = to_int32(record[Slots::mask], numbers, "a mask");
  particles.image()[i] = read_image(record[Slots::image], form);
  std::copy_n(record.begin() + Slots::v, 3, particles.v()[i].begin());
  particles.set_bonds(i, static_cast<std::size_t>(bonds.bonds));
  const double* pair = bonds.pairs;
  for (std::size_t k = 0; k < particles.partners(i).size(); ++k, pair += 2)
  {
    particles.bond_types(i)[k] = to_int32(pair[0], WholeNumbers::Values, "a bond type");
    particles.partners(i)[k] = to_whole(pair[1], WholeNumbers::Values);
  }
  const auto history = particles.history(i);
  std::copy_n(bonds.history, history.size(), history.begin());
  return { record.size(), record.subspan(bonds.size) };
}
}

std::size_t record_doubles(const BondedParticles& particles, std::size_t i)
{
  if (i >= particles.size())
  {
    throw LimitError("expected a particle below " + std::to_string(particles.size()) + ", got " +
      std::to_string(i));
  }
  const std::size_t history = particles.history_values() > 0 ? 1 + particles.history(i).size() : 0;
  return Slots::first_bond + 2 * particles.bond_types(i).size() + history;
}

void append_record(const BondedParticles& particles, std::size_t i, const RecordForm& form,
  std::span<const double> fixes, std::vector<double>& records)
{
  const std::size_t size = record_doubles(particles, i) + fixes.size();
  const std::int32_t type = particles.type()[i];
  if (type < 1)
  {
    throw LimitError(
      "expected a type from 1 of particle " + std::to_string(i) + ", got " + std::to_string(type));
  }
  std::vector<double> record;
  record.reserve(size);
  try
  {
    const Vector3& x = particles.x()[i];
    const Vector3& v = particles.v()[i];
    record = { static_cast<double>(size), x[0], x[1], x[2],
      to_slot(particles.tag()[i], form.numbers, "a tag"), to_slot(type, form.numbers, "a type"),
      to_slot(particles.mask()[i], form.numbers, "a mask"),
      to_slot(pack_image(particles.image()[i], form.image_bits), form.image, "an image", true),
      v[0], v[1], v[2], to_slot(particles.molecule()[i], WholeNumbers::Values, "a molecule") };
    append_bonds(particles, i, record);
  }
  catch (const LimitError& error)
  {
    throw LimitError(error.text() + " of particle " + std::to_string(i));
  }
  record.insert(record.end(), fixes.begin(), fixes.end());
  records.insert(records.end(), record.begin(), record.end());
}

RecordRead read_record(std::span<const double> chunk, std::size_t place, const RecordForm& form,
  std::size_t fix_doubles, BondedParticles& particles)
{
  const std::size_t old = particles.size();
  try
  {
    return add_record(find_record(chunk, place), form, fix_doubles, particles);
  }
  catch (const FormatError& error)
  {
    particles.resize(old);
    throw FormatError(error.text() + ", in the record of particle " + std::to_string(old) +
      " from double " + std::to_string(place) + " on");
  }
}
}
