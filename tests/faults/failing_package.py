# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that the package makes fails in turn, for a reader, for a writer of the library, and for the files that are
written in Python: an exception names the file, a file to write is the old one or the new one, and the next call is good. Then the calls
that wait for the disk are counted. Memory is refused where the library asks for it."""
import contextlib
import hashlib
import io
import os
import warnings

import vtkgranular as vg
from vtkgranular.command import main
import failing_calls

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
PLAIN = os.path.join(GOOD, "plain.dump")
HERE = os.getcwd()
MOST = 2  # calls of a kind that are tried, where not all are wanted; those of the library are in failing_interface.cpp


def content(path):
    with open(path, "rb") as stream:
        return stream.read()


def said(error):
    return f"{type(error).__name__}: {error}"  # the error itself would keep the run


def read():
    """All that the file holds in short, what went wrong, and what was told."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        found, error = hashlib.sha256(), None
        try:
            for frame in vg.open(PLAIN):
                found.update(repr((frame.step, list(frame))).encode())
                for name in frame:
                    found.update(frame[name])
        except (vg.Error, OSError, MemoryError) as raised:
            error = said(raised)
    return None if error else found.hexdigest(), error, [str(one.message) for one in told]


def check_reader():
    whole = read()
    assert whole[0] and whole[1] is None, whole
    count = 0
    for one in failing_calls.READER_FAULTS + failing_calls.MEMORY_FAULTS:
        for seen in failing_calls.each(one, GOOD, read, whole, MOST):
            count += 1
            found, error, told = seen
            assert seen == whole or not one.harmless, (one.name, seen)
            assert found == whole[0] or error is not None or len(told) > len(whole[2]), (one.name, seen)
            assert error is None or one.of_memory or GOOD in error, (one.name, seen)
            assert read() == whole, (one.name, seen)
    print(count, "faults in a reader")


def check_writer(name, write, faults, most_left=1):
    """write(path) returns the error, or None."""
    path = os.path.join(HERE, name)
    count = failing_calls.check_writer(path, lambda: write(path), faults, None, lambda error: error, lambda: content(path), MOST, most_left)
    print(count, "faults in", name)


def write_by_library(path):
    try:
        vg.write(path, frames)
    except (vg.Error, OSError, MemoryError) as error:
        return said(error)
    return None


def convert(path, *options):
    with contextlib.redirect_stderr(io.StringIO()) as heard:
        status = main(["convert", PLAIN, path, "--quiet", *options])
    return heard.getvalue() if status else None


def convert_last(path):
    return convert(path, "--frames", "-1")


def check_durable():
    """Two calls wait for the disk for each of three frames: for the bytes of the file, and for its name."""
    assert failing_calls.count(failing_calls.SYNC, lambda: vg.write("one.dump", frames, durable=False)) == 0
    for path, options, expected in (("one.csv", ["--frames", "0"], 2), ("one.csv", ["--frames", "0", "--durable", "off"], 0),
                                    ("many_*.csv", [], 0), ("many_*.bin", ["--durable", "on"], 6)):
        made = failing_calls.count(failing_calls.SYNC, lambda: convert(path, *options))
        assert made == expected, (path, options, made)


check_reader()
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    frames = list(vg.open(PLAIN))
    assert len(frames) == 3
    check_writer("new.dump", write_by_library, failing_calls.WRITER_FAULTS + failing_calls.MEMORY_FAULTS)
    # Python says it when closing is interrupted: the old file stays
    in_python = [one._replace(harmless=one.harmless and one.name != "closing is interrupted") for one in failing_calls.WRITER_FAULTS]
    check_writer("new.csv", convert_last, in_python, most_left=3)
    check_durable()
