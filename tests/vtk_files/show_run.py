# SPDX-License-Identifier: BSD-3-Clause
"""The folder of a run is shown by one call: particles, box, walls and contacts at the times of the particles, and the plate is under the
particles in every frame. The portable plugin says that it leaves out the walls. Charts draw the tables beside."""
import os
import shutil
import warnings

import numpy as np
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import vtkgranular as vg

POST = os.path.join(os.environ["GRANULAR_DATA"], "..", "..", "samples", "data", "whole_run", "post")
HOPPER = os.path.join(os.environ["GRANULAR_DATA"], "good", "hopper")
HAS_VTK = hasattr(servermanager.sources, "GranularMeshReader")
STEPS, DT = range(0, 7000, 1000), 2e-5


def shown(told, *arguments, **options):
    """The displays, with one remark for each text."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        displays = vg.show_run(*arguments, **options)
    found = [str(warning.message) for warning in caught]
    assert len(found) == len(told) and all(text in remark for text, remark in zip(told, found)), found
    return displays


def new_view():
    ResetSession()
    CreateRenderView(ViewSize=[200, 200])


def raises(kind, text, *arguments, **options):
    try:
        vg.show_run(*arguments, **options)
    except kind as error:
        assert text in str(error), error
    else:
        raise AssertionError(text)


def data_of(display):
    data = servermanager.Fetch(display.Input)
    return data, vtk_to_numpy(data.GetPoints().GetData()), data.GetFieldData().GetArray("timestep").GetValue(0)


def pixels(name):
    """The number of pixels that are not the background."""
    SaveScreenshot(name, view)
    picture = vtkPNGReader()
    picture.SetFileName(name)
    picture.Update()
    values = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars())
    return int((values != values[0]).any(axis=1).sum())


view = CreateRenderView(ViewSize=[400, 400], OrientationAxesVisibility=0)
dt_told, left_out = "time of a timestep, 2e-05, is from ", "walls_*.vtk is left out: "
displays = shown([dt_told] if HAS_VTK else [left_out, dt_told], POST)
assert list(displays) == ["dump_*.liggghts", "walls_*.vtk"][:1 + HAS_VTK], displays
particles = displays["dump_*.liggghts"]
assert tuple(particles.ColorArrayName) == ("POINTS", "v") and particles.LookupTable.RGBPoints[-4] > 0.4
times = [float(f"{2 * step}e-5") for step in STEPS]
scene, keeper = GetAnimationScene(), GetTimeKeeper()
assert list(keeper.TimestepValues) == times and scene.AnimationTime == times[-1], (keeper.TimestepValues, scene.AnimationTime)
for step, time in zip(STEPS, times) if HAS_VTK else ():
    scene.AnimationTime = time
    picture = pixels(f"frame_{step}.png")
    data, corners, wall_step = data_of(displays["walls_*.vtk"])
    assert wall_step == step and (picture > 10000 or step == 0), (step, wall_step, picture)
    if step < 3000:
        continue
    grains, positions, grains_step = data_of(particles)
    radii, origin = vtk_to_numpy(grains.GetPointData().GetArray("radius")), corners[-4]  # the plate comes last
    x, y = corners[-3] - origin, corners[-1] - origin
    normal = np.cross(x, y) / np.linalg.norm(np.cross(x, y))
    along = np.linalg.lstsq(np.array([x, y]).T, (positions - origin).T, rcond=None)[0]
    over = np.all((along > 0.1) & (along < 0.9), axis=0) & (np.abs((positions - origin) @ normal) < 0.02)
    nearest = np.min(np.abs((positions - origin) @ normal)[over] - radii[over])
    assert grains_step == step and abs(nearest) < 1.5e-4, (step, nearest)  # of a radius of 3e-3

new_view()
lack = "contacts_*.dump lacks 3 of 7 timesteps of dump_*.liggghts, the first 1000"
displays = shown([lack], POST, dt=DT, walls=False, contacts=True, color="radius", view=GetActiveView(), legend=False)
assert list(displays) == ["dump_*.liggghts", "contacts_*.dump"] and displays["dump_*.liggghts"].ColorArrayName[1] == "radius"
scene = GetAnimationScene()
scene.AnimationTime = times[3]
assert [data_of(display)[2] for display in displays.values()] == [3000, 2000]

# the folder of the active source; walls by name, also where they lack timesteps
new_view()
dump = vg.reader(os.path.join(HOPPER, "dump_*.liggghts"))
SetActiveSource(dump)
told = [left_out] * (not HAS_VTK) + ["walls_*.vtk lacks 2 of 3 timesteps of dump_*.liggghts, the first 2000"] * HAS_VTK
displays = shown(told, dt=DT, walls="walls_*.vtk")
assert list(GetTimeKeeper().TimestepValues) == [0.04, 0.06, 0.08] and len(vg.film(GetActiveView(), "film.png")) == 3
if HAS_VTK:
    assert [data_of(display)[2] for display in displays.values()] == [4000, 3000]
    os.makedirs("vtk", exist_ok=True)
    os.makedirs("blocks", exist_ok=True)
    for step in (0, 2000, 4000):
        for name in (f"particles_{step}.vtk", f"particles_boundingBox_{step}.vtk"):
            os.path.exists(os.path.join("vtk", name)) or os.symlink(os.path.join(HOPPER, name), os.path.join("vtk", name))
    new_view()
    displays = shown([], "vtk", contacts=True)
    assert list(displays) == ["particles_*.vtk"] and list(GetTimeKeeper().TimestepValues) == [0, 2000, 4000]
    for step in (0, 4000):
        for name in (f"blocks_{step}", f"blocks_{step}.vtm"):
            os.path.exists(os.path.join("blocks", name)) or os.symlink(os.path.join(HOPPER, name), os.path.join("blocks", name))
    new_view()
    displays = shown([], "blocks")
    walls = servermanager.Fetch(displays["walls of blocks_*.vtm"].Input)
    assert list(displays)[0] == "blocks_*.vtm" and walls.GetNumberOfBlocks() == 2, displays

# bonds that name their particles alone
shutil.rmtree("bonds", ignore_errors=True)
os.makedirs("bonds")
os.symlink(os.path.join(HOPPER, "..", "local", "chain.dump"), "bonds/chain.dump")
with open("bonds/bonds.local", "w", encoding="ascii") as stream:
    stream.write("ITEM: TIMESTEP\n1000\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ENTRIES id1 id2\n1 2\n2 3\n")
new_view()
bonds = shown([], "bonds", contacts=True)["bonds.local"].Input
assert bonds.GetXMLName() == "GranularLocalJoin" and bonds.GetDataInformation().GetNumberOfCells() == 2, bonds
for name, column, lines, first in (("tables/chunk2.profile", "vz", ["vz 1", "vz 2", "vz 3", "vz 4"], (0.004, -0.251181)),
                                   ("log/liggghts.txt", "KinEng", ["KinEng"], (0, 0))):
    display = vg.chart(os.path.join(os.environ["GRANULAR_DATA"], "good", name), column, dt=DT)
    table = servermanager.Fetch(display.Input)
    assert list(display.SeriesVisibility) == lines and display.XArrayName == "time", display.SeriesVisibility
    assert tuple(table.GetColumnByName(each).GetValue(0) for each in ("time", lines[-1])) == first, table
os.makedirs("empty", exist_ok=True)
raises(ValueError, "empty: expected particles, walls or contacts, got no files", "empty")
raises(ValueError, "expected one of dump_*.liggghts, ", POST, walls="wall")
raises(FileNotFoundError, "none", "none")
SetActiveSource(None)
raises(ValueError, "expected a folder, or an active source that reads files, got neither")
