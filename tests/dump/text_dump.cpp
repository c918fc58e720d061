// SPDX-License-Identifier: BSD-3-Clause
// Headers and frames of text dumps as the programs write them, and as users' tools change them.
#include "granular/formats/dump/grammar/text_dump.h"

#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
using granular::FrameHeader;
using granular::is_text_dump;
using granular::Vector3;
using Steps = std::vector<std::int64_t>;
}

// ---- the writers -------------------------------------------------------------------------------

TEST(TextHeader, LiggghtsDumpCustom)
{
  // LIGGGHTS ends the line of the columns and every row with a blank
  const Dump dump(R"(ITEM: TIMESTEP
200
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS mm mm ff
-0.05 0.05
-0.06 0.06
0 0.15
ITEM: ATOMS id type x y z radius )"
                  "\n"
                  "350 1 -0.0470467 0.01 0.02 0.0025 \n"
                  "7 2 0.03 -0.04 0.05 0.003 \n");
  ASSERT_EQ(dump.frames(), 1u);
  EXPECT_EQ(dump.said(), "");
  const FrameHeader& header = dump.header();
  EXPECT_EQ(header.timestep, 200);
  EXPECT_EQ(header.rows, 2);
  EXPECT_FALSE(header.time);
  EXPECT_EQ(header.label, "");
  EXPECT_EQ(header.units, "");
  EXPECT_EQ(header.box.boundary, "mm mm ff");
  EXPECT_FALSE(header.box.tilted);
  EXPECT_EQ(header.box.corner(0, 0, 0), (Vector3{ -0.05, -0.06, 0 }));
  EXPECT_EQ(header.box.corner(1, 1, 1), (Vector3{ 0.05, 0.06, 0.15 }));
  EXPECT_EQ(dump.entry().kind->schema.text(), "id type x y z radius");
  EXPECT_EQ(dump.entry().offset, 0);
  EXPECT_EQ(dump.entry().line, 1);
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.integers("id"), (std::vector<std::int64_t>{ 350, 7 }));
  EXPECT_EQ(frame.integers("type"), (std::vector<std::int64_t>{ 1, 2 }));
  EXPECT_EQ(frame.values("radius"), (std::vector<double>{ 0.0025, 0.003 }));
  EXPECT_EQ(frame.points(), (std::vector<double>{ -0.0470467, 0.01, 0.02, 0.03, -0.04, 0.05 }));
  EXPECT_EQ(frame.said(), "");
}

TEST(TextHeader, LiggghtsTriclinic)
{
  const Dump dump(R"(ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS xy xz yz pp pp pp
-3 12 2
0 14 -3
0 5 4
ITEM: ATOMS id type xs ys zs
1 1 0.5 0.5 0.5
)");
  const FrameHeader& header = dump.header();
  EXPECT_TRUE(header.box.tilted);
  EXPECT_EQ(header.box.boundary, "pp pp pp");
  EXPECT_EQ(header.box.corner(0, 0, 0), (Vector3{ 0, 0, 0 }));
  EXPECT_EQ(header.box.corner(1, 1, 1), (Vector3{ 9, 14, 5 }));
  EXPECT_EQ(dump.read().points(), (std::vector<double>{ 4.5, 7, 2.5 }));
}

TEST(TextHeader, LammpsWithUnitsTimeAndLongBounds)
{
  const std::string header = R"(ITEM: TIME
0.25
ITEM: TIMESTEP
100
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS pp ff pp
-1.0000000000000000e+00 1.0000000000000000e+00
 0.0000000000000000e+00 2.5000000000000000e-01
-5.0000000000000000e-01 5.0000000000000000e-01
ITEM: ATOMS id type xs ys zs
1 1 0.5 0.5 0.5
)";
  std::string later = header;
  later.replace(later.find("0.25\n"), 5, "0.5\n");
  later.replace(later.find("100\n"), 4, "200\n");
  // UNITS stands once a file
  const Dump dump("ITEM: UNITS\nsi\n" + header + later);
  EXPECT_EQ(dump.said(), "");
  ASSERT_EQ(dump.steps(), (Steps{ 100, 200 }));
  EXPECT_EQ(dump.header(0).units, "si");
  EXPECT_EQ(dump.header(1).units, "si");
  EXPECT_EQ(dump.header(0).time, 0.25);
  EXPECT_EQ(dump.header(1).time, 0.5);
  EXPECT_EQ(dump.entry(0).offset, 0);
  EXPECT_EQ(dump.entry(1).line, 14 + 1);
  EXPECT_EQ(dump.read({}, 1).points(), (std::vector<double>{ 0, 0.125, 0 }));
}

