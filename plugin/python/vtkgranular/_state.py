# SPDX-License-Identifier: BSD-3-Clause
"""State files whose data were moved together with them."""
from __future__ import annotations

import os
import tempfile
from pathlib import Path
from xml.etree import ElementTree

from ._errors import expect_utf8
from ._library import shown


def _find_again(name: str, folder: Path) -> str | None:
    """The file with the longest end of a path that lies below a folder."""
    parts = Path(name).parts
    for first in range(1, len(parts)):
        candidate = folder.joinpath(*parts[first:])
        if candidate.is_file():
            return str(candidate)
    return None


def load_state(path: str | os.PathLike[str]) -> None:
    """Loads a state file of ParaView, also after its folder was moved.

    path  a .pvsm file, as SaveState and File, Save State write it

    State files name their data by absolute paths. A data file that is no longer there is looked for below the folder of the
    state file, by the longest end of its path: for /old/run/post/a.dump and a state in /new/run that is
    /new/run/post/a.dump. The state file itself stays as it is. For states of this machine, not of a server. Raises FileNotFoundError if
    the state, or a file that its readers name, is not found.
    """
    from paraview import simple

    path = Path(expect_utf8(os.fsdecode(path))).resolve()
    state = ElementTree.parse(path)
    moved = False
    for proxy in state.iter("Proxy"):
        if proxy.get("group") != "sources":
            continue
        for prop in proxy.iter("Property"):
            if prop.get("name") not in ("FileName", "FileNames"):
                continue
            for element in prop.iter("Element"):
                name = element.get("value", "")
                if not name or os.path.exists(name):
                    continue
                found = _find_again(name, path.parent)
                if found is None:
                    raise FileNotFoundError(f"{shown(str(path))} names {shown(name)}, which is neither there nor below {shown(str(path.parent))}")
                element.set("value", found)
                moved = True
    if not moved:
        simple.LoadState(str(path))
        return
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, path.name)
        state.write(copy)
        simple.LoadState(copy)
