# SPDX-License-Identifier: BSD-3-Clause
"""Files of any name."""
from __future__ import annotations

import contextlib
import functools
import glob
import html
import os
import re
from typing import Any, Callable, Iterator

from ._errors import expect_utf8, output_names, raised, times_of, update, upstream
from ._fetch import fetch_groups
from ._inline import put_inline
from ._library import shown
from ._whole_file import whole_files
from ._write import BINARIES, DUMPS, Writer, ending_of

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


def _identity(path: str) -> tuple[int, int]:
    state = os.stat(path)
    return state.st_dev, state.st_ino


def _is_one_of(path: str, files: set[tuple[int, int]]) -> bool:
    try:
        return _identity(path) in files
    except OSError:  # there is no file behind the name
        return False


def _inputs(output: Any, ours: bool) -> set[tuple[int, int]]:
    """Returns the files that the readers of this plugin, or all others, read for an output."""
    found = set()
    for source in upstream(output):
        for name in ("FileNames", "FileName"):
            if source.GetXMLName().startswith("Granular") == ours and source.SMProxy.GetProperty(name):
                value = source.GetPropertyValue(name)
                for file in [value] if isinstance(value, str) else value or []:
                    with contextlib.suppress(OSError):
                        found.add(_identity(file))
    return found


def _expect_whole(file: str) -> None:
    """Raises OSError or RuntimeError for a file that a writer of ParaView has not finished: some of them tell nobody."""
    with open(file, "r+b") as stream:
        size = stream.seek(0, os.SEEK_END)
        stream.seek(0)
        if b"<VTKFile" in stream.read(1000):
            stream.seek(max(0, size - 100))
            is_whole = stream.read().rstrip().endswith(b"</VTKFile>")
        else:  # where a write has failed there is no room for more: those that do not look write a few KiB at a time
            os.posix_fallocate(stream.fileno(), size, 1 << 16)
            stream.truncate(size)
            is_whole = True
    if is_whole and re.search(r"\.(pv\w+|vt(m|mb|pc|pd|h|hb))$", file):  # which names others
        with open(file, encoding="utf-8", errors="surrogateescape") as text:
            others = re.findall(r'<(?:Piece|DataSet)\b[^>]*? (?:Source|file)="([^"]*)"', text.read())
        is_whole = all(os.path.exists(os.path.join(os.path.dirname(file), html.unescape(other))) for other in others)
    if not is_whole:
        raise RuntimeError("expected a whole file, got a part of one: ParaView's writer has failed")


@contextlib.contextmanager
def _told_errors() -> Iterator[list[str]]:
    """Yields a list that gets the errors that VTK prints meanwhile."""
    from vtkmodules.vtkCommonCore import vtkOutputWindow

    errors: list[str] = []

    def take(window: Any, event: str, text: str) -> None:
        if text.startswith("ERROR: In "):  # a place in VTK's sources; Python's warnings come here, too
            errors.append(re.sub(r"^\w+ \(0x[0-9a-f]+\): ", "", text.split("\n")[1]))

    take.CallDataType = "string0"  # type: ignore[attr-defined]
    window = vtkOutputWindow.GetInstance()
    tag = window.AddObserver("ErrorEvent", take)
    try:
        yield errors
    finally:
        window.RemoveObserver(tag)


def _on_first(path: str, work: Callable[[], str]) -> str:
    """Returns the text that work() returns on the first rank, on all that run this script. Raises its error on all."""
    from paraview import servermanager
    from vtkmodules.vtkCommonCore import vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkTable
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    ranks = vtkMultiProcessController.GetGlobalController()
    together = servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
    told = vtkStringArray()
    if together:
        ranks.Barrier()  # until all have written
    if not together or ranks.GetLocalProcessId() == 0:
        try:
            told.InsertNextValue(work())
        except Exception as error:  # the other ranks wait for it
            told.InsertNextValue("")
            text = str(error).removeprefix(f"{shown(os.path.abspath(path))}: ")
            told.InsertNextValue(f"cannot write: {error.strerror}" if isinstance(error, OSError) and error.strerror else text)
    if together:
        table = vtkTable()
        table.GetFieldData().AddArray(told)
        ranks.Broadcast(table, 0)
        told = table.GetFieldData().GetAbstractArray(0)
    if told.GetNumberOfValues() > 1:
        raise RuntimeError(f"{shown(path)}: {told.GetValue(1)}")
    return told.GetValue(0)


