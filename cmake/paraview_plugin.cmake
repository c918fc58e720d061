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
# ParaView's macro would look for the modules beside the folder of all plugins alone.
file(RELATIVE_PATH granular_rpath "/${granular_plugin_folder}/Granular" "/${granular_library_folder}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/${granular_rpath}")
# Versions of ParaView differ in which of their rules name a component.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME plugin)
# Making the help pages would need Qt's help tools.
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
  DISABLE_XML_DOCUMENTATION ON)
