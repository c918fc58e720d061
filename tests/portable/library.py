# SPDX-License-Identifier: BSD-3-Clause
"""library.py FOLDER: the libraries in the wheel that packaging/portable made there keep to the rules of its tag, manylinux_2_28.

They need no newer symbols than the tag's systems have, and no library that these may lack but the ones beside them. libgranular shows
nothing but its functions. The folder to unpack has the same files.
"""
import glob
import os
import re
import subprocess
import sys
import tempfile
import zipfile

#: What every system of the tag has, of what these libraries need: PEP 600 and the policies of auditwheel.
SYSTEM = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libgcc_s.so.1", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
NEWEST = {"GLIBC": (2, 28), "GCC": (7, 0, 0)}


def objdump(option, path):
    return subprocess.run(["objdump", option, path], check=True, capture_output=True, text=True).stdout


def faults(path, beside):
    """Yields what is wrong with a library."""
    name, header = os.path.basename(path), objdump("-p", path)
    needed = set(re.findall(r"NEEDED +(\S+)", header))
    for each in sorted(needed - SYSTEM - beside):
        yield f"{name}: needs {each}, which is not in every system"
    if needed & beside and not re.search(r"RUNPATH +\$ORIGIN\n", header):
        yield f"{name}: needs {sorted(needed & beside)}, and does not look beside itself"
    for version, prefix, number in set(re.findall(r"0x\w+ 0x\w+ \d+ ((GLIBC|GCC)_([0-9.]+))", header)):
        if tuple(map(int, number.split("."))) > NEWEST[prefix]:
            users = re.findall(rf"\({re.escape(version)}\) +(\S+)", objdump("-T", path))
            yield f"{name}: {', '.join(users)} of {version} is newer than the systems of the wheel's tag"
    if name.startswith("libgranular"):
        shown = re.findall(r"^\w+ .{7} (?!\*UND\*|\*ABS\*)\S+\t\w+ +\S+ +(\S+)$", objdump("-T", path), re.MULTILINE)
        if not shown or not all(each.startswith("granular_") for each in shown):
            yield f"{name}: expected to show functions granular_*, got {sorted(set(shown))}"


wheels = glob.glob(os.path.join(glob.escape(sys.argv[1]), "vtk_granular-*.whl"))
if not wheels:
    sys.exit(f"skipped: expected the wheel of packaging/portable in {sys.argv[1]}, got none")
for wheel in wheels:
    processor = re.fullmatch(r"vtk_granular-[0-9.]+-py3-none-manylinux_2_28_(\w+)\.whl", os.path.basename(wheel)).group(1)
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel) as file:
        file.extractall(folder)
        names = file.namelist()
        about = next(file.read(name).decode() for name in names if name.endswith(".dist-info/WHEEL"))
        assert "Root-Is-Purelib: false\n" in about and f"Tag: py3-none-manylinux_2_28_{processor}\n" in about, about
        libraries = [os.path.join(folder, name) for name in names if ".so" in os.path.basename(name)]
        found = [fault for path in libraries for fault in faults(path, set(map(os.path.basename, libraries)))]
        assert libraries and not found, "\n".join(found) or names
        print(f"{os.path.basename(wheel)}: {os.path.getsize(wheel)} bytes; {', '.join(map(os.path.basename, libraries))}")
