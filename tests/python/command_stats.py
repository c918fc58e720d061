# SPDX-License-Identifier: BSD-3-Clause
"""granular stats, against fractions; granular show, where it can draw."""
import csv
import importlib.util
import io
import json
import os
import shutil
from fractions import Fraction

import plain_dump
from command import SAMPLES, granular

SOURCE = os.path.join(SAMPLES, "grains.dump")
text = plain_dump.read(SOURCE)[-1]
rows = list(csv.DictReader(io.StringIO(granular("stats", SOURCE, "--csv", "--frames", "-1", "--dt", "2e-5")[0])))
told = {row["column"]: row for row in rows}
for name in ("id", "x", "vx", "omegaz", "radius", "mass", "ix"):
    exact = [Fraction(word) if name in ("id", "ix") else Fraction(float(word)) for word in text.columns[name]]
    row = told[name]
    assert (int(row["count"]), float(row["min"]), float(row["max"])) == (len(exact), float(min(exact)), float(max(exact))), row
    assert float(row["sum"]) == float(sum(exact)) and float(row["mean"]) == float(sum(exact)) / len(exact), row
    assert row["step"] == "4000" and row["time"] == "0.08"
mass = [Fraction(float(word)) for word in text.columns["mass"]]
velocity = [[Fraction(float(word)) for word in text.columns[name]] for name in ("vx", "vy", "vz")]
energy = sum(m * (x * x + y * y + z * z) for m, x, y, z in zip(mass, *velocity)) / 2
mean = [sum(m * v for m, v in zip(mass, axis)) / sum(mass) for axis in velocity]
heat = sum(m * sum((v - u) ** 2 for v, u in zip(each, mean)) for m, *each in zip(mass, *velocity)) / (3 * sum(mass))
height = sum(m * Fraction(float(word)) for m, word in zip(mass, text.columns["z"])) / sum(mass)
for name, exact in (("kinetic energy", energy), ("granular temperature", heat), ("centre of mass z", height)):
    assert abs(float(told[name]["mean"]) / float(exact) - 1) < 1e-14, (name, told[name], float(exact))
document = json.loads(granular("stats", SOURCE, "--json", "--frames", "::2", "--dt", "2e-5")[0])
assert list(document) == ["given", "faults", "frames"] and [frame["step"] for frame in document["frames"]] == [0, 2000, 4000]
frame = document["frames"][-1]
assert frame["time"] == 0.08 and frame["rows"] == 1200 and frame["columns"]["vx"] == {
    name: type(frame["columns"]["vx"][name])(told["vx"][name]) for name in ("count", "min", "max", "mean", "sum")}
assert [frame[name] for name in ("centre_of_mass_z", "kinetic_energy", "granular_temperature")] == [
    float(told[name]["mean"]) for name in ("centre of mass z", "kinetic energy", "granular temperature")]
assert document["frames"][0]["columns"]["vx"] == {"count": 0, "min": None, "max": None, "mean": None, "sum": None}
granular("stats", SOURCE, "--json", "--csv", status=2)
some = granular("stats", SOURCE, "--columns", "v radius")[0]
assert some.count("vx") == 5 and "mass" not in some and "kinetic" not in some
assert "velocity" in granular("stats", SOURCE, "--columns", "velocity", status=1)[1]

granular("show", SOURCE, "--size", "large", status=2)
assert "radius" in granular("show", SOURCE, "--color", "velocity", status=1)[1]
if importlib.util.find_spec("vtkmodules") and shutil.which("xvfb-run"):
    # in a folder of results, whose Python files are not run
    os.makedirs("results", exist_ok=True)
    for name in ("json", "numpy", "vtkgranular", "vtkmodules", "sitecustomize"):
        with open(f"results/{name}.py", "w") as module:
            module.write("raise SystemExit('a file of the user was run')\n")
    assert granular("show", SOURCE, "-o", "../shown.png", "--color", "v", "--size", "300x200", cwd="results")[0] == "../shown.png\n"
    drawn = json.loads(granular("show", SOURCE, "-o", "again.png", "--json", "--size", "30x20", preexec_fn=lambda: None)[0])
    assert drawn == {"given": [SOURCE], "picture": os.path.abspath("again.png"), "frame": 4, "step": 4000, "time": 4000.0, "color": None, "size": [30, 20]}
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName("shown.png")
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    assert reader.GetOutput().GetDimensions()[:2] == (300, 200)
    coloured = (pixels.max(axis=1) - pixels.min(axis=1) > 60).mean()
    assert 0.05 < coloured < 0.5, coloured  # particles, and not the whole picture
else:
    print("nothing to draw with")
print("stats")
