# SPDX-License-Identifier: BSD-3-Clause
"""Makes calls of the system fail in this process, which must have been started with the library failing_calls in LD_PRELOAD. See
failing_calls.h, whose numbers these are."""
import ctypes
import errno
import gc
import os
import threading

OPEN, STAT, READ, CREATE, WRITE, CLOSE, RENAME, UNLINK, CHANGE, SYNC, MEMORY, MAP, THREAD = (1 << bit for bit in range(13))
READING = OPEN | STAT | READ
SHORT, INTERRUPTED, END, ERROR = 1, 2, 3, 9

_shim = ctypes.CDLL(None)
_shim.granular_calls_that_may_fail.restype = ctypes.c_long
_shim.granular_make_fail.argtypes = [ctypes.c_uint, ctypes.c_int, ctypes.c_int, ctypes.c_long, ctypes.c_long, ctypes.c_char_p,
                                     ctypes.c_char_p]


def _fail(kinds, fault, error, number, folder, caller):
    _shim.granular_make_fail(kinds, fault, error, number, 1, folder.encode(), caller.encode())


def each(kinds, fault, error, folder, use, caller="", most=0, prepare=lambda: None):
    """Calls use() again and again, while one call after the other fails that is of these kinds and, if it is of a file, has folder in
    its path. most: of more calls only about so many are tried, spread over all. prepare() comes before use(), while nothing fails. Yields what use() returned, where a call failed."""
    most = 0 if os.environ.get("GRANULAR_FAULTS") == "all" else most
    number = 1
    while True:
        prepare()
        files = len(os.listdir("/proc/self/fd"))
        _fail(kinds, fault, error, number, folder, caller)
        try:
            result = use()
            for thread in threading.enumerate():
                if thread is not threading.current_thread():
                    thread.join()  # one that reads ahead
        finally:
            made = _shim.granular_calls_that_may_fail()
            _fail(0, 0, 0, 1, "", "")
        gc.collect()
        assert len(os.listdir("/proc/self/fd")) == files, (kinds, fault, number, result, "files are left open")
        if made < number:
            return
        yield result
        step = max(1, made // most) if most else 1
        number += 1 if number < min(step, most) else step


# kinds, fault, error, and whether nothing may be seen of it
READER_FAULTS = [(READING, ERROR, errno.EIO, False), (READ, END, 0, False), (READ, SHORT, 0, True),
                 (OPEN | READ, INTERRUPTED, 0, True), (CLOSE, ERROR, errno.EIO, True)]
WRITER_FAULTS = [(STAT, ERROR, errno.EIO, False), (CREATE, ERROR, errno.ENOSPC, False), (WRITE, ERROR, errno.ENOSPC, False),
                 (WRITE, SHORT, 0, True), (CREATE | WRITE | CLOSE, INTERRUPTED, 0, True), (CLOSE, ERROR, errno.EIO, False),
                 (RENAME, ERROR, errno.EACCES, False), (SYNC, ERROR, errno.EIO, False)]
MEMORY_FAULTS = [(MEMORY, ERROR, errno.ENOMEM, False), (MAP, ERROR, errno.ENOMEM, False)]


def count(kinds, use):
    """How many calls of these kinds use() makes; none of them fails."""
    _shim.granular_make_fail(kinds, ERROR, 0, 2**62, 1, b"", b"")
    use()
    made = _shim.granular_calls_that_may_fail()
    _fail(0, 0, 0, 1, "", "")
    return made
