// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/dump_format.h"

#include "granular/common/error.h"
#include "granular/common/words.h"

#include <algorithm>

namespace granular
{
DumpFormat format_of_name(
  std::string_view path, const std::string& columns, const std::string& numbers)
{
  DumpFormat format;
  format.binary = is_binary_name(path);
  format.compression = compression_of_name(path);
  const std::vector<std::string_view> names = split_words(columns);
  format.columns.assign(names.begin(), names.end());
  format.numbers = parse_number_format(numbers.empty() ? "Automatic" : numbers);
  return format;
}

Dialect choose_dialect(const DumpFormat& format, const FrameHeader& header) noexcept
{
  const bool names_are_lost = format.binary && !header.digits.empty();
  const Dialect same = names_are_lost || format.units || format.time
    ? Dialect::Lammps
    : header.dialect.value_or(Dialect::Lammps);
  return format.dialect.value_or(same);
}

void check_format(const DumpFormat& format, const std::string& path)
{
  if (format.binary && format.compression != Compression::None)
  {
    throw UnsupportedError(
      "expected text to compress, got a binary dump: no program reads that", { path });
  }
  if (format.style != DumpStyle::Local)
  {
    return;
  }
  if (format.binary)
  {
    throw UnsupportedError(
      "expected text for local data, got a binary dump: no program reads that", { path });
  }
  constexpr std::string_view sections[] = { "ATOMS", "BOX", "LABEL", "NUMBER", "TIME", "TIMESTEP",
    "UNITS" };
  const std::string& word = format.counted;
  const bool is_word =
    std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (!is_word || std::find(std::begin(sections), std::end(sections), word) != std::end(sections))
  {
    throw Error(
      "expected one word for what the rows are called, as ENTRIES, CONTACTS or BONDS, and not "
      "that of another section, got '" +
        word + "'",
      { path });
  }
}

std::vector<std::string> atom_columns(const AtomForm& form)
{
  const std::string columns = std::string("id type ") + (form.scaled ? "xs ys zs" : "x y z") +
    (form.image ? " ix iy iz" : "");
  const std::vector<std::string_view> names = split_words(columns);
  return { names.begin(), names.end() };
}

FrameView view_atoms(const AtomRows& atoms, const FrameHeader& header)
{
  FrameView frame;
  frame.header = header;
  frame.rows = atoms.rows;
  frame.points = view_rows("points", ValueType::Float64, atoms.positions, 3);
  frame.arrays.push_back(view_rows("id", ValueType::Int64, atoms.ids));
  frame.arrays.push_back(view_rows("type", ValueType::Int32, atoms.types));
  if (atoms.images)
  {
    frame.arrays.push_back(view_rows("image", ValueType::Int32, atoms.images, 3));
  }
  return frame;
}
}
