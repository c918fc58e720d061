// SPDX-License-Identifier: BSD-3-Clause
// Files of other programs: each is told by its first bytes, whatever its name is, and the error says what to do with it.
#include "granular/frames/other_files.h"

#include "../support/byte_source_packing.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
using namespace std::string_literals;

struct Other
{
  const char* name;
  std::string bytes;
  const char* told; ///< a part of the text
  bool refused;     ///< by a reader in ParaView's window: no reader of ParaView takes it
};

std::string vtk(const std::string& type)
{
  return "<?xml version=\"1.0\"?>\n<VTKFile version=\"1.0\" type=\"" + type +
    "\" byte_order=\"LittleEndian\">\n";
}

/// 80 bytes, a number, and so many triangles.
std::string stl(char triangles)
{
  return std::string(80, 's') + triangles +
    std::string(3 + 50 * static_cast<std::size_t>(triangles), '\0');
}

const std::string log_text = "LAMMPS (4 Jul 2026)\n# a comment\nunits si\natom_style sphere\n";

// clang-format off
const Other others[] = {
  { "legacy", "# vtk DataFile Version 5.1\nmine\nBINARY\nDATASET POLYDATA\n\0\0"s,
    "a VTK file: GranularVTKParticleReader opens particles in it, and GranularMeshReader walls, under a name like NAME.vtk", false },
  { "vtp", vtk("PolyData"), "a VTK file: GranularVTKParticleReader opens particles in it, and GranularMeshReader walls, under a name like NAME.vtp", false },
  { "vtu", "<!-- mine -->\n" + vtk("UnstructuredGrid"), "walls, under a name like NAME.vtu", false },
  { "vti", vtk("RectilinearGrid"), "NAME.vtr (XMLRectilinearGridReader ", false },
  { "vtm", vtk("vtkMultiBlockDataSet"), "walls, under a name like NAME.vtm", false },
  { "pvtp", vtk("PPolyData"), "walls, under a name like NAME.pvtp", false },
  { "pvd", vtk("Collection"), "PVDReader", false },
  { "newer", vtk("Hexagons"), "a VTK file: ParaView opens it", false },
  { "ascii_stl", "solid\n  facet normal 0 0 1\n", "a mesh (STL): GranularMeshReader opens it under a name like NAME.stl", false },
  { "large_stl", "SOLID part\r\nFACET NORMAL 0 0 1\r\n", "a mesh (STL)", false },
  { "binary_stl", stl(2), "a mesh (binary STL)", false },
  { "ply", "ply\nformat ascii 1.0\n", "a mesh (PLY)", false },
  { "log", log_text, "a log of LAMMPS: vtkgranular.read_log reads it in Python", true },
  { "screen", "mpirun: a warning\nLIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0)\n", "a log of LIGGGHTS", true },
  { "later_log", "run 10\nPer MPI rank memory allocation (min/avg/max) = 4 | 4 | 4 Mbytes\n", "a log of LAMMPS", true },
  { "old_log", "run 10\nMemory usage per processor = 5.1 Mbytes\nStep Atoms 1\n", "a log of LAMMPS or LIGGGHTS", true },
  { "thermo", "   Step  Temp\n 0 1.5\n", "a thermo table: vtkgranular.read_log", true },
  { "thermo_yaml", "---\nkeywords: ['Step', 'Temp', ]\n", "a thermo table in YAML: vtkgranular.read_log", true },
  { "script", "# in.mine\nunits si\natom_style sphere\nread_data grains.data\n", "an input script of LAMMPS or LIGGGHTS: run it", true },
  { "xyz", "2\n Atoms. Timestep: 0\nsand 0.1 -2e-3 3\nsand 1 2 3\n", "an xyz file: if a dump command wrote it, OVITO", false },
  { "extended_xyz", "1\r\nProperties=id:I:1:pos:R:3\r\n1 1 2 3\r\n", "an xyz file", false },
  { "cfg", "Number of particles = 110\nA = 1 Angstrom\n", "a file of AtomEye (`dump cfg`): if a dump command wrote it, OVITO", true },
  { "yaml", "---\ncreator: LAMMPS\ntimestep: 0\nnatoms: 2\n", "a file of `dump yaml`: PyYAML", true },
  { "averages", "# Time-averaged data for fix avt\n# TimeStep c_1\n500 0.1\n", "averages of a fix (ave/time, ave/chunk, ave/histo): vtkgranular.read_table", true },
  { "titled", "# my layers\n# TimeStep Number-of-rows\n# Row c_1\n", "averages of a fix", true },
  { "averages_yaml", "# mine\n# TimeStep c_1\n---\nkeywords: ['Step', ]\n", "averages of a fix in YAML: vtkgranular.read_table", true },
  { "fix_print", "# Fix print output for fix p\n0 1\n", "a table of fix print", true },
  { "cdf1", "CDF\1\0\0\0\0"s, "a NetCDF file: if a dump command wrote it, OVITO", true },
  { "cdf2", "CDF\2" + std::string(60, '\0'), "a NetCDF file", true },
  { "cdf5", "CDF\5\0\0\0\0\0\0\0\0"s, "a NetCDF file", true },
  { "netcdf4", "\x89HDF\r\n\x1a\n\0\0_NCProperties"s, "a NetCDF file (HDF5)", true },
  { "h5md", "\x89HDF\r\n\x1a\n\0\0h5md"s, "an HDF5 file (as H5MD is): h5py", true },
  { "vtkhdf", "\x89HDF\r\n\x1a\n\0\0VTKHDF"s, "NAME.hdf (VTKHDFReader ", false },
  { "bzip2", "BZh91AY&SY\x01\x02", "a file packed by bzip2: unpack it first; only gzip and Zstandard need no unpacking", true },
  { "xz", "\xfd" "7zXZ\0\0"s, "a file packed by xz", true },
  { "lz4", "\x04\x22\x4d\x18\x64\x40", "a file packed by lz4", true },
  { "zip", "PK\3\4\x14\0\0\0grains.dump"s, "a zip archive", true },
  { "npz", "PK\3\4\x14\0\0\0points.npy"s, "numpy.load", true },
  { "tar", std::string(257, 'a') + "ustar\0" + "00", "a tar archive", true },
  { "html", "\n<!DOCTYPE html>\n<html>", "a web page", true },
  { "quotes", "\xef\xbb\xbf<VTKFile type='ImageData'>", "XMLImageDataReader", false },
  { "xhtml", "<?xml version=\"1.0\"?><!DOCTYPE html PUBLIC>", "a web page", true },
  { "plain_html", "<HTML>\n<head>", "a web page", true },
  { "lammps", "LammpS RestartT\0\1\0\0\0"s, "a restart file of LAMMPS: `lmp -restart2data FILE NEW.data`", false },
};
// clang-format on

