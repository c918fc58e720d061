// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/dump_format.h"

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
  for (const std::string_view name : split_words(columns))
  {
    format.columns.emplace_back(name);
  }
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
}
