# SPDX-License-Identifier: BSD-3-Clause
"""What one rank alone cannot read, and what none can: one error that says where and why, empty outputs, none waits, and ParaView
lives on and shows the next file."""
import os
import re
import struct

import all_ranks
import plain_euler
import vtkgranular as vg
from paraview.simple import *

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
RANKS = all_ranks.ranks.GetNumberOfProcesses()
CONTACTS = "x1 y1 z1 x2 y2 z2 id1 id2"
FIBRES = os.path.join(GOOD, "restart", "fibres.restart")


def dump_text():
    rows = [f"{i:04d} 0.5 {0.5 if i != 901 else 'zero'} 0.5\n" for i in range(1, 1001)]
    return ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1000\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n" +
            "".join(rows))


def data_texts():
    head = "a title\n\n200 atoms\n0 10 xlo xhi\n\nAtoms # atomic\n\n"
    rows = [f"{i} 1 0.5 0.5 0.5\n" for i in range(1, 201)]
    speeds = [f"{i} 1 2 3\n" for i in range(200, 0, -1)]
    word = rows[:187] + [rows[187].replace(" 1 0.5", " 1 0.O")] + rows[188:]
    texts = {"short.data": (rows[:-1], speeds), "word.data": (word, speeds), "missing.data": (rows, ["201 1 2 3\n"] + speeds[1:]),
             "twice.data": (rows, ["1 1 2 3\n"] + speeds[1:])}
    texts = {name: head + "".join(atoms) + "Velocities\n\n" + "".join(velocities) for name, (atoms, velocities) in texts.items()}
    labels = texts["word.data"].replace("Atoms #", "Atom Type Labels\n\n1 sand\n\nAtoms #").replace(" 1 0.O", " glass 0.5")
    return {**texts, "label.data": labels}


def local_texts():
    head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1000\nITEM: ENTRIES "
    rows = [f"0.5 0.5 0.5 0.6 0.5 0.5 {i:04d} {i + 1:04d}\n" for i in range(1000)]
    bad = rows[:900] + [rows[900].replace("0.6 ", "O.6 ")] + rows[901:]
    return {"word.local": head + CONTACTS + "\n" + "".join(bad),
            "silent.local": head + " ".join(f"c_a[{i}]" for i in range(1, 9)) + "\n" + "".join(rows),
            "short.local": head + CONTACTS + "\n" + "".join(rows[:-1]) + "0.5 0.5\n"}


def restart_files():
    with open(FIBRES, "rb") as file, open(os.path.join(GOOD, "restart", "parts.base.restart"), "rb") as base:
        whole, parts = file.read(), base.read()
    bonds = whole.index(struct.pack("<d", 65.0)) + 8 * (17 + 12)  # in the record of a particle with two
    assert struct.unpack_from("<d", whole, bonds)[0] == 2
    return {"restart.cut": whole[:-100], "restart.many": whole[:bonds] + struct.pack("<d", 2e9) + whole[bonds + 8:],
            "restart.lammps": b"LammpS RestartT\0" + bytes(200), "restart.base.7": parts}


def euler_texts():
    cells = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (2, 2, 2)))
    good = plain_euler.text(cells)
    cells["centres"][5] = [7, 7, 7]
    other = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (3, 2, 2)))
    small = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (1, 1, 2)))
    return {"word_1.vtk": good.replace("LOOKUP_TABLE default\n", "LOOKUP_TABLE default\nx", 1), "no_grid_1.vtk": plain_euler.text(cells),
            "later_1.vtk": good, "later_2.vtk": plain_euler.text(other), "small_1.vtk": plain_euler.text(small)}


