// SPDX-License-Identifier: BSD-3-Clause
// Records that are not what they say: an error with the place, or a frame, but never a crash or memory for what is not there.
#include "restart_runs.h"

#include "../support/error_of.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace
{
using restart_builder::RestartBuilder;

/// What is said of bytes that have changed since the layout was found.
std::string error_of(const std::string& layout, const std::string& bytes)
{
  return ::error_of([&] { read_as(layout, bytes); });
}

void put(std::string& bytes, std::size_t at, double number)
{
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

/// Where the first record of the file begins.
std::size_t first_record(const std::string& bytes)
{
  granular::Notices notices;
  granular::Progress progress;
  const auto layout = granular::read_layout(*granular::open_memory(bytes), notices, progress);
  return static_cast<std::size_t>(layout.chunks[0].offset);
}

RestartBuilder bonds_file()
{
  const std::vector<double> history(12, 0.5);
  return bonded_file({ { 17, { { 1, 18, history }, { 1, 19, history } } },
                       { 18, { { 1, 17, history } } }, { 19, { { 1, 17, history } } } },
    12);
}
}

TEST(RestartDamage, SaysWhere)
{
  // the second record, which holds one bond
  const std::string whole = bonds_file().file();
  const std::size_t second = first_record(whole) + (17 + 42) * 8;
  const auto said = [&](std::size_t slot, double number)
  {
    std::string bytes = whole;
    put(bytes, second + slot * 8, number);
    return error_of(whole, bytes);
  };
  const std::string at = "memory@" + std::to_string(second) + ": expected ";
  const std::string part = " of the bond/gran part of a record, got ";
  const std::string of = ", in record 2 of particle 18";
  EXPECT_EQ(said(0, 1e300), at + "the length of a record, from 11 to 90 doubles, got 1e+300" + of);
  EXPECT_EQ(
    said(17 + 12, -1), at + "a number of bonds from 0 to 6 in double 12" + part + "-1" + of);
  EXPECT_EQ(
    said(17 + 12, 0.5), at + "a number of bonds from 0 to 6 in double 12" + part + "0.5" + of);
  EXPECT_EQ(said(17 + 12, 7), at + "a number of bonds from 0 to 6 in double 12" + part + "7" + of);
  EXPECT_EQ(said(17, 29),
    at + "the length of the part of style bond/gran, from 11 to 28, in double 17, got 29" + of);
  EXPECT_EQ(said(17, 27),
    at + "at most 11 history values, for which there is room, in double 15" + part + "1 times 12" +
      of);
  EXPECT_EQ(said(17 + 15, 11),
    at + "the number of history values of a bond, 12 as in other records, in double 15" + part +
      "11" + of);
  EXPECT_EQ(said(17 + 2, 9),
    at +
      "the position of the particle again behind double 17, where the part of style bond/gran "
      "begins, "
      "got another one" +
      of);
  EXPECT_EQ(said(17 + 14, 0.25), at + "a whole number of 64 bits, got 0.25 for a bond" + of);
  EXPECT_EQ(said(5, 0.5),
    at + "the type of a particle, from 1, in double 5 of a record, got 0.5, in record 2");
}

TEST(RestartDamage, TheFirstRecord)
{
  // of which the plan of all others is made
  const std::string whole = bonds_file().file();
  const std::size_t first = first_record(whole);
  for (const auto& [slot, number] : std::vector<std::pair<std::size_t, double>>{
         { 0, 1e300 }, { 5, 0.5 }, { 17, 43 }, { 17, 40 }, { 19, 9 }, { 29, -1 }, { 34, 11 } })
  {
    std::string bytes = whole;
    put(bytes, first + slot * 8, number);
    const std::string said = error_of(whole, bytes);
    EXPECT_TRUE(said.starts_with("memory@" + std::to_string(first) + ": expected ")) << said;
    EXPECT_NE(said.find(", in record 1"), std::string::npos) << said;
  }
}

TEST(RestartDamage, FilesThatChange)
{
  const std::string whole = bonds_file().file();
  EXPECT_NE(error_of(whole, whole.substr(0, whole.size() - 1)).find("the file was shortened"),
    std::string::npos);
  // two records where three were
  std::string bytes = whole;
  put(bytes, first_record(whole), (17 + 42) + (17 + 28));
  put(bytes, first_record(whole) + 17 * 8, 42 + 17 + 28);
  EXPECT_NE(error_of(whole, bytes), "");
  RestartBuilder spheres;
  spheres.chunks[0] = { restart_builder::granular_record({}),
    restart_builder::granular_record({}) };
  bytes = spheres.file();
  put(bytes, first_record(spheres.file()), 34);
  EXPECT_NE(error_of(spheres.file(), bytes).find("expected 2 records, got 1"), std::string::npos);
}

// A number of history values without bonds costs nothing in the file, but arrays.
TEST(RestartDamage, HistoryOfNoBonds)
{
  RestartBuilder builder = bonded_file({ { 1 }, { 2 } }, 12);
  for (auto& record : builder.chunks[0])
  {
    record.back() = 1'000'000'000;
  }
  const std::string bytes = builder.file();
  EXPECT_NE(
    error_of(bytes, bytes).find("expected at most 1024 history values of a bond, got 1000000000"),
    std::string::npos);
}
