// SPDX-License-Identifier: BSD-3-Clause
// What is said of files that are wrong, to the letter: this is what a user sees.
#include "grid_files.h"

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

constexpr Bad bad_grids[] = {
  { "# vtk DataFile", "vtk DataFile",
    ":1: expected '# vtk DataFile', got 'vtk DataFile Version 2.0'" },
  { "Version 2.0", "Version two",
    ":1: expected a version from 1.0 to 5.1, got '# vtk DataFile Version two'" },
  { "Version 2.0", "Version 6.0",
    ":1: expected a version from 1.0 to 5.1, got '# vtk DataFile Version 6.0'" },
  { "Version 2.0", "", ":1: expected a version from 1.0 to 5.1, got '# vtk DataFile '" },
  { "ASCII", "TEXT", ":3: expected ASCII or BINARY, got 'TEXT'" },
  { "DATASET ", "DATA ", ":4: expected DATASET, got 'DATA RECTILINEAR_GRID'" },
  { "RECTILINEAR_GRID", "STRUCTURED_GRID",
    ":4: expected DATASET RECTILINEAR_GRID or UNSTRUCTURED_GRID, got 'STRUCTURED_GRID'" },
  { "DIMENSIONS 3 2 2", "DIMENSIONS 3 2",
    ":5: expected a number of at least 0 as word 4, got 'DIMENSIONS 3 2'" },
  { "DIMENSIONS 3 2 2", "DIMENSIONS 3 -2 2",
    ":5: expected a number of at least 0 as word 3, got 'DIMENSIONS 3 -2 2'" },
  { "DIMENSIONS", "EXTENT", ":5: expected a section of the grid, got 'EXTENT'" },
  { "X_COORDINATES 3", "X_COORDINATES",
    ":6: expected a type of values as word 3, got 'X_COORDINATES float'" },
  { "X_COORDINATES 3 float", "X_COORDINATES 3 real",
    ":6: expected a type of values as word 3, got 'X_COORDINATES 3 real'" },
  { "X_COORDINATES 3", "X_COORDINATES 4", ":8: expected a number (4 of 4), got 'Y_COORDINATES'" },
  { "X_COORDINATES 3", "X_COORDINATES 2", ":7: expected a section of the grid, got '1.000000'" },
  { "X_COORDINATES 3", "X_COORDINATES 1", ":6: expected at least 2 coordinates, got '1'" },
  { "X_COORDINATES 3", "X_COORDINATES -3",
    ":6: expected a number of at least 0 as word 2, got 'X_COORDINATES -3 float'" },
  { "X_COORDINATES 3", "X_COORDINATES 1000000000000000000",
    ":7: expected 1000000000000000000 numbers, got the end of the file" },
  { "X_COORDINATES 3", "X_COORDINATES 99999999999999999999",
    ":6: expected a number of at least 0 as word 2, got 'X_COORDINATES 99999999999999999999 "
    "float'" },
  { "Y_COORDINATES", "X_COORDINATES", ":8: expected one section of the name, got 'X_COORDINATES'" },
  { "0.250000", "quarter", ":7: expected a number (2 of 3), got 'quarter'" },
  { "Y_COORDINATES 2 float\n0.000000 2.000000 \n", "",
    ":10: expected Y_COORDINATES, got the end of the file" },
  { "-1.000000 0.000000 \n", "-1.000000 \n",
    ":12: expected 2 numbers, got 1 and the end of the file" },
};

// Found when the grid is read.
constexpr Bad bad_coordinates[] = {
  { "0.250000", "0.2.5", ":7: expected a number (2 of 3), got '0.2.5'" },
  { "0.250000", "0,25", ":7: expected a number (2 of 3), got '0,25'" },
};