TEST(TextHeader, LammpsGeneralTriclinic)
{
  const Dump dump(R"(ITEM: TIMESTEP
5
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS abc origin pp ff pp
4 1 0 1
-1 5 0.5 2
0 0 6 3
ITEM: ATOMS id type xs ys zs
1 1 0.5 0.5 0.5
)");
  const FrameHeader& header = dump.header();
  EXPECT_TRUE(header.box.general);
  EXPECT_EQ(header.box.boundary, "pp ff pp");
  EXPECT_EQ(header.box.corner(0, 0, 0), (Vector3{ 1, 2, 3 }));
  EXPECT_EQ(header.box.corner(1, 1, 1), (Vector3{ 4, 8, 9.5 }));
  EXPECT_EQ(dump.read().points(), (std::vector<double>{ 2.5, 5, 6.25 }));
}

TEST(TextHeader, TrapOldLammpsWithoutFlagsAndColumnsOf5)
{
  const Dump dump(R"(ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS
0 10
0 20
0 40
ITEM: ATOMS
1 1 0.5 0.5 0.5
2 3 0 0.25 1
)");
  EXPECT_EQ(dump.header().box.boundary, "");
  EXPECT_EQ(dump.entry().kind->schema.text(), "id type xs ys zs");
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.points(), (std::vector<double>{ 5, 10, 20, 0, 5, 40 }));
  EXPECT_EQ(frame.integers("type"), (std::vector<std::int64_t>{ 1, 3 }));
}

TEST(TextHeader, TrapOldLammpsWithoutFlagsAndColumnsOf8)
{
  const Dump dump(R"(ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS xy xz yz
0 12 2
0 10 0
0 10 0
ITEM: ATOMS
1 1 0.5 0.5 0.5 1 -2 0
)");
  EXPECT_TRUE(dump.header().box.tilted);
  EXPECT_EQ(dump.header().box.boundary, "");
  EXPECT_EQ(dump.entry().kind->schema.text(), "id type xs ys zs ix iy iz");
  EXPECT_EQ(dump.read().integers("image"), (std::vector<std::int64_t>{ 1, -2, 0 }));
  EXPECT_EQ(dump.read().points(), (std::vector<double>{ 6, 5, 5 }));
}

