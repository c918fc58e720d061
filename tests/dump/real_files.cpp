// SPDX-License-Identifier: BSD-3-Clause
// The files of tests/data/good: runs that LAMMPS and LIGGGHTS wrote in many forms at once. All forms
// must show the same particles, as far as their digits go. reader_numbers.py has every number of each file.
#include "granular/formats/dump/grammar/dump_files.h"

#include "../support/dumps.h"
#include "../support/quad.h"
#include "../support/reference_dump.h"
#include "../support/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using granular::Coordinates;
using granular::Request;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;
using Exact3 = std::array<Exact, 3>;

std::string path_of(const std::string& file)
{
  return std::string(GRANULAR_DATA) + "/good/" + file;
}

// ---- the files, read by other means ----------------------------------------------------------------

/// A frame as the numbers of a file, by the id of the particle.
struct Table
{
  std::int64_t step = 0;
  Doubles box; ///< as they stand in the file: bounds, and tilts behind them
  std::string columns;
  Integers ids; ///< in the order of the file
  std::map<std::int64_t, std::map<std::string, double>> rows;
};

void add_row(Table& table, const std::vector<std::string>& names, const Doubles& values)
{
  std::map<std::string, double> row;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    row[names[i]] = values[i];
  }
  table.ids.push_back(static_cast<std::int64_t>(row.at("id")));
  table.rows[table.ids.back()] = row;
}

std::vector<std::string> words_of(const std::string& line)
{
  std::istringstream stream(line);
  return { std::istream_iterator<std::string>(stream), {} };
}

/// The frames of a text, by the standard library.
std::vector<Table> tables_of_text(const std::string& text)
{
  std::vector<Table> tables;
  std::istringstream stream(text);
  std::string line;
  std::int64_t step = 0;
  std::size_t count = 0;
  Doubles box;
  while (std::getline(stream, line))
  {
    const auto next = [&]
    {
      std::getline(stream, line);
      return words_of(line);
    };
    const std::vector<std::string> item = words_of(line);
    if (item.at(1) == "TIMESTEP")
    {
      step = std::stoll(next().at(0));
    }
    else if (item.at(1) == "NUMBER")
    {
      count = std::stoull(next().at(0));
    }
    else if (item.at(1) == "BOX")
    {
      box.clear();
      Doubles tilts;
      for (int axis = 0; axis < 3; ++axis)
      {
        const std::vector<std::string> numbers = next();
        box.push_back(std::stod(numbers.at(0)));
        box.push_back(std::stod(numbers.at(1)));
        if (numbers.size() > 2)
        {
          tilts.push_back(std::stod(numbers[2]));
        }
      }
      box.insert(box.end(), tilts.begin(), tilts.end());
    }
    else if (item.at(1) != "ATOMS")
    {
      next(); // the value of a section of one line
    }
    else
    {
      const std::vector<std::string> names(item.begin() + 2, item.end());
      Table& table = tables.emplace_back();
      table.step = step;
      table.box = box;
      for (std::size_t row = 0; row < count; ++row)
      {
        const std::vector<std::string> words = next();
        Doubles values;
        std::transform(words.begin(), words.end(), std::back_inserter(values),
          [](const std::string& word) { return std::strtod(word.c_str(), nullptr); });
        add_row(table, names, values);
      }
    }
  }
  return tables;
}

template <typename T>
T take(const std::string& bytes, std::size_t& at)
{
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}

