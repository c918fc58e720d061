# SPDX-License-Identifier: BSD-3-Clause
"""The readers: the runs of the C library as sources of the pipeline."""
from __future__ import annotations

import math
import os
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkAbstractArray, vtkDataArraySelection, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPartitionedDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkExtentTranslator
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from .._options import FILES, FRAME, Option
from .._run import Run, kind_of
from ._algorithm import Algorithm, asked_output, piece_of
from ._arrays import Table, cells, fill_lines, fill_particles, fill_voxels, numbers, texts
from ._choice import ArrayChoice
from ._ranks import is_first, ranks_of_paraview, threads_of_rank, together

#: What the compiled readers call other values than the library: Double is 1 there.
_CHOICES = {"PointPrecision": ("single", "double")}


class Reader(Algorithm):
    """Base of the readers: the files, the run behind them, and the choice of arrays.

    kind    of files, as `kind` of vtkgranular.open
    tables  the selections of arrays: "Points" for those of table 0, "Cells" for those of lines
    """

    kind, tables = "", ()
    presets: dict[int, str] = {}

    def __init__(self) -> None:
        super().__init__()
        self._paths: list[str] = []
        self._run: Run | None = None
        self._opened: Any = None  # with these options
        self._stale = False
        self._choices = {name: ArrayChoice(self, self.kind == "restart") for name in ("Points", "Cells")}

    # ---- properties ----
    def AddFileName(self, name: str) -> None:
        if name:
            self._paths.append(name)
            self.Modified()

    def ClearFileNames(self) -> None:
        self._paths = []
        self.Modified()

    def Refresh(self) -> None:
        self._stale = True
        self.Modified()

    def GetPointDataArraySelection(self) -> vtkDataArraySelection:
        return self._choices["Points"].selection

    def GetCellDataArraySelection(self) -> vtkDataArraySelection:
        return self._choices["Cells"].selection

    def CanReadFile(self, name: str) -> int:
        return int(kind_of(name) in self.kinds())

    @classmethod
    def kinds(cls) -> tuple[str, ...]:
        return (cls.kind,)

    # ---- the run ----
    def _given(self, options: tuple[Option, ...]) -> dict[str, Any]:
        """The options of the library that are properties of the reader."""
        given = {}
        for option in options:
            value = self.values.get(option.property)
            if value is None or (option.type in ("text", "names") and not value):
                continue
            if option.property == "Preset":
                value = self.presets[value]
            elif option.type == "choice":
                value = _CHOICES.get(option.property, option.choices)[value]
            elif option.type == "region":
                value = [pair if pair[0] <= pair[1] and any(pair) else None for pair in (value[:2], value[2:4], value[4:])]
            given[option.name] = value
        given["threads"] = given.get("threads") or threads_of_rank()
        return given

    def _open(self) -> Run:
        """Opens the run, unless it is open already, and offers its arrays."""
        if not self._paths:
            raise c.Error("no file to read: set FileNames first")
        options = {**self._given(FILES), "kind": self.kind_of_files()}
        if self._run is None or self._opened != (self._paths, options):
            self._run = None
            if self._opened and self._opened[0] != self._paths:
                self._told.forget()
            together(lambda: _expect_files(self._paths) if is_first() else None)
            self._run = Run(self._paths, options, self._progress, ranks_of_paraview(), self._told.warn)
            self._opened = list(self._paths), options
        elif self._stale:
            self._run.refresh(self._progress)
        else:
            return self._run
        self._stale = False
        self._offer(self._run)
        return self._run

    def kind_of_files(self) -> str:
        return self.kind

    def _offer(self, run: Run) -> None:
        for table, name in enumerate(self.tables):
            self._choices[name].offer(_columns(run, c.EVERY_FRAME, table))

    # ---- the pipeline ----
    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        def work() -> None:
            times = [float(time) for time in self._open().times]
            for port in range(len(self.ports)):
                info = outputs.GetInformationObject(port)
                info.Set(Pipeline.TIME_STEPS(), times, len(times))
                info.Set(Pipeline.TIME_RANGE(), [times[0], times[-1]], 2)
                self.inform(self._run, info)

        for port in range(len(self.ports)):
            info = outputs.GetInformationObject(port)
            info.Remove(Pipeline.TIME_STEPS())
            info.Remove(Pipeline.TIME_RANGE())
            info.Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)  # also after an error, or the first rank alone is asked for data, and waits
        return self._guarded(work, outputs)

    def inform(self, run: Run | None, info: Any) -> None:
        """Tells the pipeline more of an output."""

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        def work() -> None:
            run, info = self._open(), asked_output(request, outputs)
            time = info.Get(Pipeline.UPDATE_TIME_STEP()) if info.Has(Pipeline.UPDATE_TIME_STEP()) else None
            number = 0 if time is None else run.find(time).number
            piece, pieces = piece_of(info)
            datasets = [vtkDataObject.GetData(outputs, i) for i in range(len(self.ports))]
            self.fill(run, number, {"piece": piece, "pieces": pieces}, datasets)
            for data in datasets:
                data.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), float(run.times[number]))
                _hide_facts(data.GetFieldData())

        return self._guarded(work, outputs)

    def read(self, run: Run, number: int, piece: dict[str, int], table: int = 0, points: bool = True) -> Table:
        """Reads the chosen arrays of a table of a frame."""
        lines = self.tables[table] == "Cells"
        choice, columns = self._choices[self.tables[table]], _columns(run, number, table)
        for name in choice.missing() - dict(columns).keys():
            self._told.warn(f"{c.shown(run._place_of(number)[1][1])}: no frame has the array '{name}' asked for")
        names = [*(["ends"] if lines and points else ["points"] if points else []), *choice.choose(columns)]
        asked = {**self._given(FRAME), **piece}
        if not points:
            asked.pop("periodic_lines", None)
        handle = run._read(number, names, bool(table), asked, self._progress, self._told.warn, for_vtk=True)
        return Table(handle, lines and asked.get("periodic_lines") == "split", asked.get("precision") == "single", takes=True)

    def fill(self, run: Run, number: int, piece: dict[str, int], outputs: list[Any]) -> None:
        """Fills the outputs with a frame."""
        raise NotImplementedError

    def fill_box(self, run: Run, number: int, piece: dict[str, int], table: Table, box: Any) -> None:
        """Fills an output with the box of a frame, on the first rank alone."""
        if piece["piece"] == 0 and table.header.has_box and not table.fill_box(box):
            self._told.warn(f"{c.shown(run._place_of(number)[1][1])}: the box is not finite and not shown")
        table.add_header(box.GetFieldData())
        table.add_columns(box.GetFieldData())


