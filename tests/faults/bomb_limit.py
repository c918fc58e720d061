# SPDX-License-Identifier: BSD-3-Clause
"""The limit of the content of compressed files, where users meet it: a small file with much in it is refused.
Argument: proxies, for those of ParaView; else the package and the command."""
import gzip
import os
import sys

REFUSED = ("expected content of at most 200 times", "if you trust the file, unpack it first")
PARTS, ROWS = 270, b"1 1 0 0 0\n" * 104858  # a MiB each


def write_bomb(path):
    """A dump of equal rows, 270 MiB in 700 kB."""
    header = (f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{PARTS * 104858}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
              "ITEM: ATOMS id type x y z\n")
    with open(path, "wb") as file:
        file.write(gzip.compress(header.encode()) + PARTS * gzip.compress(ROWS))
    assert os.path.getsize(path) < 1 << 20


def check_package(path):
    import granular

    try:
        granular.open(path)
        raise AssertionError("a bomb was opened")
    except granular.Error as error:
        assert all(word in str(error) for word in REFUSED), error


def check_log():
    import granular

    def refused(path, *words):
        try:
            granular.read_log(path)
        except granular.Error as error:
            assert all(word in str(error) for word in words), error
        else:
            raise AssertionError("a bomb was read")

    table = b"Step Temp\n0 1\n1 2\nLoop time of 1\n"
    with open("log.gz", "wb") as file:
        file.write(gzip.compress(table) + PARTS * gzip.compress((b"#" * 1023 + b"\n") * 1024))
    refused("log.gz", *REFUSED)
    with open("log", "wb") as file:
        file.write(table + b"x" * (1 << 22))
    refused("log", "log:5: expected lines of fewer than 4194304 bytes")
    os.remove("log.gz")
    os.remove("log")


def check_command(path):
    from command import granular

    refused = granular("info", path, status=1)
    assert all(word in refused[1] for word in REFUSED), refused


def check_proxies(path):
    import paraview.simple
    from said import said_by

    good = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")
    reader = paraview.simple.GranularDumpReader(FileNames=[good])
    said = said_by(reader.GetClientSideObject())
    reader.FileNames = [path]
    reader.UpdatePipelineInformation()
    assert all(word in " ".join(said) for word in REFUSED), said


bomb = os.path.abspath("bomb.dump.gz")
write_bomb(bomb)
if sys.argv[1:] == ["proxies"]:
    check_proxies(bomb)
else:
    check_package(bomb)
    check_log()
    check_command(bomb)
os.remove(bomb)
