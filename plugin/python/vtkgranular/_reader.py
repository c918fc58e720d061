# SPDX-License-Identifier: BSD-3-Clause
"""Readers by what is in a file."""
from __future__ import annotations

import numbers
import os
import warnings
from typing import Any, Iterable

from ._errors import expect_utf8, raised
from ._files import files
from ._folder import MESHES
from ._options import READERS
from ._plugin import expect_plugin, has_plugin
from ._run import open as open_run


#: Readers of files whose names alone tell timesteps and ranks.
_NAMED = ("GranularVTKParticleReader", "GranularMeshReader")


def _names(paths: Iterable[str], remote: bool) -> list[str]:
    """The names of the files; a server's are taken as they are."""
    names: list[str] = []
    for path in paths:
        if remote:
            names.append(path)
        elif os.path.exists(path):
            names.append(os.path.abspath(path))
        else:
            names += files(path)
    if not names:
        raise ValueError("no files")
    return [expect_utf8(name) for name in names]


def _find_reader(names: list[str], column_map: Any) -> str:
    """The reader that recognises a file by its contents, or, where it has no header, by the names of its columns.

    The first VTK file of a run may be empty, and then the last one tells.
    """
    from paraview import servermanager

    name = names[0]
    is_mesh = os.path.splitext(name.removesuffix(".gz").removesuffix(".zst"))[1].lower() in MESHES
    more = [("GranularVTKParticleReader", each) for each in (name, names[-1]) if is_mesh]
    for reader, file in [*((reader, name) for reader in READERS), *more]:
        # not by NewProxy of the proxy manager, whose result Python never frees
        make = getattr(servermanager.sources, reader, None)  # the portable plugin has no readers of VTK files
        if make and servermanager.vtkSMReaderFactory.CanReadFile(file, make(no_update=True).SMProxy):
            return reader
    if is_mesh and hasattr(servermanager.sources, "GranularMeshReader"):
        return "GranularMeshReader"
    if column_map and os.path.exists(name):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the reader says the same
            if open_run(name, column_map=column_map).kind == "local":
                return "GranularLocalReader"
    return READERS[0]  # which says what it expected


def reader(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float | None = None,
           **properties: Any) -> Any:
    """Returns the ParaView reader that fits a file, updated to its frames and arrays. The first reader sets the times of the animation.

    paths       a file, a pattern as the `dump` command has it (see vtkgranular.files), or a list of these: the files of one
                run. Particle dumps, contacts and bonds, restart files, data files, decompositions, Euler cells, and particles in
                VTK files are told apart by their contents; other VTK, STL and PLY files are walls.
    dt          the time of one timestep, greater than 0, in the unit of the run. None: timesteps, unless the files hold times
    properties  of the reader's proxy: ColumnNames, Stride, RegionOfInterest, PointArrayStatus, ...

    The plugin must be loaded: see vtkgranular.load_plugin. Raises FileNotFoundError, AttributeError for a property that there is not,
    ValueError for a name that is not UTF-8, and RuntimeError with the file's message, which names path, line or byte, and column.
    """
    from paraview import servermanager, simple

    expect_plugin(has_plugin())
    given: list[Any] = [paths] if isinstance(paths, (str, bytes, os.PathLike)) else list(paths)
    connection = servermanager.ActiveConnection
    names = _names([os.fsdecode(path) for path in given], connection is not None and connection.IsRemote())
    kind = _find_reader(names, properties.get("ColumnMap"))
    if kind == "GranularRestartReader" and len(names) > 1:
        bases = [name for name in names if "base" in os.path.basename(name)]
        names = bases or names  # the files of the other ranks are found beside them
    if kind in _NAMED and any("%" in path and not os.path.exists(path) for path in map(os.fsdecode, given)):
        properties.setdefault("RepeatedSteps", "Merge")
    if dt is not None:
        if not isinstance(dt, numbers.Real):
            raise TypeError(f"expected a number for dt, the time of one timestep, got {dt!r}: other settings have names, as in "
                            "Preset=\"Contacts\"")
        properties["TimestepSize"] = float(dt)
    # As paraview.simple does it, but registered only once it is known to be of use.
    controller = servermanager.ParaViewPipelineController()
    made = getattr(servermanager.sources, kind)(no_update=True)
    controller.PreInitializeProxy(made)
    made.UpdateVTKObjects()
    with raised([made]):
        # arrays are chosen among those of the files, which other properties say how to read
        for name, value in sorted({**properties, "FileNames": names}.items(), key=lambda item: item[0].endswith("ArrayStatus")):
            setattr(made, name, value)
        controller.PostInitializeProxy(made)
        made.UpdatePipelineInformation()
    first = not simple.GetTimeKeeper().TimestepValues
    controller.RegisterPipelineProxy(made, os.path.basename(names[0]))
    if first:  # as the window does; a film then has a picture for each frame
        simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    return made