TEST(TextHeader, OldLammpsWithoutColumnsAndWithoutRows)
{
  const Dump dump(
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS\n0 1\n0 1\n0 1\nITEM: ATOMS\n");
  ASSERT_EQ(dump.frames(), 1u);
  EXPECT_EQ(dump.entry().kind->schema.text(), "id type xs ys zs");
}

TEST(TextHeader, SecondWordOnTheLineOfTheTimestep)
{
  const Dump dump("ITEM: TIMESTEP\n17       3.25\nITEM: NUMBER OF ATOMS\n0\n"
                  "ITEM: BOX BOUNDS\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z\n");
  EXPECT_EQ(dump.steps(), Steps{ 17 });
}

TEST(TextHeader, TrapLabelBetweenTimestepAndNumber)
{
  const std::string head = "ITEM: TIMESTEP\n10\nITEM: LABEL\n";
  const std::string tail =
    "\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS mm mm mm\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z \n";
  EXPECT_EQ(Dump(head + "hopper, case 7" + tail).header().label, "hopper, case 7");
  EXPECT_EQ(Dump(head + tail).header().label, "");
  EXPECT_EQ(Dump(head + "  two  blanks " + tail).header().label, "  two  blanks ");
  EXPECT_EQ(Dump(head + "17" + tail).header().timestep, 10);
}

TEST(TextHeader, TrapUnknownSectionsArePassedOver)
{
  const Dump dump(R"(ITEM: TIMESTEP
10
ITEM: SOMETHING NEW
1 2 3
any text, 17 lines of it

ITEM: NUMBER OF ATOMS
1
ITEM: EMPTY ONE
ITEM: BOX BOUNDS pp pp pp
0 1
0 1
0 1
ITEM: TIMESTEP SIZE
0.001
ITEM: ATOMS id x y z
1 0 0 0
)");
  EXPECT_EQ(dump.steps(), Steps{ 10 });
  EXPECT_EQ(dump.said(), "");
  EXPECT_EQ(dump.read().rows(), 1);
}

TEST(TextHeader, UnknownSectionsBehindTheRowsArePassedOver)
{
  const std::string frame = "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                            "ITEM: ATOMS id x y z\n7 0.5 0.5 0.5\nITEM: CHECKSUM md5\n1 2 3\nabc\n";
  const Dump dump("ITEM: TIMESTEP\n0\n" + frame + "ITEM: TIMESTEP\n10\n" + frame);
  EXPECT_EQ(dump.steps(), (std::vector<std::int64_t>{ 0, 10 }));
  EXPECT_EQ(dump.said(), "");
  EXPECT_EQ(dump.read({}, 1).integers("id"), (std::vector<std::int64_t>{ 7 }));
}

TEST(TextHeader, SectionsInAnotherOrder)
{
  const Dump dump(R"(ITEM: TIMESTEP
10
ITEM: BOX BOUNDS pp pp pp
0 1
0 1
0 1
ITEM: TIME
1.5
ITEM: UNITS
lj
ITEM: NUMBER OF ATOMS
0
ITEM: ATOMS id x y z
)");
  ASSERT_EQ(dump.frames(), 1u);
  EXPECT_EQ(dump.header().time, 1.5);
  EXPECT_EQ(dump.header().units, "lj");
}

TEST(TextHeader, TrapBoxOfInfinitiesAndNans)
{
  const Dump dump(
    one_frame("id x y z", "1 2 3 4\n", " ff ff ff\n-inf inf\nnan -nan\n1.#INF -1.#IND\n"));
  ASSERT_EQ(dump.frames(), 1u);
  EXPECT_EQ(dump.read().points(), (std::vector<double>{ 2, 3, 4 }));
}

// ---- what editors and transfers do -------------------------------------------------------------

namespace
{
const char* const two_frames = R"(ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
0 1
0 2
0 4
ITEM: ATOMS id type x y z element
1 1 0.5 1.5 2.5 C
2 1 0.25 1.25 3.5 Si
ITEM: TIMESTEP
100
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS pp pp pp
0 1
0 2
0 4
ITEM: ATOMS id type x y z element
2 1 0.125 1.125 3.25 Si
)";

void expect_the_two_frames(const std::string& text)
{
  const Dump dump(text);
  EXPECT_EQ(dump.said(), "") << text;
  ASSERT_EQ(dump.steps(), (Steps{ 0, 100 })) << text;
  const Decoded first = dump.read({}, 0);
  EXPECT_EQ(first.points(), (std::vector<double>{ 0.5, 1.5, 2.5, 0.25, 1.25, 3.5 })) << text;
  EXPECT_EQ(first.integers("id"), (std::vector<std::int64_t>{ 1, 2 }));
  EXPECT_EQ(first.texts("element"), (std::vector<std::string>{ "C", "Si" }));
  EXPECT_EQ(dump.entry(0).kind->schema.text(), "id type x y z element");
  EXPECT_EQ(dump.header(0).box.boundary, "pp pp pp");
  const Decoded second = dump.read({}, 1);
  EXPECT_EQ(second.points(), (std::vector<double>{ 0.125, 1.125, 3.25 })) << text;
}
}

TEST(TextDump, AsItShouldBe)
{
  expect_the_two_frames(two_frames);
}

TEST(TextDump, TrapLineEndsOfWindows)
{
  expect_the_two_frames(replaced(two_frames, "\n", "\r\n"));
  expect_the_two_frames(replaced(two_frames, "\n", " \r\n"));
}

TEST(TextDump, TrapByteOrderMark)
{
  expect_the_two_frames(std::string("\xef\xbb\xbf") + two_frames);
  expect_the_two_frames(std::string("\xef\xbb\xbf\n\n") + two_frames);
  expect_the_two_frames(std::string("\xef\xbb\xbf") + replaced(two_frames, "\n", "\r\n"));
}

