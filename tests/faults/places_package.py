# SPDX-License-Identifier: BSD-3-Clause
"""Strange names and places for the package and the command."""
import contextlib
import io
import os
import shutil
import socket
import warnings

import command

import vtkgranular as vg
from vtkgranular.command import main

warnings.simplefilter("ignore")
PARTICLES = os.path.join(command.GOOD, "grains_1000.dump")
NAMES = {"a b": "a b", "quote'\"": "quote'\"", "new\nline": r"new\nline", "tab\t\x1b[31m": r"tab\t\x1b[31m", "back\\slash": "back\\slash",
         "per%cent%d": "per%cent%d", "st*r": "st*r", "b[r]a?k": "b[r]a?k", "-dash": "-dash", "\u00e4\u20ac\U0001f600": "\u00e4\u20ac\U0001f600",
         os.fsdecode(b"\xff\xfe"): r"\xff\xfe", "n" * 240: "n" * 240}
shutil.rmtree("files", ignore_errors=True)
os.mkdir("files")
os.chdir("files")
HERE = os.getcwd()


def expect_error(kind, call, *words):
    try:
        call()
    except kind as error:
        text = str(error)
        assert all(word in text for word in words) and "\n" not in text and text.encode(), text
    else:
        raise AssertionError(f"expected {kind} with {words}")


def convert(*arguments, status=0):
    """What the command said, in this process."""
    with contextlib.redirect_stderr(io.StringIO()) as heard:
        assert main(["convert", "--quiet", *arguments]) == status, heard.getvalue()
    return heard.getvalue()


# ---- names --------------------------------------------------------------------------------------
plain = vg.open(PARTICLES)[0].read()
for name, shown in NAMES.items():
    file = name + ".dump"
    os.mkdir(name)
    for path in (file, os.path.join(name, file)):
        shutil.copy(PARTICLES, path)
        for spelled in (path, os.fsencode(path), os.path.abspath(path)):
            assert (vg.open(spelled)[0]["id"] == plain["id"]).all()
    assert vg.files(os.path.join(name, "*.dump")) == [os.path.join(HERE, name, file)]
    expect_error(vg.Error, lambda: vg.open(file, kind="restart"), os.path.join(HERE, shown + ".dump"))  # noqa: B023
    expect_error(FileNotFoundError, lambda: vg.open(name + ".none"), shown + ".none")  # noqa: B023
    if "*" not in name and "%" not in name:
        os.remove(file)
        vg.write(file, plain)
        assert command.content(file) == command.content(PARTICLES), name
    with open(name + ".log", "w") as log:
        log.write("nothing\n")
    expect_error(vg.Error, lambda: vg.read_log(name + ".log"), shown + ".log")  # noqa: B023
    shutil.copy(PARTICLES, name + "_7.stl")
    if "\udcff" in name:
        expect_error(ValueError, lambda: vg.write_series([name + "_7.stl"], 1, path="no.series"), "UTF-8", shown)  # noqa: B023
    else:
        assert os.path.exists(vg.write_series([name + "_7.stl"], 1)), name
for call in (vg.open, vg.files, lambda path: vg.write(path, plain)):
    expect_error(ValueError, lambda: call("nul\0.dump"), "null")  # noqa: B023
for name in ("new\nline", os.fsdecode(b"\xff\xfe"), "-dash", "st*r"):
    shutil.copy(PARTICLES, name + ".dump")
    convert("--", name + ".dump", name + ".csv")
    assert os.path.exists(name.replace("*", "1000") + ".csv"), os.listdir(".")
for name in ("new\nline", os.fsdecode(b"\xff\xfe")):
    out, said = command.granular("check", "--", name + ".dump", env={**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0"})
    assert out == NAMES[name] + ".dump: 1 frames, 1200 rows, nothing is wrong\n" and not said, (name, out, said)

# ---- no files -----------------------------------------------------------------------------------
os.mkdir("places")
os.chdir("places")
os.mkfifo("pipe")
os.mkdir("folder")
bound = socket.socket(socket.AF_UNIX)
bound.bind("socket")
for target, link in (("pipe", "to_pipe"), ("folder", "to_folder"), ("loop", "loop"), ("none", "dangling")):
    os.symlink(target, link)
DEVICE, FOLDER = "expected a file, got a device or a pipe", "expected a file, got a directory: name the files in it"
for place, why in {"pipe": DEVICE, "to_pipe": DEVICE, "socket": DEVICE, "/dev/null": DEVICE, "/dev/zero": DEVICE, "/dev/full": DEVICE,
                   "folder": FOLDER, "folder/": FOLDER, "to_folder": FOLDER, "loop": "Too many levels", "dangling": "No such file"}.items():
    if why == FOLDER:
        assert not list(vg.open(place))  # the files of a run, of which there are none
    else:
        expect_error(OSError, lambda: vg.open(place), why)  # noqa: B023
    expect_error(OSError, lambda: vg.files(place), why)  # noqa: B023
os.symlink("pipe", "out.csv")  # what is written in Python; for dumps, tests/bytes
assert "out.csv" in convert(PARTICLES, "out.csv", status=1)
assert os.path.islink("out.csv")
print("all places were tried")
