# SPDX-License-Identifier: BSD-3-Clause
"""A sample, started as a user does, leaves nothing in the settings of ParaView."""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

with tempfile.TemporaryDirectory(dir=".") as home:
    home = os.path.abspath(home)
    subprocess.run(sys.argv[1:], env={**os.environ, "HOME": home, "XDG_CONFIG_HOME": f"{home}/.config"}, check=True)
    found = list(Path(home).rglob("*.json"))
    assert found, "expected settings of ParaView, got none: where are they?"
    for settings in found:
        assert json.loads(settings.read_text()) == {}, f"{settings.name}: {settings.read_text()}"
