# SPDX-License-Identifier: BSD-3-Clause
# What is made of the table of options of readers when CMake configures: see reader_options.py.
find_package(Python3 3.11 QUIET COMPONENTS Interpreter)
if(NOT Python3_Interpreter_FOUND)
  message(FATAL_ERROR "Python 3.11 or later was not found, which makes the options of the readers (Debian: python3). Install it, or build "
    "the core alone (GRANULAR_BUILD_PLUGIN=OFF, GRANULAR_BUILD_PYTHON=OFF).")
endif()

# granular_make_options(what to): the expanded files of the server manager (xml) in a folder, or the tables of the package (python) as a file
function(granular_make_options what to)
  file(GLOB depends CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/xml/*.xml" "${PROJECT_SOURCE_DIR}/xml/shared/*.xml")
  set(script "${PROJECT_SOURCE_DIR}/cmake/reader_options.py")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${depends} "${script}" "${PROJECT_SOURCE_DIR}/core/granular/runs/options.toml")
  execute_process(COMMAND ${Python3_EXECUTABLE} -B "${script}" "${PROJECT_SOURCE_DIR}" ${what} "${to}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()
