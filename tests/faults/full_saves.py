# SPDX-License-Identifier: BSD-3-Clause
"""vg.save by ParaView's own writers where there is no room, as files may not have more bytes: an error that names the file, and
the old files as they were. Some of these writers do not look whether their bytes were written."""
import contextlib
import os
import resource
import shutil
import signal

from paraview.simple import *

import vtkgranular as vg

PARTICLES = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
LIMIT = 100_000  # bytes of a file
small, large = Sphere(), Sphere(ThetaResolution=200, PhiResolution=200)
particles = vg.reader(PARTICLES)


@contextlib.contextmanager
def limited():
    """No file may have more bytes."""
    _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, most))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))


def contents():
    found = {}
    for folder, _, names in os.walk("."):
        for name in names:
            with open(os.path.join(folder, name), "rb") as file:
                found[os.path.join(folder, name)] = file.read()
    return found


def refused(source, path, **properties):
    before = contents()
    try:
        vg.save(source, path, **properties)
    except RuntimeError as error:
        assert str(error).startswith(path + ": "), error
    else:
        raise AssertionError(f"{path} has {os.path.getsize(path)} bytes")
    assert contents() == before, path


shutil.rmtree("full", ignore_errors=True)
os.mkdir("full")
os.chdir("full")
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
for ending in ("vtp", "csv", "ply", "stl", "vtk", "pvd", "pvtp"):
    path = f"a.{ending}"
    vg.save(small, path)
    os.chmod(path, 0o640)
    with limited():
        refused(large, path)
    vg.save(small, path)
    assert os.stat(path).st_mode & 0o777 == 0o640, ending
    for name in os.listdir("."):
        shutil.rmtree(name) if os.path.isdir(name) else os.remove(name)

# all files of a series, or none
vg.save(particles, "all.vtp", WriteTimeSteps=1)
assert sorted(os.listdir(".")) == ["all_0.vtp", "all_1.vtp", "all_2.vtp"], os.listdir(".")
with limited():
    refused(particles, "all.vtp", WriteTimeSteps=1)
    refused(particles, "new.vtp", WriteTimeSteps=1)

print("no file was lost")
