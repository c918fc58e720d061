// SPDX-License-Identifier: BSD-3-Clause
// A file of dump decomposition/vtk from memory, in VTK's legacy format.
#include "decomposition_checks.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  granular::fuzz::check_subdomain_file({ reinterpret_cast<const char*>(data), size });
  return 0;
}
