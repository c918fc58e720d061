# SPDX-License-Identifier: BSD-3-Clause
"""Runs LIGGGHTS, where it is installed, on one process, and compares all cells that its fix ave/euler wrote."""
import os
import shutil
import subprocess

import numpy
import plain_average
import plain_dump
import plain_euler
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

LO, HI = numpy.array([-0.05, -0.05, 0]), numpy.array([0.05, 0.05, 0.15])
SCRIPT = """
atom_style granular
atom_modify map array
boundary p p f
newton off
communicate single vel yes
units si
region reg block -0.05 0.05 -0.05 0.05 0. 0.15 units box
create_box 2 reg
neighbor 0.002 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5.e6 5.e6
fix m2 all property/global poissonsRatio peratomtype 0.45 0.45
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix m4 all property/global coefficientFriction peratomtypepair 2 0.3 0.3 0.3 0.3
pair_style gran model hertz tangential history
pair_coeff * *
timestep 0.00002
fix fall all gravity 9.81 vector 0.0 0.0 -1.0
fix ground all wall/gran model hertz tangential history primitive type 1 zplane 0.0
fix large all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 0.0035
fix small all particletemplate/sphere 49979687 atom_type 2 density constant 1500 radius constant 0.0025
fix both all particledistribution/discrete 15485867 2 large 0.6 small 0.4
region above block -0.05 0.05 -0.05 0.05 0.01 0.15 units box
fix insert all insert/pack seed 32452843 distributiontemplate both vel constant 0.1 0.05 -0.5 &
  insert_every once overlapcheck yes all_in yes particles_in_region 1000 region above
fix move all nve/sphere
fix cells all ave/euler nevery 100 cell_size_relative 3. parallel no
compute stress all stress/atom pair
run 1
dump grains all custom 1000 grains.dump id type x y z ix iy iz vx vy vz radius mass &
  c_stress[1] c_stress[2] c_stress[3] c_stress[4] c_stress[5] c_stress[6]
dump_modify grains format "%d %d %.17g %.17g %.17g %d %d %d %.17g %.17g %.17g %.17g %.17g &
  %.17g %.17g %.17g %.17g %.17g %.17g"
dump cells all euler/vtk 1000 euler_*.vtk
run 2999
"""


def main():
    if not shutil.which("liggghts"):
        print("skipped: liggghts is not installed")
        return
    with open("in.settling", "w", encoding="ascii") as file:
        file.write(SCRIPT)
    done = subprocess.run(["liggghts", "-log", "none", "-in", "in.settling"], capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    dump = GranularDumpReader(FileNames=[os.path.abspath("grains.dump")])
    average = GranularEulerAverage(Input=dump, Output="Points", CellsBy="CellSizeRelative", CellSizeRelative=3,
                                   Weights="Centre", StressArray="c_stress")
    largest, excepted = {}, 0
    for frame in plain_dump.read("grains.dump"):
        if frame.timestep not in (1000, 2000, 3000):
            continue
        theirs = plain_euler.read(f"euler_{frame.timestep}.vtk")
        assert theirs["volumefraction"].max() > 0.1 and theirs["pressure"].max() > 10
        average.UpdatePipeline(frame.timestep)
        output = servermanager.Fetch(average)
        found = {name: vtk_to_numpy(output.GetPointData().GetArray(name)).reshape(112, -1)
                 for name in plain_euler.ARRAYS}
        found["centres"] = vtk_to_numpy(output.GetPoints().GetData())
        # of a cell with a particle that is beyond a periodic face, LIGGGHTS' own v_avg is too small, by up to 3.5e-5 of it
        particles = plain_average.particles(frame)
        shares = plain_average.by_centres(particles, LO, HI, (4, 4, 7), (0, 1))
        beyond = ((particles["x"] < LO) | (particles["x"] >= HI)).any(axis=1)
        whole = numpy.ones(112, bool)
        whole[shares[1][beyond[shares[0]]]] = False
        excepted += (~whole).sum()
        assert (abs(found["v_avg"] - theirs["v_avg"]) <= 5e-7 + 3.5e-5 * abs(theirs["v_avg"])).all(), frame.timestep
        for name, rows in theirs.items():
            apart = abs(found[name] - rows)[whole if name in ("v_avg", "pressure") else slice(None)].max()
            largest[name] = max(apart, largest.get(name, 0))
    print({name: f"{apart:.4g}" for name, apart in largest.items()}, f"but for {excepted} cells")
    assert all(apart < 5.01e-7 for apart in largest.values()) and excepted < 10


main()
