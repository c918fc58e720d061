// SPDX-License-Identifier: BSD-3-Clause
// Lines of data files up to the first section.
#ifndef granular_formats_data_file_data_header_h
#define granular_formats_data_file_data_header_h

#include "granular/formats/data_file/data_layout.h"
#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace granular
{
/// Returns the words of a line, less a comment.
std::vector<std::string_view> data_words(std::string_view line);

/// Returns the first byte of a line that is no blank; 0: there is none.
char first_letter(std::string_view line) noexcept;

/// Returns true if a line names a section: rows begin with a number, but see TypeLabels.
bool names_section(std::string_view line) noexcept;

/// Returns true if a word is a 64-bit integer, which is stored.
bool is_integer(std::string_view word, std::int64_t& value);

/// Returns true if a word is the number of a type or its label; the number is stored. labels may be null.
bool is_type(std::string_view word, const TypeLabels* labels, std::int64_t& type);

/// Takes the facts of the title that write_data makes: "..., timestep = 2000, units = lj".
void take_title(std::string_view title, DataLayout& layout);

/// Takes the lines between the title and the first section.
class HeaderLines
{
public:
  /// Takes a line; those of other things are passed over. Throws FormatError.
  void take(std::string_view line, const Where& where, DataLayout& layout);

  Box box() const;
  bool describes_box() const;

  bool counts_atoms = false;

private:
  std::array<std::optional<Vector3>, 8> numbers_; ///< of each line that describes the box
};
}
#endif
