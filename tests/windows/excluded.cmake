# SPDX-License-Identifier: BSD-3-Clause
# Tests of the core that Windows does without, each with the reason.

# faults: calls of libc are taken away, and processes killed; consumer: installs for Linux; fuzz, common: their programs compare compilers
# and instruction sets, and compile the core again.
set(granular_posix_folders faults/CMakeLists.txt consumer/CMakeLists.txt fuzz/CMakeLists.txt common/CMakeLists.txt)

set(granular_posix_tests
  byte_sink locked_file # fork, owners, permissions, limits of a process: tests/windows/files.cpp has what Windows has of that
  growing_run index_threads # fork; files that a process may open
  large_file binary_large # files with holes
  c_misuse) # a thread that ends by pthread_exit

set(granular_posix_cases)
