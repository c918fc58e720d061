# SPDX-License-Identifier: BSD-3-Clause
# cmake -DBUILD=folder -DPREFIX=folder -DOLD=folder -P install.cmake
#   Installs from BUILD to PREFIX; nothing of an earlier run is left there or in
#   the folders OLD.
file(REMOVE_RECURSE "${PREFIX}" ${OLD})
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}"
  COMMAND_ERROR_IS_FATAL ANY)
