// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_history_layout_h
#define granular_restart_history_layout_h

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The history values of a bond, by program.
struct HistoryLayout
{
  std::string_view name; ///< of the program
  std::string_view
    version; ///< a word in the header of its files that no others have; empty: there is none
  std::span<const std::string_view> columns; ///< in turn, as make_local_schema takes them

  /// Values from here on have no sign, in either copy of the bond.
  static constexpr std::size_t unsigned_from = 12;
};

/// The table: WITH-BONDS (12 values), PFM (13), Flexible_Fibers until 2021 (13), Flexible_Fibers and SEAICE (14).
std::span<const HistoryLayout> history_layouts() noexcept;

/// Instead of a place in the table: the layout with as many values, of two that whose word is in the version, else the last.
inline constexpr int automatic_history = -1;
/// Instead of a place in the table: history1, history2, ...
inline constexpr int numbered_history = -2;

/// Returns the layout for a number of values, by its place in the table; version: of the program, from the file's header.
/// Null: there is none, or the layout has another number of values.
const HistoryLayout* find_history_layout(
  int layout, std::string_view version, std::int64_t values) noexcept;

/// Returns names for the values of a layout; without one: history1, history2, ...
std::vector<std::string> history_columns(int layout, std::string_view version, std::int64_t values);
}
#endif
