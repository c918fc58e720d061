// SPDX-License-Identifier: BSD-3-Clause
// Files of dump euler/vtk, as LIGGGHTS, PFM and VTK write them.
#include "euler_files.h"

#include "../support/byte_source_packing.h"
#include "../support/stop.h"

#include "granular/bytes/byte_source_unpack.h"
#include "granular/formats/decomposition/decomposition_file.h"
#include "granular/frames/named_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

using namespace granular;

namespace
{
std::string names_of(const EulerFrame& frame)
{
  std::string names;
  for (const EulerValues& array : frame.arrays)
  {
    names += array.name + " ";
  }
  return names;
}

std::string path_of(const std::string& file)
{
  return std::string(GRANULAR_DATA) + "/good/" + file;
}

const std::vector<double>& values_of(const EulerFrame& frame, const std::string& name)
{
  return std::ranges::find(frame.arrays, name, &EulerValues::name)->values;
}
}

TEST(EulerFile, OfLiggghts)
{
  EulerFile file(data_file("good/euler_4000.vtk"));
  ASSERT_EQ(file.frames(), 1u);
  EXPECT_EQ(file.entry().rows, 112);
  EXPECT_EQ(file.entry().timestep, 0);
  EXPECT_EQ(file.entry().line, 1);
  EXPECT_EQ(file.entry().end, 10202);
  EXPECT_EQ(file.entry().shape, 0u);
  EXPECT_EQ(euler_format().complete, &name_steps);
  const EulerFrame frame = file.read();
  EXPECT_EQ(frame.cells, 112);
  EXPECT_EQ(names_of(frame), "v_avg volumefraction radius pressure ");
  EXPECT_EQ(frame.arrays[0].components, 3);
  EXPECT_EQ(frame.arrays[1].components, 1);
  EXPECT_EQ(frame.arrays[0].values.size(), 336u);
  EXPECT_EQ(frame.arrays[3].values.size(), 112u);
  // the nearest doubles, not those of type float
  EXPECT_EQ(frame.centres[0], -0.0375);
  EXPECT_EQ(frame.centres[2], 0.010714);
  EXPECT_TRUE(frame.faces[0].empty() && frame.faces[1].empty() && frame.faces[2].empty());
  EXPECT_EQ(file.said() + file.told() + file.defect(), "");
}

TEST(EulerFile, OfPfm)
{
  for (const std::string& text : { two_points(true), two_boxes(), two_hexahedra() })
  {
    EulerFile file(text);
    ASSERT_EQ(file.frames(), 1u) << file.defect();
    const EulerFrame frame = file.read();
    EXPECT_EQ(frame.cells, 2);
    EXPECT_EQ(cells_of(frame), cells_of_two(true));
    EXPECT_EQ(names_of(frame), "v_avg volumefraction radius pressure sigma tau ");
  }
  const EulerFrame boxes = EulerFile(two_boxes()).read();
  EXPECT_EQ(boxes.faces[0], (std::vector<double>{ -0.5, 0, 0.5 }));
  EXPECT_EQ(boxes.faces[1], (std::vector<double>{ 0.25, 0.75 }));
  EXPECT_EQ(boxes.faces[2], (std::vector<double>{ 0.75, 1.25 }));
}

// What is behind `none` has lost its arrays.
TEST(EulerFile, WrittenByVtk)
{
  for (const std::string end : { "_42.vtk", "_42_binary.vtk", "_51.vtk", "_51_binary.vtk" })
  {
    SCOPED_TRACE(end);
    for (const std::string name : { "points", "grid", "hexahedra" })
    {
      EulerFile file(data_file("good/euler/" + name + end));
      ASSERT_EQ(file.frames(), 1u) << file.defect();
      EXPECT_EQ(file.entry().line, end.find("binary") == std::string::npos ? 1 : 0);
      EXPECT_EQ(cells_of(file.read()), cells_of_two(true));
      EXPECT_TRUE(is_euler_file(path_of("euler/" + name + end)));
    }
    EulerFile none(data_file("good/euler/none" + end));
    ASSERT_EQ(none.frames(), 1u) << none.defect();
    EXPECT_EQ(none.read().cells, 0);
  }
}