/// The frames of a binary dump of LAMMPS of revision 2 or, where names are given, of LIGGGHTS, on a
/// little-endian machine: what these files are, and no more.
std::vector<Table> tables_of_binary(const std::string& bytes, const std::string& names = "")
{
  std::vector<Table> tables;
  for (std::size_t at = 0; at < bytes.size();)
  {
    Table& table = tables.emplace_back();
    if (names.empty())
    {
      at += static_cast<std::size_t>(-take<std::int64_t>(bytes, at));
      EXPECT_EQ(take<std::int32_t>(bytes, at), 1);
      EXPECT_EQ(take<std::int32_t>(bytes, at), 2);
    }
    table.step = take<std::int64_t>(bytes, at);
    const auto count = take<std::int64_t>(bytes, at);
    const auto triclinic = take<std::int32_t>(bytes, at);
    at += 6 * sizeof(std::int32_t);
    for (int i = 0; i < (triclinic == 1 ? 9 : 6); ++i)
    {
      table.box.push_back(take<double>(bytes, at));
    }
    const auto columns = static_cast<std::size_t>(take<std::int32_t>(bytes, at));
    table.columns = names;
    if (names.empty())
    {
      EXPECT_EQ(take<std::int32_t>(bytes, at), 0) << "units";
      EXPECT_EQ(take<char>(bytes, at), 0) << "time";
      const auto length = static_cast<std::size_t>(take<std::int32_t>(bytes, at));
      table.columns = bytes.substr(at, length);
      at += length;
    }
    const std::vector<std::string> words = words_of(table.columns);
    EXPECT_EQ(words.size(), columns);
    for (auto chunks = take<std::int32_t>(bytes, at); chunks > 0; --chunks)
    {
      for (auto n = take<std::int32_t>(bytes, at); n > 0; n -= static_cast<std::int32_t>(columns))
      {
        Doubles values;
        for (std::size_t column = 0; column < columns; ++column)
        {
          values.push_back(take<double>(bytes, at));
        }
        add_row(table, words, values);
      }
    }
    EXPECT_EQ(static_cast<std::int64_t>(table.ids.size()), count);
  }
  return tables;
}

/// Half a unit of the last digit of a number that was printed with %g.
double half_digit(double printed)
{
  return printed == 0 ? 0 : 0.5 * std::pow(10, std::floor(std::log10(std::abs(printed))) - 5);
}

// ---- the box, in 113 bits --------------------------------------------------------------------------

struct Cell : ReferenceBox
{
  Exact3 origin;
  std::array<Exact3, 3> rows; ///< of the matrix, whose columns are the vectors a b c

  explicit Cell(const Doubles& box)
    : ReferenceBox{ { box[0], box[2], box[4] }, { box[1], box[3], box[5] } }
  {
    if (box.size() > 6)
    {
      tilted = true;
      xy = box[6];
      xz = box[7];
      yz = box[8];
    }
    origin = this->corner();
    rows = this->matrix();
  }

  /// origin (once, or not) + H s
  Exact3 cartesian(const Exact3& s, bool with_origin) const
  {
    Exact3 x;
    for (std::size_t k = 0; k < 3; ++k)
    {
      x[k] = with_origin ? origin[k] : Exact(0);
      for (std::size_t j = k; j < 3; ++j)
      {
        x[k] = x[k] + s[j] * rows[k][j];
      }
    }
    return x;
  }

  /// What errors of scaled coordinates become, and the other way round: by magnitudes.
  std::array<double, 3> spread(const std::array<double, 3>& s) const
  {
    std::array<double, 3> x = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t j = k; j < 3; ++j)
      {
        x[k] += s[j] * std::abs(static_cast<double>(rows[k][j].value));
      }
    }
    return x;
  }

  std::array<double, 3> gather(const std::array<double, 3>& x) const
  {
    std::array<double, 3> s = {};
    for (std::size_t k = 3; k-- > 0;)
    {
      s[k] = x[k];
      for (std::size_t j = k + 1; j < 3; ++j)
      {
        s[k] += s[j] * std::abs(static_cast<double>(rows[k][j].value));
      }
      s[k] /= std::abs(static_cast<double>(rows[k][k].value));
    }
    return s;
  }
};

Exact3 three(const std::map<std::string, double>& row, const std::array<const char*, 3>& names)
{
  return { row.at(names[0]), row.at(names[1]), row.at(names[2]) };
}

constexpr std::array<const char*, 3> x_names = { "x", "y", "z" };
constexpr std::array<const char*, 3> xs_names = { "xs", "ys", "zs" };
constexpr std::array<const char*, 3> xu_names = { "xu", "yu", "zu" };
constexpr std::array<const char*, 3> xsu_names = { "xsu", "ysu", "zsu" };
constexpr std::array<const char*, 3> i_names = { "ix", "iy", "iz" };
constexpr Coordinates all_coordinates[] = { Coordinates::Absolute, Coordinates::Unwrapped,
  Coordinates::Scaled };

