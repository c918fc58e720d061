# SPDX-License-Identifier: BSD-3-Clause
"""Writes files in another form: other forms of dumps, arrays of numpy, tables, files of VTK."""
from __future__ import annotations

import argparse
import os
import re
from typing import Any, Iterable

from .._inline import put_inline
from .._library import shown
from .._options import FRAME
from .._whole_file import whole_file
from . import add_frames, add_option, add_reading, chosen, open_run
from .progress import Bar
from .info import tell_faults

MORE = """The ending of OUT chooses: .npz (numpy), .csv, .vtp, .vtu and .vtkhdf (VTK) hold one frame a file; .bonds, .euler and \
.decomposition are those of contacts, cells and subdomains; .bin is a binary dump; .dump, .lammpstrj and the like are text dumps, compressed where .gz or \
.zst follows. `*` in OUT stands for the timestep and makes a file a frame. Each file appears when it is complete; until then, and after \
an error, an old one is as it was. A file of the run is replaced last, and only by the same kind of file."""

# --threads is one of all commands, and numbers have the precision of the new file.
_PART = [option for option in FRAME if option.name not in ("threads", "precision", "origin", "piece", "pieces")]


def options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of convert."""
    parser.add_argument("files", metavar="IN", nargs="+", help="name or pattern of the files of one run")
    parser.add_argument("out", metavar="OUT", help="name of the new file")
    add_frames(parser)
    add_reading(parser)
    part = parser.add_argument_group("the part to write")
    part.add_argument("--columns", metavar="NAMES", default="", help="columns in their order: 'id type x y z vx vy vz' (default: all)")
    for option in _PART:
        add_option(part, option)
    form = parser.add_argument_group("the form of dumps")
    form.add_argument("--style", choices=("atom", "custom", "local", "euler", "decomposition"), help="(default: by data and ending)")
    form.add_argument("--dialect", default="", help="LIGGGHTS or LAMMPS; of subdomains PUBLIC or INL; of cells LIGGGHTS or Wide")
    form.add_argument("--numbers", metavar="FORMAT", default="", help="%%g, %%.1g to %%.17g or shortest (default: the digits of the file)")
    form.add_argument("--label", default="", help="word for rows of contacts and bonds")
    form.add_argument("--unscaled", action="store_true", help="style atom: x y z instead of xs ys zs")
    form.add_argument("--image", action="store_true", help="style atom: also ix iy iz")
    parser.add_argument("--durable", choices=("auto", "on", "off"), default="auto",
                        help="on: files are on the disk before they get their names, and survive a loss of power "
                        "(default: on for one file, off for a file a frame)")
    parser.add_argument("--quiet", "-q", action="store_true", help="no bar")


def _expect_output(out: str, files: list[str]) -> None:
    """Refuses a name like those of the inputs: the shell has made names of a pattern, and there is no OUT."""
    def shape(path: str) -> str:
        return re.sub(r"\d+", "#", os.path.abspath(path))

    if os.path.exists(out) and len(files) > 1 and shape(out) in map(shape, files):
        raise ValueError(f"{shown(out)}: expected the name of a new file after those to read, got one like theirs")


def _expect_no_input(paths: list[str], files: list[str]) -> None:
    """Refuses a file that is read, under any name: as a file of another kind it would be lost to the run."""
    read = {(state.st_dev, state.st_ino) for state in map(os.stat, files)}
    for path in filter(os.path.exists, paths):
        state = os.stat(path)
        if (state.st_dev, state.st_ino) in read:
            raise ValueError(f"{shown(path)}: expected another file to write, got one that is read")


def _write_npz(frame: Any, stream: Any, columns: list[str] | None) -> None:
    import zipfile

    import numpy

    box = frame.box
    facts = {"step": numpy.array(frame.step), "time": numpy.array(frame.time)}
    if box is not None:
        facts |= {"box_origin": box.origin, "box_vectors": box.vectors}
    wanted = frame._has_points() and (columns is None or {"x", "y", "z", "x1"} & set(columns))
    points = {"points": frame.points} if wanted else {}
    # numpy.savez leaves the archive open after an error, and Python prints a traceback when it closes it
    with zipfile.ZipFile(stream, "w") as archive:
        for name, values in {**facts, **points, **dict(frame)}.items():
            with archive.open(name + ".npy", "w", force_zip64=True) as member:
                numpy.lib.format.write_array(member, numpy.asanyarray(values), allow_pickle=False)


def _write_csv(frame: Any, stream: Any, columns: list[str] | None) -> None:
    import csv
    import io

    from .._run import component_columns

    table = component_columns(frame)
    if columns is not None:
        table = {name: table[name] for name in columns}
    text = io.TextIOWrapper(stream, encoding="utf-8", newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table)
    writer.writerows(zip(*(values.tolist() for values in table.values())))  # the shortest digits that read back as the same number
    text.detach()


def _write_vtk(frame: Any, path: str, ending: str) -> None:
    try:
        from vtkmodules.vtkFiltersCore import vtkAppendFilter
        from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
    except ImportError as error:
        raise ImportError(f"{ending} needs VTK for Python (Debian: python3-vtk9; pip: vtk): {error}") from error
    data = frame.to_vtk()
    if ending == ".vtu":
        append = vtkAppendFilter()
        append.AddInputData(data)
        append.Update()
        data, writer = append.GetOutput(), vtkXMLUnstructuredGridWriter()
    elif ending == ".vtp":
        writer = vtkXMLPolyDataWriter()
    else:
        try:
            from vtkmodules.vtkIOHDF import vtkHDFWriter
        except ImportError as error:
            raise ImportError(f".vtkhdf needs VTK 9.4 or later: {error}") from error
        writer = vtkHDFWriter()
    if ending != ".vtkhdf":
        writer.EncodeAppendedDataOff()
    writer.SetFileName(path)
    writer.SetInputData(data)
    if not writer.Write():
        raise OSError(f"{shown(path)}: VTK could not write it")
    put_inline(path, b'<?xml version="1.0"?>\n')  # VTK leaves it out of raw files, which are no XML


_STREAM_WRITERS = {".npz": _write_npz, ".csv": _write_csv}
_ONE_FRAME_A_FILE = (*_STREAM_WRITERS, ".vtp", ".vtu", ".vtkhdf")


def _write_frames(frames: Iterable[Any], paths: list[str], columns: list[str] | None, out: str, ending: str, bar: Bar, durable: bool | None) -> None:
    """Writes each frame to a file of its own, under a name that is replaced when the file is complete."""
    count = len(paths)
    if count != 1 and "*" not in os.path.basename(out):
        raise ValueError(f"{shown(out)}: expected * for the timestep in the name, or one frame (--frames -1): {ending} holds one frame a file, and "
                         f"there are {count}")
    if durable is None:
        durable = "*" not in os.path.basename(out)
    for i, (frame, path) in enumerate(zip(frames, paths)):
        frame.read(bar.within(i, count))
        with whole_file(path, durable) as temporary:
            if ending in _STREAM_WRITERS:
                with open(temporary, "wb") as stream:
                    _STREAM_WRITERS[ending](frame, stream, columns)
            else:
                _write_vtk(frame, temporary, ending)


def run(arguments: argparse.Namespace) -> None:
    """Converts the files."""
    from .. import write
    from .._run import arrays_of

    ending = os.path.splitext(arguments.out)[1].lower()
    with open_run(arguments) as opened, Bar(opened, arguments.quiet) as bar:
        _expect_output(arguments.out, opened.files)
        tell_faults(opened)
        numbers = chosen(opened, arguments.frames)
        asked = {"threads": arguments.threads, **{option.name: getattr(arguments, option.name) for option in _PART}}
        durable = {"auto": None, "on": True, "off": False}[arguments.durable]
        words = arguments.columns.replace(",", " ").split()
        if ending in _ONE_FRAME_A_FILE:
            columns = arrays_of(numbers[0], words)[1] if words and len(numbers) else None
            frames = (opened._part(number, columns=words or None, **asked) for number in numbers._numbers())
            folder, name = os.path.split(arguments.out)
            paths = [os.path.join(folder, name.replace("*", str(step))) for step in numbers.steps]
            _expect_no_input(paths, opened.files)
            _write_frames(frames, paths, columns, arguments.out, ending, bar, durable)
            return
        if arguments.coordinates:
            raise ValueError(f"{shown(arguments.out)}: --coordinates is for .npz, .csv and files of VTK; dumps say by --columns which they have: xs xu x")
        if arguments.periodic_lines:
            raise ValueError(f"{shown(arguments.out)}: --periodic-lines is for .npz, .csv and files of VTK; dumps have the ends as they were")
        part = numbers if arguments.stride in (None, 1) and not arguments.region else \
            (opened._part(number, **asked) for number in numbers._numbers())
        write(arguments.out, part, style=arguments.style or "", dialect=arguments.dialect, columns=" ".join(words), numbers=arguments.numbers,
              label=arguments.label, scaled=not arguments.unscaled, image=arguments.image, sort=bool(arguments.sort),
              threads=arguments.threads or 0, progress=bar.show, durable=durable)
