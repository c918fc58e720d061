# SPDX-License-Identifier: BSD-3-Clause
"""Strange places and names for the package and the command; and little of what the system gives."""
import contextlib
import io
import itertools
import os
import resource
import shutil
import socket
import stat
import subprocess
import sys
import warnings

import command

import granular
import granular.command

warnings.simplefilter("ignore")
GRAINS = os.path.join(command.GOOD, "grains_1000.dump")
NAMES = {"a b": "a b", "quote'\"": "quote'\"", "new\nline": r"new\nline", "tab\t\x1b[31m": r"tab\t\x1b[31m", "back\\slash": "back\\slash",
         "per%cent%d": "per%cent%d", "st*r": "st*r", "b[r]a?k": "b[r]a?k", "-dash": "-dash", "\u00e4\u20ac\U0001f600": "\u00e4\u20ac\U0001f600",
         os.fsdecode(b"\xff\xfe"): r"\xff\xfe", "n" * 240: "n" * 240}
shutil.rmtree("files", ignore_errors=True)
os.mkdir("files")
os.chdir("files")
HERE = os.getcwd()


def raises(kind, call, *words):
    try:
        call()
    except Exception as error:  # noqa: BLE001
        assert isinstance(error, kind), (type(error), error)
        text = str(error)
        assert all(word in text for word in words) and "\n" not in text and text.encode(), text
        return
    raise AssertionError(f"expected {kind} with {words}")


def run(*arguments, status=0, **options):
    """What the command printed and said, as bytes. With options of subprocess.run it has a process of its own."""
    if options:
        done = subprocess.run([sys.executable, os.environ["GRANULAR_COMMAND"], *arguments], capture_output=True, timeout=60,
                              stdin=subprocess.DEVNULL, **options)
        out, said, code = done.stdout, done.stderr, done.returncode
    else:
        streams = [io.TextIOWrapper(io.BytesIO(), "utf-8", errors) for errors in ("strict", "backslashreplace")]
        with contextlib.redirect_stdout(streams[0]), contextlib.redirect_stderr(streams[1]):
            code = granular.command.main(arguments)
        for stream in streams:
            stream.flush()
        out, said = (stream.buffer.getvalue() for stream in streams)
    assert code == status and b"Traceback" not in said, (arguments, code, out, said)
    return out, said


def apart(task, limits=(), user=None, variables=()):
    """Runs a task in a process of its own, with limits, as another user; returns what it returns as text, or how it died."""
    out, into = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            for name, value in dict(variables).items():
                os.environ[name] = value
            for limit, most in limits:
                resource.setrlimit(limit, (most, most))
            if user is not None:
                os.setresuid(user, user, user)
            os.write(into, str(task()).encode())
            status = 0
        except BaseException as error:  # noqa: BLE001
            os.write(into, f"{type(error).__name__}: {error}".encode(errors="backslashreplace"))
        finally:
            os._exit(status)
    os.close(into)
    with os.fdopen(out, "rb") as stream:
        text = stream.read().decode()
    _, status = os.waitpid(child, 0)
    return text if not os.WIFSIGNALED(status) else f"signal {os.WTERMSIG(status)}"


# ---- names --------------------------------------------------------------------------------------
plain = granular.open(GRAINS)[0].read()
for name, shown in NAMES.items():
    file = name + ".dump"
    os.mkdir(name)
    for path in (file, os.path.join(name, file)):
        shutil.copy(GRAINS, path)
        for spelled in (path, os.fsencode(path), os.path.abspath(path)):
            frame = granular.open(spelled)[0]
            assert (frame["id"] == plain["id"]).all()
    assert granular.files(os.path.join(name, "*.dump")) == [os.path.join(HERE, name, file)]
    raises(granular.Error, lambda: granular.open(file, kind="restart"), os.path.join(HERE, shown + ".dump"))  # noqa: B023
    raises(FileNotFoundError, lambda: granular.open(name + ".none"), shown + ".none")  # noqa: B023
    if "*" not in name and "%" not in name:
        os.remove(file)
        granular.write(file, plain)
        with open(file, "rb") as written, open(GRAINS, "rb") as given:
            assert written.read() == given.read(), name
    with open(name + ".log", "w") as log:
        log.write("Step Temp\n0 1.5\n10 2.5\nLoop time of 1\n")
    assert granular.read_log(name + ".log")["Temp"].tolist() == [1.5, 2.5]
    with open(name + ".log", "w") as log:
        log.write("nothing\n")
    raises(granular.Error, lambda: granular.read_log(name + ".log"), shown + ".log")  # noqa: B023
    shutil.copy(GRAINS, name + "_7.stl")
    if "\udcff" in name:
        raises(ValueError, lambda: granular.write_series([name + "_7.stl"], 1, path="no.series"), "UTF-8", shown)  # noqa: B023
    else:
        assert os.path.exists(granular.write_series([name + "_7.stl"], 1)), name