TEST(TextDump, TrapTabsAndTrailingBlanks)
{
  expect_the_two_frames(replaced(replaced(two_frames, "ITEM: ", "ITEM:\b"), " ", "\t"));
  expect_the_two_frames(replaced(two_frames, "\n", " \t \n"));
  expect_the_two_frames(replaced(two_frames, " ", "   "));
}

TEST(TextDump, TrapBlankLines)
{
  expect_the_two_frames("\n \n" + std::string(two_frames) + "\n\n\t\n");
  expect_the_two_frames(replaced(two_frames, "ITEM: TIMESTEP", "\nITEM: TIMESTEP"));
  expect_the_two_frames(replaced(two_frames, "\n", "\n\n"));
  expect_the_two_frames(replaced(two_frames, "\n", "\r\n \r\n\r\n"));
  expect_the_two_frames(replaced(two_frames, "2 1 0.25", "\n\n2 1 0.25"));
}

TEST(TextDump, TrapNoLineFeedAtTheEnd)
{
  const std::string text = two_frames;
  const Dump dump(text.substr(0, text.size() - 1));
  // 3.25 may be the start of 3.257
  EXPECT_EQ(dump.steps(), Steps{ 0 });
  EXPECT_EQ(dump.said(), "");
}

// ---- frames ------------------------------------------------------------------------------------

TEST(TextDump, TrapFramesWithoutAtoms)
{
  const std::string empty =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS mm mm mm\n"
    "0 1\n0 1\n0 1\nITEM: ATOMS id type x y z vx vy vz element \n";
  const Dump dump(empty + empty + "\n" + empty);
  ASSERT_EQ(dump.frames(), 3u);
  EXPECT_EQ(dump.said(), "");
  const Decoded frame = dump.read({}, 1);
  EXPECT_EQ(frame.rows(), 0);
  EXPECT_EQ(frame.names(), "id type v element");
  EXPECT_EQ(frame.points(), std::vector<double>{});
  EXPECT_EQ(frame.values("v"), std::vector<double>{});
  EXPECT_EQ(frame.texts("element"), std::vector<std::string>{});
}

TEST(TextDump, TrapNumberColumnsAndOrderChangeBetweenFrames)
{
  const Dump dump(one_frame("id x y z", "1 2 3 4\n") +
    one_frame("z y x id q", "1 2 3 4 5\n6 7 8 9 10\n") + one_frame("id x y z", "5 6 7 8\n"));
  ASSERT_EQ(dump.frames(), 3u);
  EXPECT_EQ(dump.read({}, 0).points(), (std::vector<double>{ 2, 3, 4 }));
  EXPECT_EQ(dump.read({}, 1).points(), (std::vector<double>{ 3, 2, 1, 8, 7, 6 }));
  EXPECT_EQ(dump.read({}, 1).integers("id"), (std::vector<std::int64_t>{ 4, 9 }));
  EXPECT_EQ(dump.read({}, 2).points(), (std::vector<double>{ 6, 7, 8 }));
  EXPECT_EQ(dump.entry(0).kind, dump.entry(2).kind) << "equal schemas are shared";
  EXPECT_NE(dump.entry(0).kind, dump.entry(1).kind);
}

TEST(TextDump, TrapUnknownTextColumns)
{
  const Dump dump(one_frame("id x y z material", "1 0 0 0 glass\n2 0 0 0 17\n3 0 0 0 1.5x\n"));
  EXPECT_EQ(dump.read().texts("material"), (std::vector<std::string>{ "glass", "17", "1.5x" }));
  // a column of numbers stays one
  const Dump numbers(one_frame("id x y z heat", "1 0 0 0 nan\n2 0 0 0 -1.#IND\n3 0 0 0 +1e-005\n"));
  EXPECT_EQ(numbers.read().values("heat")[2], 1e-5);
}

TEST(TextDump, ATextColumnThatBeginsWithANumber)
{
  const Dump dump(one_frame("id x y z tag", "1 0 0 0 12\n2 0 0 0 C\n3 0 0 0 12\n"));
  const Decoded frame = dump.read();
  EXPECT_EQ(frame.texts("tag"), (std::vector<std::string>{ "12", "C", "12" }));
  EXPECT_EQ(frame.said(),
    "memory:11: column 'tag': expected a number, got 'C'; the column is kept as texts\n");
  // what its other words would have made of the column is not said
  EXPECT_EQ(Dump(one_frame("id x y z tag", "1 0 0 0 0.5\n2 0 0 0 9007199254740993\n3 0 0 0 abc\n"))
              .read()
              .said(),
    "memory:12: column 'tag': expected a number, got 'abc'; the column is kept as texts\n");
  // where a column is known to hold numbers, a word is an error
  EXPECT_EQ(Dump(one_frame("id x y z vx", "1 0 0 0 12\n2 0 0 0 C\n")).error(),
    "memory:11: column 'vx': expected a number, got 'C'");
}

