# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts one after another in one pvbatch of several ranks, as these take longer to start than most scripts to run.

in_turn.py OUTPUT TABLE mpirun -n 3 pvbatch ...   runs them, and looks at what each says
in_turn.py OUTPUT TABLE                           that pvbatch: each script in its folder below OUTPUT

A line of the table: the name of the test, the script with its arguments, what it must say or nothing, what it must not say; a tab between
each two. Expressions are those of Python, and `.` is any character. What a rank says while a script runs goes into a file of that rank
beside the table's, <name>.<number of its process>, as lines of several ranks would mix.
"""
import gc
import glob
import os
import re
import runpy
import subprocess
import sys
import traceback

# Executed by each rank before a script, also by those that do not run the script but write files of their own.
ENTER = """
import os, sys
os.chdir({folder!r})
sys.stdout.flush()
said = os.open({path!r} + f".{{os.getpid()}}", os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
os.dup2(said, 1)
os.dup2(said, 2)
os.close(said)
"""


def run(simple, output, said, name, words):
    """Runs a script; what goes wrong is printed, and the next one can run."""
    folder = os.environ["GRANULAR_OUTPUT"] = os.path.join(output, name)
    os.makedirs(folder, exist_ok=True)
    simple.ProgrammableSource(Script=ENTER.format(folder=folder, path=os.path.join(said, name))).UpdatePipeline()
    sys.argv[:] = words.split()
    sys.path[0] = os.path.dirname(sys.argv[0])
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    except BaseException:
        traceback.print_exc()
    for proxy in [*simple.GetRenderViews(), *simple.GetSources().values()]:
        simple.Delete(proxy)
    gc.collect()


def take(said, name):
    """Returns what all ranks said while a script ran, or None if it did not run, and forgets it."""
    texts = []
    for path in glob.glob(os.path.join(said, name + ".*")):
        with open(path, errors="replace") as file:
            texts.append(file.read())
        os.remove(path)
    return "".join(texts) if texts else None


def judge(said, name, expected, forbidden):
    """Returns what is wrong with what a script said, and the whole of it."""
    if said is None:
        return f"{name}: did not run"
    found = re.search(forbidden, said)
    if found:
        return f"{name}: said {found.group()!r}, in\n{said}"
    if not re.search(expected, said, re.DOTALL):
        return f"{name}: did not say {expected!r}, but\n{said}"
    return None


def run_and_judge(output, table, said, rows, command):
    """Returns what is wrong with the scripts, or 0."""
    for name, _, _, _ in rows:
        take(said, name)
    status = subprocess.run([*command, __file__, output, table]).returncode
    wrong = [judge(take(said, name), name, expected, forbidden) for name, _, expected, forbidden in rows]
    wrong += [None if status == 0 else f"exit status {status}"]
    return "\n".join(filter(None, wrong)) or 0


def main(output, table, *command):
    with open(table) as file:
        rows = [line.rstrip("\n").split("\t") for line in file]
    said = os.path.splitext(table)[0]
    if command:
        sys.exit(run_and_judge(output, table, said, rows, command))
    from paraview import simple
    for name, words, _, _ in rows:
        run(simple, output, said, name, words)


main(*sys.argv[1:])
