# SPDX-License-Identifier: BSD-3-Clause
"""find_vtk.py cmake generator make find_vtk.cmake: packages of ParaView that are not there, too old, or wrong in the way of Debian's."""
import os
import subprocess
import sys
import tempfile

PROJECT = """
cmake_minimum_required(VERSION 3.20)
project(Finding LANGUAGES NONE)
include("{find_vtk}")
granular_find(ParaView 5.11 "RemotingCore" "install paraview-dev.")
get_target_property(location ParaView::ServerPython IMPORTED_LOCATION_NONE)
message(STATUS "module ${{location}}")
get_target_property(header ParaView::Server HEADER)
message(STATUS "header ${{header}}")
if(NOT TARGET Far::Away OR NOT TARGET Linked::Only)
  message(FATAL_ERROR "no stand-ins")
endif()
message(STATUS "ParaView_DIR ${{ParaView_DIR}}")
"""
# What CMake and VTK write, in short.
CONFIG = """
set(ParaView_FOUND {found})
set(ParaView_NOT_FOUND_MESSAGE "RemotingCore lacks MPI.")
include("${{CMAKE_CURRENT_LIST_DIR}}/ParaViewPython-targets.cmake")
include("${{CMAKE_CURRENT_LIST_DIR}}/vtk/properties.cmake")
"""
VERSION = """
set(PACKAGE_VERSION "{version}")
if(NOT PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
"""
TARGETS = """
get_filename_component(_IMPORT_PREFIX "${CMAKE_CURRENT_LIST_FILE}" PATH)
get_filename_component(_IMPORT_PREFIX "${_IMPORT_PREFIX}" PATH)
get_filename_component(_IMPORT_PREFIX "${_IMPORT_PREFIX}" PATH)
get_filename_component(_IMPORT_PREFIX "${_IMPORT_PREFIX}" PATH)
add_library(ParaView::ServerPython MODULE IMPORTED)
add_library(ParaView::Server SHARED IMPORTED)
set_target_properties(ParaView::Server PROPERTIES
  INTERFACE_LINK_LIBRARIES "ParaView::ServerPython;Far::Away;$<LINK_ONLY:Linked::Only>")
include("${CMAKE_CURRENT_LIST_DIR}/ParaViewPython-targets-none.cmake")
"""
MODULES = """
set_target_properties(ParaView::ServerPython PROPERTIES
  IMPORTED_LOCATION_NONE "${_IMPORT_PREFIX}/lib/python3/server.so")
if(NOT EXISTS "${_IMPORT_PREFIX}/lib/python3/server.so")
  message(FATAL_ERROR "references a file that does not exist")
endif()
"""
PROPERTIES = """
set(_vtk_module_import_prefix "${CMAKE_CURRENT_LIST_DIR}")
get_filename_component(_vtk_module_import_prefix "${_vtk_module_import_prefix}" DIRECTORY)
get_filename_component(_vtk_module_import_prefix "${_vtk_module_import_prefix}" DIRECTORY)
get_filename_component(_vtk_module_import_prefix "${_vtk_module_import_prefix}" DIRECTORY)
get_filename_component(_vtk_module_import_prefix "${_vtk_module_import_prefix}" DIRECTORY)
set_property(TARGET ParaView::Server PROPERTY HEADER "${_vtk_module_import_prefix}/include/server.h")
"""
cmake, generator, make, find_vtk = sys.argv[1:]


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def package(prefix, version, module, found="TRUE"):
    """A ParaView below prefix/lib/cmake whose Python module has the file name `module`."""
    folder = f"{prefix}/lib/cmake/paraview-{version}"
    write(f"{folder}/paraview-config.cmake", CONFIG.format(found=found))
    write(f"{folder}/paraview-config-version.cmake", VERSION.format(version=version))
    write(f"{folder}/ParaViewPython-targets.cmake", TARGETS)
    write(f"{folder}/ParaViewPython-targets-none.cmake", MODULES)
    write(f"{folder}/vtk/properties.cmake", PROPERTIES)
    write(f"{prefix}/lib/python3/{module}", "")
    return folder


def configure(folder, *options):
    """Returns the exit status of CMake, and what it said on one line."""
    write(f"{folder}/CMakeLists.txt", PROJECT.format(find_vtk=find_vtk))
    # nothing of this machine
    hidden = [f"-DCMAKE_FIND_USE_{place}=OFF" for place in (
        "PACKAGE_ROOT_PATH", "CMAKE_ENVIRONMENT_PATH", "SYSTEM_ENVIRONMENT_PATH", "CMAKE_SYSTEM_PATH", "INSTALL_PREFIX",
        "PACKAGE_REGISTRY", "SYSTEM_PACKAGE_REGISTRY")]
    done = subprocess.run([cmake, "-G", generator, f"-DCMAKE_MAKE_PROGRAM={make}", "-S", folder, "-B", f"{folder}/build", *hidden,
                           *options], capture_output=True, text=True)
    return done.returncode, " ".join((done.stdout + done.stderr).split())


def expect(text, said):
    assert text in said, f"expected '{text}' in: {said}"


with tempfile.TemporaryDirectory() as top:
    top = os.path.realpath(top)

    status, said = configure(f"{top}/none")
    assert status != 0
    expect("ParaView 5.11 or later is needed, none was found: install paraview-dev.", said)

    package(f"{top}/old/usr", "5.9.1", "server.so")
    status, said = configure(f"{top}/old", f"-DCMAKE_PREFIX_PATH={top}/old/usr")
    assert status != 0
    expect(f"ParaView 5.11 or later is needed, found 5.9.1 in {top}/old/usr", said)

    package(f"{top}/broken/usr", "5.13.2", "server.so", found="FALSE")
    status, said = configure(f"{top}/broken", f"-DCMAKE_PREFIX_PATH={top}/broken/usr")
    assert status != 0
    expect("cannot be used: RemotingCore lacks MPI. install paraview-dev.", said)

    # as it should be, and as Debian 13 has it; the second time from the cache
    for name, module in (("right", "server.so"), ("wrong", "server.cpython-313-x86_64-linux-gnu.so")):
        original = package(f"{top}/{name}/usr", "5.13.2", module)
        for options in ([f"-DCMAKE_PREFIX_PATH={top}/{name}/usr"], []):
            status, said = configure(f"{top}/{name}", *options)
            assert status == 0, said
            expect(f"module {top}/{name}/usr/lib/python3/{module} ", said)
            expect(f"header {top}/{name}/usr/include/server.h ", said)
            expect(f"ParaView_DIR {original} ", said)
        assert os.path.isdir(f"{top}/{name}/build/mended") == (name == "wrong")

    # the new one, where there is an old one, too
    package(f"{top}/two/usr", "5.9.1", "server.so")
    new = package(f"{top}/two/usr", "6.1.1", "server.so")
    status, said = configure(f"{top}/two", f"-DCMAKE_PREFIX_PATH={top}/two/usr")
    assert status == 0, said
    expect(f"ParaView_DIR {new} ", said)
print("ok")
