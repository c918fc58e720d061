// SPDX-License-Identifier: BSD-3-Clause
// What is said of files that are wrong, to the letter: this is what a user sees.
#include "euler_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
/// A change of a good file, and what is said behind its name.
struct Bad
{
  const char* what;
  const char* with;
  const char* said;
};

// Found when the file is indexed.
constexpr Bad bad_points[] = {
  { "# vtk DataFile", "vtk DataFile",
    ":1: expected '# vtk DataFile', got 'vtk DataFile Version 2.0'" },
  { "Version 2.0", "Version 6.0",
    ":1: expected a version from 1.0 to 5.1, got '# vtk DataFile Version 6.0'" },
  { "ASCII", "TEXT", ":3: expected ASCII or BINARY, got 'TEXT'" },
  { "DATASET POLYDATA", "DATASET STRUCTURED_POINTS",
    ":4: expected DATASET POLYDATA, RECTILINEAR_GRID or UNSTRUCTURED_GRID, got "
    "'STRUCTURED_POINTS'" },
  { "POINTS 2", "POINTS two",
    ":5: expected a number of at least 0 as word 2, got 'POINTS two float'" },
  { "POINTS 2", "POINTS 3", ":8: expected a number (7 of 9), got 'VERTICES'" },
  { "POINTS 2", "POINTS 1", ":7: expected a section of Euler cells, got '0.250000'" },
  { "POINTS 2", "POINTS 1000000000000000000",
    ":6: expected 3000000000000000000 numbers, got the end of the file" },
  { "POINTS 2 float", "POINTS 2", ":5: expected a type of values as word 3, got 'POINTS 2'" },
  { "VERTICES 2 4", "POINTS 2 float", ":8: expected one section of the name, got 'POINTS'" },
  { "VERTICES 2 4", "VERTICES 2 5", ":11: expected a number (5 of 5), got 'POINT_DATA'" },
  { "VERTICES 2 4", "VERTICES", ":8: expected a number of at least 0 as word 2, got 'VERTICES'" },
  { "VERTICES", "LINES", ":8: expected a section of Euler cells, got 'LINES'" },
  { "POINT_DATA 2", "POINT_DATA 3", ":11: expected data of 2 points, got '3'" },
  { "POINT_DATA 2", "POINT_DATA 1", ":11: expected data of 2 points, got '1'" },
  { "POINT_DATA 2", "CELL_DATA 2", ":27: expected an array 'v_avg', got the end of the file" },
  { "VECTORS v_avg", "SCALARS v_avg",
    ":13: expected LOOKUP_TABLE, got '1.000000 2.000000 3.000000'" },
  { "v_avg", "v", ":27: expected an array 'v_avg', got the end of the file" },
  { "v_avg float", "v_avg real",
    ":12: expected a type of values as word 3, got 'VECTORS v_avg real'" },
  { "volumefraction float 1", "volumefraction float 2",
    ":16: expected values of 'volumefraction', 1 x 2, got '2 x 2'" },
  { "radius", "volumefraction", ":20: expected one array of the name, got 'volumefraction'" },
  { "SCALARS radius float 1\nLOOKUP_TABLE default\n", "FIELD f 1\nradius 1 3 float\n",
    ":20: expected values of 'radius', 1 x 2, got '1 x 3'" },
  { "SCALARS pressure float 1\nLOOKUP_TABLE default\n", "FIELD f 2\nmine 0 2 float\n",
    ":24: expected values of 'mine', any number x 2, got '0 x 2'" },
  { "SCALARS pressure", "SCALES pressure", ":23: expected a section of Euler cells, got 'SCALES'" },
  { "1000.000000\n", "", ":26: expected 2 numbers, got 1 and the end of the file" },
  { "1000.000000\n", "1000.000000", ":26: expected 2 numbers, got 1 and the end of the file" },
};

// Found when the cells are read.
constexpr Bad bad_numbers[] = {
  { "0.625000", "0.6.5", ":18: expected a number (2 of 2), got '0.6.5'" },
  { "0.625000", "0,625", ":18: expected a number (2 of 2), got '0,625'" },
  { "1 1\nPOINT", "1 2\nPOINT", ":10: expected points from 0 to 1 in vertex 1, got 2" },
  { "1 0\n1 1\n", "1 -1\n1 1\n", ":9: expected points from 0 to 1 in vertex 0, got -1" },
  { "VERTICES 2 4", "VERTICES 3 4", ":9: expected 3 cells in 4 numbers, got 2" },
  { "1 1\nPOINT", "2 1\nPOINT",
    ":10: expected a number of points, of which there are at most 1, got 2" },
  { "1 1\nPOINT", "1 1.5\nPOINT", ":10: expected a whole number (4 of 4), got '1.5'" },
};

