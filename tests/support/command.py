# SPDX-License-Identifier: BSD-3-Clause
"""Runs the command granular as a user does."""
import json
import os
import runpy
import subprocess
import sys
import tempfile

import vtkgranular.command  # loaded once for the copies

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
SAMPLES = os.path.join(os.environ["GRANULAR_ROOT"], "samples", "data")


try:
    import jsonschema
except ImportError:
    print("documents of --json are not checked: python3-jsonschema is not installed")
    jsonschema = None
with open(os.path.join(os.environ["GRANULAR_ROOT"], "docs", "guide", "command.schema.json"), encoding="ascii") as _stream:
    SCHEMA = json.load(_stream)
assert list(SCHEMA["$defs"]) == [*vtkgranular.command.COMMANDS, "error"]


def _in_a_copy(words):
    """The command in a copy (fork) of this process, where its modules are loaded already."""
    with tempfile.TemporaryFile("w+") as printed, tempfile.TemporaryFile("w+") as said:
        sys.stdout.flush()
        sys.stderr.flush()
        copy = os.fork()
        if copy == 0:
            status = 1
            try:
                os.dup2(printed.fileno(), 1)
                os.dup2(said.fileno(), 2)
                sys.argv = words
                runpy.run_path(words[0], run_name="__main__")
            except SystemExit as end:
                status = end.code or 0
            except BaseException:
                sys.excepthook(*sys.exc_info())
            finally:
                sys.stdout.flush()
                sys.stderr.flush()
                os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(copy, 0)[1])
        for stream in printed, said:
            stream.seek(0)
        return subprocess.CompletedProcess(words, status, printed.read(), said.read())


def granular(*arguments, status=0, **options):
    """What it printed, and what it said on stderr. With options of subprocess.run in a process of its own."""
    words = [os.environ["GRANULAR_COMMAND"], *map(str, arguments)]
    done = subprocess.run([sys.executable, *words], capture_output=True, text=True, timeout=100, **options) if options else _in_a_copy(words)
    assert done.returncode == status, (arguments, done.returncode, done.stdout, done.stderr)
    assert "Traceback" not in done.stderr, done.stderr
    if "--json" in arguments and jsonschema:
        document = json.loads(done.stdout)
        jsonschema.validate(document, {"$ref": "#/$defs/" + ("error" if "error" in document else arguments[0]), **SCHEMA})
    return done.stdout, done.stderr


def content(path):
    with open(path, "rb") as stream:
        return stream.read()
