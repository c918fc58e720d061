# SPDX-License-Identifier: BSD-3-Clause
"""Sources look as clang-format has them, in the version that is given: others break lines elsewhere.

    format.py TREE CLANG_FORMAT
"""
import os
import re
import subprocess
import sys

import tree

SOURCES = r".*\.(h|cpp|cxx)"
FILES_A_CALL = 100


def check(root, clang_format):
    paths = [path for path in tree.files(root) if re.fullmatch(SOURCES, path)]
    for first in range(0, len(paths), FILES_A_CALL):
        some = [os.path.join(root, path) for path in paths[first:first + FILES_A_CALL]]
        ended = subprocess.run([clang_format, "--style=file", "--dry-run", *some],
                               stderr=subprocess.PIPE, text=True, check=False)
        if ended.returncode != 0:
            raise RuntimeError(ended.stderr)
        for path, line in re.findall(r"^(.*?):(\d+):\d+: warning: ", ended.stderr, re.MULTILINE):
            yield os.path.relpath(path, root), int(line), "is not as clang-format has it"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: format.py top-of-the-source-tree clang-format")
    command = sys.argv.pop()
    tree.run(lambda root: check(root, command))
