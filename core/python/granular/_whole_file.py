# SPDX-License-Identifier: BSD-3-Clause
"""Files that appear when they are complete."""
from __future__ import annotations

import contextlib
import errno
import fcntl
import hashlib
import os
import shutil
import socket
import stat
from typing import Callable, Iterator

from ._library import shown

_MOST_TRIES = 1000
_MOST_FREE = 8  # names in a row: programs that ended have left gaps between others


def expect_file(path: str, mode: int) -> None:
    """Raises OSError, as the library does, for the mode of something that is not a regular file."""
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(f"{shown(path)}: expected a file, got a directory")
    if not stat.S_ISREG(mode):
        raise OSError(f"{shown(path)}: expected a file, got a device or a pipe")


def _behind_links(path: str) -> str:
    """The file that a symbolic link leads to, there or not."""
    target = path
    for _ in range(40):  # as Linux has it
        if not os.path.islink(target):
            return target
        target = os.path.join(os.path.dirname(target), os.readlink(target))
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), path)


def _is_name_of(name: str, file: int) -> bool:
    """Returns whether a name is that of an open file. Raises OSError if the system does not tell."""
    try:
        return os.path.samestat(os.lstat(name), os.fstat(file))
    except FileNotFoundError:
        return False


def _close(file: int) -> None:
    """Closes a file that nothing was written to, so that an error means nothing."""
    with contextlib.suppress(OSError):
        os.close(file)


def _remove(name: str) -> None:
    """Removes a hidden file or folder, if that can be done: the next program that writes the same file tries it again."""
    try:
        os.unlink(name)
    except IsADirectoryError:
        shutil.rmtree(name, ignore_errors=True)
    except OSError:
        pass


def _lock(file: int) -> bool:
    """Returns whether the lock is this file's: a file system may have none. Raises BlockingIOError if another program has it."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True
    except BlockingIOError:
        raise
    except OSError:
        return False


def _remove_left(name: str, data: str) -> bool:
    """Removes the two files that a dead program has left. Returns False if there is nothing of the name."""
    try:
        file = os.open(name, os.O_WRONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return False
    try:
        state = os.fstat(file)
        if stat.S_ISREG(state.st_mode) and state.st_uid == os.geteuid() and _lock(file) and _is_name_of(name, file):
            _remove(data)
            _remove(name)
    except OSError:
        pass  # that program lives, or the system does not tell
    finally:
        _close(file)
    return True


def _create_locked(target: str, ending: str) -> tuple[str, int]:
    """Creates a locked file of a hidden name, and removes those of dead programs, as the library's LockedFile does."""
    folder, file_name = os.path.split(target)
    mark = hashlib.blake2b(os.fsencode(socket.gethostname()) + b"\0" + os.fsencode(file_name), digest_size=8).hexdigest()
    begin = os.path.join(folder, f".granular-{mark}-")
    free = number = 0
    while free < _MOST_FREE and number < _MOST_TRIES:
        name = f"{begin}{number}.tmp"
        free = 0 if _remove_left(name, name + ending) else free + 1
        number += 1
    number = -1
    for _ in range(_MOST_TRIES):
        number += 1
        name = f"{begin}{number}.tmp"
        try:
            file = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
        except FileExistsError:
            continue
        try:
            locked = _lock(file)
            if _is_name_of(name, file):
                if locked or number >= _MOST_TRIES:
                    return name, file
                # without a lock it would pass for one that was left as soon as another gets one: nobody looks at numbers like this
                _remove(name)
                number = _MOST_TRIES * (1 + os.getpid())
        except BlockingIOError:
            pass  # another program has taken it for one that was left
        except OSError:
            _remove(name)
            _close(file)
            raise
        _close(file)
    raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), begin)


def _sync(path: str) -> None:
    """Waits until a file or a folder is on the disk. Some file systems keep nothing, or cannot tell."""
    file = os.open(path, os.O_RDONLY)
    try:
        os.fsync(file)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.ENOSYS):
            raise
    finally:
        _close(file)


def _sync_folder(folder: str, path: str) -> None:
    """Waits until the new name of a path is on the disk."""
    try:
        _sync(folder)
    except PermissionError:
        pass  # a folder that may not be read cannot be synchronised
    except OSError as error:
        raise OSError(error.errno, "written, but a loss of power may take the new file back: cannot synchronise its folder: "
                      f"{error.strerror}", path) from None


def _remove_own(name: str, lock: int) -> None:
    """Removes the file of a lock, unless another program has the name."""
    try:
        own = _is_name_of(name, lock)
    except OSError:
        own = True  # as it was a moment ago
    if own:
        _remove(name)
    _close(lock)


def _old_file(target: str, path: str) -> os.stat_result | None:
    """The state of the file that a new one will replace, or None. Raises OSError for what may not be replaced."""
    try:
        old = os.lstat(target)
    except FileNotFoundError:
        return None
    expect_file(path, old.st_mode)
    if not os.access(target, os.W_OK):  # who may not write a file may not replace it either
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)
    return old


