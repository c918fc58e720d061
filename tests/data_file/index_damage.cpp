// SPDX-License-Identifier: BSD-3-Clause
// Kept indices of data files with any of their numbers changed: see ../support/index_damage.h.
#include "../support/index_damage.h"

#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"

#include <string>

namespace
{
std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  granular::SerialCommunicator alone;
  granular::Notices notices;
  granular::Progress progress;
  const granular::DumpFrame particles =
    granular::read_data(index.first_piece(frame), {}, alone, notices, progress).particles;
  return { static_cast<const char*>(particles.points.data()), particles.points.bytes() };
}
}

TEST(DataFileIndexDamage, OneFile)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/sphere.data";
  index_damage::put(
    path, index_damage::content(std::string(GRANULAR_DATA) + "/good/data_file/sphere.data"));
  index_damage::Run run;
  run.files = { path };
  run.options.format = &granular::data_file_format();
  run.show = shown;
  const index_damage::Outcomes outcomes = index_damage::damage(run, 3);
  EXPECT_EQ(outcomes.silent, "");
  EXPECT_GT(outcomes.told, 0);
}
