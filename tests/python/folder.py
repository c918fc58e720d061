# SPDX-License-Identifier: BSD-3-Clause
"""A folder is listed as its files are: series by kind, with timesteps, columns, and the walls that move with the particles."""
import json
import os
import shutil
import subprocess
import sys

import vtkgranular as vg
from vtkgranular._folder import _families

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
HOPPER = os.path.join(GOOD, "hopper")

# names, and the patterns, names and timesteps of their series
for names, expected in (
    ("dump_0 dump_1000 dump_200", {"dump_*": ("dump_0 dump_200 dump_1000", [0, 200, 1000])}),
    ("a_1.0.d a_1.1.d a_2.0.d a_2.1.d", {"a_*.%.d": ("a_1.0.d a_1.1.d a_2.0.d a_2.1.d", [1, 1, 2, 2])}),
    ("r1_0.d r1_5.d r2_0.d r2_5.d", {"r1_*.d": ("r1_0.d r1_5.d", [0, 5]), "r2_*.d": ("r2_0.d r2_5.d", [0, 5])}),
    ("run2_007.d.gz run2_008.d", {"run2_*.d": ("run2_007.d.gz run2_008.d", [7, 8])}),
    ("x.d x.d.zst y2.d.gz", {name: (name, [2] if "2" in name else []) for name in ("x.d", "x.d.zst", "y2.d.gz")})):
    found = {pattern: (" ".join(files), steps) for pattern, files, steps in _families(names.split())}
    assert found == expected, found

# the run of tests/data/README.md: name, kind, timesteps, columns
V = "id type v radius"
SERIES = (("dump_*.liggghts", "dump", [2000, 3000, 4000], V), ("blocks_*.vtm", "particles", [0, 4000], ""),
          ("packed_2000.vtp", "particles", [2000], V), ("particles_*.vtk", "particles", [0, 2000, 4000], V),
          ("ranks_4000.pvtp", "particles", [4000], "id type radius"), ("contacts_*.dump", "local", [0, 2000, 4000], "id1 id2 periodic force"),
          ("contacts_*.vtk", "contacts", [0, 2000, 4000], "id1 id2 force"), ("funnel.stl", "walls", [], ""), ("plate.stl", "walls", [], ""),
          ("plate_*.stl", "walls", [*range(0, 4500, 500)], ""),
          ("walls_*.vtk", "walls", [0, 1500, 3000], "meshid normal_stress_average shear_stress_average wear v"), ("in.hopper", "other", [], ""))
folder = vg.open(HOPPER)
assert [(each.name, each.kind, each.steps, " ".join(each.columns)) for each in folder.values()] == [*SERIES], [*folder.values()]
assert folder.dt is None and folder.dt_path == "" and folder["in.hopper"].about == "an input script of LAMMPS or LIGGGHTS"
assert folder.particles.name == "dump_*.liggghts" and [each.name for each in folder.walls] == ["plate_*.stl"], folder.walls
assert folder.remarks[2] == "walls_*.vtk lacks 2 of 3 timesteps of dump_*.liggghts, the first 2000: the file before is shown there", folder.remarks
assert [os.path.basename(path) for step in (-5, 1999, 9999) for path in folder["walls_*.vtk"].files_at(step)] == [
    "walls_0.vtk", "walls_1500.vtk", "walls_3000.vtk"]
run = folder["dump_*.liggghts"].open(dt=2e-5)
assert run.times.tolist() == [0.04, 0.06, 0.08] and run[-1]["radius"].max() > 0
assert folder["plate_*.stl"].open() is None
text = str(folder)
assert "  walls         plate_*.stl\n                  9 timesteps: 0 to 4000, every 500\n" in text and text.endswith(folder.remarks[-1]), text
try:
    folder["plate"]
except vg.ColumnError as error:
    assert "expected one of dump_*.liggghts, " in str(error) and "got 'plate'" in str(error), error
else:
    raise AssertionError("no such series")

# a log beside the folder tells dt; tables are listed one by one; walls with arrays are shown, and others are the same ones again
os.makedirs("made/post", exist_ok=True)
for step in (2000, 4000):
    for name in ("particles_{}.vtk", "particles_boundingBox_{}.vtk", "plate_{}.stl"):
        shutil.copy(os.path.join(HOPPER, name.format(step)), "made/post")
    shutil.copy(os.path.join(HOPPER, "walls_1500.vtk"), f"made/post/walls_{step}.vtk")
for name, copy in (("tables/chunk2.profile", "post/table2.txt"), ("tables/print.csv", "post/table1.txt"), ("tables/words.txt", "post/words.txt"),
                   ("log/liggghts.txt", "log.liggghts"), ("grains.bin", "post/grains.bin"), ("local/pieces_3000.0.dump", "post/c_3000.0.dump")):
    shutil.copy(os.path.join(GOOD, name), os.path.join("made", copy))
with open("made/post/rows.txt", "w", encoding="ascii") as stream:
    stream.write("1 2 3\n4 5 6\n")
folder = vg.open("made/post")
assert (folder.dt, os.path.basename(folder.dt_path)) == (2e-5, "log.liggghts"), folder
assert [each.name for each in folder.of("table")] == ["table1.txt", "table2.txt", "words.txt"] and folder["rows.txt"].kind == "other", folder
assert folder["table1.txt"].steps[-1] == 600 and folder["table2.txt"].open()["vz"].shape == (3, 4)
assert folder["words.txt"].about.endswith("words.txt:3: column 1: expected a number, got 'at'")
assert folder.particles.name == "particles_*.vtk" and [each.name for each in folder.walls] == ["walls_*.vtk"], folder.walls
assert folder.particles.times(folder.dt) == [0.04, 0.08] and "times 0.04 to 0.08" in str(folder)
assert [os.path.basename(path) for path in folder.box_of(folder.particles.files[0])] == ["particles_boundingBox_2000.vtk"]
assert vg.open("made/post", dt=1e-5).dt_path == ""

command = [sys.executable, os.environ["GRANULAR_COMMAND"]]
told = json.loads(subprocess.run([*command, "info", "--json", "made/post"], capture_output=True, check=True).stdout)
assert told["dt"] == 2e-5 and {each["name"]: each["times"] for each in told["series"]}["walls_*.vtk"] == [0.04, 0.08], told
for arguments, message in ((["stats", "made/post"], "got a directory"), (["show", "made"], "expected particles, got ")):
    done = subprocess.run([*command, *arguments], capture_output=True, text=True)
    assert done.returncode in (1, 2) and message in done.stderr, done
