# SPDX-License-Identifier: BSD-3-Clause
"""Files that the package writes in Python itself, whose program is killed: the old or the new one is whole, and the next write of the
name leaves nothing. Argument: the number of kills."""
import os
import random
import shutil
import signal
import sys
import time

import granular
from granular.command import main
from granular._whole_file import whole_file

GRAINS = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
OLD = b"old" * 50_000


def content(name):
    with open(name, "rb") as file:
        return file.read()


def convert(name):
    assert main(["convert", GRAINS, name, "--frames", "-1", "--quiet"]) == 0


def series(name):
    granular.write_series([f"step_{i}.vtk" for i in range(200)], 1, name)


def in_child(work, seconds=None):
    """Works in a process of its own, which is killed after some time. Returns whether it was killed, and the time that it took."""
    child = os.fork()
    if child == 0:
        work()
        os._exit(0)
    begin = time.monotonic()
    if seconds is not None:
        time.sleep(seconds)
        os.kill(child, signal.SIGKILL)
    status = os.waitpid(child, 0)[1]
    assert status in (0, signal.SIGKILL), status
    return status != 0, time.monotonic() - begin


def check(write, name, kills, chosen):
    write(name)
    new = content(name)
    _, took = in_child(lambda: write(name))
    killed = left = 0
    while killed < kills:
        with open(name, "wb") as file:
            file.write(OLD)
        died, _ = in_child(lambda: write(name), chosen.uniform(0, took))
        killed += died
        assert len(content(name)) in (len(OLD), len(new)), name
        assert content(name) == OLD or name.endswith(".npz") or content(name) == new, name  # an archive knows the time
        names = [each for each in os.listdir(".") if each.startswith(".granular-")]
        left += bool(names)
        write(name)
        assert sorted(os.listdir(".")) == before, (name, os.listdir("."))
    print(f"{name}: killed {killed} times, {left} left a file")
    return left


def two_at_once():
    """One that lives keeps its file."""
    with whole_file("two.csv", ".csv") as outer:
        with whole_file("two.csv", ".csv") as inner:
            with open(inner, "w") as file:
                file.write("inner")
        assert content("two.csv") == b"inner"
        with open(outer, "w") as file:
            file.write("outer")
    assert content("two.csv") == b"outer"
    assert not [each for each in os.listdir(".") if each.startswith(".granular-")]


shutil.rmtree("killed", ignore_errors=True)
os.mkdir("killed")
os.chdir("killed")
two_at_once()
kills = int(sys.argv[1])
chosen = random.Random(int(os.environ.get("GRANULAR_SEED", "1")))
for i in range(200):
    with open(f"step_{i}.vtk", "w"):
        pass
left = 0
for write, name in ((convert, "a.npz"), (convert, "a.csv"), (series, "a.series")):
    with open(name, "w"):
        pass
    before = sorted(os.listdir("."))
    left += check(write, name, kills // 3, chosen)
assert left > 0
