# SPDX-License-Identifier: BSD-3-Clause
"""Making any source or filter of the plugin leaves the times of the animation alone, and a film has a picture for each frame.

Readers have times of their own, which the lint of the XML tells apart from settings."""
import glob
import os
import struct

import vtkgranular as vg
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "contacts")


def times():
    scene = GetAnimationScene()
    return list(GetTimeKeeper().TimestepValues), scene.StartTime, scene.EndTime, scene.PlayMode.GetData()


def film(source, name):
    """The number of pictures that SaveAnimation writes of what a source shows."""
    table = source.GetDataInformation().GetDataClassName() == "vtkTable"
    view = chart if table else render
    display = Show(source, view)
    for old in glob.glob(f"{name}.*.png"):
        os.remove(old)
    SaveAnimation(f"{name}.png", view, ImageResolution=[120, 100])
    Hide(source, view)
    pictures = glob.glob(f"{name}.*.png")
    assert display and all(os.path.getsize(picture) for picture in pictures), name
    return len(pictures)


render, chart = CreateView("RenderView"), CreateView("XYChartView")
particles = vg.reader(os.path.join(data, "moving.dump.gz"), dt=0.5)
wanted = ([1500, 1510], 1500, 1510, "Snap To TimeSteps")
assert times() == wanted, times()
assert film(particles, "reader") == 2

contacts = vg.reader(os.path.join(data, "moving_contacts.dump.gz"), dt=0.5, ColumnMap="pos vel id force delta")
inputs = {"Input": particles, "Lines": contacts, "Points": particles}
names = sorted(name for group in ("sources", "filters") for name in dir(getattr(servermanager, group))
               if name.startswith("Granular") and not name.endswith("Reader"))
assert len(names) >= 10, names
for name in names:
    group = servermanager.filters if hasattr(servermanager.filters, name) else servermanager.sources
    known = getattr(group, name)(no_update=True).ListProperties()
    made = getattr(paraview.simple, name)(**{key: source for key, source in inputs.items() if key in known})
    assert times() == wanted, (name, times())
    if "Input" in known:
        assert film(made, name) == 2, name
    Delete(made)
    assert times() == wanted, (name, times())

# ---- vg.film: the frames of what is shown, each once, whatever else there is ---------------------------------------------

Delete(contacts)
for view in (render, chart):
    for source in GetSources().values():
        Hide(source, view)
grains = GranularDumpReader(FileNames=[os.path.join(data, "..", "grains.dump")], TimestepSize=2e-5)  # nobody sets the animation for it
render.ViewSize = [120, 100]
render.CameraPosition, render.CameraFocalPoint, render.CameraViewUp = [0.22, -0.30, 0.19], [0.02, 0.01, 0.069], [0, 0, 1]
vg.show(grains, render)
before = times()


def content(name):
    with open(name, "rb") as file:
        return file.read()


def refused(view, name, kind, text, **properties):
    try:
        vg.film(view, name, **properties)
    except kind as error:
        assert text in str(error), error
    else:
        raise AssertionError(f"{name} was written")


with open("grains.0005.png", "w") as picture:
    picture.write("of an older film with more frames")
assert vg.film(render, "grains.png") == [f"grains.{i:04}.png" for i in range(3)]
assert sorted(glob.glob("grains.*.png")) == [f"grains.{i:04}.png" for i in range(3)] and times() == before, times()
for i, time in enumerate((0, 0.02, 0.04)):
    render.ViewTime = time
    SaveScreenshot("one.png", render)
    assert content("one.png") == content(f"grains.{i:04}.png"), time
assert vg.film(render, "grains.avi", FrameRate=5) == ["grains.avi"]
head = content("grains.avi")
assert struct.unpack_from("<I", head, head.index(b"avih") + 24) == (3,), head[:100]
both = {"Input": grains, "Ids": "1 2"}
for shown, count in ((TemporalShiftScale(Input=grains, PostShift=5), 3), (GranularTrajectories(Tail=1, **both), 3), (GranularTrajectories(**both), 3),
                     (GranularHistory(**both), 3), (particles, 2)):
    Hide(grains, render)
    view = chart if shown.GetXMLName() == "GranularHistory" else render
    Show(shown, view)
    assert len(vg.film(view, "shown.png", ImageResolution=[60, 50])) == count, shown
    Hide(shown, view)
Show(grains, render)
Show(particles, render)
assert len(vg.film(render, "shown.png")) == 5 and len(vg.film(render, "shown.png", FrameStride=2)) == 3
assert len(glob.glob("shown.*")) == 3
refused(render, "grains.xyz", ValueError, "grains.xyz: expected an ending that this ParaView can write")
refused(render, "nowhere/grains.png", RuntimeError, "nowhere")
refused(CreateView("RenderView"), "nothing.png", ValueError, "data with times")