@contextlib.contextmanager
def written_by_paraview(path: str, expect: Callable[[str, str], None]) -> Iterator[str]:
    """Yields a name for a path in another folder, for ParaView to write one file or several. At the end, they replace the old ones if
    ParaView has told no error; see whole_files for expect."""
    errors: list[str] = []

    def look(file: str, old: str) -> None:
        expect(file, old)
        if errors:
            raise RuntimeError(errors[0])

    def finish() -> str:
        if not os.listdir(os.path.dirname(temporary)):
            raise RuntimeError(errors[0] if errors else "ParaView wrote no file; its messages say why")
        stack.close()
        return ""

    with contextlib.ExitStack() as stack:
        # absolute: other ranks may be in other folders
        temporary = _on_first(path, lambda: stack.enter_context(whole_files(os.path.abspath(path), look)))
        with _told_errors() as told:
            yield temporary
        errors += [error.replace(temporary, path) for error in told]
        _on_first(path, finish)


def _save_by_paraview(output: Any, path: str, properties: dict[str, Any]) -> None:
    from paraview import servermanager, simple

    if "*" in path:
        raise ValueError(f"expected a name without *, got '{shown(path)}': ParaView's writers number the files of WriteTimeSteps themselves")
    known = simple.CreateWriter(path, output).ListProperties()
    if "WriteTimeSteps" in properties:  # which ParaView's writers call by several names
        names = [name for name in known if re.fullmatch("Write(all)?timestepsasfileseries|WriteTimeSteps",
                                                        name, re.IGNORECASE)]
        if not names:
            raise AttributeError(f"{shown(path)}: ParaView's writer of this format has no WriteTimeSteps")
        properties = {names[0] if name == "WriteTimeSteps" else name: value for name, value in properties.items()}
    if "Precision" in known:  # of a text: all digits
        properties = {"Precision": 17, **properties}
    if servermanager.ActiveConnection.IsRemote():  # the files are the server's
        if "DataMode" in known:
            properties = {"DataMode": "Binary", **properties}
        simple.SaveData(path, output, **properties)
        return
    if "DataMode" not in properties:
        properties = {name: value for name, value in properties.items() if name != "EncodeAppendedData"}  # inline data are always encoded
    inputs = _inputs(output, ours=True)

    def expect(file: str, old: str) -> None:
        _expect_whole(file)
        if "DataMode" not in properties:
            put_inline(file)
        if _is_one_of(old, inputs):
            raise RuntimeError(f"expected other files to write, got one that is read: {shown(old)}")

    with written_by_paraview(path, expect) as temporary:
        simple.SaveData(temporary, output, **properties)


def _rows_of(output: Any) -> tuple[dict[str, Any], Any]:
    """Returns the rows of an output by the names of their arrays, and its timestep, or None: rows of a table, lines, cells, or points."""
    import numpy

    groups = fetch_groups(output)
    rows, places, image = (groups[name] for name in ("rows", "places", "image"))
    of_cells = groups["cells"] and (not groups["points"] or _kind(output) in ("cells", "subdomains"))
    if image:
        counts = numpy.maximum(image["dimensions"] - 1, 1) if of_cells else image["dimensions"]
        k, j, i = numpy.indices(counts[::-1]).reshape(3, -1)
        places = {"points": image["origin"] + (numpy.stack([i, j, k], axis=1) + (0.5 if of_cells else 0)) * image["spacing"]}
    elif of_cells:
        ends, count = places["points"], len(next(iter(groups["cells"].values())))
        places = {"points": ends.reshape(count, 2, 3)} if len(ends) == 2 * count else {}
    return {**places, **(rows or groups["cells" if of_cells else "points"])}, groups["fields"].get("timestep")


