// SPDX-License-Identifier: BSD-3-Clause
// Private to the files of this room that are for Windows: names for the system, in UTF-16, and its errors.
#ifndef granular_bytes_names_windows_h
#define granular_bytes_names_windows_h

#include <string>
#include <string_view>

namespace granular::os
{
/// Sets errno to what the system's last error means. Returns -1.
int fail() noexcept;

/// Returns the whole name as the system takes it, which wants a mark before long ones; empty: it is not UTF-8, or there is no memory.
std::wstring system_name(const std::string& name) noexcept;

/// Returns the text in UTF-8, with slashes.
std::string narrow(std::wstring_view text);
}
#endif