TEST(OtherFiles, AreToldByTheirFirstBytes)
{
  const Folder folder;
  for (const Other& other : others)
  {
    for (const bool packed : { false, true })
    {
      if (packed && other.bytes == stl(2))
      {
        continue; // which is told by its size
      }
      const std::string path =
        folder.write(other.name, packed ? packing::gzip(other.bytes) : other.bytes);
      Series run;
      const std::string said = error_of([&] { run.update({ path }); });
      EXPECT_TRUE(said.starts_with(path + ": expected a dump, got a")) << said;
      EXPECT_NE(said.find(packed ? " inside gzip or Zstandard: " : other.told), said.npos) << said;
      const bool tells =
        said.find(": unpack it") != said.npos || said.find("web page") != said.npos;
      EXPECT_TRUE(!packed || tells) << said; // no reader of other files unpacks them
      EXPECT_EQ(granular::is_refused_file(path), packed || other.refused) << said;
    }
  }
}

TEST(OtherFiles, ThoseOfARunAreNone)
{
  const Folder folder;
  const auto other = [&](const std::string& bytes)
  { return granular::find_other(*granular::open_memory(bytes)).has_value(); };
  EXPECT_FALSE(other("ITEM: TIMESTEP\n0\n"));
  EXPECT_FALSE(other("# vtk\n# timestep\nITEM: TIMESTEP\n0\n"));
  EXPECT_FALSE(other("LAMMPS (mine) data\n\n2 atoms\n0 1 xlo xhi\n"));
  EXPECT_FALSE(other("40 0.1 0.2 0.3\n12 0.1 0.2 0.3\n13 0.1 0.2 0.3\n")); // rows without a header
  EXPECT_FALSE(other("-- PostgreSQL database dump\n"));
  EXPECT_FALSE(other(std::string(200, '\0')));
  EXPECT_FALSE(other(
    "CDF\1\0\0\0\0\2\0\0\0\0\0\0\0"s)); // a binary dump of timestep 21382211, of two particles
  EXPECT_FALSE(other(""));
  EXPECT_TRUE(other(packing::gzip("ITEM: TIMESTEP\n"))); // packed once more than the file tells
  EXPECT_TRUE(granular::is_refused_file(folder.write("empty", "")));
  EXPECT_FALSE(granular::is_refused_file(folder.write("other", "-- PostgreSQL database dump\n")));
  EXPECT_FALSE(granular::is_refused_file(folder.path("none")));
  EXPECT_FALSE(granular::is_refused_file(folder.path("")));
}
}
