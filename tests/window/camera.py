# SPDX-License-Identifier: BSD-3-Clause
"""Where the camera is put: around the box where a frame has no particles, around the particles where it has some,
though they may all be on one rank."""
import math
import os

import numpy
from paraview.simple import *

BOX = "ITEM: BOX BOUNDS ff ff ff\n10 30\n-10 10\n0 40\n"
TILTED = "ITEM: BOX BOUNDS xy xz yz pp pp ff\n0 14 1\n0 22 2\n0 30 3\n"  # edges (11 or 10, 0, 0), (1, 20, 0), (2, 3, 30)
ROWS = "ITEM: ATOMS id x y z radius\n"

view = CreateRenderView()
view.ViewSize = [400, 400]
view.CameraParallelProjection = 1


def write(name, box, *frames):
    """Writes a dump with the rows of each frame, at the steps 0, 10, ..."""
    with open(name, "w") as file:
        for number, rows in enumerate(frames):
            file.write(f"ITEM: TIMESTEP\n{10 * number}\nITEM: NUMBER OF ATOMS\n{len(rows)}\n{box}{ROWS}")
            file.writelines(rows)
    return os.path.abspath(name)


def expect(what, lower, upper):
    """Raises AssertionError unless the camera fits the sphere around these bounds."""
    ResetCamera(view)
    lower, upper = numpy.array(lower, float), numpy.array(upper, float)
    centre, radius = (lower + upper) / 2, numpy.linalg.norm(upper - lower) / 2
    assert numpy.allclose(view.CameraFocalPoint, centre, atol=1e-6 * radius), (what, view.CameraFocalPoint[:], centre)
    assert math.isclose(view.CameraParallelScale, radius, rel_tol=1e-6), (what, view.CameraParallelScale, radius)


def show(path):
    reader = OpenDataFile(path)
    display = Show(reader, view)
    display.SetRepresentationType("Grains")
    Render(view)
    return reader, display


def write_plain(name, *frames):
    """Writes a dump without radii."""
    write(name, BOX, *frames)
    with open(name) as file:
        text = file.read()
    with open(name, "w") as file:
        file.write(text.replace(" radius\n", "\n"))
    return os.path.abspath(name)


# One row, in the first of the bytes: with several ranks only one of them has it.
empty_first = write("empty_first.dump", BOX, [], ["1 12 0 5 2\n"])
reader, display = show(empty_first)
expect("box", [10, -10, 0], [30, 10, 40])
moved = "Translation" if "Translation" in display.ListProperties() else "Position"  # since ParaView 5.12
setattr(display, moved, [100, 0, 0])
Render(view)
expect("box that is moved", [110, -10, 0], [130, 10, 40])
setattr(display, moved, [0, 0, 0])
view.ViewTime = 10
Render(view)
expect("particle", [10, -2, 3], [14, 2, 7])
view.ViewTime = 0
Render(view)
expect("box again", [10, -10, 0], [30, 10, 40])
reader.PointOrigin = [10, 20, 30]
Render(view)
expect("box from PointOrigin", [0, -30, -30], [20, -10, 10])
Delete(reader)

# opened the plain way, without radii: dots, which have no extent
reader = OpenDataFile(write_plain("plain.dump", [], ["1 12 0 5\n", "2 12 4 5\n"]))
Show(reader, view)
view.ViewTime = 0
Render(view)
expect("box without radii", [10, -10, 0], [30, 10, 40])
reader.Coordinates = "Scaled"
Render(view)
expect("scaled box", [0, 0, 0], [1, 1, 1])
reader.Coordinates = "Absolute"
view.ViewTime = 10
Render(view)
expect("dots", [12, 0, 5], [12, 4, 5])
view.ViewTime = 0
Delete(reader)

reader, _ = show(write("tilted.dump", TILTED, []))
box = OutputPort(reader, 1)
UpdatePipeline(proxy=reader)
bounds = box.GetDataInformation().GetBounds()
assert abs(bounds[4]) < 1e-12 and abs(bounds[5] - 30) < 1e-12 and bounds[1] > 11, bounds
expect("tilted box", bounds[0::2], bounds[1::2])
Delete(reader)

# contacts: around the box where there are none, and around the lines later
contacts = OpenDataFile(os.path.join(os.environ["GRANULAR_DATA"], "good", "local", "contacts.dump"))
view.ViewTime = 0
assert Show(contacts, view).Representation == "Contacts"
Render(view)
expect("box without contacts", [-0.05, -0.05, 0], [0.05, 0.05, 0.15])
view.ViewTime = 4000
Render(view)
bounds = contacts.GetDataInformation().GetBounds()
expect("contacts", bounds[0::2], bounds[1::2])
view.ViewTime = 0
Delete(contacts)

# a filter that lets no particle through
reader, _ = show(empty_first)
Hide(reader, view)
clip = Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=100, UpperThreshold=200)
view.ViewTime = 10
display = Show(clip, view)
display.SetRepresentationType("Grains")
Render(view)
expect("all particles left out", [10, -10, 0], [30, 10, 40])
