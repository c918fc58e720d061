# SPDX-License-Identifier: BSD-3-Clause
"""A sample, started as a user does, leaves nothing in the settings of ParaView."""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

with tempfile.TemporaryDirectory(dir=".") as home:
    subprocess.run(sys.argv[1:], env={**os.environ, "HOME": os.path.abspath(home)}, check=True)
    for settings in Path(home).rglob("*.json"):
        assert json.loads(settings.read_text()) == {}, f"{settings.name}: {settings.read_text()}"