constexpr Bad bad_boxes[] = {
  { "DIMENSIONS 3 2 2", "DIMENSIONS 3 2 3",
    ":5: expected DIMENSIONS 3 2 2 as of the coordinates, got 3 2 3" },
  { "DIMENSIONS 3 2 2", "DIMENSIONS 3 2",
    ":5: expected a number of at least 0 as word 4, got 'DIMENSIONS 3 2'" },
  { "Y_COORDINATES 2 float\n0.250000 0.750000", "Y_COORDINATES 1 float\n0.25",
    ":8: expected at least 2 coordinates, got '1'" },
  { "Y_COORDINATES 2 float\n0.250000 0.750000\n", "",
    ":10: expected Y_COORDINATES, got 'CELL_DATA'" },
  { "CELL_DATA 2", "CELL_DATA 4", ":12: expected data of 2 cells, got '4'" },
};

constexpr Bad bad_hexahedra[] = {
  { "CELLS 2 18", "CELLS 2 12", ":14: expected eight points in each cell, got 'CELLS 2 12'" },
  { "CELL_TYPES 2\n12\n", "CELL_TYPES 1\n", ":17: expected CELL_TYPES of 2 cells, got 1" },
  { "CELL_DATA 2", "CELL_DATA 16", ":20: expected data of 2 cells, got '16'" },
};

constexpr Bad bad_corners[] = {
  { "14 15\n", "14 16\n", ":16: expected points from 0 to 15 in cell 1, got 16" },
  { "8 0 1", "7 0 1", ":16: expected a number of points, of which there are at most 1, got 14" },
  { "8 0 1 2 3 4 5 6 7\n8 8", "7 0 1 2 3 4 5 6\n9 7 8",
    ":15: expected eight points in a cell, got 7" },
  { "12\n12\n", "12\n10\n",
    ":19: expected the cell type of a voxel (11) or a hexahedron (12), got 10" },
};

template <std::size_t count>
void expect_defects(const std::string& good, const Bad (&all)[count])
{
  for (const Bad& bad : all)
  {
    const std::string text = replaced(good, bad.what, bad.with);
    ASSERT_NE(text, good) << bad.what;
    EulerFile file(text);
    EXPECT_EQ(file.frames(), 0u) << bad.said;
    EXPECT_EQ(file.defect(), "memory" + std::string(bad.said));
    // what may still be growing is not complained about
    const bool ended = std::string(bad.said).find("the end of the file") != std::string::npos;
    EXPECT_EQ(file.said(), ended ? "" : file.defect() + "; the frame is left out\n");
  }
}

template <std::size_t count>
void expect_errors(const std::string& good, const Bad (&all)[count])
{
  for (const Bad& bad : all)
  {
    const std::string text = replaced(good, bad.what, bad.with);
    ASSERT_NE(text, good) << bad.what;
    EulerFile file(text);
    ASSERT_EQ(file.frames(), 1u) << bad.said << file.defect();
    EXPECT_EQ(file.error(), "memory" + std::string(bad.said));
  }
}
}

TEST(EulerBadInput, Points)
{
  expect_defects(two_points(), bad_points);
  expect_errors(two_points(), bad_numbers);
}

TEST(EulerBadInput, CellsWithFaces)
{
  expect_defects(two_boxes(), bad_boxes);
  expect_defects(two_hexahedra(), bad_hexahedra);
  expect_errors(two_hexahedra(), bad_corners);
}

// Lines are not counted there, bytes are.
TEST(EulerBadInput, Binary)
{
  const std::string good = data_file("good/euler/points_42_binary.vtk");
  const std::size_t vertices = good.find("VERTICES 2 4\n") + 13;
  std::string text = good;
  text[vertices + 7] = '\x05'; // counts and points have four bytes each
  EulerFile file(text);
  ASSERT_EQ(file.frames(), 1u) << file.defect();
  EXPECT_EQ(file.error(),
    "memory@" + std::to_string(vertices) + ": expected points from 0 to 1 in vertex 0, got 5");
  EulerFile data(replaced(good, "POINT_DATA 2", "POINT_DATA 5"));
  EXPECT_EQ(data.defect(),
    "memory@" + std::to_string(good.find("POINT_DATA")) + ": expected data of 2 points, got '5'");
}

TEST(EulerBadInput, OtherFiles)
{
  EXPECT_EQ(EulerFile(data_file("good/grains_1000.dump")).defect(),
    "memory:1: expected '# vtk DataFile', got 'ITEM: TIMESTEP'");
  EXPECT_EQ(EulerFile(data_file("good/decomposition_1000.vtk")).defect(),
    "memory:12: expected an array 'v_avg', got the end of the file");
  EXPECT_EQ(EulerFile(std::string(100'000, '\0')).defect(), "");
  EXPECT_EQ(EulerFile(std::string(100'000, 'x')).defect(),
    "memory:1: expected a line of at most 65536 bytes, got a longer one");
}
