# SPDX-License-Identifier: BSD-3-Clause
"""interface.py tree compiler [write]: functions, constants, struct sizes and offsets of the C headers are those of interface.txt, which
a program that was compiled before relies on. A struct may grow at its end if it begins with its size; new lines are welcome. Another
change of a line breaks such programs, and belongs in CHANGELOG. With write: makes the list."""
import difflib
import os
import re
import subprocess
import sys
import tempfile

HEADERS = ("core/c/granular.h", "core/c/granular_filters.h", "core/bonds/granular_bonds.h")
LIST = "tests/lint/interface.txt"


def members(body):
    """The names of the members of a struct."""
    for declaration in body.split(";"):
        pointer = re.search(r"\(\*(\w+)\)", declaration)
        names = [pointer.group(1)] if pointer else re.findall(r"(\w+)(?:\[\d+\])?\s*(?=,|$)", declaration.strip())
        yield from names


def interface(root, compiler):
    """The lines of the list: made by the compiler, for a machine of 64 bits."""
    lines, prints = [], []
    for header in HEADERS:
        with open(os.path.join(root, header), encoding="ascii") as stream:
            text = re.sub(r"/\*.*?\*/", "", stream.read(), flags=re.DOTALL)
        for name, body in re.findall(r"^typedef struct (\w+)\s*\{(.*?)\}", text, re.MULTILINE | re.DOTALL):
            form = f"struct {name} %zu:" + "".join(f" {member} %zu" for member in members(body))
            values = [f"sizeof({name})"] + [f"offsetof({name}, {member})" for member in members(body)]
            prints.append(f'printf("{form}\\n", {", ".join(values)});')
        for body in re.findall(r"\b(?:enum\b[^{;]*|GRANULAR_ENUM\(\w+\)\s*)\{(.*?)\}", text, re.DOTALL):
            prints += [f'printf("{name} %d\\n", (int){name});' for name in re.findall(r"\b(GRANULAR_\w+)", body)]
        found = re.findall(r"^GRANULAR_(?:BONDS_)?API (.*?);|^(typedef [^;{]*\(\*\w+\).*?);", text, re.MULTILINE | re.DOTALL)
        lines += [" ".join("".join(each).split()) for each in found]
    includes = "".join(f'#include "{os.path.join(os.path.abspath(root), header)}"\n' for header in HEADERS)
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "sizes")
        with open(program + ".c", "w", encoding="ascii") as stream:
            stream.write("#include <stdio.h>\n" + includes + "int main(void)\n{\n" + "\n".join(prints) + "\n}\n")
        subprocess.run([compiler, "-I" + os.path.join(root, "core/c"), program + ".c", "-o", program], check=True)
        lines += subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
    return [line + "\n" for line in lines]


def main():
    root, compiler = sys.argv[1:3]
    path = os.path.join(root, LIST)
    now = interface(root, compiler)
    if sys.argv[3:] == ["write"]:
        with open(path, "w", encoding="ascii") as stream:
            stream.writelines(now)
        return
    with open(path, encoding="ascii") as stream:
        changes = list(difflib.unified_diff(stream.readlines(), now, LIST, "headers", n=0))
    sys.stdout.writelines(changes)
    sys.exit(f"{LIST}:1: expected the interface that is listed there; see the head of interface.py" if changes else 0)


if __name__ == "__main__":
    main()
