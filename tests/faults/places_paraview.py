# SPDX-License-Identifier: BSD-3-Clause
"""Strange names and places in ParaView: readers, writers, state files and traces."""
import os
import shutil
import socket

from paraview import smtrace
from paraview.simple import *

import vtkgranular as vg

SOURCE = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")
ROWS = 1200
NAMES = {"a b": "a b", "quote'\"&<>": "quote'\"&<>", "new\nline": r"new\nline", "tab\there": r"tab\there", "back\\slash": "back\\slash",
         "per%cent%d": "per%cent%d", "st*r": "st*r", "b[r]a?k": "b[r]a?k", "-dash": "-dash", "\u00e4\u20ac\U0001f600": "\u00e4\u20ac\U0001f600",
         "n" * 240: "n" * 240}
shutil.rmtree("files", ignore_errors=True)
os.mkdir("files")
os.chdir("files")
HERE = os.getcwd()


def expect_error(kind, call, *words):
    try:
        call()
    except kind as error:
        assert all(word in str(error) for word in words) and "\n" not in str(error), error
    else:
        raise AssertionError(f"expected {kind} with {words}")


def expect_shown(path):
    """Expects one source, which reads this file."""
    source, = GetSources().values()
    assert list(source.FileNames) == [path], (source.FileNames, path)
    source.UpdatePipeline()
    assert source.GetDataInformation().GetNumberOfPoints() == ROWS
    return source


def delete_all():
    for each in list(GetSources().values()):
        Delete(each)


# ---- names ---------------------------------------------------------------------------------------
for name, shown in NAMES.items():
    path, state, before = os.path.join(HERE, name + ".dump"), os.path.join(HERE, name + ".pvsm"), set(os.listdir("."))
    shutil.copy(SOURCE, path)
    vg.reader(path)
    SaveState(state)
    delete_all()
    vg.load_state(state)
    vg.save(expect_shown(path), os.path.join(HERE, "out_" + name[:230] + ".dump"))
    written, = set(os.listdir(".")) - before - {name + ".dump", name + ".pvsm"}
    assert written == f"out_{name[:230]}.dump" or "*" in name or "%" in name  # the timestep and the rank
    with open(written, "rb") as stream:
        assert stream.read().startswith(b"ITEM: TIMESTEP")
    delete_all()
    smtrace.start_trace()
    OpenDataFile(path)
    trace = smtrace.stop_trace()
    delete_all()
    exec(trace)  # noqa: S102
    expect_shown(path)
    delete_all()
    os.truncate(path, 7)
    expect_error(RuntimeError, lambda: vg.reader(path), os.path.join(HERE, shown + ".dump: "))  # noqa: B023
    delete_all()
    for each in (path, state, written):
        os.remove(each)
opened = vg.reader(SOURCE)
odd = os.fsencode(HERE) + b"/\xff\xfe.dump"  # not UTF-8
shutil.copy(SOURCE, odd)
for call in (lambda: vg.reader(odd), lambda: vg.save(opened, odd), lambda: vg.load_state(odd)):
    expect_error(ValueError, call, "UTF-8", r"\xff\xfe.dump")
os.remove(odd)

# ---- no files ------------------------------------------------------------------------------------
os.mkfifo("pipe")
os.mkdir("folder")
socket.socket(socket.AF_UNIX).bind("socket")
DEVICE, FOLDER = "expected a file, got a device or a pipe", "expected a file, got a directory: name the files in it"
for place, why in {"pipe": DEVICE, "folder": FOLDER, "socket": "cannot open: ", "/dev/null": DEVICE, "/dev/zero": DEVICE}.items():
    expect_error(RuntimeError, lambda: vg.reader(os.path.join(HERE, place)), why)  # noqa: B023
    os.symlink(place, "link.dump")
    expect_error(RuntimeError, lambda: vg.save(opened, os.path.join(HERE, "link.dump")), "link.dump: cannot write: ")
    os.remove("link.dump")
assert sorted(os.listdir(".")) == ["folder", "pipe", "socket"] and not os.listdir("folder"), os.listdir(".")
print("all places were tried")
