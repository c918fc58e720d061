// SPDX-License-Identifier: BSD-3-Clause
#include "granular/writing/file_names.h"

#include "granular/common/error.h"

#include <algorithm>

namespace granular
{
namespace
{
/// Returns true if a name ends so, in capitals or not. The end is in small letters.
bool ends_with(std::string_view path, std::string_view end) noexcept
{
  return path.size() >= end.size() &&
    std::equal(end.begin(), end.end(), path.end() - static_cast<std::ptrdiff_t>(end.size()),
      [](char small, char c)
      { return c == small || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == small); });
}

/// Returns the place where the file name begins.
std::size_t begin_of_name(const std::string& path) noexcept
{
  return path.rfind('/') + 1; // 0 without a slash
}

std::string replace_first(const std::string& path, char mark, const std::string& text)
{
  const std::size_t place = path.find(mark, begin_of_name(path));
  return place == path.npos ? path : path.substr(0, place) + text + path.substr(place + 1);
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

std::string name_of_new_step(
  const std::string& path, std::int64_t timestep, std::set<std::int64_t>& written)
{
  std::string name = name_of_step(path, timestep);
  if (!written.insert(timestep).second)
  {
    throw Error("expected a timestep of its own for each frame, got timestep " +
        std::to_string(timestep) + " again",
      { name });
  }
  return name;
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
