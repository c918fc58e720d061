# SPDX-License-Identifier: BSD-3-Clause
"""Builds the C library by CMake and puts it into the package. Nothing in it depends on the version of Python."""
import os
import re
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.path.join(HERE, "build", "wheel")


class BuildPackage(build_py):
    """The package as CMake makes it, and the library beside its modules."""

    def run(self):
        subprocess.run(["cmake", "-S", HERE, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release", "-DGRANULAR_BUILD_PLUGIN=OFF", "-DBUILD_TESTING=OFF",
                        "-DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON", "-DCMAKE_INSTALL_LIBDIR=lib", "-DGRANULAR_PYTHON_FOLDER=."], check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "granular_c", "--parallel", str(os.cpu_count())], check=True)
        subprocess.run(["cmake", "--install", BUILD, "--prefix", self.build_lib, "--component", "python", "--strip"], check=True)
        library = "libgranular.so." + version().split(".")[0]
        self.copy_file(os.path.realpath(os.path.join(BUILD, "lib", library)), os.path.join(self.build_lib, "granular", library))


class AnyPython(bdist_wheel):
    """A wheel for every Python 3 on this kind of machine."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    """Says that the wheel holds a library."""

    def has_ext_modules(self):
        return True


def version():
    """The version that CMake knows."""
    with open(os.path.join(HERE, "CMakeLists.txt"), encoding="utf-8") as lists:
        return re.search(r"VERSION (\d+\.\d+\.\d+)", lists.read().split("project(Granular")[1]).group(1)


setup(version=version(), packages=["granular"], package_dir={"granular": "core/python/granular"}, distclass=WithLibrary,
      cmdclass={"build_py": BuildPackage, "bdist_wheel": AnyPython})
