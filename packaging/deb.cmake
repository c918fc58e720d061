# SPDX-License-Identifier: BSD-3-Clause
# Settings of `cpack -G DEB`, and files that only packages hold. Packages are for the Debian that runs this; each is a
# component of the install rules:
#
#   c                libgranular0               the C library
#   bonds            libgranular-bonds0         bonded particles for simulation codes
#   python           python3-vtkgranular           the Python package, which needs numpy alone
#   command          granular                   the command
#   plugin           granular-paraview          the ParaView plugin, loaded by ParaView's programs when they start
#   paraview_python  python3-vtkgranular-paraview  the compiled classes of the Python package
#   dev              libgranular-dev            headers of C and C++, and the core, for find_package(Granular)
if(NOT GRANULAR_PARAVIEW OR NOT GRANULAR_BUILD_PLUGIN OR NOT GRANULAR_BUILD_PYTHON)
  message(FATAL_ERROR "GRANULAR_DEB is for all of this project: GRANULAR_BUILD_PLUGIN, GRANULAR_PARAVIEW and "
    "GRANULAR_BUILD_PYTHON must be ON.")
endif()

# ---- the version -------------------------------------------------------------------------------
# Packages for a release sort before packages for the next one, and before packages for unstable.
file(STRINGS /etc/os-release granular_os_release)
set(granular_release 1)
set(granular_suite unstable)
if(granular_os_release MATCHES "VERSION_ID=\"?([0-9.]+)")
  set(granular_release "1~deb${CMAKE_MATCH_1}")
  string(REGEX MATCH "VERSION_CODENAME=([a-z]+)" granular_suite "${granular_os_release}")
  set(granular_suite "${CMAKE_MATCH_1}")
endif()
set(granular_version "${PROJECT_VERSION}-${granular_release}")

