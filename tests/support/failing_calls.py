# SPDX-License-Identifier: BSD-3-Clause
"""Makes calls of the system fail in this process, which must have been started with the library failing_calls in LD_PRELOAD. See
failing_calls.h, whose numbers these are, and failing_cases.h, whose faults."""
import ctypes
import errno
import gc
import os
import threading
from typing import NamedTuple

OPEN, STAT, READ, CREATE, WRITE, CLOSE, RENAME, UNLINK, CHANGE, SYNC, MEMORY, _, _, LOCK, COPY = (1 << bit for bit in range(15))
SHORT, INTERRUPTED, END, ERROR = 1, 2, 3, 9
ALWAYS = 2**30

_shim = ctypes.CDLL(None)
_shim.granular_calls_that_may_fail.restype = ctypes.c_long
_shim.granular_live_blocks.restype = ctypes.c_long
_shim.granular_make_fail.argtypes = [ctypes.c_uint, ctypes.c_int, ctypes.c_int, ctypes.c_long, ctypes.c_long, ctypes.c_char_p,
                                     ctypes.c_char_p]


class Fault(NamedTuple):
    """A fault. harmless: nothing may be seen of it. leaves: hidden files that are there after it, of this writer (own) or of one before
    (older)."""
    name: str
    kinds: int
    fault: int = ERROR
    error: int = errno.EIO
    harmless: bool = False
    count: int = 1
    leaves: str = ""

    @property
    def of_memory(self):
        return self.kinds == MEMORY


READER_FAULTS = [
    Fault("a file cannot be opened", OPEN, ERROR, errno.EACCES),
    Fault("opening is interrupted", OPEN, INTERRUPTED, 0, True),
    Fault("a file cannot be asked", STAT),
    Fault("a read fails", READ),
    Fault("a read gives nothing", READ, END, 0),
    Fault("a read gives one byte", READ, SHORT, 0, True),
    Fault("a read is interrupted", READ, INTERRUPTED, 0, True),
    Fault("closing fails", CLOSE, ERROR, errno.EIO, True),
    Fault("closing is interrupted", CLOSE, INTERRUPTED, 0, True),
]
WRITER_FAULTS = [
    Fault("a file cannot be asked", STAT),
    Fault("no file can be made", CREATE, ERROR, errno.ENOSPC),
    Fault("making a file is interrupted", CREATE, INTERRUPTED, 0, True),
    Fault("the disk is full", WRITE, ERROR, errno.ENOSPC),
    Fault("one byte is written", WRITE, SHORT, 0, True),
    Fault("a write is interrupted", WRITE, INTERRUPTED, 0, True),
    Fault("a file cannot be changed", CHANGE, ERROR, errno.EPERM),
    Fault("there are no locks", LOCK, ERROR, errno.ENOLCK, True, ALWAYS),
    Fault("locking is interrupted", LOCK, INTERRUPTED, 0, True),
    Fault("there are no descriptors", COPY, ERROR, errno.EMFILE),
    Fault("closing fails", CLOSE, ERROR, errno.ENOSPC),
    Fault("closing is interrupted", CLOSE, INTERRUPTED, 0, True),
    Fault("renaming fails", RENAME, ERROR, errno.EACCES),
    Fault("renaming and removing fail", RENAME | UNLINK, ERROR, errno.EACCES, False, ALWAYS, "own"),
    Fault("an older file cannot be removed", UNLINK, ERROR, errno.EACCES, True, ALWAYS, "older"),
    Fault("the disk takes nothing", SYNC),
    Fault("waiting for the disk is interrupted", SYNC, INTERRUPTED, 0, True),
]
MEMORY_FAULTS = [Fault("memory is refused", MEMORY, ERROR, errno.ENOMEM)]
LEAVING = Fault("a writer leaves its file", RENAME | UNLINK, ERROR, errno.EACCES, False, ALWAYS)


