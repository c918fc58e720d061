# SPDX-License-Identifier: BSD-3-Clause
"""Files that the package writes in Python itself, whose program is killed: the old or the new one is whole, and the next write of the
name leaves nothing. Each call of the system that makes a file whole is a moment. Argument: the number of random moments."""
import os
import random
import shutil
import signal
import sys
import time

import granular
from granular.command import main
from granular import _whole_file
from granular._whole_file import whole_file, whole_files

GRAINS = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
OLD = b"old" * 50_000


def content(name):
    with open(name, "rb") as file:
        return file.read()


def convert(name):
    assert main(["convert", GRAINS, name, "--frames", "-1", "--quiet"]) == 0


def series(name):
    granular.write_series([f"step_{i}.vtk" for i in range(200)], 1, name)


def several(name):
    """As a writer of ParaView, which makes files in a folder of the same name, too."""
    with whole_files(name, lambda file, old: None) as temporary:
        os.mkdir(os.path.splitext(temporary)[0])
        for file in (temporary, os.path.join(os.path.splitext(temporary)[0], "part")):
            with open(file, "w") as out:
                out.write("new")


def die_at_call(number):
    """This process is killed before the call of this number, counted from 1, with which the package makes a file whole."""
    left = [number]

    def look(frame, event, called):
        if event == "c_call" and called.__module__ in ("posix", "fcntl") and frame.f_code.co_filename == _whole_file.__file__:
            left[0] -= 1
            if left[0] == 0:
                os.kill(os.getpid(), signal.SIGKILL)

    sys.setprofile(look)


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


class Killed:
    """A file, and how often its writer was killed and left hidden files."""

    def __init__(self, write, name):
        with open(name, "w"):
            pass
        self.all = sorted(os.listdir("."))
        write(name)
        self.write, self.name, self.new = write, name, content(name)
        self.killed = self.left = 0

    def try_once(self, work, seconds=None):
        """Works in a process of its own, and checks what is left. Returns whether it was killed."""
        with open(self.name, "wb") as file:
            file.write(OLD)
        died, _ = in_child(work, seconds)
        now = content(self.name)
        assert len(now) in (len(OLD), len(self.new)), self.name
        assert now in (OLD, self.new) or self.name.endswith(".npz"), self.name  # an archive knows the time
        self.killed += died
        self.left += any(each.startswith(".granular-") for each in os.listdir("."))
        self.write(self.name)
        assert sorted(os.listdir(".")) == self.all, (self.name, os.listdir("."))
        return died

    def at_each_call(self):
        def work():
            die_at_call(self.killed + 1)
            self.write(self.name)

        while self.try_once(work):
            pass
        print(f"{self.name}: killed at each of {self.killed} calls, {self.left} left a file")
        assert self.killed > 20 and self.left > 5

    def at_random_moments(self, tries, chosen):
        _, took = in_child(lambda: self.write(self.name))
        for _ in range(tries):
            self.try_once(lambda: self.write(self.name), chosen.uniform(0, took))
        print(f"{self.name}: killed at {self.killed} of {tries} moments, {self.left} left a file")


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


def child_leaves():
    """A child that leaves the block has no part in the file."""
    try:
        with whole_file("one.csv") as name:
            child = os.fork()
            if child == 0:
                raise KeyboardInterrupt
            assert os.waitpid(child, 0)[1] == 0
            with open(name, "r+") as file:
                file.write("parent")
    except KeyboardInterrupt:
        os._exit(0)
    assert content("one.csv") == b"parent"


shutil.rmtree("killed", ignore_errors=True)
os.mkdir("killed")
os.chdir("killed")
two_at_once()
child_leaves()
kills = int(sys.argv[1])
chosen = random.Random(int(os.environ.get("GRANULAR_SEED", "1")))
for i in range(200):
    with open(f"step_{i}.vtk", "w"):
        pass
Killed(series, "a.series").at_each_call()
os.mkdir("b")
Killed(several, "b.pvd").at_each_call()
files = [Killed(convert, "a.npz"), Killed(convert, "a.csv"), Killed(series, "a.series")]
for file in files:
    file.all = sorted(os.listdir("."))
for _ in range(10):
    for file in files:
        file.at_random_moments(kills // 3, chosen)
    if any(file.killed for file in files):
        break
else:
    raise AssertionError("none was killed")
