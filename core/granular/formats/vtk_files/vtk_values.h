// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_vtk_files_vtk_values_h
#define granular_formats_vtk_files_vtk_values_h

#include "granular/common/value_type.h"
#include "granular/numbers/number.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace granular
{
/// A contiguous range of values in a file.
struct VtkArray
{
  std::string name = {}; ///< as the file spells it
  ValueType type = ValueType::Float64;
  std::int64_t components = 1;
  std::int64_t tuples = 0;

  std::int64_t size() const noexcept; ///< values; the largest number there is, where it is larger
};

/// Returns the number of cells of a rectilinear grid with this many positions along each axis; a flat axis counts as
/// one cell. Returns the largest integer if the number is larger.
std::int64_t cells_between(const std::array<std::int64_t, 3>& positions) noexcept;

/// Returns the bytes of a binary number in a VTK file; 0 for words, and for bits, of which eight make a byte. Binary
/// numbers have the most significant byte first, `long` has eight bytes, vtkIdType four.
std::int64_t bytes_of(ValueType type) noexcept;

/// Converts binary numbers to double or std::int64_t. Returns the number of converted values: all, or those before the
/// first that is not an integer or does not fit.
template <class T>
std::int64_t load_numbers(
  ValueType type, const char* bytes, std::int64_t count, T* numbers) noexcept;

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
