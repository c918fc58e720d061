// SPDX-License-Identifier: BSD-3-Clause
// Files of dump decomposition/vtk, as LIGGGHTS and VTK write them, and as they grow.
#include "grid_files.h"

#include "../support/counting_source.h"
#include "../support/stop.h"

#include "granular/formats/decomposition/vtu_grids.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

using granular::Subdomain;

namespace
{
std::string reflected(const std::string& place, int cells)
{
  return place + ": corners of " + std::to_string(cells) +
    " voxels are in the order of LIGGGHTS-INL, x and z exchanged: they were put right\n";
}

std::string path_of(const std::string& file)
{
  return std::string(GRANULAR_DATA) + "/good/" + file;
}
}

TEST(DecompositionFile, OfLiggghts)
{
  GridFile file(data_file("good/decomposition_1000.vtk"));
  ASSERT_EQ(file.frames(), 1u);
  EXPECT_EQ(file.entry().rows, 4);
  EXPECT_EQ(file.entry().timestep, 0);
  EXPECT_EQ(file.entry().line, 1);
  EXPECT_EQ(file.entry().end, 248);
  EXPECT_EQ(file.entry().shape, 0u);
  EXPECT_NE(file.entry().time, file.entry().time);
  const granular::Decomposition all = file.read();
  EXPECT_FALSE(all.has_particles);
  EXPECT_FALSE(all.has_ranks);
  // 2 x 1 x 2, x fastest
  const std::vector<Subdomain> expected = { { { -0.05, -0.05, 0 }, { 0, 0.05, 0.075 }, 0, 0 },
    { { 0, -0.05, 0 }, { 0.05, 0.05, 0.075 }, 0, 1 },
    { { -0.05, -0.05, 0.075 }, { 0, 0.05, 0.15 }, 0, 2 },
    { { 0, -0.05, 0.075 }, { 0.05, 0.05, 0.15 }, 0, 3 } };
  EXPECT_EQ(all.subdomains, expected);
  EXPECT_EQ(file.said() + file.told() + file.defect(), "");
}

TEST(DecompositionFile, WrittenByVtk)
{
  for (const std::string version : { "_42", "_51" })
  {
    for (const std::string form : { "", "_binary" })
    {
      const std::string end = version + form + ".vtk";
      SCOPED_TRACE(end);
      for (const std::string name : { "inl", "arrays" })
      {
        GridFile file(data_file("good/decomposition/" + name + end));
        ASSERT_EQ(file.frames(), 1u);
        EXPECT_EQ(file.entry().rows, 3);
        const granular::Decomposition all = file.read();
        EXPECT_TRUE(all.has_particles && all.has_ranks);
        EXPECT_EQ(all.subdomains, boxes_of_three(2147483647, { 0, 1, 2 }));
        EXPECT_EQ(file.told(), reflected(form.empty() ? "memory:1" : "memory@0", 3));
      }
      for (const std::string name : { "voxels", "hexahedra" })
      {
        GridFile file(data_file("good/decomposition/" + name + end));
        ASSERT_EQ(file.frames(), 1u);
        EXPECT_EQ(file.entry().rows, 3);
        EXPECT_EQ(file.entry().line, form.empty() ? 1 : 0);
        const granular::Decomposition all = file.read();
        EXPECT_TRUE(all.has_particles && all.has_ranks);
        EXPECT_EQ(all.subdomains, boxes_of_three(std::int64_t{ 1 } << 40, { 2, 0, 1 }));
        EXPECT_EQ(file.told(), "");
      }
    }
  }
}

