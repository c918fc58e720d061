// SPDX-License-Identifier: BSD-3-Clause
// Header, sections and box of data files; what is none, and what is not complete.
#include "data_run.h"

using Numbers = std::vector<double>;

TEST(DataFile, IsToldByContent)
{
  for (const char* name :
    { "local/chain.data", "data_file/sphere.data", "data_file/granular.data" })
  {
    EXPECT_TRUE(granular::is_data_file(good_data(name))) << name;
  }
  for (const char* name : { "grains.dump", "grains.bin", "local/contacts.dump", "euler_1000.vtk",
         "", "no/such", "restart/fibres.restart" })
  {
    EXPECT_FALSE(granular::is_data_file(good_data(name))) << name;
  }
  EXPECT_TRUE(granular::is_data_file(write_data("title\n\n2 atoms\n1 bonds\n")));
  EXPECT_TRUE(granular::is_data_file(write_data("\r\n2 atoms\r\n0 1 xlo xhi\r\n\r\nAtoms\r\n")));
  EXPECT_FALSE(
    granular::is_data_file(write_data("2 atoms\n0 1 xlo xhi\n"))); // the first line is a title
  EXPECT_FALSE(granular::is_data_file(write_data("title\n\nAtoms\n\n2 atoms\n0 1 xlo xhi\n")));
}

TEST(DataFile, TheTitleSaysTheTimestep)
{
  DataRun run(write_data(
    "LAMMPS data file via write_data, timestep = 2000, units = si\n\n1 atoms\n0 1 xlo xhi\n"
    "\nAtoms # atomic\n\n1 1 0.5 0 0\n"));
  EXPECT_EQ(run.step(), 2000);
  EXPECT_EQ(run.read().rows.header.units, "si");
  EXPECT_EQ(run.read().rows.header.timestep, 2000);
}

TEST(DataFile, Boxes)
{
  const auto box = [](const std::string& lines)
  { return DataRun(write_data("t\n\n0 atoms\n1 atom types\n" + lines)).read().rows.header.box; };
  const granular::Box plain = box("-1 3 xlo xhi # x\n2 4 ylo yhi\n");
  EXPECT_EQ(plain.origin[0].value(), -1);
  EXPECT_EQ(plain.vectors[0][0].value(), 4);
  EXPECT_EQ(plain.origin[2].value(), -0.5); // as LAMMPS has it where nothing is said
  EXPECT_EQ(plain.vectors[2][2].value(), 1);
  EXPECT_FALSE(plain.tilted);
  const granular::Box tilted =
    box("0 4 xlo xhi\n0 3 ylo yhi\n0 2 zlo zhi\n0.5 0.25 -0.3 xy xz yz\n");
  EXPECT_TRUE(tilted.tilted);
  EXPECT_FALSE(tilted.general);
  EXPECT_EQ(tilted.corner(0, 0, 0), (granular::Vector3{ 0, 0, 0 })); // not the bounds around it
  EXPECT_EQ(tilted.corner(1, 1, 1), (granular::Vector3{ 4.75, 2.7, 2 }));
  EXPECT_EQ(tilted.bounds().lo, (granular::Vector3{ 0, -0.3, 0 }));
  const granular::Box general = box("1 2 3 avec\n0 1 1 bvec\n1 0 5 cvec\n7 8 9 abc origin\n");
  EXPECT_TRUE(general.general);
  EXPECT_EQ(general.corner(0, 0, 0), (granular::Vector3{ 7, 8, 9 }));
  EXPECT_EQ(general.corner(1, 1, 0), (granular::Vector3{ 8, 11, 13 }));
}

// Sections in any order, comments and blank lines anywhere.
TEST(DataFile, SectionsInAnyOrder)
{
  DataRun run(write_data(
    "t\n# of two\n 2 atoms # and no more\n1 bonds\n\n0 10 xlo xhi\n\n"
    "Bonds # ids\n\n# first\n\n1 3 20 10 # only\n\nBond Coeffs # harmonic\n\n1 200 1.05\n\n"
    "Velocities\n\n10 1 2 3\n# between\n20 4 5 6\n# behind\n\n"
    "Masses\n\nC 1\n\nAtoms  # bond \n\n20 1 2 1 1 1 # a # b\n\n  # blank\n10 1 1 2 2 2\n"));
  const granular::Tables frame = run.read();
  EXPECT_EQ(names_of(frame.rows), "id mol type v");
  EXPECT_EQ(array_of<std::int64_t>(frame.rows, "id"), (std::vector<std::int64_t>{ 20, 10 }));
  EXPECT_EQ(array_of(frame.rows, "v"), (Numbers{ 4, 5, 6, 1, 2, 3 }));
  EXPECT_EQ(points_of(frame.rows), (Numbers{ 1, 1, 1, 2, 2, 2 }));
  EXPECT_EQ(array_of<std::int32_t>(frame.bonds, "btype"), (std::vector<std::int32_t>{ 3 }));
  EXPECT_EQ(frame.rows.schema.text(), "id mol type x y z vx vy vz");
  EXPECT_EQ(run.said(), "");
}