def _save_table(output: Any, path: str, given: dict[str, Any]) -> None:
    """Writes a table of the frame now shown, or of all frames."""
    properties = {"WriteTimeSteps": 0, "Columns": "", **given}
    if len(properties) > 2:
        raise AttributeError(f"{shown(path)}: expected properties of WriteTimeSteps and Columns, got {', '.join(given)}")
    inputs = _inputs(output, True) | _inputs(output, False)
    with contextlib.ExitStack() as stack:
        writer: Any = None

        def write(rows: dict[str, Any], step: int, time: float | None) -> str:
            nonlocal writer
            name = os.path.join(os.path.dirname(path), os.path.basename(path).replace("*", str(step)))
            if _is_one_of(name, inputs):
                raise ValueError(f"expected another file to write, got one that is read: {shown(name)}")
            writer = writer or stack.enter_context(Writer(os.path.abspath(path), columns=properties["Columns"]))
            writer.write(rows, step=step, time=time)
            return ""

        for number, time in enumerate(times_of(output) or [None] if properties["WriteTimeSteps"] else [None]):
            if time is not None:
                update(output, time)
            rows, step = _rows_of(output)
            _on_first(path, functools.partial(write, rows, number if step is None else int(step), time))
        _on_first(path, lambda: writer.finish() or "")


def save(proxy: Any, path: str | os.PathLike[str], time: float | None = None, writer: str | None = None,
         **properties: Any) -> None:
    """Writes what a source or filter shows, in the format that fits the data and the name.

    proxy       a source or filter of paraview.simple, or one of its output ports
    path        the file to write. What the data are decides first:
                particles      .dump, .lammpstrj, .liggghts, .lammps, .dmp (text), .bin, .lammpsbin (binary)
                lines or rows  of contacts and bonds: .bonds, or the endings of text dumps
                subdomains     .decomposition, .vtk, .vtu
                cells          .euler, .vtk
                .csv is a table with all digits, as vtkgranular.write has it, written where the script runs. WriteTimeSteps=1 puts all
                frames into it, or with `*` in the name into a file each; Columns chooses columns.
                All other endings that ParaView knows for the data, as .vtp, .vti, .vtu, .vtkhdf and .stl, go to its writers.
                Text dumps are compressed if .gz or .zst follows. In the names of tables and of this plugin's formats `*` stands for
                the timestep, and in those of dumps `%` for the rank.
    time        the time to write, as for vtkgranular.update
    writer      GranularDumpWriter, GranularLocalWriter, GranularDecompositionWriter or GranularEulerWriter, which take
                files of any name. None: see path.
    properties  of the writer's proxy: WriteTimeSteps, Dialect, Style, Label, Columns, NumberFormat, ...

    Files are written under a temporary name and renamed when all are complete; after an error the old ones are untouched. On a pvserver,
    ParaView's own writers write in place. A file that is read is replaced after the last frame, and only in a format of this plugin.

    Raises ValueError for a name that is not UTF-8, and for an ending that no writer has for such data; AttributeError for a property,
    or a writer, that there is not; RuntimeError with the message if the file could not be written.
    """
    from paraview import servermanager

    path = expect_utf8(os.fsdecode(path))
    update(proxy, time)
    if writer is None and os.path.splitext(path)[1].lower() == ".csv":
        _save_table(proxy, path, properties)
        return
    writer = writer or _choose(proxy, path)
    if writer is None:
        _save_by_paraview(proxy, path, properties)
        return
    if "*" in os.path.basename(path):  # the writer knows the readers of this plugin alone
        folder, name = os.path.split(path)
        foreign = _inputs(proxy, ours=False)
        for old in glob.glob(os.path.join(glob.escape(folder), "*".join(map(glob.escape, name.split("*", 1))))) if foreign else ():
            if _is_one_of(old, foreign):
                raise ValueError(f"{shown(old)}: expected other files to write, got one that is read")
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
