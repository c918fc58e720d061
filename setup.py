# SPDX-License-Identifier: BSD-3-Clause
"""Builds the C library by CMake and puts it into the package. Nothing in it depends on the version of Python. GRANULAR_BUILD names a
build folder that has the library already, GRANULAR_PACKAGE a finished package (packaging/portable)."""
import glob
import os
import re
import subprocess
import tempfile

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.abspath(__file__))


def build_library():
    """Returns the build folder."""
    build = os.path.join(HERE, "build", "wheel")
    subprocess.run(["cmake", "-S", HERE, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DGRANULAR_BUILD_PLUGIN=OFF", "-DBUILD_TESTING=OFF",
                    "-DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "granular_c", "--parallel", str(os.cpu_count())], check=True)
    return build


class BuildPackage(build_py):
    """The modules and the library, as CMake installs them, in one folder."""

    def run(self):
        package = os.path.join(self.build_lib, "vtkgranular")
        if "GRANULAR_PACKAGE" in os.environ:
            self.copy_tree(os.environ["GRANULAR_PACKAGE"], package)
            return
        build = os.environ.get("GRANULAR_BUILD") or build_library()
        with tempfile.TemporaryDirectory() as prefix:
            for component in ("python", "c"):
                subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--component", component, "--strip"], check=True)
            (modules,) = glob.glob(os.path.join(prefix, "**", "vtkgranular", "__init__.py"), recursive=True)
            (library,) = glob.glob(os.path.join(prefix, "**", "libgranular.so." + version().split(".")[0]), recursive=True)
            self.copy_tree(os.path.dirname(modules), package)
            self.copy_file(os.path.realpath(library), os.path.join(package, os.path.basename(library)))


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


setup(version=version(), packages=["vtkgranular"], package_dir={"vtkgranular": "core/python/vtkgranular"}, distclass=WithLibrary,
      cmdclass={"build_py": BuildPackage, "bdist_wheel": AnyPython})
