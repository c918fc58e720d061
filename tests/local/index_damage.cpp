// SPDX-License-Identifier: BSD-3-Clause
// Kept indices of local data with any of their numbers changed: see ../support/index_damage.h.
#include "../support/index_damage.h"

#include "../support/frame_content.h"
#include "local_files.h"

#include <string>
#include <vector>

namespace
{
std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  granular::DumpRequest request;
  request.points = false;
  granular::Notices notices;
  granular::Progress progress;
  const FrameContent content =
    content_of(granular::read_dump(index.pieces(frame), request, notices, progress));
  std::string seen = content.head;
  for (const std::string& values : content.values)
  {
    seen += values;
  }
  return seen;
}

void expect_none(const std::vector<std::string>& files)
{
  index_damage::Run run;
  run.files = files;
  run.options.format = &granular::local_format();
  run.show = shown;
  const index_damage::Outcomes outcomes = index_damage::damage(run, 3);
  EXPECT_EQ(outcomes.silent, "");
  EXPECT_GT(outcomes.told, 0);
}
}

TEST(LocalIndexDamage, Frames)
{
  const std::vector<std::string> rows = { "1 2 1 word", "2 3 1.5 other", "3 4 2 word" };
  expect_none({ write_text("a.dump",
    local_frame("id1 id2 c_a words", rows) +
      local_frame("id1 id2 c_a words", { "7 9 4 more" }, "", "ENTRIES", 5)) });
}

TEST(LocalIndexDamage, FilesOfProcesses)
{
  expect_none({ write_text("a.0.dump", local_frame("id1 id2 btype", { "1 2 1" }, "", "BONDS", 5)),
    write_text("a.1.dump", "3 4 1 \n5 67 1 \n") });
}
