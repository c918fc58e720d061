# SPDX-License-Identifier: BSD-3-Clause
"""What comes out of ParaView's filters as particles is shown as particles, and other things are not; only arrays of particles are colours;
while the camera moves, few particles stand for many."""
import os

import numpy
import vtkgranular as vg
from discs import black_view, picture
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
PIXELS = 200
view = black_view(PIXELS)

reader = vg.reader(os.path.join(GOOD, "grains.dump"))
reader.UpdatePipeline(2000)
view.ViewTime = 2000
bounds = reader.GetDataInformation().GetBounds()
middle = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
clip = Clip(Input=reader, ClipType="Plane")
clip.ClipType.Origin, clip.ClipType.Normal = middle, [0, 0, 1]
box = Clip(Input=reader, ClipType="Box")
threshold = Threshold(Input=clip, Scalars=["POINTS", "type"], LowerThreshold=1, UpperThreshold=2)
chosen = ExtractSelection(Input=reader, Selection=SelectionQuerySource(QueryString="id <= 300", ElementType="Point Data"))
calculated = Calculator(Input=reader, Function="mag(v)", ResultArrayName="speed")
alien = vg.reader(os.path.join(GOOD, "shapes", "computes.dump"))
dots = vg.reader(os.path.join(GOOD, "ortho_plain.dump"))
dots.UpdatePipeline()  # a box of ParaView 6 is empty where nothing has been read
groups = {"dots": Clip(Input=dots, ClipType="Box"), "computes": Threshold(Input=alien, Scalars=["POINTS", "type"], LowerThreshold=1, UpperThreshold=1),
          "clip": clip, "box": box, "threshold": threshold, "selection": chosen, "calculator": calculated}
for name, source in groups.items():
    source.UpdatePipeline(2000)
    assert 0 < source.GetDataInformation().GetNumberOfPoints() <= 1200, name
    assert Show(source, view).Representation == "Grains", name
    Hide(source, view)
colours = Show(reader, view).SMProxy.GetProperty("ColorArrayName").FindDomain("vtkSMArrayListDomain")
names = [colours.GetString(i) for i in range(colours.GetNumberOfStrings())]
assert names == sorted(["f", "id", "image", "mass", "omega", "radius", "type", "v"]), names
Hide(reader, view)
view.ViewTime = 0  # a frame without particles
early = Clip(Input=reader, ClipType="Box")
early.UpdatePipeline(0)
assert early.GetDataInformation().GetNumberOfPoints() == 0 and Show(early, view).Representation == "Grains"
spheres = Glyph(Input=reader, GlyphType="Sphere")
spheres.UpdatePipeline(0)
assert Show(spheres, view).Representation == "Surface"
Hide(early, view)
Hide(spheres, view)
view.ViewTime = 2000
glyphs = Glyph(Input=reader, GlyphType="Sphere", ScaleArray=["POINTS", "radius"], ScaleFactor=2, GlyphMode="All Points")
circles = Slice(Input=glyphs)
circles.SliceType.Origin, circles.SliceType.Normal = middle, [0, 1, 0]
for name, source in {"glyphs": glyphs, "circles": circles, "ball": Sphere(),
                     "contacts": vg.reader(os.path.join(GOOD, "local", "contacts.dump"), ColumnMap="pos id force"),
                     "paths": TemporalParticlesToPathlines(Input=reader, MaskPoints=1),
                     "voxels": PointVolumeInterpolator(Input=reader)}.items():
    source.UpdatePipeline(2000)
    assert Show(source, view).Representation != "Grains", name
    Hide(source, view)

# ---- while the camera moves ----------------------------------------------------------------------------------------------
def window():
    """The pixels that are in the window now."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.GetRenderWindow())
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(PIXELS, PIXELS, 3).astype(int)


def white(source):
    display = vg.show(source, view)
    display.Ambient, display.Diffuse, display.AmbientColor, display.DiffuseColor = 1, 0, [1, 1, 1], [1, 1, 1]
    display.ColorArrayName = [None, ""]
    return display


HideAll(view)
many = GranularPackingSource(NumberOfGrains=30000)
white(many)
ResetCamera(view)
view.LODThreshold, view.LODResolution = 0, 0.1
EVERY = 2  # of 30,000, at most 10^(4 + 2 * 0.1)
view.SMProxy.StillRender()
still = window()
view.SMProxy.InteractiveRender()
moving = window()
view.SMProxy.StillRender()
assert (window() == still).all(), "the picture is complete again"
Hide(many, view)
chosen = ProgrammableFilter(Input=many, OutputDataSetType="Same as Input", Script=f"""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
ids = numpy.asarray(inputs[0].PointData["id"]).astype(numpy.uint64)
kept = (ids * numpy.uint64(0x9e3779b97f4a7c15) >> numpy.uint64(32)) % numpy.uint64({EVERY}) == 0
assert abs(kept.mean() - 1 / {EVERY}) < 0.02
output.SetPoints(inputs[0].Points[kept])
output.PointData.append(numpy.asarray(inputs[0].PointData["radius"])[kept] * {EVERY}**(1 / 3), "radius")
""")
white(chosen)
view.LODThreshold = 1e9
view.SMProxy.StillRender()
expected = window()
apart = (moving != expected).any(axis=2).sum()
assert apart <= 5 and (still != expected).any(axis=2).sum() > 50, apart
print("all displays looked at")
