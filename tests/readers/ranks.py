# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks read a part each, and all of them together what one process reads alone, in its order: points, cells and
arrays to the bit. That one process reads the right numbers is checked for each reader in its own folder."""
import glob
import os

import all_ranks
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
LINES = ("MinimumImage", "Split", "AsWritten")
NUMBERS = {name: number for number, name in enumerate(LINES)}  # of words, for the classes
CONTACTS = "x1 y1 z1 x2 y2 z2 id1 id2 periodic forcex forcey forcez"


def made(name, text):
    """A file that the first rank writes."""
    if all_ranks.ranks.GetLocalProcessId() == 0:
        with open(name, "w") as file:
            file.write(text)
    all_ranks.wait()
    return os.path.abspath(name)


def few(count):
    """A file of contacts with fewer rows than there are ranks."""
    return made(f"few_{count}.dump", f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n{count}\nITEM: ENTRIES x1 y1 z1 x2 y2 z2 id1 id2\n" +
                "1 1 1 2 2 2 7 8\n" * count)


def grid():
    """A grid whose first column is named id, as `dump_modify colname 1 id` does it."""
    with open(os.path.join(GOOD, "grid", "grid.dump")) as file:
        return made("grid.dump", file.read().replace("c_pg:grid:data[1]", "id"))


def properties():
    """Labels of types, and a section of a fix without an array, about which nothing is said."""
    with open(os.path.join(GOOD, "data_file", "properties.data")) as file:
        return made("properties.data", file.read().replace("d_heat d_pos", "d_heat d_x d_y d_z"))


# reader, files below good, times, outputs, properties: each of them with each value
TABLE = (
    ("Dump", "grains_[0-9]*.dump", (0, 1000, 2000), (0,), {"SortById": (0, 1)}),
    ("Dump", "grains_1000.dump", (1000,), (0, 1), {"Stride": (3,), "SortById": (1,)}),
    ("Dump", "pieces_*.dump", (0, 1000), (0,), {"RegionOfInterest": ((1, -1, 1, -1, 1, -1), (1, -1, 1, -1, -1, 0.03))}),
    ("Dump", "ortho_*.dump.gz", (0, 50, 100), (0,), {}),
    ("Dump", "ortho_custom.bin", (100,), (0,), {"SortById": (0, 1)}),
    ("DataFile", "local/chain.data", (None,), (0, 1), {"AtomStyle": ("bond",), "SortById": (0, 1), "PeriodicLines": LINES[:2]}),
    ("DataFile", "data_file/full.data", (None,), (0, 1, 2), {"AtomStyle": ("full",), "PeriodicLines": LINES[2:]}),
    ("DataFile", "data_file/full.data", (None,), (0, 1), {"AtomStyle": ("full",), "SortById": (1,), "PeriodicLines": LINES[1:2]}),
    ("DataFile", "data_file/sphere.data", (None,), (0,), {"AtomStyle": ("sphere",), "SortById": (0, 1), "Stride": (1, 4)}),
    ("DataFile", properties(), (None,), (0,), {"SortById": (0, 1)}),
    ("DataFile", "data_file/hybrid_labels.data", (None,), (0, 1), {"AtomStyle": ("hybrid sphere bond",)}),
    ("DataFile", "shapes/superellipsoids.data", (None,), (0,), {"AtomStyle": ("ellipsoid",), "SortById": (0, 1)}),
    ("Local", "local/contacts.dump", (4000, 3000, 2000, 1000), (0,), {"ColumnMap": (CONTACTS,)}),
    ("Local", "local/contacts.dump", (4000,), (0,), {"ColumnMap": (CONTACTS,), "PeriodicLines": LINES[1:]}),
    ("Local", "local/pieces_*.dump", (3000,), (0,), {"ColumnMap": (CONTACTS,)}),  # only the first of a step has a header
    *(("Local", few(count), (None,), (0,), {}) for count in (0, 1, 2)),
    ("Restart", "restart/fibres.restart", (None,), (0, 1, 2), {}),
    ("Restart", "restart/fibres.restart", (None,), (1,), {"PeriodicLines": LINES[1:]}),
    ("Restart", "restart/parts.base.restart", (None,), (0, 1), {}),
    ("Euler", "euler_?000.vtk", (1000, 2000, 3000, 4000), (0,), {}),
    ("Euler", grid(), (None,), (0,), {}),
    ("Decomposition", "decomposition/all.vtk", (0,), (0,), {}),
)


def combined(properties):
    """Every way to choose a value of each property."""
    ways = [{}]
    for name, values in properties.items():
        ways = [{**way, name: value} for way in ways for value in values]
    return ways


def content(data):
    """Points, cells and arrays by name, as bytes."""
    arrays = {"points": data.GetPoints().GetData() if data.GetNumberOfPoints() else None}
    for part, attributes in (("point", data.GetPointData()), ("cell", data.GetCellData())):
        for i in range(attributes.GetNumberOfArrays()):
            arrays[part, attributes.GetArrayName(i)] = attributes.GetAbstractArray(i)
    told = {name: vtk_to_numpy(array).tobytes() for name, array in arrays.items() if array and array.GetNumberOfTuples()}
    cells = [[data.GetCell(i).GetPointId(k) for k in range(data.GetCell(i).GetNumberOfPoints())] for i in range(data.GetNumberOfCells())]
    return data.GetNumberOfPoints(), cells, told


def alone(kind, files, time, way):
    """The same by the class, in this process without the others."""
    reader = getattr(vg, f"vtkGranular{kind}Reader")()
    reader.SetController(None)
    for name in files:
        reader.AddFileName(name)
    for name, value in way.items():
        value = NUMBERS.get(value, value) if isinstance(value, str) else value
        getattr(reader, f"Set{name}")(*value if isinstance(value, tuple) else (value,))
    reader.Update() if time is None else reader.UpdateTimeStep(time)
    assert not reader.GetErrorMessage(), reader.GetErrorMessage()
    return reader


for kind, pattern, times, ports, properties in TABLE:
    files = sorted(glob.glob(os.path.join(GOOD, pattern)))
    assert files, pattern
    for way in combined(properties):
        proxy, empty = globals()[f"Granular{kind}Reader"](FileNames=files, **way), True
        for time in times:
            expected = alone(kind, files, time, way)
            for port in ports:
                data = expected.GetOutputDataObject(port)
                found = all_ranks.whole(OutputPort(proxy, port), time, data.GetClassName())
                assert content(found) == content(data), (kind, pattern, way, time, port)
                empty = empty and data.GetNumberOfCells() == 0
        assert not empty or "few_0" in pattern, (pattern, way)
        if not all_ranks.symmetric:  # arrays are whole, not there on some ranks only
            arrays = proxy.GetPointDataInformation()
            assert not any(arrays.GetArray(i).GetIsPartial() for i in range(arrays.GetNumberOfArrays())), pattern
        Delete(proxy)
print("all there")
