# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts one after another in one pvbatch of several ranks, as these take longer to start than most scripts to run.

in_turn.py OUTPUT TABLE mpirun -n 3 pvbatch ...   runs them, and looks at what each says
in_turn.py OUTPUT TABLE                           that pvbatch: each script in its folder below OUTPUT

A line of the table: the name of the test, the script with its arguments, what it must say or nothing, what it must not say; a tab between
each two. Expressions are those of Python, and `.` is any character.
"""
import gc
import os
import re
import runpy
import subprocess
import sys
import time
import traceback

MARK = "-- script "


def run(output, name, words):
    """Runs a script; what goes wrong is printed, and the next one can run."""
    os.write(2, f"{MARK}{name}\n".encode())  # at once: of several ranks that run the script the lines stay whole
    folder = os.environ["GRANULAR_OUTPUT"] = os.path.join(output, name)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    sys.argv[:] = words.split()
    sys.path[0] = os.path.dirname(sys.argv[0])
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    except BaseException:
        traceback.print_exc()
    from paraview import simple
    for proxy in [*simple.GetRenderViews(), *simple.GetSources().values()]:
        simple.Delete(proxy)
    gc.collect()
    time.sleep(0.2)  # what other ranks said comes by another way than the next mark


def judge(said, name, expected, forbidden):
    """Returns what is wrong with what a script said."""
    found = re.search(forbidden, said)
    if found:
        return f"{name}: said {found.group()!r}"
    if not re.search(expected, said, re.DOTALL):
        return f"{name}: did not say {expected!r}"
    return None


output, table, *command = sys.argv[1:]
with open(table) as file:
    rows = [line.rstrip("\n").split("\t") for line in file]
if command:
    process = subprocess.run([*command, __file__, output, table], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    print(process.stdout, flush=True)
    parts = re.split(rf"{MARK}(\w+)\n", process.stdout)
    said = {}
    for name, text in zip(parts[1::2], parts[2::2]):
        said[name] = said.get(name, "") + text  # of each rank that runs the script
    wrong = [judge(said[name], name, expected, forbidden) if name in said else f"{name}: did not run" for name, _, expected, forbidden in rows]
    wrong += [None if process.returncode == 0 else f"exit status {process.returncode}"]
    sys.exit("\n".join(filter(None, wrong)) or 0)
for name, words, _, _ in rows:
    run(output, name, words)
