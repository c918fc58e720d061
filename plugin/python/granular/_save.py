# SPDX-License-Identifier: BSD-3-Clause
"""Files of any name."""
from __future__ import annotations

import glob
import os
import re
from typing import Any

from ._errors import expect_utf8, output_names, raised, update, upstream
from ._library import shown
from ._write import BINARIES, DUMPS, ending_of

# For each kind of data its writer, and the endings that are this writer's.
_WRITERS = {
    "particles": ("GranularDumpWriter", (*DUMPS, *BINARIES)),
    "lines or rows": ("GranularLocalWriter", (".bonds", *DUMPS)),
    "subdomains": ("GranularDecompositionWriter", (".decomposition", ".vtk", ".vtu")),
    "cells": ("GranularEulerWriter", (".euler", ".vtk")),
}
# Endings that no other writer has: it says what it expects where the data do not fit.
_ALONE = {".bonds": "GranularLocalWriter", ".decomposition": "GranularDecompositionWriter", ".euler": "GranularEulerWriter",
          ".bin": "GranularDumpWriter", ".lammpsbin": "GranularDumpWriter"}


def _names(attributes: Any) -> set[str]:
    return {attributes.GetArrayInformation(i).GetName() for i in range(attributes.GetNumberOfArrays())}


def _kind_by_origin(output: Any) -> str:
    """The same of an empty frame, which has no arrays: what its reader, source or filter gives otherwise."""
    if output_names(output)[output.Port] in ("Bonds", "Lines", "Rows"):
        return "lines or rows"
    for source in reversed(upstream(output)):
        name = source.GetXMLName()
        for part, kind in (("GranularLocal", "lines or rows"), ("GranularDecomposition", "subdomains"), ("GranularEuler", "cells")):
            if name.startswith(part):
                return kind
    return "particles"


def _kind(output: Any) -> str:
    """What data are: a key of _WRITERS."""
    information = output.GetDataInformation()
    shape = information.GetDataClassName()
    if information.GetNumberOfPoints() == 0 and information.GetNumberOfRows() == 0:
        return _kind_by_origin(output)
    cells = _names(information.GetCellDataInformation())
    points = _names(information.GetPointDataInformation())
    if shape == "vtkImageData" or "volumefraction" in cells | points:
        return "cells"
    if shape == "vtkTable" or (shape == "vtkPolyData" and cells):
        return "lines or rows"
    is_grid = shape == "vtkUnstructuredGrid"
    return "subdomains" if is_grid and (cells & {"proc", "nlocal"} or _kind_by_origin(output) == "subdomains") else "particles"


def _paraview_endings(output: Any) -> list[str]:
    """The endings that ParaView's writers know for some data."""
    from paraview import servermanager

    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    if factory.GetNumberOfRegisteredPrototypes() == 0:
        factory.UpdateAvailableWriters()
    types = factory.GetSupportedFileTypes(output.SMProxy, output.Port)
    return sorted(set(re.findall(r"\*(\.\w+)", types)))


def _choose(output: Any, path: str) -> str | None:
    """The name of a writer of this plugin, or None for ParaView's."""
    ending = ending_of(path)
    if ending in _ALONE:
        return _ALONE[ending]
    kind = _kind(output)
    writer, ours = _WRITERS[kind]
    if ending in ours:
        return writer
    if ending in DUMPS:
        return "GranularDumpWriter"  # all that has points can be a dump
    theirs = [each for each in _paraview_endings(output) if each not in {*_ALONE, *DUMPS, ".gz", ".zst"}]
    if ending in theirs and not path.endswith((".gz", ".zst")):
        return None
    known = ", ".join([*ours, *(each for each in theirs if each not in ours)])
    raise ValueError(f"expected a name for {kind} that ends in one of {known} (text may be compressed: .gz, .zst), got '{shown(path)}'; "
                     "a writer of your choice takes any name: writer=\"GranularDumpWriter\"")


def _save_by_paraview(output: Any, path: str, properties: dict[str, Any]) -> None:
    from paraview import servermanager, simple

    if "*" in path:
        raise ValueError(f"expected a name without *, got '{shown(path)}': ParaView's writers number the files of WriteTimeSteps themselves")
    known = simple.CreateWriter(path, output).ListProperties()
    if "DataMode" in known:  # appended data are no XML for some versions of libexpat
        properties = {"DataMode": "Binary", **properties}
    if "WriteTimeSteps" in properties:  # which ParaView's writers call by several names
        names = [name for name in known if re.fullmatch("Write(all)?timestepsasfileseries|WriteTimeSteps",
                                                        name, re.IGNORECASE)]
        if not names:
            raise AttributeError(f"{shown(path)}: ParaView's writer of this format has no WriteTimeSteps")
        properties = {names[0] if name == "WriteTimeSteps" else name: value for name, value in properties.items()}

    def written() -> dict[str, int]:
        stem, ending = os.path.splitext(path)
        return {name: os.stat(name).st_mtime_ns for name in glob.glob(glob.escape(stem) + "*" + glob.escape(ending))}

    before = written()
    simple.SaveData(path, output, **properties)
    if not servermanager.ActiveConnection.IsRemote() and written() == before:
        raise RuntimeError(f"{shown(path)}: ParaView wrote no file; its messages say why")


def save(proxy: Any, path: str | os.PathLike[str], time: float | None = None, writer: str | None = None,
         **properties: Any) -> None:
    """Writes what a source or filter shows, in the format that fits the data and the name.

    proxy       a source or filter of paraview.simple, or one of its output ports
    path        the file to write. What the data are decides first:
                particles      .dump, .lammpstrj, .liggghts, .lammps, .dmp (text), .bin, .lammpsbin (binary)
                lines or rows  of contacts and bonds: .bonds, or the endings of text dumps
                subdomains     .decomposition, .vtk, .vtu
                cells          .euler, .vtk
                All other endings that ParaView knows for the data, as .vtp, .vti, .vtu, .vtkhdf, .csv, .stl and .ply, go to
                ParaView's writers, VTK's XML with DataMode Binary, which all versions of libexpat read. Text dumps are compressed if .gz or .zst follows. In the names of this plugin's formats `*`
                stands for the timestep, and in those of dumps `%` for the rank.
    time        the time to write, as for granular.update
    writer      GranularDumpWriter, GranularLocalWriter, GranularDecompositionWriter or GranularEulerWriter, which take
                files of any name. None: see path.
    properties  of the writer's proxy: WriteTimeSteps, Dialect, Style, Label, Columns, NumberFormat, ...

    A file of this plugin is there when it is complete; after an error the old one is untouched. Raises ValueError for a name
    that is not UTF-8, and for an ending that no writer has for such data, and lists those that are known; AttributeError for a
    property, or a writer, that there is not; RuntimeError with the message if the file could not be written.
    """
    from paraview import servermanager

    path = expect_utf8(os.fsdecode(path))
    update(proxy, time)
    writer = writer or _choose(proxy, path)
    if writer is None:
        _save_by_paraview(proxy, path, properties)
        return
    written = getattr(servermanager.writers, writer)(Input=proxy, FileName=path)
    for name, value in properties.items():
        words = name == "Columns" and not isinstance(value, str)
        setattr(written, name, " ".join(value) if words else value)
    written.UpdateVTKObjects()
    with raised([*upstream(proxy), written]):
        written.UpdatePipeline()
    written.UpdatePropertyInformation()
    if not written.GetPropertyValue("Written"):
        raise RuntimeError(f"{shown(path)} could not be written: see the messages above")
