# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of files, and the options of vtkgranular.open and Run.read: made of core/granular/runs/options.toml by
tests/lint/options.py."""
from __future__ import annotations

from typing import Any, NamedTuple


class Option(NamedTuple):
    name: str
    property: str  #: of ParaView's readers
    c: str  #: in the structs of granular.h
    type: str
    default: Any
    choices: tuple[str, ...]
    text: str


KINDS = ("dump", "local", "restart", "data", "euler", "decomposition")
#: In the order in which they are asked whether a file is theirs.
READERS = ("GranularDumpReader", "GranularLocalReader", "GranularRestartReader",
           "GranularDataFileReader", "GranularDecompositionReader", "GranularEulerReader")
FILES = (
    Option("dt", "TimestepSize", "timestep_size", "number", 1.0,
           (),
           "time of one timestep, greater than 0, in the unit of the run; default: times are timesteps, unless the files hold times"),
    Option("column_names", "ColumnNames", "column_names", "names", "",
           (),
           "columns of binary dumps that do not name them: \"id type x y z vx vy vz\""),
    Option("preset", "Preset", "preset", "text", "",
           (),
           "order of the columns of contacts and bonds, by its name"),
    Option("column_map", "ColumnMap", "column_map", "names", "",
           (),
           "names of the columns of contacts and bonds, one for each column"),
    Option("atom_style", "AtomStyle", "atom_style", "text", "",
           (),
           "atom style of data files that do not name it"),
    Option("boundary", "Boundary", "boundary", "text", "",
           (),
           "boundaries of the box in data files, which do not hold them: \"p p f\"; empty: axes that particles have crossed are periodic"),
    Option("history_layout", "HistoryLayout", "history_layout", "choice", "automatic",
           ("automatic", "numbered", "with_bonds", "pfm", "flexible_fibers", "flexible_fibers_damage"),
           "program that wrote the history of bonds in restart files, which says what its values are"),
    Option("repeated_steps", "RepeatedSteps", "repeated_steps", "choice", "auto",
           ("auto", "merge", "last"),
           "meaning of a timestep in several files: pieces of one frame (merge), or a run that was restarted (last)"),
    Option("threads", "Threads", "threads", "threads", 0,
           (),
           "number of threads; 0 (default): one per core"),
)
FRAME = (
    Option("region", "RegionOfInterest", "region", "region", None,
           (),
           "bounds xlo, xhi, ylo, yhi, zlo, zhi of the particles, which belong to the region, in absolute coordinates"),
    Option("stride", "Stride", "stride", "count", 1,
           (),
           "n keeps particles whose id is a multiple of n, or each n-th row without ids; 1 (default): all"),
    Option("coordinates", "Coordinates", "coordinates", "choice", "absolute",
           ("absolute", "unwrapped", "scaled"),
           "positions in the box, also moved by the image counts (unwrapped), or in units of the box (scaled)"),
    Option("precision", "PointPrecision", "single_precision", "choice", "double",
           ("double", "single"),
           "points as 64-bit or 32-bit floats"),
    Option("origin", "PointOrigin", "origin", "point", None,
           (),
           "a point that is subtracted from the points before any rounding"),
    Option("sort", "SortById", "sort_by_id", "flag", False,
           (),
           "rows in the order of their ids"),
    Option("periodic_lines", "PeriodicLines", "periodic_lines", "choice", "minimum_image",
           ("minimum_image", "split", "as_written"),
           "drawing of contacts and bonds across periodic faces: to the nearest image, or from end to end as the file has them"),
    Option("threads", "Threads", "threads", "threads", 0,
           (),
           "number of threads; 0 (default): one per core"),
)
