# SPDX-License-Identifier: BSD-3-Clause
"""The writers: data of the pipeline as files, by the C library."""
from __future__ import annotations

import os
from typing import Any, Iterator

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkInformationVector
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from .. import _library as c
from ._contents import DUPLICATE, Content, Rows, box_of
from ._ranks import gather, is_first, no_garbage_collected, share, together
from ._readers import Reader
from ._told import Told, message_of


def _is_whole(number: Any, most: int = 2**53) -> bool:
    return number is not None and float(number).is_integer() and abs(number) < most


def _shown_time(algorithm: Any, port: int, otherwise: float) -> float:
    """Returns the time that was asked for: a filter that is new, as ParaView puts some before writers, has not been asked yet."""
    while algorithm:
        info = algorithm.GetOutputInformation(port)
        if info.Has(Pipeline.UPDATE_TIME_STEP()):
            return float(info.Get(Pipeline.UPDATE_TIME_STEP()))
        connection = algorithm.GetInputConnection(0, 0) if algorithm.GetNumberOfInputPorts() else None
        algorithm, port = (connection.GetProducer(), connection.GetIndex()) if connection else (None, 0)
    return otherwise


class Writer(VTKPythonAlgorithmBase):
    """Base of the writers: the frames of the input, the ranks, and the file."""

    style = ""
    defaults: dict[str, Any] = {}

    def __init__(self) -> None:
        super().__init__(nInputPorts=1, nOutputPorts=0, inputType="vtkDataObject")
        self.values = dict(self.defaults)
        self._path, self._ghosts, self._message, self._written = "", 0, "", 0
        self._told = Told(self)

    def SetFileName(self, name: str) -> None:
        self._path = name or ""

    def SetGhostLevel(self, level: int) -> None:
        self._ghosts = level

    def GetWritten(self) -> int:
        return self._written

    def GetErrorMessage(self) -> str:
        return self._message

    def Write(self) -> int:
        self._written, self._message = 0, ""
        self._told.forget()
        try:
            with no_garbage_collected():
                self._write()
            self._written = 1
        except c.Cancelled:
            pass
        except Exception as error:  # noqa: BLE001 (which ParaView would print and forget)
            self._message = message_of(error) or type(error).__name__
            self._told.error(self._message)
        self._told.tell()
        return self._written

    # ---- the input ----
    def _frames(self) -> Iterator[tuple[Any, float | None, float | None]]:
        """Yields the data of each frame, its time, and its time as a timestep where those of all frames are whole."""
        if not self.GetNumberOfInputConnections(0):
            raise c.Error("no input: expected points to write")
        connection = self.GetInputConnection(0, 0)
        source, port = connection.GetProducer(), connection.GetIndex()
        source.UpdateInformation()
        info = source.GetOutputInformation(port)
        all_times = list(info.Get(Pipeline.TIME_STEPS()) or ()) if info.Has(Pipeline.TIME_STEPS()) else []
        times = all_times if self.values["WriteTimeSteps"] else []
        if share(times) != times:
            raise c.Error("expected the time steps of the first process, got others")
        shown = _shown_time(source, port, times[0]) if times else None
        try:
            yield from self._updates(source, port, info, times)
        finally:
            if shown is not None:
                info.Set(Pipeline.UPDATE_TIME_STEP(), shown)
                source.GetExecutive().PropagateUpdateExtent(port)

    def _updates(self, source: Any, port: int, info: Any, times: list[float]) -> Iterator[tuple[Any, float | None, float | None]]:
        """Updates the input to each time, or once."""
        controller = vtkMultiProcessController.GetGlobalController()
        for time in times or [None]:  # type: ignore[list-item]
            requests = vtkInformationVector()
            requests.SetNumberOfInformationObjects(port + 1)
            request = requests.GetInformationObject(port)
            if time is not None:
                info.Set(Pipeline.UPDATE_TIME_STEP(), time)
            request.Set(Pipeline.UPDATE_PIECE_NUMBER(), controller.GetLocalProcessId() if controller else 0)
            request.Set(Pipeline.UPDATE_NUMBER_OF_PIECES(), controller.GetNumberOfProcesses() if controller else 1)
            request.Set(Pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS(), self._ghosts)
            made, data = source.Update(port, requests), source.GetOutputDataObject(port)
            if not made or data is None:
                raise c.Error(f"{c.shown(self._path)}: the input could not be made, and nothing is written: see the messages before")
            there = data.GetInformation()
            now = there.Get(vtkDataObject.DATA_TIME_STEP()) if there.Has(vtkDataObject.DATA_TIME_STEP()) else None
            whole = all(map(_is_whole, times or [now]))
            yield data, now, (time if times else now) if whole else None

    def _runs(self) -> list[Any]:
        """The runs of all readers upstream."""
        found = [self]
        for algorithm in found:  # which grows
            for port in range(algorithm.GetNumberOfInputPorts()):
                for i in range(algorithm.GetNumberOfInputConnections(port)):
                    before = algorithm.GetInputAlgorithm(port, i)
                    if before not in found:
                        found.append(before)
        return [each._run for each in found if isinstance(each, Reader) and each._run]

    def take(self, data: Any) -> Rows:
        """Takes this rank's rows of a frame."""
        raise NotImplementedError

    # ---- the file ----
    def format(self) -> c.Format:
        """Returns the format of the file by the properties."""
        made, values = c.Format(), self.values
        c.library().granular_format_init(c.byref(made))
        made.style = self.style.encode()
        for field, name in (("numbers", "NumberFormat"), ("columns", "Columns"), ("label", "Label")):
            if values.get(name):
                setattr(made, field, values[name].encode())
        made.dialect = (b"LIGGGHTS", b"LAMMPS", b"")[values["Dialect"]] if self.style in ("", "local") else b""
        for field, name in (("scaled", "Scaled"), ("image", "Image"), ("sort_by_id", "SortById"), ("write_units", "WriteUnits"),
                            ("write_time", "WriteTime"), ("threads", "Threads"), ("durable", "Durable")):
            if name in values:
                setattr(made, field, int(values[name]))
        return made

    def _write(self) -> None:
        if not self._path:
            raise c.Error("no file to write: set FileName first")
        if "%" in os.path.basename(self._path) and self.style in ("euler", "decomposition"):
            raise c.Error(f"{c.shown(self._path)}: expected a name without '%': one file holds the rows of all ranks")
        library = c.library()
        pointers: list[Any] = []  # to the files that are being written, by the first rank
        frames, number = self._frames(), 0
        calls = c.Calls(self._progress, self._told.warn)

        def take() -> Any:
            data, time, step = next(frames, (None, None, None))
            return None if data is None else (self.take(data), time, step)

        def write() -> None:
            with calls:
                for path in [] if pointers else self._paths(len(parts)):
                    given, pointer = self.format(), c.c_void_p()
                    given.progress, given.notice = calls.progress, calls.notice
                    library.granular_create(c.name_bytes(path), c.byref(given), c.byref(pointer))
                    pointers.append(pointer)
                    for run in self._runs():
                        library.granular_add_input(pointer, run._open())
                self._write_frame(pointers, [rows for rows, *_ in parts], number, *parts[0][1:])

        def finish() -> None:
            while pointers:
                library.granular_finish(pointers.pop(0))

        try:
            while True:
                parts = gather(together(take))
                if share(not all(parts)):  # as the first rank has it
                    break
                together(lambda: write() if is_first() else None)
                number += 1
            together(lambda: finish() if is_first() else None)
        finally:
            frames.close()
            self.SetAbortExecute(0)  # holds for one file
            for pointer in pointers:
                library.granular_abandon(pointer)

    def _paths(self, ranks: int) -> list[str]:
        """Returns the names of the files: one for each rank where the name has a place for its number."""
        folder, name = os.path.split(self._path)
        return [os.path.join(folder, name.replace("%", str(rank), 1)) for rank in range(ranks)] if "%" in name else [self._path]

    def _progress(self, fraction: float) -> bool:
        self.UpdateProgress(fraction)
        return not self.GetAbortExecute()

    def _write_frame(self, pointers: list[Any], parts: list[Rows], number: int, time: float | None, step: float | None) -> None:
        """Writes the rows of all ranks, with the facts of the first one that has any."""
        filled = [part for part in parts if len(part)] or parts[:1]
        known = filled[0]
        for rank, part in enumerate(parts):
            other = sorted(part.arrays.keys() ^ known.arrays.keys()) if len(part) else []
            if other:
                raise c.Error(f"{c.shown(self._path)}: column '{other[0]}': expected the same arrays on all ranks, got others (on rank {rank} "
                              f"of {len(parts)})")
        for text in (text for part in filled for text in part.told):
            self._told.warn(text)
        # a file knows nothing of the others: neither where their rows are nor how many
        if len(pointers) > 1 and not self.style and (self.values["SortById"] or "id" not in known.arrays or self.box(known.facts) is None):
            raise c.Error(f"{c.shown(self._path)}: expected points with an array 'id' and a box, and SortById off, for a file of each rank")
        facts = known.facts
        for pointer, group in zip(pointers, [[part] for part in parts] if len(pointers) > 1 else [filled]):
            arrays = self.arrange({name: values if group == [known] else
                                   numpy.concatenate([part.arrays.get(name, values[:0]) for part in group])
                                   for name, values in known.arrays.items()})
            content = Content(arrays, facts)
            self._set_time(content, facts, number, step, time)
            content.set_box(self.box(facts))
            c.library().granular_write(pointer, c.byref(content))

    def _set_time(self, content: Content, facts: dict[str, Any], number: int, step: int | None, time: float | None) -> None:
        """Gives a frame its timestep and time."""
        if content.timestep == c.NO_TIMESTEP:
            if self.style in ("", "local") or ("*" in os.path.basename(self._path) and step is None):
                self._told.warn("the input has no field data 'timestep': " + ("its time is taken for it" if step is not None else
                                                                             "frames are counted from 0"))
            content.timestep = int(step) if step is not None else number
        of_file = facts["time"] is not None and len(facts["time"]) == 1
        content.has_time = int(of_file or time is not None)
        content.time = float(facts["time"][0]) if of_file else float(time or 0)

    def arrange(self, arrays: dict[str, Any]) -> dict[str, Any]:
        """Returns the rows of all ranks in the order of the file."""
        return arrays

    def box(self, facts: dict[str, Any]) -> c.CBox | None:
        """Returns the box that is written."""
        return box_of(facts)


