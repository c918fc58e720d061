// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/dump_format.h"

namespace granular
{
bool is_binary_name(std::string_view path) noexcept
{
  if (const Compression compression = compression_of_name(path); compression != Compression::None)
  {
    path.remove_suffix(compression == Compression::Gzip ? 3 : 4);
  }
  return path.ends_with(".bin") || path.ends_with(".lammpsbin");
}

Compression compression_of_name(std::string_view path) noexcept
{
  return path.ends_with(".gz") ? Compression::Gzip
    : path.ends_with(".zst")   ? Compression::Zstd
                               : Compression::None;
}
}
