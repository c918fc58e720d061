// SPDX-License-Identifier: BSD-3-Clause
// Files that were cut anywhere, or claim anything: a right grid, or an error, in bounded memory; and the same whether a
// file was indexed at once or while it grew. Other damage is for the fuzz targets.
#include "grid_files.h"

#include "../support/byte_source_packing.h"

#include "granular/formats/decomposition/vtu_grids.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace
{
std::vector<std::string> good_files()
{
  std::vector<std::string> files = { two_boxes() + liggghts_header + two_boxes(),
    two_boxes() + "CELL_DATA 2\nSCALARS nlocal int 1\nLOOKUP_TABLE default\n5\n6\n" + two_boxes(),
    two_voxels(counts_and_ranks), data_file("good/decomposition_1000.vtk") };
  const std::string folder = "good/decomposition/";
  for (const auto& entry : std::filesystem::directory_iterator(GRANULAR_DATA "/" + folder))
  {
    if (entry.file_size() > 0)
    {
      files.push_back(data_file(folder + entry.path().filename().string()));
    }
  }
  EXPECT_GE(files.size(), 20u);
  return files;
}

/// The frames are the first of those of the whole file. Data of processes that come last may be missing.
void expect_beginning(GridFile& cut, GridFile& whole)
{
  ASSERT_LE(cut.frames(), whole.frames());
  for (std::size_t frame = 0; frame < cut.frames(); ++frame)
  {
    ASSERT_EQ(cut.entry(frame).line, whole.entry(frame).line);
    granular::Decomposition expected = whole.read(frame);
    const granular::Decomposition got = cut.read(frame);
    ASSERT_EQ(got.subdomains.size(), expected.subdomains.size());
    for (std::size_t i = 0; i < got.subdomains.size(); ++i)
    {
      expected.subdomains[i].particles *= got.has_particles ? 1 : 0;
      expected.subdomains[i].rank =
        got.has_ranks ? expected.subdomains[i].rank : static_cast<int>(i);
    }
    ASSERT_EQ(got.subdomains, expected.subdomains);
    ASSERT_TRUE(frame + 1 == cut.frames() || got.has_particles == expected.has_particles);
  }
}

/// All grids are right or wrong with an error.
void read_all(GridFile& file)
{
  for (std::size_t frame = 0; frame < file.frames(); ++frame)
  {
    const granular::FrameEntry& entry = file.entry(frame);
    ASSERT_LT(entry.offset, entry.end);
    try
    {
      const granular::Decomposition all = file.read(frame);
      EXPECT_EQ(static_cast<std::int64_t>(all.subdomains.size()), entry.rows);
    }
    catch (const granular::Error& error)
    {
      EXPECT_EQ(error.where().path, "memory");
      EXPECT_TRUE(error.where().line > 0 || error.where().byte >= 0) << error.what();
    }
  }
}
}

TEST(DecompositionDamage, CutAnywhere)
{
  for (const std::string& text : good_files())
  {
    SCOPED_TRACE(text.substr(0, 300));
    GridFile whole(text);
    GridFile grown("");
    for (std::size_t bytes = 0; bytes <= text.size(); ++bytes)
    {
      SCOPED_TRACE(bytes);
      GridFile cut(text.substr(0, bytes));
      grown.grow(text.substr(0, bytes));
      ASSERT_EQ(cut.frames(), grown.frames());
      expect_beginning(cut, whole);
      expect_beginning(grown, whole);
      ASSERT_TRUE(cut.frames() > 0 || bytes == 0 || !cut.defect().empty());
    }
    EXPECT_EQ(grown.frames(), whole.frames());
    EXPECT_EQ(grown.read(0).has_particles, whole.read(0).has_particles);
  }
}

// XML without its middle.
TEST(DecompositionDamage, CutBeforeTheLastTag)
{
  for (const std::string& text : good_files())
  {
    for (std::size_t bytes = 0; granular::is_vtu(text) && bytes < text.size(); ++bytes)
    {
      GridFile file(text.substr(0, bytes) + "</VTKFile>");
      read_all(file);
    }
  }
}

TEST(DecompositionDamage, ClaimsOfAnySize)
{
  const std::int64_t before = restart_peak();
  const std::string files[] = { two_boxes(), two_voxels(counts_and_ranks),
    data_file("good/decomposition/arrays_42.vtk"),
    data_file("good/decomposition/arrays_42_binary.vtk"),
    data_file("good/decomposition/arrays_51.vtk"),
    data_file("good/decomposition/arrays_51_binary.vtk"),
    data_file("good/decomposition/inl_appended.vtu"), data_file("good/decomposition/pieces.vtu") };
  for (const std::string& good : files)
  {
    change_each_count(good,
      [](const std::string& text)
      {
        GridFile file(text);
        read_all(file);
      });
  }
  // each number is there, but not their product
  std::vector<std::string> many(300);
  for (std::size_t i = 0; i < many.size(); ++i)
  {
    many[i] = std::to_string(i);
  }
  GridFile file(rectilinear("300 300 300", many, many, many));
  EXPECT_EQ(file.frames(), 0u);
  EXPECT_EQ(file.defect(), "memory:10: expected at most 16777216 processes, got 26730899");
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 64 } << 20);
}

TEST(DecompositionDamage, Compressed)
{
  for (const std::string& text : good_files())
  {
    GridFile plain(text);
    const std::string packed = packing::gzip(text);
    const auto source = granular::unpack(granular::open_memory(packed));
    granular::FileIndex index;
    granular::Progress progress;
    granular::decomposition_format().index(*source, index, progress, {});
    ASSERT_EQ(index.frames.size(), plain.frames());
    for (std::size_t frame = 0; frame < plain.frames(); ++frame)
    {
      granular::Notices notices;
      EXPECT_EQ(
        granular::read_decomposition(*source, index.frames[frame], notices, progress).subdomains,
        plain.read(frame).subdomains);
    }
  }
  // a claim of which nobody knows how many bytes are there
  for (const std::string& text :
    { replaced(two_boxes(), "X_COORDINATES 3", "X_COORDINATES 1000000000000000000"),
      replaced(
        data_file("good/decomposition/inl_42_binary.vtk"), "POINTS 24", "POINTS 100000000") })
  {
    const std::string packed = packing::gzip(text);
    const auto source = granular::unpack(granular::open_memory(packed));
    granular::FileIndex index;
    granular::Progress progress;
    granular::decomposition_format().index(*source, index, progress, {});
    EXPECT_EQ(index.frames.size(), 0u);
    EXPECT_TRUE(index.defect.has_value());
  }
}