class GranularDumpWriter(Writer):
    def take(self, data: Any) -> Rows:
        if not data.IsA("vtkPointSet"):
            raise c.Error(f"{c.shown(self._path)}: expected a vtkPointSet to write, got a {data.GetClassName()}")
        rows, count = Rows(data), data.GetNumberOfPoints()
        if data.GetPoints():
            rows.arrays["points"] = vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 3)
        rows.see(data.GetPointData(), count)
        rows.leave_out(data.GetPointGhostArray())
        return rows

    def format(self) -> c.Format:
        if self.values["Style"] == 1 and (not self.values["Scaled"] or self.values["Image"]):
            self._told.warn("Scaled and Image are of the Style Atom: this is Custom, see Columns")
        if self.values["Style"] == 0 and self.values["Columns"]:
            self._told.warn("Columns are of the Style Custom: this is Atom")
        made = super().format()
        made.style = (b"atom", b"custom")[self.values["Style"]]
        return made

    def box(self, facts: dict[str, Any]) -> c.CBox | None:
        box, vectors = super().box(facts), self.values["BoxVectors"]
        flags = self.values["Boundary"].encode() or (box.boundary if box else b"")
        if any(vectors):
            box = c.CBox()
            box.origin[:], box.vectors[:] = self.values["BoxOrigin"], vectors
        if box is not None:
            box.boundary = flags
        return box