TEST(TextDump, TextColumnsAreFoundFrameByFrame)
{
  const Dump dump(
    one_frame("id x y z tag", "1 0 0 0 a\n") + one_frame("id x y z tag", "1 0 0 0 2\n"));
  EXPECT_EQ(dump.read({}, 0).texts("tag"), std::vector<std::string>{ "a" });
  EXPECT_EQ(dump.read({}, 1).values("tag"), std::vector<double>{ 2 });
}

TEST(TextDump, LinesOfFramesAreCounted)
{
  const Dump dump("\n" + std::string(two_frames) + "\n\n" + two_frames);
  ASSERT_EQ(dump.frames(), 4u);
  EXPECT_EQ(dump.entry(0).line, 2);
  EXPECT_EQ(dump.entry(1).line, 13);
  EXPECT_EQ(dump.entry(2).line, 1 + 21 + 2 + 1);
  EXPECT_EQ(
    dump.entry(2).offset, static_cast<std::int64_t>(1 + std::string(two_frames).size() + 2));
}

TEST(TextDump, WrongCountsInTheMiddleAreLeftOutAndSaidSo)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n5 6 7 8\n");
  const std::string more = replaced(good, "ATOMS\n2\n", "ATOMS\n3\n");
  const std::string less = replaced(good, "ATOMS\n2\n", "ATOMS\n1\n");
  const std::string negative = replaced(good, "ATOMS\n2\n", "ATOMS\n-2\n");
  const std::string huge = replaced(good, "ATOMS\n2\n", "ATOMS\n9000000000000000000\n");
  const std::string beyond = replaced(good, "ATOMS\n2\n", "ATOMS\n9300000000000000000\n");
  const std::string fraction = replaced(good, "ATOMS\n2\n", "ATOMS\n2.5\n");
  const Dump dump(good + more + good + less + negative + huge + beyond + fraction + good);
  EXPECT_EQ(dump.frames(), 3u);
  EXPECT_EQ(dump.said(),
    "memory:12: expected 3 rows, got 2; the frame is left out\n"
    "memory:34: expected 1 rows, got 2; the frame is left out\n"
    "memory:48: expected a number of atoms >= 0, got '-2'; the frame is left out\n"
    "memory:56: expected 9000000000000000000 rows, got 2; the frame is left out\n"
    "memory:70: expected a number of atoms, got '9300000000000000000'; the frame is left out\n"
    "memory:81: expected a number of atoms, got '2.5'; the frame is left out\n");
}

TEST(TextDump, WrongCountsAtTheEnd)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n5 6 7 8\n");
  // too few rows: its writer may not be done
  const Dump more(good + replaced(good, "ATOMS\n2\n", "ATOMS\n9000000000000000000\n"));
  EXPECT_EQ(more.frames(), 1u);
  EXPECT_EQ(more.said(), "");
  const Dump less(good + replaced(good, "ATOMS\n2\n", "ATOMS\n1\n"));
  EXPECT_EQ(less.frames(), 1u);
  EXPECT_EQ(less.said(), "memory:12: expected 1 rows, got 2; the frame is left out\n");
}

