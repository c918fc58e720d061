// SPDX-License-Identifier: BSD-3-Clause
#include "../support/hard_case.h"
#include "bonds.h"

#include <array>

using namespace bonds;

namespace
{
/// The fields that the programs send, by hand: x v f, X and V of the molecule, id, type, mask, molecule.
struct Order
{
  int kind;
  std::string fields;
  Numbers of_one; ///< of the particle of one()
};

const std::vector<Order> orders = {
  { GRANULAR_BONDS_COMM, "xXV", { 1, 2, 3, 10, 11, 12, 13, 14, 15 } },
  { GRANULAR_BONDS_COMM + plain, "x", { 1, 2, 3 } },
  { GRANULAR_BONDS_COMM_VELOCITY, "xvXV", { 1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15 } },
  { GRANULAR_BONDS_COMM_VELOCITY + plain, "xv", { 1, 2, 3, 4, 5, 6 } },
  { GRANULAR_BONDS_BORDER, "xitmoXV", { 1, 2, 3, 21, 22, 23, 24, 10, 11, 12, 13, 14, 15 } },
  { GRANULAR_BONDS_BORDER + plain, "xitmo", { 1, 2, 3, 21, 22, 23, 24 } },
  { GRANULAR_BONDS_BORDER_VELOCITY, "xitmovXV",
    { 1, 2, 3, 21, 22, 23, 24, 4, 5, 6, 10, 11, 12, 13, 14, 15 } },
  { GRANULAR_BONDS_BORDER_VELOCITY + plain, "xitmov", { 1, 2, 3, 21, 22, 23, 24, 4, 5, 6 } },
  { GRANULAR_BONDS_BORDER_HYBRID, "o", { 24 } },
  { GRANULAR_BONDS_BORDER_HYBRID + plain, "o", { 24 } },
  { GRANULAR_BONDS_REVERSE, "f", { 7, 8, 9 } },
  { GRANULAR_BONDS_REVERSE + plain, "f", { 7, 8, 9 } },
};

/// The first of some particles, by hand.
Object one(std::size_t count = 1)
{
  Object particles = create(1, 0, count);
  const granular_bonds_arrays a = arrays_of(particles);
  set(a.x, 1, 2, 3);
  set(a.v, 4, 5, 6);
  set(a.f, 7, 8, 9);
  set(a.x_mol, 10, 11, 12);
  set(a.v_mol, 13, 14, 15);
  a.tag[0] = 21;
  a.type[0] = 22;
  a.mask[0] = 23;
  a.molecule[0] = 24;
  return particles;
}

/// The rule for ids: up to 2^53 their value, beyond their bits; an id whose bits are such a value gets the bits of that integer.
double number_of_id(std::int64_t id)
{
  const auto small = [](double number)
  {
    return std::abs(number) <= 0x1p53 && std::trunc(number) == number &&
      std::bit_cast<std::uint64_t>(number) != std::uint64_t{ 1 } << 63;
  };
  if (std::abs(static_cast<long double>(id)) <= 0x1p53L)
  {
    return static_cast<double>(id);
  }
  const auto bits = std::bit_cast<double>(id);
  return small(bits) ? std::bit_cast<double>(static_cast<std::int64_t>(bits)) : bits;
}

/// The doubles of a particle, field by field.
void append(const granular_bonds_arrays& a, std::size_t i, const std::string& fields, Numbers& to)
{
  for (const char field : fields)
  {
    const double* const vector = field == 'x' ? a.x
      : field == 'v'                          ? a.v
      : field == 'f'                          ? a.f
      : field == 'X'                          ? a.x_mol
      : field == 'V'                          ? a.v_mol
                                              : nullptr;
    if (vector != nullptr)
    {
      to.insert(to.end(), vector + 3 * i, vector + 3 * i + 3);
      continue;
    }
    to.push_back(field == 'i' ? number_of_id(a.tag[i])
        : field == 't'        ? a.type[i]
        : field == 'm'        ? a.mask[i]
                              : number_of_id(a.molecule[i]));
  }
}
}

