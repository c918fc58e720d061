// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_column_arrays_h
#define granular_particles_column_arrays_h

#include "granular/particles/frame_view.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Values of one kind in someone else's memory, one row after the other.
struct ValueSource
{
  ValueType type = ValueType::Float64;
  const void* data = nullptr;
  std::int64_t step = 1; ///< values from one row to the next
  double factor = 1;     ///< 2: a diameter of radii; 0.5: a radius of diameters
};

/// Returns a name in the form of a dump's header: one word, with '_' for each blank.
std::string as_word(std::string name);

/// The arrays of a frame by their names, for many lookups without scanning them all. The arrays must outlive this.
class ArraysByName
{
public:
  explicit ArraysByName(const std::vector<ArrayView>& arrays);

  /// The arrays of a frame; converts implicitly where a function takes arrays by name, for one lookup.
  ArraysByName(const FrameView& frame) // NOLINT: may convert
    : ArraysByName(frame.arrays)
  {
  }

  /// Returns the first array with that name, or one that becomes it as a word, and so many components; or null.
  const ArrayView* find(std::string_view name, int components) const;

  /// Returns the first array that becomes that word and has at least so many components, or null.
  const ArrayView* find_longer(std::string_view word, int components) const;

private:
  using Places = std::map<std::string, std::vector<const ArrayView*>, std::less<>>;

  Places names_;
  Places words_;
};

ValueSource component_of(const ArrayView& array, int component, double factor = 1);

/// Returns the source of a column: the array of this name, the array that columns of this name become, its radius or
/// diameter, or for A[3] the third component of A.
std::optional<ValueSource> find_values(const ArraysByName& arrays, std::string_view name);

/// Returns the sources of the columns of a dump, which together become arrays (see ColumnSchema). An array with the exact
/// name of a column comes before an array that contains the column.
std::vector<std::optional<ValueSource>> find_all_values(
  const ArraysByName& arrays, const std::vector<std::string>& names);

/// Returns the columns that an array becomes. Where programs spell them in several ways, as quat1 and quatw, those that are among
/// the columns of the input, or else the first in the table of known columns.
std::vector<std::string> columns_of(
  const ArrayView& array, const std::vector<std::string>& input = {});
}
#endif
