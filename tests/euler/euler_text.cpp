// SPDX-License-Identifier: BSD-3-Clause
// The text of Euler cells: the bytes of LIGGGHTS, those of printf, and all digits.
#include "granular/formats/euler/euler_text.h"

#include "../support/stop.h"
#include "euler_files.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

using namespace granular;

namespace
{
std::string encoded(const EulerCells& cells, EulerDialect dialect, std::string* said = nullptr)
{
  Notices notices;
  Progress progress;
  std::string text = encode_euler(cells, dialect, notices, progress);
  if (said)
  {
    *said = lines_of(notices);
  }
  return text;
}

std::string said_of(const EulerCells& cells, EulerDialect dialect = EulerDialect::Liggghts)
{
  std::string said;
  encoded(cells, dialect, &said);
  return said;
}

/// The file as the C functions of LIGGGHTS print it.
std::string printed(const EulerCells& cells)
{
  std::string text;
  const auto print = [&](const char* format, auto... values)
  {
    std::array<char, 1200> line;
    const int size = std::snprintf(line.data(), line.size(), format, values...);
    text.append(line.data(), static_cast<std::size_t>(size));
  };
  const auto count = static_cast<int>(cells.count());
  const auto print_tuples = [&](const std::vector<double>& values, bool vectors)
  {
    for (std::size_t i = 0; i < values.size(); i += vectors ? 3 : 1)
    {
      vectors ? print("%f %f %f\n", values[i], values[i + 1], values[i + 2])
              : print("%f\n", values[i]);
    }
  };
  text = euler_header + "DATASET POLYDATA\n";
  print("POINTS %d float\n", count);
  print_tuples(cells.centres, true);
  print("VERTICES %d %d\n", count, 2 * count);
  for (int i = 0; i < count; ++i)
  {
    print("1 %d\n", i);
  }
  print("POINT_DATA %d\n", count);
  text += "VECTORS v_avg float\n";
  print_tuples(cells.velocities, true);
  text += "SCALARS volumefraction float 1\nLOOKUP_TABLE default\n";
  print_tuples(cells.volume_fraction, false);
  text += "SCALARS radius float 1\nLOOKUP_TABLE default\n";
  print_tuples(cells.radius, false);
  text += "SCALARS pressure float 1\nLOOKUP_TABLE default\n";
  print_tuples(cells.pressure, false);
  return text;
}

/// Cells with these values, one after the other, in all arrays.
EulerCells cells_with(std::vector<double> values)
{
  while (values.size() % 3 != 0)
  {
    values.push_back(0);
  }
  EulerCells cells;
  cells.resize(static_cast<std::int64_t>(values.size()));
  for (std::size_t i = 0; i < 3 * values.size(); ++i)
  {
    cells.centres[i] = values[i % values.size()];
    cells.velocities[i] = -values[i % values.size()];
  }
  cells.volume_fraction = cells.radius = cells.pressure = values;
  return cells;
}

void expect_same_text(const std::string& got, const std::string& expected)
{
  EXPECT_TRUE(got == expected) << got.substr(0, 2000) << "\n---\n" << expected.substr(0, 2000);
}
}

TEST(EncodeEuler, bytes_of_liggghts)
{
  for (const std::string name :
    { "euler_1000", "euler_2000", "euler_3000", "euler_4000", "euler/parallel_2000" })
  {
    const std::string text = data_file("good/" + name + ".vtk");
    EulerFile file(text);
    std::string said;
    expect_same_text(encoded(cells_of(file.read()), EulerDialect::Liggghts, &said), text);
    EXPECT_EQ(said, "");
  }
  expect_same_text(encoded(cells_of_two(true), EulerDialect::Liggghts),
    replaced(two_points(), "-0.000000", "0.000000"));
  expect_same_text(encoded({}, EulerDialect::Liggghts), no_points());
}

