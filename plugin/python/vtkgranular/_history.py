# SPDX-License-Identifier: BSD-3-Clause
"""Particles against time, as numpy arrays."""
from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Iterable

from ._fetch import fetch

if TYPE_CHECKING:
    import numpy

_COLUMN = re.compile(r"(.*) \(id (-?\d+)\)")


def history(reader: Any, ids: str | int | Iterable[int] = "", arrays: str | Iterable[str] = "",
            **properties: Any) -> dict[str, numpy.ndarray]:
    """Returns places and arrays of single particles at all times, as a dict of numpy arrays.

    reader      a source or filter of paraview.simple with particles, such as vtkgranular.reader returns
    ids         ids of at most 1000 particles: a number, a list, or a text like "5 10-20 100-900:50". Empty: all
    arrays      names of point arrays, as one text or a list
    properties  others of GranularHistory: EveryNth, NumberOfSamples, RegionOfInterest, TimeWindow, FrameStride, ...

    "time", "timestep"  of the frames, shape (frames,)
    "id"                of the particles, ascending, shape (particles,)
    "position"          unwrapped: continuous across periodic faces, shape (frames, particles, 3); nan where a particle is absent
    names of arrays     shape (frames, particles) or (frames, particles, components)

    Of a reader only ids, positions and these arrays are read. A warning names single ids that are in no frame. Raises RuntimeError as
    vtkgranular.update does, and ValueError if no frame has any of the ids.
    """
    import numpy
    from paraview import servermanager

    if not isinstance(ids, str):
        ids = " ".join(str(int(number)) for number in numpy.atleast_1d(numpy.asarray(ids)))
    names = arrays if isinstance(arrays, str) else " ".join(arrays)
    columns = fetch(servermanager.filters.GranularHistory(Input=reader, Ids=ids, Arrays=names, **{"NumberOfSamples": 0, **properties}))
    found: dict[str, Any] = {"time": columns.pop("time"), "timestep": columns.pop("timestep"), "id": []}
    parts: dict[str, list[numpy.ndarray]] = {}
    for column, values in columns.items():
        match = _COLUMN.fullmatch(column)
        if match:
            parts.setdefault(match[1], []).append(values)
            if match[1] == "position":
                found["id"].append(int(match[2]))
    if ids and not found["id"]:
        raise ValueError(f"expected ids of particles, got {ids!r}, of which no frame has any")
    found["id"] = numpy.array(found["id"], dtype=numpy.int64)
    for name, values in parts.items():
        found[name] = numpy.stack(values, axis=1)
    return found
