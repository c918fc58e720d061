// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_byte_sink_h
#define granular_base_byte_sink_h

#include <string>
#include <string_view>

namespace granular
{
/// Writes a file whole or not at all: the bytes go into a new file in the same folder, which then
/// takes the place of the old one. A reader sees the old content or the new one; if this fails, the
/// old file is as it was. Throws IoError.
void write_file(const std::string& path, std::string_view bytes);
}
#endif
