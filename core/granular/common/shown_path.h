// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_shown_path_h
#define granular_common_shown_path_h

#include <string>
#include <string_view>

namespace granular
{
/// Returns a file name, or a text with words of a user, for a message. It is on one line and in UTF-8: control characters become
/// \n, \t or \x1b, and bytes that are not UTF-8 become \xff.
std::string shown_path(std::string_view path);
}
#endif
