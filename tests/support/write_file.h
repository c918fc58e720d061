// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_write_file_h
#define granular_tests_support_write_file_h

#include "granular/bytes/byte_sink.h"

#include <string>
#include <string_view>

/// Writes a file as a whole, as the writers do. durable: as Durability::On.
inline void write_file(const std::string& path, std::string_view bytes, bool durable = true)
{
  granular::NewFile file(path);
  file.write_at(0, bytes);
  file.finish(durable);
}
#endif