TEST(TextDump, MissingSectionsAreLeftOutAndSaidSo)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n");
  const std::string no_step = replaced(good, "ITEM: TIMESTEP\n0\n", "");
  const std::string no_rows = replaced(good, "ITEM: NUMBER OF ATOMS\n1\n", "");
  const std::string no_atoms = replaced(good, "ITEM: ATOMS id x y z\n1 2 3 4\n", "");
  const std::string only_time = "ITEM: TIME\n1\n" + no_step;
  EXPECT_EQ(Dump(no_step + good).said(),
    "memory:1: expected ITEM: TIMESTEP, UNITS or TIME, got 'ITEM: NUMBER OF ATOMS'; the frame is "
    "left out\n");
  EXPECT_EQ(Dump(no_rows + good).said(),
    "memory:7: expected ITEM: NUMBER OF ATOMS before ITEM: ATOMS, got none; the frame is left "
    "out\n");
  EXPECT_EQ(Dump(no_atoms + good).said(),
    "memory:9: expected ITEM: ATOMS, got 'ITEM: TIMESTEP'; the frame is left out\n");
  EXPECT_EQ(Dump(only_time + good).said(),
    "memory:9: expected ITEM: TIMESTEP before ITEM: ATOMS, got none; the frame is left out\n");
  for (const std::string& bad : { no_step, no_rows, no_atoms, only_time })
  {
    const Dump dump(good + bad + good);
    EXPECT_EQ(dump.frames(), 2u) << bad;
  }
}

TEST(TextDump, MissingItemLinesAreSaid)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n");
  const auto first_said = [&](const char* item)
  { return Dump(replaced(good, item, "") + good).said(); };
  EXPECT_EQ(first_said("ITEM: TIMESTEP\n"),
    "memory:1: expected ITEM: TIMESTEP, UNITS or TIME, got '0'; the frame is left out\n");
  EXPECT_EQ(first_said("ITEM: NUMBER OF ATOMS\n"),
    "memory:3: expected an ITEM: line, got '1'; the frame is left out\n");
  EXPECT_EQ(first_said("ITEM: BOX BOUNDS pp pp pp\n"),
    "memory:5: expected an ITEM: line, got '0 1'; the frame is left out\n");
  EXPECT_EQ(first_said("ITEM: ATOMS id x y z\n"),
    "memory:9: expected an ITEM: line, got '1 2 3 4'; the frame is left out\n");
}

TEST(TextDump, ARunThatWasKilledWithinARowAndWentOn)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n5 6 7 8\n");
  const std::string later = replaced(good, "TIMESTEP\n0\n", "TIMESTEP\n100\n");
  for (const char* cut : { "8\n", "7 8\n", " 8\n", "5 6 7 8\n", "\n5 6 7 8\n", "3 4\n5 6 7 8\n" })
  {
    const std::string start = good.substr(0, good.rfind(cut));
    for (const char* opening : { "", "ITEM: UNITS\nsi\n", "ITEM: TIME\n0.5\n" })
    {
      const Dump dump(good + start + opening + later + good);
      ASSERT_EQ(dump.steps(), (Steps{ 0, 100, 0 })) << start << opening;
      EXPECT_NE(dump.said().find("the frame is left out"), std::string::npos) << start;
      EXPECT_EQ(dump.read({}, 1).points(), (std::vector<double>{ 2, 3, 4, 6, 7, 8 }));
      EXPECT_EQ(dump.read({}, 2).points(), (std::vector<double>{ 2, 3, 4, 6, 7, 8 }));
      if (*opening != '\0')
      {
        EXPECT_TRUE(dump.header(1).units == "si" || dump.header(1).time == 0.5);
      }
    }
  }
  EXPECT_EQ(Dump(good.substr(0, good.rfind("8\n")) + later).said(),
    "memory:1: expected 2 rows, got the header of another frame within a row; the frame is left "
    "out\n");
}

TEST(TextDump, AKilledRunThatIsLookedAtAtEveryByte)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n5 6 7 8\n");
  const std::string later = replaced(good, "TIMESTEP\n0\n", "TIMESTEP\n100\n");
  for (const char* lost : { "8\n", " 4\n5 6 7 8\n", "\n5 6 7 8\n" })
  {
    const std::string text = good + good.substr(0, good.rfind(lost)) + later + good;
    const Dump dump(text);
    for (std::size_t cut = 0; cut <= text.size(); ++cut)
    {
      granular::FileIndex index = Dump(text.substr(0, cut)).index();
      granular::Progress progress;
      const auto source = granular::open_memory(text);
      index_text_dump(*source, index, progress);
      ASSERT_EQ(index.frames.size(), 3u) << "looked at after byte " << cut << " of\n" << text;
      EXPECT_EQ(index.frames[1].timestep, 100);
      for (std::size_t frame = 0; frame < 3; ++frame)
      {
        const granular::FrameEntry& whole = dump.entry(frame);
        EXPECT_EQ(index.frames[frame].offset, whole.offset);
        EXPECT_EQ(index.frames[frame].line, whole.line);
        EXPECT_EQ(index.frames[frame].end, whole.end);
      }
    }
  }
}

