# SPDX-License-Identifier: BSD-3-Clause
"""The command granular: what files hold, whether they are sound, other forms of them, their statistics, a picture."""
from __future__ import annotations

import argparse
import contextlib
import json
import math
import os
import re
import sys
import warnings
from typing import Any, Iterator, NoReturn, Sequence

from .._options import FILES, KINDS, Option

# Each has a module of its name, with the functions `options(parser)` and `run(arguments)`.
COMMANDS = {
    "info": "says what files hold: frames, steps, times, columns, box",
    "check": "reads everything, and says what is wrong",
    "convert": "writes files in another form",
    "stats": "prints statistics of each frame and column",
    "show": "makes a picture",
}
WRONG, USAGE, INTERRUPTED = 1, 2, 130

DESCRIPTION = """Reads and writes files of discrete-element simulations by LIGGGHTS and LAMMPS: dumps in every form, contacts and \
bonds, restart and data files, decompositions, Euler cells. FILE is a name or a pattern in quotes, such as 'post/run_*.dump', where * \
stands for the timestep and % for the rank; several files are one run."""

STATUS = """exit status: 0 if it was done, 1 if it could not be done or `check` found a fault, 2 for a usage that cannot be, 130 after \
Ctrl-C."""


def add_files(parser: argparse.ArgumentParser) -> None:
    """Adds FILE... and what tells how to read them."""
    parser.add_argument("files", metavar="FILE", nargs="+", help="name or pattern of the files of one run; of info and show also a folder")
    parser.add_argument("--json", action="store_true", help="prints one JSON document, also of an error")
    add_reading(parser)


def add_reading(parser: argparse.ArgumentParser) -> None:
    """Adds the options of vtkgranular.open."""
    group = parser.add_argument_group("reading")
    group.add_argument("--kind", choices=KINDS, help="what the files are (default: as their contents say)")
    for option in FILES:
        add_option(group, option)


def add_option(group: Any, option: Option) -> None:
    """Adds an option of the library; None stands for its default."""
    more: dict[str, Any] = {"flag": {"action": "store_true", "default": None}, "choice": {"choices": option.choices},
                            "number": {"type": float, "metavar": "T"}, "count": {"type": int, "metavar": "N"},
                            "threads": {"type": int, "metavar": "N"}, "names": {"metavar": "NAMES"},
                            "region": {"type": region, "metavar": "BOUNDS"}}.get(option.type, {})
    text = option.text + ("; - where there is no bound" if option.type == "region" else "")
    group.add_argument("--" + option.name.replace("_", "-"), help=text.replace("%", "%%"), **more)


def region(text: str) -> list[float | None]:
    """Returns the six bounds in a text, None where it has -."""
    words = text.replace(",", " ").split()
    if len(words) != 6:
        raise argparse.ArgumentTypeError(f"expected six bounds, xlo xhi ylo yhi zlo zhi, with - where there is no bound, got {text!r}")
    try:
        return [None if word == "-" else float(word) for word in words]
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def add_frames(parser: argparse.ArgumentParser) -> None:
    """Adds the choice of frames."""
    parser.add_argument("--frames", metavar="A:B:N", help="frames as in Python: 5, -1, 10:20, ::5 (default: all)")


def open_run(arguments: argparse.Namespace) -> Any:
    """Returns the run of the files."""
    import vtkgranular

    return vtkgranular.open(arguments.files, kind=arguments.kind, **{option.name: getattr(arguments, option.name) for option in FILES})


@contextlib.contextmanager
def notices() -> Iterator[list[str]]:
    """Collects the different things that are said about files, instead of printing them."""
    said: list[str] = []
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        yield said
    said += dict.fromkeys(str(each.message) for each in found)


def chosen(run: Any, text: str | None) -> Any:
    """Returns the frames that --frames names."""
    if not text:
        return run
    parts = text.split(":")
    try:
        numbers = [int(part) if part else None for part in parts]
        if len(numbers) == 1 and numbers[0] is not None:
            at = range(len(run))[numbers[0]]
            return run[at:at + 1]
        return run[slice(*numbers)]
    except IndexError:
        raise ValueError(f"frame {text}: expected a frame from {-len(run)} to {len(run) - 1}") from None
    except (TypeError, ValueError):
        raise ValueError(f"--frames: expected a number or A:B:N, got {text!r}") from None


