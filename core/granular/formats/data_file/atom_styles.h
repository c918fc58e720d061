// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_atom_styles_h
#define granular_formats_data_file_atom_styles_h

#include "granular/common/error.h"
#include "granular/formats/data_file/data_layout.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The columns of the sections Atoms and Velocities in an atom style, with the names in dumps. Three image counts ix iy iz
/// may follow in all rows of Atoms.
struct AtomStyle
{
  std::string_view name;
  std::string_view columns;
  std::string_view velocities = {}; ///< behind id vx vy vz
  bool has_bonds = false;           ///< particles of the style may have bonds
  bool rare = true; ///< taken for a style without a name only where no other one fits
};

/// Returns the table of styles.
std::span<const AtomStyle> atom_styles() noexcept;

/// A style with its columns, or hybrid with those of its sub-styles.
struct Style
{
  std::string name;
  std::vector<std::string_view> columns;    ///< of Atoms, without image counts
  std::vector<std::string_view> velocities; ///< of Velocities
  bool has_bonds = false;

  /// Returns the columns of rows of so many words: with image counts, or without; none where the style has others.
  std::vector<std::string_view> columns_of(std::size_t words) const;
};

Style style_of(const AtomStyle& style);

/// Returns hybrid with its sub-styles, in their order: id type x y z, then each other column once.
Style hybrid_of(std::span<const AtomStyle* const> parts);

/// Returns the style that a text names: "sphere", "sphere/omp", "hybrid sphere bond"; nothing for no text, or hybrid alone. Words
/// behind a style do not matter, if any may be there, as in a comment. Throws FormatError for other names.
std::optional<Style> named_style(
  std::string_view text, bool any_behind, const DataLayout& layout, const Where& where);

/// Finds the style, or the sub-styles of hybrid, of a file that does not name it: the only columns that fit the values of all rows
/// and the header, with a notice. Throws FormatError that names those that fit.
Style guess_style(const DataLayout& layout, bool hybrid, const Where& where, Notices& notices);

/// Returns "; sphere granular fit all rows: set AtomStyle" for a file that names no style; else nothing.
std::string style_advice(const DataLayout& layout);
}
#endif
