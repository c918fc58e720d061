// SPDX-License-Identifier: BSD-3-Clause
// What is said of the files of tests/data/bad, to the letter: this is what a user sees.
#include "../support/dumps.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace
{
struct Bad
{
  const char* file;
  const char* said; ///< behind the path
};

// Found when the file is opened.
constexpr Bad when_opened[] = {
  { "empty.dump",
    ": expected a dump, got an empty file: its program has written nothing to it yet" },
  { "garbage.dump",
    ": expected a dump, got a thermo table: vtkgranular.read_log reads it in Python" },
  { "no_header.dump",
    ":1: expected ITEM: TIMESTEP, UNITS or TIME, or ColumnNames for rows without headers, got '1 1 "
    "0.1 "
    "0.2 0.3'" },
  { "local.dump", ":3: expected ITEM: NUMBER OF ATOMS, got 'ITEM: NUMBER OF ENTRIES'" },
  { "no_timestep.dump", ":9: expected ITEM: TIMESTEP before ITEM: ATOMS, got none" },
  { "no_number.dump", ":7: expected ITEM: NUMBER OF ATOMS before ITEM: ATOMS, got none" },
  { "no_columns.dump", ":9: expected an ITEM: line, got '1 1 0.1 0.2 0.3'" },
  { "timestep_fraction.dump",
    ":2: expected an integer timestep, and a time under ITEM: TIME, got '0.5'" },
  { "timestep_missing.dump", ":2: expected a value, got 'ITEM: NUMBER OF ATOMS'" },
  { "number_negative.dump", ":4: expected a number of atoms >= 0, got '-2'" },
  { "number_huge.dump", ":1: expected 9000000000000000000 rows, got 2" },
  { "number_beyond.dump", ":4: expected a number of atoms, got '99999999999999999999'" },
  { "number_word.dump", ":4: expected a number of atoms, got 'two'" },
  { "number_too_large.dump", ":1: expected 3 rows, got 2" },
  { "number_too_small.dump", ":1: expected 1 rows, got 2" },
  { "box_word.dump", ":7: expected a number, got 'one'" },
  { "box_short.dump", ":7: expected 2 numbers, got '0'" },
  { "box_tilt_missing.dump", ":7: expected 3 numbers, got '0 1'" },
  { "box_two_lines.dump", ":8: expected a value, got 'ITEM: ATOMS id type x y z'" },
  { "cut_in_header.dump", ":1: expected a complete frame, got the end of the file in its header" },
  { "cut_in_rows.dump", ":1: expected 2 rows, got 1, and a last line without its line feed" },
  { "columns_unnamed.dump",
    ":9: expected 5 or 8 words in a row of a dump that does not name its columns, got 6" },
};

// Found when the frame is read.
constexpr Bad when_read[] = {
  { "row_short.dump", ":11: expected 5 words in a row, got 4" },
  { "row_word.dump", ":11: column 'y': expected a number, got 'half'" },
  { "row_decimal_comma.dump", ":10: column 'x': expected a number, got '0,1'" },
  { "row_joined.dump", ":10: column 'x': expected a number, got '0.1-0.2'" },
  { "id_fraction.dump", ":11: column 'id': expected an integer, got '2.5'" },
  { "coordinates_missing.dump",
    ":1: expected columns of coordinates (x y z, xs ys zs, xu yu zu or xsu ysu zsu), got 'id type "
    "vx "
    "vy vz'" },
  { "coordinates_mixed.dump",
    ":1: expected all coordinates of a tilted box in one form, got 'id type x ys z'" },
};

std::string path_of(const std::string& file)
{
  return std::string(GRANULAR_DATA) + "/bad/" + file;
}
}

TEST(BadInput, SaidWhenOpened)
{
  for (const Bad& bad : when_opened)
  {
    Series run;
    EXPECT_EQ(error_of([&] { run.update({ path_of(bad.file) }); }), path_of(bad.file) + bad.said);
    EXPECT_EQ(run.index.size(), 0u);
    // and the same index reads a good file afterwards
    run.update({ std::string(GRANULAR_DATA) + "/good/grains_1000.dump" });
    EXPECT_EQ(run.read(0).rows(), 1200);
  }
}

TEST(BadInput, SaidWhenRead)
{
  for (const Bad& bad : when_read)
  {
    Series run;
    EXPECT_EQ(error_of([&] { run.update({ path_of(bad.file) }); }), "") << bad.file;
    EXPECT_EQ(error_of([&] { run.read(0); }), path_of(bad.file) + bad.said);
  }
}

TEST(BadInput, EveryFileOfTheFolderIsTested)
{
  std::set<std::string> tested;
  for (const Bad& bad : when_opened)
  {
    tested.insert(bad.file);
  }
  for (const Bad& bad : when_read)
  {
    tested.insert(bad.file);
  }
  for (const auto& entry : std::filesystem::directory_iterator(path_of("")))
  {
    EXPECT_TRUE(tested.contains(entry.path().filename().string())) << entry.path();
  }
}

// One bad frame among good ones: the good ones are shown.
TEST(BadInput, ABadFrameDoesNotHideTheOthers)
{
  const std::string good = one_frame("id type x y z", "1 1 0.1 0.2 0.3\n");
  for (const Bad& bad : when_opened)
  {
    const std::string text = data_file(std::string("bad/") + bad.file);
    if (text.starts_with("ITEM:"))
    {
      const Dump dump(good + text + good);
      // what has no LF at its end takes the next header with it
      const std::size_t shown = text.ends_with('\n') || dump.frames() == 2 ? 2 : 1;
      EXPECT_EQ(dump.frames(), shown) << bad.file;
      for (std::size_t frame = 0; frame < dump.frames(); ++frame)
      {
        EXPECT_EQ(dump.read({}, frame).points(), (std::vector<double>{ 0.1, 0.2, 0.3 }))
          << bad.file;
      }
    }
  }
}

// Whatever the file says, no more is allocated than it holds.
TEST(BadInput, NothingIsAllocatedOnTheWordOfAFile)
{
  for (const char* number : { "1000000000000", "4611686018427387904", "9223372036854775807" })
  {
    const std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::string(number) +
      "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z c_a[2000000000] c_a[1]\n"
      "1 0 0 0 1 2\n";
    EXPECT_EQ(Dump(text).frames(), 0u);
    EXPECT_EQ(Dump(text + text).frames(), 0u);
  }
}