constexpr Bad bad_voxels[] = {
  { "POINTS 16", "POINTS sixteen",
    ":5: expected a number of at least 0 as word 2, got 'POINTS sixteen float'" },
  { "POINTS 16", "POINTS 17", ":13: expected a number (49 of 51), got 'CELLS'" },
  { "POINTS 16", "POINTS 134217736", ":5: expected at most 16777216 processes, got 16777217" },
  { "CELLS 2 18", "CELLS 2 12", ":13: expected eight points in each cell, got 'CELLS 2 12'" },
  { "CELLS 2 18", "CELLS 3 27", ":17: expected a number (19 of 27), got 'CELL_TYPES'" },
  { "CELLS 2 18", "CELLS", ":13: expected a number of at least 0 as word 2, got 'CELLS'" },
  { "CELL_TYPES 2", "CELL_TYPES 1", ":19: expected a section of the grid, got '11'" },
  { "CELL_TYPES 2\n11\n11\n", "CELL_TYPES 1\n11\n", ":17: expected CELL_TYPES of 2 cells, got 1" },
  { "CELL_TYPES 2\n11\n11\n\n", "", ":17: expected CELL_TYPES, got 'CELL_DATA'" },
  { "CELL_DATA 2", "CELL_DATA 3", ":21: expected data of 2 cells, got '3'" },
  { "nlocal 1 2 int\n7 30 ", "nlocal 2 2 int\n7 30 7 30",
    ":23: expected one value of 'nlocal' for each of 2 cells, got '2 x 2'" },
  { "nlocal 1 2 int\n7 30 ", "nlocal 1 3 int\n7 30 7",
    ":23: expected one value of 'nlocal' for each of 2 cells, got '1 x 3'" },
  { "FIELD FieldData 2", "FIELD FieldData 3",
    ":27: expected an array of the field (3 of 3), got the end of the file" },
  { "FIELD FieldData 2", "FIELD FieldData 1", ":25: expected a section of the grid, got 'proc'" },
  { "FIELD FieldData 2", "SCALARS", ":22: expected a name as word 2, got 'SCALARS'" },
  { "FIELD FieldData 2", "ARRAYS", ":22: expected an array, got 'ARRAYS'" },
  { "FIELD FieldData 2", "SCALARS a int", ":23: expected LOOKUP_TABLE, got 'nlocal 1 2 int'" },
  { "FIELD FieldData 2\nnlocal 1 2 int\n7 30 \nproc 1 2 int\n0 1 \n", "",
    ":22: expected arrays of CELL_DATA, got the end of the file" },
};

constexpr Bad bad_cells[] = {
  { "7 30", "7.5 30", ":24: expected a whole number (1 of 2), got '7.5'" },
  { "7 30", "7\n-1", ":25: expected a number 'nlocal' from 0 to 9223372036854775807, got -1" },
  { "7 30", "1e99 30", ":24: expected a whole number (1 of 2), got '1e99'" },
  { "0 1 \n", "0 2147483648 \n",
    ":26: expected a number 'proc' from 0 to 2147483647, got 2147483648" },
  { "proc 1 2 int\n0 1 \n", "procID 1 2 int\n-1 0 \n",
    ":26: expected a number 'procID' from 0 to 2147483647, got -1" },
  { "11\n11", "11\n10",
    ":19: expected the cell type of a voxel (11) or a hexahedron (12), got 10" },
  { "14 15", "14 16", ":15: expected points from 0 to 15 in cell 1, got 16" },
  { "14 15", "14 -1", ":15: expected points from 0 to 15 in cell 1, got -1" },
  { "8 0 1", "7 0 1", ":15: expected a number of points, of which there are at most 1, got 14" },
  { "8 0 1 2 3 4 5 6 7 \n8 8 9", "9 0 1 2 3 4 5 6 7 \n8 7 9",
    ":14: expected eight points in a cell, got 9" },
  { "14 15", "15 14",
    ":15: expected the corners of a box along the axes, in the order of a voxel or a hexahedron, "
    "got cell 1 with others" },
  { "-0.5 2 0 ", "-0.5 2 1 ",
    ":14: expected the corners of a box along the axes, in the order of a voxel or a hexahedron, "
    "got cell 0 with others" },
  { "-0.5 2 0 ", "-0.5 2 nan ",
    ":14: expected the corners of a box along the axes, in the order of a voxel or a hexahedron, "
    "got cell 0 with others" },
};

template <std::size_t N>
void expect_when_opened(const std::string& good, const Bad (&table)[N])
{
  for (const Bad& bad : table)
  {
    ASSERT_NE(good.find(bad.what), std::string::npos) << bad.what;
    std::string text = good;
    text.replace(good.find(bad.what), std::string(bad.what).size(), bad.with);
    GridFile file(text);
    EXPECT_EQ(file.frames(), 0u) << bad.said;
    EXPECT_EQ(file.defect(), std::string("memory") + bad.said);
  }
}

template <std::size_t N>
void expect_when_read(const std::string& good, const Bad (&table)[N])
{
  for (const Bad& bad : table)
  {
    ASSERT_NE(good.find(bad.what), std::string::npos) << bad.what;
    std::string text = good;
    text.replace(good.find(bad.what), std::string(bad.what).size(), bad.with);
    GridFile file(text);
    ASSERT_EQ(file.frames(), 1u) << bad.said << "\n" << file.defect();
    EXPECT_EQ(file.error(), std::string("memory") + bad.said);
  }
}
}

TEST(DecompositionBadInput, RectilinearGrids)
{
  expect_when_opened(two_boxes(), bad_grids);
  expect_when_read(two_boxes(), bad_coordinates);
}