def _keep_owner(name: str, old: os.stat_result, path: str) -> None:
    """Gives a new file the owner and group of the file that it will replace."""
    now = os.stat(name)
    if (now.st_uid, now.st_gid) != (old.st_uid, old.st_gid):
        try:
            os.chown(name, old.st_uid, old.st_gid)
        except OSError as error:
            raise OSError(error.errno, "cannot write: the new file would not keep the owner and group of the old one: "
                          f"{error.strerror}", path) from None


def _complete(name: str, path: str, old: os.stat_result | None, durable: bool) -> None:
    """Makes a new file ready for its name."""
    if old is not None:
        _keep_owner(name, old, path)
        os.chmod(name, stat.S_IMODE(old.st_mode) & 0o777)
    if durable:
        _sync(name)


@contextlib.contextmanager
def _hidden(path: str, target: str, ending: str) -> Iterator[tuple[str, Callable[[], None]]]:
    """Yields a name beside a target that nobody else uses, and what raises OSError if that is no longer so. Removes at the end what
    has the name. Errors name the path."""
    try:
        name, lock = _create_locked(target, ending)
    except OSError as error:  # the user knows the path, and not the name of the hidden file
        raise OSError(error.errno, error.strerror, path) from None
    temporary, process = name + ending, os.getpid()

    def expect_own() -> None:
        if os.getpid() != process:
            raise PermissionError(errno.EPERM, "expected the process that began the file, got a child of it", path)
        if not _is_name_of(name, lock):  # somebody has removed it, and another may have the name
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)

    try:
        _remove(temporary)
        yield temporary, expect_own
    except OSError as error:
        if error.errno is None or error.filename not in (None, temporary, name):
            raise  # of another file
        raise OSError(error.errno, error.strerror, path) from error
    finally:
        if os.getpid() == process:  # a child has a copy of all this
            _remove(temporary)
            _remove_own(name, lock)


@contextlib.contextmanager
def whole_file(path: str, ending: str = "", durable: bool = True) -> Iterator[str]:
    """Yields the name of a temporary file beside a path. It replaces the old file at the end, and is removed after an error.

    A symbolic link stays, and so do the permissions, owner and group of the old file. Raises OSError where they cannot, and for what
    is not a regular file.

    ending   of the temporary name, for programs that look at it
    durable  the file is on the disk before it gets its name

    A program that is killed leaves two hidden files, which the next whole_file of the same path removes. The lock is on the first,
    because other libraries lock the files that they write in their ways.
    """
    target = _behind_links(path)
    old = _old_file(target, path)
    with _hidden(path, target, ".data" + ending) as (temporary, expect_own):
        # who may not read the old file may not read along either
        _close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666 if old is None else 0o600))
        if old is not None and os.geteuid() != 0:  # before the first byte; until the end, a file of root is root's
            _keep_owner(temporary, old, path)
        yield temporary
        expect_own()
        _complete(temporary, path, old, durable)
        expect_own()
        os.replace(temporary, target)
    if durable:
        _sync_folder(os.path.dirname(target) or ".", path)


def _replace(file: str, to: str) -> None:
    """Gives a new file its name, behind a link to another file system as well."""
    try:
        os.replace(file, to)
    except OSError as error:
        if error.errno != errno.EXDEV:
            raise
        with whole_file(to) as copy:
            shutil.copyfile(file, copy)


@contextlib.contextmanager
def whole_files(path: str, expect: Callable[[str, str], None]) -> Iterator[str]:
    """Yields a name for a path in a temporary folder beside it, for programs that write several files. At the end, what is in the
    folder replaces the files of the same names beside the path, the path's own file last. After an error the old files stay.

    expect  is called with each new file, and the file that it will replace, before the first one is replaced; it may raise

    Links, permissions and owners stay as in whole_file. One file is on the disk before it gets its name.
    """
    target = _behind_links(path)
    _old_file(target, path)
    beside, own = os.path.split(path)
    with _hidden(path, target, ".data") as (folder, expect_own):
        os.mkdir(folder, 0o700)
        yield os.path.join(folder, own)
        expect_own()
        names = [os.path.relpath(os.path.join(place, name), folder) for place, _, inside in os.walk(folder) for name in inside]
        new = []
        for name in sorted(names, key=lambda name: (name == own, name)):
            file, to = os.path.join(folder, name), _behind_links(os.path.join(beside, name))
            expect(file, to)
            _complete(file, to, _old_file(to, to), len(names) == 1)
            new.append((file, to))
        expect_own()
        for file, to in new:
            os.makedirs(os.path.dirname(to) or ".", exist_ok=True)
            _replace(file, to)
    if len(names) == 1:
        _sync_folder(os.path.dirname(target) or ".", path)
