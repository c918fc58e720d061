# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that the package makes fails in turn: an exception names the file, a file to write is the old one or the new
one, and the next call is good. Memory is refused where the library asks for it."""
import os
import warnings

import granular
import failing_calls

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good") + "/"
HERE = os.getcwd() + "/"
MOST = 3  # calls of a kind that are tried, where not all are wanted; those of the C interface are in failing_interface.cpp

READERS = {
    "text": ["plain.dump"],
    "binary": ["ortho_scaled.bin"],
    "compressed": ["ortho_000000.dump.gz", "ortho_000050.dump.gz"],
    "pieces": [f"pieces_1000.{rank}.dump" for rank in range(4)],
    "contacts": ["local/contacts.dump"],
    "data file": ["data_file/full.data"],
    "restart": ["restart/fibres.restart"],
    "Euler cells": ["euler_1000.vtk", "euler_2000.vtk"],
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


def content(path):
    with open(path, "rb") as stream:
        return stream.read()


def read(files):
    """All that the files hold, or what went wrong."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            run = granular.open([GOOD + file for file in files])
            found = [(frame.step, {name: frame[name].tobytes() for name in frame}) for frame in run]
        except (granular.Error, OSError, MemoryError) as error:
            return None, f"{type(error).__name__}: {error}", told  # the error itself would keep the run
        return found, None, told


def write(path, frames):
    try:
        granular.write(path, frames)
    except (granular.Error, OSError, MemoryError) as error:
        return f"{type(error).__name__}: {error}"
    return None


faults = 0
for name, files in READERS.items():
    whole, error, _ = read(files)
    assert whole and error is None, (name, error)
    for kinds, fault, number, harmless in failing_calls.READER_FAULTS + failing_calls.MEMORY_FAULTS:
        of_memory = kinds in (failing_calls.MEMORY, failing_calls.MAP)
        for found, error, told in failing_calls.each(kinds, fault, number, GOOD, lambda: read(files), "libgranular" if of_memory else "",
                                                     MOST):
            faults += 1
            assert error is None or not harmless, (name, error)
            assert found == whole or error is not None or told, (name, kinds, fault)
            assert error is None or of_memory or GOOD in error, (name, error)
            found, error, _ = read(files)
            assert found == whole, (name, error)
print(faults, "faults in readers")

warnings.simplefilter("ignore")
faults = 0
for path, source in WRITERS.items():
    frames = list(granular.open(GOOD + source))
    assert write(path, frames) is None
    whole = content(path)
    for kinds, fault, number, harmless in failing_calls.WRITER_FAULTS + failing_calls.MEMORY_FAULTS:
        of_memory = kinds in (failing_calls.MEMORY, failing_calls.MAP)

        def prepare():
            with open(path, "w") as stream:
                stream.write("old")

        for error in failing_calls.each(kinds, fault, number, HERE, lambda: write(path, frames), "libgranular" if of_memory else "",
                                        MOST, prepare):
            faults += 1
            assert error is None or not harmless, (path, error)
            assert error is None or of_memory or path in error, (path, error)
            is_new = error is None or "written, but" in error
            assert content(path) == (whole if is_new else b"old"), (path, error)
            assert not [left for left in os.listdir(HERE) if left.startswith(".granular")], (path, error)
            error = write(path, frames)
            assert error is None and content(path) == whole, (path, error)
print(faults, "faults in writers")
