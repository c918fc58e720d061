# SPDX-License-Identifier: BSD-3-Clause
"""The portable plugin makes what the compiled one makes, and writes the same bytes.

compare.py readers PVPYTHON PLUGIN [FILE...] compares all that outputs.py writes of files with either plugin; without FILEs of one of each
form. compare.py filters PVBATCH PLUGIN MPIEXEC -n compares what filters.py writes, on one to three ranks.
"""
import concurrent.futures
import json
import os
import shutil
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


def run(program, plugin, script, *arguments):
    environment = {name: value for name, value in os.environ.items() if name != "PV_PLUGIN_PATH"}
    environment["PYTHONPATH"] = os.pathsep.join([os.path.join(HERE, "site"), environment.get("PYTHONPATH", "")])
    done = subprocess.run([*program, os.path.join(HERE, script), plugin, *arguments], env=environment, capture_output=True, text=True, check=False)
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


def contents_of(path):
    with open(path, "rb") as file:
        return json.load(file) if path.endswith(".json") else file.read()


def compare(program, compiled, script, arguments, name):
    """Runs a script with either plugin, and compares all files that it writes."""
    made = [os.path.join(OUTPUT, name, which) for which in ("compiled", "portable")]
    for folder in made:
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        list(pool.map(lambda plugin, folder: run(program, plugin, script, folder, *arguments), (compiled, PORTABLE), made))
    names = [sorted(os.listdir(folder)) for folder in made]
    found = [f"written with one plugin alone: {each}" for each in {*names[0]} ^ {*names[1]}]
    for each in sorted({*names[0]} & {*names[1]}):
        one, other = (contents_of(os.path.join(folder, each)) for folder in made)
        if isinstance(one, bytes):
            found += [f"{each}: {len(one)} bytes by the compiled plugin, {len(other)} by the portable one"] if one != other else []
        else:
            found += differences(one, other, each)
    assert names[0] and not found, f"{name}: {len(found)} differences:\n" + "\n".join(text[:500] for text in found[:20])
    print(f"{name}: {len(names[0])} files")


def main(what, program, plugin, *rest):
    if what == "readers":
        compare([program], plugin, "outputs.py", rest or list(files_of(FORMS)), what)
        return
    for ranks, mode in ((1, []), (2, ["--sym"]), (3, [])):
        compare([*rest, str(ranks), program, "--dr", *mode], plugin, "filters.py", [], f"filters_{ranks}{''.join(mode)}")


main(*sys.argv[1:])
