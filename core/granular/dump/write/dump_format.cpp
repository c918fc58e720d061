// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/dump_format.h"

#include "granular/common/error.h"

#include <algorithm>

namespace granular
{
namespace
{
/// Whether a name ends so, in capitals or not. The end is in small letters.
bool ends_with(std::string_view path, std::string_view end) noexcept
{
  return path.size() >= end.size() &&
    std::equal(end.begin(), end.end(), path.end() - static_cast<std::ptrdiff_t>(end.size()),
      [](char small, char c)
      { return c == small || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == small); });
}

/// Where the file name begins.
std::size_t begin_of_name(const std::string& path) noexcept
{
  const std::size_t slash = path.rfind('/');
  return slash == path.npos ? 0 : slash + 1;
}

std::string replace_first(const std::string& path, char mark, const std::string& text)
{
  const std::size_t place = path.find(mark, begin_of_name(path));
  return place == path.npos ? path : path.substr(0, place) + text + path.substr(place + 1);
}
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

bool is_binary_name(std::string_view path) noexcept
{
  if (const Compression compression = compression_of_name(path); compression != Compression::None)
  {
    path.remove_suffix(compression == Compression::Gzip ? 3 : 4);
  }
  return ends_with(path, ".bin") || ends_with(path, ".lammpsbin");
}

Compression compression_of_name(std::string_view path) noexcept
{
  return ends_with(path, ".gz") ? Compression::Gzip
    : ends_with(path, ".zst")   ? Compression::Zstd
                                : Compression::None;
}

bool is_name_of_steps(const std::string& path) noexcept
{
  return path.find('*', begin_of_name(path)) != path.npos;
}

bool is_durable(Durability durability, const std::string& path) noexcept
{
  return durability == Durability::On ||
    (durability == Durability::Automatic && !is_name_of_steps(path));
}

std::string name_of_step(const std::string& path, std::int64_t timestep)
{
  return replace_first(path, '*', std::to_string(timestep));
}

bool is_name_of_ranks(const std::string& path) noexcept
{
  return path.find('%', begin_of_name(path)) != path.npos;
}

std::string name_of_rank(const std::string& path, int rank)
{
  return replace_first(path, '%', std::to_string(rank));
}
}