def json_text(document: Any) -> str:
    """Returns a document as JSON. Numbers that are not finite, which JSON has not, become null."""
    def finite(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: finite(each) for name, each in value.items()}
        if isinstance(value, (list, tuple)):
            return [finite(each) for each in value]
        return value if not isinstance(value, float) or math.isfinite(value) else None

    return json.dumps(finite(document), indent=2, allow_nan=False)


def say(text: str) -> None:
    """Prints a remark on one line, where it does not mix with results. Work goes on if nobody hears it."""
    from .._library import shown

    try:
        print(f"granular: {shown(text)}", file=sys.stderr, flush=True)
    except OSError:
        _drop(sys.stderr)


class _Parser(argparse.ArgumentParser):
    """Raises ValueError for a usage that cannot be."""

    def error(self, message: str) -> NoReturn:
        self.print_usage(sys.stderr)
        raise ValueError(message)


def parser() -> argparse.ArgumentParser:
    """Returns the parser of all commands."""
    import importlib

    from .._folders import VERSION

    made = _Parser("granular", description=DESCRIPTION, epilog=STATUS)
    made.add_argument("--version", action="version", version=f"granular {VERSION}")
    commands = made.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, text in COMMANDS.items():
        module = importlib.import_module("." + name, __name__)
        about = f"{module.__doc__.split(chr(10), 1)[0]} {getattr(module, 'MORE', '')}".strip()
        command = commands.add_parser(name, help=text, description=about, epilog=STATUS)
        module.options(command)
        command.set_defaults(run=module.run)
    return made


def _drop(stream: Any) -> None:
    """Sends what is left of a stream nowhere: Python writes it out at its end, and would make an error of it the exit status 120."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _flush() -> None:
    """Writes out what was printed: at Python's own end it is too late for an error. After an error the rest is dropped."""
    try:
        sys.stderr.flush()
    except OSError:
        _drop(sys.stderr)
    try:
        sys.stdout.flush()
    except OSError:
        _drop(sys.stdout)
        raise


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit status."""
    from .. import Cancelled, Error

    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # it was closed: a file that is written must not get its number
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))
    words = list(sys.argv[1:] if arguments is None else arguments)
    for i in range(len(words) - 1, 0, -1):
        if words[i - 1] in ("--frames", "--frame") and re.match(r"-\d", words[i]):  # argparse takes -2: for an option
            words[i - 1:i + 1] = [f"{words[i - 1]}={words[i]}"]
    status = 0
    try:
        try:
            given = parser().parse_args(words)
            with warnings.catch_warnings():
                warnings.simplefilter("once")
                warnings.showwarning = lambda message, *_: say(str(message))  # type: ignore[assignment]
                status = given.run(given) or 0
        finally:
            _flush()
        return status
    except (KeyboardInterrupt, Cancelled):
        say("interrupted; files that were there are as they were")
        return INTERRUPTED
    except BrokenPipeError:  # the reader of a pipe, such as head, has left
        return status
    except (ValueError, ImportError, RuntimeError, OSError, MemoryError) as error:
        text = str(error)
        if isinstance(error, ImportError) and error.name == "numpy":
            text = f"expected a Python with numpy, got {sys.executable}, which has none (Debian: python3-numpy; or {sys.executable} -m pip install numpy)"
        say(text)
        if "--json" in words:
            with contextlib.suppress(OSError):
                byte = getattr(error, "byte", -1)
                print(json_text({"error": {"message": text, "path": getattr(error, "path", None) or getattr(error, "filename", None),
                                           "line": getattr(error, "line", None) or None, "byte": byte if byte >= 0 else None,
                                           "column": getattr(error, "column", None) or None}}), flush=True)
        return USAGE if not isinstance(error, Error) and isinstance(error, ValueError) else WRONG
