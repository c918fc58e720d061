# SPDX-License-Identifier: BSD-3-Clause
"""symbols.py nm library...: no library shows a symbol of the core, which is linked into it and whose
layout is nobody else's business. The C library shows the functions that its header declares, and nothing else."""
import os
import re
import subprocess
import sys


def visible(nm, library):
    """The demangled names that the library defines for others."""
    listing = subprocess.run([nm, "-D", "-C", "--defined-only", library], check=True,
                             capture_output=True, text=True).stdout
    return [line.split(None, 2)[-1] for line in listing.splitlines()]


def declared():
    """The functions of the C interface."""
    header = os.path.join(os.path.dirname(__file__), "..", "..", "core", "c", "granular.h")
    with open(header, encoding="ascii") as stream:
        return set(re.findall(r"^GRANULAR_API[^;(]*?(\w+)\(", stream.read(), re.MULTILINE))


def main():
    if len(sys.argv) < 3:
        sys.exit("usage: symbols.py nm library...")
    shown = 0
    for library in sys.argv[2:]:
        names = visible(sys.argv[1], library)
        if not names:
            sys.exit(f"{library}: shows nothing at all")
        if os.path.basename(library).startswith("libgranular.so"):
            functions = {name.split("@")[0] for name in names if not name.startswith("GRANULAR_")}  # versions
            if functions != declared():
                print(f"{os.path.basename(library)}:1: shows {sorted(functions ^ declared())}, or lacks them")
                shown += 1
        for name in names:
            if "granular::" in name:
                print(f"{os.path.basename(library)}:1: shows {name}")
                shown += 1
    sys.exit(1 if shown else 0)


if __name__ == "__main__":
    main()