TEST(DecompositionFile, XmlIsAFrameOfItsOwn)
{
  for (const std::string name : { "inl.vtu", "inl_appended.vtu" })
  {
    const std::string text = data_file("good/decomposition/" + name);
    EXPECT_TRUE(granular::is_vtu(text.substr(0, 200)));
    GridFile file(text);
    ASSERT_EQ(file.frames(), 1u);
    EXPECT_EQ(file.entry().rows, 3);
    EXPECT_EQ(file.entry().offset, 0);
    EXPECT_EQ(file.entry().end, static_cast<std::int64_t>(text.size()));
    EXPECT_EQ(file.read().subdomains, boxes_of_three(2147483647, { 0, 1, 2 }));
    EXPECT_EQ(file.told(), reflected("memory:1", 3));
    GridFile cut(text.substr(0, text.size() - 3));
    EXPECT_EQ(cut.frames(), 0u);
    EXPECT_EQ(cut.defect(), "memory: expected </VTKFile> at the end of the file, got none");
    cut.grow(text);
    EXPECT_EQ(cut.frames(), 1u);
    cut.grow(text + "\n\n");
    EXPECT_EQ(cut.frames(), 1u);
    EXPECT_EQ(cut.index().resume_offset, static_cast<std::int64_t>(text.size() + 2));
  }
  EXPECT_FALSE(granular::is_vtu("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n"));
  EXPECT_FALSE(granular::is_vtu("<html><VTKFile type=\"UnstructuredGrid\">"));
  EXPECT_FALSE(granular::is_vtu(liggghts_header));
  EXPECT_FALSE(granular::is_vtu(""));
}

TEST(DecompositionFile, SeveralGridsInOne)
{
  const std::string one = two_boxes("0.000000");
  GridFile file(one + two_boxes() + two_boxes("0.500000"));
  ASSERT_EQ(file.frames(), 3u);
  for (std::size_t frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(file.entry(frame).timestep, static_cast<std::int64_t>(frame));
    EXPECT_EQ(file.entry(frame).offset, static_cast<std::int64_t>(frame * one.size()));
    EXPECT_EQ(file.entry(frame).line, static_cast<std::int64_t>(11 * frame + 1));
    EXPECT_EQ(file.read(frame).subdomains, boxes_of_two(0.25 * static_cast<double>(frame)));
  }
  EXPECT_EQ(file.said(), "");
}

// A timestep that is dumped twice has a header, but no grid.
TEST(DecompositionFile, HeadersWithoutAGrid)
{
  GridFile file(liggghts_header + two_boxes() + liggghts_header + liggghts_header + two_boxes() +
    liggghts_header);
  ASSERT_EQ(file.frames(), 2u);
  const std::string said =
    ": expected DATASET RECTILINEAR_GRID or UNSTRUCTURED_GRID, got another header: LIGGGHTS "
    "writes a header without a grid where a timestep is dumped again; the frame is left out\n";
  EXPECT_EQ(file.said(), "memory:4" + said + "memory:18" + said + "memory:21" + said);
  EXPECT_EQ(file.read(1).subdomains, boxes_of_two());
  EXPECT_EQ(file.entry(1).line, 21);
  GridFile alone(liggghts_header);
  EXPECT_EQ(alone.frames(), 0u);
  EXPECT_EQ(alone.said(), "");
  EXPECT_EQ(alone.defect(),
    "memory:4: expected DATASET RECTILINEAR_GRID or UNSTRUCTURED_GRID, got the end of the file: "
    "LIGGGHTS writes a header without a grid where a timestep is dumped again");
}

// PFM, '%' in the name: DIMENSIONS of the whole grid, coordinates of one process.
TEST(DecompositionFile, PiecesOfProcesses)
{
  const auto piece = [](const char* dimensions) {
    return rectilinear(dimensions, { "0.000000", "1.000000" }, { "0", "1" }, { "2", "3" });
  };
  GridFile file(piece("3 2 2"));
  EXPECT_EQ(file.entry().rows, 1);
  EXPECT_EQ(file.read().subdomains, (std::vector<Subdomain>{ { { 0, 0, 2 }, { 1, 1, 3 } } }));
  EXPECT_NE(file.entry().shape, 0u);
  EXPECT_EQ(file.entry().shape, GridFile(piece("3 2 2")).entry().shape);
  EXPECT_NE(file.entry().shape, GridFile(piece("2 3 2")).entry().shape);
  EXPECT_EQ(GridFile(piece("2 2 2")).entry().shape, 0u);
  EXPECT_EQ(GridFile(piece("1 1 1")).entry().shape, 0u);
}

