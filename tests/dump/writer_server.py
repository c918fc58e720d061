# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks saves: the server writes, and the client hears how it went."""
import os

import vtkgranular as vg
from paraview.simple import *
from ranks_server import connected


def content(path):
    with open(path, "rb") as file:
        return file.read()


with connected() as server:
    source = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
    reader = OpenDataFile(source)
    for mode in ("Gather", "MPI-IO"):
        name = os.path.abspath(f"{mode}.dump")
        SaveData(name, reader, WriteTimeSteps=1, Dialect="LIGGGHTS", ParallelMode=mode)
        assert content(name) == content(source), mode
        vg.save(reader, os.path.abspath("dump.grains"), WriteTimeSteps=1, Dialect="LIGGGHTS",
                ParallelMode=mode)
        assert content("dump.grains") == content(source), mode
    reader.UpdatePipeline(2000)
    vg.save(reader, os.path.abspath("part_%.dump"))
    assert sorted(name for name in os.listdir(".") if name.startswith("part_")) == \
        ["part_0.dump", "part_1.dump"]
    try:
        vg.save(reader, "/nowhere/gone.dump")
    except RuntimeError as error:
        assert "/nowhere/gone.dump: cannot write" in str(error), error
    else:
        raise AssertionError("nothing was raised")
    server.wait_for(r"/nowhere/gone\.dump: cannot write: No such file or directory \(on rank 0 of 2\)")
    vg.save(reader, os.path.abspath("again.dump"))
    assert b"\n2000\n" in content("again.dump")
    Delete(reader)
    del reader
print("saved on the server")