files = {"broken.dump": dump_text(), **data_texts(), **local_texts(), **restart_files(), **euler_texts()}
if all_ranks.ranks.GetLocalProcessId() == 0:
    for name, content in files.items():
        with open(name, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
all_ranks.wait()


def reader(kind, *names, **properties):
    return lambda: globals()[f"Granular{kind}Reader"](FileNames=[os.path.abspath(name) for name in names], **properties)


def next_file(name, **properties):
    return {"FileNames": [os.path.join(GOOD, name)], **properties}


def filter_of(kind, file, **properties):
    return lambda: globals()[f"Granular{kind}"](Input=GranularDumpReader(FileNames=[os.path.join(GOOD, file)]), **properties)


PARTICLES, DATA, BONDS = next_file("grains_1000.dump"), next_file("data_file/full.data"), next_file("local/chain_bonds.dump", ColumnMap="")
RESTART, CELLS = next_file("restart/fibres.restart"), next_file("euler_1000.vtk")
SPLIT = {"Mode": "ProcessorGrid", "ProcessorGrid": [2, 1, 1], "XCuts": []}
LAST = rf" \(on rank {RANKS - 1} of {RANKS}\)" if RANKS > 1 else ""
# a source, what it says, what mends it, and what each output has then: rows of a table, else cells
CASES = (
    (reader("Dump", "gone.dump"), "gone.dump: cannot open", PARTICLES, (1200, 1)),
    (reader("Dump", "broken.dump"), f"broken.dump:910: column 'y': expected a number, got 'zero'{LAST}", PARTICLES, (1200, 1)),
    (reader("Dump", "broken.dump", SortById=1), f"broken.dump:910: column 'y': expected a number, got 'zero'{LAST}", PARTICLES, (1200, 1)),
    (reader("DataFile", "gone.data"), "gone.data: cannot open", DATA, (40, 3, 1)),
    (reader("DataFile", "short.data"), "short.data:6: expected 200 rows in the section Atoms, got 199", DATA, (40, 3, 1)),
    (reader("DataFile", "word.data"), "word.data:195: column 'x': expected a number, got '0.O'", DATA, (40, 3, 1)),
    (reader("DataFile", "label.data"), "label.data:199: column 'type': expected a type or its label, got 'glass'", DATA, (40, 3, 1)),
    (reader("DataFile", "missing.data"), "missing.data:208: expected a row of particle 200", DATA, (40, 3, 1)),
    (reader("DataFile", "twice.data"), "twice.data:409: column 'id': .*particle 1;", DATA, (40, 3, 1)),
    (reader("Local", "gone.local"), "gone.local: cannot open", BONDS, (0, 96)),
    (reader("Local", "word.local"), "word.local:906: column 'x2': .*got 'O.6'", BONDS, (0, 96)),
    (reader("Local", "silent.local", Preset="BondIds"), "silent.local:1: expected the 3 columns of the preset BondIds .* got 8",
     {"Preset": "Automatic", "ColumnMap": CONTACTS}, (1000, 1000)),
    (reader("Local", "short.local"), "short.local:1005: expected 8 words in a row, got 2", BONDS, (0, 96)),
    (reader("Restart", "restart.gone"), "restart.gone: cannot open", RESTART, (31, 27, 1)),
    (reader("Restart", "restart.cut"), "cut@669: expected 31 particles of 3 processes.*understood: header, groups, masses", RESTART,
     (31, 27, 1)),
    (reader("Restart", "restart.many"), "many@1394: expected a number of bonds from 0 to 2.*in record 2 of particle 2", RESTART,
     (31, 27, 1)),
    (reader("Restart", "restart.lammps"), "LAMMPS.*restart2data", RESTART, (31, 27, 1)),
    (reader("Restart", "restart.base.7"), "restart.0.7: expected", RESTART, (31, 27, 1)),
    (reader("Euler", "gone.vtk"), "gone.vtk: cannot open", CELLS, (112,)),
    (reader("Euler", "word_1.vtk"), "word_1.vtk:[0-9]+: ", CELLS, (112,)),
    (reader("Euler", "word_1.vtk", Output="ImageData"), "word_1.vtk:[0-9]+: ", CELLS, (112,)),
    (reader("Euler", "no_grid_1.vtk", Output="ImageData"), "no_grid_1.vtk", {"Output": "Points"}, (8,)),
    (reader("Euler", "no_grid_1.vtk", Output="ImageData"), "no_grid_1.vtk", next_file("euler_1000.vtk"), (112,)),
)
CASES += () if "GranularDecomposition" not in globals() else (
    (lambda: GranularDecompositionSource(ProcessorGrid=[2, 2, 2], NumberOfProcesses=9), "got 9", {"NumberOfProcesses": 8}, (8,)),
    (filter_of("Decomposition", "grains_2000.dump", Mode="ProcessArray"), "'proc'", SPLIT, (2,)),
    (filter_of("Decomposition", "grains_2000.dump", Mode="Subdomains"), "second input", SPLIT, (2,)),
    (filter_of("Decomposition", "grains_2000.dump", ProcessorGrid=[2, 1, 1], XCuts=[7]), "7", SPLIT, (2,)),
    (filter_of("Decomposition", "tri_plain.dump"), "tilted", None, ()),
)


def check(proxy, counts, time=None):
    """What the outputs have; a rank of many that run the script has a part."""
    vg.update(proxy, time)
    for port, count in enumerate(counts):
        told = OutputPort(proxy, port).GetDataInformation()
        found = told.GetNumberOfRows() if told.GetDataClassName() == "vtkTable" else told.GetNumberOfCells()
        assert found == count or (all_ranks.symmetric and count > 0), (port, found, count)


def refused(proxy, message, time=None):
    try:
        vg.update(proxy, time)
    except RuntimeError as error:
        assert re.search(message, str(error)), (message, str(error))
    else:
        raise AssertionError(f"nothing was raised: {message}")
    for port in range(proxy.SMProxy.GetNumberOfOutputPorts()):
        told = OutputPort(proxy, port).GetDataInformation()
        assert told.GetNumberOfCells() == told.GetNumberOfPoints() == told.GetNumberOfRows() == 0, message


for make, message, cure, counts in CASES:
    proxy = make()
    refused(proxy, message)
    if cure:
        vg.set_properties(proxy, **cure)
        check(proxy, counts)
    Delete(proxy)

# Euler cells: a grid that is not the first file's, and after an error another one, that is smaller
series = reader("Euler", "later_1.vtk", "later_2.vtk", Output="ImageData")()
check(series, (8,), 1)
refused(series, "later_2.vtk", 2)
check(series, (8,), 1)
series.Output = "Points"
check(series, (12,), 2)
series.Output = "ImageData"
refused(series, "later_2.vtk", 2)
series.FileNames = [os.path.abspath("small_1.vtk")]
check(series, (2,))

# of a run that was stopped while it wrote, the file before is shown
check(GranularRestartReader(FileNames=[os.path.abspath("restart.cut"), FIBRES]), (31, 27, 1))
print("alive")
