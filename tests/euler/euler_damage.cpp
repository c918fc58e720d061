// SPDX-License-Identifier: BSD-3-Clause
// Files that were cut anywhere, or claim anything: the right cells, or an error, in bounded memory; and the same whether a
// file was indexed at once or while it grew. Other damage is for the fuzz targets.
#include "euler_files.h"

#include "granular/formats/euler/regular_grids.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace
{
std::vector<std::string> good_files()
{
  std::vector<std::string> files = { two_points(), two_points(true), two_boxes(), two_hexahedra(),
    no_points() };
  for (const auto& entry : std::filesystem::directory_iterator(GRANULAR_DATA "/good/euler"))
  {
    if (entry.file_size() < 1000)
    {
      files.push_back(data_file("good/euler/" + entry.path().filename().string()));
    }
  }
  EXPECT_EQ(files.size(), 21u);
  return files;
}

/// The cells are right, or wrong with an error; and nobody stumbles over them.
void read_all(EulerFile& file)
{
  for (std::size_t frame = 0; frame < file.frames(); ++frame)
  {
    const granular::FrameEntry& entry = file.entry(frame);
    ASSERT_LT(entry.offset, entry.end);
    granular::EulerFrame cells;
    try
    {
      cells = file.read(frame);
    }
    catch (const granular::Error& error)
    {
      EXPECT_EQ(error.where().path, "memory");
      EXPECT_TRUE(error.where().line > 0 || error.where().byte >= 0) << error.what();
      continue;
    }
    EXPECT_EQ(cells.cells, entry.rows);
    EXPECT_EQ(static_cast<std::int64_t>(cells.centres.size()), 3 * cells.cells);
    for (const granular::EulerValues& array : cells.arrays)
    {
      EXPECT_EQ(static_cast<std::int64_t>(array.values.size()), array.components * cells.cells);
    }
    error_of(
      [&]
      {
        granular::Notices notices;
        granular::find_regular_grids(cells, notices);
      });
  }
}
}

// At work LIGGGHTS has written the first bytes. Only the arrays of PFM may be missing behind those of LIGGGHTS.
TEST(EulerDamage, CutAnywhere)
{
  for (const std::string& text : good_files())
  {
    SCOPED_TRACE(text.substr(0, 300));
    EulerFile whole(text);
    const granular::EulerCells expected = cells_of(whole.read());
    EulerFile grown("");
    for (std::size_t bytes = 0; bytes <= text.size(); ++bytes)
    {
      SCOPED_TRACE(bytes);
      EulerFile cut(text.substr(0, bytes));
      grown.grow(text.substr(0, bytes));
      ASSERT_EQ(cut.frames(), grown.frames());
      ASSERT_EQ(cut.said() + grown.said(), "");
      ASSERT_TRUE(cut.frames() > 0 || bytes == 0 || !cut.defect().empty());
      for (EulerFile* file : { &cut, &grown })
      {
        if (file->frames() == 0)
        {
          continue;
        }
        granular::EulerCells got = cells_of(file->read());
        for (const granular::EulerArray& array : granular::euler_arrays())
        {
          const bool may_miss = array.optional || text.find("vtk output") != std::string::npos;
          if ((got.*array.values).empty() && may_miss)
          {
            got.*array.values = expected.*array.values;
          }
        }
        ASSERT_EQ(got, expected);
      }
    }
    EXPECT_EQ(cells_of(grown.read()), expected);
  }
}

TEST(EulerDamage, ClaimsOfAnySize)
{
  const std::int64_t before = restart_peak();
  for (const std::string& good : good_files())
  {
    change_each_count(good,
      [](const std::string& text)
      {
        EulerFile file(text);
        read_all(file);
      });
  }
  // each coordinate is there, but not the cells between them
  std::string many;
  for (int i = 0; i < 300; ++i)
  {
    many += std::to_string(i) + " ";
  }
  std::string text = euler_header + "DATASET RECTILINEAR_GRID\nDIMENSIONS 300 300 300\n";
  for (const char* axis : { "X", "Y", "Z" })
  {
    text += std::string(axis) + "_COORDINATES 300 float\n" + many + "\n";
  }
  EulerFile none(text);
  EXPECT_EQ(none.defect(), "memory:12: expected an array 'v_avg', got the end of the file");
  EulerFile some(text + "CELL_DATA 26730899\nVECTORS v_avg float\n1 2 3\n");
  EXPECT_EQ(some.defect(), "memory:14: expected 80192697 numbers, got the end of the file");
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 64 } << 20);
}
