# SPDX-License-Identifier: BSD-3-Clause
"""Writes files in another form: other forms of dumps, arrays of numpy, tables, files of VTK."""
from __future__ import annotations

import argparse
import os
import re

from .._library import shown
from .._options import FRAME
from . import add_frames, add_option, add_reading, chosen, json_text, open_run
from .progress import Bar
from .info import tell_faults

MORE = """The ending of OUT chooses: .npz (numpy), .vtp, .vtu and .vtkhdf (VTK) hold one frame a file; .csv is a \
table, which begins with step and time where there are several frames; .bonds, .euler and \
.decomposition are those of contacts, cells and subdomains; .bin is a binary dump; .dump, .lammpstrj and the like are text dumps, compressed where .gz or \
.zst follows. `*` in OUT stands for the timestep and makes a file a frame. Each file appears when it is complete; until then, and after \
an error, an old one is as it was. A file of the run is replaced last, and only by the same kind of file."""

# --threads is one of all commands, and numbers have the precision of the new file.
_PART = [option for option in FRAME if option.name not in ("threads", "precision", "origin", "piece", "pieces")]


def options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of convert."""
    parser.add_argument("files", metavar="IN", nargs="+", help="name or pattern of the files of one run")
    parser.add_argument("out", metavar="OUT", help="name of the new file")
    parser.add_argument("--json", action="store_true", help="prints one JSON document, also of an error")
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


def run(arguments: argparse.Namespace) -> None:
    """Converts the files."""
    from .. import write
    from .._forms import form_of
    from .._run import RunSlice

    with open_run(arguments) as opened, Bar(opened, arguments.quiet) as bar:
        _expect_output(arguments.out, opened.files)
        tell_faults(opened)
        numbers = chosen(opened, arguments.frames)
        is_form = bool(form_of(arguments.out)) and not arguments.style
        # a dump is sorted when it is written
        asked = {"threads": arguments.threads, **{option.name: getattr(arguments, option.name) for option in _PART if is_form or option.name != "sort"}}
        durable = {"auto": None, "on": True, "off": False}[arguments.durable]
        words = arguments.columns.replace(",", " ").split()
        if is_form:
            asked["columns"] = words or None
        elif arguments.coordinates:
            raise ValueError(f"{shown(arguments.out)}: --coordinates is for .npz, .csv and files of VTK; dumps say by --columns which they have: xs xu x")
        elif arguments.periodic_lines:
            raise ValueError(f"{shown(arguments.out)}: --periodic-lines is for .npz, .csv and files of VTK; dumps have the ends as they were")
        write(arguments.out, RunSlice(opened, numbers._numbers(), asked), style=arguments.style or "", dialect=arguments.dialect,
              columns=" ".join(words), numbers=arguments.numbers, label=arguments.label, scaled=not arguments.unscaled, image=arguments.image,
              sort=not is_form and bool(arguments.sort), threads=arguments.threads or 0, progress=bar.show, durable=durable)
        if arguments.json:
            print(json_text({"given": arguments.files, "out": arguments.out, "frames": len(numbers)}))
