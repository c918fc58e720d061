# SPDX-License-Identifier: BSD-3-Clause
# The ParaView plugin, from the modules of vtk_layer.cmake.

# PV_PLUGIN_PATH of the build tree, and below the prefix when installed.
set(granular_plugin_folder "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")

paraview_plugin_find_plugins(granular_plugin_files "${PROJECT_SOURCE_DIR}/plugin")
paraview_plugin_scan(
  PLUGIN_FILES ${granular_plugin_files}
  PROVIDES_PLUGINS granular_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)

# ---- the help pages ----------------------------------------------------------------------------
# ParaView would make them with Qt's help tools and an XSLT processor, hundreds of megabytes of packages. Both of its
# functions are replaced, and Python does it.
find_package(Python3 QUIET COMPONENTS Interpreter)
set(granular_no_help ON)
if(Python3_Interpreter_FOUND)
  execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import sqlite3, xml.etree.ElementTree, zlib"
    RESULT_VARIABLE granular_no_help ERROR_QUIET)
endif()
if(granular_no_help)
  message(STATUS "The '?' of ParaView's panels will open no help: Python 3 with sqlite3 was not found (Debian: python3).")
  set(granular_no_help ON)
else()
  set(granular_no_help OFF)
  function(paraview_client_documentation)
  endfunction()
  function(paraview_client_generate_help)
    cmake_parse_arguments(PARSE_ARGV 0 help "" "NAME;TARGET;OUTPUT_DIR;OUTPUT_PATH" "")
    set(pages "${help_OUTPUT_DIR}/${help_NAME}.qch")
    set(script "${PROJECT_SOURCE_DIR}/cmake/help_pages.py")
    file(MAKE_DIRECTORY "${help_OUTPUT_DIR}")
    add_custom_command(OUTPUT "${pages}"
      COMMAND "${Python3_EXECUTABLE}" -B "${script}" "${pages}" ${granular_xmls}
      DEPENDS "${script}" ${granular_xmls}
      COMMENT "Making the help pages"
      VERBATIM)
    add_custom_target(${help_TARGET} DEPENDS "${pages}")
    set(${help_OUTPUT_PATH} "${pages}" PARENT_SCOPE)
  endfunction()
  # ParaView 5.13 makes no pages where Qt is 6. This plugin has nothing else that needs to know. (The window of 5.13
  # with Qt 6 shows no pages at all, ParaView's own neither: its collection of pages is read-only. In 6.1 it is not.)
  if(DEFINED PARAVIEW_QT_MAJOR_VERSION)
    set(PARAVIEW_QT_MAJOR_VERSION 5)
  endif()
endif()

# ---- the plugin itself ------------------------------------------------------------------------
# ParaView's macro would look for the modules beside the folder of all plugins alone.
file(RELATIVE_PATH granular_rpath "/${granular_plugin_folder}/Granular" "/${granular_library_folder}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${granular_rpath}")
# Versions of ParaView differ in which of their rules name a component.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME plugin)
paraview_plugin_build(
  PLUGINS ${granular_plugins}
  AUTOLOAD ${granular_plugins}
  PLUGINS_FILE_NAME "granular.plugins.xml"
  INSTALL_HEADERS OFF
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  ADD_INSTALL_RPATHS OFF
  PLUGINS_COMPONENT plugin
  TARGET_COMPONENT plugin
  DISABLE_XML_DOCUMENTATION ${granular_no_help})
