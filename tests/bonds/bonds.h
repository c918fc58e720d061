// SPDX-License-Identifier: BSD-3-Clause
// Bonded particles of granular_bonds.h that end by themselves, with hard values, and all their bits.
#ifndef granular_tests_bonds_bonds_h
#define granular_tests_bonds_bonds_h

#include "granular_bonds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace bonds
{
using Numbers = std::vector<double>;
using Object = std::unique_ptr<granular_bonds, decltype(&granular_bonds_destroy)>;

/// Dialects.
constexpr int pfm = 0;
constexpr int plain = GRANULAR_BONDS_WITH_BONDS;

/// The status of a function must be this; the message of an error.
inline std::string message_of(granular_bonds_status status, granular_bonds_status expected)
{
  EXPECT_EQ(status, expected) << granular_bonds_last_error();
  return status == GRANULAR_BONDS_OK ? "" : granular_bonds_last_error();
}

inline void expect_ok(granular_bonds_status status)
{
  message_of(status, GRANULAR_BONDS_OK);
}

inline Object create(std::int32_t most_bonds, std::int32_t history_values, std::size_t size = 0)
{
  granular_bonds* particles = nullptr;
  expect_ok(granular_bonds_create(most_bonds, history_values, &particles));
  expect_ok(granular_bonds_resize(particles, size));
  return { particles, granular_bonds_destroy };
}

inline granular_bonds_arrays arrays_of(const Object& particles)
{
  granular_bonds_arrays arrays = {};
  expect_ok(granular_bonds_view(particles.get(), &arrays));
  return arrays;
}

inline void set(double* vector, double x, double y, double z)
{
  vector[0] = x;
  vector[1] = y;
  vector[2] = z;
}

/// Packs rows, all of them or those of a list.
inline Numbers pack(const Object& particles, int kind, std::size_t first, std::size_t count,
  const std::int32_t* list = nullptr, const granular_bonds_shift* shift = nullptr)
{
  std::size_t doubles = 0;
  expect_ok(
    granular_bonds_pack(particles.get(), kind, first, count, list, shift, nullptr, 0, &doubles));
  Numbers buffer(doubles + 1, 77); // there must be a place, also for nothing
  expect_ok(granular_bonds_pack(
    particles.get(), kind, first, count, list, shift, buffer.data(), doubles, &doubles));
  EXPECT_EQ(buffer.back(), 77);
  buffer.resize(doubles);
  return buffer;
}

inline Numbers pack_all(const Object& particles, int kind)
{
  return pack(particles, kind, 0, arrays_of(particles).size);
}

inline granular_bonds_status unpack(
  const Object& particles, int kind, std::size_t first, const Numbers& buffer)
{
  return granular_bonds_unpack(
    particles.get(), kind, first, nullptr, buffer.data(), buffer.size(), nullptr);
}

inline Numbers pack_record(const Object& particles, std::size_t row,
  const granular_bonds_form* form = nullptr, const Numbers& fixes = {})
{
  std::size_t doubles = 0;
  expect_ok(granular_bonds_pack_record(
    particles.get(), row, form, fixes.data(), fixes.size(), nullptr, 0, &doubles));
  Numbers record(doubles);
  expect_ok(granular_bonds_pack_record(particles.get(), row, form, fixes.data(), fixes.size(),
    record.data(), record.size(), &doubles));
  return record;
}

using Words = std::vector<std::uint64_t>;

inline Words bits_of(const Numbers& numbers)
{
  Words words;
  std::ranges::transform(numbers, std::back_inserter(words),
    [](double number) { return std::bit_cast<std::uint64_t>(number); });
  return words;
}

/// All bits of a particle: x v f x_mol v_mol, integers, bonds with their history.
inline Words bits_of(const granular_bonds_arrays& a, std::size_t i)
{
  const auto most_bonds = static_cast<std::size_t>(a.most_bonds);
  const auto history_values = static_cast<std::size_t>(a.history_values);
  Numbers reals;
  for (const double* const vector : { a.x, a.v, a.f, a.x_mol, a.v_mol })
  {
    reals.insert(reals.end(), vector + 3 * i, vector + 3 * i + 3);
  }
  const auto bonds = static_cast<std::size_t>(a.bonds[i]);
  const double* const history = a.history + i * most_bonds * history_values;
  reals.insert(reals.end(), history, history + bonds * history_values);
  Words words = bits_of(reals);
  std::vector<std::int64_t> integers = { a.tag[i], a.molecule[i], a.type[i], a.mask[i],
    a.image[3 * i], a.image[3 * i + 1], a.image[3 * i + 2], a.bonds[i] };
  for (std::size_t k = i * most_bonds; k < i * most_bonds + bonds; ++k)
  {
    integers.insert(integers.end(), { a.bond_types[k], a.partners[k] });
  }
  words.insert(words.end(), integers.begin(), integers.end());
  return words;
}

inline std::vector<Words> bits_of(const Object& particles)
{
  std::vector<Words> all;
  const granular_bonds_arrays a = arrays_of(particles);
  for (std::size_t i = 0; i < a.size; ++i)
  {
    all.push_back(bits_of(a, i));
  }
  return all;
}

// ---- hard values -------------------------------------------------------------------------------

using Limits32 = std::numeric_limits<std::int32_t>;
using Limits64 = std::numeric_limits<std::int64_t>;
using Doubles = std::numeric_limits<double>;

/// Both zeros, the smallest and largest numbers, infinities, a quiet and two signalling nans.
inline const Numbers hard_numbers = { 0, -0.0, 1, -1, 0.1, Doubles::denorm_min(),
  -Doubles::min() / 4, Doubles::max(), Doubles::infinity(), -Doubles::infinity(),
  Doubles::quiet_NaN(), std::bit_cast<double>(std::uint64_t{ 0x7ff0000000000001 }),
  std::bit_cast<double>(std::uint64_t{ 0xfff0dead0000beef }) };

inline const std::vector<std::int64_t> hard_ids = { 0, 1, -1, 7, std::int64_t{ 1 } << 31,
  -(std::int64_t{ 1 } << 31) - 1, 5'000'000'000, (std::int64_t{ 1 } << 52) + 1,
  std::int64_t{ 1 } << 53, (std::int64_t{ 1 } << 53) + 1, -(std::int64_t{ 1 } << 53) - 1,
  4607182418800017408, -4616189618054758400, Limits64::max(), Limits64::min(),
  Limits64::min() + 1 };

inline const std::vector<std::int32_t> hard_integers = { 0, 1, -1, 3, Limits32::max(),
  Limits32::min() };

/// Counts of 21 bits.
inline const std::vector<std::int32_t> hard_images = { 0, -1, 5, -(1 << 20), (1 << 20) - 1 };

class Random
{
public:
  explicit Random(std::uint64_t seed)
    : random_(seed)
  {
  }

  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }

  template <class T>
  T one_of(const std::vector<T>& values)
  {
    return values[this->below(values.size())];
  }

  /// Hard ids, small ones, and any bits.
  std::int64_t id()
  {
    const std::size_t kind = this->below(3);
    return kind == 0 ? this->one_of(hard_ids)
      : kind == 1    ? static_cast<std::int64_t>(this->below(100000))
                     : std::bit_cast<std::int64_t>(random_());
  }

private:
  std::mt19937_64 random_;
};