/// LIGGGHTS' text where it has the same values, all digits where it has not.
TEST(EncodeEuler, automatic)
{
  const auto expect_as = [](EulerDialect dialect, const EulerCells& cells)
  { expect_same_text(encoded(cells, EulerDialect::Automatic), encoded(cells, dialect)); };
  for (const std::string name : { "euler_1000", "euler_4000", "euler/parallel_2000" })
  {
    EulerFile file(data_file("good/" + name + ".vtk"));
    expect_as(EulerDialect::Liggghts, cells_of(file.read()));
  }
  expect_as(EulerDialect::Liggghts, {});
  expect_as(EulerDialect::Wide, cells_of_two(true)); // has stresses
  const EulerCells cells = cells_of_two(false);
  expect_as(EulerDialect::Liggghts, cells);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double value :
    { 0.000001, 0.1, -0.0, 123456.789012, 1e22, infinity, -infinity, std::nan("") })
  {
    EulerCells same = cells;
    same.pressure.back() = same.velocities.front() = value;
    expect_as(EulerDialect::Liggghts, same);
  }
  for (const double value : { 1.0 / 3, 1e-7, 5e-7, std::nextafter(0.1, 1), -5e-324 })
  {
    for (const EulerArray& array : euler_arrays())
    {
      EulerCells others = cells;
      (others.*array.values).resize(static_cast<std::size_t>(2 * array.components));
      (others.*array.values).back() = value;
      expect_as(EulerDialect::Wide, others);
    }
  }
  // centres of grids are computed: they may be between the decimals, by up to 1 % of a radius
  EulerCells moved = cells;
  moved.centres.front() += 1e-3 / 3;
  moved.radius = { 0.01, 0.01 };
  expect_as(EulerDialect::Liggghts, moved);
  moved.radius = { 0.00001, 0.00001 };
  expect_as(EulerDialect::Wide, moved);
}

TEST(EncodeEuler, bytes_of_printf)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values = { nan, -nan, infinity, -infinity, 0.0, -0.0, 1e300, -1e300,
    std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), 1e22, 1e23,
    9007199254740993.0, 0.1, 5e-7, -5e-7, 1.5e-6, 4.9999999e-7, -4e-7, 0.9999995, 0.99999949999,
    999999.9999995, 2147483647.5, 1e-300, 123456789.123456789 };
  // ties: odd multiples of 2^-7 have seven decimals, the last of them 5
  for (int i = 1; i < 400; i += 2)
  {
    values.push_back(std::ldexp(i, -7));
    values.push_back(-std::ldexp(i, -7) - 1e6);
  }
  std::mt19937_64 random(1);
  for (int i = 0; i < 30000; ++i)
  {
    values.push_back(std::bit_cast<double>(random()));
    values.push_back(std::ldexp(static_cast<double>(random() >> 11), -static_cast<int>(i % 80)));
  }
  const EulerCells cells = cells_with(values);
  expect_same_text(encoded(cells, EulerDialect::Liggghts), printed(cells));
}

TEST(EncodeEuler, all_digits)
{
  expect_same_text(encoded(cells_of_two(true), EulerDialect::Wide),
    euler_header +
      "DATASET POLYDATA\nPOINTS 2 double\n-0.25 0.5 1\n0.25 0.5 1\nVERTICES 2 4\n1 0\n1 1\n"
      "POINT_DATA 2\nVECTORS v_avg double\n1 2 3\n-0.5 0.25 0\nSCALARS volumefraction double 1\n"
      "LOOKUP_TABLE default\n0.5\n0.625\nSCALARS radius double 1\nLOOKUP_TABLE default\n0.125\n0\n"
      "SCALARS pressure double 1\nLOOKUP_TABLE default\n-100.5\n1000\nVECTORS sigma double\n"
      "1.5 2.5 3.5\n4.5 5.5 6.5\nVECTORS tau double\n-1.5 -2.5 -3.5\n-4.5 -5.5 -6.5\n");
  EulerCells cells = cells_of_two(false);
  cells.normal_stress = { 1, 2, 3, 4, 5, 6 };
  const std::string text = encoded(cells, EulerDialect::Wide);
  EXPECT_NE(text.find("sigma"), std::string::npos);
  EXPECT_EQ(text.find("tau"), std::string::npos);
}

