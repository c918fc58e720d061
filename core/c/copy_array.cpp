// SPDX-License-Identifier: BSD-3-Clause
// Numbers of one type as those of another.
#include "frame.h"

#include "granular/numbers/number_print.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace granular_c
{
using namespace granular;

namespace
{
/// Calls with a null pointer to the C++ type of a type of numbers.
template <class Use>
void with_type(ValueType type, Use&& use)
{
  switch (type)
  {
    case ValueType::Int8:
      return use(static_cast<std::int8_t*>(nullptr));
    case ValueType::UInt8:
      return use(static_cast<std::uint8_t*>(nullptr));
    case ValueType::Int16:
      return use(static_cast<std::int16_t*>(nullptr));
    case ValueType::UInt16:
      return use(static_cast<std::uint16_t*>(nullptr));
    case ValueType::Int32:
    case ValueType::Text:
      return use(static_cast<std::int32_t*>(nullptr));
    case ValueType::UInt32:
      return use(static_cast<std::uint32_t*>(nullptr));
    case ValueType::Int64:
      return use(static_cast<std::int64_t*>(nullptr));
    case ValueType::UInt64:
      return use(static_cast<std::uint64_t*>(nullptr));
    case ValueType::Float32:
      return use(static_cast<float*>(nullptr));
    case ValueType::Float64:
      return use(static_cast<double*>(nullptr));
    default:
      throw BadArgument("expected a type of granular_type");
  }
}

/// Returns a number with all its digits.
template <class Number>
std::string digits_of(Number number)
{
  if constexpr (std::is_floating_point_v<Number>)
  {
    return to_text(static_cast<double>(number));
  }
  else
  {
    return std::to_string(number);
  }
}

/// Returns true if a number is the same in another type; floats may be rounded to floats.
template <class To, class From>
bool fits(From value, To converted) noexcept
{
  if constexpr (std::is_floating_point_v<To>)
  {
    return (std::is_floating_point_v<From> &&
             std::isfinite(static_cast<double>(value)) == std::isfinite(converted)) ||
      static_cast<long double>(converted) == static_cast<long double>(value);
  }
  else if constexpr (std::is_floating_point_v<From>)
  {
    constexpr auto most = static_cast<From>(std::numeric_limits<To>::max());
    return value >= static_cast<From>(std::numeric_limits<To>::min()) && value <= most &&
      static_cast<From>(converted) == value && (most != value || sizeof(To) < sizeof(From));
  }
  else
  {
    return std::in_range<To>(value);
  }
}

template <class To, class From>
To convert(From value) noexcept
{
  if constexpr (std::is_integral_v<To> && std::is_floating_point_v<From>)
  {
    // undefined for numbers beyond the type, which do not fit
    constexpr auto least = static_cast<From>(std::numeric_limits<To>::min());
    constexpr auto most = static_cast<From>(std::numeric_limits<To>::max());
    constexpr bool is_exact = sizeof(To) < sizeof(From); // or the largest number is rounded up
    return value >= least && (value < most || (is_exact && value == most)) ? static_cast<To>(value)
                                                                           : To{};
  }
  else
  {
    return static_cast<To>(value);
  }
}
}

void copy_array(const granular_frame& frame, const granular_destination& to)
{
  const FrameArray& array = find_array(frame, to.array);
  const auto values =
    static_cast<std::size_t>(frame.rows) * static_cast<std::size_t>(array.components);
  if (to.values < values || (to.data == nullptr && values > 0))
  {
    throw BadArgument("array '" + array.name + "': expected room for " + std::to_string(values) +
      " values, got " + std::to_string(to.data == nullptr ? 0 : to.values));
  }
  if (to.type < GRANULAR_INT8 || to.type > GRANULAR_TEXT)
  {
    throw BadArgument("array '" + array.name + "': expected a type of granular_type, got " +
      std::to_string(to.type));
  }
  if (array.type == ValueType::Text && to.type != GRANULAR_TEXT)
  {
    throw BadArgument("array '" + array.name + "': expected the type GRANULAR_TEXT for words");
  }
  with_type(static_cast<ValueType>(to.type),
    [&](auto* target_type)
    {
      with_type(array.type,
        [&](auto* source_type)
        {
          using To = std::remove_pointer_t<decltype(target_type)>;
          using From = std::remove_pointer_t<decltype(source_type)>;
          const auto* const from = static_cast<const From*>(array.data);
          auto* const target = static_cast<char*>(to.data); // at any address
          for (std::size_t i = 0; i < values; ++i)
          {
            const To value = convert<To>(from[i]);
            if (!fits<To>(from[i], value))
            {
              throw BadArgument("array '" + array.name + "', value " + std::to_string(i) +
                ": expected a number of the wanted type, got " + digits_of(from[i]));
            }
            std::memcpy(target + i * sizeof(To), &value, sizeof(To));
          }
        });
    });
}
}