bool is_scaled(const std::map<std::string, double>& row)
{
  return row.contains("xs");
}

/// The point that a row of a file stands for, x or xs and images, if it is there.
Exact3 point_of(const std::map<std::string, double>& row, const Cell& cell, Coordinates coordinates)
{
  const bool scaled = is_scaled(row);
  const Exact3 given = three(row, scaled ? xs_names : x_names);
  if (coordinates == Coordinates::Scaled)
  {
    return scaled ? given : cell.scaled(given);
  }
  Exact3 point = scaled ? cell.cartesian(given, true) : given;
  if (coordinates == Coordinates::Unwrapped)
  {
    const Exact3 shift = cell.cartesian(three(row, i_names), false);
    for (std::size_t k = 0; k < 3; ++k)
    {
      point[k] = point[k] + shift[k];
    }
  }
  return point;
}

// ---- the same run in every form ----------------------------------------------------------------------

/// What a file of a run is made of.
struct Form
{
  const char* file; ///< behind "ortho_" or "tri_"
  bool images;
};

constexpr Form texts[] = {
  { "scaled.dump", false },
  { "plain.dump", false },
  { "image.dump", true },
  { "scaled_image.dump", true },
};

constexpr Form binaries[] = {
  { "scaled.bin", false },
  { "image.bin", true },
  { "custom.bin", false },
};

std::vector<Table> exact_tables(const std::string& run)
{
  return tables_of_text(data_file("good/" + run + "_unwrapped.dump"));
}

Decoded read(const Dump& dump, std::size_t frame, Coordinates coordinates)
{
  Request request;
  request.coordinates = coordinates;
  return dump.read(request, frame);
}

/// Calls compare(id, point, exact row) for all particles of a frame.
template <typename Compare>
void for_points(const Decoded& frame, const Table& exact, const Compare& compare)
{
  const Integers ids = frame.integers("id");
  const Doubles points = frame.points();
  ASSERT_EQ(ids.size(), exact.rows.size());
  EXPECT_EQ(std::set<std::int64_t>(ids.begin(), ids.end()).size(), ids.size());
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    ASSERT_TRUE(exact.rows.contains(ids[row]));
    compare(ids[row], std::span<const double, 3>(points.data() + 3 * row, 3));
  }
}

/// The 17 digits are those of the doubles in LAMMPS' memory: x is that, exactly, and so are the image
/// counts; the other forms of the text are what LAMMPS made of it in a few operations.
Exact3 true_point(const Table& exact, std::int64_t id, const Cell& cell, Coordinates coordinates)
{
  std::map<std::string, double> row = exact.rows.at(id);
  row.erase("xs");
  return point_of(row, cell, coordinates);
}

/// How far a point may be from the truth if coordinates in the file are %g.
std::array<double, 3> allowance(
  const std::map<std::string, double>& printed, const Cell& cell, Coordinates coordinates)
{
  const bool scaled = is_scaled(printed);
  std::array<double, 3> digits = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    digits[k] = half_digit(printed.at((scaled ? xs_names : x_names)[k]));
  }
  const bool to_scaled = coordinates == Coordinates::Scaled;
  std::array<double, 3> all = scaled == to_scaled ? digits
    : scaled                                      ? cell.spread(digits)
                                                  : cell.gather(digits);
  for (double& one : all)
  {
    one += 1e-14; // rounding in doubles, here and in LAMMPS: coordinates are below 16
  }
  return all;
}

