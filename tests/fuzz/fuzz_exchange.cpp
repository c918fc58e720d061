// SPDX-License-Identifier: BSD-3-Clause
// A buffer that another process sent, or the records of a restart file, as the doubles behind a few bytes that say what they are.
// Whatever they are, there is an Error and the particles are as before, or particles that are packed as the same doubles. The
// mutator packs particles, and changes some of their doubles.
#include "dump_checks.h"
#include "mutations.h"

#include "granular/bonds/exchange_packing.h"
#include "granular/bonds/restart_record.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <vector>

using namespace granular;
using namespace granular::fuzz;

namespace
{
using Doubles = std::vector<double>;

enum What : std::uint8_t
{
  Exchange = 6, ///< below: a PackRoutine
  Record,
  whats
};

/// The first bytes of an input.
struct Setting
{
  static constexpr std::size_t bytes = 8;

  explicit Setting(const std::string& from)
    : what(static_cast<std::uint8_t>(from[0]) % whats)
    , dialect((from[1] & 1) != 0 ? PackDialect::Pfm : PackDialect::WithBonds)
    , most_bonds((from[2] & 15) + 1)
    , history(from[3] & 15)
    , before(static_cast<std::size_t>(from[4] & 3))
    , fixes(static_cast<std::size_t>(from[5] & 3))
  {
    form.numbers = (from[6] & 1) != 0 ? WholeNumbers::Bits : WholeNumbers::Values;
    form.image = (from[6] & 2) != 0 ? WholeNumbers::Bits : WholeNumbers::Values;
    form.image_bits = (from[6] & 4) != 0 ? 21 : 10;
  }

  PackRoutine routine() const { return static_cast<PackRoutine>(what); }

  /// Particles that are there before.
  BondedParticles particles() const
  {
    BondedParticles all(most_bonds, history);
    for (std::size_t i = 0; i < before; ++i)
    {
      all.add(1, { 1, 2, static_cast<double>(i) });
    }
    return all;
  }

  std::uint8_t what;
  PackDialect dialect;
  std::int32_t most_bonds;
  std::int32_t history;
  std::size_t before;
  std::size_t fixes; ///< doubles of fixes in a record
  RecordForm form;
};

/// The same bits, or the same number: a whole number may have been -0.
bool same(std::span<const double> a, std::span<const double> b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](double x, double y)
    { return x == y || std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); });
}

Doubles pack_all(const BondedParticles& particles, const Setting& setting, ParticleRange rows)
{
  Doubles packed;
  if (setting.what == Exchange)
  {
    packed.resize(exchange_doubles(particles, setting.dialect, rows));
    pack_exchange(particles, setting.dialect, rows, packed);
  }
  else if (setting.what == Record)
  {
    const Doubles fixes(setting.fixes, 7.0);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      append_record(particles, rows[i], setting.form, fixes, packed);
    }
  }
  else
  {
    packed.resize(rows.size() * packed_doubles(setting.routine(), setting.dialect));
    pack(particles, setting.routine(), setting.dialect, rows, {}, packed);
  }
  return packed;
}

void check_exchange(const Setting& setting, std::span<const double> buffer)
{
  BondedParticles particles = setting.particles();
  const std::size_t count = unpack_exchange(particles, setting.dialect, buffer);
  require(particles.size() == setting.before + count, "the number of particles");
  require(same(pack_all(particles, setting, { setting.before, count }), buffer), "packed again");
}

/// Rows from the last one there was on, so that the first is overwritten.
void check_routine(const Setting& setting, std::span<const double> buffer)
{
  BondedParticles particles = setting.particles();
  const std::size_t doubles = packed_doubles(setting.routine(), setting.dialect);
  const ParticleRange rows{ setting.before / 2, buffer.size() / doubles };
  unpack(particles, setting.routine(), setting.dialect, rows, buffer);
  require(particles.size() == std::max(setting.before, rows.first + rows.count),
    "the number of particles");
  if (setting.routine() != PackRoutine::Reverse) // of which forces are added
  {
    require(same(pack_all(particles, setting, rows), buffer), "packed again");
    return;
  }
  const std::vector<std::size_t> last(rows.count, particles.size() - 1);
  unpack_reverse(particles, last, buffer);
}

