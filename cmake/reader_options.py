# SPDX-License-Identifier: BSD-3-Clause
"""What is made of core/granular/runs/options.toml, the table of kinds of files and options of readers. When CMake configures:

reader_options.py ROOT xml FOLDER    the files of ROOT/xml, with the properties of the options and other shared parts
reader_options.py ROOT python FILE   the tables of the Python package

After a change of the table, in files that have more:

reader_options.py ROOT write         the structs of granular.h and what fills them, the keywords and docstrings of vtkgranular.open
                                     and Run.read
"""
import os
import re
import sys
import textwrap
import tomllib

TABLE = "core/granular/runs/options.toml"
WIDTH = 132
SHARED = re.compile(r'<Shared name="(?P<name>[A-Za-z]+)"(?: of="(?P<of>[A-Za-z]+)")?(?:/>|>(?P<inside>.*?)</Shared>)', re.DOTALL)
GROUP_OR_PROPERTY = re.compile(r'<ProxyGroup name="(?P<group>\w+)"|<\w+VectorProperty name="(?P<name>\w+)"(?=(?P<rest>[^>]*))')

XML_TAGS = {"text": "String", "names": "String", "choice": "Int", "flag": "Int", "count": "Int", "threads": "Int",
            "number": "Double", "point": "Double", "region": "Double"}
XML_DEFAULTS = {"text": "", "names": "", "point": "0 0 0", "region": "0 0 0 0 0 0"}


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="surrogateescape", newline="") as stream:
        return stream.read()


def load(root):
    """The table, with what every row has; an empty one where there is none."""
    table = tomllib.loads(read(root, TABLE)) if os.path.exists(os.path.join(root, TABLE)) else {"kind": [], "option": []}
    for option in table["option"]:
        option.setdefault("c", option["name"])
        option.setdefault("core", option["c"])
        option.setdefault("property", "")
        option.setdefault("kinds", [])
        option.setdefault("choices", [])
        option.setdefault("default", option["choices"][0] if option["choices"] else None if option["type"] in ("point", "region", "number")
                          else "" if option["type"] in ("text", "names") else False if option["type"] == "flag" else 0)
    return table


def options_of(table, scope):
    return [option for option in table["option"] if option["of"] in (scope, "all")]


PYTHON_TABLES = '''# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of files, and the options of vtkgranular.open and Run.read: made of core/granular/runs/options.toml."""
from __future__ import annotations

from typing import Any, NamedTuple


class Option(NamedTuple):
    name: str
    property: str  #: of ParaView's readers
    c: str  #: in the structs of granular.h
    type: str
    default: Any
    minimum: Any
    choices: tuple[str, ...]
    text: str


KINDS = {kinds}
#: In the order in which they are asked whether a file is theirs.
READERS = {readers}
FILES = ({files}
)
FRAME = ({frame}
)
'''


def files_of(table, option):
    """The files whose frames an option is for, in brackets; nothing for options of all, or of files, which tell themselves."""
    files = [kind["files"] for kind in table["kind"] if kind["name"] in option["kinds"]]
    return f" ({' and '.join(', '.join(files).rsplit(', ', 1))})" if files and option["of"] == "frame" else ""


def python_tables(table):
    def row(option):
        told = option["text"] + files_of(table, option)
        return (*(option[key] for key in ("name", "property", "c", "type", "default")), option.get("minimum", 0), tuple(option["choices"]), told)

    def rows(scope):
        return "".join(f"\n    Option{row(option)!r}," for option in options_of(table, scope))

    kinds = sorted(table["kind"], key=lambda kind: kind["number"])
    return PYTHON_TABLES.format(kinds=tuple(kind["name"] for kind in kinds), readers=tuple(dict.fromkeys(kind["reader"] for kind in table["kind"])),
                                files=rows("files"), frame=rows("frame"))


def xml_property(option):
    tag = XML_TAGS[option["type"]]
    kind = "Int" if "entries" in option else tag
    default = XML_DEFAULTS.get(option["type"], option["default"])
    if option["choices"] or "entries" in option:
        default = option.get("default_value", 0)
    elif "strings" in option:
        default = option["strings"][0]
    default = default if isinstance(default, str) else f"{default:g}"
    advanced = ' panel_visibility="advanced"' if option.get("advanced") else ""
    lines = [f'      <{kind}VectorProperty name="{option["property"]}" default_values="{default}"{advanced}>']
    entries = option.get("entries") or ["".join(word.capitalize() for word in choice.split("_")) for choice in option["choices"]]
    if entries:
        values = option.get("values", range(len(entries)))
        lines += ['        <EnumerationDomain name="enum">',
                  *[f'          <Entry text="{entry}" value="{value}"/>' for entry, value in zip(entries, values)],
                  "        </EnumerationDomain>"]
    elif "strings" in option:
        lines += ['        <StringListDomain name="styles">', *[f'          <String value="{word}"/>' for word in option["strings"]],
                  "        </StringListDomain>"]
    elif option["type"] == "flag":
        lines.append('        <BooleanDomain name="bool"/>')
    elif "minimum" in option:
        lines.append(f'        <{kind}RangeDomain name="range" min="{option["minimum"]:g}"/>')
    text = textwrap.wrap(" ".join(option["page"].split()), WIDTH, initial_indent=" " * 10, subsequent_indent=" " * 10,
                         break_long_words=False, break_on_hyphens=False)
    return [*lines, "        <Documentation>", *text, "        </Documentation>", f"      </{kind}VectorProperty>"]


