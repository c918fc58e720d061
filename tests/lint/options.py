# SPDX-License-Identifier: BSD-3-Clause
"""What is made of core/granular/runs/options.toml, the table of kinds of files and options of readers, in files that have more: the
structs of granular.h and what fills them, the keywords and docstrings of vtkgranular.open and Run.read. `options.py ROOT write` makes
it; without `write` says where it is not as it should be. CMake makes the rest by cmake/reader_options.py."""
import os
import re
import sys
import textwrap

import tree

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cmake"))
from reader_options import TABLE, WIDTH, files_of, load, options_of  # noqa: E402


# ---- types: in C, in C++ from C, in Python, in the panel ---------------------------------------------
C_TYPES = {"text": "const char* {}", "names": "const char* {}", "choice": "int {}", "flag": "int {}", "count": "int64_t {}",
           "threads": "int {}", "number": "double {}", "point": "double {}[3]", "region": "double {}[6]"}
FROM_C = {"text": "made.{core} = text_of(given.{c});", "names": "made.{core} = text_of(given.{c});",
          "choice": 'take_choice(made.{core}, given.{c}, {most}, "{c}");', "flag": "made.{core} = given.{c} != 0;",
          "count": 'made.{core} = at_least({minimum}, given.{c}, "{c}");',
          "threads": "made.{core} = given.{c} > 0 ? given.{c} : available_cores();",
          "point": "std::copy_n(given.{c}, 3, made.{core}.begin());", "region": "std::copy_n(given.{c}, 6, made.{core}.begin());"}
PYTHON_TYPES = {"text": "str", "names": "str | Iterable[str]", "choice": "str", "flag": "bool", "count": "int", "threads": "int",
                "number": "float | None", "point": "Any", "region": "Any"}
PYTHON_MORE = {"names": "; or a list", "point": "; shape (3,)", "region": "; or three pairs; None where there is no bound"}
C_MORE = {"region": "; an axis with lo > hi (default) is not restricted; no NaN"}


def text_of(table, option, shown, more):
    """The sentence for Python and C: with the choices, and the kinds that have what is chosen of a frame."""
    text = option["text"] + more.get(option["type"], "")
    if option["choices"]:
        text += ": " + choices_text(option["choices"], shown)
    return text + files_of(table, option)


def choices_text(choices, shown):
    """Lists choices, of which the first is the default."""
    words = [shown(i, choice) for i, choice in enumerate(choices)]
    words[0] += " (default)"
    return ", ".join(words[:-1]) + " or " + words[-1]


# ---- C ---------------------------------------------------------------------------------------------
def c_comment(text):
    lines = textwrap.wrap(text, WIDTH - 8, break_on_hyphens=False)
    return ["  /* " + lines[0]] + ["   * " + line for line in lines[1:]]


def c_fields(table, scope):
    lines = []
    for option in options_of(table, scope):
        comment = c_comment(text_of(table, option, lambda i, choice: f"{i} {choice}", C_MORE))
        field = C_TYPES[option["type"]].format(option["c"])
        if "c_type" in option:
            field = option["c_type"] + field[field.index(" "):]
        lines += [*comment[:-1], comment[-1] + " */", f"  {field};"]
    return lines


def c_kinds(table):
    rows = sorted(table["kind"], key=lambda kind: kind["number"])
    words = [f"  GRANULAR_KIND_{kind['c']} = {kind['number']}" + ("," if kind is not rows[-1] else "") for kind in rows]
    return [f"{word:<33} /* {kind['text']} */" for word, kind in zip(words, rows)]


def c_defaults(table, scope, struct):
    lines = []
    for option in options_of(table, scope):
        if option["type"] in ("count", "number") and option["default"]:
            lines.append(f"      {struct}->{option['c']} = {option['default']:g};")
        elif option["type"] == "region":
            lines += [f"      const double {option['c']}[] = {{ 1, -1, 1, -1, 1, -1 }};",
                      f"      std::memcpy({struct}->{option['c']}, {option['c']}, sizeof({option['c']}));"]
    return lines


def from_c(table, scope):
    return ["  " + FROM_C[option["type"]].format(**option, most=len(option["choices"]) - 1) for option in options_of(table, scope)
            if option["type"] in FROM_C]


# ---- Python ----------------------------------------------------------------------------------------


def python_signature(table, scope, left_out=()):
    words = [f"{option['name']}: {PYTHON_TYPES[option['type']]} = {option['default']!r}".replace("'", '"')
             for option in options_of(table, scope) if option["name"] not in left_out]
    return words


def python_kinds(table):
    names = [f'"{kind["name"]}"' for kind in sorted(table["kind"], key=lambda kind: kind["number"])]
    text = f"{', '.join(names[:-1])} or {names[-1]}; None (default): as the contents say"
    return textwrap.wrap(text, WIDTH, initial_indent="    kind            ", subsequent_indent=" " * 20, break_on_hyphens=False)


