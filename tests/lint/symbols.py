# SPDX-License-Identifier: BSD-3-Clause
"""symbols.py nm library...: no library shows a symbol of the core, which is linked into it and whose
layout is nobody else's business."""
import os
import subprocess
import sys


def visible(nm, library):
    """The demangled names that the library defines for others."""
    listing = subprocess.run([nm, "-D", "-C", "--defined-only", library], check=True,
                             capture_output=True, text=True).stdout
    return [line.split(None, 2)[-1] for line in listing.splitlines()]


def main():
    if len(sys.argv) < 3:
        sys.exit("usage: symbols.py nm library...")
    shown = 0
    for library in sys.argv[2:]:
        names = visible(sys.argv[1], library)
        if not names:
            sys.exit(f"{library}: shows nothing at all")
        for name in names:
            if "granular::" in name:
                print(f"{os.path.basename(library)}:1: shows {name}")
                shown += 1
    sys.exit(1 if shown else 0)


if __name__ == "__main__":
    main()