class GranularLocalWriter(Writer):
    style = "local"

    def take(self, data: Any) -> Rows:
        rows = Rows(data)
        if data.IsA("vtkTable"):
            rows.see(data.GetRowData(), data.GetNumberOfRows())
            return rows
        if not data.IsA("vtkPolyData"):
            raise c.Error(f"{c.shown(self._path)}: expected a vtkPolyData with lines, or a vtkTable, to write, got a {data.GetClassName()}: "
                          "the filter ExtractSurface makes lines of it")
        lines = data.GetLines()
        for others, name in ((data.GetVerts(), "vertices"), (data.GetPolys(), "polygons"), (data.GetStrips(), "triangle strips")):
            if others and others.GetNumberOfCells():
                raise c.Error(f"{c.shown(self._path)}: expected lines to write and no other cells, got {others.GetNumberOfCells()} {name}")
        count = lines.GetNumberOfCells() if lines else 0
        if count and lines.GetMaxCellSize() != 2 or (count and lines.GetNumberOfConnectivityIds() != 2 * count):
            raise c.Error(f"{c.shown(self._path)}: expected lines of two points each to write, got others")
        rows.see(data.GetCellData(), count)
        if not count and not rows.arrays:
            if data.GetFieldData().GetAbstractArray("Columns"):
                rows.told.append("the input has no lines, as its file does not say where these are: rows are on the second output of the "
                                 "reader")
            return rows
        columns = () if rows.facts["Columns"] is None else rows.facts["Columns"]
        part = rows.arrays.get("part")
        is_split = part is not None and part.dtype.kind == "i" and "row" in rows.arrays
        begins = (part == 0).nonzero()[0] if is_split else numpy.arange(count)
        ends = numpy.append(begins[1:], count) - 1 if len(begins) else begins
        if is_split and count:
            counted = numpy.arange(count) - numpy.repeat(begins, ends - begins + 1) if len(begins) and begins[0] == 0 else -1
            if numpy.any(counted != part):
                raise c.Error(f"{c.shown(self._path)}: expected all parts of a line one after the other, got others")
        ghosts = data.GetCellGhostArray()
        if ghosts:
            own = (vtk_to_numpy(ghosts)[begins] & DUPLICATE) == 0
            begins, ends = begins[own], ends[own]
        rows.keep(begins)
        if not self.values["Columns"]:
            drawn = next(name for name in ("length", *(f"length_{i}" for i in range(2, len(columns) + 3))) if name not in columns)
            for name in (drawn, "row", "part"):
                if name not in columns:
                    rows.arrays.pop(name, None)
        if data.GetNumberOfPoints():
            origin = rows.facts["PointOrigin"]
            points = vtk_to_numpy(data.GetPoints().GetData()) + (0 if origin is None else origin.reshape(3))
            of_lines = vtk_to_numpy(lines.GetConnectivityArray()).reshape(-1, 2)
            for name, at in (("position1", of_lines[begins, 0]), ("position2", of_lines[ends, 1])):
                rows.arrays.setdefault(name, points[at].astype(float))
        else:
            for name in ("position1", "position2"):
                rows.arrays.setdefault(name, numpy.empty((0, 3)))
        return rows