shutil.rmtree("new\nline")
raises(ValueError, lambda: granular.open("nul\0.dump"), "null")
raises(ValueError, lambda: granular.files("nul\0*.dump"), "null")
raises(ValueError, lambda: granular.write("nul\0.dump", plain), "null")
raises(ValueError, lambda: granular.write("nul\0.dump", plain, style="atom"), "null")
for name, shown in NAMES.items():
    shutil.copy(GRAINS, name + ".dump")
for name in ("new\nline", os.fsdecode(b"\xff\xfe"), "-dash", "st*r"):
    shown = NAMES[name]
    plain_c = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    for options in ({}, *([{"env": plain_c}] if name in ("new\nline", "\udcff\udcfe") else [])):
        out, said = run("check", "--", name + ".dump", **options)
        assert out == f"{shown}.dump: 1 frames, 1200 rows, nothing is wrong\n".encode() and not said, (name, out, said)
    out, _ = run("info", "--", name + ".dump")
    assert out.split(b"\n")[0] == shown.encode() + b".dump", out
    _, said = run("stats", "--", name + ".none", status=1)
    assert said == f"granular: {HERE}/{shown}.none: no file fits the pattern\n".encode(), said
    for ending in (".csv", ".npz", ".dump.zst"):
        run("convert", "-q", "--", name + ".dump", name + ending)
        assert os.path.exists(name.replace("*", "1000") + ending), os.listdir(".")

# ---- what is no file ----------------------------------------------------------------------------
os.mkdir("places")
os.chdir("places")
os.mkfifo("pipe")
os.mkdir("folder")
bound = socket.socket(socket.AF_UNIX)
bound.bind("socket")
for target, link in (("pipe", "to_pipe"), ("folder", "to_folder"), ("loop", "loop"), ("none", "dangling")):
    os.symlink(target, link)
DEVICE, FOLDER = "expected a file, got a device or a pipe", "expected a file, got a directory"
REFUSED = {"pipe": DEVICE, "to_pipe": DEVICE, "socket": DEVICE, "/dev/null": DEVICE, "/dev/zero": DEVICE, "/dev/full": DEVICE,
           "folder": FOLDER, "folder/": FOLDER, "to_folder": FOLDER, "": FOLDER, "loop": "Too many levels", "dangling": "No such file",
           "/proc/self/status": "known size"}
for place, why in REFUSED.items():
    raises(OSError, lambda: granular.open(place), why)  # noqa: B023
    if place not in ("", "/proc/self/status"):  # which is a name that any program may look up
        raises(OSError, lambda: granular.files(place), why)  # noqa: B023
    if place not in ("", "socket", "/proc/self/status"):  # a log of the system is text like others
        raises(OSError, lambda: granular.read_log(place))  # noqa: B023
for subcommand, place in itertools.product(("info", "check", "stats"), ("pipe", "folder", "/dev/zero")):
    _, said = run(subcommand, place, status=1)
    assert said.decode().endswith(f"{place}: {REFUSED[place]}\n"), said
before = {name: os.lstat(name).st_mode for name in os.listdir(".")}
for place, ending in itertools.product(("pipe", "folder", "socket", "/dev/full", "loop", "none/none"), (".csv", ".npz", ".dump", ".bin")):
    os.symlink(place, "out" + ending)
    _, said = run("convert", "-q", GRAINS, "out" + ending, status=1)
    assert f"out{ending}".encode() in said, said
    os.remove("out" + ending)
    assert {name: os.lstat(name).st_mode for name in os.listdir(".")} == before, (place, os.listdir("."))