def complete(text):
    """The text with the attributes that a property with default_values leaves out: if it has no number_of_elements, this is the number of
    its defaults (of a text 1), its command is Set and its name unless it gives one, and sources and filters do not animate it."""
    group = ""

    def completed(match):
        nonlocal group
        group = match["group"] or group
        default = re.search(r'\bdefault_values="([^"]*)"', match["rest"] or "")
        if not default or "number_of_elements=" in match["rest"]:
            return match.group()
        count = 1 if match.group().startswith("<String") else len(default[1].split())
        return "".join([match.group(), f' number_of_elements="{count}"',
                        f' command="Set{match["name"]}"' if " command=" not in match["rest"] else "",
                        ' animateable="0"' if group.endswith(("sources", "filters")) else ""])
    return GROUP_OR_PROPERTY.sub(completed, text)


def expand(root, text, table=None):
    """The text with each <Shared name="X" of="Y">inside</Shared> replaced: by the property of an option, with the name Options by all those
    of the base Y, or else by xml/shared/X.xml, with Y for @Of@, y for @of@ and inside for @inside@; on as many lines, so that complaints name
    the line of the stand-in; and completed."""
    table = table or load(root)
    options = {option["property"]: option for option in table["option"]}

    def shared(match):
        name, of, inside = (match.group(key) or "" for key in ("name", "of", "inside"))
        shown = [option for option in options.values() if option.get("base") == of] if name == "Options" else [options[name]] if name in options else []
        part = "\n".join(line for option in shown for line in xml_property(option)) or read(root, f"xml/shared/{name}.xml")
        part = part.replace("@Of@", of).replace("@of@", of.lower()).replace("@inside@", inside)
        return SHARED.sub(shared, part).replace("\n", " ") + "\n" * match.group().count("\n")
    made = complete(SHARED.sub(shared, text))
    if re.search("</?Shared", made):
        raise SystemExit(f"expected <Shared name=\"X\" of=\"Y\"/>, got {made[made.index('<Shared'):][:60]}")
    return made


# ---- types: in C, in C++ from C, in Python, in the panel ---------------------------------------------
C_TYPES = {"text": "const char* {}", "names": "const char* {}", "choice": "int {}", "flag": "int {}", "count": "int64_t {}",
           "threads": "int {}", "int": "int {}", "number": "double {}", "point": "double {}[3]", "region": "double {}[6]"}
FROM_C = {"text": "made.{core} = text_of(given.{c});", "names": "made.{core} = text_of(given.{c});",
          "choice": 'take_choice(made.{core}, given.{c}, {most}, "{c}");', "flag": "made.{core} = given.{c} != 0;",
          "count": 'made.{core} = at_least({minimum}, given.{c}, "{c}");',
          "int": 'made.{core} = at_least({minimum}, given.{c}, "{c}");',
          "threads": "made.{core} = given.{c} > 0 ? given.{c} : available_cores();",
          "point": "std::copy_n(given.{c}, 3, made.{core}.begin());", "region": "std::copy_n(given.{c}, 6, made.{core}.begin());"}
PYTHON_TYPES = {"text": "str", "names": "str | Iterable[str]", "choice": "str", "flag": "bool", "count": "int", "int": "int", "threads": "int",
                "number": "float | None", "point": "Any", "region": "Any"}
PYTHON_MORE = {"names": "; or a list", "point": "; shape (3,)", "region": "; or three pairs; None where there is no bound"}
C_MORE = {"region": "; an axis with lo > hi (default), or of 0 0, is not restricted; no NaN"}


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


def core_kinds(table, form):
    return [form.format(f"{kind['c'].lower()}_kind") for kind in table["kind"]]


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
            if option["type"] in FROM_C]  # TimestepSize is not one of RunOptions


# ---- Python ----------------------------------------------------------------------------------------
def python_signature(table, scope, left_out=()):
    return [f"{option['name']}: {PYTHON_TYPES[option['type']]} = {option['default']!r}".replace("'", '"')
            for option in options_of(table, scope) if option["name"] not in left_out]


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
    kinds = core_kinds(table, "&{}")
    regions = {
        "core/granular/runs/kind.h": [(r"^/// The kinds, each in a file of its own\.$", r"^$", core_kinds(table, "extern const Kind {};"))],
        "core/granular/runs/kinds.cpp": [
            (r"^  static constexpr const Kind\* all\[\] = \{$", r"^  \};$",
             [f"    {kind}," for kind in kinds[:-1]] + [f"    {kinds[-1]},"])],
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
    files = {}
    for path, parts in regions.items():
        text = read(root, path)
        for begin, end, lines in parts:
            text = between(path, text, begin, end, lines)
        files[path] = text
    path = "core/python/vtkgranular/_run.py"
    files[path] = signature(path, files[path], "open", python_signature(table, "files", ("dt",)))
    files[path] = signature(path, files[path], "read", python_signature(table, "frame"))
    return files


def main(root, what, to=""):
    if what == "write":
        files = {os.path.join(root, path): text for path, text in made(root).items()}
    elif what == "python":
        files = {to: python_tables(load(root))}
    else:
        names = [name for name in os.listdir(os.path.join(root, "xml")) if name.endswith(".xml")]
        files = {os.path.join(to, name): expand(root, read(root, f"xml/{name}")) for name in names}
    for path, text in files.items():
        os.makedirs(os.path.dirname(path), exist_ok=True)
        if not os.path.exists(path) or read("", path) != text:  # what is made of it is as new as it is
            with open(path, "w", encoding="utf-8", errors="surrogateescape") as stream:
                stream.write(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
