// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_value_type_h
#define granular_common_value_type_h

#include <cstddef>
#include <cstdint>

namespace granular
{
/// Types of values in files and in memory. Columns of files become Int32, Int64, Float64 or Text. Written arrays have
/// any type up to Text; only legacy VTK files have all types.
enum class ValueType : std::uint8_t
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64,
  Text,
  Variant, ///< a type and a word
  Bit
};

constexpr bool is_integer(ValueType type) noexcept
{
  return type < ValueType::Float32;
}

constexpr bool is_number(ValueType type) noexcept
{
  return type < ValueType::Text || type == ValueType::Bit;
}

/// Returns the bytes of one value in an array. For Text these are the bytes of the word's index, std::int32_t; for
/// types without a fixed size 0.
constexpr std::size_t size_of(ValueType type) noexcept
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, sizeof(std::int32_t), 0, 0 };
  return sizes[static_cast<std::size_t>(type)];
}
}
#endif
