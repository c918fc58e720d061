# SPDX-License-Identifier: BSD-3-Clause
"""Strange places and names in ParaView: readers, writers, state files and traces; decimal commas."""
import ctypes
import locale
import os
import shutil
import socket
import subprocess

from paraview import smtrace
from paraview.simple import *
from said import said_by

import granular

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
KINDS = {"Dump": ("grains_1000", ".dump"), "Local": ("local/contacts", ".dump"), "Restart": ("restart/style_sphere", ".restart"),
         "DataFile": ("data_file/granular", ".data"), "Euler": ("euler_1000", ".vtk"), "Decomposition": ("decomposition_1000", ".vtk")}
NAMES = {"a b": "a b", "quote'\"&<>": "quote'\"&<>", "new\nline": r"new\nline", "tab\there": r"tab\there", "back\\slash": "back\\slash",
         "per%cent%d": "per%cent%d", "st*r": "st*r", "b[r]a?k": "b[r]a?k", "-dash": "-dash", "\u00e4\u20ac\U0001f600": "\u00e4\u20ac\U0001f600",
         "n" * 240: "n" * 240}
shutil.rmtree("files", ignore_errors=True)
os.mkdir("files")
os.chdir("files")
HERE = os.getcwd()


def source(kind):
    return os.path.join(GOOD, "".join(KINDS[kind]))


def raises(kind, call, *words):
    try:
        call()
    except Exception as error:  # noqa: BLE001
        assert isinstance(error, kind) and all(word in str(error) for word in words) and "\n" not in str(error), (type(error), error)
        return
    raise AssertionError(f"expected {kind} with {words}")


def reader(kind, *paths):
    """An object of VTK, and what it says."""
    made = getattr(granular, f"vtkGranular{kind}Reader")()
    for path in paths:
        made.AddFileName(path)
    return made, said_by(made)


def rows(data):
    return [data.GetNumberOfElements(kind) for kind in range(7)]


def content(path):
    with open(path, "rb") as stream:
        return stream.read()


def delete_all():
    for each in list(GetSources().values()):
        Delete(each)


# ---- names: every reader, what it says -----------------------------------------------------------
plain = {}
for kind in KINDS:
    made, said = reader(kind, source(kind))
    made.Update()
    plain[kind] = rows(made.GetOutputDataObject(0)), made.GetErrorCode()
    assert sum(plain[kind][0]) > 0 and plain[kind][1] == 0
for name, shown in NAMES.items():
    for kind, (_, ending) in KINDS.items():
        os.mkdir(name)
        path = os.path.join(HERE, name, name + ending)
        shutil.copy(source(kind), path)
        for spelled in (path, path.encode()):
            made, said = reader(kind, spelled)
            made.Update()
            assert (rows(made.GetOutputDataObject(0)), made.GetErrorCode()) == plain[kind], (name, kind)
            assert all(shown in text and (shown == name or name not in text) for text in said), said
        os.truncate(path, 7)
        made, said = reader(kind, path)
        made.Update()
        message = made.GetErrorMessage()
        assert message.startswith(os.path.join(HERE, shown, shown + ending)) and "\n" not in message, message
        shutil.rmtree(name)
odd = os.fsencode(HERE) + b"/\xff\xfe.dump"  # not UTF-8: classes take bytes, what goes through proxies cannot
shutil.copy(source("Dump"), odd)
made, said = reader("Dump", odd)
made.Update()
assert rows(made.GetOutputDataObject(0)) == plain["Dump"][0]
for call in (lambda: granular.reader(odd), lambda: granular.save(granular.reader(source("Dump")), odd), lambda: granular.load_state(odd)):
    raises(ValueError, call, "UTF-8", r"\xff\xfe.dump")
delete_all()
os.remove(odd)
made, said = reader("Dump", odd)
made.Update()
assert made.GetErrorMessage() == HERE + r"/\xff\xfe.dump: cannot open: No such file or directory", made.GetErrorMessage()

