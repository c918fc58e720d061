// SPDX-License-Identifier: BSD-3-Clause
// Kept indices of restart files with any of their numbers changed: see ../support/index_damage.h.
#include "../support/index_damage.h"

#include "granular/restart/restart_file.h"
#include "granular/restart/restart_reader.h"

#include <string>
#include <vector>

namespace
{
std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  const auto source = granular::open_indexed(index.first_piece(frame).file);
  granular::Notices notices;
  granular::Progress progress;
  const granular::RestartLayout layout = granular::read_layout(*source, notices, progress);
  const granular::DumpFrame particles =
    granular::read_restart(*source, layout, {}, notices, progress).particles;
  return { static_cast<const char*>(particles.points.data()), particles.points.bytes() };
}

void expect_none(const std::vector<std::string>& names, std::size_t step)
{
  const std::string folder = GRANULAR_OUTPUT;
  for (const std::string& name : names)
  {
    index_damage::put(folder + "/" + name,
      index_damage::content(std::string(GRANULAR_DATA) + "/good/restart/" + name));
  }
  index_damage::Run run;
  run.files = { folder + "/" + names.front() };
  run.options.format = &granular::restart_format();
  run.show = shown;
  const index_damage::Outcomes outcomes = index_damage::damage(run, step);
  EXPECT_EQ(outcomes.silent, "");
  EXPECT_GT(outcomes.told, 0);
}
}

TEST(RestartIndexDamage, OneFile)
{
  expect_none({ "style_sphere.restart" }, 3);
}

TEST(RestartIndexDamage, FilesOfProcesses)
{
  expect_none({ "parts.base.restart", "parts.0.restart", "parts.1.restart", "parts.2.restart" }, 7);
}
