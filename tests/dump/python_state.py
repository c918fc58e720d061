# SPDX-License-Identifier: BSD-3-Clause
"""vg.load_state: a state file opens again after its folder was moved, and says which file is gone."""
import os
import shutil
from pathlib import Path

import vtkgranular as vg
from paraview.simple import *

good = Path(os.environ["GRANULAR_DATA"]) / "good"
for folder in ("first", "second"):
    shutil.rmtree(folder, ignore_errors=True)
os.makedirs("first/post")
for step in (0, 1000, 2000):
    shutil.copy(good / f"grains_{step}.dump", "first/post")
reader = vg.reader("first/post/grains_*.dump", dt=2e-5)
vg.show(reader, color="radius", box=True)
GranularCompare(Input=reader)
CreateExtractor("GranularDump", reader)
SaveState("first/run.pvsm")
state = Path("first/run.pvsm").read_bytes()
for kept, gone in (("RepeatedSteps", "IndexFile"), ("MassArray", "BondTypeArray"), ("WriteUnits", "Units")):
    place = f'<Property name="{kept}"'.encode()
    assert state.count(place) == 1, kept
    state = state.replace(place, f'<Property name="{gone}" id="1.{gone}" number_of_elements="1"><Element index="0" value="1"/></Property>'.encode() + place)
Path("first/run.pvsm").write_bytes(state)  # a state of the time when there were these properties


def loaded():
    """The reader that a state brings, alone."""
    ResetSession()
    vg.load_state("second/run.pvsm" if os.path.exists("second") else "first/run.pvsm")
    (_, source), = ((name, source) for name, source in GetSources().items() if source.GetXMLName() == "GranularDumpReader")
    vg.update(source, 0.04)
    assert source.GetDataInformation().GetNumberOfPoints() > 100 and source.TimestepSize == 2e-5
    return source


assert loaded().FileNames[0].endswith("first/post/grains_0.dump")
shutil.move("first", "second")
again = loaded()
assert [os.path.relpath(name) for name in again.FileNames] == [f"second/post/grains_{step}.dump" for step in (0, 1000, 2000)]
assert Path("second/run.pvsm").read_bytes() == state  # it is as it was

os.remove("second/post/grains_1000.dump")
try:
    loaded()
except FileNotFoundError as error:
    assert "first/post/grains_1000.dump" in str(error) and "run.pvsm" in str(error), error
else:
    raise AssertionError("a file that is gone was not missed")
print("loaded")
