# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks opens a file of each kind, draws and saves it; what goes wrong is said and passes."""
import glob
import os

import plain_euler
import vtkgranular as vg
from paraview.simple import *
from ranks_server import connected

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
cells = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (2, 2, 2)))
cells["centres"][5] = [7, 7, 7]
with open("no_grid_1.vtk", "w") as file:
    file.write(plain_euler.text(cells))
with open(os.path.join(GOOD, "restart", "fibres.restart"), "rb") as whole, open("restart.cut", "wb") as cut:
    cut.write(whole.read()[:-100])

# files, reader, steps: properties, time, what each output has (rows of a table, else cells); what is refused, and what the server
# says. The last step is good again.
SESSIONS = (
    ("grains_[0-9]*.dump", "Dump", [({}, 0, (0, 1)), ({}, 1000, (1200, 1)), ({}, 2000, (1200, 1)), ({}, 1000, (1200, 1))],
     {"FileNames": ["/nowhere/gone.dump"]}, r"gone\.dump: cannot open: No such file or directory \(on rank 0 of 2\)",
     ({"FileNames": [os.path.join(GOOD, "grains_2000.dump")]}, 2000, (1200, 1))),
    ("local/contacts.dump", "Local", [({}, 0, (0, 0, 1)), ({}, 4000, (261, 261, 1)), ({}, 1000, (4, 4, 1))], {"Preset": "Bonds"},
     "contacts.dump:1: expected the 9 columns of the preset Bonds", ({"Preset": "Automatic", "PeriodicLines": "MinimumImage"}, 2000, (35, 35, 1))),
    ("restart/fibres.restart", "Restart", [({}, None, (31, 27, 1))], {"FileNames": [os.path.abspath("restart.cut")]},
     "restart.cut.*expected 31 particles of 3 processes",
     ({"FileNames": [os.path.join(GOOD, "restart/fibres.restart")], "PeriodicLines": "Split"}, None, (31, 28, 1))),
    ("euler_4000.vtk", "Euler", [({"Output": "Points"}, None, (112,)), ({"Output": "ImageData"}, None, (112,))],
     {"FileNames": [os.path.abspath("no_grid_1.vtk")]}, "no_grid_1.vtk", ({"Output": "Points"}, None, (8,))),
    ("decomposition/all.vtk", "Decomposition", [({}, None, (4,))], None, None, None),
)


def check(proxy, properties, time, counts):
    vg.set_properties(proxy, **properties)
    proxy.UpdatePipeline(*([] if time is None else [time]))
    for port, count in enumerate(counts):
        told = OutputPort(proxy, port).GetDataInformation()
        found = told.GetNumberOfRows() if told.GetDataClassName() == "vtkTable" else told.GetNumberOfCells()
        assert found == count, (proxy.GetXMLName(), properties, time, port, found)


def drawn(proxy, most, time=None):
    """A filter of ParaView makes more cells than so many."""
    proxy.UpdatePipeline(*([] if time is None else [time]))
    assert proxy.GetDataInformation().GetNumberOfCells() > most, proxy


def dump(reader):
    assert list(reader.TimestepValues) == [0, 1000, 2000]
    assert reader.PointData["id"].GetRange(0) == (1, 1200)


def local(reader):
    assert list(reader.TimestepValues) == [0, 1000, 2000, 3000, 4000]
    assert reader.CellArrayStatus[:] == ["id1", "id2", "periodic", "force"], reader.CellArrayStatus[:]
    GranularLocalReader(FileNames=[os.path.join(GOOD, "local", "chain_bonds.dump")]).UpdatePipeline()
    server.wait_for("taken for the preset BondTypeIdsForce")
    reader.PeriodicLines = "Split"
    drawn(Tube(Input=reader), 261, 4000)
    assert reader.CellData["row"].GetRange(0) == (0, 260), reader.CellData["row"].GetRange(0)


def restart(reader):
    drawn(Tube(Input=OutputPort(reader, 1), Radius=0.0005), 27)


def euler(reader):
    for output in ("Points", "ImageData"):
        reader.Output = output
        vg.save(reader, os.path.abspath("again_*.euler"))
        with open("again_4000.euler") as written, open(os.path.join(GOOD, "euler_4000.vtk")) as original:
            assert written.read() == original.read(), output
        os.remove("again_4000.euler")
    cut = Slice(Input=reader, SliceType="Plane")
    vg.set_properties(cut.SliceType, Origin=[0.001, 0, 0], Normal=[1, 0, 0])
    drawn(cut, 27)


def decomposition(divided):
    """The filter counts by subdomains of the file and by a grid, and what it says of the grid passes."""
    all_particles = OpenDataFile(os.path.join(GOOD, "grains_2000.dump"))
    counted = GranularDecomposition(Input=all_particles, Mode="Subdomains", Subdomains=divided)
    by_grid = GranularDecomposition(Input=all_particles, ProcessorGrid=[2, 1, 2])
    for domains in (counted, by_grid):
        check(domains, {}, None, (4,))
        assert domains.GetDataInformation().GetBounds() == (-0.05, 0.05, -0.05, 0.05, 0, 0.15)
    assert counted.CellData["nlocal"].GetRange() == by_grid.CellData["nlocal"].GetRange()
    vg.save(by_grid, os.path.abspath("counted_*.vtk"))
    written = OpenDataFile(os.path.abspath("counted_2000.vtk"))
    written.UpdatePipeline()
    assert written.CellData["nlocal"].GetRange() == by_grid.CellData["nlocal"].GetRange()
    check(by_grid, {"NumberOfProcesses": 5}, None, (0,))
    server.wait_for("got 5")
    check(by_grid, {"NumberOfProcesses": 4}, None, (4,))


with connected() as server:
    for pattern, kind, steps, bad, message, again in SESSIONS:
        reader = OpenDataFile(sorted(glob.glob(os.path.join(GOOD, pattern))))
        assert reader.GetXMLName() == f"Granular{kind}Reader", reader
        for step in steps:
            check(reader, *step)
        globals()[kind.lower()](reader)
        if bad:
            check(reader, bad, None, (0,) * len(steps[0][2]))
            server.wait_for(message)
            check(reader, *again)
print("served")
