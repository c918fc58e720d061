# SPDX-License-Identifier: BSD-3-Clause
"""Runs the command granular as a user does."""
import os
import subprocess
import sys

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
SAMPLES = os.path.join(os.environ["GRANULAR_ROOT"], "samples", "data")


def granular(*arguments, status=0, **options):
    """What it printed, and what it said on stderr."""
    done = subprocess.run([sys.executable, os.environ["GRANULAR_COMMAND"], *map(str, arguments)], capture_output=True, text=True,
                          timeout=100, **options)
    assert done.returncode == status, (arguments, done.returncode, done.stdout, done.stderr)
    assert "Traceback" not in done.stderr, done.stderr
    return done.stdout, done.stderr


def content(path):
    with open(path, "rb") as stream:
        return stream.read()