/// Particles with up to B bonds, of hard values in all fields; every third has B, of which the first two are with itself.
inline Object make(
  std::size_t count, std::int32_t most_bonds, std::int32_t history_values, std::uint64_t seed)
{
  Object particles = create(most_bonds, history_values, count);
  const granular_bonds_arrays a = arrays_of(particles);
  Random random(seed);
  Numbers history(static_cast<std::size_t>(history_values));
  for (std::size_t i = 0; i < count; ++i)
  {
    for (double* const vector : { a.x, a.v, a.f, a.x_mol, a.v_mol })
    {
      std::generate_n(vector + 3 * i, 3, [&] { return random.one_of(hard_numbers); });
    }
    a.tag[i] = random.id();
    a.molecule[i] = random.id();
    a.type[i] = random.one_of(hard_integers);
    a.mask[i] = random.one_of(hard_integers);
    std::generate_n(a.image + 3 * i, 3, [&] { return random.one_of(hard_images); });
    const auto most = static_cast<std::size_t>(most_bonds);
    const std::size_t bonds = i % 3 == 0 ? most : random.below(most + 1);
    for (std::size_t k = 0; k < bonds; ++k)
    {
      std::ranges::generate(history, [&] { return random.one_of(hard_numbers); });
      expect_ok(granular_bonds_add_bond(particles.get(), i, random.one_of(hard_integers),
        k < 2 ? a.tag[i] : random.id(), history.data()));
    }
  }
  return particles;
}
}
#endif
