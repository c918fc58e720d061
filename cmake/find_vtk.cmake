# SPDX-License-Identifier: BSD-3-Clause
# Finds VTK or ParaView, in spite of what their packages get wrong or leave out.

# granular_find(package minimum components install)
#   find_package(package minimum COMPONENTS components), with a message of one line where that cannot
#   be: what was found, what is wanted, and what to do about it.
macro(granular_find package minimum components install)
  if("${${package}_DIR}" MATCHES "^${CMAKE_BINARY_DIR}/mended/")
    unset(${package}_DIR CACHE) # left there by a configuration that failed
  endif()
  # No version fits 9999: CMake says what there is, and reads none of it.
  find_package(${package} 9999 QUIET CONFIG)
  set(granular_found "none was found")
  set(granular_folder)
  foreach(config version IN ZIP_LISTS ${package}_CONSIDERED_CONFIGS ${package}_CONSIDERED_VERSIONS)
    if(NOT granular_folder AND version VERSION_GREATER_EQUAL "${minimum}")
      get_filename_component(granular_folder "${config}" DIRECTORY)
    elseif(NOT granular_folder)
      set(granular_found "found ${version} in ${config}")
    endif()
  endforeach()
  if(NOT granular_folder)
    message(FATAL_ERROR "${package} ${minimum} or later is needed, ${granular_found}: ${install}")
  endif()

  granular_mended_package("${granular_folder}" granular_mended)
  set(${package}_DIR "${granular_mended}" CACHE PATH "Folder of ${package}'s CMake package" FORCE)
  find_package(${package} ${minimum} QUIET CONFIG COMPONENTS ${components})
  # The next time it is the original again that is looked at.
  set(${package}_DIR "${granular_folder}" CACHE PATH "Folder of ${package}'s CMake package" FORCE)
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "${package} ${${package}_VERSION} in ${granular_folder} cannot be used: "
      "${${package}_NOT_FOUND_MESSAGE} ${install}")
  endif()
  granular_make_stand_ins()
endmacro()

# granular_mended_package(folder result)
#   The folder of a CMake package, or a copy below the build folder where the package names compiled
#   Python modules by names that they do not have: Debian 13 and later install
#   NAME.cpython-313-x86_64-linux-gnu.so and list NAME.so, at which CMake stops.
function(granular_mended_package folder result)
  string(REGEX REPLACE "/lib(64)?/.*" "" prefix "${folder}")
  set(wrong)
  set(right)
  file(GLOB_RECURSE lists "${folder}/*Python*-targets-*.cmake")
  foreach(list IN LISTS lists)
    file(READ "${list}" text)
    string(REGEX MATCHALL "{_IMPORT_PREFIX}/[^\"]*\\.so\"" modules "${text}")
    list(REMOVE_DUPLICATES modules)
    foreach(module IN LISTS modules)
      string(REGEX REPLACE "^{_IMPORT_PREFIX}(.*)\\.so\"$" "${prefix}\\1" path "${module}")
      file(GLOB there RELATIVE "${prefix}" "${path}.*.so")
      if(there AND NOT EXISTS "${path}.so")
        list(APPEND wrong "${module}")
        list(APPEND right "{_IMPORT_PREFIX}/${there}\"")
      endif()
    endforeach()
  endforeach()
  if(NOT wrong)
    set(${result} "${folder}" PARENT_SCOPE)
    return()
  endif()

  # Files of a package find each other beside them, and the rest of the system from where they are: the
  # copy looks from the place of the original.
  get_filename_component(name "${folder}" NAME)
  set(copy "${CMAKE_BINARY_DIR}/mended/${name}")
  file(REMOVE_RECURSE "${copy}")
  file(COPY "${folder}/" DESTINATION "${copy}")
  file(GLOB_RECURSE files RELATIVE "${folder}" "${folder}/*.cmake")
  foreach(file IN LISTS files)
    file(READ "${folder}/${file}" text)
    set(mended "${text}")
    get_filename_component(here "${folder}/${file}" DIRECTORY)
    foreach(prefix IN ITEMS _IMPORT_PREFIX _vtk_module_import_prefix PACKAGE_PREFIX_DIR)
      string(REPLACE "${prefix} \"\${CMAKE_CURRENT_LIST_FILE}" "${prefix} \"${folder}/${file}" mended "${mended}")
      string(REPLACE "${prefix} \"\${CMAKE_CURRENT_LIST_DIR}" "${prefix} \"${here}" mended "${mended}")
    endforeach()
    if(file MATCHES "Python.*-targets-")
      foreach(from to IN ZIP_LISTS wrong right)
        string(REPLACE "${from}" "${to}" mended "${mended}")
      endforeach()
    endif()
    if(NOT mended STREQUAL text)
      file(WRITE "${copy}/${file}" "${mended}")
    endif()
  endforeach()
  set(${result} "${copy}" PARENT_SCOPE)
endfunction()

# granular_make_stand_ins()
#   Libraries of VTK and ParaView name the targets of third parties that they were linked with. CMake
#   wants each of them to exist, though nothing here includes them and the shared libraries bring what
#   they need: an empty target stands in for one whose development files are not there.
function(granular_make_stand_ins)
  get_property(targets DIRECTORY "${PROJECT_SOURCE_DIR}" PROPERTY IMPORTED_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
    string(REGEX MATCHALL "[A-Za-z0-9_.+-]+::[A-Za-z0-9_.+:-]+" names "${libraries}")
    foreach(name IN LISTS names)
      if(NOT TARGET ${name})
        add_library(${name} INTERFACE IMPORTED)
      endif()
    endforeach()
  endforeach()
endfunction()
