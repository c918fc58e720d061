# SPDX-License-Identifier: BSD-3-Clause
# Toolchain file for Windows: Debian's clang and lld, with the headers and libraries of MinGW, zlib, Zstandard and ISA-L in a folder that
# packaging/windows makes. MinGW's own GCC does not align the stack for AVX: its bug 54412.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_SYSROOT "${CMAKE_CURRENT_LIST_DIR}/../build/windows_sysroot")
set(CMAKE_FIND_ROOT_PATH "${CMAKE_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()

set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
foreach(tool IN ITEMS AR RANLIB STRIP)
  string(TOLOWER ${tool} name)
  set(CMAKE_${tool} x86_64-w64-mingw32-${name} CACHE STRING "")
endforeach()
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
foreach(language IN ITEMS C CXX)
  set(CMAKE_${language}_COMPILER_TARGET x86_64-w64-windows-gnu)
  set(CMAKE_${language}_STANDARD_LIBRARIES "-lstdc++ -lwinpthread -lkernel32") # static: a library of its own needs no other
endforeach()
add_compile_definitions(_WIN32_WINNT=0x0A00) # Windows 10
foreach(kind IN ITEMS EXE SHARED)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-fuse-ld=lld -static")
endforeach()
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