# ---- names: proxies, writers, state files and traces ----------------------------------------------
for name in NAMES:
    path = os.path.join(HERE, name + ".dump")
    shutil.copy(source("Dump"), path)
    opened = granular.reader(path)
    opened.UpdatePipeline()
    assert opened.GetDataInformation().GetNumberOfPoints() == 1200
    state = os.path.join(HERE, name + ".pvsm")
    SaveState(state)
    delete_all()
    granular.load_state(state)
    loaded, = GetSources().values()
    assert list(loaded.FileNames) == [path], (loaded.FileNames, path)
    loaded.UpdatePipeline()
    assert loaded.GetDataInformation().GetNumberOfPoints() == 1200
    out = os.path.join(HERE, "out_" + name)[:len(HERE) + 240]
    before = set(os.listdir(HERE))
    granular.save(loaded, out + ".dump")
    written, = set(os.listdir(HERE)) - before
    assert written == os.path.basename(out) + ".dump" or "*" in name or "%" in name  # the timestep and the rank
    assert content(written).startswith(b"ITEM: TIMESTEP")
    delete_all()
    smtrace.start_trace()
    OpenDataFile(path)
    trace = smtrace.stop_trace()
    delete_all()
    exec(trace)  # noqa: S102
    traced, = GetSources().values()
    assert list(traced.FileNames) == [path], (traced.FileNames, trace)
    delete_all()
    for each in (path, state, written):
        os.remove(each)

# ---- what is no file -----------------------------------------------------------------------------
os.mkfifo("pipe")
os.mkdir("folder")
socket.socket(socket.AF_UNIX).bind("socket")
DEVICE, FOLDER = "expected a file, got a device or a pipe", "expected a file, got a directory"
REFUSED = {"pipe": DEVICE, "folder": FOLDER, "socket": "cannot open: ", "/dev/null": DEVICE, "/dev/zero": DEVICE}
for place, why in REFUSED.items():
    path = os.path.join(HERE, place)
    for kind in KINDS:
        assert not getattr(granular, f"vtkGranular{kind}Reader")().CanReadFile(path), (kind, place)
        made, said = reader(kind, path)
        made.Update()
        assert made.GetErrorMessage().startswith(f"{path}: {why}"), made.GetErrorMessage()
    raises(RuntimeError, lambda: granular.reader(path), why)  # noqa: B023
opened = {kind: granular.reader(source(kind)) for kind in ("Dump", "Local", "Euler", "Decomposition")}
ENDINGS = {"Dump": (".dump", ".bin"), "Local": (".bonds",), "Euler": (".euler",), "Decomposition": (".decomposition", ".vtu")}
for place in ("pipe", "folder", "socket", "/dev/full", "none/none"):
    for kind, endings in ENDINGS.items():
        for ending in endings:
            os.symlink(place, "link" + ending)
            raises(RuntimeError, lambda: granular.save(opened[kind], os.path.join(HERE, "link" + ending)),  # noqa: B023
                   f"link{ending}: cannot write: ")
            os.remove("link" + ending)
assert sorted(os.listdir(".")) == ["folder", "pipe", "socket"] and not os.listdir("folder"), os.listdir(".")

# ---- decimal commas ------------------------------------------------------------------------------
for kind, endings in ENDINGS.items():
    for ending in endings:
        granular.save(opened[kind], os.path.join(HERE, "points" + ending))
try:
    made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", "./de_DE.UTF-8"]).returncode in (0, 1)
except FileNotFoundError:
    made = False
if made and os.path.isdir("de_DE.UTF-8"):
    os.environ["LOCPATH"] = HERE
    locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
    text = ctypes.create_string_buffer(20)
    ctypes.CDLL(None).snprintf(text, 20, b"%.1f", ctypes.c_double(0.5))
    assert text.value == b"0,5"
    for kind, endings in ENDINGS.items():
        again = granular.reader(source(kind))
        for ending in endings:
            granular.save(again, os.path.join(HERE, "commas" + ending))
            assert content("commas" + ending) == content("points" + ending), ending
    for kind in KINDS:
        made, said = reader(kind, source(kind))
        made.Update()
        assert (rows(made.GetOutputDataObject(0)), made.GetErrorCode()) == plain[kind], kind
    locale.setlocale(locale.LC_ALL, "C")
delete_all()

print("all places were tried")
