// SPDX-License-Identifier: BSD-3-Clause
// Kept indices of decompositions: those of many cells are used, those with changed numbers show nothing else. See
// ../support/index_damage.h.
#include "../support/index_damage.h"
#include "grid_files.h"

#include <string>
#include <vector>

namespace
{
std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  const granular::FramePiece piece = index.first_piece(frame);
  granular::Notices notices;
  granular::Progress progress;
  const granular::Decomposition decomposition = granular::read_decomposition(
    *granular::open_indexed(piece.file), piece.entry, notices, progress);
  std::string seen;
  for (const granular::Subdomain& subdomain : decomposition.subdomains)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      seen += " " + std::to_string(subdomain.lo[axis]) + " " + std::to_string(subdomain.hi[axis]);
    }
    seen += " " + std::to_string(subdomain.rank) + "\n";
  }
  return seen;
}

index_damage::Run run_of(const std::string& name, const std::string& bytes)
{
  index_damage::Run run;
  run.files = { std::string(GRANULAR_OUTPUT) + "/" + name };
  index_damage::put(run.files[0], bytes);
  run.options.format = &granular::decomposition_format();
  run.show = shown;
  return run;
}
}

/// 17 numbers an axis of 4096 cells: more cells than bytes.
TEST(DecompositionIndex, ThatHasMoreCellsThanTheFileHasBytesIsUsed)
{
  std::vector<std::string> numbers;
  for (int i = 0; i <= 16; ++i)
  {
    numbers.push_back(std::to_string(i));
  }
  const std::string bytes = rectilinear("17 17 17", numbers, numbers, numbers);
  ASSERT_LT(bytes.size(), 4096U);
  const index_damage::Run run = run_of("cells.vtk", bytes);
  std::filesystem::remove(run.kept());
  granular::Notices notices;
  const std::string first = index_damage::open_and_show(run, notices);
  EXPECT_EQ(index_damage::open_and_show(run, notices), first);
  EXPECT_EQ(notices.size(), 0U);

  granular::RunIndex index;
  granular::Progress progress;
  index.update(run.files, run.options, notices, progress);
  granular::RunIndex elsewhere;
  elsewhere.decode(index.encode());
  EXPECT_EQ(elsewhere.first_piece(0).entry.rows, 4096);
}

TEST(DecompositionIndexDamage, GridsOfAFile)
{
  for (const std::string& bytes :
    { two_boxes(), two_boxes() + two_boxes("0.5") + two_boxes("0.75") })
  {
    const index_damage::Outcomes outcomes = index_damage::damage(run_of("grids.7.vtk", bytes));
    EXPECT_EQ(outcomes.silent, "");
    EXPECT_GT(outcomes.told, 0);
  }
}
