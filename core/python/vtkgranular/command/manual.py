# SPDX-License-Identifier: BSD-3-Clause
"""Makes the manual page and the completion of bash from the options of the command.

    python3 -m vtkgranular.command.manual man granular.1
    python3 -m vtkgranular.command.manual bash granular
"""
from __future__ import annotations

import argparse
import sys
from typing import Iterator

from . import DESCRIPTION, STATUS, parser


def _commands() -> dict[str, argparse.ArgumentParser]:
    for action in parser()._actions:
        if isinstance(action, argparse._SubParsersAction):
            return dict(action.choices)
    raise AssertionError("no commands")


def _escape(text: str) -> str:
    """Signs that mean something to troff."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def _options(command: argparse.ArgumentParser) -> Iterator[tuple[list[str], str, str]]:
    """Names, value and help of each option; arguments have no names."""
    for action in command._actions:
        text = (action.help or "") % {"default": action.default, "prog": command.prog} if action.help else ""
        value = action.metavar or ("|".join(action.choices) if action.choices else "" if action.nargs == 0 else action.dest.upper())
        yield list(action.option_strings), str(value), text


def manual() -> str:
    """Returns the manual page, in the macros of man."""
    from .._folders import VERSION

    lines = [f'.TH GRANULAR 1 "" "granular {VERSION}" "User Commands"', ".SH NAME",
             "granular \\- files of discrete\\-element simulations: what they hold, other forms, statistics, pictures", ".SH SYNOPSIS"]
    for name in _commands():
        lines += [f".B granular {name}", "[\\fIOPTION\\fR]... \\fIFILE\\fR..." + (" \\fIOUT\\fR" if name == "convert" else ""), ".br"]
    lines += [".SH DESCRIPTION", _escape(DESCRIPTION)]
    for name, command in _commands().items():
        lines += [f".SH {name.upper()}", _escape(command.description or "")]
        for options, value, text in _options(command):
            shown = ", ".join(f"\\fB{_escape(option)}\\fR" for option in options)
            shown += (" " if shown and value else "") + (f"\\fI{_escape(value)}\\fR" if value else "")
            lines += [".TP", shown, _escape(text)]
    lines += [".SH EXIT STATUS", _escape(STATUS[0].upper() + STATUS[1:]), ".SH EXAMPLES"]
    for text, example in (("What is in a run:", "granular info 'post/run_*.dump'"),
                          ("The same, compressed, in one file:", "granular convert 'post/run_*.dump' run.dump.zst"),
                          ("Every tenth frame, three columns:",
                           "granular convert run.dump small.dump --frames ::10 --columns 'id x y z radius'"),
                          ("A file of numpy for each frame:", "granular convert run.dump 'frame_*.npz'")):
        lines += [text, ".PP", ".RS", _escape(example), ".RE", ".PP"]
    return "\n".join(lines) + "\n"


def bash() -> str:
    """Returns the completion of bash: commands, options, and the words that options take; bash itself adds names of files."""
    commands = _commands()
    lines = ["# bash completion of granular; made from its options", "_granular()", "{",
             "  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\" words=",
             "  COMPREPLY=()",
             "  if [ \"$COMP_CWORD\" -eq 1 ]; then",
             f"    COMPREPLY=($(compgen -W '{' '.join(commands)} --help --version' -- \"$word\"))",
             "    return", "  fi",
             "  case \"${COMP_WORDS[1]} $before\" in"]
    for name, command in commands.items():
        for action in command._actions:
            if action.choices and action.option_strings:
                lines += [f"    '{name} {option}') words='{' '.join(map(str, action.choices))}' ;;" for option in action.option_strings]
    lines += ["  esac", "  if [ -z \"$words\" ] && [[ \"$word\" == -* ]]; then", "    case \"${COMP_WORDS[1]}\" in"]
    for name, command in commands.items():
        options = " ".join(option for names, _, _ in _options(command) for option in names)
        lines.append(f"      {name}) words='{options}' ;;")
    lines += ["    esac", "  fi", "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))", "}", "complete -o default -F _granular granular"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    with open(sys.argv[2], "w", encoding="utf-8") as page:
        page.write({"man": manual, "bash": bash}[sys.argv[1]]())
