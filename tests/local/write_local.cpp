// SPDX-License-Identifier: BSD-3-Clause
// Dumps of local data: rows that are no particles.
#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "text_frames.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace
{
using namespace granular;

DumpFormat local(Dialect dialect, const std::string& counted = "ENTRIES")
{
  DumpFormat format;
  format.style = DumpStyle::Local;
  format.dialect = dialect;
  format.counted = counted;
  format.numbers.digits = 6;
  return format;
}

/// A frame of a file, with its columns as arrays: those of a compute as one, as c_fc of c_fc[1] .. c_fc[12], or each by
/// itself.
struct Table
{
  explicit Table(TextFrame read, bool together)
    : text(std::move(read))
  {
    view.header.timestep = text.timestep;
    view.header.box = Box::from_bounds(
      { text.lo[0], text.lo[1], text.lo[2] }, { text.hi[0], text.hi[1], text.hi[2] });
    view.header.box.boundary = text.boundary;
    view.rows = static_cast<std::int64_t>(text.rows.size());
    view.columns = text.columns;
    for (std::size_t begin = 0, end = 0; begin < text.columns.size(); begin = end)
    {
      const auto base = [&](std::size_t column)
      { return text.columns[column].substr(0, text.columns[column].find('[')); };
      const bool joins = together && text.columns[begin].ends_with("[1]");
      for (++end; joins && end < text.columns.size() && base(end) == base(begin); ++end)
      {
      }
      std::vector<double>& values = arrays.emplace_back();
      for (const std::vector<double>& row : text.rows)
      {
        values.insert(values.end(), row.begin() + static_cast<std::ptrdiff_t>(begin),
          row.begin() + static_cast<std::ptrdiff_t>(end));
      }
      view.arrays.push_back(view_rows(end - begin > 1 ? base(begin) : text.columns[begin],
        ValueType::Float64, values.data(), static_cast<int>(end - begin)));
    }
  }

  TextFrame text;
  std::vector<std::vector<double>> arrays;
  FrameView view;
};

struct Tables
{
  explicit Tables(const std::string& file, bool together = true)
  {
    for (TextFrame& frame : read_text_frames(GRANULAR_DATA "/good/local/" + file))
    {
      tables.emplace_back(std::move(frame), together);
      views.push_back(tables.back().view);
    }
  }

  std::vector<Table> tables;
  Frames views;
};

struct RealFile
{
  const char* name;
  Dialect dialect;
  const char* counted;
};

constexpr RealFile real_files[] = {
  { "contacts.dump", Dialect::Liggghts, "ENTRIES" },
  { "all.dump", Dialect::Liggghts, "ENTRIES" },
  { "label.dump", Dialect::Liggghts, "CONTACTS" },
  { "chain_bonds.dump", Dialect::Lammps, "BONDS" },
};

std::string bytes_of(const RealFile& file)
{
  return data_file(std::string("good/local/") + file.name);
}

// ---- real files --------------------------------------------------------------------------------

TEST(WriteLocal, RealFilesByteByByte)
{
  const Folder folder;
  for (const RealFile& file : real_files)
  {
    for (const bool together : { true, false })
    {
      const Tables tables(file.name, together);
      DumpFormat format = local(file.dialect, file.counted);
      for (const bool chosen : { false, true })
      {
        format.columns = chosen ? tables.views.back().columns : std::vector<std::string>();
        const Written written = write_dump(folder.path("again"), tables.views, format);
        EXPECT_EQ(written.error, "");
        EXPECT_EQ(written.said, "");
        EXPECT_EQ(difference(written.bytes, bytes_of(file)), "") << file.name;
      }
    }
  }
}

TEST(WriteLocal, AnyRanksAndThreadsGiveTheSameBytes)
{
  const Folder folder;
  for (const RealFile& file : real_files)
  {
    const Tables tables(file.name);
    const DumpFormat format = local(file.dialect, file.counted);
    for (const ParallelMode mode : { ParallelMode::Gather, ParallelMode::MpiIo })
    {
      for (const std::vector<std::int64_t>& shares : std::vector<std::vector<std::int64_t>>{
             { 1000 }, { 7, 1000 }, { 0, 20, 1000 }, { knows_nothing, 3, knows_nothing } })
      {
        WriteOptions options;
        options.mode = mode;
        options.threads = 2;
        const Written written =
          write_dump(folder.path("ranks"), cut(tables.views, shares), format, options);
        EXPECT_EQ(written.error, "");
        EXPECT_EQ(difference(written.bytes, bytes_of(file)), "") << file.name;
      }
    }
  }
}

TEST(WriteLocal, FilesOfRanksAndStepsHaveHeadersOfTheirOwn)
{
  const Folder folder;
  const Tables tables("contacts.dump");
  const Written written = write_dump(folder.path("part_*.%.dump"),
    cut({ tables.views[1], tables.views[2] }, { 3, 1000 }), local(Dialect::Liggghts));
  EXPECT_EQ(written.error, "");
  const std::map<std::string, std::size_t> rows = { { "part_1000.0.dump", 3 },
    { "part_1000.1.dump", 1 }, { "part_2000.0.dump", 3 }, { "part_2000.1.dump", 32 } };
  for (const auto& [name, count] : rows)
  {
    const std::vector<TextFrame> frames = read_text_frames(folder.path(name));
    ASSERT_EQ(frames.size(), 1u) << name;
    EXPECT_EQ(frames[0].rows.size(), count) << name;
    EXPECT_EQ(frames[0].columns, tables.views[1].columns) << name;
  }
}

// ---- made by hand ------------------------------------------------------------------------------

struct Made
{
  std::vector<std::int64_t> first = { 1000001, 2147483649, 9007199254740993 };
  std::vector<double> second = { 1000002, 2147483650, 9007199254740990 };
  std::vector<double> force = { 1, 2, 3, 4.5, -0.25, 1e-7, 1234567, 0, 7 };
  std::vector<std::string> kinds = { "soft", "hard", "soft" };

  FrameView view() const
  {
    FrameView view;
    view.header.timestep = 5;
    view.header.box = Box::from_bounds({ 0, 0, 0 }, { 1, 2, 3 });
    view.header.box.boundary = "pp pp ff";
    view.rows = 3;
    view.arrays.push_back(view_rows("id1", ValueType::Int64, first.data()));
    view.arrays.push_back(view_rows("id2", ValueType::Float64, second.data()));
    view.arrays.push_back(view_rows("force", ValueType::Float64, force.data(), 3));
    return view;
  }
};

const std::string box_lines = "ITEM: BOX BOUNDS pp pp ff\n0 1\n0 2\n0 3\n";

/// An error has the name of the file without its folder.
Written write(const FrameView& view, const DumpFormat& format)
{
  const Folder folder;
  const std::string path = folder.path("local");
  Written written = write_dump(path, Frames{ view }, format);
  if (written.error.starts_with(path + ": "))
  {
    written.error = "local: " + written.error.substr(path.size() + 2);
  }
  return written;
}

/// Ends of lines that %g moves by more than 1e-4 of the box.
TEST(WriteLocal, LostDigitsOfEndsAreTold)
{
  const std::vector<double> ends = { 1e6, 0.5, 0.25, 1e6 + 0.5, 1, 1, 1e6 + 1, 1, 1 };
  Made made;
  FrameView view = made.view();
  view.header.box = Box::from_bounds({ 1e6, 0, 0 }, { 1e6 + 1, 2, 3 });
  view.header.box.boundary = "pp pp ff";
  view.arrays.push_back(view_rows("position1", ValueType::Float64, ends.data(), 3));
  view.arrays.back().columns = { "x1", "y1", "z1" };
  view.arrays.back().places = true;
  DumpFormat format = local(Dialect::Lammps, "BONDS");
  EXPECT_EQ(write(view, format).said,
    "rounding to %g moves ends of lines by up to 1 along x, where the box is 1 long; "
    "NumberFormat=%.17g keeps all digits\n");
  format.numbers = { 17 };
  EXPECT_EQ(write(view, format).said, "");
  format.dialect = Dialect::Liggghts; // whose box has all digits, as six are too few
  EXPECT_NE(write(view, format).bytes.find("\n1e+06 1000001\n0 2\n"), std::string::npos);
}

TEST(WriteLocal, ColumnsAreArraysByTheirNames)
{
  const Made made;
  FrameView view = made.view();
  view.arrays.push_back(view_rows("kind of it", ValueType::Text, made.kinds.data()));
  view.arrays.push_back(view_rows("x", ValueType::Float64, made.second.data())); // no coordinate
  DumpFormat format = local(Dialect::Lammps);
  format.columns = { "force[3]", "x", "kind_of_it", "force", "id1" };
  format.numbers.digits = 10;
  const Written written = write(view, format);
  EXPECT_EQ(written.error, "");
  EXPECT_EQ(written.bytes,
    "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ENTRIES\n3\nITEM: BOX BOUNDS pp pp ff\n"
    "0.0000000000000000e+00 1.0000000000000000e+00\n"
    "0.0000000000000000e+00 2.0000000000000000e+00\n"
    "0.0000000000000000e+00 3.0000000000000000e+00\n"
    "ITEM: ENTRIES force[3] x kind_of_it force[1] force[2] force[3] id1 \n"
    "3 1000002 soft 1 2 3 1000001 \n"
    "1e-07 2147483650 hard 4.5 -0.25 1e-07 2147483649 \n"
    "7 9.007199255e+15 soft 1234567 0 7 9007199254740993 \n");
}

TEST(WriteLocal, NamesOfParticleColumnsMeanNothing)
{
  const Made made;
  DumpFormat format = local(Dialect::Liggghts);
  FrameView view = made.view();
  view.arrays.push_back(view_rows("f", ValueType::Float64, made.force.data(), 3));
  for (const char* name : { "id", "type", "x", "ix", "fx", "diameter" })
  {
    format.columns = { name };
    EXPECT_EQ(write(view, format).error,
      "column '" + std::string(name) +
        "': expected an array to make it from, got none: there are id1, id2, force, f");
  }
  format.columns = { "f" };
  EXPECT_NE(
    write(view, format).bytes.find("ITEM: ENTRIES f[1] f[2] f[3] \n1 2 3 \n"), std::string::npos);
}

TEST(WriteLocal, NoBox)
{
  const Made made;
  FrameView view = made.view();
  view.has_box = false;
  DumpFormat format = local(Dialect::Lammps);
  format.columns = { "id1" };
  const std::string expected = "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ENTRIES\n3\nITEM: ENTRIES id1 \n"
                               "1000001 \n2147483649 \n9007199254740993 \n";
  const Written written = write(view, format);
  EXPECT_EQ(written.error, "");
  EXPECT_EQ(written.said, "");
  EXPECT_EQ(written.bytes, expected);
  const Folder folder;
  EXPECT_EQ(write_dump(folder.path("ranks"), cut({ view }, { knows_nothing, 1, 2 }), format).bytes,
    expected);
}

TEST(WriteLocal, NoRows)
{
  const Made made;
  FrameView view = rows_of(made.view(), 0, 0);
  const std::string head =
    "ITEM: TIMESTEP\n5\nITEM: NUMBER OF CONTACTS\n0\n" + box_lines + "ITEM: CONTACTS ";
  DumpFormat format = local(Dialect::Liggghts, "CONTACTS");
  EXPECT_EQ(write(view, format).bytes, head + "id1 id2 force[1] force[2] force[3] \n");
  // without arrays, too, as filters leave nothing
  view.arrays.clear();
  view.columns = { "c_fc[1]", "c_fc[2]" };
  EXPECT_EQ(write(view, format).bytes, head + "c_fc[1] c_fc[2] \n");
  format.columns = { "id1", "anything" };
  EXPECT_EQ(write(view, format).bytes, head + "id1 anything \n");
  format.columns.clear();
  view.columns.clear();
  EXPECT_EQ(write(view, format).error, "expected at least one column, got none");
}

// ---- errors ------------------------------------------------------------------------------------

TEST(WriteLocal, WhatRowsAreCalled)
{
  const Made made;
  // unless one word is given, that of the file that they are from
  FrameView view = made.view();
  for (const char* of_file : { "ATOMS", "BONDS", "BOND ENTRIES" })
  {
    view.header.counted = of_file;
    const std::string expected = of_file == std::string("ATOMS") ? "ENTRIES" : of_file;
    EXPECT_NE(
      write(view, local(Dialect::Lammps, "")).bytes.find("ITEM: NUMBER OF " + expected + "\n3\n"),
      std::string::npos);
  }
  // it is nothing to dumps of particles, whose rows are atoms
  view.points = view_rows("points", ValueType::Float64, made.force.data(), 3);
  DumpFormat custom = local(Dialect::Lammps, "");
  custom.style = DumpStyle::Custom;
  view.header.counted = "BONDS";
  EXPECT_NE(write(view, custom).bytes.find("ITEM: NUMBER OF ATOMS\n3\n"), std::string::npos);
}

TEST(WriteLocal, Errors)
{
  const Made made;
  DumpFormat format = local(Dialect::Lammps);
  format.columns = { "id1", "force[4]" };
  EXPECT_EQ(write(made.view(), format).error,
    "column 'force[4]': expected an array to make it from, got none: there are id1, id2, force");
  format.columns = { "two words" };
  const FrameView nothing;
  EXPECT_EQ(
    write(nothing, format).error, "expected the name of a column as one word, got 'two words'");
  format = local(Dialect::Lammps);
  format.binary = true;
  EXPECT_EQ(write(made.view(), format).error,
    "local: expected text for local data, got a binary dump: no program reads that");
  // other arrays on another rank
  FrameView other = rows_of(made.view(), 1, 2);
  other.arrays.pop_back();
  const Folder folder;
  EXPECT_EQ(
    write_dump(folder.path("ranks"),
      std::vector<Frames>{ { rows_of(made.view(), 0, 1) }, { other } }, local(Dialect::Lammps))
      .error,
    "column 'force[1]': expected an array to make it from, got none: there are id1, id2 (on rank 1 "
    "of 2)");
}
}
