# SPDX-License-Identifier: BSD-3-Clause
"""Files that the package writes in Python itself, whose program is killed: the old or the new one is whole, and the next write of the
name leaves nothing. Each call of the system by which the library makes a file whole is a moment. The program must have been started with
the library dying_calls in LD_PRELOAD."""
import ctypes
import os
import shutil
import signal

from vtkgranular._whole_file import whole_file, whole_files

OLD = b"old" * 50_000


def content(name):
    with open(name, "rb") as file:
        return file.read()


def one(name):
    with whole_file(name) as temporary, open(temporary, "w") as out:
        out.write("new")


def several(name):
    """As a writer of ParaView, which makes files in a folder of the same name, too."""
    with whole_files(name, lambda file, old: None) as temporary:
        os.mkdir(os.path.splitext(temporary)[0])
        for file in (temporary, os.path.join(os.path.splitext(temporary)[0], "part")):
            with open(file, "w") as out:
                out.write("new")


def check_kills(write, name):
    """Kills the writer of a file at each call, until one comes to its end."""
    with open(name, "w"):
        pass
    expected = sorted(os.listdir("."))
    write(name)
    new, kills, left, status = content(name), 0, 0, signal.SIGKILL
    while status != 0:
        with open(name, "wb") as file:
            file.write(OLD)
        child = os.fork()
        if child == 0:
            ctypes.CDLL(None).granular_die_at_call(ctypes.c_long(kills + 1))
            write(name)
            os._exit(0)
        status = os.waitpid(child, 0)[1]
        assert status in (0, signal.SIGKILL), status
        assert content(name) in (OLD, new), name
        kills += status != 0
        left += any(each.startswith(".granular-") for each in os.listdir("."))
        write(name)
        assert sorted(os.listdir(".")) == expected, (name, os.listdir("."))
    print(f"{name}: killed at each of {kills} calls, {left} left a file")
    assert kills > 20 and left > 5


def check_two_at_once():
    """One that lives keeps its file."""
    with whole_file("two.csv") as outer:
        with whole_file("two.csv") as inner:
            with open(inner, "w") as file:
                file.write("inner")
        assert content("two.csv") == b"inner"
        with open(outer, "w") as file:
            file.write("outer")
    assert content("two.csv") == b"outer"
    assert not [each for each in os.listdir(".") if each.startswith(".granular-")]


def check_child():
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
os.makedirs("killed/b")
os.chdir("killed")
check_two_at_once()
check_child()
check_kills(one, "a.csv")
check_kills(several, "b.pvd")