#: Arrays of cells that files have.
_CELLS = ("v_avg", "volumefraction", "radius", "pressure", "sigma", "tau")


class GranularEulerWriter(Writer):
    style = "euler"

    def format(self) -> c.Format:
        made = super().format()
        made.dialect = (b"LIGGGHTS", b"Wide", b"")[self.values["Dialect"]]
        return made

    def take(self, data: Any) -> Rows:
        if not data.IsA("vtkCompositeDataSet"):
            return self._cells(data)
        rows, blocks, parts = Rows(data), data.NewIterator(), []
        blocks.InitTraversal()
        while not blocks.IsDoneWithTraversal():
            part = self._cells(blocks.GetCurrentDataObject(), rows.facts)
            if rows.facts["timestep"] is None and part.facts["timestep"] is not None:
                rows.facts = {**part.facts, "PointOrigin": None}
            parts += [part.arrays] if len(part) else []
            blocks.GoToNextItem()
        known = [name for name in parts[0] if all(name in arrays for arrays in parts) and name != "place"] if parts else []
        rows.arrays = {name: numpy.concatenate([arrays[name] for arrays in parts]) for name in known} or {"points": numpy.empty((0, 3))}
        return rows

    def _cells(self, data: Any, facts: dict[str, Any] | None = None) -> Rows:
        """Takes the cells of a data set, which may be a block of one with such facts. Those of a grid have a place in it."""
        rows = Rows(data)
        if facts is not None and rows.facts["Coordinates"] is None:
            rows.facts = {**facts, "timestep": rows.facts["timestep"]}
        if data.IsA("vtkPointSet"):
            rows.add_points(data)
            attributes, ghosts = data.GetPointData(), data.GetPointGhostArray()
        elif data.IsA("vtkImageData") or data.IsA("vtkRectilinearGrid"):
            first, along = data.GetExtent()[::2], self._middles(data)
            for name, axes in (("points", along), ("place", [first[i] + numpy.arange(len(along[i])) for i in range(3)])):
                z, y, x = numpy.meshgrid(*axes[::-1], indexing="ij")
                rows.arrays[name] = numpy.stack([x, y, z], axis=-1).reshape(-1, 3)
            rows.arrays["points"] = rows.arrays["points"] + (0 if rows.facts["PointOrigin"] is None else rows.facts["PointOrigin"].reshape(3))
            rows.facts["PointOrigin"] = None
            attributes, ghosts = data.GetCellData(), data.GetCellGhostArray()
        else:
            raise c.Error(f"{c.shown(self._path)}: expected points, a vtkImageData or a vtkRectilinearGrid of cells to write, got a "
                          f"{data.GetClassName()}")
        if len(rows):
            rows.see(attributes, len(rows), _CELLS)
            for name in _CELLS[:4]:
                if name not in rows.arrays:
                    raise c.Error(f"{c.shown(self._path)}: column '{name}': expected the array in the data of the "
                                  f"{'cells' if 'place' in rows.arrays else 'points'}, got none")
        rows.leave_out(ghosts)
        return rows

    def _middles(self, data: Any) -> list[Any]:
        """Returns the middles of the cells of a grid along its axes. A flat one has cells in its plane."""
        extent, middles = data.GetExtent(), []
        if data.IsA("vtkImageData") and not data.GetDirectionMatrix().IsIdentity():
            raise c.Error(f"{c.shown(self._path)}: expected an image along the axes, got a turned one")
        for axis, name in enumerate("XYZ"):
            first, last = extent[2 * axis:2 * axis + 2]
            if data.IsA("vtkImageData"):
                numbers = numpy.arange(first, max(last, first + 1) if last >= first else first) + (0 if last == first else 0.5)
                middles.append(data.GetOrigin()[axis] + numbers * data.GetSpacing()[axis])
            else:
                faces = vtk_to_numpy(getattr(data, f"Get{name}Coordinates")()).astype(float)
                middles.append(faces if last == first else faces[:-1] + (faces[1:] - faces[:-1]) / 2)
        return middles

    def arrange(self, arrays: dict[str, Any]) -> dict[str, Any]:
        place = arrays.pop("place", None)
        if not len(arrays["points"]):
            return {"points": numpy.empty((0, 3)), **{name: numpy.empty((0, 3) if name == "v_avg" else 0) for name in _CELLS[:4]}}
        if place is None:
            return arrays
        order = numpy.lexsort(place.T)  # by z, then y, then x
        return {name: values[order] for name, values in arrays.items()}


class GranularDecompositionWriter(Writer):
    style = "decomposition"

    def format(self) -> c.Format:
        made = super().format()
        made.dialect = (b"INL", b"PUBLIC")[self.values["Dialect"]]
        return made

    def take(self, data: Any) -> Rows:
        if not data.IsA("vtkUnstructuredGrid"):
            raise c.Error(f"{c.shown(self._path)}: expected a vtkUnstructuredGrid of voxels to write, got a {data.GetClassName()}")
        rows = Rows(data)
        if rows.facts["BoxBounds"] is not None and rows.facts["BoxBounds"].size == 9:
            raise c.Error(f"{c.shown(self._path)}: expected a box along the axes, got a tilted one, whose subdomains are no voxels")
        rows.see_voxels(data, f"{c.shown(self._path)}: ")
        rows.leave_out(data.GetCellGhostArray())
        return rows

    def box(self, facts: dict[str, Any]) -> c.CBox | None:
        return None


WRITERS = {f"vtk{made.__name__}": made for made in (GranularDumpWriter, GranularLocalWriter, GranularEulerWriter, GranularDecompositionWriter)}