TEST(TextDump, ARunThatWasKilledWithinAHeaderAndWentOn)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n5 6 7 8\n");
  const std::string header = good.substr(0, good.find("1 2 3 4"));
  const std::string later = replaced(good, "TIMESTEP\n0\n", "TIMESTEP\n100\n");
  const std::string last = replaced(good, "TIMESTEP\n0\n", "TIMESTEP\n200\n");
  for (std::size_t cut = 1; cut < header.size(); ++cut)
  {
    const Dump dump(good + header.substr(0, cut) + "ITEM: TIME\n0.5\n" + later + last);
    ASSERT_EQ(dump.steps(), (Steps{ 0, 100, 200 })) << header.substr(0, cut);
    EXPECT_EQ(dump.header(1).time, 0.5) << header.substr(0, cut);
    for (std::size_t frame = 0; frame < dump.frames(); ++frame)
    {
      EXPECT_EQ(dump.read({}, frame).points(), (std::vector<double>{ 2, 3, 4, 6, 7, 8 }));
    }
  }
}

TEST(TextDump, ARunThatWasKilledTwiceInItsHeader)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n5 6 7 8\n");
  const std::string header = good.substr(0, good.find("1 2 3 4"));
  const std::string again = replaced(header, "TIMESTEP\n0\n", "TIMESTEP\n50\n");
  const std::string last = replaced(good, "TIMESTEP\n0\n", "TIMESTEP\n100\n");
  for (std::size_t first = 1; first < header.size(); ++first)
  {
    for (std::size_t second = 1; second < 50; ++second)
    {
      const Dump dump(good + header.substr(0, first) + again.substr(0, second) + last);
      ASSERT_EQ(dump.steps(), (Steps{ 0, 100 })) << first << " " << second;
    }
  }
}

// A file system that lost power leaves zeros where the data should be.
TEST(TextDump, ZerosAtTheEndDoNotHideTheFramesBefore)
{
  const std::string good = one_frame("id x y z", "1 2 3 4\n");
  for (const std::size_t zeros : { 100u, 5'000'000u, 20'000'000u })
  {
    for (const char* start :
      { "", "ITEM: TIM", "ITEM: TIMESTEP\n", "1 2", "ITEM: TIMESTEP\n10\nITEM: NU" })
    {
      const Dump dump(good + good + start + std::string(zeros, '\0'));
      EXPECT_EQ(dump.frames(), 2u) << zeros << " zeros behind '" << start << "'";
    }
  }
}

// ---- cut anywhere ------------------------------------------------------------------------------

namespace
{
/// Three frames with everything: UNITS, TIME, LABEL, an unknown section, no atoms in the second.
const char* const three_frames = R"(ITEM: UNITS
si
ITEM: TIME
0
ITEM: TIMESTEP
0
ITEM: LABEL
a label
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS xy xz yz pp pp ff
0 1 0
0 1 0
0 1 0
ITEM: ATOMS id type x y z
1 1 0.11 0.22 0.33
2 1 0.44 0.55 0.66
ITEM: TIME
0.5
ITEM: TIMESTEP
1000
ITEM: NUMBER OF ATOMS
0
ITEM: BOX BOUNDS pp pp ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z
ITEM: TIME
1.0
ITEM: TIMESTEP
2000
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS pp pp ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z
1 1 0.11 0.22 0.33
12 1 0.44 0.55 0.66
3 1 0.77 0.88 0.99
)";

