# SPDX-License-Identifier: BSD-3-Clause
"""The version is the same in CMakeLists.txt, granular.h, CITATION.cff, the recipes and the first heading of CHANGELOG, which also
has its day.
`release.py root tag` prints the release notes, if the tag is "v" and the version."""
import re
import sys

import tree


def notes(root):
    """The heading's version, its day, and the text below it up to the next heading."""
    return re.search(r"^## (\S+) - (\S+)\n+(.*?)^## ", tree.read(root, "CHANGELOG.md"), re.MULTILINE | re.DOTALL).groups()


def check(root):
    version = re.search(r"project\(Granular\s+VERSION (\S+)", tree.read(root, "CMakeLists.txt")).group(1)
    header = ".".join(re.findall(r"#define GRANULAR_VERSION_\w+ (\d+)", tree.read(root, "core/c/granular.h")))
    citation = dict(re.findall(r"^(version|date-released): (\S+)$", tree.read(root, "CITATION.cff"), re.MULTILINE))
    heading, day, _ = notes(root)
    conda = re.search(r'set version = "(\S+)"', tree.read(root, "packaging/conda/meta.yaml")).group(1)
    spack = re.search(r'    version\("(\S+)"\)', tree.read(root, "packaging/spack/package.py")).group(1)
    for path, got, expected in (("core/c/granular.h", header, version), ("CITATION.cff", citation["version"], version),
                                ("CHANGELOG.md", heading, version),
                                ("packaging/conda/meta.yaml", conda, version),
                                ("packaging/spack/package.py", spack, version), ("CITATION.cff", citation["date-released"], day)):
        if got != expected:
            yield path, 1, f"expected {expected}, got {got}"


if __name__ == "__main__":
    if len(sys.argv) == 3:
        found, _, text = notes(sys.argv[1])
        if sys.argv[2] != "v" + found:
            sys.exit(f"expected the tag v{found}, which CHANGELOG.md tells of, got {sys.argv[2]}")
        print(text.strip())
    else:
        tree.run(check)
