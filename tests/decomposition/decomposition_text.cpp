// SPDX-License-Identifier: BSD-3-Clause
// The text of decompositions: the bytes of LIGGGHTS, and those that VTK's own writer makes of the same cells.
#include "granular/formats/decomposition/decomposition_text.h"

#include "../grid/made_subdomains.h"
#include "../support/error_of.h"
#include "../support/hard_case.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>
#include <string>

using namespace granular;

namespace
{
std::string data_file(const std::string& name)
{
  std::ifstream file(std::string(GRANULAR_DATA) + "/good/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return { std::istreambuf_iterator<char>(file), {} };
}

std::string voxels_of(const Decomposition& decomposition)
{
  Progress progress;
  return encode_voxels(decomposition, progress);
}

std::string grid_of(const Subdomains& subdomains)
{
  Notices notices;
  return encode_grid({ subdomains }, notices);
}

/// What is said of slabs between these cuts along an axis, without its end.
std::string said_of(const std::vector<double>& cuts, std::size_t axis = 0)
{
  Subdomains slabs(cuts.size() - 1, made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }));
  for (std::size_t i = 0; i < slabs.size(); ++i)
  {
    slabs[i].lo[axis] = cuts[i];
    slabs[i].hi[axis] = cuts[i + 1];
  }
  Notices notices;
  encode_grid({ slabs }, notices);
  if (notices.empty())
  {
    return "";
  }
  EXPECT_EQ(notices.size(), 1u);
  const std::string begin = "six decimals, which is what LIGGGHTS-PUBLIC writes, are few along ";
  const std::string end = "; the dialect INL keeps all digits";
  const std::string text = to_string(notices[0]);
  EXPECT_TRUE(text.starts_with(begin) && text.ends_with(end)) << text;
  return text.substr(begin.size(), text.size() - begin.size() - end.size());
}

/// in.settling: region block -0.05 0.05 -0.05 0.05 0 0.15, processors 2 1 2.
Subdomains settling()
{
  return { made_subdomain({ -0.05, -0.05, 0 }, { 0, 0.05, 0.075 }),
    made_subdomain({ 0, -0.05, 0 }, { 0.05, 0.05, 0.075 }),
    made_subdomain({ -0.05, -0.05, 0.075 }, { 0, 0.05, 0.15 }),
    made_subdomain({ 0, -0.05, 0.075 }, { 0.05, 0.05, 0.15 }) };
}

/// What stands after a line that begins so, up to the next letter.
std::string section(const std::string& text, const std::string& begin)
{
  const std::size_t line = text.find(begin);
  const std::size_t first = text.find('\n', line) + 1;
  return text.substr(first, text.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZnp", first) - first);
}
}

TEST(EncodeGrid, bytes_of_liggghts)
{
  Subdomains subdomains = settling();
  EXPECT_EQ(grid_of(subdomains), data_file("decomposition_1000.vtk"));
  std::shuffle(subdomains.begin(), subdomains.end(), std::mt19937(1));
  EXPECT_EQ(grid_of(subdomains), data_file("decomposition_2000.vtk"));
}

/// Numbers as printf prints them.
TEST(EncodeGrid, numbers)
{
  std::vector<double> cuts = { -1e300, -1234567.0000005, -0.5, -1e-7, 0, 5e-7, 1.5e-6, 0.1, 1e9,
    1e17, std::numeric_limits<double>::max() };
  Subdomains slabs;
  std::string expected;
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    if (i > 0)
    {
      slabs.push_back(made_subdomain({ 0, cuts[i - 1], 0 }, { 1, cuts[i], 1 }));
    }
    std::array<char, 400> text;
    expected.append(text.data(),
      static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%f ", cuts[i])));
  }
  EXPECT_EQ(grid_of(slabs),
    "# vtk DataFile Version 2.0\nLIGGGHTS mesh/gran/VTK export\nASCII\nDATASET RECTILINEAR_GRID\n"
    "DIMENSIONS 2 11 2\nX_COORDINATES 2 float\n0.000000 1.000000 \nY_COORDINATES 11 float\n" +
      expected + "\nZ_COORDINATES 2 float\n0.000000 1.000000 \n");
}

/// Binary fractions, so that what is lost is exact: 2^-21 becomes 0.000000, 2^-20 0.000001.
TEST(EncodeGrid, six_decimals)
{
  const double few = std::ldexp(1, -21);
  EXPECT_EQ(said_of({ 0, 0.5, 1 }), "");
  EXPECT_EQ(said_of({ -0.05, 0.1, 0.3 }), ""); // not what they are, but what they print as
  EXPECT_EQ(said_of({ 0, few, 1 }),
    "x: coordinates change by up to 4.76837158203125e-07, the thinnest slab has "
    "4.76837158203125e-07; 1 of 2 slabs becomes flat");
  EXPECT_EQ(said_of({ 0, 0.125 + few, 1 }, 2), "");
  EXPECT_EQ(said_of({ 0, std::ldexp(1, -12), 1 }, 1), "");           // 0.000244140625
  const std::string thin = said_of({ 0, std::ldexp(1, -15), 1 }, 1); // 0.000030517578125
  EXPECT_TRUE(thin.starts_with("y: coordinates change by up to 4.82421875")) << thin;
  EXPECT_TRUE(thin.ends_with(", the thinnest slab has 3.0517578125e-05")) << thin;
  EXPECT_EQ(said_of({ 7, 7, 8 }), ""); // flat already
  // a particle of a micrometre
  EXPECT_NE(
    said_of({ 0, 1e-7, 2e-7, 3e-7, 1 }).find("; 3 of 4 slabs become flat"), std::string::npos);
  EXPECT_EQ(error_of(
              [] {
                said_of({ 0, 1e-7, 2e-7, 3e-7, 4e-7 });
              }),
    "expected a box that six decimals, which is what LIGGGHTS-PUBLIC writes, do not make flat, got "
    "one with a length of 4e-07 along x; the dialect INL keeps all digits");
}

