# SPDX-License-Identifier: BSD-3-Clause
# cmake -DBUILD=folder -DPREFIX=folder -DOLD=folder -P install.cmake
#   Installs from BUILD, and moves the tree to PREFIX; nothing of an earlier run is
#   left there or in the folders OLD.
set(first "${PREFIX} at first")
file(REMOVE_RECURSE "${PREFIX}" "${first}" ${OLD})
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${first}"
  COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${first}" "${PREFIX}")
