# SPDX-License-Identifier: BSD-3-Clause
"""Making any source or filter of the plugin leaves the times of the animation alone, and a film has a picture for each frame."""
import glob
import os

import granular
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "paths")


def times():
    scene = GetAnimationScene()
    return list(GetTimeKeeper().TimestepValues), scene.StartTime, scene.EndTime, scene.PlayMode


def film(source, name):
    """The number of pictures that SaveAnimation writes of what a source shows in the view that ParaView prefers for it."""
    display = Show(source)
    SaveAnimation(f"{name}.png", GetActiveView(), ImageResolution=[120, 100])
    Hide(source)
    pictures = glob.glob(f"{name}.*.png")
    assert display and all(os.path.getsize(picture) for picture in pictures), name
    return len(pictures)


view = CreateView("RenderView")
grains = granular.reader(os.path.join(data, "breaking.dump"), dt=0.005)
wanted = ([0, 2, 4, 6], 0, 6, "Snap To TimeSteps")
assert times() == wanted, times()
assert film(grains, "reader") == 4

local = granular.reader(os.path.join(data, "breaking_bonds.dump"), dt=0.005, Preset="BondTypeIds")
bonds = GranularLocalJoin(Input=grains, Lines=OutputPort(local, 1))
plane = Plane()
inputs = {"Input": grains, "Lines": bonds, "Points": plane}
names = sorted(name for group in ("sources", "filters") for name in dir(getattr(servermanager, group)) if name.startswith("Granular"))
assert len(names) >= 16, names
for name in names:
    group = servermanager.filters if hasattr(servermanager.filters, name) else servermanager.sources
    known = getattr(group, name)(no_update=True).ListProperties()
    made = getattr(paraview.simple, name)(**{key: source for key, source in inputs.items() if key in known})
    assert times() == wanted, (name, times())
    if "Input" in known:
        SetActiveView(view)
        assert film(made, name) == 4, name
    Delete(made)
    assert times() == wanted, (name, times())