def _with(one, number, folder, use):
    """Returns what use() returns, and how many calls there were that might fail. The caller's memory is that of our library."""
    caller = b"libgranular" if one.of_memory else b""
    _shim.granular_make_fail(one.kinds, one.fault, one.error, number, one.count, folder.encode(), caller)
    try:
        result = use()
        for thread in threading.enumerate():
            if thread is not threading.current_thread():
                thread.join()  # one that reads ahead
        return result, _shim.granular_calls_that_may_fail()
    finally:
        _shim.granular_make_fail(0, 0, 0, 1, 1, b"", b"")


def leave(folder, use):
    """Calls use(), a writer, which leaves its hidden file behind, as one does that is killed."""
    return _with(LEAVING, 1, folder, use)[0]


def each(one, folder, use, usual, most=0, prepare=lambda: None, memory=True):
    """Calls use() again and again, while one call after the other fails that is of this fault and, if it is of a file, has folder,
    without a slash at its end, in its path. Yields what use() returned, where a call failed.

    usual    what use() returns where no call fails
    most     of more calls only about so many are tried, spread over all
    prepare  called before use(), while nothing fails
    memory   as many blocks are to be there after use() as before
    """
    most = 0 if os.environ.get("GRANULAR_FAULTS") == "all" else most
    number, delivered, fired = 1, 0, True
    gc.collect()
    gc.freeze()  # what was there before need not be looked at again and again
    while fired:
        for _ in range(4):  # something may be kept for good, but not each time
            prepare()
            gc.collect()
            files, blocks = len(os.listdir("/proc/self/fd")), _shim.granular_live_blocks()
            result, made = _with(one, number, folder, use)
            gc.collect()
            grown = memory and _shim.granular_live_blocks() > blocks
            assert len(os.listdir("/proc/self/fd")) == files, (one.name, number, result, "files are left open")
            if not grown:
                break
        assert not grown, (one.name, number, result, "memory is lost")
        fired = number <= made
        if fired:
            delivered += 1
            yield result
        else:
            assert result == usual, (one.name, number, result, "without a fault")
        step = max(1, made // most) if most else 1
        number += 1 if number < min(step, most) else step
    assert delivered > 0, (one.name, "never came up")


def check_writer(path, write, faults, usual, error_in, content, most, most_left=1, memory=True):
    """Makes a writer fail in all these ways. After each, the file is the old one, with an error that names it, or the new one, the writer
    has left hidden files only where none can be removed, and the next write is good. Returns the number of faults.

    write      writes the file, and returns what was said; usual: what that is where nothing fails
    error_in   returns the error among what was said, or None
    content    returns what the file holds
    most       as in each(); most_left: hidden files that may be there where none can be removed
    memory     as in each()
    """
    folder = os.path.dirname(path)

    def hidden():
        return [name for name in os.listdir(folder) if name.startswith(".granular-")]

    def put_old():
        with open(path, "wb") as stream:
            stream.write(b"old")

    def prepare():
        put_old()
        if one.leaves == "older":
            assert error_in(leave(folder, write)) is not None
            put_old()

    put_old()
    old = content()
    assert write() == usual
    whole, faults_made, written_but = content(), 0, 0
    for one in faults:
        for said in each(one, folder, write, usual, most, prepare, memory):
            faults_made += 1
            error = error_in(said)
            where = (path, one.name, said, hidden())
            assert said == usual or not one.harmless, where
            assert error is None or one.of_memory or path in error, where
            is_new = error is None or "written, but" in error
            written_but += is_new and error is not None
            assert content() == (whole if is_new else old), where
            assert bool(one.leaves) <= len(hidden()) <= (most_left if one.leaves else 0), where
            assert write() == usual and content() == whole and not hidden(), (*where, hidden())
        assert content() == whole, (path, one.name, "after the last call, which did not fail")
    assert written_but, (path, "of the folder, which is behind the file")
    return faults_made


def count(kinds, use):
    """How many calls of these kinds use() makes; none of them fails."""
    return _with(Fault("none", kinds, ERROR, 0, False, 1), 2**62, "", use)[1]
