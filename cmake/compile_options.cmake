# SPDX-License-Identifier: BSD-3-Clause
# Options for rounding, for warnings per layer, and sanitizers.

set(granular_warnings_vtk -Wall -Wextra)
set(granular_warnings_core -Wall -Wextra)
if(GRANULAR_STRICT)
  # VTK's headers are included as system headers, but its macros expand in our files: conversions
  # in them are not ours to mend, so the VTK layer has the shorter list.
  list(APPEND granular_warnings_vtk -Werror)
  list(APPEND granular_warnings_core
    -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms of GCC 12 in its own header: "literal" + std::string, from C++20 on.
  set(granular_false_alarms -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
  list(APPEND granular_warnings_vtk ${granular_false_alarms})
  list(APPEND granular_warnings_core ${granular_false_alarms})
endif()

# granular_warnings(target core|vtk)
function(granular_warnings target layer)
  target_compile_options(${target} PRIVATE
    "$<$<COMPILE_LANGUAGE:CXX>:${granular_warnings_${layer}}>")
endfunction()

# granular_standard_headers(target header...)
#   Headers that most files of a target include, compiled once. Each file still includes what it needs: the preset core-only and
#   clang-tidy do without.
function(granular_standard_headers target)
  if(GRANULAR_PCH)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <cstring> <functional> <limits> <map>
      <memory> <numeric> <optional> <span> <string> <string_view> <utility> <vector> ${ARGN})
  endif()
endfunction()

# Results are the same on all machines: the compiler must not join a product and a sum into one
# rounding where the processor could. std::fma is written where that is wanted. Plugin and tests
# compile inline functions of the core, so the option is for all.
add_compile_options("$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>")
# Nobody asks which floating-point exceptions were raised. While GCC keeps them, it leaves branches in loops that vector
# instructions could do; the values are the same.
add_compile_options("$<$<CXX_COMPILER_ID:GNU>:-fno-trapping-math>")

if(GRANULAR_SANITIZE)
  add_compile_options(
    -fsanitize=${GRANULAR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  add_link_options(-fsanitize=${GRANULAR_SANITIZE})
endif()

if(GRANULAR_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR
      "GRANULAR_FUZZ needs clang (Debian: clang), found ${CMAKE_CXX_COMPILER_ID}: configure in an "
      "empty folder with CMAKE_CXX_COMPILER=clang++, or use the preset fuzz.")
  endif()
  # Coverage counters everywhere; libFuzzer's main only in the fuzz targets.
  add_compile_options(-fsanitize=fuzzer-no-link -g)
endif()