void expect_text_form(const std::string& text, const std::string& run, bool images,
  const std::vector<Table>& exact, const Dump& dump)
{
  const std::vector<Table> printed = tables_of_text(text);
  ASSERT_EQ(printed.size(), exact.size());
  ASSERT_EQ(dump.frames(), exact.size());
  for (std::size_t frame = 0; frame < exact.size(); ++frame)
  {
    EXPECT_EQ(dump.entry(frame).timestep, exact[frame].step);
    EXPECT_EQ(printed[frame].box, exact[frame].box);
    const Cell cell(exact[frame].box);
    for (const Coordinates coordinates : all_coordinates)
    {
      if (coordinates == Coordinates::Unwrapped && !images)
      {
        continue;
      }
      SCOPED_TRACE(run + " " + std::to_string(frame) + " " + to_string(coordinates));
      const Decoded got = read(dump, frame, coordinates);
      EXPECT_EQ(got.said(), "");
      EXPECT_EQ(got.frame.header.box.boundary, "pp pp pp");
      for_points(got, exact[frame],
        [&](std::int64_t id, std::span<const double, 3> point)
        {
          const Exact3 truth = true_point(exact[frame], id, cell, coordinates);
          const auto allowed = allowance(printed[frame].rows.at(id), cell, coordinates);
          for (std::size_t k = 0; k < 3; ++k)
          {
            const auto value = static_cast<double>(truth[k].value);
            ASSERT_LE(std::abs(point[k] - value), allowed[k]) << id << " " << k << " " << value;
          }
        });
    }
  }
}

void expect_types(const Decoded& frame, const std::map<std::int64_t, std::int64_t>& types)
{
  const Integers ids = frame.integers("id");
  const Integers got = frame.integers("type");
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    ASSERT_EQ(got[row], types.at(ids[row])) << ids[row];
  }
}

std::map<std::int64_t, std::int64_t> types_of(const std::string& run)
{
  std::map<std::int64_t, std::int64_t> types;
  const std::vector<Table> tables = tables_of_text(data_file("good/" + run + "_plain.dump"));
  for (const auto& [id, row] : tables[0].rows)
  {
    types[id] = static_cast<std::int64_t>(row.at("type"));
  }
  return types;
}
}

TEST(RealFiles, TextsShowTheRunToTheirDigits)
{
  for (const std::string run : { "ortho", "tri" })
  {
    const std::vector<Table> exact = exact_tables(run);
    ASSERT_EQ(exact.size(), 2u);
    for (const Form& form : texts)
    {
      const std::string text = data_file("good/" + run + "_" + form.file);
      const Dump dump(text);
      EXPECT_EQ(dump.said(), "");
      expect_text_form(text, run + "_" + form.file, form.images, exact, dump);
      expect_types(dump.read({}, 1), types_of(run));
    }
  }
}

// 17 digits: the truth to the last bit, or to what LAMMPS itself rounded.
TEST(RealFiles, TheTextOf17Digits)
{
  for (const std::string run : { "ortho", "tri" })
  {
    const std::vector<Table> exact = exact_tables(run);
    const Dump dump(data_file("good/" + run + "_unwrapped.dump"));
    EXPECT_EQ(dump.said(), "");
    for (std::size_t frame = 0; frame < exact.size(); ++frame)
    {
      EXPECT_EQ(dump.header(frame).units, "lj");
      EXPECT_EQ(dump.header(frame).time, frame == 0 ? 0 : 0.5) << "100 steps of 0.005";
      const Decoded got = dump.read(everything(), frame);
      for_points(got, exact[frame],
        [&](std::int64_t id, std::span<const double, 3> point)
        {
          const auto& row = exact[frame].rows.at(id);
          ASSERT_EQ((Doubles(point.begin(), point.end())),
            (Doubles{ row.at("x"), row.at("y"), row.at("z") }));
        });
      const Integers ids = got.integers("id");
      for (const auto& names : { x_names, xs_names, xu_names, xsu_names })
      {
        for (std::size_t k = 0; k < 3 && got.has(names[k]); ++k)
        {
          const Doubles values = got.values(names[k]);
          for (std::size_t row = 0; row < ids.size(); ++row)
          {
            ASSERT_EQ(values[row], exact[frame].rows.at(ids[row]).at(names[k]));
          }
        }
      }
    }
  }
}

