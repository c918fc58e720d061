# SPDX-License-Identifier: BSD-3-Clause
"""The limits of compressed files and of lines in Python: vg.open and vg.read_log refuse a small file with much in it."""
import gzip
import os

import vtkgranular as vg

PARTS = 270  # of a MiB each
LIMIT = ("expected content of at most 200 times", "if you trust the file, unpack it first")
TABLE = b"Step Temp\n0 1\n1 2\nLoop time of 1\n"


def expect_refused(read, path, content, words):
    with open(path, "wb") as file:
        file.write(content)
    try:
        read(path)
    except vg.Error as error:
        assert all(word in str(error) for word in words), error
    else:
        raise AssertionError(path + " was read")
    os.remove(path)


header = (f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{PARTS * 104858}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
          "ITEM: ATOMS id type x y z\n")
bomb = gzip.compress(header.encode()) + PARTS * gzip.compress(b"1 1 0 0 0\n" * 104858)
assert len(bomb) < 1 << 20
expect_refused(vg.open, "bomb.dump.gz", bomb, LIMIT)
expect_refused(vg.read_log, "log.gz", gzip.compress(TABLE) + PARTS * gzip.compress((b"#" * 1023 + b"\n") * 1024), LIMIT)
expect_refused(vg.read_log, "log", TABLE + b"x" * (1 << 22), ["log:5: expected lines of fewer than 4194304 bytes"])
