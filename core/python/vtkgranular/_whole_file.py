# SPDX-License-Identifier: BSD-3-Clause
"""Files that appear when they are complete, and are written by Python or VTK: see granular_begin_file in granular.h."""
from __future__ import annotations

import contextlib
import errno
import os
import shutil
from typing import Any, Callable, Iterator

from . import _library as c


@contextlib.contextmanager
def _begun(path: str) -> Iterator[tuple[Any, str]]:
    """Yields a file of the library, and the name to write to. Removes at the end what has this name. Errors name the path."""
    library, file = c.library(), c.c_void_p()
    library.granular_begin_file(c.name_bytes(path), c.byref(file))
    name = c.text(library.granular_file_name(file))
    try:
        yield file, name
    except OSError as error:
        if error.errno is None or error.filename not in (None, name):
            raise  # of another file
        raise OSError(error.errno, error.strerror, path) from error  # the user knows the path, and not the hidden name
    finally:
        library.granular_close_file(file)


def _finish(files: list[Any], durable: bool) -> None:
    c.library().granular_finish_files((c.c_void_p * len(files))(*files), len(files), durable)


@contextlib.contextmanager
def whole_file(path: str, durable: bool = True) -> Iterator[str]:
    """Yields the name of a temporary file beside a path. It replaces the old file at the end, and is removed after an error.

    A symbolic link stays, and so do the permissions, owner and group of the old file. Raises OSError where they cannot, and for what
    is not a regular file.

    durable  the file is on the disk before it gets its name
    """
    with _begun(path) as (file, name):
        yield name
        _finish([file], durable)


def _move(file: str, to: str) -> None:
    """Puts a file in the place of an empty one, behind a link to another file system as well."""
    shutil.copymode(to, file)  # who may not read the old file may not read this one
    try:
        os.replace(file, to)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        shutil.copyfile(file, to)


@contextlib.contextmanager
def whole_files(path: str, expect: Callable[[str, str], None]) -> Iterator[str]:
    """Yields a name for a path in a temporary folder beside it, for programs that write several files. At the end, what is in the
    folder replaces the files of the same names beside the path, the path's own file last. After an error the old files stay.

    expect  is called with each new file, and the file that it will replace, before the first one is replaced; it may raise

    Links, permissions and owners stay as in whole_file. One file is on the disk before it gets its name.
    """
    beside, own = os.path.split(path)
    process = os.getpid()
    with contextlib.ExitStack() as begun:
        _, name = begun.enter_context(_begun(path))
        folder = name + ".files"

        def leave() -> None:
            if os.getpid() == process:  # a child has a copy of all this
                shutil.rmtree(folder, ignore_errors=True)

        leave()
        os.mkdir(folder, 0o700)
        begun.callback(leave)
        yield os.path.join(folder, own)
        if os.getpid() != process:
            raise PermissionError(errno.EPERM, "expected the process that began the files, got a child of it", path)
        names = [os.path.relpath(os.path.join(place, name), folder) for place, _, inside in os.walk(folder) for name in inside]
        names.sort(key=lambda name: (name == own, name))
        for name in names:
            expect(os.path.join(folder, name), os.path.join(beside, name))
        files = []
        for name in names:
            to = os.path.join(beside, name)
            os.makedirs(os.path.dirname(to) or ".", exist_ok=True)
            file, temporary = begun.enter_context(_begun(to))
            _move(os.path.join(folder, name), temporary)
            c.library().granular_hold_file(file, len(names) == 1)
            files.append(file)
        _finish(files, len(names) == 1)