def _expect_files(paths: list[str]) -> None:
    """Raises the error of a file that is not there: the library takes its name for a pattern."""
    for path in paths:
        try:
            os.stat(path)
        except OSError as error:
            raise c.Error(f"{c.shown(path)}: cannot open: {error.strerror}") from None


def _hide_facts(fields: Any) -> None:
    """Keeps what describes a frame, such as its box, out of ParaView's lists of colours."""
    for i in range(fields.GetNumberOfArrays()):
        array = fields.GetAbstractArray(i)
        if array.GetName() != "imbalance":
            array.GetInformation().Set(vtkAbstractArray.GUI_HIDE(), 1)


def _columns(run: Run, number: int, table: int) -> list[tuple[str, bool]]:
    """Returns the names of the arrays of a table of a frame, or of every frame, and whether each is usual."""
    offered = run._columns(number, bool(table))
    return [(column.name, is_usual) for columns, is_usual in ((offered.usual, True), (offered.others, False)) for column in columns]


def _part(count: int, piece: dict[str, int]) -> tuple[int, int]:
    """Returns where a piece of so many rows begins and ends."""
    begin, end = (count * each // piece["pieces"] for each in (piece["piece"], piece["piece"] + 1))
    return begin, end


class _Particles(Reader):
    """Particles, perhaps bonds, and the box."""

    _vertices: Any = None, None  # of the last frame: their number and form, and the cells

    def fill(self, run: Run, number: int, piece: dict[str, int], outputs: list[Any]) -> None:
        table = self.read(run, number, piece)
        if not table.has_points:
            raise c.Error(f"{c.shown(run._place_of(number)[1][1])}: expected columns of coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu), "
                          f"got '{' '.join(table.columns)}'")
        particles, box = outputs[0], outputs[-1]
        fill_particles(particles, table, 0)
        rows, form = particles.GetNumberOfPoints(), self.values.get("Vertices", 2)
        if rows and form:
            shape = (rows, 1) if form == 2 else (1, rows)
            if self._vertices[0] != shape:  # most frames have as many particles as the one before
                self._vertices = shape, cells(*shape)
            particles.SetVerts(self._vertices[1])
        table.add_header(particles.GetFieldData())
        table.add_columns(particles.GetFieldData())
        self.fill_box(run, number, piece, table, box)
        if len(outputs) == 3:
            bonds = self.read(run, number, piece, 1)
            if not bonds.has_lines:
                bonds.add_no_lines(self.values.get("PeriodicLines") == 1)
            _fill_lines(outputs[1], bonds)
        groups = [c.text(name) for name in table.header.groups[:table.header.group_count]]
        if groups:
            particles.GetFieldData().AddArray(texts("Groups", groups))
        left_out = [f"Stride {self.values['Stride']}"] if self.values.get("Stride", 1) > 1 else []
        if "region" in self._given(FRAME) and any(self._given(FRAME)["region"]):
            left_out.append("RegionOfInterest")
        for output in outputs if left_out else []:
            output.GetFieldData().AddArray(texts("ParticlesLeftOut", left_out))


def _fill_lines(lines: Any, table: Table) -> None:
    """Fills an output with lines, their arrays and what is known of them."""
    if table.has_lines:
        fill_lines(lines, table)
    table.add_header(lines.GetFieldData())
    table.add_columns(lines.GetFieldData())


class GranularDumpReader(_Particles):
    kind, ports, tables = "dump", ("vtkPolyData", "vtkUnstructuredGrid"), ("Points",)


class GranularRestartReader(_Particles):
    kind, ports, tables = "restart", ("vtkPolyData", "vtkPolyData", "vtkUnstructuredGrid"), ("Points", "Cells")


class GranularDataFileReader(_Particles):
    kind, ports, tables = "data", ("vtkPolyData", "vtkPolyData", "vtkUnstructuredGrid"), ("Points", "Cells")


class GranularLocalReader(Reader):
    kind, ports, tables = "local", ("vtkPolyData", "vtkTable", "vtkUnstructuredGrid"), ("Cells",)

    def fill(self, run: Run, number: int, piece: dict[str, int], outputs: list[Any]) -> None:
        table = self.read(run, number, piece)
        _fill_lines(outputs[0], table)
        rows = self.read(run, number, piece, points=False) if self.values.get("PeriodicLines") == 1 else table
        rows.add_to(outputs[1].GetRowData(), rows.arrays.values())
        rows.add_header(outputs[1].GetFieldData())
        rows.add_columns(outputs[1].GetFieldData())
        self.fill_box(run, number, piece, table, outputs[2])


class GranularDecompositionReader(Reader):
    kind, ports, tables = "decomposition", ("vtkUnstructuredGrid",), ("Points",)

    def fill(self, run: Run, number: int, piece: dict[str, int], outputs: list[Any]) -> None:
        # each rank reads all, and keeps its piece
        table = Table(run._read(number, None, False, {}, self._progress, self._told.warn))
        grid, known = outputs[0], {name: vtk_to_numpy(array) for name, array in table.arrays.items()}
        table.add_header(grid.GetFieldData())
        if "nlocal" in known:
            counts = known["nlocal"]
            imbalance = float(counts.max(initial=0)) * len(counts) / math.fsum(counts) if counts.any() else 1.0
            grid.GetFieldData().AddArray(numbers("imbalance", numpy.array([imbalance])))
        fill_voxels(grid, known, *_part(len(known["lo"]), piece))


#: Names of components that are not those of a vector along x, y and z.
_TENSORS = {f"{name}{part}": parts for part in ("", "_kinetic", "_contact") for name, parts in
            (("sigma", ("XX", "YY", "ZZ")), ("tau", ("XY", "XZ", "YZ")))} | {"fabric": ("XX", "YY", "ZZ", "XY", "XZ", "YZ")}


class GranularEulerReader(Reader):
    kind, ports, tables = "euler", ("vtkDataObject",), ("Points",)

    def __init__(self) -> None:
        super().__init__()
        self._form: Any = None  # of all frames, as the first one that has cells tells: run, timestep, the grid of an image or None

    @classmethod
    def kinds(cls) -> tuple[str, ...]:
        return "euler", "grid"

    def kind_of_files(self) -> str:
        return "grid" if kind_of(self._paths[0]) == "grid" else "euler"

    def _is_image(self) -> bool:
        return self.values["Output"] == 1

    def _grids(self, run: Run, table: Table) -> list[c.Grid]:
        library, count = c.library(), c.c_size_t()
        with c.Calls(None, self._told.warn) as calls:
            library.granular_grids(table.handle, calls.notice, None, None, 0, c.byref(count))
        grids = (c.Grid * max(1, count.value))()
        library.granular_grids(table.handle, c.NOTICE(), None, grids, count.value, c.byref(count))
        return list(grids[:count.value])

    def _look(self, run: Run) -> tuple[int, bool, Any]:
        """Returns the timestep of the first frame with cells, whether it is one grid, and this grid, if there is one."""
        if self._form is None or self._form[0] != (run, run._state):
            filled = run.rows.nonzero()[0]
            number = int(filled[0]) if len(filled) else len(run) - 1
            number = 0 if run.kind == "grid" else number
            table = Table(run._read(number, ["points"], False, {}, self._progress, lambda _: None))
            grids = self._grids(run, table)
            self._form = (run, run._state), (run._place_of(number)[1][0], len(grids) <= 1, grids[0] if len(grids) == 1 else None)
        return self._form[1]

    # ---- the pipeline ----
    def RequestDataObject(self, request: Any, inputs: Any, outputs: Any) -> int:
        info = outputs.GetInformationObject(0)

        def provide(made: Any) -> None:
            there = info.Get(vtkDataObject.DATA_OBJECT())
            if there is None or there.GetDataObjectType() != made.GetDataObjectType():
                info.Set(vtkDataObject.DATA_OBJECT(), made)

        if not self._is_image():
            provide(vtkPolyData())
            return 1
        if info.Get(vtkDataObject.DATA_OBJECT()) is None:
            provide(vtkImageData())  # whatever happens
        return self._guarded(lambda: provide(vtkImageData() if self._look(self._open())[1] else vtkPartitionedDataSet()), outputs)

    def inform(self, run: Run, info: Any) -> None:
        for key in (self.CAN_PRODUCE_SUB_EXTENT(), Pipeline.WHOLE_EXTENT(), vtkDataObject.ORIGIN(), vtkDataObject.SPACING()):
            info.Remove(key)
        if self._is_image() and self._look(run)[1]:
            grid = self._look(run)[2]
            info.Remove(self.CAN_HANDLE_PIECE_REQUEST())
            info.Set(self.CAN_PRODUCE_SUB_EXTENT(), 1)
            info.Set(Pipeline.WHOLE_EXTENT(), _extent(grid) if grid else [0, -1, 0, -1, 0, -1], 6)
            info.Set(Pipeline.UNRESTRICTED_UPDATE_EXTENT(), 1)
            info.Set(vtkDataObject.ORIGIN(), grid.lo[:] if grid else [0.0, 0.0, 0.0], 3)
            info.Set(vtkDataObject.SPACING(), grid.spacing[:] if grid else [1.0, 1.0, 1.0], 3)

    def fill(self, run: Run, number: int, piece: dict[str, int], outputs: list[Any]) -> None:
        # each rank reads all, and keeps its part
        output, info = outputs[0], self.GetOutputInformation(0)
        table = Table(run._read(number, ["points", *self._choices["Points"].choose(_columns(run, number, 0))], False, self._given(FRAME), self._progress, self._told.warn))
        grids = self._grids(run, table) if self._is_image() else []
        arrays = {name: vtk_to_numpy(array) for name, array in table.arrays.items()}
        count = table.points.GetNumberOfPoints()
        if not self._is_image():
            begin, end = _part(count, piece)
            points = vtkPoints()
            points.SetData(numbers("Points", vtk_to_numpy(table.points.GetData())[begin:end]))
            output.SetPoints(points)
            output.SetVerts(cells(end - begin, 1))
            _add_values(output.GetPointData(), {name: values[begin:end] for name, values in arrays.items()})
        elif self._look(run)[1]:
            step, _, known = self._look(run)
            if len(grids) > 1 or (grids and known and grids[0].counts[:] != known.counts[:]):
                expected, got = (" x ".join(map(str, grid.counts)) for grid in (known, grids[0]))
                got = f"{len(grids)} grids" if len(grids) > 1 else got
                raise c.Error(f"{run._place_of(number)[1][1]}: expected a grid of {expected} cells as at timestep {step}, got {got}: "
                              "with the output Points all can be shown")
            if grids:
                _fill_image(output, grids[0], arrays, self._asked(info, _extent(known)))
            else:
                _add_values(output.GetCellData(), {name: values[:0] for name, values in arrays.items()})
        else:
            begin, end = _part(len(grids), piece)
            output.SetNumberOfPartitions(len(grids))
            for i in range(begin, end):
                image = vtkImageData()
                _fill_image(image, grids[i], arrays, _extent(grids[i]))
                output.SetPartition(i, image)
        if not table.header.has_box:
            _set_box(table, grids)
        table.add_header(output.GetFieldData())

    @staticmethod
    def _asked(info: Any, whole: list[int]) -> list[int]:
        """Returns the part of an image that is asked for: an extent, or a piece."""
        asked = list(info.Get(Pipeline.UPDATE_EXTENT())) if info.Has(Pipeline.UPDATE_EXTENT()) else whole
        if all(asked[i] >= whole[i] and asked[i + 1] <= whole[i + 1] for i in (0, 2, 4)):
            return asked
        translator = vtkExtentTranslator()
        translator.SetWholeExtent(whole)
        translator.SetPiece(info.Get(Pipeline.UPDATE_PIECE_NUMBER()))
        translator.SetNumberOfPieces(info.Get(Pipeline.UPDATE_NUMBER_OF_PIECES()))
        translator.SetGhostLevel(info.Get(Pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS()))
        translator.PieceToExtent()
        return list(translator.GetExtent())


def _extent(grid: c.Grid) -> list[int]:
    return [bound for count in grid.counts for bound in (0, count)]


def _add_values(data: Any, arrays: dict[str, Any]) -> None:
    """Adds arrays of cells; which one is shown first and which is a vector is as in VTK's own reader of such files."""
    for name, values in arrays.items():
        made = numbers(name, values)
        made.SetNumberOfComponents(values.shape[1] if values.ndim > 1 else 1)
        for i, part in enumerate(_TENSORS.get(name, ())[:made.GetNumberOfComponents()]):
            made.SetComponentName(i, part)
        data.AddArray(made)
    if "volumefraction" in arrays and arrays["volumefraction"].ndim == 1:
        data.SetActiveScalars("volumefraction")
    if "v_avg" in arrays and arrays["v_avg"].shape[1:] == (3,):
        data.SetActiveVectors("v_avg")


def _fill_image(image: Any, grid: c.Grid, arrays: dict[str, Any], extent: list[int]) -> None:
    """Makes a part of a grid an image, in which its cells have the numbers that they have in the grid."""
    if all(extent[i] < extent[i + 1] for i in (0, 2, 4)):
        image.SetOrigin(grid.lo[:])
        image.SetSpacing(grid.spacing[:])
        image.SetExtent(extent)
    nx, ny, nz = grid.counts
    part = tuple(slice(extent[i], max(extent[i], extent[i + 1])) for i in (4, 2, 0))

    def cut(values: Any) -> Any:
        tail = values.shape[1:]
        return numpy.ascontiguousarray(values[grid.first:grid.first + nx * ny * nz].reshape((nz, ny, nx, *tail))[part]).reshape((-1, *tail))

    _add_values(image.GetCellData(), {name: cut(values) for name, values in arrays.items()})


def _set_box(table: Table, grids: list[c.Grid]) -> None:
    """Gives a frame whose file has no box the smallest one around its points, or around all grids."""
    header, points = table.header, vtk_to_numpy(table.points.GetData()) if table.points.GetNumberOfPoints() else numpy.empty((0, 3))
    places = numpy.array([bound[:] for grid in grids for bound in (grid.lo, grid.hi)]) if grids else points
    for axis in range(3):
        known = places[:, axis][~numpy.isnan(places[:, axis])] if len(places) else places
        header.box.bounds[2 * axis:2 * axis + 2] = [known.min(), known.max()] if len(known) else [0.0, 0.0]
    header.box.has_bounds, header.has_box, header.box.boundary = 1, 1, b"ff ff ff"
    c.library().granular_complete_box(c.byref(header.box))


READERS = {f"vtk{made.__name__}": made for made in (GranularDumpReader, GranularRestartReader, GranularDataFileReader, GranularLocalReader,
                                                    GranularDecompositionReader, GranularEulerReader)}