TEST(DecompositionFile, DataOfARectilinearGrid)
{
  GridFile file(two_boxes() +
    "CELL_DATA 2\nSCALARS nlocal int 1\nLOOKUP_TABLE default\n5\n6\nSCALARS other float\n"
    "LOOKUP_TABLE default\nnan 1e-300\nFIELD more 1\nproc 1 2 int\n1 0\n" +
    two_boxes());
  ASSERT_EQ(file.frames(), 2u);
  std::vector<Subdomain> expected = boxes_of_two();
  expected[0].particles = 5;
  expected[0].rank = 1;
  expected[1].particles = 6;
  expected[1].rank = 0;
  EXPECT_EQ(file.read(0).subdomains, expected);
  EXPECT_EQ(file.read(1).subdomains, boxes_of_two());
}

TEST(DecompositionFile, ArraysThatAreThere)
{
  GridFile none(two_voxels(""));
  EXPECT_FALSE(none.read().has_particles || none.read().has_ranks);
  EXPECT_EQ(none.read().subdomains, boxes_of_two());
  GridFile counts(two_voxels("SCALARS nlocal unsigned_char\nLOOKUP_TABLE default\n3 4\n"));
  EXPECT_TRUE(counts.read().has_particles);
  EXPECT_FALSE(counts.read().has_ranks);
  EXPECT_EQ(counts.read().subdomains[1].particles, 4);
  EXPECT_EQ(counts.read().subdomains[1].rank, 1);
  GridFile ranks(two_voxels("FIELD a 1\nproc 1 2 vtkIdType\n6 5\n"));
  EXPECT_FALSE(ranks.read().has_particles);
  EXPECT_EQ(ranks.read().subdomains[0].rank, 6);
  // whole numbers, of whatever type
  GridFile floats(two_voxels("SCALARS nlocal double 1\nLOOKUP_TABLE default\n3e2 4.0\n"));
  EXPECT_EQ(floats.read().subdomains[0].particles, 300);
  // proc is the usual name, whichever comes first
  for (const bool first : { true, false })
  {
    const std::string proc = "proc 1 2 int\n1 0\n";
    const std::string other = "procID 1 2 int\n8 9\n";
    GridFile both(two_voxels("FIELD a 2\n" + (first ? proc + other : other + proc)));
    EXPECT_EQ(both.read().subdomains[0].rank, 1);
  }
  GridFile points(two_voxels("") +
    "POINT_DATA 16\nSCALARS nlocal int\nLOOKUP_TABLE d\n"
    "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  EXPECT_FALSE(points.read().has_particles);
}

TEST(DecompositionFile, FlatCellsAndEndlessOnes)
{
  GridFile grid(rectilinear("3 2 2", { "1", "1", "1" }, { "0", "-0.0" }, { "-inf", "inf" }));
  EXPECT_EQ(grid.read().subdomains[1].lo[0], 1);
  EXPECT_EQ(grid.read().subdomains[1].hi[0], 1);
  EXPECT_EQ(grid.read().subdomains[1].hi[2], std::numeric_limits<double>::infinity());
  std::string points;
  for (int i = 0; i < 16; ++i)
  {
    points += i < 8 ? "1e9 2 3 " : i % 2 == 0 ? "0 0 0 " : "0 0 1 ";
  }
  const std::string all = two_voxels("");
  GridFile voxels(
    all.substr(0, all.find("-0.5 0")) + points + "\n" + all.substr(all.find("CELLS")));
  const std::vector<Subdomain> expected = { { { 1e9, 2, 3 }, { 1e9, 2, 3 }, 0, 0 },
    { { 0, 0, 0 }, { 0, 0, 1 }, 0, 1 } };
  EXPECT_EQ(voxels.read().subdomains, expected);
}

// Who reads says what becomes of them.
TEST(DecompositionFile, OddBoundsAreHandedOn)
{
  using granular::Answer;
  const std::string bounds =
    "expected finite bounds, lower ones not above upper ones, got 1 subdomain without: process ";
  const std::string inverted = bounds + "1 from 2.5 0 -1 to 1 2 0";
  const std::pair<std::string, std::string> files[] = {
    { two_boxes("2.5"), inverted },
    { replaced(two_voxels(""), "0.25 ", "2.5 "), inverted },
    { replaced(two_boxes(), "-0.500000", "nan"), bounds + "0 from nan 0 -1 to 0.25 2 0" },
    { replaced(two_voxels(""), "-0.5 ", "nan "), bounds + "0 from nan 0 -1 to 0.25 2 0" },
    { replaced(two_boxes(), " 1.000000", " inf"), bounds + "1 from 0.25 0 -1 to inf 2 0" },
  };
  for (const auto& [text, said] : files)
  {
    GridFile file(text);
    ASSERT_EQ(file.frames(), 1u) << file.defect();
    const std::vector<Subdomain> subdomains = file.read().subdomains;
    ASSERT_EQ(subdomains.size(), 2u);
    const granular::Where where = { "run.vtk", 7 };
    granular::Progress progress;
    granular::Notices notices;
    EXPECT_EQ(error_of([&] { check_subdomains(subdomains, {}, where, notices, progress); }),
      "run.vtk:7: " + said);
  }
}

TEST(DecompositionFile, TextInAnyForm)
{
  const std::string good = two_voxels(counts_and_ranks);
  std::vector<Subdomain> expected = boxes_of_two();
  expected[0].particles = 7;
  expected[1].particles = 30;
  const std::string forms[] = { replaced(good, "\n", "\r\n"), replaced(good, " ", " \t "),
    "\xef\xbb\xbf" + good, "\n \n" + good, replaced(good, "int", "InT"),
    replaced(replaced(good, "CELL", "cell"), "POINTS", "points"),
    replaced(good, "Version 4.2", "Version 1.0"), replaced(good, "0.25", "+2.5E-01"),
    replaced(good, "0.25", "0.25\n"), good + "\n\n  ", good + std::string(5000, '\0') };
  for (const std::string& text : forms)
  {
    GridFile file(replaced(text, "# \t vtk \t DataFile", "# vtk DataFile"));
    ASSERT_EQ(file.frames(), 1u) << text << file.defect();
    EXPECT_EQ(file.read().subdomains, expected) << text;
  }
}

// ---- growing files -----------------------------------------------------------------------------------

TEST(DecompositionFile, DataComeLater)
{
  GridFile file(two_voxels(""));
  EXPECT_FALSE(file.read().has_particles);
  file.grow(two_voxels("FIELD FieldData 2\nnlocal 1 2 int\n7 30 \n"));
  EXPECT_EQ(file.frames(), 0u);
  file.grow(two_voxels(counts_and_ranks));
  ASSERT_EQ(file.frames(), 1u);
  EXPECT_TRUE(file.read().has_particles && file.read().has_ranks);
}

TEST(DecompositionFile, UnstructuredGridsAreAlone)
{
  GridFile file(two_voxels(counts_and_ranks) + two_boxes());
  EXPECT_EQ(file.frames(), 1u);
  EXPECT_EQ(file.said(),
    "memory:27: expected the end of the file behind an unstructured grid, got another header; "
    "what follows is left out\n");
}

TEST(DecompositionFile, ChangedSinceItWasIndexed)
{
  const std::string text = two_boxes();
  granular::FrameEntry entry = GridFile(text).entry();
  entry.rows = 3;
  const auto source = granular::open_memory(text);
  granular::Notices notices;
  granular::Progress progress;
  EXPECT_EQ(error_of([&] { granular::read_decomposition(*source, entry, notices, progress); }),
    "memory:1: the file changed since it was indexed: expected 3 cells, got 2; reload the files");
}

TEST(DecompositionFile, ReportsAndCanBeCancelled)
{
  Stop stop(Stop::never, 0.5);
  std::string text = two_boxes();
  text.insert(text.find("Z_COORD"), std::string(std::size_t{ 1 } << 27, ' '));
  const auto source = granular::open_memory(text);
  granular::FileIndex index;
  EXPECT_THROW(
    granular::decomposition_format().index(*source, index, stop, {}), granular::Cancelled);
  EXPECT_GE(stop.reports, 64); // each MiB
  EXPECT_NEAR(stop.last, 0.5, 0.01);
  // short headers, none of which reaches so far
  text.clear();
  for (int i = 0; i < 2500; ++i)
  {
    text += "# vtk DataFile\n";
  }
  Stop all;
  const auto headers = granular::open_memory(text);
  index = {};
  granular::decomposition_format().index(*headers, index, all, {});
  EXPECT_EQ(all.reports, 2);
  EXPECT_NEAR(all.last, 0.8, 0.001);
}

/// Of a file that is made of headers no more than some are named, and none is read from the file again.
TEST(DecompositionFile, HeadersWithoutEnd)
{
  for (const std::string header : { "# vtk DataFile", "# vtk DataFile Version 2.0\n" })
  {
    std::string text;
    for (int i = 0; i < 40000; ++i)
    {
      text += header;
    }
    const std::string bytes = text + two_boxes();
    const CountingSource source(bytes);
    granular::FileIndex index;
    granular::Progress progress;
    granular::decomposition_format().index(source, index, progress, {});
    EXPECT_EQ(index.frames.size(), 1u);
    ASSERT_EQ(index.notices.size(), 101u);

    EXPECT_EQ(to_string(index.notices[100]), "memory: and 39900 more frames are left out");
    EXPECT_LT(source.bytes_read(), 2 * static_cast<std::int64_t>(text.size()));
  }
}

// ---- which files are decompositions ------------------------------------------------------------------

TEST(DecompositionFile, IsTold)
{
  const Folder folder;
  const auto is_one = [&](const std::string& text)
  { return granular::is_decomposition_file(folder.write("a.vtk", text)); };
  for (const auto& entry : std::filesystem::directory_iterator(path_of("decomposition")))
  {
    const bool empty = entry.file_size() == 0; // of a process that leaves writing to another
    EXPECT_EQ(granular::is_decomposition_file(entry.path().string()), !empty) << entry.path();
  }
  EXPECT_TRUE(granular::is_decomposition_file(path_of("decomposition_1000.vtk")));
  EXPECT_TRUE(is_one(two_boxes() + two_boxes()));
  EXPECT_TRUE(is_one(liggghts_header));
  EXPECT_TRUE(is_one(liggghts_header + two_boxes()));
  EXPECT_TRUE(is_one(two_boxes().substr(0, 170)));
  EXPECT_TRUE(is_one(two_voxels(counts_and_ranks)));
  EXPECT_TRUE(is_one(two_voxels("SCALARS nlocal int\nLOOKUP_TABLE default\n1 2\n")));

  EXPECT_FALSE(is_one(two_voxels("")));
  EXPECT_FALSE(is_one(two_voxels("SCALARS Nlocal int\nLOOKUP_TABLE default\n1 2\n")));
  EXPECT_FALSE(is_one(two_voxels("") +
    "POINT_DATA 16\nSCALARS nlocal int\nLOOKUP_TABLE d\n"
    "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"));
  // nlocal of cells that are no boxes
  const std::string voxels = two_voxels(counts_and_ranks);
  EXPECT_FALSE(is_one(replaced(voxels, "6 7 \n", "7 6 \n")));
  EXPECT_FALSE(is_one(replaced(voxels, "-0.5 2 0 ", "-0.5 2 0.5 ")));
  EXPECT_FALSE(is_one(replaced(voxels, "11\n11", "11\n10")));
  EXPECT_FALSE(is_one(replaced(two_boxes(), "mesh/gran/VTK", "mesh/VTK")));
  EXPECT_FALSE(is_one(two_boxes() + "CELL_DATA 2\nSCALARS p int\nLOOKUP_TABLE d\n1 2\n"));
  EXPECT_FALSE(is_one(replaced(two_boxes(), "X_COORDINATES 3", "X_COORDINATES x")));
  EXPECT_FALSE(is_one(replaced(two_boxes(), "RECTILINEAR_GRID", "POLYDATA")));
  EXPECT_FALSE(is_one(data_file("good/grains_1000.dump")));
  EXPECT_FALSE(is_one(data_file("good/grains.bin")));
  const std::string xml = data_file("good/decomposition/inl.vtu");
  EXPECT_TRUE(is_one(xml));
  EXPECT_FALSE(is_one(replaced(xml, "nlocal", "Nlocal")));
  EXPECT_FALSE(is_one(replaced(xml, "CellData", "PointData")));
  EXPECT_FALSE(is_one(""));
  EXPECT_FALSE(granular::is_decomposition_file(folder.path("missing.vtk")));
  EXPECT_FALSE(granular::is_decomposition_file(folder.path("")));
}
