# SPDX-License-Identifier: BSD-3-Clause
"""No function takes more than 128 KiB of the stack at once: threads may have 256 KiB. Reads the instructions of the library.

stack_frames.py LIBRARY"""
import re
import subprocess
import sys

MOST = 1 << 17
# What a function takes when it begins; in large steps, it counts up to an address that it loads first.
TAKES = re.compile(r"\bsub\s+\$0x([0-9a-f]+),%rsp|\blea\s+-0x([0-9a-f]+)\(%rsp\),%r11")
frames = {}
name = ""
with subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", sys.argv[1]], stdout=subprocess.PIPE, text=True) as listing:
    for line in listing.stdout:
        if line.endswith(">:\n"):
            name = line.partition("<")[2][:-3]
        elif "%rsp" in line:
            found = TAKES.search(line)
            if found:
                size = int(found[1] or found[2], 16)
                size = min(size, (1 << 64) - size)  # subtracting -128 is a shorter instruction than adding 128
                frames[name] = max(frames.get(name, 0), size)
if listing.returncode or not frames:
    print("skipped: no objdump, or instructions of another processor")
    sys.exit(0)
assert len(frames) > 100, len(frames)
names = sorted(frames, key=frames.get, reverse=True)
large = {name: frames[name] for name in names if frames[name] > MOST}
shown = subprocess.run(["c++filt"], input="\n".join(f"{frames[name]} bytes: {name}" for name in large or names[:1]), capture_output=True, text=True)
assert not large, shown.stdout
print(f"{len(frames)} functions, the largest of {shown.stdout.strip()}")
