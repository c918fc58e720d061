// SPDX-License-Identifier: BSD-3-Clause
// Restart files that are wrong: what is said of them, and that nothing is allocated on their word. In a program of its own, because it
// replaces operator new.
#include "restart_files.h"

#include "../support/counting_source.h"
#include "../support/dumps.h"
#include "../support/largest_request.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>

namespace
{
using granular::RestartLayout;
using restart_builder::RestartBuilder;

std::string said_of(const std::string& bytes)
{
  return error_of([&] { layout_of(bytes); });
}

/// An error with a place, or a layout that lies in the file.
void expect_sane(const std::string& bytes)
{
  largest_request = 0;
  try
  {
    const RestartLayout layout = layout_of(bytes);
    const auto size = static_cast<std::int64_t>(bytes.size());
    std::int64_t at = layout.begin;
    EXPECT_LE(layout.header.end, at);
    for (const granular::RestartChunk& chunk : layout.chunks)
    {
      EXPECT_EQ(chunk.offset, at + 4);
      EXPECT_GE(chunk.doubles, 0);
      at = chunk.offset + 8 * chunk.doubles;
    }
    EXPECT_LE(at, size);
    EXPECT_EQ(layout.records, layout.header.atoms);
    EXPECT_LE(layout.records * 88, size);
  }
  catch (const granular::FormatError& error)
  {
    EXPECT_EQ(error.where().path, "memory");
    EXPECT_GE(error.where().byte, 0) << error.what();
  }
  // nan for each of a million types, at most
  EXPECT_LE(largest_request, std::size_t{ 8 } << 20);
}

/// The header of the small file with four bytes written over.
std::string with_int(std::size_t at, std::int32_t number)
{
  std::string bytes = small_file().file();
  bytes.replace(at, 4, std::string_view(reinterpret_cast<const char*>(&number), 4));
  return bytes;
}

/// Where the value of a flag of small integers is in the small file.
std::size_t value_of(std::int32_t flag)
{
  RestartBuilder file = small_file();
  const std::size_t first_count = 4 + 4 + file.version.size() + 1;
  const std::size_t after_units = first_count + 3 * 8 + 4 + 4 + file.units.size() + 1 + 4 + 8;
  return flag <= 3 ? first_count + 8 * static_cast<std::size_t>(flag - 1) + 4
                   : after_units + 8 * static_cast<std::size_t>(flag - 6) + 4;
}

TEST(RestartDamage, EveryCut)
{
  RestartBuilder file = small_file();
  for (const bool meshes : { false, true })
  {
    if (meshes)
    {
      file.time = 1;
    }
    const std::string bytes = file.file();
    for (std::size_t size = 0; size < bytes.size(); ++size)
    {
      expect_sane(bytes.substr(0, size));
      EXPECT_THROW(layout_of(bytes.substr(0, size)), granular::FormatError) << size;
    }
  }
}

TEST(RestartDamage, EveryByte)
{
  for (const bool swapped : { false, true })
  {
    RestartBuilder file = small_file();
    file.swapped = swapped;
    const std::string bytes = file.file();
    for (std::size_t at = 0; at < file.base().size() + 160; ++at)
    {
      for (const int change : { 1, 0x80, 0x7f, 0xff })
      {
        std::string other = bytes;
        other[at] = static_cast<char>(other[at] ^ change);
        expect_sane(other);
      }
    }
  }
}

TEST(RestartDamage, WhatIsSaid)
{
  const std::size_t end = small_file().header().size() - 4;
  EXPECT_EQ(said_of("ITEM: TIMESTEP"),
    "memory@0: expected the header of a restart file, which begins with the version of the "
    "program, "
    "got other bytes");
  EXPECT_EQ(said_of(with_int(value_of(1) - 4, 99)),
    "memory@" + std::to_string(value_of(1) - 4) +
      ": expected a flag of the header, -1 to 52, got 99");
  EXPECT_EQ(said_of(with_int(value_of(2), 5)),
    "memory@" + std::to_string(value_of(2)) + ": expected the bytes of an id, 4 or 8, got 5");
  EXPECT_EQ(said_of(with_int(value_of(3), 16)),
    "memory@" + std::to_string(value_of(3)) + ": expected the bytes of a count, 4 or 8, got 16");
  EXPECT_EQ(said_of(with_int(value_of(2) - 4, 3)),
    "memory@" + std::to_string(value_of(3) - 4) +
      ": expected the bytes of a count once in the header, got it again");
  EXPECT_EQ(said_of(with_int(value_of(6), 4)),
    "memory@" + std::to_string(value_of(6)) + ": expected the dimension, 2 to 3, got 4");
  EXPECT_EQ(said_of(with_int(value_of(7), 0)),
    "memory@" + std::to_string(value_of(7)) +
      ": expected the number of processes, 1 to 10000000, got 0");
  EXPECT_EQ(said_of(with_int(value_of(8), 3)),
    "memory@" + std::to_string(value_of(8)) + ": expected a grid of 2 processes, got 3 x 1 x 1");
  EXPECT_EQ(said_of(with_int(value_of(16), 1)),
    "memory@" + std::to_string(value_of(16)) +
      ": expected the lower boundary of x to be 0, as x is periodic, got 1");
  EXPECT_EQ(said_of(with_int(value_of(20), 0)),
    "memory@" + std::to_string(value_of(20)) +
      ": expected the lower boundary of z to be 1, 2 or 3, as z is not periodic, got 0");
  EXPECT_EQ(said_of(with_int(end + 4, 33)),
    "memory@" + std::to_string(end + 4) + ": expected the number of groups, 1 to 32, got 33");
  EXPECT_EQ(said_of(with_int(value_of(7) - 4, -1)),
    "memory@" + std::to_string(value_of(7)) +
      ": expected the number of processes (flag 7) in the header, got the end of the header");
}

TEST(RestartDamage, TextsInTheHeader)
{
  RestartBuilder file = small_file();
  file.atom_style = "hybrid";
  file.styles = { "granular", "bond/gran" };
  file.bond_styles = { { 1, -2 } };
  const std::size_t at = file.header().find("bond/gran") + 10;
  EXPECT_EQ(said_of(file.file()),
    "memory@" + std::to_string(at + 4) +
      ": expected the bonds per particle of bond/gran, 0 to 1000000, got -2");
  file.styles[0] = "gra\tnular";
  EXPECT_EQ(said_of(file.file()),
    "memory@" + std::to_string(file.header().find("gra\tnular") - 4) +
      ": expected an atom style of the hybrid, a text of 1 to 1023 printable bytes and a zero, got "
      "other bytes");
  file.styles.assign(101, "granular");
  EXPECT_EQ(said_of(file.file()),
    "memory@" + std::to_string(file.header().find("hybrid") + 7) +
      ": expected the number of atom styles of the hybrid, 1 to 100, got 101");
}

TEST(RestartDamage, BoundsThatAreNone)
{
  RestartBuilder file = small_file();
  file.hi[1] = -1;
  EXPECT_NE(said_of(file.file()).find("expected the upper bound of y above the lower one, got -1"),
    std::string::npos);
  file.hi[1] = std::numeric_limits<double>::infinity();
  EXPECT_NE(said_of(file.file()).find("expected a number for the upper bound of y, got inf"),
    std::string::npos);
}

TEST(RestartDamage, NoParticles)
{
  RestartBuilder file = small_file();
  file.atoms = 6;
  const std::string from = std::to_string(file.header().size() + file.groups_and_masses().size());
  const std::string common = "memory@" + from +
    ": expected 6 particles of 2 processes up to the end of the file, found none behind byte " +
    from + "; understood: header, groups, masses";
  EXPECT_EQ(said_of(file.file()), common + "; found 5 particles where these should be");
  EXPECT_EQ(said_of(file.base()), common + ", fixes (1 and 2)");
  EXPECT_EQ(said_of(file.file() + "x"), common);
  file.chunks[1][0][0] = 18; // longer than what is left for two
  EXPECT_EQ(said_of(file.file()), common);
}

// From the chunk of each process, chunks lead to the end of the file: only those of all processes are looked at.
TEST(RestartDamage, OneParticleTooFewOfManyProcesses)
{
  RestartBuilder file = small_file();
  const restart_builder::Record record = file.chunks[0][0];
  file.chunks.assign(300, std::vector<restart_builder::Record>(100, record));
  file.grid = { 300, 1, 1 };
  file.atoms = 30'001;
  const std::string said = said_of(file.file());
  EXPECT_TRUE(said.ends_with("; found 30000 particles where these should be")) << said;
}

TEST(RestartDamage, RecordsThatAreNone)
{
  for (const std::size_t slot : { 0u, 4u, 5u })
  {
    for (const double value : { 0.5, -1., std::nan("") })
    {
      RestartBuilder file = small_file();
      file.chunks[1][1][slot] = value;
      EXPECT_THROW(layout_of(file.file()), granular::FormatError) << slot << " " << value;
    }
  }
}

TEST(RestartDamage, NewerFilesOfLammps)
{
  const std::string bytes("LammpS RestartT\0\1\0\0\0\2\0\0\0", 24);
  EXPECT_EQ(error_of<granular::UnsupportedError>([&] { layout_of(bytes); }),
    "memory: expected a restart file of LIGGGHTS, got a restart file of LAMMPS: `lmp -restart2data "
    "FILE NEW.data` makes a data file of it in full precision; open that");
}

/// Bytes read of a file to find that there are no particles in it.
std::int64_t cost_of(const std::string& bytes)
{
  const CountingSource source(bytes);
  granular::Notices notices;
  granular::Progress progress;
  EXPECT_THROW(granular::read_layout(source, notices, progress), granular::FormatError);
  return source.bytes_read();
}

/// Behind the small header: from each of 400 000 places chunks lead to the end of the file, all of them with records that
/// are right. To walk from each would read 3.6 TB.
TEST(RestartDamage, ManyBeginnings)
{
  RestartBuilder file;
  file.atoms = 3;
  std::string bytes = file.base();
  restart_builder::Record record = restart_builder::common_block({});
  record.push_back(0);
  record[0] = 12;
  constexpr std::size_t count = 100'000;
  for (std::size_t i = 1; i <= count; ++i)
  {
    // the upper half of the last double is the count of the records behind
    record[11] = restart_builder::bits_of(static_cast<std::int64_t>(12 * (count - i)) << 32);
    bytes.append(reinterpret_cast<const char*>(record.data()), 96);
  }
  EXPECT_NE(said_of(bytes).find("gave up"), std::string::npos);
  EXPECT_LT(
    cost_of(bytes), (std::int64_t{ 1 } << 28) + 8 * static_cast<std::int64_t>(bytes.size()));
}

TEST(RestartDamage, OnlyZeros)
{
  RestartBuilder file;
  for (const int processes : { 1, 1000, 10'000'000 })
  {
    file.processes = processes;
    file.grid[0] = processes;
    file.atoms = 3;
    const std::string bytes = file.base() + std::string(3'000'000, '\0');
    EXPECT_LT(cost_of(bytes), 20'000'000);
    file.atoms = 0;
    if (processes == 1000)
    {
      EXPECT_EQ(layout_of(file.base() + std::string(3'000'000, '\0')).chunks.size(), 1000u);
    }
  }
}
}