void expect_the_complete_frames(const std::string& text, const std::vector<std::size_t>& ends)
{
  const std::vector<std::int64_t> steps = { 0, 1000, 2000 };
  for (std::size_t cut = 0; cut <= text.size(); ++cut)
  {
    const auto complete =
      static_cast<std::ptrdiff_t>(std::upper_bound(ends.begin(), ends.end(), cut) - ends.begin());
    const std::string part = text.substr(0, cut);
    const Dump dump(part);
    ASSERT_EQ(dump.steps(), Steps(steps.begin(), steps.begin() + complete)) << "cut at " << cut;
    ASSERT_EQ(dump.said(), "") << "cut at " << cut;
    for (std::size_t frame = 0; frame < dump.frames(); ++frame)
    {
      ASSERT_EQ(dump.read({}, frame).rows(), dump.header(frame).rows);
    }
    // the writer goes on: what was indexed is kept, the rest is found
    granular::FileIndex index = dump.index();
    granular::Progress progress;
    index.notices.clear();
    const auto source = granular::open_memory(text);
    index_text_dump(*source, index, progress);
    const Dump whole(text);
    ASSERT_EQ(index.frames.size(), 3u) << "cut at " << cut;
    ASSERT_EQ(lines_of(index.notices), "") << "cut at " << cut;
    for (std::size_t frame = 0; frame < 3; ++frame)
    {
      ASSERT_EQ(index.frames[frame].offset, whole.entry(frame).offset) << "cut at " << cut;
      ASSERT_EQ(index.frames[frame].line, whole.entry(frame).line) << "cut at " << cut;
      ASSERT_EQ(index.frames[frame].end, whole.entry(frame).end) << "cut at " << cut;
      ASSERT_EQ(index.frames[frame].kind->units, "si") << "cut at " << cut;
    }
  }
}
}

TEST(TextDump, TrapCutAtEveryByte)
{
  const std::string text = three_frames;
  const std::size_t first = text.find("ITEM: TIME\n0.5");
  const std::size_t second = text.find("ITEM: TIME\n1.0");
  expect_the_complete_frames(text, { first, second, text.size() });
}

TEST(TextDump, TrapCutAtEveryByteWithLineEndsOfWindows)
{
  const std::string text = replaced(three_frames, "\n", "\r\n");
  const std::size_t first = text.find("ITEM: TIME\r\n0.5");
  const std::size_t second = text.find("ITEM: TIME\r\n1.0");
  expect_the_complete_frames(text, { first, second, text.size() });
}

// Blank lines are no rows: a frame that has one and lacks a row is not complete.
TEST(TextDump, TrapCutAtEveryByteWithBlankLines)
{
  std::string text = replaced(three_frames, "12 1 0.44", "\n \n12 1 0.44");
  text = replaced(text, "2 1 0.44 0.55 0.66\nITEM", "\n2 1 0.44 0.55 0.66\nITEM");
  const std::size_t first = text.find("ITEM: TIME\n0.5");
  const std::size_t second = text.find("ITEM: TIME\n1.0");
  expect_the_complete_frames(text, { first, second, text.size() });
}

// ---- is it one? --------------------------------------------------------------------------------

TEST(IsTextDump, OursAndOthers)
{
  EXPECT_TRUE(is_text_dump(two_frames));
  EXPECT_TRUE(is_text_dump(three_frames));
  EXPECT_TRUE(is_text_dump(std::string("\xef\xbb\xbf\r\n") + two_frames));
  EXPECT_TRUE(is_text_dump(replaced(two_frames, "\n", "\r\n")));
  EXPECT_TRUE(is_text_dump("ITEM: TIMESTEP\n"));
  EXPECT_TRUE(is_text_dump("ITEM: TIMESTEP"));
  EXPECT_FALSE(is_text_dump(""));
  EXPECT_FALSE(is_text_dump("\n\n"));
  EXPECT_FALSE(is_text_dump("# vtk DataFile Version 2.0\nLIGGGHTS mesh/gran/VTK export\nASCII\n"));
  EXPECT_FALSE(is_text_dump("ITEM: ATOMS id x y z\n1 2 3 4\n"));
  EXPECT_FALSE(is_text_dump("xITEM: TIMESTEP\n"));
  // dump local: bonds, contacts
  EXPECT_FALSE(is_text_dump("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n2\n"));
  EXPECT_FALSE(is_text_dump("ITEM: TIMESTEP\n0\nITEM: NUMBER OF BONDS\n2\n"));
  EXPECT_FALSE(is_text_dump(std::string("\0\0\0\0", 4)));
  EXPECT_FALSE(is_text_dump(std::string(1000, '\n') + two_frames));
}

TEST(IsTextDump, EveryStartOfADump)
{
  const std::string text = three_frames;
  for (std::size_t cut = text.find('\n'); cut < text.size(); ++cut)
  {
    EXPECT_TRUE(is_text_dump(text.substr(0, cut))) << cut;
  }
}