TEST(EncodeGrid, no_grid)
{
  Subdomains subdomains = settling();
  subdomains[1].hi[2] = subdomains[3].lo[2] = 0.08;
  EXPECT_EQ(error_of<UnsupportedError>([&] { grid_of(subdomains); }),
    "expected subdomains that form a grid, which is all that a rectilinear grid can hold, got 4 "
    "that do not");
  EXPECT_THROW(grid_of({}), UnsupportedError);
}

/// As vtkUnstructuredGridWriter (VTK 9.1, file version 4.2) writes these two cells, but for the first two lines.
TEST(EncodeVoxels, bytes_of_vtk)
{
  const Decomposition two = { { made_subdomain({ 0, 0, 0 }, { 1, 1, 0.1 }, 12, 0),
    made_subdomain({ 1, 0, 0 }, { 2, 1, 0.1 }, 30, 1) } };
  EXPECT_EQ(voxels_of(two),
    "# vtk DataFile Version 3.0\nGenerated by vtk-granular\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 16 double\n"
    "0 0 0 0 0 0.1 0 1 0 \n"
    "0 1 0.1 1 0 0 1 0 0.1 \n"
    "1 1 0 1 1 0.1 1 0 0 \n"
    "1 0 0.1 1 1 0 1 1 0.1 \n"
    "2 0 0 2 0 0.1 2 1 0 \n"
    "2 1 0.1 \n"
    "CELLS 2 18\n8 0 4 2 6 1 5 3 7 \n8 8 12 10 14 9 13 11 15 \n\n"
    "CELL_TYPES 2\n11\n11\n\n"
    "CELL_DATA 2\nFIELD FieldData 2\nnlocal 1 2 int\n12 30 \nproc 1 2 int\n0 1 \n");
}

/// Each number reads back as the same.
TEST(EncodeVoxels, exact)
{
  HardCase changed("voxels",
    "corners of any bits, also one ulp apart, written as text: not the same double when read",
    "numbers", 0);
  const double ulp = std::numeric_limits<double>::epsilon();
  Subdomains subdomains = { made_subdomain(
    { 1.0 / 3, -1e9, 0.1 }, { 1.0 / 3 + ulp, 1e-300, 5e-324 }) };
  std::mt19937_64 random(7);
  const auto any = [&]
  {
    const auto value = std::bit_cast<double>(random());
    return std::isfinite(value) ? value : 0.0;
  };
  for (int i = 0; i < 1000; ++i)
  {
    subdomains.push_back(made_subdomain({ any(), any(), any() }, { any(), any(), any() }));
  }
  std::istringstream points(section(voxels_of({ subdomains }), "POINTS"));
  for (const Subdomain& subdomain : subdomains)
  {
    for (std::size_t i = 0; i < 8; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        std::string word;
        points >> word;
        const double wanted = (i >> (2 - axis) & 1 ? subdomain.hi : subdomain.lo)[axis];
        changed.add(std::strtod(word.c_str(), nullptr) == wanted ? 0 : 1);
      }
    }
  }
}

TEST(EncodeVoxels, arrays)
{
  Decomposition some = { made_grid({ 3, 3, 1 }) };
  some.subdomains[4].particles = std::int64_t{ 1 } << 31;
  std::string text = voxels_of(some);
  EXPECT_NE(
    text.find(
      "FIELD FieldData 2\nnlocal 1 9 vtktypeint64\n0 100 200 1 2147483648 201 2 102 202 \n\n"
      "proc 1 9 int\n0 1 2 3 4 5 6 7 8 \n\n"),
    std::string::npos)
    << text;
  some.subdomains[4].particles = std::numeric_limits<std::int32_t>::max();
  EXPECT_NE(voxels_of(some).find("nlocal 1 9 int\n0 100 200 1 2147483647 "), std::string::npos);
  some.has_particles = false;
  text = voxels_of(some);
  EXPECT_NE(text.find("CELL_DATA 9\nFIELD FieldData 1\nproc 1 9 int\n"), std::string::npos);
  EXPECT_EQ(text.find("nlocal"), std::string::npos);
  some.has_ranks = false;
  EXPECT_EQ(voxels_of(some).find("CELL_DATA"), std::string::npos);
}

TEST(EncodeVoxels, a_million)
{
  const Decomposition many = { made_grid({ 1000, 1000, 1 }) };
  Stop all;
  const std::string text = encode_voxels(many, all);
  EXPECT_NE(text.find("CELLS 1000000 9000000\n"), std::string::npos);
  EXPECT_NE(text.find("\n8 7999992 7999996 7999994 7999998 7999993 7999997 7999995 7999999 \n\n"),
    std::string::npos);
  EXPECT_EQ(all.last, 1);
  for (const int reports : { 1, 2, all.reports })
  {
    Stop stopped(reports - 1);
    EXPECT_THROW(encode_voxels(many, stopped), Cancelled);
  }
}

TEST(EncodeVoxels, nothing)
{
  EXPECT_NE(voxels_of({}).find("POINTS 0 double\n"), std::string::npos);
}
