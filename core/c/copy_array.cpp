// SPDX-License-Identifier: BSD-3-Clause
// Numbers of one type as those of another.
#include "frame.h"

#include "granular/numbers/number_print.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

namespace granular_c
{
using namespace granular;
using namespace std::string_literals;

namespace
{
/// Calls use with a number of the C++ type of a type of numbers, in the order of ValueType; words are indices.
template <class Use>
void with_type(ValueType type, const Use& use)
{
  constexpr std::tuple<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
    std::uint32_t, std::int64_t, std::uint64_t, float, double, std::int32_t>
    numbers = {};
  auto left = static_cast<int>(type);
  std::apply([&](auto... number)
    { static_cast<void>((... || (left-- == 0 && (use(number), true)))); },
    numbers);
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

/// Returns a number in another type, or nothing if it is another one there; floats may be rounded to floats.
template <class To, class From>
std::optional<To> convert(From value) noexcept
{
  if constexpr (std::is_floating_point_v<To>)
  {
    const auto made = static_cast<To>(value);
    const bool same = std::is_floating_point_v<From>
      ? std::isfinite(static_cast<double>(value)) == std::isfinite(made)
      : static_cast<long double>(made) == static_cast<long double>(value);
    return same ? std::optional(made) : std::nullopt;
  }
  else if constexpr (std::is_floating_point_v<From>)
  {
    constexpr auto least = static_cast<From>(std::numeric_limits<To>::min());
    constexpr auto most = static_cast<From>(std::numeric_limits<To>::max());
    constexpr bool is_exact = sizeof(To) < sizeof(From); // or the largest number is rounded up
    // a conversion of numbers beyond the type would be undefined
    const bool is_there = value >= least && (value < most || (is_exact && value == most));
    return is_there && std::trunc(value) == value ? std::optional(static_cast<To>(value))
                                                  : std::nullopt;
  }
  else
  {
    return std::in_range<To>(value) ? std::optional(static_cast<To>(value)) : std::nullopt;
  }
}
}

void copy_array(const granular_frame& frame, const granular_destination& to)
{
  const FrameArray& array = find_array(frame, to.array);
  const auto values =
    static_cast<std::size_t>(frame.table.rows) * static_cast<std::size_t>(array.components);
  if (to.values < values || (to.data == nullptr && values > 0))
  {
    throw ArgumentError("array '"s + array.name + "': expected room for " + std::to_string(values) +
      " values, got " + std::to_string(to.data == nullptr ? 0 : to.values));
  }
  if (to.type < GRANULAR_INT8 || to.type > GRANULAR_TEXT)
  {
    throw ArgumentError("array '"s + array.name + "': expected a type of granular_type, got " +
      std::to_string(to.type));
  }
  if (array.type == ValueType::Text && to.type != GRANULAR_TEXT)
  {
    throw ArgumentError("array '"s + array.name + "': expected the type GRANULAR_TEXT for words");
  }
  with_type(static_cast<ValueType>(to.type),
    [&](auto made)
    {
      with_type(array.type,
        [&](auto given)
        {
          using To = decltype(made);
          using From = decltype(given);
          const auto* const from = static_cast<const From*>(array.values->data());
          auto* const target = static_cast<char*>(to.data); // at any address
          for (std::size_t i = 0; i < values; ++i)
          {
            const std::optional<To> value = convert<To>(from[i]);
            if (!value)
            {
              throw ArgumentError("array '"s + array.name + "', value " + std::to_string(i) +
                ": expected a number of the wanted type, got " + digits_of(from[i]));
            }
            std::memcpy(target + i * sizeof(To), &*value, sizeof(To));
          }
        });
    });
}
}
