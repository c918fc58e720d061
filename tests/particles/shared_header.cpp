// SPDX-License-Identifier: BSD-3-Clause
// What a rank without rows learns of a frame from the others.
#include "granular/particles/frame_view.h"

#include "../support/error_of.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <string>

using namespace granular;

namespace
{
FrameView known_view(double hi)
{
  FrameView frame;
  frame.rows = 1;
  frame.header.timestep = 7;
  frame.header.box = Box::from_bounds({ 0, 0, 0 }, { hi, 1, 1 });
  frame.header.box.boundary = "pp pp ff";
  frame.coordinates = Coordinates::Unwrapped;
  frame.point_origin = { 1, 2, 3 };
  return frame;
}

FrameView empty_view()
{
  FrameView frame;
  frame.has_box = false;
  return frame;
}
}

TEST(SharedHeader, WhoHasNoRowsLearnsAll)
{
  run_ranks(3,
    [](Communicator& ranks)
    {
      FrameView frame = ranks.rank() == 1 ? known_view(4) : empty_view();
      share_header(frame, ranks);
      EXPECT_TRUE(frame.has_box);
      EXPECT_EQ(frame.rows, ranks.rank() == 1 ? 1 : 0);
      EXPECT_EQ(frame.header.timestep, 7);
      EXPECT_EQ(frame.header.box.bounds().hi[0], 4);
      EXPECT_EQ(frame.header.box.boundary, "pp pp ff");
      EXPECT_EQ(frame.coordinates, Coordinates::Unwrapped);
      EXPECT_EQ(frame.point_origin, (Vector3{ 1, 2, 3 }));
    });
}

TEST(SharedHeader, WithoutAnyRowsTheFirstBoxCounts)
{
  run_ranks(2,
    [](Communicator& ranks)
    {
      FrameView frame = ranks.rank() == 1 ? known_view(4) : empty_view();
      frame.rows = 0;
      share_header(frame, ranks);
      EXPECT_TRUE(frame.has_box);
    });
}

TEST(SharedHeader, OtherBoxesAreAnErrorOfAll)
{
  run_ranks(3,
    [](Communicator& ranks)
    {
      FrameView frame = ranks.rank() == 0 ? empty_view() : known_view(3 + ranks.rank());
      const std::string error = error_of([&] { share_header(frame, ranks); });
      EXPECT_NE(error.find("on process 2"), std::string::npos) << error;
    });
}