def python_docs(table, scope, indent, width):
    lines = []
    for option in options_of(table, scope):
        text = text_of(table, option, lambda i, choice: f'"{choice}"', PYTHON_MORE)
        first = " " * indent + f"{option['name']:<{width}}"
        lines += textwrap.wrap(text, WIDTH, initial_indent=first, subsequent_indent=" " * (indent + width), break_on_hyphens=False)
    return lines




# ---- files -----------------------------------------------------------------------------------------
def between(path, text, begin, end, lines):
    """The text with other lines between two that match."""
    match = re.search(f"({begin})(.*?)({end})", text, re.DOTALL | re.MULTILINE)
    if not match:
        raise SystemExit(f"{path}: expected lines like {begin!r} and {end!r}")
    return text[:match.end(1)] + "\n" + "".join(line + "\n" for line in lines) + text[match.start(match.lastindex):]


def signature(path, text, name, words):
    """The text with other keywords in the signature of a function, before `progress`."""
    first = {"open": "kind", "read": "columns"}[name]
    match = re.search(rf"( *)def {name}\(((?:(?!def ).)*?\b{first}: .*?)(progress: Callable)", text, re.DOTALL)
    kept = [word.strip() for word in re.split(r",\s*(?![^\[]*\])", match[2])]
    kept = kept[:next(i for i, word in enumerate(kept) if word.startswith(first + ":")) + 1]
    head = f"{match[1]}def {name}("
    indent = " " * len(head)
    line, lines = head, []
    for word in [*kept, *words]:
        if len(line) + len(word) + 1 > WIDTH:
            lines.append(line.rstrip())
            line = indent
        line += word + ", "
    if len(line) + 70 > WIDTH:
        lines.append(line.rstrip())
        line = indent
    return text[:match.start()] + "\n".join([*lines, line]) + text[match.start(3):]


def made(root):
    """{path: text} of all that comes from the table."""
    table = load(root)
    files = {}
    regions = {
        "core/c/granular.h": [
            (r"^  GRANULAR_KIND_AUTOMATIC = -1,$", r"^\} granular_kind;$", c_kinds(table)),
            (r"^  granular_kind kind; [^\n]*\*/$", r"^  granular_progress progress;", c_fields(table, "files")),
            (r"^  int points; [^\n]*\*/$", r"^  granular_progress progress;", c_fields(table, "frame"))],
        "core/c/run.cpp": [(r"^  RunOptions made;$", r"^  return made;$", from_c(table, "files")),
                           (r"^void take\(Request& made, const granular_request& given\)\n\{$", r"^\}$", from_c(table, "frame"))],
        "core/c/granular_c.cpp": [(r"^      options->kind = GRANULAR_KIND_AUTOMATIC;$", r"^    \}$", c_defaults(table, "files", "options")),
                                  (r"^      request->points = 1;$", r"^    \}$", c_defaults(table, "frame", "request"))],
        "core/python/vtkgranular/_run.py": [
            (r"^    paths           a file, .*?by their contents\.$", r"^    progress        is called",
             [*python_kinds(table), *python_docs(table, "files", 4, 16)]),
            (r"^ {24}take no memory; positions are always read\.$", r"^ {8}progress {8}is called", python_docs(table, "frame", 8, 16))],
    }
    for path, parts in regions.items():
        text = tree.read(root, path)
        for begin, end, lines in parts:
            text = between(path, text, begin, end, lines)
        files[path] = text
    path = "core/python/vtkgranular/_run.py"
    files[path] = signature(path, files[path], "open", python_signature(table, "files", ("dt",)))
    files[path] = signature(path, files[path], "read", python_signature(table, "frame"))
    return files


def check_core(root):
    """The kinds of the core have the numbers and the order of the table."""
    path = "core/granular/runs/kinds.cpp"
    order = re.findall(r"&(\w+)_kind\b", tree.read(root, path))
    expected = [kind["c"].lower() for kind in load(root)["kind"]]
    if order != expected:
        yield path, 1, f"expected the kinds in the order of {TABLE}, {', '.join(expected)}, got {', '.join(order)}"
    for kind in load(root)["kind"]:
        path = f"core/granular/runs/{kind['c'].lower()}_kind.cpp"
        if f".number = {kind['number']}," not in tree.read(root, path):
            yield path, 1, f"expected .number = {kind['number']}, as {TABLE} has it"


def check(root):
    yield from check_core(root)
    for path, text in made(root).items():
        there = tree.read(root, path)
        if there != text:
            lines = zip(there.splitlines() + [""], text.splitlines() + [""])
            line = next((i for i, (a, b) in enumerate(lines, 1) if a != b), 1)
            yield path, line, f"is not what {TABLE} says: python3 tests/lint/options.py . write"


if __name__ == "__main__":
    if sys.argv[2:] == ["write"]:
        for name, content in made(sys.argv[1]).items():
            with open(os.path.join(sys.argv[1], name), "w", encoding="utf-8") as stream:
                stream.write(content)
    else:
        tree.run(check)