TEST(RealFiles, BinariesShowTheRunToTheLastBit)
{
  for (const std::string run : { "ortho", "tri" })
  {
    const std::vector<Table> exact = exact_tables(run);
    for (const Form& form : binaries)
    {
      const std::string bytes = data_file("good/" + run + "_" + form.file);
      const std::vector<Table> stored = tables_of_binary(bytes);
      const Dump dump(bytes);
      EXPECT_EQ(dump.said(), "");
      ASSERT_EQ(stored.size(), exact.size());
      ASSERT_EQ(dump.frames(), exact.size());
      EXPECT_FALSE(dump.index().unnamed);
      for (std::size_t frame = 0; frame < exact.size(); ++frame)
      {
        EXPECT_EQ(dump.entry(frame).timestep, exact[frame].step);
        EXPECT_EQ(stored[frame].box, exact[frame].box) << "17 digits are the doubles";
        const granular::FrameHeader header = dump.header(frame);
        EXPECT_EQ(header.box.boundary, "pp pp pp");
        EXPECT_EQ(header.box.tilted, run == "tri");
        EXPECT_EQ(header.units, "");
        EXPECT_FALSE(header.time);
        const Cell cell(exact[frame].box);
        for (const Coordinates coordinates : all_coordinates)
        {
          if (coordinates == Coordinates::Unwrapped && !form.images)
          {
            continue;
          }
          SCOPED_TRACE(
            run + "_" + form.file + " " + std::to_string(frame) + " " + to_string(coordinates));
          const Decoded got = read(dump, frame, coordinates);
          EXPECT_EQ(got.said(), "");
          EXPECT_EQ(got.integers("id"), stored[frame].ids) << "the order of the file";
          expect_types(got, types_of(run));
          for_points(got, exact[frame],
            [&](std::int64_t id, std::span<const double, 3> point)
            {
              // Of the doubles of this file, rounded once. Of those that LAMMPS had in its memory:
              // the file holds these, or scaled ones that LAMMPS made of them in at most 8
              // operations, each off by no more than 2^-53 of the magnitudes that add up.
              const Exact3 result = point_of(stored[frame].rows.at(id), cell, coordinates);
              const Exact3 truth = true_point(exact[frame], id, cell, coordinates);
              for (std::size_t k = 0; k < 3; ++k)
              {
                ASSERT_LE(error_in_bounds(point[k], result[k]), 1) << id << " " << k;
                const Quad bound = (truth[k].terms + result[k].terms) * Quad(0x1p-50);
                ASSERT_LE(absolute(Quad(point[k]) - truth[k].value), bound) << id << " " << k;
                if (coordinates == Coordinates::Absolute && !is_scaled(stored[frame].rows.at(id)))
                {
                  ASSERT_EQ(point[k], exact[frame].rows.at(id).at(x_names[k]));
                }
              }
            });
        }
      }
    }
  }
}

// What LAMMPS itself says the other coordinates are.
TEST(RealFiles, BinariesAgreeWithTheOtherCoordinatesOfLammps)
{
  for (const std::string run : { "ortho", "tri" })
  {
    const std::vector<Table> exact = exact_tables(run);
    const Dump images(data_file("good/" + run + "_image.bin"));
    for (std::size_t frame = 0; frame < exact.size(); ++frame)
    {
      std::int64_t crossed = 0;
      for_points(read(images, frame, Coordinates::Unwrapped), exact[frame],
        [&](std::int64_t id, std::span<const double, 3> point)
        {
          const auto& row = exact[frame].rows.at(id);
          crossed += row.at("ix") != 0 || row.at("iy") != 0 || row.at("iz") != 0;
          for (std::size_t k = 0; k < 3; ++k)
          {
            // x + ix h0 + iy h5 + iz h4: 6 roundings of numbers below 64, and those of the h
            ASSERT_NEAR(point[k], row.at(xu_names[k]), 64 * 0x1p-50);
          }
        });
      EXPECT_EQ(crossed > 50, frame == 1) << "what makes this worth while";
      for_points(read(images, frame, Coordinates::Scaled), exact[frame],
        [&](std::int64_t id, std::span<const double, 3> point)
        {
          const auto& row = exact[frame].rows.at(id);
          for (std::size_t k = 0; k < 3; ++k)
          {
            // (s + (512 + ix)) - 512: LAMMPS rounds to half a unit in the last place of 512
            ASSERT_NEAR(point[k], row.at(xsu_names[k]) - row.at(i_names[k]), 0x1p-44 + 0x1p-48);
          }
        });
    }
  }
}