TEST(BondMessages, OneParticleByHand)
{
  const Object particles = one();
  for (const Order& order : orders)
  {
    EXPECT_EQ(pack(particles, order.kind, 0, 1), order.of_one) << order.fields;
  }
}

TEST(BondMessages, RowsAndListsAreThoseOfPlainLoops)
{
  HardCase changed("messages",
    "all fields of bonded particles, by plain loops: NaN payloads, -0, denormals, ids beyond 2^53; "
    "other bits",
    "messages", 0);
  const Object particles = make(700, 2, 1, 11);
  const granular_bonds_arrays a = arrays_of(particles);
  std::vector<std::int32_t> list;
  for (int k = 0; k < 300; ++k)
  {
    list.push_back(k % 10 == 0 ? 699 : k * k % 700);
  }
  for (const Order& order : orders)
  {
    for (const auto& [first, count] : std::vector<std::pair<std::size_t, std::size_t>>{
           { 0, 700 }, { 130, 255 }, { 3, 1 }, { 700, 0 }, { 5, 0 } })
    {
      Numbers expected;
      for (std::size_t i = first; i < first + count; ++i)
      {
        append(a, i, order.fields, expected);
      }
      changed.add(bits_of(pack(particles, order.kind, first, count)) == bits_of(expected) ? 0 : 1);
    }
    Numbers expected;
    for (std::size_t k = 1; k < list.size(); ++k)
    {
      append(a, static_cast<std::size_t>(list[k]), order.fields, expected);
    }
    const Numbers packed = pack(particles, order.kind, 1, list.size() - 1, list.data());
    changed.add(bits_of(packed) == bits_of(expected) ? 0 : 1);
  }
}

/// Particles that are unpacked give the same buffer again, and nothing else has changed: neither fields that are not sent, nor
/// rows before and behind.
TEST(BondMessages, UnpackingIsTheOtherWay)
{
  HardCase changed("messages",
    "bonded particles unpacked into old, new and mixed rows: changed bits of what is sent, or of "
    "anything else",
    "messages", 0);
  constexpr std::size_t count = 700;
  constexpr std::size_t old = 1000;
  const Object particles = make(count, 2, 1, 11);
  for (const Order& order : orders)
  {
    if (order.fields == "f")
    {
      continue;
    }
    const Numbers buffer = pack(particles, order.kind, 0, count);
    for (const std::size_t first : { 0U, 13U, 650U, 1000U })
    {
      const Object others = make(2000, 1, 0, 12);
      expect_ok(
        granular_bonds_resize(others.get(), old)); // there was something else in the room behind
      if (first == 650)
      {
        expect_ok(granular_bonds_grow(others.get(), old));
      }
      const Object expected = make(old, 1, 0, 12);
      expect_ok(granular_bonds_resize(expected.get(), std::max(old, first + count)));
      const granular_bonds_arrays from = arrays_of(particles);
      const granular_bonds_arrays to = arrays_of(expected);
      const auto copy = [&](char field, const auto* sent, auto* kept, std::size_t width)
      {
        if (order.fields.find(field) != std::string::npos)
        {
          std::copy_n(sent, count * width, kept + first * width);
        }
      };
      copy('x', from.x, to.x, 3);
      copy('v', from.v, to.v, 3);
      copy('X', from.x_mol, to.x_mol, 3);
      copy('V', from.v_mol, to.v_mol, 3);
      copy('i', from.tag, to.tag, 1);
      copy('t', from.type, to.type, 1);
      copy('m', from.mask, to.mask, 1);
      copy('o', from.molecule, to.molecule, 1);
      std::size_t unpacked = 0;
      expect_ok(granular_bonds_unpack(
        others.get(), order.kind, first, nullptr, buffer.data(), buffer.size(), &unpacked));
      EXPECT_EQ(unpacked, count);
      changed.add(bits_of(others) == bits_of(expected) ? 0 : 1);
    }
  }
}

