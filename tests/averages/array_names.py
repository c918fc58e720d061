# SPDX-License-Identifier: BSD-3-Clause
"""Filters tell once, whatever the number of frames, that an array they were asked for does not exist."""
import vtkgranular as vg
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData

from said import said_by

FRAMES = range(4)
HEAD = ("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS ff ff ff\n0 4\n0 1\n0 1\n"
        "ITEM: ATOMS id proc x y z vx vy vz radius mass\n")
with open("particles.dump", "w") as file:
    for frame in FRAMES:
        rows = (f"{i} 0 {i} 0.5 0.5 1 0 0 0.5 {frame + 1}\n" for i in (1, 2, 3))
        file.write(HEAD.format(frame) + "".join(rows))

lines, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
for end in ((1, 0.5, 0.5), (2, 0.5, 0.5)):
    points.InsertNextPoint(end)
cells.InsertNextCell(2, (0, 1))
lines.SetPoints(points)
lines.SetLines(cells)
for name, values in (("id1", [1]), ("id2", [2]), ("force", [[1.0, 0, 0]])):
    array = numpy_to_vtk(values, deep=1)
    array.SetName(name)
    lines.GetCellData().AddArray(array)
image = vtkImageData()
image.SetDimensions(2, 2, 2)

AVERAGE = (("VelocityArray", "v", "no array 'wrong' of velocities"), ("MassArray", "mass", "neither an array 'wrong' nor density"),
           ("RadiusArray", "radius", "array 'wrong' of radii"), ("Arrays", None, "there is no array 'wrong': Arrays may name v_avg"))
ENDS = (("Differences", "radius", "array 'wrong' of the particles"),)
PATHS = (("Arrays", "radius", "expected an array 'wrong' of the particles"),)
# filter, other inputs by port, other properties, and names of arrays: property, a right name, what is told of a wrong one
FILTERS = (
    ("EulerAverage", {}, {"CellCounts": (1, 1, 1)}, AVERAGE + (("StressArray", "", "an array 'wrong' with six values a particle"),)),
    ("EulerAverage", {}, {"CellCounts": (1, 1, 1), "TimeAverage": True}, AVERAGE),
    ("PointAverage", {3: image}, {"KernelWidth": 1.0}, AVERAGE),
    ("ContactSums", {1: lines}, {"Arrays": "von_mises"},
     (("RadiusArray", "radius", "expected an array 'wrong' of the particles"), ("Arrays", None, "there is no array 'wrong': Arrays may"))),
    ("Compare", {1: lines}, {}, ENDS),
    ("LocalJoin", {1: lines}, {}, ENDS + (("Averages", "radius", "array 'wrong' of the particles"),)),
    ("Trajectories", {}, {"Tail": 1}, PATHS),
    ("History", {}, {"OutputType": 1}, PATHS),
    ("Decomposition", {}, {"Mode": 1}, (("ProcessArray", "proc", "expected a point array 'wrong' with ranks"),)),
)


def set_to(filter_, name, value):
    if hasattr(filter_, f"Set{name}"):
        getattr(filter_, f"Set{name}")(*value if isinstance(value, tuple) else (value,))
    elif value:
        filter_.GetArraySelection().EnableArray(value)
    else:
        filter_.GetArraySelection().DisableArray("wrong")


def said_over_frames(filter_):
    filter_.said.clear()
    for time in FRAMES:
        filter_.UpdateTimeStep(time)
    return filter_.said


reader = vg.vtkGranularDumpReader()
reader.AddFileName("particles.dump")
for kind, inputs, properties, names in FILTERS:
    filter_ = getattr(vg, f"vtkGranular{kind}")()
    filter_.SetInputConnection(reader.GetOutputPort())
    for port, data in inputs.items():
        filter_.SetInputDataObject(port, data)
    for name, value in properties.items():
        set_to(filter_, name, value)
    filter_.said = said_by(filter_)
    assert said_over_frames(filter_) == [], (kind, filter_.said)
    for name, right, text in names:
        set_to(filter_, name, "wrong")
        said = said_over_frames(filter_)
        assert len(said) == 1 and text in said[0], (kind, name, said)
        set_to(filter_, name, right)
        assert said_over_frames(filter_) == [], (kind, name, filter_.said)
    output = filter_.GetOutputDataObject(0)
    assert filter_.GetErrorCode() == 0 and output.GetActualMemorySize() > 0, kind
print("each told once")
