// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_vtk_words_h
#define granular_vtk_files_vtk_words_h

#include "granular/numbers/number.h"

#include <cstdint>
#include <string_view>
#include <type_traits>

namespace granular
{
/// The kind of word that a text must contain, for messages.
template <class T>
constexpr const char* kind_of_word = std::is_integral_v<T> ? "a whole number" : "a number";

/// Parses a word as a number of that kind; returns false if it is none.
inline bool parse_word(std::string_view word, double& number) noexcept
{
  return static_cast<bool>(parse_double(word.data(), word.data() + word.size(), number));
}

inline bool parse_word(std::string_view word, std::int64_t& number) noexcept
{
  return static_cast<bool>(parse_int64(word.data(), word.data() + word.size(), number));
}
}
#endif
