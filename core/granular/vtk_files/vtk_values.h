// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_vtk_values_h
#define granular_vtk_files_vtk_values_h

#include "granular/common/value_type.h"

#include <array>
#include <cstdint>
#include <string>

namespace granular
{
/// Values that stand together in a file.
struct VtkArray
{
  std::string name = {}; ///< as the file spells it
  ValueType type = ValueType::Float64;
  std::int64_t components = 1;
  std::int64_t tuples = 0;

  std::int64_t size() const noexcept; ///< values; the largest number there is, where it is larger
};

/// Cells of a rectilinear grid with so many positions along each axis, one where they are flat; the largest number there
/// is, where there are more.
std::int64_t cells_between(const std::array<std::int64_t, 3>& positions) noexcept;

/// Returns the bytes of a binary number in a VTK file; 0 for bits, of which eight are a byte, and for words. Binary numbers have
/// the most significant byte first, `long` has eight bytes, vtkIdType four.
std::int64_t bytes_of(ValueType type) noexcept;

/// Converts binary numbers to double or std::int64_t. Returns how many could be: all, or those before the first that is
/// not whole or does not fit.
template <class T>
std::int64_t load_numbers(
  ValueType type, const char* bytes, std::int64_t count, T* numbers) noexcept;
}
#endif
