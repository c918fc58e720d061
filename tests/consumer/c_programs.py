# SPDX-License-Identifier: BSD-3-Clause
"""Takes the folder of the programs of samples/c_programs and the files of the samples: what they print is what a plain reading of
the file gives, and what they write is what they say."""
import os
import subprocess
import sys

import plain_dump

folder, samples = sys.argv[1:]
dump = os.path.join(samples, "grains.dump")
frames = plain_dump.read(dump)


def run(name, *arguments):
    done = subprocess.run([os.path.join(folder, name), *arguments], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


lines = [line.split() for line in run("energy", dump).splitlines()]
assert [int(line[0]) for line in lines] == [frame.timestep for frame in frames]
for line, frame in zip(lines, frames):
    v, mass = frame.stack(["vx", "vy", "vz"]), frame.numbers("mass")
    energy = (0.5 * mass * (v ** 2).sum(axis=1)).sum() if len(mass) else 0
    assert int(line[1]) == len(mass) and abs(float(line[2]) - energy) <= 1e-11 * energy, (line, energy)
done = subprocess.run([os.path.join(folder, "energy"), "no_such.dump"], capture_output=True, text=True)
assert done.returncode == 1 and done.stderr == "no_such.dump: no such file or folder\n", done.stderr

run("falling", "falling.dump")
fallen = plain_dump.read("falling.dump")
assert [frame.timestep for frame in fallen] == [0, 100, 200, 300]
assert fallen[0].stack("xyz").tolist() == [[0.5 + i % 5, 0.5 + i // 5, 8] for i in range(10)]
height = fallen[-1].numbers("z")
expected = 8 - sum(9.81e-6 * k for k in range(1, 301))  # v is updated first
assert abs(height - expected).max() < 1e-12, height

if os.path.exists(os.path.join(folder, "heights")):
    rows, mean = run("heights", dump).split()
    last = frames[-1].stack("xyz")[:, 2]
    assert int(rows) == len(last) == 1200 and abs(float(mean) - last.mean()) < 1e-9, (rows, mean)
    print("Fortran, too")
else:
    print("no Fortran compiler")
