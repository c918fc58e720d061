// SPDX-License-Identifier: BSD-3-Clause
// Bonds of data files: lines between the particles.
#include "data_run.h"

namespace
{
using Numbers = std::vector<double>;
using Ids = std::vector<std::int64_t>;

Numbers lengths_of(const granular::Tables& frame)
{
  const granular::Block& block = frame.bonds.lines.lengths;
  const auto* const values = static_cast<const double*>(block.data());
  return { values, values + block.bytes() / sizeof(double) };
}

Numbers ends_of(const granular::Tables& frame)
{
  const granular::Block& block = frame.bonds.lines.points;
  const auto* const values = static_cast<const double*>(block.data());
  return { values, values + block.bytes() / sizeof(double) };
}

/// Two particles near opposite faces along x.
std::string across(const std::string& images, const std::string& bonds, int count)
{
  return data_text(3,
    "Atoms # bond\n\n5 1 1 9 5 5" + images + "\n7 1 1 1 5 5" + images + "\n9 1 1 1 6 5" + images +
      "\n\nBonds\n\n" + bonds,
    count);
}
}

TEST(DataBonds, RealFile)
{
  DataRun run(good_data("local/chain.data"));
  const granular::Tables frame = run.read();
  EXPECT_EQ(frame.rows.rows, 100);
  EXPECT_EQ(frame.bonds.rows, 96);
  EXPECT_EQ(names_of(frame.bonds), "bond_id btype id1 id2");
  const Ids first = array_of<std::int64_t>(frame.bonds, "id1");
  const Ids second = array_of<std::int64_t>(frame.bonds, "id2");
  for (std::size_t i = 0; i < 96; ++i) // four chains of 25
  {
    const auto atom = static_cast<std::int64_t>(i / 24 * 25 + i % 24 + 1);
    EXPECT_EQ(first[i], atom);
    EXPECT_EQ(second[i], atom + 1);
  }
  for (const double length : lengths_of(frame)) // also across the periodic face
  {
    EXPECT_EQ(length, 1);
  }
  EXPECT_EQ(frame.rows.header.box.boundary, "pp ff ff");
  EXPECT_EQ(frame.bonds.header.counted, "BONDS");
}

TEST(DataBonds, AcrossFaces)
{
  const std::string bonds = "1 1 5 7\n2 2 7 9\n";
  DataRun run(write_data(across("", bonds, 2)));
  granular::Request request;
  EXPECT_EQ(lengths_of(run.read(request)), (Numbers{ 8, 1 })); // nothing says that x is periodic
  const granular::DataOptions periodic = { .boundary = "p f f" };
  EXPECT_EQ(lengths_of(run.read(request, periodic)), (Numbers{ 2, 1 }));
  EXPECT_EQ(ends_of(run.read(request, periodic)), (Numbers{ 9, 5, 5, 11, 5, 5, 1, 5, 5, 1, 6, 5 }));
  request.point_origin = { 1, 0, 0 };
  EXPECT_EQ(ends_of(run.read(request, periodic)), (Numbers{ 8, 5, 5, 10, 5, 5, 0, 5, 5, 0, 6, 5 }));
  request.coordinates = granular::Coordinates::Scaled;
  request.point_origin = {};
  const granular::Tables scaled = run.read(request, periodic);
  EXPECT_EQ(ends_of(scaled)[0], 9);
  EXPECT_EQ(scaled.bonds.coordinates, granular::Coordinates::Absolute);
  request = {};
  request.periodic_lines = granular::PeriodicLines::Split;
  EXPECT_EQ(run.read(request, periodic).bonds.lines.count, 3);
  request.periodic_lines = granular::PeriodicLines::AsWritten;
  EXPECT_EQ(lengths_of(run.read(request, periodic)), (Numbers{ 8, 1 }));
}

// Particles of another step of the same file: a bond of which one is missing has no line.
TEST(DataBonds, WithoutTheirParticles)
{
  DataRun run(write_data(across("", "1 1 5 7\n2 1 8 9\n3 3 9 7\n", 3)));
  const granular::Tables frame = run.read();
  EXPECT_EQ(array_of<std::int64_t>(frame.bonds, "bond_id"), (Ids{ 1, 3 }));
  EXPECT_EQ(array_of<std::int32_t>(frame.bonds, "btype"), (std::vector<std::int32_t>{ 1, 3 }));
  EXPECT_EQ(lengths_of(frame), (Numbers{ 8, 1 }));
  EXPECT_EQ(run.said(), "bonds that are left out, as a particle of theirs is not there: 1\n");
  granular::Request request;
  request.stride = 5;
  EXPECT_EQ(run.read(request).bonds.rows, 0);
  EXPECT_EQ(run.said().find("theirs"), run.said().rfind("theirs")); // who wants few knows
  request = {};
  request.wanted_bonds = [](std::string_view name, bool) { return name == "id2"; };
  request.wanted = [](std::string_view name, bool) { return name == "type"; };
  const granular::Tables few = run.read(request);
  EXPECT_EQ(names_of(few.bonds), "id2");
  EXPECT_EQ(names_of(few.rows), "type");
  EXPECT_EQ(few.bonds.lines.count, 2);
}

TEST(DataBonds, Errors)
{
  const auto error = [](const std::string& bonds) { return data_error(across("", bonds, 2)); };
  EXPECT_EQ(error("1 1 5 7\n2 1 5\n"), ":18: expected 4 words in a row, got 3");
  EXPECT_EQ(error("1 1 5 7\n2 1 5 7.5\n"), ":18: column 'id2': expected an integer, got '7.5'");
  EXPECT_EQ(error("1 1 5 7\n2 1 x 7\n"), ":18: column 'id1': expected a number, got 'x'");
}
