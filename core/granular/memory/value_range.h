// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_memory_value_range_h
#define granular_memory_value_range_h

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace granular
{
/// The minimum and maximum of each component of some rows, and of the rows' sums of squares.
class ValueRange
{
public:
  using Bounds = std::array<double, 2>;

  ValueRange() = default;
  explicit ValueRange(std::size_t components)
    : components_(components, nothing)
  {
  }

  /// Adds rows of type double, float, std::int32_t or std::int64_t.
  template <typename T>
  void add(const T* values, std::size_t rows) noexcept;

  void add(const ValueRange& other) noexcept;

  /// Returns true if there were values and all values and sums of squares are finite. Otherwise the range is unknown.
  bool known() const noexcept;

  /// Returns the range of each component.
  const std::vector<Bounds>& components() const noexcept { return components_; }

  /// Returns the range of x^2 + y^2 + ..., added up in doubles from the first component on.
  const Bounds& squares() const noexcept { return squares_; }

private:
  static constexpr Bounds nothing = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };

  std::vector<Bounds> components_;
  Bounds squares_ = nothing;
  bool numbers_ = true; ///< no value was none
};
}
#endif
