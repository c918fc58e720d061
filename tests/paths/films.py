# SPDX-License-Identifier: BSD-3-Clause
"""Making any source or filter of the plugin leaves the times of the animation alone, and a film has a picture for each frame.

Readers have times of their own, which the lint of the XML tells apart from settings."""
import glob
import os

import vtkgranular as vg
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "contacts")


def times():
    scene = GetAnimationScene()
    return list(GetTimeKeeper().TimestepValues), scene.StartTime, scene.EndTime, scene.PlayMode


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
