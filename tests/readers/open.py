# SPDX-License-Identifier: BSD-3-Clause
"""Files open as what they are, by name and content; names, defaults, arrays and times of each reader."""
import gzip
import os
import shutil

import vtkgranular as vg
from paraview.simple import *

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
ALL_PARTICLES, SPHERE, CONTACTS = "grains_1000.dump", "data_file/sphere.data", "local/contacts.dump"
FIBRES, CELLS, DOMAINS = "restart/fibres.restart", "euler_1000.vtk", "decomposition/all.vtk"
COMMON = {"TimestepSize": 1, "RefreshOnUpdate": 0, "Threads": 0}
LINES = {"PeriodicLines": "MinimumImage", "PointOrigin": [0, 0, 0]}
PARTICLES = {"Coordinates": "Absolute", "PointOrigin": [0, 0, 0], "SortById": 0, "Stride": 1, "RegionOfInterest": [0] * 6}


def good(name):
    return os.path.join(GOOD, name)


# file, reader, cells of the first output (None: it would warn of columns without names), names under which users have such files
NAMES = (
    (ALL_PARTICLES, "Dump", 1200, "a.dump a.lammpstrj a.liggghts a.dmp A.DUMP dump.1000 dump.liggghts dump.1000.liggghts "
     "dump1000.liggghts_run dump_xyzr-2000 dump.settling.1000"),
    (SPHERE, "DataFile", 40, "data.sphere x.lmp x.data"),
    (CONTACTS, "Local", None, "contacts.local bonds.bond x.bfc x.lmp dump.local.1000"),
    (FIBRES, "Restart", 31, "restart.1000 restart.equil tmp.restart.2000 old.rst fibres.restart tmp.restart1"),
    (CELLS, "Euler", 112, "cells.euler"),
    ("grid/grid_600.dump", "Euler", None, "a.grid cells.dump grid.lammpstrj"),
    (DOMAINS, "Decomposition", 4, "all.vtk all.decomposition"),
)
# files of one kind that have the names of others
KINDS = {"Dump": "grains.dump grains.bin local/chain.dump", "Local": "local/contacts.dump local/chain_bonds.dump local/label.dump",
         "DataFile": "local/chain.data", "Decomposition": "decomposition_1000.vtk"}
# files, properties that differ from the defaults, defaults, arrays of points, arrays of cells, times
READERS = (
    ([f"grains_{step}.dump" for step in (0, 1000, 2000)], {}, {**COMMON, **PARTICLES, "PointPrecision": "Double", "Vertices": "Vertex"},
     ["id", "type", "image", "radius"], None, [0, 1000, 2000]),
    ([SPHERE], {}, {**COMMON, **LINES, **PARTICLES, "AtomStyle": "automatic", "Boundary": ""},
     ["id", "type", "diameter", "density", "image", "v", "omega", "radius"], ["bond_id", "btype", "id1", "id2"], [3000]),
    ([CONTACTS], {"Preset": "ContactsForce"}, {**COMMON, **LINES, "ColumnMap": "", "RepeatedSteps": "Auto"}, None,
     ["id1", "id2", "periodic", "force"], [0, 1000, 2000, 3000, 4000]),
    ([FIBRES], {}, {**COMMON, **LINES, "HistoryLayout": "Automatic"}, None, None, None),
    ([f"euler_{step}.vtk" for step in (1000, 2000, 3000, 4000)], {}, {**COMMON, "Output": "Points", "RepeatedSteps": "Auto"},
     ["v_avg", "volumefraction", "radius", "pressure"], None, [1000, 2000, 3000, 4000]),
    ([DOMAINS], {}, COMMON, None, None, [0, 1, 2]),
)


def opened(name, kind):
    reader = OpenDataFile(name)
    assert reader is not None and reader.GetXMLName() == kind, (name, reader and reader.GetXMLName())
    return reader


def check_count(reader, count):
    if count is not None:
        reader.UpdatePipeline()
        assert reader.GetDataInformation().GetNumberOfCells() == count, reader.FileNames
    Delete(reader)


for file, kind, count, names in NAMES:
    for name in names.split():
        shutil.copyfile(good(file), name)
        check_count(opened(os.path.abspath(name), f"Granular{kind}Reader"), count)
for kind, names in KINDS.items():
    for name in names.split():
        Delete(opened(good(name), f"Granular{kind}Reader"))

# restart files of several processes, and packed
for part in ("base", "0", "1", "2"):
    shutil.copyfile(good(f"restart/parts.{part}.restart"), f"restart.{part}.10000")
with open(good(FIBRES), "rb") as file, gzip.open("fibres.restart.gz", "wb") as packed:
    packed.write(file.read())
for name in ("restart.base.10000", "fibres.restart.gz"):
    check_count(opened(os.path.abspath(name), "GranularRestartReader"), 31)

# other files of these names are for ParaView's own readers
SaveData("sphere.vtk", Sphere(), FileType="Ascii")
SaveData("wavelet.vtk", Wavelet(), FileType="Binary")
SaveData("rectilinear.vtk", Wavelet(), FileType="Ascii")
SaveData("arrays.vtk", PointDatatoCellData(Input=Wavelet()), FileType="Ascii")
SaveData("wavelet.vtu", Tetrahedralize(Wavelet()), DataMode="Binary")
with open("mesh.vtk", "w") as file:  # as dump mesh/vtk of LIGGGHTS, which has the same title
    file.write("# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
               "0 0 0\n1 0 0\n0 1 0\nPOLYGONS 1 4\n3 0 1 2\nCELL_DATA 1\nSCALARS pressure float 1\n"
               "LOOKUP_TABLE default\n7\n")
for name in ("sphere.vtk", "wavelet.vtk", "rectilinear.vtk", "arrays.vtk", "mesh.vtk"):
    opened(os.path.abspath(name), "LegacyVTKFileReader")
opened(os.path.abspath("wavelet.vtu"), "XMLUnstructuredGridReader")

for files, properties, defaults, points, cells, times in READERS:
    reader = OpenDataFile([good(name) for name in files], **properties)
    assert len(reader.FileNames) == len(files), files
    for name, default in defaults.items():
        found = getattr(reader, name)
        assert (list(found) if isinstance(default, list) else found) == default, (files, name, found)
    assert points is None or reader.PointArrayStatus[:] == points, reader.PointArrayStatus[:]
    assert cells is None or reader.CellArrayStatus[:] == cells, reader.CellArrayStatus[:]
    assert times is None or list(reader.TimestepValues) == times, (files, reader.TimestepValues)
    if points:  # an array that is switched off is not there
        reader.PointArrayStatus = ["radius"]
        for each in (reader, vg.reader([good(name) for name in files], PointArrayStatus=["radius"], **properties)):
            each.UpdatePipeline(times[-1])
            assert list(each.PointData.keys()) == ["radius"], (files, each.PointData.keys())
    Delete(reader)
print("opened")
