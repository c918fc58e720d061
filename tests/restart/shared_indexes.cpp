// SPDX-License-Identifier: BSD-3-Clause
// Runs of one process that take from each other what they know of restart files, which may be in parts.
#include "granular/frames/shared_indexes.h"
#include "granular/restart/restart_file.h"

#include "../support/own_folder.h"
#include "../support/series.h"
#include "restart_files.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
class RestartSharedIndexes : public OwnFolder
{
protected:
  /// A file that has rested for a while.
  std::string rested(const std::string& name, const std::string& bytes) const
  {
    const std::string path = this->write(name, bytes);
    touch(path, -100);
    return path;
  }

  Series run()
  {
    Series made;
    made.options.format = &granular::restart_format();
    made.options.shared = &indexes;
    return made;
  }

  granular::SharedIndexes indexes;
};
}

TEST_F(RestartSharedIndexes, AFileBesideItJustWritten)
{
  const auto file = small_file();
  const std::string base = this->rested("rbase.restart", file.base());
  this->write("r0.restart", file.part(0));
  this->write("r1.restart", file.part(1));
  Series first = this->run();
  first.update({ base });
  Series second = first;
  second.index = {};
  second.update({ base });
  EXPECT_NE(second.index.files()[0].layout, first.index.files()[0].layout);
  touch(this->path("r0.restart"), -100);
  touch(this->path("r1.restart"), -100);
  first.update({ base });
  second.index = {};
  second.update({ base });
  EXPECT_EQ(second.index.files()[0].layout, first.index.files()[0].layout);
}

TEST_F(RestartSharedIndexes, WhatOtherFilesSayOfAFileStaysWithTheirRun)
{
  const auto file = small_file();
  auto other = small_file();
  other.timestep = 5;
  const std::string cut = file.base().substr(0, file.base().size() / 2);
  const std::string base = this->rested("rbase.restart", cut);
  const std::string part = this->rested("r1.restart", file.part(1));
  const std::string whole = this->rested("s.restart", other.file());
  Series first = this->run();
  first.update({ base, part, whole });
  Series alone;
  alone.options.format = first.options.format;
  alone.update({ part, whole });
  Series second = this->run();
  second.update({ part, whole });
  EXPECT_EQ(second.said, alone.said);
  EXPECT_NE(second.said, "");
  first.update({ part, whole }); // nor does it stay when the files of a run are others
  EXPECT_EQ(first.said, alone.said);
}
