// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/vtk_files/vtk_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace granular
{
namespace
{
/// The first bytes as an unsigned number, the first the most significant.
template <class U>
U load_big(const char* bytes) noexcept
{
  U value = 0;
  for (std::size_t i = 0; i < sizeof(U); ++i)
  {
    value = static_cast<U>(std::uint64_t{ value } << 8 | static_cast<unsigned char>(bytes[i]));
  }
  return value;
}

/// False: the number is not whole or does not fit.
template <class From, class To>
bool convert(From from, To& to) noexcept
{
  bool fits = true;
  if constexpr (std::is_same_v<To, std::int64_t> && std::is_floating_point_v<From>)
  {
    fits = from >= -0x1p63 && from < 0x1p63 && from == std::trunc(from);
  }
  else if constexpr (std::is_same_v<To, std::int64_t>)
  {
    fits = std::in_range<std::int64_t>(from);
  }
  to = fits ? static_cast<To>(from) : 0;
  return fits;
}

/// Returns how many could be converted.
template <class Bits, class From, class To>
std::int64_t load(const char* bytes, To* numbers, std::int64_t count) noexcept
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto from =
      std::bit_cast<From>(load_big<Bits>(bytes + i * static_cast<std::int64_t>(sizeof(Bits))));
    if (!convert(from, numbers[i]))
    {
      return i;
    }
  }
  return count;
}

template <class To>
std::int64_t load_bits(const char* bytes, To* numbers, std::int64_t count)
{
  for (std::int64_t i = 0; i < count; ++i)
  {
    numbers[i] = static_cast<To>(static_cast<unsigned char>(bytes[i / 8]) >> (7 - i % 8) & 1);
  }
  return count;
}

template <class To>
using Load = std::int64_t (*)(const char*, To*, std::int64_t);

/// By ValueType; words are none.
template <class To>
constexpr Load<To> loads[] = { &load<std::uint8_t, std::int8_t, To>,
  &load<std::uint8_t, std::uint8_t, To>, &load<std::uint16_t, std::int16_t, To>,
  &load<std::uint16_t, std::uint16_t, To>, &load<std::uint32_t, std::int32_t, To>,
  &load<std::uint32_t, std::uint32_t, To>, &load<std::uint64_t, std::int64_t, To>,
  &load<std::uint64_t, std::uint64_t, To>, &load<std::uint32_t, float, To>,
  &load<std::uint64_t, double, To>, nullptr, nullptr, &load_bits<To> };
}

std::int64_t VtkArray::size() const noexcept
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  return components != 0 && tuples > most / components ? most : tuples * components;
}

std::int64_t cells_between(const std::array<std::int64_t, 3>& positions) noexcept
{
  std::int64_t cells = 1;
  for (const std::int64_t along : positions)
  {
    cells =
      VtkArray{ {}, ValueType::Float64, cells, std::max(along, std::int64_t{ 1 }) - 1 }.size();
  }
  return cells;
}

std::int64_t bytes_of(ValueType type) noexcept
{
  return is_number(type) ? static_cast<std::int64_t>(size_of(type)) : 0;
}

template <class T>
std::int64_t load_numbers(
  ValueType type, const char* bytes, std::int64_t count, T* numbers) noexcept
{
  return loads<T>[static_cast<std::size_t>(type)](bytes, numbers, count);
}

template std::int64_t load_numbers(ValueType, const char*, std::int64_t, double*) noexcept;
template std::int64_t load_numbers(ValueType, const char*, std::int64_t, std::int64_t*) noexcept;
}
