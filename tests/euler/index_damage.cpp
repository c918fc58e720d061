// SPDX-License-Identifier: BSD-3-Clause
// Kept indices of Euler cells with any of their numbers changed: see ../support/index_damage.h.
#include "../support/index_damage.h"

#include "granular/euler/euler_file.h"

#include <string>
#include <vector>

namespace
{
std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  const granular::FramePiece piece = index.first_piece(frame);
  granular::Notices notices;
  granular::Progress progress;
  const granular::EulerFrame cells = granular::read_euler(
    *granular::open_indexed(piece.file), piece.entry, [](std::string_view) { return true; },
    notices, progress);
  std::string seen = std::to_string(cells.cells);
  for (const double centre : cells.centres)
  {
    seen += " " + std::to_string(centre);
  }
  for (const granular::EulerValues& array : cells.arrays)
  {
    seen += "\n" + array.name;
    for (const double value : array.values)
    {
      seen += " " + std::to_string(value);
    }
  }
  return seen;
}
}

TEST(EulerIndexDamage, TextAndBinary)
{
  const std::string folder = GRANULAR_OUTPUT;
  for (const char* const name : { "points_42.vtk", "points_51_binary.vtk" })
  {
    index_damage::Run run;
    run.files = { folder + "/" + name };
    index_damage::put(
      run.files[0], index_damage::content(std::string(GRANULAR_DATA) + "/good/euler/" + name));
    run.options.format = &granular::euler_format();
    run.show = shown;
    const index_damage::Outcomes outcomes = index_damage::damage(run);
    EXPECT_EQ(outcomes.silent, "");
    EXPECT_GT(outcomes.told, 0);
  }
}
