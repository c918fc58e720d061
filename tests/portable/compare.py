# SPDX-License-Identifier: BSD-3-Clause
"""The portable plugin makes what the compiled one makes, and writes the same bytes.

compare.py PVPYTHON PLUGIN [FILE...] compares all that outputs.py prints of files with either plugin; without FILEs of one of each form.
"""
import concurrent.futures
import json
import os
import subprocess
import sys

import vtkgranular

HERE = os.path.dirname(os.path.abspath(__file__))
DATA, OUTPUT = os.environ["GRANULAR_DATA"], os.environ["GRANULAR_OUTPUT"]
FORMS = ("grains.dump", "grains.bin", "ortho_image.dump", "ortho_000050.dump.gz", "tri_000000.dump.gz", "ortho_scaled.bin", "plain.bin",
         "shapes", "local", "restart", "data_file", "decomposition", "euler", "euler_2000.vtk", "decomposition_1000.vtk", "grid")
PORTABLE = os.path.join(os.path.dirname(vtkgranular.__file__), "portable", "Granular.py")


def files_of(names):
    for name in names:
        path = os.path.join(DATA, "good", name)
        yield from sorted(os.path.join(path, each) for each in os.listdir(path)) if os.path.isdir(path) else [path]


def run(pvpython, plugin, script, *arguments):
    environment = {name: value for name, value in os.environ.items() if name != "PV_PLUGIN_PATH"}
    environment["PYTHONPATH"] = os.pathsep.join([os.path.join(HERE, "site"), environment.get("PYTHONPATH", "")])
    done = subprocess.run([pvpython, os.path.join(HERE, script), plugin, *arguments], env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{script} with {plugin}: {done.stdout[-2000:]}{done.stderr[-4000:]}")


def differences(one, other, place=""):
    """Yields the places at which two values of JSON differ."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in sorted({*one, *other}):
            yield from differences(one.get(key, "missing"), other.get(key, "missing"), f"{place}/{key}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for i, pair in enumerate(zip(one, other)):
            yield from differences(*pair, f"{place}/{i}")
    elif one != other:
        yield f"{place}: {one!r} by the compiled plugin, {other!r} by the portable one"


def compare(pvpython, compiled, files):
    made = [os.path.join(OUTPUT, name) for name in ("compiled", "portable")]
    for folder in made:
        os.makedirs(folder, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        list(pool.map(lambda plugin, folder: run(pvpython, plugin, "outputs.py", folder, *files), (compiled, PORTABLE), made))
    outputs = []
    for folder in made:
        with open(os.path.join(folder, "outputs.json"), encoding="utf-8") as file:
            outputs.append(json.load(file))
    found = list(differences(*outputs))
    names = [sorted(name for name in os.listdir(folder) if name != "outputs.json") for folder in made]
    assert names[0] == names[1] and names[0], names
    for name in names[0]:
        contents = [open(os.path.join(folder, name), "rb").read() for folder in made]
        if contents[0] != contents[1]:
            found.append(f"{name}: {len(contents[0])} bytes by the compiled plugin, {len(contents[1])} by the portable one")
    assert not found, f"{len(found)} differences:\n" + "\n".join(text[:500] for text in found[:20])
    print(f"{len(outputs[0])} settings of {len(files)} files, {len(names[0])} written files")


compare(sys.argv[1], sys.argv[2], sys.argv[3:] or list(files_of(FORMS)))
