// SPDX-License-Identifier: BSD-3-Clause
// A buffer that another process sent, or the records of a restart file, as the doubles behind a few bytes that say what they are.
// Whatever they are, there is an error and the particles are as before, or particles that are packed as the same doubles. The
// mutator packs particles, and changes some of their doubles.
#include "dump_checks.h"
#include "mutations.h"

#include "granular_bonds.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

using namespace granular;
using namespace granular::fuzz;

namespace
{
using Doubles = std::vector<double>;
using Particles = std::unique_ptr<granular_bonds, decltype(&granular_bonds_destroy)>;

constexpr int record = GRANULAR_BONDS_EXCHANGE + 1;

/// The first bytes of an input.
struct Setting
{
  static constexpr std::size_t bytes = 8;

  explicit Setting(const std::string& from)
    : routine(static_cast<std::uint8_t>(from[0]) % (record + 1))
    , kind(routine + ((from[1] & 1) != 0 ? 0 : GRANULAR_BONDS_WITH_BONDS))
    , most_bonds((from[2] & 15) + 1)
    , history(from[3] & 15)
    , before(static_cast<std::size_t>(from[4] & 3))
    , fixes(static_cast<std::size_t>(from[5] & 3))
    , form{ from[6] & 1, from[6] >> 1 & 1, (from[6] & 4) != 0 ? 21 : 10 }
  {
  }

  /// Particles that are there before.
  Particles particles() const
  {
    granular_bonds* all = nullptr;
    granular_bonds_create(most_bonds, history, &all);
    granular_bonds_resize(all, before);
    return { all, granular_bonds_destroy };
  }

  int routine; ///< or a record
  int kind;
  std::int32_t most_bonds;
  std::int32_t history;
  std::size_t before;
  std::size_t fixes; ///< doubles of fixes in a record
  granular_bonds_form form;
};

granular_bonds_arrays arrays_of(const Particles& particles)
{
  granular_bonds_arrays arrays;
  granular_bonds_view(particles.get(), &arrays);
  return arrays;
}

/// The same bits, or the same number: a whole number may have been -0.
bool same(std::span<const double> a, std::span<const double> b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](double x, double y)
    { return x == y || std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); });
}

/// Appends the record of a particle; false: this form has no place for a number.
bool pack_record(const Particles& particles, std::size_t row, const Setting& setting,
  std::span<const double> fixes, Doubles& records)
{
  std::size_t doubles = 0;
  Doubles packed(1000);
  const granular_bonds_status status = granular_bonds_pack_record(particles.get(), row,
    &setting.form, fixes.data(), fixes.size(), packed.data(), packed.size(), &doubles);
  require(status == GRANULAR_BONDS_OK || status == GRANULAR_BONDS_LIMIT_ERROR, "a record");
  records.insert(records.end(), packed.begin(), packed.begin() + std::ptrdiff_t(doubles));
  return status == GRANULAR_BONDS_OK;
}

Doubles pack(const Particles& particles, int kind, std::size_t first, std::size_t count)
{
  std::size_t doubles = 0;
  granular_bonds_pack(particles.get(), kind, first, count, nullptr, nullptr, nullptr, 0, &doubles);
  Doubles packed(doubles + 1);
  require(granular_bonds_pack(particles.get(), kind, first, count, nullptr, nullptr, packed.data(),
            doubles, &doubles) == GRANULAR_BONDS_OK,
    "what was unpacked is packed");
  packed.pop_back();
  return packed;
}

/// Rows from the last one there was on, so that the first is overwritten.
void check_message(const Setting& setting, std::span<const double> buffer)
{
  const Particles particles = setting.particles();
  const bool adds = setting.routine == GRANULAR_BONDS_EXCHANGE;
  const std::size_t first = adds ? setting.before : setting.before / 2;
  std::size_t count = 0;
  const auto unpack = [&](std::size_t from, const std::int32_t* list)
  {
    return granular_bonds_unpack(
      particles.get(), setting.kind, from, list, buffer.data(), buffer.size(), &count);
  };
  const bool unpacked = unpack(first, nullptr) == GRANULAR_BONDS_OK;
  const std::size_t size = arrays_of(particles).size;
  require(size == (unpacked ? std::max(setting.before, first + count) : setting.before),
    "the number of particles");
  if (setting.routine != GRANULAR_BONDS_REVERSE) // of which forces are added
  {
    require(!unpacked || same(pack(particles, setting.kind, first, count), buffer), "packed again");
    return;
  }
  const std::vector<std::int32_t> last(buffer.size() / 3 + 1, static_cast<std::int32_t>(size) - 1);
  unpack(0, last.data());
}

void check_records(const Setting& setting, std::span<const double> buffer)
{
  const Particles particles = setting.particles();
  for (std::size_t doubles = 0; !buffer.empty(); buffer = buffer.subspan(doubles))
  {
    const std::size_t row = arrays_of(particles).size;
    const bool read = granular_bonds_unpack_record(particles.get(), &setting.form, setting.fixes,
                        buffer.data(), buffer.size(), &doubles) == GRANULAR_BONDS_OK;
    require(arrays_of(particles).size == row + (read ? 1 : 0), "a particle for a record");
    if (!read)
    {
      return;
    }
    require(doubles > setting.fixes && doubles <= buffer.size(), "the end of a record");

    // what is written is read as it was
    const auto fixes = buffer.first(doubles).last(setting.fixes);
    Doubles once;
    if (!pack_record(particles, row, setting, fixes, once))
    {
      continue;
    }
    Setting empty = setting;
    empty.before = 0;
    const Particles again = empty.particles();
    Doubles twice;
    require(granular_bonds_unpack_record(again.get(), &setting.form, setting.fixes, once.data(),
              once.size(), nullptr) == GRANULAR_BONDS_OK &&
        pack_record(again, 0, setting, fixes, twice) && same(once, twice),
      "written again");
  }
}

}

void fuzz::mutate(std::string& bytes, Random& random, std::size_t most)
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
  Setting setting(bytes);
  setting.before = below(random, 4) + 1;
  const Particles particles = setting.particles();
  const granular_bonds_arrays a = arrays_of(particles);
  const Doubles history(static_cast<std::size_t>(setting.history) + 1, 0.25);
  Doubles packed;
  for (std::size_t row = 0; row < a.size; ++row)
  {
    a.type[row] = static_cast<std::int32_t>(below(random, 4)) + 1;
    a.tag[row] = other_integer<std::int64_t>(1, random);
    a.mask[row] = other_integer<std::int32_t>(1, random);
    a.molecule[row] = static_cast<std::int64_t>(below(random, 9));
    a.image[3 * row + 2] = static_cast<std::int32_t>(below(random, 9)) - 4;
    for (std::size_t bond = below(random, static_cast<std::size_t>(setting.most_bonds) + 1);
         bond > 0; --bond)
    {
      granular_bonds_add_bond(particles.get(), row, static_cast<std::int32_t>(below(random, 3)),
        other_integer<std::int64_t>(1, random), history.data());
    }
    if (setting.routine == record &&
      !pack_record(particles, row, setting, Doubles(setting.fixes, 7.0), packed))
    {
      return mutate_bytes(bytes, most); // an id that a record has no place for
    }
  }
  if (setting.routine != record)
  {
    packed = pack(particles, setting.kind, 0, a.size);
  }
  bytes.resize(one_in(random, 3) ? Setting::bytes + 8 * doubles : Setting::bytes);
  bytes.append(reinterpret_cast<const char*>(packed.data()), 8 * packed.size());
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
  (setting.routine == record ? check_records : check_message)(setting, buffer);
  return 0;
}
