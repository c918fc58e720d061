// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_restart_styles_h
#define granular_restart_restart_styles_h

#include "granular/restart/bond_record.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace granular
{
/// The part of an atom style in a particle's record: the common values (RecordSlots), values, and lists.
struct StyleLayout
{
  static constexpr std::size_t most_lists = 4;

  std::string_view name;
  std::string_view
    columns; ///< of the values behind the common ones, as in known_columns; mol is a whole number
  std::size_t values = 0; ///< doubles up to the first list, or to the end
  std::array<std::uint8_t, most_lists>
    lists = {}; ///< doubles an entry; each list begins with the number of its entries; 0: there is none
  bool bonds = false;   ///< the first list: type and partner
  bool history = false; ///< behind that of the bonds: see look_at_bonds

  bool has_lists() const noexcept { return lists[0] > 0; }
};

/// Returns a style, or null.
const StyleLayout* find_style(std::string_view name) noexcept;

/// Returns the doubles of a style's part that begins here, up to the end of its lists. Not for styles with history. Throws
/// FormatError, with the double of the part, if it needs more doubles than there are.
std::size_t measure_lists(std::span<const double> block, const StyleLayout& style);
}
#endif
