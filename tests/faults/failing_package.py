# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that the package makes fails in turn: an exception names the file, a file to write is the old one or the new
one, and the next call is good. Memory is refused where the library asks for it. Every fault must come up for every file."""
import contextlib
import hashlib
import io
import os
import warnings
import zipfile

import granular
from granular.command import main
import failing_calls

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
HERE = os.getcwd()
MADE = os.path.join(HERE, "made.dump")
MOST = 2  # calls of a kind that are tried, where not all are wanted; those of the C interface are in failing_interface.cpp

READERS = {
    "text": ["plain.dump"],
    "binary": ["ortho_scaled.bin"],
    "compressed": ["ortho_000000.dump.gz"],
    "pieces": [f"pieces_1000.{rank}.dump" for rank in range(4)],
    "contacts": ["local/contacts.dump"],
    "data file": ["data_file/full.data"],
    "restart": ["restart/fibres.restart"],
    "Euler cells": ["euler_1000.vtk"],
    "decomposition": ["decomposition_1000.vtk"],
    "decomposition, .vtu": ["decomposition/blocks_raw_zlib.vtu"],
}

WRITERS = {
    "new.dump": "plain.dump",
    "new.bin": "chain.dump",
    "new.dump.gz": "chain.dump",
    "new.dump.zst": "chain.dump",
    "new.bonds": "local/contacts.dump",
    "new.euler": "euler_1000.vtk",
    "new.decomposition": "decomposition_1000.vtk",
}

# Faults that cannot come up, and why.
CANNOT = {
    (".npz", "there are no descriptors"): "Python's own files copy none",
    (".csv", "there are no descriptors"): "Python's own files copy none",
    (".series", "there are no descriptors"): "Python's own files copy none",
}
# Python says it when closing is interrupted: the old file stays
NOT_HARMLESS = {"closing is interrupted"}


def content(path):
    if path.endswith(".npz") and zipfile.is_zipfile(path):  # which has the time of day
        with zipfile.ZipFile(path) as parts:
            return {name: parts.read(name) for name in parts.namelist()}
    with open(path, "rb") as stream:
        return stream.read()


def said(error):
    return f"{type(error).__name__}: {error}"  # the error itself would keep the run


def read(paths):
    """All that the files hold in short, what went wrong, and what was told."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found, error = hashlib.sha256(), None
        try:
            for frame in granular.open(paths):
                found.update(repr((frame.step, list(frame))).encode())
                for name in frame:
                    found.update(frame[name])
        except (granular.Error, OSError, MemoryError) as raised:
            error = said(raised)
    return None if error else found.hexdigest(), error, [str(one.message) for one in told]


def check_reader(name, paths, folder, faults):
    whole = read(paths)
    assert whole[0] and whole[1] is None, (name, whole)
    count = 0
    for one in faults:
        for seen in failing_calls.each(one, folder, lambda: read(paths), whole, MOST):
            count += 1
            found, error, told = seen
            where = (name, one.name, error, told)
            assert seen == whole or not one.harmless, where
            assert found == whole[0] or error is not None or len(told) > len(whole[2]), where
            assert error is None or one.of_memory or folder in error, where
            assert read(paths) == whole, where
    return count


def check_writer(path, write, faults, most_left=1):
    """write() returns the error, or None."""
    ending = os.path.splitext(path)[1]
    return failing_calls.check_writer(path, write, faults, None, lambda error: error, lambda: content(path), MOST, most_left,
                                      lambda one: (ending, one.name) in CANNOT)


def write_by_library(path, frames):
    try:
        granular.write(path, frames)
    except (granular.Error, OSError, MemoryError) as error:
        return said(error)
    return None


def convert(path):
    with contextlib.redirect_stderr(io.StringIO()) as heard:
        status = main(["convert", os.path.join(GOOD, "plain.dump"), path, "--frames", "-1", "--quiet"])
    return heard.getvalue() if status else None


def write_series(path):
    try:
        granular.write_series([os.path.join(GOOD, f"euler_{step}.vtk") for step in (1000, 2000)], 1, path)
    except OSError as error:
        return said(error)
    return None


for name, files in READERS.items():
    faults = failing_calls.READER_FAULTS + failing_calls.MEMORY_FAULTS
    print(check_reader(name, [os.path.join(GOOD, file) for file in files], GOOD, faults), "faults in", name)
with open(MADE, "w") as stream:
    rows = 60000
    stream.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{rows}\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10\nITEM: ATOMS id x y z\n")
    stream.writelines(f"{row + 1} {row % 9} 2 3\n" for row in range(rows))
print(check_reader("many rows", [MADE], HERE, failing_calls.LARGE_FAULTS), "faults in many rows")

for file, source in WRITERS.items():
    path = os.path.join(HERE, file)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        frames = list(granular.open(os.path.join(GOOD, source)))
        faults = failing_calls.WRITER_FAULTS + failing_calls.MEMORY_FAULTS
        print(check_writer(path, lambda: write_by_library(path, frames), faults), "faults in", file)
in_python = [one._replace(harmless=one.harmless and one.name not in NOT_HARMLESS) for one in failing_calls.WRITER_FAULTS]
for file, write in {"new.csv": convert, "new.npz": convert, "new.series": write_series}.items():
    path = os.path.join(HERE, file)
    print(check_writer(path, lambda: write(path), in_python, most_left=3), "faults in", file)
