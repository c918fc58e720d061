# SPDX-License-Identifier: BSD-3-Clause
"""symbols.py nm library...: no library shows a symbol of the core, which is linked into it and whose
layout is nobody else's business. The C libraries show the functions that their headers declare, and nothing else. Functions that glibc 2.29
has anew are wrapped in the portable library, for systems with 2.28."""
import os
import re
import subprocess
import sys


def visible(nm, library):
    """The demangled names that the library defines for others."""
    listing = subprocess.run([nm, "-D", "-C", "--defined-only", library], check=True,
                             capture_output=True, text=True).stdout
    return [line.split(None, 2)[-1] for line in listing.splitlines()]


HEADERS = {"libgranular.so": ("c/granular.h", "c/granular_filters.h"), "libgranular_bonds.so": ("bonds/granular_bonds.h",)}


def declared(header):
    """The functions of a C interface."""
    with open(os.path.join(os.path.dirname(__file__), "..", "..", "core", header), encoding="ascii") as stream:
        return set(re.findall(r"^GRANULAR_(?:BONDS_)?API[^;(]*?(\w+)\(", stream.read(), re.MULTILINE))


def not_wrapped(nm, library):
    """The functions of glibc 2.29 that core/c/CMakeLists.txt does not wrap."""
    listing = subprocess.run([nm, "-D", "--undefined-only", library], check=True, capture_output=True, text=True).stdout
    with open(os.path.join(os.path.dirname(__file__), "..", "..", "core", "c", "CMakeLists.txt"), encoding="ascii") as stream:
        wrapped = set(re.findall(r"--wrap=(\w+)", stream.read()))
    return sorted(set(re.findall(r" (\w+)@GLIBC_2\.29$", listing, re.MULTILINE)) - wrapped)


def main():
    if len(sys.argv) < 3:
        sys.exit("usage: symbols.py nm library...")
    shown = 0
    for library in sys.argv[2:]:
        names = visible(sys.argv[1], library)
        if not names:
            sys.exit(f"{library}: shows nothing at all")
        headers = HEADERS.get(os.path.basename(library).partition(".so")[0] + ".so")
        if headers:
            functions = {name.split("@")[0] for name in names if not name.startswith("GRANULAR_")}  # versions
            own = set().union(*map(declared, headers))
            if functions != own:
                print(f"{os.path.basename(library)}:1: shows {sorted(functions ^ own)}, or lacks them")
                shown += 1
        for name in not_wrapped(sys.argv[1], library) if os.path.basename(library).startswith("libgranular.so") else ():
            print(f"{os.path.basename(library)}:1: needs {name} of glibc 2.29: add it to old_libc.c and --wrap in core/c/CMakeLists.txt")
            shown += 1
        for name in names:
            if "granular::" in name:
                print(f"{os.path.basename(library)}:1: shows {name}")
                shown += 1
    sys.exit(1 if shown else 0)


if __name__ == "__main__":
    main()