TEST(EulerFile, WithoutCells)
{
  EulerFile file(no_points());
  ASSERT_EQ(file.frames(), 1u);
  const EulerFrame frame = file.read();
  EXPECT_EQ(frame.cells, 0);
  EXPECT_TRUE(frame.centres.empty());
  EXPECT_EQ(names_of(frame), "v_avg volumefraction radius pressure ");
}

// VTK's reader drops all arrays from the first of these on.
TEST(EulerFile, NumbersThatAreNone)
{
  std::string text = replaced(two_points(), "1.000000 2.000000 3.000000", "nan -nan inf");
  text = replaced(text, "0.625000", "-inf");
  text = replaced(text, "0.500000 1.000000\n0.25", "-1.#IND 1.#INF\n0.25");
  EulerFile file(text);
  ASSERT_EQ(file.frames(), 1u) << file.defect();
  const EulerFrame frame = file.read();
  EXPECT_TRUE(std::isnan(frame.centres[1]));
  EXPECT_EQ(frame.centres[2], std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(values_of(frame, "v_avg")[0]) && std::isnan(values_of(frame, "v_avg")[1]));
  EXPECT_TRUE(std::signbit(values_of(frame, "v_avg")[1]));
  EXPECT_EQ(values_of(frame, "v_avg")[2], std::numeric_limits<double>::infinity());
  EXPECT_EQ(values_of(frame, "volumefraction")[1], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(values_of(frame, "pressure"), (std::vector<double>{ -100.5, 1000 }));
}

TEST(EulerFile, TheNearestDouble)
{
  EulerFile file(replaced(replaced(two_points(), "0.625000", "0.1"), "1000.000000",
    "0.1000000000000000055511151231257827021181583404541015625"));
  const EulerFrame frame = file.read();
  EXPECT_EQ(values_of(frame, "volumefraction")[1], 0.1);
  EXPECT_EQ(values_of(frame, "pressure")[1], 0.1);
}

TEST(EulerFile, TextInAnyForm)
{
  const std::string good = two_points(true);
  const std::string other_title = replaced(good, "LIGGGHTS mesh/VTK export", "mine");
  const std::size_t vertices = good.find("VERTICES");
  const std::string forms[] = { replaced(good, "\n", "\r\n"), "\xef\xbb\xbf" + good,
    replaced(good, "float", "DOUBLE"), replaced(good, "POINT_DATA", "point_data"),
    replaced(good, "Version 2.0", "Version 1.0"), replaced(good, " 0.250000", " +2.5E-01"),
    good + "\n\n  ", good + std::string(5000, '\0'), other_title,
    replaced(good, "VERTICES 2 4\n1 0\n1 1\n", ""),
    replaced(good, "VERTICES 2 4\n1 0\n1 1\n", "VERTICES 1 3\n2 1 0\n"),
    replaced(good, "1 0\n1 1\n", "1 1\n1 0\n"),
    good.substr(0, vertices) + "METADATA\nINFORMATION 0\n\n" + good.substr(vertices),
    replaced(good, "POINTS", "FIELD FieldData 1\nTimeValue 1 1 double\n0.5\nPOINTS"),
    replaced(
      good, "POINT_DATA", "CELL_DATA 2\nSCALARS v_avg int\nLOOKUP_TABLE default\n1 2\nPOINT_DATA"),
    good + "CELL_DATA 2\nSCALARS radius int\nLOOKUP_TABLE default\n1 2\n",
    good + "LOOKUP_TABLE pressure 2\n0 0 0 1 1 1 1 1\n" };
  for (const std::string& text : forms)
  {
    EulerFile file(text);
    ASSERT_EQ(file.frames(), 1u) << text << file.defect();
    EXPECT_EQ(cells_of(file.read()), cells_of_two(true)) << text;
    EXPECT_EQ(file.said() + file.told(), "");
  }
}

TEST(EulerFile, OtherArraysAreKept)
{
  EulerFile file(two_points() +
    "SCALARS granular_temperature double 2\nLOOKUP_TABLE default\n1 2\n3 4\nFIELD more 3\n"
    "count 1 2 vtkIdType\n7 8\nnames 1 2 string\na b\nc\nlabels 1 2 string\nd\ne\n"
    "TENSORS stress float\n1 2 3\n4 5 6\n7 8 9\n1 2 3\n4 5 6\n7 8 9\n");
  ASSERT_EQ(file.frames(), 1u) << file.defect();
  const EulerFrame frame = file.read();
  EXPECT_EQ(
    names_of(frame), "v_avg volumefraction radius pressure granular_temperature count stress ");
  EXPECT_EQ(frame.arrays[4].components, 2);
  EXPECT_EQ(frame.arrays[4].values, (std::vector<double>{ 1, 2, 3, 4 }));
  EXPECT_EQ(values_of(frame, "count"), (std::vector<double>{ 7, 8 }));
  EXPECT_EQ(frame.arrays[6].components, 9);
  EXPECT_EQ(file.told(),
    "memory:1: expected arrays of numbers, got 2 of text, which are left out: the first is "
    "'names'\n");
  // of a file that is not LIGGGHTS' own two arrays are enough
  const std::string text = replaced(two_points(), "LIGGGHTS mesh/VTK export", "vtk output");
  EulerFile few(text.substr(0, text.find("SCALARS radius")));
  ASSERT_EQ(few.frames(), 1u) << few.defect();
  EXPECT_EQ(names_of(few.read()), "v_avg volumefraction ");
}

TEST(EulerFile, ArraysThatAreWanted)
{
  EulerFile file(two_boxes());
  Progress progress;
  Notices notices;
  EXPECT_EQ(euler_array_names(file.source(), file.entry(), progress),
    (std::vector<std::string>{ "v_avg", "volumefraction", "radius", "pressure", "sigma", "tau" }));
  const EulerFrame frame = read_euler(
    file.source(), file.entry(), [](std::string_view name) { return name == "tau"; }, notices,
    progress);
  EXPECT_EQ(names_of(frame), "tau ");
  EXPECT_EQ(frame.centres, cells_of_two(false).centres);
}

// ---- cells with faces --------------------------------------------------------------------------------

TEST(EulerFile, TheMiddleOfCells)
{
  // x y z, x fastest
  const std::string text = euler_header +
    "DATASET RECTILINEAR_GRID\nDIMENSIONS 3 2 3\nX_COORDINATES 3 float\n0 1 3\n"
    "Y_COORDINATES 2 float\n-1 0\nZ_COORDINATES 3 float\n0.1 0.3 1e308\nCELL_DATA 4\n";
  std::string arrays = arrays_of_two(false);
  arrays = replaced(arrays, "-0.000000\nSCALARS", "0\n1 2 3\n1 2 3\nSCALARS");
  arrays = replaced(arrays, "default\n", "default\n1 2 ");
  EulerFile file(text + arrays);
  ASSERT_EQ(file.frames(), 1u) << file.defect();
  const double low = (0.1 + 0.3) / 2;
  const double high = 0.5e308;
  EXPECT_EQ(file.read().centres,
    (std::vector<double>{ 0.5, -0.5, low, 2, -0.5, low, 0.5, -0.5, high, 2, -0.5, high }));
  // a skew cell: the mean of its corners
  EulerFile skew(replaced(two_hexahedra(), "-0.500000 0.250000 0.750000", "-4.5 4.25 0.75"));
  EXPECT_EQ(skew.read().centres, (std::vector<double>{ -0.75, 1, 1, 0.25, 0.5, 1 }));
  // voxels have other corners, and the same middle
  EulerFile voxels(replaced(replaced(replaced(two_hexahedra(), "12\n12\n", "11\n11\n"),
                              "8 0 1 2 3 4 5 6 7", "8 0 1 3 2 4 5 7 6"),
    "8 8 9 10 11 12 13 14 15", "8 8 9 11 10 12 13 15 14"));
  EXPECT_EQ(cells_of(voxels.read()), cells_of_two(true));
}

// ---- files that are not complete, or more ------------------------------------------------------------

TEST(EulerFile, NotYetComplete)
{
  EulerFile empty("");
  EXPECT_EQ(empty.frames(), 0u);
  EXPECT_EQ(empty.said() + empty.defect(), "");
  EulerFile header(euler_header);
  EXPECT_EQ(header.frames(), 0u);
  EXPECT_EQ(header.said(), "");
  EXPECT_EQ(header.defect(),
    "memory:4: expected DATASET POLYDATA, RECTILINEAR_GRID or UNSTRUCTURED_GRID, got the end of "
    "the file");
  // between two arrays
  const std::string text = two_points();
  EulerFile file(text.substr(0, text.find("SCALARS radius")));
  EXPECT_EQ(file.frames(), 0u);
  EXPECT_EQ(file.defect(), "memory:19: expected an array 'radius', got the end of the file");
  file.grow(text);
  ASSERT_EQ(file.frames(), 1u);
  EXPECT_EQ(file.defect(), "");
  // of PFM more may come
  EXPECT_EQ(names_of(file.read()), "v_avg volumefraction radius pressure ");
  file.grow(two_points(true));
  ASSERT_EQ(file.frames(), 1u);
  EXPECT_EQ(names_of(file.read()), "v_avg volumefraction radius pressure sigma tau ");
  EXPECT_EQ(file.said(), "");
}

TEST(EulerFile, AnotherHeader)
{
  EulerFile file(two_points() + two_points());
  ASSERT_EQ(file.frames(), 1u);
  EXPECT_EQ(file.said(),
    "memory:27: expected the end of the file behind Euler cells, got another header; what "
    "follows is left out\n");
  EXPECT_EQ(cells_of(file.read()), cells_of_two(false));
  file.grow(two_points() + two_points() + " ");
  EXPECT_EQ(std::ranges::count(file.said(), '\n'), 1);
}

TEST(EulerFile, ChangedSinceItWasIndexed)
{
  FrameEntry entry = EulerFile(two_points()).entry();
  entry.rows = 3;
  const std::string text = two_points();
  const auto source = open_memory(text);
  Notices notices;
  Progress progress;
  EXPECT_EQ(error_of([&] { read_euler(*source, entry, all_arrays, notices, progress); }),
    "memory:1: the file changed since it was indexed: expected 3 cells, got 2; reload the files");
}

TEST(EulerFile, Compressed)
{
  const std::string text = data_file("good/euler_3000.vtk");
  EulerFile plain(text);
  for (const std::string& packed : { packing::gzip(text), packing::zstd(text) })
  {
    const auto source = unpack(open_memory(packed));
    FileIndex index;
    Progress progress;
    Notices notices;
    euler_format().index(*source, index, progress, {});
    ASSERT_EQ(index.frames.size(), 1u);
    const EulerFrame frame = read_euler(*source, index.frames[0], all_arrays, notices, progress);
    EXPECT_EQ(cells_of(frame), cells_of(plain.read()));
  }
}

TEST(EulerFile, ReportsAndCanBeCancelled)
{
  Stop stop(Stop::never, 0.5);
  std::string text = two_points();
  text.insert(text.find("SCALARS radius"), std::string(std::size_t{ 1 } << 25, ' '));
  const auto source = open_memory(text);
  FileIndex index;
  EXPECT_THROW(euler_format().index(*source, index, stop, {}), Cancelled);
  EXPECT_GE(stop.reports, 16); // each MiB
  EXPECT_NEAR(stop.last, 0.5, 0.05);
}

// ---- which files are Euler files ---------------------------------------------------------------------

TEST(EulerFile, IsTold)
{
  const Folder folder;
  const auto is_one = [&](const std::string& text)
  { return is_euler_file(folder.write("a.vtk", text)); };
  EXPECT_TRUE(is_euler_file(path_of("euler_1000.vtk")));
  EXPECT_TRUE(is_euler_file(path_of("euler/parallel_2000.vtk")));
  EXPECT_TRUE(is_one(packing::gzip(two_points())));
  const std::string mine = "somebody's own";
  for (const std::string& text : { two_points(), two_points(true), two_boxes(), two_hexahedra() })
  {
    EXPECT_TRUE(is_one(text));
    const std::string other = replaced(text, "LIGGGHTS mesh/VTK export", mine);
    EXPECT_TRUE(is_one(other));
    EXPECT_FALSE(is_one(replaced(text, "v_avg", "v")));
    EXPECT_FALSE(is_one(replaced(text, "volumefraction", "phi")));
    EXPECT_FALSE(is_one(other.substr(0, other.find("SCALARS"))));
    const bool points = text.find("POLYDATA") != std::string::npos;
    EXPECT_FALSE(is_one(points ? replaced(other, "POINT_DATA", "CELL_DATA")
                               : replaced(other, "CELL_DATA", "POINT_DATA")));
  }
  EXPECT_TRUE(is_one(no_points()));
  // the reader says what is wrong with what comes later
  EXPECT_TRUE(is_one(replaced(two_points(), "SCALARS radius", "SCALES radius")));
  EXPECT_TRUE(is_one(replaced(two_points(), "POINT_DATA 2", "POINT_DATA 3")));

  EXPECT_FALSE(is_one(replaced(two_hexahedra(), "12\n12\n", "12\n10\n")));
  EXPECT_FALSE(is_one(data_file("good/grains_1000.dump")));
  EXPECT_FALSE(is_one(data_file("good/grains.bin")));
  EXPECT_FALSE(is_one(data_file("good/decomposition/inl.vtu")));
  EXPECT_FALSE(is_one(""));
  EXPECT_FALSE(is_euler_file(folder.path("missing.vtk")));
  EXPECT_FALSE(is_euler_file(folder.path("")));
}

// LIGGGHTS may be at work; its meshes have the same title.
TEST(EulerFile, IsToldWhereItIsCut)
{
  const Folder folder;
  const auto is_one = [&](const std::string& text)
  { return is_euler_file(folder.write("a.vtk", text)); };
  const std::string text = two_points();
  EXPECT_TRUE(is_one(euler_header));
  const std::size_t vertices = text.find("POINT_DATA");
  for (std::size_t bytes = euler_header.size() + 1; bytes < text.size(); ++bytes)
  {
    EXPECT_EQ(is_one(text.substr(0, bytes)), bytes >= vertices) << bytes;
  }
  const std::string mesh = euler_header +
    "DATASET POLYDATA\nPOINTS 3 float\n0 0 0\n1 0 0\n0 1 0\nPOLYGONS 1 4\n3 0 1 2\nCELL_DATA 1\n"
    "SCALARS f float 1\nLOOKUP_TABLE default\n1\n";
  for (std::size_t bytes = euler_header.size() + 1; bytes <= mesh.size(); ++bytes)
  {
    EXPECT_FALSE(is_one(mesh.substr(0, bytes))) << bytes;
  }
  EXPECT_FALSE(is_one(replaced(mesh, "SCALARS f",
    "VECTORS v_avg float\n0 0 0\nSCALARS "
    "volumefraction")));
}

TEST(EulerFile, IsNoDecomposition)
{
  for (const auto& entry : std::filesystem::directory_iterator(path_of("decomposition")))
  {
    EXPECT_FALSE(is_euler_file(entry.path().string())) << entry.path();
  }
  EXPECT_FALSE(is_euler_file(path_of("decomposition_1000.vtk")));
  for (const auto& entry : std::filesystem::directory_iterator(path_of("euler")))
  {
    EXPECT_FALSE(is_decomposition_file(entry.path().string())) << entry.path();
  }
  EXPECT_FALSE(is_decomposition_file(path_of("euler_1000.vtk")));
  const Folder folder;
  for (const std::string& text : { two_points(), two_boxes(), two_hexahedra(), euler_header })
  {
    EXPECT_FALSE(is_decomposition_file(folder.write("a.vtk", text)));
  }
}
