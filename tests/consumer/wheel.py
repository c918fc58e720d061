# SPDX-License-Identifier: BSD-3-Clause
"""Makes the wheel of the Python package by pip, installs it into an environment of its own, and uses it there. Takes the sources and a
build folder, which spares building the library again."""
import os
import shutil
import subprocess
import sys
import zipfile

source, build = sys.argv[1:]
os.makedirs("sources", exist_ok=True)
for name in ("CMakeLists.txt", "README.md", "pyproject.toml", "setup.py"):  # pip leaves files beside the sources
    shutil.copy(os.path.join(source, name), "sources")
shutil.copytree(os.path.join(source, "core", "python"), "sources/core/python", dirs_exist_ok=True)
environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "LD_LIBRARY_PATH")}
environment["GRANULAR_BUILD"] = build


def run(*command, **options):
    subprocess.run(command, check=True, env=environment, **options)


shutil.rmtree("made", ignore_errors=True)
run(sys.executable, "-m", "venv", "--system-site-packages", "--clear", "environment")
run("environment/bin/python", "-m", "pip", "wheel", "--no-build-isolation", "--no-index", "--no-deps", "--wheel-dir", "made", "./sources")
(wheel,) = os.listdir("made")
assert wheel.startswith("vtk_granular-") and "-py3-none-linux_" in wheel, wheel
names = zipfile.ZipFile(os.path.join("made", wheel)).namelist()
assert {"vtkgranular/__init__.py", "vtkgranular/libgranular.so.0", "vtkgranular/_reader.py", "vtkgranular/command/info.py", "vtkgranular/py.typed"} <= set(names), names
run("environment/bin/python", "-m", "pip", "install", "--no-index", "--no-deps", "--force-reinstall", os.path.join("made", wheel))
dump = os.path.join(source, "samples", "data", "grains.dump")
run("environment/bin/granular", "check", dump)
script = """import sys, vtkgranular as vg
assert "environment" in vg.__file__, vg.__file__
run = vg.open(sys.argv[1])
assert run[-1]["v"].shape == (1200, 3)
maps = open("/proc/self/maps").read()
assert "environment/lib" in [line for line in maps.splitlines() if "libgranular" in line][0], maps
"""
run("environment/bin/python", "-c", script, dump)
environment["PYTHONPATH"] = os.path.join(source, "tests", "support")
for name in ("arrays", "writing"):
    run("environment/bin/python", "-W", "error", os.path.join(source, "tests", "python", name + ".py"))