// A comment that chunks of the file begin in is one all the same.
TEST(DataFile, LongComments)
{
  std::string rows;
  for (int i = 1; i <= 200; ++i)
  {
    rows += std::to_string(i) + " 1 0.5 " + std::to_string(i) + " 0.5 #" + std::string(700, '7') +
      " 1 2\n";
  }
  DataRun run(write_data(data_text(200, "Atoms # atomic\n\n" + rows)));
  for (const std::size_t chunk : { std::size_t{ 64 }, std::size_t{ 1000 }, std::size_t{ 1 } << 18 })
  {
    granular::Request request;
    request.chunk_bytes = chunk;
    request.threads = 3;
    const Numbers points = points_of(run.read(request).rows);
    ASSERT_EQ(points.size(), 600u);
    for (std::size_t i = 0; i < 200; ++i)
    {
      EXPECT_EQ(points[3 * i + 1], static_cast<double>(i + 1));
    }
  }
  EXPECT_EQ(run.said(), "");
}

TEST(DataFile, NotComplete)
{
  const std::string atoms = "Atoms # atomic\n\n1 1 0 0 0\n2 1 0 0 1\n";
  EXPECT_EQ(
    data_error("title\n\nno atoms\n"), ":3: expected a header that counts atoms, got 'no atoms'");
  EXPECT_EQ(data_error("title\n\n2 atoms"), ":4: expected a section Atoms with 2 rows, got none");
  EXPECT_EQ(data_error("title\n\n-2 atoms\n"), ":3: expected a number of atoms, got '-2'");
  EXPECT_EQ(data_error("title\n\n2.5 atoms\n"), ":3: expected a number of atoms, got '2.5'");
  EXPECT_EQ(data_error("title\n\n2 atoms\n0 l xlo xhi\n"), ":4: expected a number, got 'l'");
  EXPECT_EQ(data_error(data_text(2, "Masses\n\n1 1\n")),
    ":12: expected a section Atoms with 2 rows, got none");
  EXPECT_EQ(data_error(data_text(3, atoms)),
    ":9: expected 3 rows in the section Atoms, got 2, then the end of the file");
  EXPECT_EQ(data_error(data_text(1, atoms)),
    ":9: expected 1 rows in the section Atoms, got 2, then the end of the file");
  EXPECT_EQ(data_error(data_text(3, atoms + "3 1 0 0")), ":13: expected 5 words in a row, got 4");
  EXPECT_EQ(data_error(data_text(3, atoms + "O3 1 0 0 2\n")),
    ":9: expected 3 rows in the section Atoms, got 2, then 'O3 1 0 0 2'");
  EXPECT_EQ(data_error(data_text(2, atoms + "\nVelocities\n\n1 0 0 0\n")),
    ":14: expected 2 rows in the section Velocities, got 1, then the end of the file");
  EXPECT_EQ(data_error(data_text(2, atoms + "\nAtoms\n\n1 0 0 0\n")),
    ":14: expected one section Atoms, got another one; the first is in line 9");
  EXPECT_EQ(
    data_error(data_text(2, atoms, 1)), ":13: expected a section Bonds with 1 rows, got none");
  EXPECT_EQ(data_error(data_text(2, atoms + "\nBonds\n\n", 1)),
    ":14: expected 1 rows in the section Bonds, got 0, then the end of the file");
}

TEST(DataFile, WithoutParticles)
{
  for (const char* sections : { "", "Atoms\n\n", "Atoms # sphere\n\nVelocities\n\nBonds\n\n" })
  {
    DataRun run(write_data(data_text(0, sections)));
    const granular::Tables frame = run.read();
    EXPECT_EQ(frame.rows.rows, 0) << sections;
    EXPECT_EQ(frame.bonds.lines.count, 0) << sections;
    EXPECT_EQ(run.said(), "") << sections;
  }
}