TEST(RealFiles, CornersOfTheBoxes)
{
  for (const std::string run : { "ortho", "tri" })
  {
    const std::vector<Table> exact = exact_tables(run);
    for (const std::string file : { "scaled.dump", "plain.dump", "image.dump", "scaled_image.dump",
           "unwrapped.dump", "scaled.bin", "image.bin", "custom.bin" })
    {
      const Dump dump(data_file("good/" + run + "_" + file));
      for (std::size_t frame = 0; frame < 2; ++frame)
      {
        const granular::Box box = dump.header(frame).box;
        const Cell cell(exact[frame].box);
        for (int corner = 0; corner < 8; ++corner)
        {
          const Exact3 s = { double(corner & 1), double(corner >> 1 & 1), double(corner >> 2) };
          const Exact3 expected = cell.cartesian(s, true);
          const granular::Vector3 got = box.corner(corner & 1, corner >> 1 & 1, corner >> 2);
          for (std::size_t k = 0; k < 3; ++k)
          {
            EXPECT_EQ(got[k], static_cast<double>(expected[k].value)) << run << file << corner;
          }
        }
      }
    }
    // in.orthogonal and in.triclinic: 5 cells of fcc at the density 0.8442, tilts 1.5 -1 0.75 cells
    const double cell = std::cbrt(4 / 0.8442);
    const granular::Box box = Dump(data_file("good/" + run + "_image.bin")).header().box;
    const granular::Vector3 top = box.corner(1, 1, 1);
    const bool tilted = run == "tri";
    EXPECT_NEAR(top[0], (5 + (tilted ? 1.5 - 1 : 0)) * cell, 1e-14);
    EXPECT_NEAR(top[1], (5 + (tilted ? 0.75 : 0)) * cell, 1e-14);
    EXPECT_NEAR(top[2], 5 * cell, 1e-14);
    EXPECT_EQ(box.corner(0, 0, 0), granular::Vector3{});
  }
}

// ---- LIGGGHTS ----------------------------------------------------------------------------------------

namespace
{
constexpr const char* particle_names = "id type x y z ix iy iz vx vy vz radius";

/// The columns are those of the text with the same rows, in its order.
void expect_columns(
  const Decoded& got, const Table& printed, const std::vector<const char*>& columns)
{
  EXPECT_EQ(got.said(), "");
  EXPECT_EQ(got.integers("id"), printed.ids) << "in the order of the processes";
  for (const char* const name : columns)
  {
    const Doubles values = got.values(name);
    ASSERT_EQ(values.size(), printed.ids.size());
    for (std::size_t row = 0; row < values.size(); ++row)
    {
      ASSERT_EQ(values[row], printed.rows.at(printed.ids[row]).at(name)) << name;
    }
  }
}
}

// Without the names the steps are there, and the user is told what the first row holds: the first
// frame has none.
TEST(RealFiles, PlainBinaryOfLiggghtsWithoutNames)
{
  Series run;
  run.update({ path_of("grains.bin") });
  EXPECT_EQ(run.said, "");
  ASSERT_EQ(run.steps(), (Steps{ 0, 1000, 2000 }));
  const std::vector<Table> stored = tables_of_binary(data_file("good/grains.bin"), particle_names);
  for (std::size_t frame = 0; frame < 3; ++frame)
  {
    const std::string said = error_of([&] { run.read(frame); });
    const std::string expected = path_of("grains.bin") + "@" +
      std::to_string(run.entry(frame).offset) +
      ": expected 12 names in ColumnNames, because the file does not name its columns, got none; "
      "its "
      "first row is ";
    ASSERT_TRUE(said.starts_with(expected)) << said;
    const std::vector<std::string> words = words_of(said.substr(expected.size()));
    ASSERT_EQ(words.size(), 12u);
    const Table& table = stored[std::max<std::size_t>(1, frame)];
    for (std::size_t column = 0; column < 12; ++column)
    {
      EXPECT_EQ(std::strtod(words[column].c_str(), nullptr),
        table.rows.at(table.ids[0]).at(words_of(particle_names)[column]));
    }
  }
}