TEST(BondMessages, ForcesAreAdded)
{
  const Object particles = one(2);
  const Numbers buffer = { 0.5, 1, 2, 100, 200, 300, 0.25, 0, 0 };
  const std::int32_t rows[] = { 0, 1, 0 };
  expect_ok(granular_bonds_unpack(
    particles.get(), GRANULAR_BONDS_REVERSE, 0, rows, buffer.data(), 9, nullptr));
  const granular_bonds_arrays a = arrays_of(particles);
  EXPECT_EQ(Numbers(a.f, a.f + 6), (Numbers{ 7.75, 9, 11, 100, 200, 300 }));
  expect_ok(granular_bonds_unpack(
    particles.get(), GRANULAR_BONDS_REVERSE, 1, nullptr, buffer.data(), 3, nullptr));
  EXPECT_EQ(Numbers(a.f, a.f + 6), (Numbers{ 7.75, 9, 11, 100.5, 201, 302 }));
}

/// Numbers that add up without rounding. Only the second particle is in a moving group; the list has it first, as the mask that
/// counts is that of the particle, not that of its place.
TEST(BondMessages, ShiftedByHand)
{
  const Object particles = one(2);
  const granular_bonds_arrays a = arrays_of(particles);
  set(a.x + 3, 1, 2, 3);
  a.mask[0] = 2;
  a.mask[1] = 8 + 2;
  for (const int triclinic : { 0, 1 })
  {
    const granular_bonds_shift shift = { { 1, -1, 2, -1, 1, 3 }, { 1000, 2000, 4000 },
      { 0.5, 0.25, 0.125 }, triclinic, { 16, 32, 64, 1, 2, 4 }, 1 + 8 };
    using Triple = std::array<double, 3>;
    const Triple comm = { 1000 + (triclinic ? 3 * 0.125 + 0.25 : 0), -2000 - (triclinic ? 0.5 : 0),
      8000 };
    const Triple border = triclinic ? Triple{ 1, -1, 2 } : Triple{ 1000, -2000, 8000 };
    const Triple v = { 16 + 3 * 4 + 2, -32 - 1, 128 };
    for (const Order& order : orders)
    {
      if (order.fields[0] != 'x')
      {
        continue;
      }
      Numbers expected;
      append(a, 1, order.fields, expected);
      append(a, 0, order.fields, expected);
      const bool is_border = order.fields.find('t') != std::string::npos;
      for (std::size_t k = 0; k < 3; ++k)
      {
        expected[k] += is_border ? border[k] : comm[k];
        expected[expected.size() / 2 + k] += is_border ? border[k] : comm[k];
        if (order.fields.find('v') != std::string::npos)
        {
          expected[k + (is_border ? 7 : 3)] += v[k];
        }
      }
      const std::int32_t list[] = { 1, 0 };
      EXPECT_EQ(pack(particles, order.kind, 0, 2, list, &shift), expected)
        << order.fields << triclinic;
    }
  }
  const granular_bonds_shift none = { {}, { 1, 1, 1 }, {}, 1, {}, 1 };
  set(a.x, -0.0, 0, 0);
  EXPECT_TRUE(std::signbit(pack(particles, GRANULAR_BONDS_COMM, 0, 1, nullptr, &none)[0]));
}

// ---- errors ------------------------------------------------------------------------------------