void check_records(const Setting& setting, std::span<const double> buffer)
{
  BondedParticles particles = setting.particles();
  for (std::size_t place = 0; place < buffer.size();)
  {
    const std::size_t row = particles.size();
    const RecordRead read = read_record(buffer, place, setting.form, setting.fixes, particles);
    require(particles.size() == row + 1 && read.size > 0, "a particle for a record");
    require(read.size <= buffer.size() - place, "the end of a record");
    require(read.fixes.size() == setting.fixes, "the doubles of fixes");
    place += read.size;

    // what is written is read as it was
    Doubles record;
    try
    {
      append_record(particles, row, setting.form, read.fixes, record);
    }
    catch (const LimitError&)
    {
      continue; // a number that this form has no place for
    }
    BondedParticles again(setting.most_bonds, setting.history);
    read_record(record, 0, setting.form, setting.fixes, again);
    Doubles twice;
    append_record(again, 0, setting.form, read.fixes, twice);
    require(same(record, twice), "written again");
  }
}

void mutate(std::string& bytes, Random& random, std::size_t most)
{
  if (bytes.size() < Setting::bytes || one_in(random, 4))
  {
    mutate_bytes(bytes, most);
    bytes.resize(std::max(bytes.size(), Setting::bytes));
    return;
  }
  const std::size_t doubles = (bytes.size() - Setting::bytes) / 8;
  if (doubles > 0 && !one_in(random, 3))
  {
    for (std::size_t left = below(random, 3) + 1; left > 0; --left)
    {
      store(bytes, Setting::bytes + 8 * below(random, doubles), other_double(random));
    }
    return;
  }
  if (one_in(random, 4))
  {
    bytes[below(random, Setting::bytes)] = static_cast<char>(random());
  }
  const Setting setting(bytes);
  BondedParticles particles(setting.most_bonds, setting.history);
  for (std::size_t count = below(random, 4) + 1; count > 0; --count)
  {
    const std::size_t row =
      particles.add(static_cast<std::int32_t>(below(random, 4)) + 1, { 0.5, 1, 1.5 });
    particles.tag()[row] = other_integer<std::int64_t>(1, random);
    particles.mask()[row] = other_integer<std::int32_t>(1, random);
    particles.molecule()[row] = static_cast<std::int64_t>(below(random, 9));
    particles.image()[row] = { 1, -1, static_cast<std::int32_t>(below(random, 9)) - 4 };
    for (std::size_t bond = below(random, static_cast<std::size_t>(setting.most_bonds) + 1);
         bond > 0; --bond)
    {
      particles.add_bond(row, static_cast<std::int32_t>(below(random, 3)),
        other_integer<std::int64_t>(1, random),
        Doubles(static_cast<std::size_t>(setting.history), 0.25));
    }
  }
  try
  {
    const Doubles packed = pack_all(particles, setting, { 0, particles.size() });
    bytes.resize(one_in(random, 3) ? Setting::bytes + 8 * doubles : Setting::bytes);
    bytes.append(reinterpret_cast<const char*>(packed.data()), 8 * packed.size());
  }
  catch (const LimitError&)
  {
    mutate_bytes(bytes, most); // an id that a record has no place for
  }
}
}

extern "C" std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
  return mutate_as(data, size, most, seed, mutate);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size < Setting::bytes)
  {
    return 0;
  }
  const Setting setting(std::string(reinterpret_cast<const char*>(data), Setting::bytes));
  Doubles buffer((size - Setting::bytes) / 8);
  if (!buffer.empty())
  {
    std::memcpy(buffer.data(), data + Setting::bytes, 8 * buffer.size());
  }
  try
  {
    (setting.what == Exchange    ? check_exchange
        : setting.what == Record ? check_records
                                 : check_routine)(setting, buffer);
  }
  catch (const Error&)
  {
    // what it says is for a reader to judge
  }
  return 0;
}
