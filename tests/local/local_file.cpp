// SPDX-License-Identifier: BSD-3-Clause
// Frames of dump local, and of its pieces without headers.
#include "local_files.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
std::vector<std::string> piece_files(const std::string& step)
{
  std::vector<std::string> paths;
  for (int process = 0; process < 4; ++process)
  {
    paths.push_back(local_file("pieces_" + step + "." + std::to_string(process) + ".dump"));
  }
  return paths;
}

std::string opening_error(const std::vector<std::string>& paths)
{
  return error_of([&] { LocalRun run(paths); });
}

/// Of a file with that text, behind its path.
std::string text_error(const std::string& text)
{
  const std::string path = write_text("bad.dump", text);
  return opening_error({ path }).substr(path.size());
}
}

TEST(LocalFile, WhatItIs)
{
  EXPECT_FALSE(granular::is_local("ITEM: TIMESTEP\n0\n")) << "atoms may be what it counts";
  EXPECT_FALSE(granular::is_local("title\n\n10 atoms\n\nAtoms\n")) << "no bonds";
}

// In any order, and by themselves.
TEST(LocalFile, PiecesBelongToTheFileWithZero)
{
  const std::vector<std::string> files = piece_files("3000");
  LocalRun turned({ files[2], files[1], files[0], files[3] });
  EXPECT_EQ(turned.size(), 1u);
  EXPECT_EQ(turned.read(0).rows, LocalRun(files).read(0).rows);
  EXPECT_EQ(opening_error({ files[2] }),
    files[2] +
      ": expected a header, or rows of one timestep of which the file with 0 in its name has the "
      "header, got rows alone; they are left out, and so is what they belong to. A name with % and "
      "* gives each timestep its own files; ColumnMap makes rows of any timesteps one frame");
}

// dump_modify header no: rows of bonds that broke, whose first column is the timestep.
TEST(LocalFile, RowsAloneAreAFrameWhereTheirColumnsAreNamed)
{
  const std::string rows = "276 5469 5471 \n288 1815 1931 \n290 1810 1815 \n293 1815 1816 \n";
  const std::string path = write_text("broken.txt", rows);
  LocalRun run;
  run.update({ path }, { "time", "id1", "id2" });
  EXPECT_EQ(run.said(),
    path +
      ": the rows have no header with a timestep or a box: all rows of the file are one frame\n");
  ASSERT_EQ(run.size(), 1u);
  EXPECT_EQ(run.columns(), (std::vector<std::string>{ "column1", "column2", "column3" }));
  const granular::Table frame = run.read(0, {}, { "time", "id1", "id2" });
  EXPECT_EQ(frame.header.counted, "ENTRIES");
  EXPECT_FALSE(frame.header.has_box);
  const auto ids = values<std::int64_t>(frame, "id2");
  EXPECT_EQ(
    std::vector(ids.begin(), ids.end()), (std::vector<std::int64_t>{ 5471, 1931, 1815, 1816 }));
  write_text("broken.txt", rows + "301 1 2 \n");
  run.update({ path }, { "time", "id1", "id2" });
  EXPECT_EQ(run.read(0, {}, { "time", "id1", "id2" }).rows, 5);
  EXPECT_NE(error_of([&] { run.update({ path }); }), "") << "named no more";
  run.update({ write_text("bonds_20.txt", "1 2 \n"), write_text("bonds_5.txt", "1 2 \n3 4 \n") },
    { "id1", "id2" });
  ASSERT_EQ(run.size(), 2u);
  EXPECT_EQ(run.step(0), 5);
  EXPECT_EQ(run.read(0, {}, { "id1", "id2" }).rows, 2);
  // pieces are no frames of their own
  LocalRun pieces;
  pieces.update(piece_files("3000"), { "pos", "id", "force" });
  EXPECT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces.read(0).rows, LocalRun(piece_files("3000")).read(0).rows);
}

