# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView's versions call by different names."""
from __future__ import annotations

import re
from typing import Any


def _version() -> tuple[int, int]:
    from paraview import servermanager

    version = servermanager.vtkSMProxyManager
    return version.GetVersionMajor(), version.GetVersionMinor()


def preset(name: str) -> str:
    """Returns the name by which this ParaView knows a colour preset, for ApplyPreset.

    name  in any version: "Plasma" and "Plasma (matplotlib)" are the same. Raises ValueError if this ParaView has no such preset.
    """
    from paraview.modules.vtkRemotingViews import vtkSMTransferFunctionPresets as Presets

    presets = Presets.GetInstance() if hasattr(Presets, "GetInstance") else Presets()
    known = [presets.GetPresetName(i) for i in range(presets.GetNumberOfPresets())]
    short = re.sub(r" \([^()]*\)$", "", name)
    for candidate in [name, short, *(k for k in known if k.startswith(f"{short} ("))]:
        if candidate in known:
            return candidate
    raise ValueError(f"no colour preset in this ParaView is called {name}")


def label_format(text: str) -> dict[str, Any]:
    """Returns the properties that make a colour bar write its numbers in a format, for set_properties.

    text  the format as printf has it: "%.1f", "%g m". Raises ValueError if it has not exactly one conversion of e, f or g.
    """
    parts = re.fullmatch(r"([^%{}]*)%([+]?)([0-9]*(?:\.[0-9]+)?)([efgEFG])([^%{}]*)", text)
    if not parts:
        raise ValueError(f"expected a format with one number, as in '%.1f', got '{text}'")
    if _version() >= (6, 1):
        text = "{}{{:{}{}{}}}{}".format(*parts.groups())
    return {"AutomaticLabelFormat": 0, "LabelFormat": text, "RangeLabelFormat": text}


def process_ids(source: Any) -> tuple[Any, str]:
    """Returns a filter that says for each point which process has it, and the name of its array.

    source  a source or filter of paraview.simple. The array holds the ranks 0, 1, ...
    """
    from paraview import simple

    if _version() < (5, 12):
        return simple.ProcessIdScalars(Input=source), "ProcessId"
    return simple.ProcessIds(Input=source), "PointProcessIds"


def set_properties(proxy: Any, **properties: Any) -> None:
    """Sets several properties of a source, filter, display or view of paraview.simple.

    ParaView itself calls this SetProperties up to 6.0, and Set from then on. Raises AttributeError for a property that there is not.
    """
    for name, value in properties.items():
        setattr(proxy, name, value)
