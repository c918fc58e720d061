# SPDX-License-Identifier: BSD-3-Clause
# The VTK module and the Python package, for ParaView or for a VTK of its own. Included by the top
# CMakeLists.txt, because paraview_plugin_build adds the plugin's folder relative to the top of the
# source tree.

# ---- what must be there ------------------------------------------------------------------------
if(GRANULAR_BUILD_PYTHON)
  # Before ParaView looks for a Python of its own: interpreter and headers must be of one version.
  find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
  if(NOT Python3_FOUND)
    message(FATAL_ERROR
      "Python 3 with its headers was not found (Debian: python3-dev). Install it, point "
      "Python3_EXECUTABLE to the Python that ParaView uses, or set GRANULAR_BUILD_PYTHON=OFF.")
  endif()
endif()

# VTK's own CMake code passes empty arguments, as it could before this policy.
set(CMAKE_POLICY_DEFAULT_CMP0174 OLD)
include(cmake/find_vtk.cmake)
set(granular_module_folders "${PROJECT_SOURCE_DIR}/plugin/vtk")
set(granular_module_targets Granular::vtkGranular)
if(GRANULAR_PARAVIEW)
  # RemotingCore alone: without COMPONENTS the development files of every third party of every
  # ParaView module are looked up (Qt, GDAL, FFmpeg, netCDF, ...), and none of them is used here.
  granular_find(ParaView 5.11 RemotingCore
    "install its development files (Debian: paraview-dev python3-paraview libopenmpi-dev), set ParaView_DIR, build \
without ParaView (GRANULAR_PARAVIEW=OFF) or the core alone (GRANULAR_BUILD_PLUGIN=OFF, preset core-only).")
  # Those for the server manager and the views, which only the plugin has.
  list(APPEND granular_module_folders
    "${PROJECT_SOURCE_DIR}/plugin/servermanager"
    "${PROJECT_SOURCE_DIR}/plugin/views")
  list(APPEND granular_module_targets Granular::vtkGranularServerManager Granular::vtkGranularViews)
  include(cmake/reader_options.cmake)
  granular_make_options(xml "${CMAKE_BINARY_DIR}/xml")
  file(GLOB granular_xmls RELATIVE "${PROJECT_SOURCE_DIR}/xml" "${PROJECT_SOURCE_DIR}/xml/*.xml")
  list(TRANSFORM granular_xmls PREPEND "${CMAKE_BINARY_DIR}/xml/")
else()
  # VTK 9.4 and later link an optional module only if it is asked for here.
  granular_find(VTK 9.1
    "CommonCore;CommonDataModel;CommonExecutionModel;CommonMisc;FiltersCore;IOCore;IOGeometry;IOLegacy;IOPLY;IOXML;ParallelCore;OPTIONAL_COMPONENTS;ParallelMPI"
    "install its development files (Debian: libvtk9-dev python3-vtk9), set VTK_DIR, or build the core alone \
(GRANULAR_BUILD_PLUGIN=OFF, preset core-only).")
endif()
set(granular_vtk "VTK ${VTK_VERSION} in ${VTK_DIR}")
if(GRANULAR_PARAVIEW)
  set(granular_vtk "ParaView ${ParaView_VERSION} in ${ParaView_DIR}")
endif()
if(GRANULAR_BUILD_PYTHON AND NOT VTK_WRAP_PYTHON)
  message(FATAL_ERROR "${granular_vtk} was built without Python: use one with Python, or set GRANULAR_BUILD_PYTHON=OFF.")
endif()
if(TARGET VTK::ParallelMPI AND NOT TARGET Granular::mpi)
  message(FATAL_ERROR "${granular_vtk} was built with MPI, and MPI was not found: install its development files "
    "(Debian: libopenmpi-dev).")
elseif(NOT TARGET VTK::ParallelMPI)
  message(STATUS "${granular_vtk} was built without MPI: everything will work on one rank.")
endif()

# ---- the modules -------------------------------------------------------------------------------
vtk_module_find_modules(granular_module_files ${granular_module_folders})
vtk_module_scan(
  MODULE_FILES ${granular_module_files}
  REQUEST_MODULES ${granular_module_targets}
  PROVIDES_MODULES granular_modules
  REQUIRES_MODULES granular_required_modules
  HIDE_MODULES_FROM_CACHE ON)
foreach(module IN LISTS granular_required_modules)
  if(NOT TARGET ${module})
    message(FATAL_ERROR
      "The module ${module}, which a vtk.module below plugin/ asks for, is not part of the VTK "
      "in ${VTK_DIR}. Use one that was built with it, or set GRANULAR_BUILD_PLUGIN=OFF.")
  endif()
endforeach()
# Libraries without a version are private ones to Debian, which keeps them out of the linker's folder.
set(granular_library_folder "${CMAKE_INSTALL_LIBDIR}")
if(GRANULAR_DEB)
  string(APPEND granular_library_folder "/granular")
endif()
# PACKAGE is not the name of the package of the core: files of the two never share a name.
vtk_module_build(
  MODULES ${granular_modules}
  PACKAGE GranularVTK
  INSTALL_HEADERS OFF
  LIBRARY_DESTINATION "${granular_library_folder}"
  TARGETS_COMPONENT plugin
  HIERARCHY_DESTINATION "${CMAKE_INSTALL_LIBDIR}/vtk/hierarchy/GranularVTK"
  TEST_DIRECTORY_NAME NONE)

if(GRANULAR_PARAVIEW)
  include(cmake/paraview_plugin.cmake)
endif()

# ---- the compiled classes in the Python package ------------------------------------------------
if(GRANULAR_BUILD_PYTHON)
  add_subdirectory(plugin/python)
endif()

if(GRANULAR_PARAVIEW)
  set(granular_environment
    "export PV_PLUGIN_PATH='${CMAKE_BINARY_DIR}/${granular_plugin_folder}'\"\${PV_PLUGIN_PATH:+:\$PV_PLUGIN_PATH}\"\n")
endif()