// Old programs name no columns, and an empty frame does not even tell their number.
TEST(LocalFile, HeadersWithoutNames)
{
  const std::string path = write_text("old.dump",
    local_frame("", {}, "") + local_frame("", { "1 1 5 10", "2 1 11 45" }, "", "ENTRIES", 100));
  LocalRun run({ path });
  ASSERT_EQ(run.size(), 2u);
  EXPECT_EQ(run.found(1), "column1 column2 column3 column4");
  const std::string map = "bond_id btype id1 id2";
  for (const std::size_t frame : { std::size_t{ 0 }, std::size_t{ 1 } })
  {
    const std::vector<std::string> names = granular::name_columns(run.columns(frame), map);
    EXPECT_EQ(granular::join_words(names), map);
    const granular::Table table = run.read(frame, {}, names);
    EXPECT_EQ(table.arrays.size(), 4u);
    EXPECT_EQ(values<std::int64_t>(table, "id2").size(), 2 * frame);
  }
  EXPECT_EQ(granular::join_words(granular::name_columns({}, granular::local_presets()[0])),
    "id1 id2 btype");
}

// Rows of several timesteps, one behind the other, cannot be told apart.
TEST(LocalFile, PiecesOfSeveralFramesAreLeftOut)
{
  std::vector<std::string> files;
  for (int process = 0; process < 4; ++process)
  {
    files.push_back(local_file("nostar." + std::to_string(process) + ".dump"));
  }
  const std::string error = opening_error(files);
  EXPECT_EQ(error.substr(0, error.find(',')), files[2] + ": expected a header")
    << "of 1 and 3 there are no rows";
  EXPECT_EQ(LocalRun({ files[0] }).size(), 3u);
}

// What one process has written, alone, is said to be that.
TEST(LocalFile, OneOfSeveralPieces)
{
  LocalRun run({ piece_files("3000")[0] });
  EXPECT_EQ(run.size(), 1u);
  EXPECT_NE(run.said().find("this has the rows of one process alone"), std::string::npos);
  LocalRun all(piece_files("3000"));
  EXPECT_EQ(all.said(), "");
  LocalRun other({ local_file("contacts.dump") });
  EXPECT_EQ(other.said(), "");
}

// A run that was done again, under a name with another number, has the same rows: they do not count twice.
TEST(LocalFile, FilesWithTheSameRowsAreNoPieces)
{
  const std::string text = local_frame("id1 id2 btype", { "1 2 1", "2 3 1" }, "", "BONDS") +
    local_frame("id1 id2 btype", { "1 2 1", "2 3 1", "3 4 1" }, "", "BONDS", 10);
  const std::vector<std::string> again = { write_text("again_0.dump", text),
    write_text("again_1.dump", text), write_text("again_2.dump", text) };
  LocalRun run(again);
  ASSERT_EQ(run.size(), 2u);
  EXPECT_EQ(run.pieces(1), 1u);
  EXPECT_EQ(run.read(1).rows, 3);
  const auto piece = [](int from)
  {
    const std::string a = std::to_string(from) + " " + std::to_string(from + 1) + " 1";
    return local_frame("id1 id2 btype", { a }, "", "BONDS") +
      local_frame("id1 id2 btype", { a, "7 8 1" }, "", "BONDS", 10);
  };
  LocalRun pieces({ write_text("piece_0.dump", piece(1)), write_text("piece_1.dump", piece(3)) });
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces.read(0).rows, 2) << "LAMMPS has a header in each";
}

TEST(LocalFile, PiecesWithOtherColumns)
{
  const std::string head =
    write_text("other_5.0.dump", local_frame("id1 id2 btype", { "1 2 1" }, "", "BONDS", 5));
  const std::string rows = write_text("other_5.1.dump", "\n3 4 \n");
  EXPECT_EQ(opening_error({ head, rows }),
    rows +
      ": expected rows of 3 columns, as the file with 0 in its name has, got 2; they are left "
      "out, and so is what they belong to");
  LocalRun good({ head, write_text("other_5.1.dump", "\n3 4 1 \n") });
  EXPECT_EQ(good.read(0).rows, 2);
}

