# SPDX-License-Identifier: BSD-3-Clause
"""Particles of VTK files come up as spheres, walls and contacts as surfaces and lines, also where the first frame has none of them."""
import os

from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import vtkgranular as vg

HOPPER = os.path.join(os.environ["GRANULAR_DATA"], "good", "hopper")


def pictured(name):
    """The number of pixels that are not the background."""
    SaveScreenshot(name, view)
    picture = vtkPNGReader()
    picture.SetFileName(name)
    picture.Update()
    pixels = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars())
    return int((pixels != pixels[0]).any(axis=1).sum())


view = CreateRenderView(ViewSize=[400, 400], OrientationAxesVisibility=0)
particles, plate, walls, contacts = (vg.reader(os.path.join(HOPPER, name), dt=2e-5) for name in
                                     ("particles_*.vtk", "plate_*.stl", "walls_*.vtk", "contacts_*.vtk"))
kinds = [Show(source, view).Representation for source in (particles, contacts, plate)]
assert kinds == ["Grains", "Surface", "Surface"], kinds
Hide(contacts, view)
display = vg.show(particles, view, color="type", box=True)
assert display.GrainRadiusArray == "radius", display.GrainRadiusArray
wall = vg.show(walls, view, color="wear", legend=True)
assert wall.Representation == "Surface" and tuple(wall.ColorArrayName) == ("CELLS", "wear"), wall.ColorArrayName[:]
vg.set_properties(wall, Opacity=0.3)
view.ResetActiveCameraToPositiveY()
scene = GetAnimationScene()
scene.AnimationTime = 0.08
ResetCamera(view)
assert tuple(wall.ColorArrayName) == ("CELLS", "wear")
with_all = pictured("particles_and_walls.png")
Hide(particles, view)
assert pictured("walls.png") < with_all
try:
    vg.show(walls, view, color="heat")
except ValueError as error:
    assert "of area, meshid, " in str(error) or "wear" in str(error), error
else:
    raise AssertionError("an array that is not there")