TEST(BondMessages, WrongArguments)
{
  const Object particles = make(4, 1, 0, 1);
  const auto before = bits_of(particles);
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  Numbers buffer(12);
  std::size_t doubles = 0;
  const auto packing = [&](int kind, std::size_t first, std::size_t count,
                         const std::int32_t* list = nullptr,
                         const granular_bonds_shift* shift = nullptr)
  {
    return message_of(granular_bonds_pack(particles.get(), kind, first, count, list, shift,
                        buffer.data(), 12, &doubles),
      GRANULAR_BONDS_BAD_ARGUMENT);
  };
  EXPECT_EQ(packing(plain, 1, 4), "expected rows of 4 particles, got 4 from 1 on");
  packing(plain, 5, 0);
  packing(plain, 2, all);
  packing(plain, all, 2);
  for (const std::int32_t row : { 4, -1, Limits32::min() })
  {
    const std::int32_t list[] = { 0, row };
    EXPECT_EQ(
      packing(plain, 0, 2, list), "expected rows of 4 particles, got row " + std::to_string(row));
  }
  EXPECT_EQ(packing(GRANULAR_BONDS_COMM, 0, 2), "expected room for 18 doubles, got 12");
  EXPECT_EQ(doubles, 18U);
  for (const int kind : { -1, 7, 15, 23, 32, Limits32::min(), Limits32::max() })
  {
    EXPECT_EQ(packing(kind, 0, 1),
      "expected a kind from 0 to 6, or with 16 added, got " + std::to_string(kind));
  }
  const granular_bonds_shift shift = { { 1 }, {}, {}, 0, {}, 0 };
  for (const int kind : { GRANULAR_BONDS_BORDER_HYBRID, GRANULAR_BONDS_REVERSE })
  {
    EXPECT_EQ(packing(kind, 0, 1, nullptr, &shift),
      "expected no shift of a message without copies of positions");
  }

  const auto unpacking = [&](int kind, std::size_t first, std::size_t size,
                           granular_bonds_status status, const std::int32_t* list = nullptr)
  {
    return message_of(
      granular_bonds_unpack(particles.get(), kind, first, list, buffer.data(), size, nullptr),
      status);
  };
  EXPECT_EQ(unpacking(plain, 0, 11, GRANULAR_BONDS_FORMAT_ERROR),
    "expected 3 doubles of each particle, got 11");
  EXPECT_EQ(unpacking(plain, 5, 12, GRANULAR_BONDS_BAD_ARGUMENT),
    "expected a first row of at most 4, got 5");
  unpacking(plain, all, 12, GRANULAR_BONDS_BAD_ARGUMENT);
  unpacking(7, 0, 12, GRANULAR_BONDS_BAD_ARGUMENT);
  EXPECT_EQ(unpacking(GRANULAR_BONDS_EXCHANGE, 3, 12, GRANULAR_BONDS_BAD_ARGUMENT),
    "expected a first row of 4, got 3");
  const std::int32_t rows[] = { 0, 1, 2, 4 };
  EXPECT_EQ(unpacking(plain, 0, 12, GRANULAR_BONDS_BAD_ARGUMENT, rows),
    "expected a list of rows for forces alone");
  unpacking(GRANULAR_BONDS_REVERSE, 0, 12, GRANULAR_BONDS_BAD_ARGUMENT, rows);
  unpacking(GRANULAR_BONDS_REVERSE, 1, 12, GRANULAR_BONDS_BAD_ARGUMENT);
  EXPECT_EQ(bits_of(particles), before);
}

TEST(BondMessages, TypesAndMasksThatAreNone)
{
  const Object particles = make(400, 1, 0, 1);
  const auto before = bits_of(particles);
  for (const double wrong : { 0.5, Doubles::quiet_NaN(), 0x1p31, -0x1p31 - 1, 1e300,
         -Doubles::infinity(), 1e-310, 0x1p52, 0x1p64 + 0x1p40 })
  {
    for (const std::size_t at : { 4U, 5U })
    {
      Numbers buffer = pack(particles, GRANULAR_BONDS_BORDER + plain, 0, 400);
      buffer[7 * 300 + at] = wrong;
      for (const std::size_t first : { 0U, 300U, 400U })
      {
        const std::string text =
          message_of(unpack(particles, GRANULAR_BONDS_BORDER + plain, first, buffer),
            GRANULAR_BONDS_FORMAT_ERROR);
        EXPECT_EQ(text.substr(0, text.find(", got")),
          "expected a whole number of 32 bits in double " + std::to_string(7 * 300 + at) +
            " of the buffer, of its particle 300");
        EXPECT_EQ(bits_of(particles), before);
      }
    }
  }
}

TEST(BondMessages, Nothing)
{
  const Object none = create(1, 0);
  for (int kind = 0; kind <= GRANULAR_BONDS_EXCHANGE; ++kind)
  {
    EXPECT_TRUE(pack_all(none, kind).empty());
    expect_ok(granular_bonds_unpack(none.get(), kind, 0, nullptr, nullptr, 0, nullptr));
  }
  EXPECT_EQ(arrays_of(none).capacity, 0U);
}