# Debian's own variables for whoever makes a package.
set(granular_maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if(NOT DEFINED ENV{DEBFULLNAME} OR NOT DEFINED ENV{DEBEMAIL})
  set(granular_maintainer "vtk-granular authors <authors@vtk-granular.invalid>")
endif()

# ---- ParaView loads the plugin -----------------------------------------------------------------
# When they start, ParaView's programs read the file paraview.conf, a list of paths, and then the XML file at each
# path, which says which plugins to load. Debian 13 and later keep paraview.conf in ParaView's library folder. It lists a
# path that belongs to no package; our XML file goes there. ParaView of Debian 12 comes without a paraview.conf and looks
# for it beside its programs; our own goes there.
get_filename_component(granular_conf "/usr/${granular_plugin_folder}" DIRECTORY)
string(APPEND granular_conf "/paraview.conf")
if(EXISTS "${granular_conf}")
  file(STRINGS "${granular_conf}" granular_list REGEX "^/usr/" LIMIT_COUNT 1)
  if(NOT granular_list)
    message(FATAL_ERROR "${granular_conf} names no file for the plugins of other packages.")
  endif()
  file(RELATIVE_PATH granular_list /usr "${granular_list}")
  get_filename_component(granular_list_folder "${granular_list}" DIRECTORY)
  get_filename_component(granular_list_name "${granular_list}" NAME)
  file(WRITE "${PROJECT_BINARY_DIR}/packaging/plugins.xml" "<?xml version=\"1.0\"?>
<Plugins>
  <Plugin name=\"Granular\" filename=\"/usr/${granular_plugin_folder}/Granular/Granular.so\" auto_load=\"1\"/>
</Plugins>
")
  install(FILES "${PROJECT_BINARY_DIR}/packaging/plugins.xml" DESTINATION "${granular_list_folder}"
    RENAME "${granular_list_name}" COMPONENT plugin)
else()
  file(WRITE "${PROJECT_BINARY_DIR}/packaging/paraview.conf" "/usr/${granular_plugin_folder}/granular.plugins.xml\n")
  install(FILES "${PROJECT_BINARY_DIR}/packaging/paraview.conf" DESTINATION bin COMPONENT plugin)
endif()

# ---- what every package of Debian has ----------------------------------------------------------
# -n: without names and times, the same content gives the same bytes.
string(TIMESTAMP granular_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${PROJECT_BINARY_DIR}/packaging/changelog" "granular (${granular_version}) ${granular_suite}; urgency=medium

  * Made from the sources; changelog.gz says what is new.

 -- ${granular_maintainer}  ${granular_date}
")
execute_process(COMMAND gzip -9nc "${PROJECT_BINARY_DIR}/packaging/changelog"
  OUTPUT_FILE "${PROJECT_BINARY_DIR}/packaging/changelog.Debian.gz" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip -9nc "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  OUTPUT_FILE "${PROJECT_BINARY_DIR}/packaging/changelog.gz" COMMAND_ERROR_IS_FATAL ANY)
set(granular_components c bonds python command plugin paraview_python dev)
set(granular_libraries libgranular libgranular_bonds)
set(granular_packages
  libgranular${PROJECT_VERSION_MAJOR} libgranular-bonds${PROJECT_VERSION_MAJOR} python3-vtkgranular granular granular-paraview
  python3-vtkgranular-paraview libgranular-dev)
foreach(component package IN ZIP_LISTS granular_components granular_packages)
  install(FILES
    "${PROJECT_BINARY_DIR}/packaging/changelog.Debian.gz"
    "${PROJECT_BINARY_DIR}/packaging/changelog.gz"
    DESTINATION "share/doc/${package}" COMPONENT ${component})
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "share/doc/${package}"
    RENAME copyright COMPONENT ${component})
  string(TOUPPER "${component}" name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME "${package}")
endforeach()

# ---- the packages ------------------------------------------------------------------------------
set(CPACK_GENERATOR DEB)
set(CPACK_OUTPUT_FILE_PREFIX "${PROJECT_SOURCE_DIR}/build/packages")
set(CPACK_PACKAGE_NAME granular)
set(CPACK_PACKAGE_CONTACT "${granular_maintainer}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # else it comes before the first line of each description
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL ${granular_components})
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
execute_process(COMMAND dpkg --print-architecture
  OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_ARCHITECTURE OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
# All begin alike, so that `apt install ./granular_*.deb` installs them together: CPack adds -COMPONENT.deb.
set(CPACK_PACKAGE_FILE_NAME "granular_${granular_version}_${CPACK_DEBIAN_PACKAGE_ARCHITECTURE}")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_DEBIAN_PACKAGE_RELEASE "${granular_release}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SOURCE granular)

# What programs that are linked to a library depend on, and when ldconfig runs.
file(WRITE "${PROJECT_BINARY_DIR}/packaging/triggers" "activate-noawait ldconfig\n")
foreach(component library package IN ZIP_LISTS granular_components granular_libraries granular_packages)
  if(library)
    file(WRITE "${PROJECT_BINARY_DIR}/packaging/${component}/shlibs"
      "${library} ${PROJECT_VERSION_MAJOR} ${package} (>= ${PROJECT_VERSION})\n")
    string(TOUPPER "${component}" name)
    set(CPACK_DEBIAN_${name}_PACKAGE_SECTION libs)
    set(CPACK_DEBIAN_${name}_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_${name}_PACKAGE_CONTROL_EXTRA
      "${PROJECT_BINARY_DIR}/packaging/${component}/shlibs" "${PROJECT_BINARY_DIR}/packaging/triggers")
  endif()
endforeach()
set(CPACK_DEBIAN_C_DESCRIPTION "files of discrete-element simulations as arrays (library)
Reads and writes the files of LIGGGHTS and LAMMPS by functions for C,
C++ and Fortran: dumps of particles, contacts, bonds, subdomains and Euler
cells, restart and data files.")
set(CPACK_DEBIAN_BONDS_DESCRIPTION "bonded particles of discrete-element simulations (library)
Stores bonded particles as the atom style bond/gran of LIGGGHTS' forks, and
packs them for other ranks and for restart files, by functions for C, C++ and
Fortran.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "libgranular${PROJECT_VERSION_MAJOR} (= ${granular_version})" "python3 (>= 3.9~)" "python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-vtkgranular-paraview")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/packaging/python/postinst" "${PROJECT_SOURCE_DIR}/packaging/python/prerm")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "files of discrete-element simulations as arrays (Python 3)
The package vtkgranular: runs and frames of LIGGGHTS and LAMMPS as numpy
arrays, arrays as dumps, and functions for scripts of ParaView.")

set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "python3, python3-vtkgranular (= ${granular_version})")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "python3-vtk9 | python3-paraview, xauth, xvfb")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "looks into files of discrete-element simulations, and converts them
The command granular says what dumps, restart and data files of LIGGGHTS
and LAMMPS hold, whether they are sound, and converts them into other
forms; it prints statistics and draws pictures.")

# A plugin loads only in the series of ParaView that it was built for. dpkg-shlibdeps adds the libraries; Debian's ParaView
# narrows its own version further.
math(EXPR granular_next "${ParaView_VERSION_MINOR} + 1")
set(granular_series "${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}")
set(granular_after "${ParaView_VERSION_MAJOR}.${granular_next}~")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS "paraview (>= ${granular_series}), paraview (<< ${granular_after})")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_SUGGESTS "python3-vtkgranular-paraview")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_ENHANCES "paraview")
set(CPACK_DEBIAN_PLUGIN_DESCRIPTION "discrete-element data in ParaView
Opens and writes the files of discrete-element simulations by LIGGGHTS and
LAMMPS: dumps of particles, contacts, bonds, subdomains and Euler cells,
restart and data files.

ParaView ${granular_series} loads this plugin whenever it starts.")

math(EXPR granular_next "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PARAVIEW_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PARAVIEW_PYTHON_PACKAGE_SHLIBDEPS ON)
# libvtkGranular.so is in another package.
set(CPACK_DEBIAN_PARAVIEW_PYTHON_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
string(JOIN ", " CPACK_DEBIAN_PARAVIEW_PYTHON_PACKAGE_DEPENDS
  "granular-paraview (= ${granular_version})" "python3-vtkgranular (= ${granular_version})"
  "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}~)"
  "python3 (<< ${Python3_VERSION_MAJOR}.${granular_next})"
  "python3-paraview (>= ${granular_series})" "python3-paraview (<< ${granular_after})")
set(CPACK_DEBIAN_PARAVIEW_PYTHON_DESCRIPTION "discrete-element data in VTK and ParaView (Python 3)
The compiled part of the package vtkgranular: readers, writers and filters for
the files of LIGGGHTS and LAMMPS as VTK classes.")

set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "libgranular${PROJECT_VERSION_MAJOR} (= ${granular_version})" "libgranular-bonds${PROJECT_VERSION_MAJOR} (= ${granular_version})"
  "libzstd-dev" "zlib1g-dev")
if(GRANULAR_ISAL AND GRANULAR_ISAL_LIBRARY)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libisal-dev")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libopenmpi-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "discrete-element data for programs (development files)
The headers of libgranular and libgranular_bonds, for C, C++ and Fortran, and the core of
vtk-granular, a static C++ library without VTK: reads and writes the files of
LIGGGHTS and LAMMPS, on one process or, with MPI, on many.

CMake's find_package(Granular) finds all, pkg-config the libraries for C.")

include(CPack)
