# SPDX-License-Identifier: BSD-3-Clause
"""What is made of the table of kinds of files and options of readers, core/granular/runs/options.toml, when CMake configures: the XML
of the server manager with its shared parts, and the tables of the Python package. tests/lint/options.py makes the rest.

reader_options.py ROOT xml FOLDER    the files of ROOT/xml, expanded
reader_options.py ROOT python FILE   the tables
"""
import os
import re
import sys
import textwrap
import tomllib

TABLE = "core/granular/runs/options.toml"
WIDTH = 132
SHARED = re.compile(r'<Shared name="(?P<name>[A-Za-z]+)"(?: of="(?P<of>[A-Za-z]+)")?(?:/>|>(?P<inside>.*?)</Shared>)', re.DOTALL)

XML_TAGS = {"text": "String", "names": "String", "choice": "Int", "flag": "Int", "count": "Int", "threads": "Int",
            "number": "Double", "point": "Double", "region": "Double"}
XML_DEFAULTS = {"text": "", "names": "", "point": "0 0 0", "region": "1 -1 1 -1 1 -1"}


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="surrogateescape", newline="") as stream:
        return stream.read()


def load(root):
    """The table, with what every row has; an empty one where there is none."""
    table = tomllib.loads(read(root, TABLE)) if os.path.exists(os.path.join(root, TABLE)) else {"kind": [], "option": []}
    for option in table["option"]:
        option.setdefault("c", option["name"])
        option.setdefault("core", option["c"])
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
    def rows(scope):
        keys = ("name", "property", "c", "type", "default", "choices", "text")
        values = [tuple(tuple(option[key]) if key == "choices" else option[key] + files_of(table, option) if key == "text" else option[key]
                        for key in keys) for option in options_of(table, scope)]
        return "".join(f"\n    Option{each!r}," for each in values)

    kinds = sorted(table["kind"], key=lambda kind: kind["number"])
    return PYTHON_TABLES.format(kinds=tuple(kind["name"] for kind in kinds), readers=tuple(dict.fromkeys(kind["reader"] for kind in table["kind"])),
                                files=rows("files"), frame=rows("frame"))


def xml_property(option):
    tag = XML_TAGS[option["type"]]
    kind = "Int" if "entries" in option else tag
    name = option["property"]
    default = XML_DEFAULTS.get(option["type"], option["default"])
    if option["choices"] or "entries" in option:
        default = option.get("default_value", 0)
    elif "strings" in option:
        default = option["strings"][0]
    default = default if isinstance(default, str) else f"{default:g}"
    count = {"point": 3, "region": 6}.get(option["type"], 1)
    attributes = [f'name="{name}"', f'command="Set{name}"', f'number_of_elements="{count}"', f'default_values="{default}"',
                  'animateable="0"']
    if option.get("advanced"):
        attributes.append('panel_visibility="advanced"')
    head = f"      <{kind}VectorProperty "
    lines = [head + ("\n" + " " * len(head)).join(attributes) + ">"]
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


def expand(root, text, table=None):
    """The text with each <Shared name="X" of="Y">inside</Shared> replaced: by the property of an option, or else by xml/shared/X.xml, with
    Y for @Of@, y for @of@ and inside for @inside@; on as many lines, so that complaints name the line of the stand-in."""
    table = table or load(root)
    options = {option["property"]: option for option in table["option"]}

    def shared(match):
        name, of, inside = (match.group(key) or "" for key in ("name", "of", "inside"))
        part = "\n".join(xml_property(options[name])) if name in options else read(root, f"xml/shared/{name}.xml")
        part = part.replace("@Of@", of).replace("@of@", of.lower()).replace("@inside@", inside)
        return expand(root, part, table).replace("\n", " ") + "\n" * match.group().count("\n")
    made = SHARED.sub(shared, text)
    if re.search("</?Shared", made):
        raise SystemExit(f"expected <Shared name=\"X\" of=\"Y\"/>, got {made[made.index('<Shared'):][:60]}")
    return made


def main(root, what, to):
    if what == "python":
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
