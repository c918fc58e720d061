# SPDX-License-Identifier: BSD-3-Clause
# The VTK module, the plugin and the Python package. Included by the top CMakeLists.txt, because
# paraview_plugin_build adds the plugin's folder relative to the top of the source tree.

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

# RemotingCore alone: without COMPONENTS the development files of every third party of every
# ParaView module are looked up (Qt, GDAL, FFmpeg, netCDF, ...), and none of them is used here.
find_package(ParaView 5.11 QUIET COMPONENTS RemotingCore)
if(NOT ParaView_FOUND)
  message(FATAL_ERROR
    "ParaView 5.11 with its development files was not found (Debian: paraview-dev "
    "python3-paraview libopenmpi-dev). Install it, set ParaView_DIR, or build the core alone with "
    "GRANULAR_BUILD_PLUGIN=OFF (preset core-only).\n${ParaView_NOT_FOUND_MESSAGE}")
endif()
if(GRANULAR_BUILD_PYTHON AND NOT VTK_WRAP_PYTHON)
  message(FATAL_ERROR
    "This ParaView was built without Python: set GRANULAR_BUILD_PYTHON=OFF.")
endif()

# What ParaView's views draw with. plugin/views includes none of it, but the targets of the views'
# libraries name it, and its development files need not be there.
foreach(library IN ITEMS Freetype::Freetype GLEW::GLEW X11::X11)
  if(NOT TARGET ${library})
    add_library(${library} INTERFACE IMPORTED)
  endif()
endforeach()

# ---- the VTK module, and those for the server manager and the views, which only the plugin has -----
vtk_module_find_modules(granular_module_files
  "${PROJECT_SOURCE_DIR}/plugin/vtk"
  "${PROJECT_SOURCE_DIR}/plugin/servermanager"
  "${PROJECT_SOURCE_DIR}/plugin/views")
vtk_module_scan(
  MODULE_FILES ${granular_module_files}
  REQUEST_MODULES
    Granular::vtkGranular Granular::vtkGranularServerManager Granular::vtkGranularViews
  PROVIDES_MODULES granular_modules
  REQUIRES_MODULES granular_required_modules
  HIDE_MODULES_FROM_CACHE ON)
foreach(module IN LISTS granular_required_modules)
  if(NOT TARGET ${module})
    message(FATAL_ERROR
      "The module ${module}, which a vtk.module below plugin/ asks for, is not part of the ParaView "
      "in ${ParaView_DIR}. Use a ParaView that was built with it, or set GRANULAR_BUILD_PLUGIN=OFF.")
  endif()
endforeach()
# PACKAGE is not the name of the package of the core: files of the two never share a name.
vtk_module_build(
  MODULES ${granular_modules}
  PACKAGE GranularVTK
  INSTALL_HEADERS OFF
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  HIERARCHY_DESTINATION "${CMAKE_INSTALL_LIBDIR}/vtk/hierarchy/GranularVTK"
  TEST_DIRECTORY_NAME NONE)

# ---- the plugin --------------------------------------------------------------------------------
paraview_plugin_find_plugins(granular_plugin_files "${PROJECT_SOURCE_DIR}/plugin")
paraview_plugin_scan(
  PLUGIN_FILES ${granular_plugin_files}
  PROVIDES_PLUGINS granular_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
# Making the help pages would need Qt's help tools.
paraview_plugin_build(
  PLUGINS ${granular_plugins}
  AUTOLOAD ${granular_plugins}
  PLUGINS_FILE_NAME "granular.plugins.xml"
  INSTALL_HEADERS OFF
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  DISABLE_XML_DOCUMENTATION ON)

# ---- the Python package ------------------------------------------------------------------------
# PYTHONPATH and PV_PLUGIN_PATH of the build tree; the same two folders below the prefix when
# installed.
set(granular_python_folder "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
set(granular_plugin_folder "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")
if(GRANULAR_BUILD_PYTHON)
  add_subdirectory(plugin/python)
endif()

# For whoever starts ParaView on the build tree by hand or from a script: to be sourced by a shell.
file(GENERATE OUTPUT "${CMAKE_BINARY_DIR}/environment" CONTENT
"export PV_PLUGIN_PATH='${CMAKE_BINARY_DIR}/${granular_plugin_folder}'
export PYTHONPATH='${CMAKE_BINARY_DIR}/${granular_python_folder}'
")
