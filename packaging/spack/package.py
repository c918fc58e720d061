# SPDX-License-Identifier: BSD-3-Clause
"""A recipe of spack: copy this file to packages/vtk-granular of a repository of yours, then `spack install vtk-granular`.

Not tried. There is no address of a release yet: `spack dev-build vtk-granular@0.1.0` builds a tree that you have."""
from spack.package import *


class VtkGranular(CMakePackage):
    """Files of LIGGGHTS and LAMMPS in ParaView, VTK and numpy."""

    license("BSD-3-Clause")
    version("0.1.0")

    variant("paraview", default=True, description="Build the plugin for ParaView")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("ninja", type="build")
    depends_on("python@3.11:", type=("build", "run"))
    depends_on("py-numpy", type=("build", "run"))
    depends_on("zlib-api")
    depends_on("zstd")
    depends_on("paraview@5.11:+python+mpi", when="+paraview")
    depends_on("mpi", when="+paraview")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("GRANULAR_BUILD_PLUGIN", "paraview"),
            self.define("BUILD_TESTING", False),
            self.define("GRANULAR_PYTHON_FOLDER", python_platlib.replace(self.prefix, "").lstrip("/")),
        ]

    def setup_run_environment(self, env):
        if self.spec.satisfies("+paraview"):
            paraview = f"paraview-{self.spec['paraview'].version.up_to(2)}"
            env.prepend_path("PV_PLUGIN_PATH", join_path(self.prefix.lib, paraview, "plugins"))
