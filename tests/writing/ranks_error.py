# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong on one rank alone: an error that names it, the old file as it was, and no rank that waits.

The arguments name the systems whose writers these are."""
import gc
import os
import sys

import vtkgranular as vg
from paraview.simple import *
from writing import changed_on, check_refused, good

MODES = [{"ParallelMode": mode} for mode in ("Gather", "MPI-IO")]


def dump():
    particles = GranularDumpReader(FileNames=[good("grains.dump")])
    faulty = changed_on(1, particles, "short = vtkDoubleArray(); short.SetName('radius'); short.InsertNextValue(1); "
                                   "data.GetPointData().AddArray(short)")
    return particles, [(faulty, "old.dump")], [{"WriteTimeSteps": 1, **mode} for mode in MODES]


def local():
    contacts = GranularLocalReader(FileNames=[good("local/contacts.dump")])
    contacts.UpdatePipeline(2000)
    faulty = changed_on(-1, contacts, "data.GetCellData().RemoveArray('force')")
    bent = changed_on(1, contacts, "cells = vtkCellArray(); "
                                   "[cells.InsertNextCell(3, [0, 1, 2]) for line in range(data.GetNumberOfLines())]; "
                                   "data.SetLines(cells)")
    for proxy in (faulty, bent):
        proxy.UpdatePipeline(2000)
    return contacts, [(faulty, "old.bonds"), (bent, "old.bonds")], MODES


def euler():
    cells = GranularEulerReader(FileNames=[good("euler_1000.vtk")])
    faulty = changed_on(-1, cells, "data.GetPointData().RemoveArray('pressure')")
    return cells, [(faulty, "old.euler"), (cells, "old%.euler")], [{}]


def decomposition():
    divided = GranularDecompositionSource(Bounds=[0, 1, 0, 1, 0, 1], ProcessorGrid=[3, 3, 3])
    faulty = changed_on(-1, divided, "data.GetPoints().SetPoint(0, 5, 5, 5)")
    return divided, [(faulty, "old.vtk"), (divided, "old.dump")], [{"writer": "GranularDecompositionWriter"}]


def check(source, faults, forms):
    old = faults[0][1]
    new = old.replace("old", "new")
    with open(old, "w") as file:
        file.write("the old file")
    for form in forms:
        for proxy, name in [*faults, (source, "gone/" + old)]:
            check_refused(proxy, os.path.abspath(name), **form)
        # a proxy that an error keeps is deleted by the next that collects garbage, as ParaView's filters in Python do while all ranks update
        kept = {type(each).__name__ for each in gc.get_objects() if isinstance(each, servermanager.Proxy)}
        assert not [name for name in kept if name.endswith("Writer")], kept
        vg.save(source, os.path.abspath(new), **form)
        os.remove(new)


for system in sys.argv[1:]:
    check(*{made.__name__: made for made in (dump, local, euler, decomposition)}[system]())
print("alive")
