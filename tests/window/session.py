# SPDX-License-Identifier: BSD-3-Clause
"""The window: open a run whose first frame is empty, Apply, last frame, save the state; load it in pvbatch.

The camera is where arithmetic puts it, around the box. The first picture shows the box and nothing else, the last one the particles of the
file, pixel by pixel; pvbatch shows the same from the state."""
import math
import os
import sys

import numpy
from discs import Camera
from window import PIXELS, Window, drawn, picture, read, run

ANGLE = 30  # degrees, ParaView's default
WINDOW, PVBATCH = sys.argv[1:]
DUMP = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
LOWER, UPPER = numpy.array([-0.05, -0.05, 0]), numpy.array([0.05, 0.05, 0.15])  # the header's


# ---- in the window ----------------------------------------------------------------------------------
for name in ("first.png", "last.png", "loaded.png", "session.pvsm"):
    if os.path.exists(name):
        os.remove(name)
state = os.path.abspath("session.pvsm")
window = Window(WINDOW, DUMP)
window.apply()
window.in_shell(picture("first"))
window.last_frame()
window.in_shell(picture("last"))
window.event("menubar/menu_File", "activate", "actionFileSaveServerState")
window.event("FileSaveServerStateDialog", "filesSelected", state)
window.play()

# ---- in pvbatch -------------------------------------------------------------------------------------
with open("load.py", "w") as file:
    file.write(f"from paraview.simple import *\nLoadState({state!r})\n"
               f"SetActiveView(GetViews()[0])\n{picture('loaded')}")
run(PVBATCH, "--dr", os.path.abspath("load.py"))

# ---- what is to be seen -----------------------------------------------------------------------------
# The camera looks along -z at the sphere around the box; near is the face of the box at the top of z.
centre, radius = (LOWER + UPPER) / 2, numpy.linalg.norm(UPPER - LOWER) / 2
distance = radius / math.sin(math.radians(ANGLE / 2))
camera = Camera(centre + [0, 0, distance], centre, angle=ANGLE)
half = (distance - (UPPER - LOWER)[2] / 2) * math.tan(math.radians(ANGLE / 2))
near = PIXELS / 2 * (UPPER - LOWER)[0] / 2 / half  # half the width of that face, in pixels
first = drawn(read("first"))
for axis in (0, 1):
    line = numpy.flatnonzero(first.any(axis=axis))
    assert len(line), "the first picture is empty"
    assert abs(line[0] - (PIXELS / 2 - near)) < 2.5 and abs(line[-1] + 1 - (PIXELS / 2 + near)) < 2.5, \
        f"the box is from {line[0]} to {line[-1] + 1}, expected {PIXELS / 2 - near:.1f} to {PIXELS / 2 + near:.1f}"
assert first.mean() < 0.03, "more than a wire frame in the empty frame"

with open(DUMP) as file:
    header, *rows = file.read().split("ITEM: ATOMS ")[-1].splitlines()
column = dict(zip(header.split(), numpy.array([row.split() for row in rows], dtype=float).T))
centres = numpy.stack([column[name] for name in "xyz"], axis=1)
seen = camera.seen(centres, column["radius"], column["id"], PIXELS)
last = drawn(read("last"))
inside = seen > 0
# Neighbours of edges are mixed with the background; dark sides may be of its colour.
assert inside.mean() > 0.1, "the truth itself shows little"
assert last[inside].mean() > 0.99, f"only {last[inside].mean():.3f} of the particles' pixels are drawn"
beyond = last & ~first & (seen == 0)
assert beyond.mean() < 0.02, f"{beyond.mean():.3f} of the picture is drawn where neither box nor particles are"

# The window may smooth edges in another way than pvbatch: these pixels are few, all others are the same.
away = abs(read("last") - read("loaded")).max(axis=2)
print(f"{(away > 0).mean():.5f} of the pixels differ, {(away > 8).mean():.5f} by more than 8 levels")
assert (away > 8).mean() < 0.02, "pvbatch shows another picture from the state"
