// SPDX-License-Identifier: BSD-3-Clause
// Atom styles: from the file, from the user, from the rows.
#include "data_run.h"

namespace
{
/// The arrays of one row, and what was said.
std::string read_row(const std::string& row, const std::string& style,
  const std::string& asked = "", const std::string& more = "")
{
  DataRun run(write_data(data_text(1, "Atoms" + style + "\n\n" + row + "\n\n" + more)));
  const std::string names = names_of(run.read({}, { .atom_style = asked }).rows);
  return names + (run.said().empty() ? "" : "; " + run.said());
}

std::string error(const std::string& row, const std::string& style, const std::string& asked = "")
{
  return data_error(data_text(1, "Atoms" + style + "\n\n" + row + "\n"), { .atom_style = asked });
}
}

TEST(AtomStyles, OfTheFile)
{
  EXPECT_EQ(read_row("1 2 3 4 5", " # atomic"), "id type");
  EXPECT_EQ(read_row("1 2 0.5 3 4 5", " # charge"), "id type q");
  EXPECT_EQ(read_row("1 7 2 3 4 5", "# bond"), "id mol type");
  EXPECT_EQ(read_row("1 7 2 3 4 5 0 0 1", " #molecular"), "id mol type image");
  EXPECT_EQ(read_row("1 7 2 -0.5 3 4 5", " # full"), "id mol type q");
  EXPECT_EQ(read_row("1 2 0.3 2500 3 4 5", " # sphere"), "id type diameter density radius");
  EXPECT_EQ(read_row("1 2 1 2500 3 4 5", " # ellipsoid"), "id type ellipsoidflag density");
}

TEST(AtomStyles, OfTheUser)
{
  EXPECT_EQ(read_row("1 2 0.3 2500 3 4 5", "", "sphere"), "id type diameter density radius");
  EXPECT_EQ(
    read_row("1 2 0.3 2500 3 4 5", " # hybrid", "granular"), "id type diameter density radius");
  EXPECT_EQ(
    read_row("1 7 2 2500 3 4 5", " # sphere", "full"), "id mol type q"); // whatever the file says
  EXPECT_EQ(read_row("1 2 3 4 5", " # atomic", "automatic"), "id type");
}

TEST(AtomStyles, OfTheRows)
{
  EXPECT_EQ(read_row("1 2 3 4 5", ""),
    "id type; the atom style is not in the file: the columns are taken for those of atomic, id "
    "type x y z; if they "
    "are others, set AtomStyle\n");
  EXPECT_EQ(read_row("1 2 3.5 4 5 0 0 0", "").substr(0, 14), "id type image;");
  EXPECT_EQ(read_row("1 2 0.5 3 4 5", "").substr(0, 9), "id type q"); // mol, type: integers
  EXPECT_EQ(read_row("1 2 3.0e-1 2500 3 4 5", "").substr(0, 16),
    "id type diameter"); // as LIGGGHTS writes them
  const std::string spins = "Velocities\n\n1 0 0 0 0 0 0\n";
  EXPECT_EQ(read_row("1 2 0.3 2500 3 4 5", "", "", spins).substr(0, 16), "id type diameter");
}

TEST(AtomStyles, Errors)
{
  const std::string none =
    ":9: expected the atom style as in 'Atoms # sphere', got none, and rows of ";
  EXPECT_EQ(error("1 2 3 4 5 6", ""),
    none + "6 words; those of charge bond angle molecular fit all rows: set AtomStyle");
  EXPECT_EQ(error("1 2 1 2500 3 4 5", ""), // no ellipsoid in the header
    none + "7 words; those of full sphere granular fit all rows: set AtomStyle");
  EXPECT_EQ(error("1 2 3 4", ""),
    none + "4 words; none that is known fits all rows: set AtomStyle, or make a dump of the file");
  EXPECT_EQ(error("1 2 3 4 5", " # atomic", "sphere"),
    ":9: expected rows of 7 or 10 words, as atom style sphere has them (id type diameter density x "
    "y z, and image counts), got 5");
  const std::string unknown = error("1 2 3 4 5", "", "spheres");
  EXPECT_EQ(
    unknown.find(":9: expected an atom style of atomic charge bond angle molecular full "), 0u);
  EXPECT_NE(unknown.find("hybrid, got 'spheres'; those of atomic fit all rows: set AtomStyle"),
    unknown.npos);
}