// A header that comes later, and rows that do.
TEST(LocalFile, PiecesThatGrow)
{
  const std::string rows = write_text("grow_5.1.dump", "3 4 1 \n");
  EXPECT_NE(opening_error({ rows }), "");
  const std::string head =
    write_text("grow_5.0.dump", local_frame("id1 id2 btype", { "1 2 1" }, "", "BONDS", 5));
  LocalRun run({ head, rows });
  EXPECT_EQ(run.read(0).rows, 2);
  EXPECT_EQ(run.step(0), 5);
  write_text("grow_5.1.dump", "3 4 1 \n5 6 1 \n7 8");
  run.update({ head, rows });
  EXPECT_EQ(run.read(0).rows, 3) << "the last line is not complete";
  write_text("grow_5.0.dump", local_frame("id1 id2 btype", { "1 2 1", "2 3 1" }, "", "BONDS", 5));
  run.update({ head, rows });
  EXPECT_EQ(run.read(0).rows, 4);
  const granular::Table frame = run.read(0);
  const auto ids = values<std::int64_t>(frame, "id2");
  EXPECT_EQ(std::vector(ids.begin(), ids.end()), (std::vector<std::int64_t>{ 2, 3, 4, 6 }));
  write_text("grow_5.1.dump", "3 4 \n");
  EXPECT_NE(error_of([&] { run.update({ head, rows }); }), "") << "of other columns";
  write_text("grow_5.1.dump", "3 4 1 \n");
  run.update({ head, rows });
  EXPECT_EQ(run.read(0).rows, 3);
}

// A label of several words, and one like a section.
TEST(LocalFile, Labels)
{
  for (const char* label : { "FORCE CHAINS", "entries", "BONDS", "ATOMS OF BONDS" })
  {
    const std::string path = write_text("label.dump",
      local_frame("id1 id2", { "1 2", "3 4" }, "BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1", label) +
        local_frame("id1 id2", { "5 6" }, "BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1", label, 1));
    LocalRun run({ path });
    EXPECT_EQ(run.size(), 2u) << label;
    EXPECT_EQ(run.read(0).rows, 2) << label;
    EXPECT_EQ(run.said(), "") << label;
  }
}

TEST(LocalFile, BadInput)
{
  EXPECT_EQ(text_error(""),
    ": expected a dump of local data, got an empty file: its program has written nothing to it "
    "yet");
  EXPECT_EQ(text_error("Step Atoms KinEng\n"),
    ": expected a dump of local data, got a thermo table: vtkgranular.read_log reads it in Python");
  EXPECT_EQ(text_error("a data file\n\n2 atoms\n1 bonds\n"),
    ":1: expected ITEM: TIMESTEP, UNITS or TIME, got 'a data file'");
  EXPECT_EQ(text_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\n"),
    ":3: expected ITEM: NUMBER OF ENTRIES, or of other things than ATOMS, got 'ITEM: NUMBER OF "
    "ATOMS'");
  EXPECT_EQ(text_error(local_frame("id1 id2", { "1 2" }).substr(0, 90)),
    ":1: expected a complete frame, got the end of the file in its header");
  EXPECT_EQ(text_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF BONDS\n2\nITEM: BONDS a b\n1 2\n"),
    ":1: expected 2 rows, got 1");
  EXPECT_EQ(text_error("ITEM: TIMESTEP\n0\nITEM: NUMBER OF BONDS\n-3\n"),
    ":4: expected a number of rows >= 0, got '-3'");
  EXPECT_EQ(text_error("1 2\n3 4\nITEM: TIMESTEP\n"),
    ":3: expected rows without a header to the end of the file, got 'ITEM: TIMESTEP'");
}
