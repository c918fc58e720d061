// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/error.h"

#include <gtest/gtest.h>

using granular::to_string;
using granular::Where;

TEST(Error, SaysThePlaceAsFarAsItIsKnown)
{
  EXPECT_EQ(to_string(Where{}), "");
  EXPECT_EQ(to_string(Where{ "a.dump" }), "a.dump");
  EXPECT_EQ(to_string(Where{ "a.dump", 12 }), "a.dump:12");
  EXPECT_EQ(to_string(Where{ "a.bin", 0, 0 }), "a.bin@0");
  EXPECT_EQ(to_string(Where{ "a.bin", 0, 5'000'000'000 }), "a.bin@5000000000");
  EXPECT_EQ(to_string(Where{ "a.dump", 12, -1, "vx" }), "a.dump:12: column 'vx'");
  EXPECT_EQ(to_string(Where{ "", 0, -1, "vx" }), "column 'vx'");
}

TEST(Error, WhatIsPlaceAndText)
{
  EXPECT_STREQ(granular::FormatError("expected a, got b").what(), "expected a, got b");
  const granular::IoError error("cannot open", { "a.dump", 3, -1, "x" });
  EXPECT_STREQ(error.what(), "a.dump:3: column 'x': cannot open");
  EXPECT_EQ(error.where().line, 3);
  EXPECT_EQ(to_string(granular::Notice{ { "a.dump", 7 }, "a text" }), "a.dump:7: a text");
  EXPECT_EQ(to_string(granular::Notice{ {}, "a text" }), "a text");
  const granular::Error broken("got 'a\nb'", { "a.dump", 0, -1, "c\x1b" }); // on one line
  EXPECT_STREQ(broken.what(), "a.dump: column 'c\\x1b': got 'a\\nb'");
  EXPECT_EQ(broken.text(), "got 'a\\nb'");
}

TEST(Error, KindsAreErrors)
{
  EXPECT_THROW(throw granular::IoError("x"), granular::Error);
  EXPECT_THROW(throw granular::FormatError("x"), granular::Error);
  EXPECT_THROW(throw granular::LimitError("x"), granular::Error);
  EXPECT_THROW(throw granular::UnsupportedError("x"), std::runtime_error);
}
