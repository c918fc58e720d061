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
/// Values of one kind in someone else's memory, a row after the other.
struct ValueSource
{
  ValueType type = ValueType::Float64;
  const void* data = nullptr;
  std::int64_t step = 1; ///< values from one row to the next
  double factor = 1;     ///< 2: a diameter of radii; 0.5: a radius of diameters
};

/// A name as the header of a dump can hold it: one word, with '_' for each blank.
std::string as_word(std::string name);

/// The arrays of a frame by their names, for many questions: an answer does not take a look at all of them. The arrays must
/// outlive this, where they are.
class ArraysByName
{
public:
  explicit ArraysByName(const std::vector<ArrayView>& arrays);

  /// Those of a frame, also where a function for arrays by name is given the frame: for one question.
  ArraysByName(const FrameView& frame) // NOLINT: may convert
    : ArraysByName(frame.arrays)
  {
  }

  /// The first array with that name, or else with one that becomes it as a word, and so many components; or null.
  const ArrayView* find(std::string_view name, int components) const;

  /// The first array that becomes that word and has at least so many components, or null.
  const ArrayView* find_longer(std::string_view word, int components) const;

private:
  using Places = std::map<std::string, std::vector<const ArrayView*>, std::less<>>;

  Places names_;
  Places words_;
};

ValueSource component_of(const ArrayView& array, int component, double factor = 1);

/// What a column of this name is made from: the array of this name, the array that columns of this name become,
/// its radius or diameter, or for A[3] the third component of A.
std::optional<ValueSource> find_values(const ArraysByName& arrays, std::string_view name);

/// The same for the columns of a dump, which together become arrays (see ColumnSchema). An array that has the very
/// name of a column comes before one that the column is a part of.
std::vector<std::optional<ValueSource>> find_all_values(
  const ArraysByName& arrays, const std::vector<std::string>& names);

/// The columns that an array becomes.
std::vector<std::string> columns_of(const ArrayView& array);
}
#endif