TEST(EncodeEuler, all_digits_are_read_back)
{
  std::vector<double> values = { 1e-300, -0.0, 5e-7, 0.1, 1e300, std::nextafter(1.0, 2) };
  std::mt19937_64 random(2);
  for (int i = 0; i < 3000; ++i)
  {
    const auto value = std::bit_cast<double>(random());
    values.push_back(std::isnan(value) ? 1.0 : value);
  }
  const EulerCells cells = cells_with(values);
  EulerFile file(encoded(cells, EulerDialect::Wide));
  ASSERT_EQ(file.frames(), 1u) << file.defect();
  const EulerCells back = cells_of(file.read());
  EXPECT_EQ(back, cells);
  EXPECT_TRUE(std::signbit(back.pressure[1]));
}

/// What %f makes of a value, by printf.
double six_decimals(double value)
{
  std::array<char, 64> word;
  std::snprintf(word.data(), word.size(), "%f", value);
  return std::strtod(word.data(), nullptr);
}

/// Grains of micrometres: centres and values that become others are told, with how much.
TEST(EncodeEuler, six_decimals_may_be_few)
{
  EXPECT_EQ(said_of(cells_of_two(false)), "");
  const std::string begin = "rounding to six decimals, which is what LIGGGHTS writes, ";
  const std::string end = "; the dialect Wide keeps all digits\n";
  EulerCells cells; // a box of 1e-4, radii of 3e-6
  cells.resize(8);
  for (std::size_t i = 0; i < 8; ++i)
  {
    cells.centres[3 * i] = i % 2 == 0 ? 2.54e-5 : 7.5e-5;
    cells.centres[3 * i + 1] = i / 2 % 2 == 0 ? 2.5e-5 : 7.5e-5;
    cells.centres[3 * i + 2] = i < 4 ? 2.5e-5 : 7.5e-5;
    cells.radius[i] = 3.7e-6;
    cells.volume_fraction[i] = 0.123456;
  }
  EXPECT_EQ(six_decimals(2.54e-5), 2.5e-5);
  EXPECT_EQ(six_decimals(3.7e-6), 4e-6);
  EXPECT_EQ(said_of(cells),
    begin +
      "moves centres by up to 4e-07 along x, where the smallest radius is 3.7e-06, and "
      "changes 'radius' by up to 8.11 % of itself" +
      end);
  EXPECT_EQ(said_of(cells, EulerDialect::Wide), "");

  cells.radius.assign(8, 4e-6); // numbers that six decimals hold
  cells.centres[0] = cells.centres[6] = cells.centres[12] = cells.centres[18] = 2.5e-5;
  cells.velocities[0] = 1e-6;
  cells.pressure[3] = 2e-6;
  EXPECT_EQ(said_of(cells), "");
  cells.velocities[0] = 1.1e-6; // next to nothing beside the others of the vector
  cells.velocities[1] = 1;
  EXPECT_EQ(said_of(cells), "");
  cells.velocities[1] = 0;
  EXPECT_EQ(said_of(cells), begin + "changes 'v_avg' by up to 9.09 % of itself" + end);

  cells = {};
  cells.resize(8);
  for (std::size_t i = 0; i < 8; ++i)
  {
    cells.centres[3 * i] = 4e-7 * static_cast<double>(i % 4); // 0, 0, 1 and 1 millionths
    cells.radius[i] = 1;
  }
  EXPECT_EQ(said_of(cells),
    begin + "2 of 4 places of centres along x become equal to the one before" + end);
  for (std::size_t i = 0; i < 8; ++i)
  {
    cells.centres[3 * i + 2] = i < 4 ? 1e-7 : 3e-7;
  }
  Notices notices;
  Progress progress;
  EXPECT_EQ(error_of([&] { encode_euler(cells, EulerDialect::Liggghts, notices, progress); }),
    "expected cells that six decimals, which is what LIGGGHTS writes, tell apart, got 2 places of "
    "centres along z that all become one; the dialect Wide keeps all digits");
}

TEST(EncodeEuler, reports_and_can_be_cancelled)
{
  Stop progress;
  EulerCells cells;
  cells.resize(100'000);
  Notices notices;
  encode_euler(cells, EulerDialect::Liggghts, notices, progress);
  EXPECT_EQ(progress.last, 1);
  EXPECT_GT(progress.reports, 20);
  Stop at_once(0);
  EXPECT_THROW(encode_euler(cells, EulerDialect::Liggghts, notices, at_once), Cancelled);
}
