# SPDX-License-Identifier: BSD-3-Clause
"""Which writer granular.save and SaveData take for contacts and bonds, and what is refused."""
import os
import shutil

import granular
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "local")
shutil.rmtree("choice", ignore_errors=True)
os.mkdir("choice")
os.chdir("choice")


def content(path):
    with open(path, "rb") as file:
        return file.read()


reader = GranularLocalReader(FileNames=[os.path.join(data, "contacts.dump")])
reader.UpdatePipeline(2000)
granular.save(reader, "fresh.bonds")
lines = content("fresh.bonds")
assert lines.startswith(b"ITEM: TIMESTEP\n2000\nITEM: NUMBER OF ENTRIES\n35\n") and b" x1 " in lines
SaveData("saved.bonds", reader)
granular.save(OutputPort(reader, 0), "port.bonds")
granular.save(reader, "named.txt", writer="GranularLocalWriter")
for name in ("saved.bonds", "port.bonds", "named.txt"):
    assert content(name) == lines, name
# the rows
granular.save(OutputPort(reader, 1), "rows.bonds")
rows = content("rows.bonds")
assert rows.startswith(b"ITEM: TIMESTEP\n2000\nITEM: NUMBER OF ENTRIES\n35\n") and b" x1 " not in rows
SaveData("rows_saved.bonds", OutputPort(reader, 1))
assert content("rows_saved.bonds") == rows
# others keep their names
granular.save(reader, "ends.dump", Columns="x y z")
assert b"NUMBER OF ATOMS\n70\n" in content("ends.dump")
SaveData("paraview.vtp", reader)
SaveData("paraview.csv", OutputPort(reader, 1))
assert content("paraview.csv").startswith(b'"')

chosen = Threshold(Input=reader, Scalars=["CELLS", "id1"], LowerThreshold=0, UpperThreshold=100)
chosen.UpdatePipeline(2000)
for proxy, name, properties in ((reader, "mass.bonds", {"Columns": "id1 mass"}), (reader, "label.bonds", {"Label": "MY BONDS"}),
                                (reader, "gone/a.bonds", {}), (Sphere(), "sphere.bonds", {}),
                                (chosen, "grid.bonds", {})):
    try:
        granular.save(proxy, name, **properties)
    except RuntimeError:
        assert not os.path.exists(name)
    else:
        raise AssertionError(f"{name} was written")
for arguments, error in (({"Style": "Atom"}, AttributeError), ({"Dialect": "Wide"}, ValueError)):
    try:
        granular.save(reader, "never.bonds", **arguments)
    except error:
        pass
    else:
        raise AssertionError(f"{arguments} was taken")
assert not os.path.exists("never.bonds")
# what a filter made cells of any kind of are lines again
granular.save(ExtractSurface(Input=chosen), "chosen.bonds")
assert 0 < content("chosen.bonds").count(b"\n") < lines.count(b"\n")
print("chosen")