TEST(RealFiles, PiecesOfLiggghts)
{
  std::vector<std::string> files;
  for (const char* const step : { "0", "1000", "2000" })
  {
    for (const char* const process : { "0", "1", "2", "3" })
    {
      files.push_back(path_of(std::string("pieces_") + step + "." + process + ".dump"));
    }
  }
  const std::vector<std::string> ordered = files;
  const std::vector<Table> printed = tables_of_text(data_file("good/grains.dump"));
  std::mt19937 random(3);
  for (int round = 0; round < 10; ++round)
  {
    Series run;
    run.update(files);
    EXPECT_EQ(run.said, "");
    ASSERT_EQ(run.steps(), (Steps{ 0, 1000, 2000 }));
    for (std::size_t frame = 0; frame < 3; ++frame)
    {
      const auto pieces = run.index.pieces(frame);
      ASSERT_EQ(pieces.size(), 4u);
      Integers ids;
      for (std::size_t piece = 0; piece < 4; ++piece)
      {
        EXPECT_EQ(pieces[piece].file.path, ordered[4 * frame + piece]);
        const std::vector<Table> part = tables_of_text(data_file(
          "good/" + std::filesystem::path(ordered[4 * frame + piece]).filename().string()));
        ASSERT_EQ(part.size(), 1u);
        ids.insert(ids.end(), part[0].ids.begin(), part[0].ids.end());
      }
      const Decoded got = run.read(frame, everything());
      EXPECT_EQ(ids, printed[frame].ids) << "the one file is in the order of the processes, too";
      EXPECT_EQ(got.rows(), frame == 0 ? 0 : 1200);
      EXPECT_EQ(got.frame.header.rows, got.rows());
      ASSERT_EQ(got.names(), "id type x y z radius");
      expect_columns(got, printed[frame], { "id", "type", "x", "y", "z", "radius" });
      Request sorted;
      sorted.sort_by_id = true;
      std::sort(ids.begin(), ids.end());
      EXPECT_EQ(run.read(frame, sorted).integers("id"), ids);
    }
    std::shuffle(files.begin(), files.end(), random);
  }
}

TEST(RealFiles, FilesOfLiggghtsOneAStep)
{
  Series run;
  run.update(
    { path_of("grains_2000.dump"), path_of("grains_0.dump"), path_of("grains_1000.dump") });
  EXPECT_EQ(run.said, "");
  ASSERT_EQ(run.index.size(), 3u);
  EXPECT_EQ(run.index.times(2e-5), (Doubles{ 0, 1000 * 2e-5, 2000 * 2e-5 }));
  const std::vector<Table> printed = tables_of_text(data_file("good/grains.dump"));
  const double lengths[] = { 0.1, 0.1, 0.15 };
  for (std::size_t frame = 0; frame < 3; ++frame)
  {
    const Decoded got = run.read(frame, everything());
    expect_columns(got, printed[frame], { "radius" });
    const Doubles points = got.points();
    const Doubles images = got.values("image");
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Doubles scaled = got.values(xs_names[k]);
      for (std::size_t row = 0; row < scaled.size(); ++row)
      {
        const auto& text = printed[frame].rows.at(printed[frame].ids[row]);
        const double x = text.at(x_names[k]);
        ASSERT_LE(std::abs(points[3 * row + k] - x),
          half_digit(x) + half_digit(scaled[row]) * lengths[k] + 1e-16);
        ASSERT_EQ(images[3 * row + k], text.at(i_names[k]));
      }
    }
  }
}

// ---- all of them -------------------------------------------------------------------------------------

TEST(RealFiles, AreDumps)
{
  for (const auto& entry : std::filesystem::directory_iterator(path_of("")))
  {
    const bool of_vtk = entry.is_directory() || entry.path().extension() == ".vtk";
    EXPECT_EQ(granular::is_dump_file(entry.path().string()), !of_vtk) << entry.path();
  }
}