TEST(DecompositionBadInput, UnstructuredGrids)
{
  expect_when_opened(two_voxels(counts_and_ranks), bad_voxels);
  expect_when_read(two_voxels(counts_and_ranks), bad_cells);
}

TEST(DecompositionBadInput, OffsetsOfCells)
{
  const std::string good = data_file("good/decomposition/voxels_51.vtk");
  constexpr Bad opened[] = {
    { "CONNECTIVITY vtktypeint64", "CONNECTED vtktypeint64",
      ":18: expected CONNECTIVITY, got 'CONNECTED vtktypeint64'" },
    { "OFFSETS vtktypeint64", "OFFSETS",
      ":16: expected a type of values as word 2, got 'OFFSETS'" },
    { "CELLS 4 24", "CELLS 4 27", ":15: expected eight points in each cell, got 'CELLS 4 27'" },
  };
  expect_when_opened(good, opened);
  constexpr Bad read[] = {
    { "0 8 16 24", "0 8 16 25", ":17: expected OFFSETS that rise from 0 to 24, got others" },
    { "0 8 16 24", "1 8 16 24", ":17: expected OFFSETS that rise from 0 to 24, got others" },
    { "0 8 16 24", "0 16 8 24", ":17: expected OFFSETS that rise from 0 to 24, got others" },
    { "0 8 16 24", "0 8 17 24", ":19: expected eight points in a cell, got 9" },
  };
  expect_when_read(good, read);
}

// Of binary files the byte is named.
TEST(DecompositionBadInput, BinaryFiles)
{
  const std::string good = data_file("good/decomposition/inl_42_binary.vtk");
  const std::size_t counts = good.find("nlocal 1 3 int\n") + 15;
  std::string text = good;
  text[counts + 4] = '\xff';
  EXPECT_EQ(GridFile(text).error(),
    "memory@" + std::to_string(counts + 4) +
      ": expected a number 'nlocal' from 0 to 9223372036854775807, got -16777216");
  const std::size_t cells = good.find("CELLS 3 27\n") + 11;
  text = good;
  text[cells + 4 * 9 + 7] = '\x30';
  EXPECT_EQ(GridFile(text).error(),
    "memory@" + std::to_string(cells + 4 * 9) + ": expected points from 0 to 23 in cell 1, got 48");
  text = replaced(good, "CELL_TYPES 3", "CELL_TYPES 1000000000000000000");
  EXPECT_EQ(GridFile(text).defect(),
    "memory@" + std::to_string(good.find("CELL_TYPES 3") + 31) +
      ": expected 1000000000000000000 numbers, got the end of the file");
}

// One bad grid among good ones: the good ones are shown.
TEST(DecompositionBadInput, ABadGridDoesNotHideTheOthers)
{
  for (const Bad& bad : bad_grids)
  {
    if (std::string(bad.said).find("end of the file") == std::string::npos)
    {
      GridFile file(two_boxes() + replaced(two_boxes(), bad.what, bad.with) + two_boxes());
      // what is no header goes on with the grid before it
      const bool header = std::string(bad.what) != "# vtk DataFile";
      ASSERT_EQ(file.frames(), header ? 2u : 1u) << bad.said;
      EXPECT_EQ(file.read(file.frames() - 1).subdomains, boxes_of_two());
      const std::string said = file.said();
      EXPECT_TRUE(said.ends_with("; the frame is left out\n")) << said;
      EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    }
  }
}

// A run that was killed, and another that goes on in the same file.
TEST(DecompositionBadInput, AHeaderWithinANumber)
{
  const std::string cut = two_boxes();
  for (std::size_t bytes = 1; bytes < cut.size(); ++bytes)
  {
    GridFile file(two_boxes() + cut.substr(0, bytes) + two_boxes());
    SCOPED_TRACE(bytes);
    ASSERT_EQ(file.frames(), 2u);
    EXPECT_EQ(file.read(0).subdomains, boxes_of_two());
    EXPECT_EQ(file.read(1).subdomains, boxes_of_two());
    const std::string said = file.said();
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  }
}

TEST(DecompositionBadInput, OtherFiles)
{
  EXPECT_EQ(GridFile(data_file("good/grains_1000.dump")).defect(),
    "memory:1: expected '# vtk DataFile', got 'ITEM: TIMESTEP'");
  EXPECT_EQ(GridFile("").defect(), "");
  EXPECT_EQ(GridFile(std::string(100'000, '\0')).defect(), "");
  EXPECT_EQ(GridFile(std::string(100'000, 'x')).defect(),
    "memory:1: expected a line of at most 65536 bytes, got a longer one");
}