os.mkfifo("pipe.series")
raises(OSError, lambda: granular.write_series(GRAINS, 1, path="pipe.series"), DEVICE)
assert stat.S_ISFIFO(os.lstat("pipe.series").st_mode)

# links stay, with the permissions of the file behind them
for ending in (".csv", ".npz"):
    with open("file" + ending, "w") as file:
        file.write("old")
    os.chmod("file" + ending, 0o640)
    os.symlink("file" + ending, "link" + ending)
    os.symlink("new" + ending, "new_link" + ending)
    for link in ("link", "new_link"):
        run("convert", "-q", GRAINS, link + ending)
        assert os.path.islink(link + ending)
    assert stat.S_IMODE(os.stat("file" + ending).st_mode) == 0o640
    assert os.path.getsize("file" + ending) == os.path.getsize("new" + ending) > 1000
for mask in (0, 0o077):
    run("convert", "-q", GRAINS, f"mask_{mask}.csv", umask=mask)
    assert stat.S_IMODE(os.stat(f"mask_{mask}.csv").st_mode) == 0o666 & ~mask

# ---- a folder that may only be read, as another user; root may write everywhere ------------------
os.mkdir("locked")
shutil.copy(GRAINS, "locked/a.dump")
shutil.copy(GRAINS, "a_7.stl")
os.chmod("locked", 0o555)
NOBODY = 65534 if os.geteuid() == 0 else os.geteuid()


def in_locked_folder():
    if not os.access(os.path.abspath("locked/a.dump"), os.R_OK):
        return "out of reach"
    granular.open("locked/a.dump")[0].read()
    for ending in (".dump", ".bin"):
        raises(PermissionError, lambda: granular.write("locked/new" + ending, plain), "locked/new" + ending)  # noqa: B023
    raises(PermissionError, lambda: granular.write_series(["a_7.stl"], 1, path="locked/a.series"), "locked")
    return sorted(os.listdir("locked"))


said = apart(in_locked_folder, user=NOBODY, variables={"HOME": "/dev/null"})
assert said in ("['a.dump']", "out of reach"), said
os.chmod("locked", 0o755)

# ---- without a home, and with few means ----------------------------------------------------------
bare = {name: value for name, value in os.environ.items() if name not in ("HOME", "TMPDIR", "LC_ALL")}
for variables in ({}, {"HOME": "/dev/null", "TMPDIR": "/none"}):
    out, said = run("info", GRAINS, env={**bare, **variables})
    assert b"1200" in out and not said, (out, said)
for i in range(300):
    os.link(GRAINS, f"s_{i}.dump") if os.stat(GRAINS).st_dev == os.stat(".").st_dev else os.symlink(GRAINS, f"s_{i}.dump")
series = granular.open("s_*.dump", repeated_steps="last")
assert apart(lambda: sum(frame.read().rows for frame in granular.open("s_*.dump", threads=4)), [(resource.RLIMIT_NOFILE, 64)]) == "1200"
run("check", "s_*.dump", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (64, 64)))

# without threads nothing is read ahead
rows = str(sum(frame.read().rows for frame in granular.open(os.path.join(command.GOOD, "grains_*.dump"))))
assert apart(lambda: sum(frame.read().rows for frame in granular.open(os.path.join(command.GOOD, "grains_*.dump"), threads=4)),
             [(resource.RLIMIT_NPROC, 0)], user=NOBODY).split(":")[0] in (rows, "PermissionError")


def with_memory(more):
    """Reads and writes with a limit on the addresses of the process."""
    granular.write("before.dump", plain)  # what is loaded once is there
    with open("/proc/self/statm") as status:
        used = int(status.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + more, used + more))
    try:
        for frame in granular.open(os.path.join(command.GOOD, "grains_*.dump"), threads=2):
            frame.read()
        granular.write("memory.dump.gz", plain)
        return "done"
    except (granular.Error, MemoryError, OSError):
        return "failed"


seen = {apart(lambda: with_memory(more)) for more in (100_000, 1 << 20, 4 << 20, 32 << 20, 256 << 20)}  # noqa: B023
assert "done" in seen and not [text for text in seen if text.startswith("signal")], seen
print("all places were tried")
