// SPDX-License-Identifier: BSD-3-Clause
// The timestep of a file that does not say it, from its name.
#include "granular/frames/named_steps.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

using namespace granular;

namespace
{
struct File
{
  std::string path;
  std::size_t frames = 1;
  std::uint64_t shape = 0;
};

/// The timesteps of the first frames of the files; -1 where there is none.
std::vector<std::int64_t> steps_of(const std::vector<File>& files, Notices* told = nullptr)
{
  std::vector<FileIndex> index(files.size());
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    index[i].path = files[i].path;
    FrameEntry frame;
    frame.shape = files[i].shape;
    index[i].frames.assign(files[i].frames, frame);
  }
  Notices notices;
  name_steps(index, told ? *told : notices);
  EXPECT_TRUE(notices.empty());
  std::vector<std::int64_t> steps;
  for (const FileIndex& file : index)
  {
    steps.push_back(file.frames.empty() ? -1 : file.frames.front().timestep);
  }
  return steps;
}

using Steps = std::vector<std::int64_t>;
}

TEST(NamedSteps, TheLastNumberOfTheName)
{
  EXPECT_EQ(steps_of({ { "post/decomposition_1000.vtk" }, { "post/decomposition_2000.vtk" } }),
    (Steps{ 1000, 2000 }));
  EXPECT_EQ(
    steps_of({ { "run2_decomposition_0.vtk" }, { "run2_decomposition_1.vtk" } }), (Steps{ 0, 1 }));
  EXPECT_EQ(steps_of({ { "a_007.vtk.gz" } }), (Steps{ 7 }));
  // what is the same in all names tells no steps apart
  EXPECT_EQ(steps_of({ { "dec_1000.run2.vtk" }, { "dec_3000.run2.vtk" } }), (Steps{ 1000, 3000 }));
  EXPECT_EQ(steps_of({ { "2000/a_10_.vtu" } }), (Steps{ 10 }));
  EXPECT_EQ(steps_of({ { "decomposition.vtk" } }), (Steps{ 0 }));
  EXPECT_EQ(steps_of({ { "a_9223372036854775807.vtk" }, { "a_3.vtk" } }),
    (Steps{ 9223372036854775807, 3 }));
  EXPECT_EQ(steps_of({ { "a_5_99999999999999999999.vtk" } }), (Steps{ 5 }));
}

TEST(NamedSteps, FramesOfOneFileAreCounted)
{
  EXPECT_EQ(steps_of({ { "decomposition_1000.vtk", 3 } }), (Steps{ 0 }));
  Notices notices;
  EXPECT_EQ(steps_of({ { "a.vtk", 2 }, { "b.vtk" } }, &notices), (Steps{ 0, 0 }));
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].where.path, "a.vtk");
}

TEST(NamedSteps, ANumberThatCountsPiecesIsNone)
{
  // several steps
  EXPECT_EQ(
    steps_of({ { "a_1000.0.vtk" }, { "a_1000.1.vtk" }, { "a_2000.0.vtk" }, { "a_2000.1.vtk" } }),
    (Steps{ 1000, 1000, 2000, 2000 }));
  EXPECT_EQ(
    steps_of({ { "a.0.1000.vtk" }, { "a.1.1000.vtk" }, { "a.0.2000.vtk" }, { "a.1.2000.vtk" } }),
    (Steps{ 1000, 1000, 2000, 2000 }));
  // one step: what is in the files tells
  EXPECT_EQ(
    steps_of({ { "a_1000.0.vtk", 1, 7 }, { "a_1000.1.vtk", 1, 7 } }), (Steps{ 1000, 1000 }));
  EXPECT_EQ(steps_of({ { "a_1000.0.vtk" }, { "a_1000.1.vtk", 0 }, { "a_1000.2.vtk", 0 } }),
    (Steps{ 1000, -1, -1 }));
  EXPECT_EQ(steps_of({ { "a_1000.0.vtk" }, { "a_1000.1.vtk" } }), (Steps{ 0, 1 }));
  // a single number, one frame
  EXPECT_EQ(steps_of({ { "pfm_0.vtk", 1, 7 }, { "pfm_1.vtk", 1, 7 } }), (Steps{ 0, 0 }));
  EXPECT_EQ(steps_of({ { "dec_0.vtk" }, { "dec_1.vtk" } }), (Steps{ 0, 1 }));
  // not from 0, or with a gap
  EXPECT_EQ(steps_of({ { "a_1000.1.vtk", 1, 7 }, { "a_1000.2.vtk", 1, 7 } }), (Steps{ 1, 2 }));
  EXPECT_EQ(steps_of({ { "a_1000.0.vtk", 1, 7 }, { "a_1000.2.vtk", 1, 7 } }), (Steps{ 0, 2 }));
}
