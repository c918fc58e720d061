// SPDX-License-Identifier: BSD-3-Clause
// Where things are in restart files: real ones, of which the places were found by hand, and ones made by hand.
#include "restart_files.h"
#include "shared_file.h"

#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

namespace
{
using granular::RestartChunk;
using granular::RestartFix;
using granular::RestartLayout;
using restart_builder::RestartBuilder;

using Places = std::vector<std::pair<std::int64_t, std::int64_t>>;
using FixRows = std::vector<std::tuple<std::string, std::string, std::int64_t>>;

Places places(const RestartLayout& layout)
{
  Places places;
  for (const RestartChunk& chunk : layout.chunks)
  {
    places.emplace_back(chunk.offset, chunk.doubles);
  }
  return places;
}

FixRows fixes(const RestartLayout& layout)
{
  FixRows rows;
  for (const RestartFix& fix : layout.fixes)
  {
    rows.emplace_back(fix.id, fix.style, fix.most);
  }
  return rows;
}

std::vector<std::string> styles(const RestartLayout& layout)
{
  std::vector<std::string> names;
  for (const granular::RestartStyle& style : layout.header.styles)
  {
    names.push_back(style.name);
  }
  return names;
}

void expect_bounds(
  const granular::Box& box, const granular::Vector3& lo, const granular::Vector3& hi)
{
  EXPECT_EQ(box.bounds().lo, lo);
  EXPECT_EQ(box.bounds().hi, hi);
}

/// What is the same in all small files.
void expect_small(const RestartLayout& layout)
{
  EXPECT_EQ(layout.header.timestep, 1234);
  EXPECT_EQ(layout.header.types, 2);
  EXPECT_EQ(layout.groups, (std::vector<std::string>{ "all", "", "walls" }));
  EXPECT_EQ(layout.masses, (std::vector<double>{ 1.5, 2.5 }));
  EXPECT_TRUE(layout.has_fixes);
  EXPECT_EQ(fixes(layout),
    (FixRows{ { "contacthistory", "contacthistory", 9 }, { "pa", "property/atom", 4 } }));
  EXPECT_EQ(layout.records, 5);
  ASSERT_EQ(layout.chunks.size(), 2u);
  EXPECT_EQ(layout.chunks[0].doubles, 3 * 17);
  EXPECT_EQ(layout.chunks[1].doubles, 2 * 17);
  EXPECT_EQ(layout.chunks[1].offset, layout.chunks[0].offset + 3 * 17 * 8 + 4);
  EXPECT_EQ(layout.size, layout.chunks[1].offset + 2 * 17 * 8);
}

// ---- real files --------------------------------------------------------------------------------

TEST(RestartLayout, BeamOfBondedParticles)
{
  const std::string path = shared_file("reference/beam.restart");
  if (path.empty())
  {
    GTEST_SKIP() << "not there";
  }
  const RestartLayout layout = layout_of_file(path);
  const granular::RestartHeader& header = layout.header;
  EXPECT_EQ(header.version,
    "Version LIGGGHTS-PUBLIC 3.0.7, compiled 2015-01-26-11:21:16 by dem based on LAMMPS 23 Nov "
    "2013");
  EXPECT_EQ(header.tag_bytes, 4);
  EXPECT_EQ(header.count_bytes, 8);
  EXPECT_EQ(header.image_bits(), 10);
  EXPECT_EQ(header.units, "si");
  EXPECT_EQ(header.timestep, 100004);
  EXPECT_FALSE(header.time);
  EXPECT_EQ(header.dimension, 3);
  EXPECT_EQ(header.processes, 1);
  EXPECT_FALSE(header.newton_bond);
  EXPECT_EQ(header.atoms, 11);
  EXPECT_EQ(header.bonds, 10);
  EXPECT_EQ(header.types, 2);
  EXPECT_EQ(header.atom_style, "hybrid");
  EXPECT_EQ(styles(layout), (std::vector<std::string>{ "granular", "bond/gran" }));
  EXPECT_EQ(header.styles[1].bond_types, 1);
  EXPECT_EQ(header.styles[1].bonds_per_atom, 6);
  expect_bounds(header.box, { -5.334, -1, -5.334 }, { 5.334, 1, 1 });
  EXPECT_EQ(header.box.boundary, "ff ff ff");
  EXPECT_FALSE(header.box.tilted);
  EXPECT_EQ(header.end, 612);
  EXPECT_FALSE(layout.swapped);
  EXPECT_EQ(layout.groups,
    (std::vector<std::string>{ "all", "bonded", "freezed", "tipball", "nve_group" }));
  EXPECT_EQ(layout.masses, (std::vector<double>{ 1, 1 }));
  EXPECT_TRUE(layout.has_fixes);
  EXPECT_EQ(fixes(layout), (FixRows{ { "contacthistory", "contacthistory", 2 } }));
  EXPECT_EQ(layout.begin, 995);
  EXPECT_EQ(places(layout), (Places{ { 999, 643 } }));
  EXPECT_EQ(layout.records, 11);
  EXPECT_EQ(layout.size, 6143);
}

TEST(RestartLayout, ParticlesOfFourProcesses)
{
  const std::string path = shared_file("liggghts/grains.restart");
  if (path.empty())
  {
    GTEST_SKIP() << "not there";
  }
  const RestartLayout layout = layout_of_file(path);
  const granular::RestartHeader& header = layout.header;
  EXPECT_EQ(header.version,
    "Version LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26-19:42:32 by buildd, git commit unknown");
  EXPECT_EQ(header.units, "si");
  EXPECT_EQ(header.timestep, 4000);
  EXPECT_EQ(header.processes, 4);
  EXPECT_EQ(header.atoms, 1200);
  EXPECT_EQ(header.bonds, 0);
  EXPECT_EQ(header.types, 2);
  EXPECT_EQ(header.atom_style, "granular");
  EXPECT_EQ(styles(layout), (std::vector<std::string>{ "granular" }));
  expect_bounds(header.box, { -0.05, -0.05, 0 }, { 0.05, 0.05, 0.15 });
  EXPECT_EQ(header.box.boundary, "pp pp ff");
  EXPECT_EQ(header.end, 570);
  EXPECT_EQ(layout.groups, (std::vector<std::string>{ "all" }));
  EXPECT_TRUE(layout.masses.empty());
  EXPECT_EQ(fixes(layout),
    (FixRows{
      { "history_zwalls", "property/atom", 4 }, { "contacthistory", "contacthistory", 18 } }));
  EXPECT_EQ(layout.begin, 1122);
  EXPECT_EQ(places(layout),
    (Places{ { 1126, 14783 }, { 119394, 92 }, { 120134, 15109 }, { 241010, 184 } }));
  EXPECT_EQ(layout.records, 1200);
}

TEST(RestartLayout, HybridInOneFileAndInSeveral)
{
  const RestartLayout one = layout_of_file(GRANULAR_DATA "/good/restart/hybrid.restart");
  EXPECT_EQ(styles(one), (std::vector<std::string>{ "granular", "molecular" }));
  EXPECT_EQ(one.groups, (std::vector<std::string>{ "all", "", "few" }));
  EXPECT_EQ(fixes(one), (FixRows{ { "pa", "property/atom", 4 } }));
  EXPECT_EQ(one.masses, (std::vector<double>{ 0, 0 }));
  EXPECT_EQ(places(one), (Places{ { 729, 148 }, { 1917, 148 }, { 3105, 148 } }));
  EXPECT_EQ(one.records, 12);

  const RestartLayout parts = layout_of_file(GRANULAR_DATA "/good/restart/parts_base.restart");
  EXPECT_EQ(parts.groups, one.groups);
  EXPECT_EQ(fixes(parts), fixes(one));
  EXPECT_EQ(parts.records, 12);
  EXPECT_EQ(places(parts), (Places{ { 4, 148 }, { 4, 148 }, { 4, 148 } }));
  ASSERT_EQ(parts.chunks.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(
      parts.chunks[i].path, GRANULAR_DATA "/good/restart/parts_" + std::to_string(i) + ".restart");
    EXPECT_EQ(one.chunks[i].path, "");
  }
}

TEST(RestartLayout, ARegionIsCountedInTheHeader)
{
  const RestartLayout half = layout_of_file(GRANULAR_DATA "/good/restart/half.restart");
  EXPECT_EQ(half.header.atoms, 6);
  EXPECT_EQ(half.records, 6);
  EXPECT_EQ(places(half), (Places{ { 729, 74 }, { 1325, 74 }, { 1921, 74 } }));
}

TEST(RestartLayout, ProcessesWithoutParticles)
{
  const RestartLayout upper = layout_of_file(GRANULAR_DATA "/good/restart/upper.restart");
  EXPECT_EQ(places(upper), (Places{ { 602, 0 }, { 606, 0 }, { 610, 0 }, { 614, 136 } }));
  EXPECT_EQ(upper.records, 8);
  EXPECT_EQ(upper.header.box.boundary, "pp mm ff");
  EXPECT_TRUE(upper.has_fixes);
  EXPECT_TRUE(upper.fixes.empty());

  const RestartLayout none = layout_of_file(GRANULAR_DATA "/good/restart/none.restart");
  EXPECT_EQ(places(none), (Places{ { 602, 0 }, { 606, 0 } }));
  EXPECT_EQ(none.records, 0);
}

TEST(RestartLayout, TheBoxItselfIsStored)
{
  const granular::Box& box =
    layout_of_file(GRANULAR_DATA "/good/restart/tilted.restart").header.box;
  EXPECT_TRUE(box.tilted);
  EXPECT_EQ(box.boundary, "pp pp pp");
  EXPECT_EQ(box.corner(0, 0, 0), (granular::Vector3{ 0, 0, 0 }));
  EXPECT_EQ(box.corner(1, 0, 0), (granular::Vector3{ 0.05, 0, 0 }));
  EXPECT_EQ(box.corner(0, 1, 0), (granular::Vector3{ 0.01, 0.05, 0 }));
  EXPECT_EQ(box.corner(0, 0, 1), (granular::Vector3{ -0.005, 0.002, 0.05 }));
}

// ---- made by hand ------------------------------------------------------------------------------

TEST(RestartLayout, MadeByHand)
{
  RestartBuilder file = small_file();
  for (const bool swapped : { false, true })
  {
    for (const int tag_bytes : { 4, 8 })
    {
      for (const int count_bytes : { 4, 8 })
      {
        file.swapped = swapped;
        file.tag_bytes = tag_bytes;
        file.count_bytes = count_bytes;
        const RestartLayout layout = layout_of(file.file());
        expect_small(layout);
        EXPECT_EQ(layout.swapped, swapped);
        EXPECT_EQ(layout.header.tag_bytes, tag_bytes);
        EXPECT_EQ(layout.header.count_bytes, count_bytes);
        EXPECT_EQ(layout.header.image_bits(), tag_bytes == 8 ? 21 : 10);
        EXPECT_EQ(layout.header.end, static_cast<std::int64_t>(file.header().size()));
        EXPECT_EQ(layout.begin, static_cast<std::int64_t>(file.base().size()));
      }
    }
  }
}

TEST(RestartLayout, AllOfTheHeader)
{
  RestartBuilder file = small_file();
  file.count_bytes = 8;
  file.timestep = 5'000'000'000;
  file.time = 0.125;
  file.dimension = 2;
  file.newton_bond = 1;
  file.periodic = { 1, 0, 0 };
  file.boundary = { 0, 0, 1, 3, 2, 2 };
  file.atom_style = "hybrid";
  file.styles = { "granular", "bond/gran" };
  file.bond_styles = { { 3, 12 } };
  file.bonds = 77;
  file.lo = { 1e8, -1, 0 };
  file.hi = { 1e8 + 3, 1, 0.3 };
  file.tilts = { { 0.1, 0, -0.2 } };
  for (const bool swapped : { false, true })
  {
    file.swapped = swapped;
    const RestartLayout layout = layout_of(file.file());
    const granular::RestartHeader& header = layout.header;
    EXPECT_EQ(header.version, file.version);
    EXPECT_EQ(header.timestep, 5'000'000'000);
    EXPECT_EQ(header.time, 0.125);
    EXPECT_EQ(header.dimension, 2);
    EXPECT_TRUE(header.newton_bond);
    EXPECT_EQ(styles(layout), file.styles);
    EXPECT_EQ(header.styles[1].bond_types, 3);
    EXPECT_EQ(header.styles[1].bonds_per_atom, 12);
    EXPECT_EQ(header.bonds, 77);
    EXPECT_EQ(header.box.boundary, "pp fm ss");
    EXPECT_EQ(header.box.origin[0].value(), 1e8);
    EXPECT_EQ(header.box.vectors[0][0].value(), 3);
    EXPECT_EQ(header.box.vectors[1][0].value(), 0.1);
    EXPECT_EQ(header.box.vectors[2][1].value(), -0.2);
    EXPECT_EQ(header.box.corner(1, 1, 1)[2], 0.3);
  }
}

TEST(RestartLayout, EdgesAreExactDifferences)
{
  RestartBuilder file = small_file();
  file.lo = { 0.1, 0.1, 0.1 };
  file.hi = { 1e6, 1e6, 1e6 };
  for (const bool tilted : { false, true })
  {
    if (tilted)
    {
      file.tilts = { { 1e-9, 0, 0 } };
    }
    const granular::Twofold edge = layout_of(file.file()).header.box.vectors[0][0];
    EXPECT_EQ(edge.hi, 1e6 - 0.1);
    EXPECT_NE(edge.lo, 0);
    EXPECT_EQ(edge.lo, -0.1 - (edge.hi - 1e6)); // what the rounding took, exactly
  }
}

TEST(RestartLayout, LoneBondStyle)
{
  RestartBuilder file = small_file();
  file.atom_style = "bond/gran";
  file.bond_styles = { { 3, 12 } };
  const granular::RestartHeader header = layout_of(file.file()).header;
  ASSERT_EQ(header.styles.size(), 1u);
  EXPECT_EQ(header.styles[0].bond_types, 3);
  EXPECT_EQ(header.styles[0].bonds_per_atom, 12);
}

TEST(RestartLayout, WholeNumbersAsValues)
{
  RestartBuilder file;
  restart_builder::Particle particle;
  particle.bits = false;
  particle.tag = 9;
  particle.image = 537395712;
  file.chunks = { { restart_builder::granular_record(particle) } };
  EXPECT_EQ(layout_of(file.file()).records, 1);
}

TEST(RestartLayout, AnyPayload)
{
  RestartBuilder file = small_file();
  for (const std::string& forces :
    { std::string(), std::string(1, '\0'), std::string(70000, '\0'), std::string(300'001, '\x0b'),
      file.part(0), file.part(0) + file.part(1) + "x", file.file() })
  {
    file.forces = forces;
    const RestartLayout layout = layout_of(file.file());
    expect_small(layout);
    EXPECT_EQ(layout.begin, static_cast<std::int64_t>(file.base().size()));
  }
}

TEST(RestartLayout, EmptyChunksAnywhere)
{
  for (unsigned filled = 0; filled < 32; ++filled)
  {
    RestartBuilder file = small_file();
    file.grid = { 5, 1, 1 };
    file.chunks.assign(5, {});
    std::int64_t records = 0;
    for (unsigned process = 0; process < 5; ++process)
    {
      if ((filled >> process) & 1)
      {
        file.chunks[process] = particles(records + 1, process + 1);
        records += process + 1;
      }
    }
    const RestartLayout layout = layout_of(file.file());
    EXPECT_EQ(layout.records, records);
    EXPECT_EQ(layout.begin, static_cast<std::int64_t>(file.base().size()));
    ASSERT_EQ(layout.chunks.size(), 5u);
    for (unsigned process = 0; process < 5; ++process)
    {
      EXPECT_EQ(layout.chunks[process].doubles,
        17 * static_cast<std::int64_t>(file.chunks[process].size()));
    }
    EXPECT_EQ(layout.fixes.size(), 2u) << filled;
  }
}

TEST(RestartLayout, MeshesBehind)
{
  RestartBuilder file = small_file();
  file.time = 0.5;
  for (const std::string& behind : { std::string(), std::string("mesh"), std::string(100, '\0'),
         file.part(1), std::string(200'000, '\xee') })
  {
    file.behind = behind;
    const RestartLayout layout = layout_of(file.file());
    EXPECT_EQ(layout.begin, static_cast<std::int64_t>(file.base().size()));
    EXPECT_EQ(layout.records, 5);
    EXPECT_EQ(layout.fixes.size(), 2u);
    EXPECT_EQ(layout.chunks.size(), 2u);
    EXPECT_EQ(layout.header.time, 0.5);
  }
  file.chunks[1][1][1] = 2.5; // x more than the length of the box away from it
  EXPECT_THROW(layout_of(file.file()), granular::FormatError);
  file.time.reset();
  file.behind.clear();
  EXPECT_EQ(layout_of(file.file()).records, 5);
  file.behind = "mesh";
  EXPECT_THROW(layout_of(file.file()), granular::FormatError);
}

TEST(RestartLayout, FixesThatAreNone)
{
  RestartBuilder file = small_file();
  file.peratom_fixes[1].id = "p\x01";
  granular::Notices notices;
  granular::Progress progress;
  const std::string bytes = file.file();
  const RestartLayout layout =
    granular::read_layout(*granular::open_memory(bytes), notices, progress);
  EXPECT_EQ(layout.records, 5);
  EXPECT_FALSE(layout.has_fixes);
  EXPECT_TRUE(layout.fixes.empty());
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(to_string(notices[0]),
    "memory@" + std::to_string(file.base().size()) +
      ": expected what fixes have stored before the particles, found nothing: what they add to "
      "particles has no names");
}

TEST(RestartLayout, Packed)
{
  const Folder folder;
  const std::string bytes = small_file().file();
  expect_small(layout_of_file(folder.write("a.restart.gz", packing::gzip(bytes))));
  expect_small(layout_of_file(folder.write("a.restart.zst", packing::zstd(bytes))));
}

TEST(RestartLayout, FilesOfProcesses)
{
  const RestartBuilder file = small_file();
  const Folder folder;
  // the last `base` is the one
  const std::string base = folder.write("database_base.restart", file.base());
  const auto part = [](int process) { return "database_" + std::to_string(process) + ".restart"; };
  const auto said = [&] { return error_of([&] { layout_of_file(base); }); };
  EXPECT_EQ(said(),
    folder.path(part(0)) +
      ": expected the particles of process 0 of 2 in a file of their own, got none of "
      "this "
      "name");
  folder.write(part(0), file.part(0));
  EXPECT_EQ(said(),
    folder.path(part(1)) +
      ": expected the particles of process 1 of 2 in a file of their own, got none of "
      "this "
      "name");
  folder.write(part(1), file.part(1).substr(0, 100));
  EXPECT_EQ(said(),
    folder.path(part(1)) +
      "@0: expected as many doubles behind the count as it says, got a count of 34 and 96 bytes");
  folder.write(part(1), file.part(0));
  EXPECT_EQ(
    said(), folder.path(part(0)) + ": expected 5 particles in the files of 2 processes, got 6");
  std::string other = file.part(1);
  other.replace(4 + 17 * 8, 8, 8, '\xff');
  folder.write(part(1), other);
  EXPECT_EQ(said(),
    folder.path(part(1)) +
      "@140: expected the record of a particle, got other numbers (1 were before it)");
  folder.write(part(1), file.part(1));
  const RestartLayout layout = layout_of_file(base);
  EXPECT_EQ(layout.records, 5);
  EXPECT_EQ(fixes(layout).size(), 2u);
  EXPECT_EQ(layout.chunks[0].path, folder.path(part(0)));
  EXPECT_EQ(places(layout), (Places{ { 4, 51 }, { 4, 34 } }));
}

// The counts of fixes, two zeros, are not those of one or two processes without particles.
TEST(RestartLayout, FilesOfProcessesWithoutParticles)
{
  for (const std::size_t processes : { std::size_t{ 1 }, std::size_t{ 2 }, std::size_t{ 3 } })
  {
    RestartBuilder file;
    file.chunks.assign(processes, {});
    file.grid = { static_cast<std::int32_t>(processes), 1, 1 };
    for (const bool has_fix : { false, true })
    {
      if (has_fix)
      {
        file.peratom_fixes = { { "pa", "property/atom", 4 } };
      }
      const Folder folder;
      const std::string base = folder.write("a.base", file.base());
      for (std::size_t process = 0; process < processes; ++process)
      {
        folder.write("a." + std::to_string(process), file.part(process));
      }
      granular::Notices notices;
      granular::Progress progress;
      const auto layout = granular::read_layout(*granular::open_file(base), notices, progress);
      EXPECT_EQ(layout.records, 0);
      EXPECT_EQ(places(layout), Places(processes, { 4, 0 }));
      EXPECT_EQ(layout.chunks.back().path, folder.path("a." + std::to_string(processes - 1)));
      EXPECT_EQ(layout.begin, layout.size);
      EXPECT_EQ(layout.fixes.size(), has_fix ? 1u : 0u);
      EXPECT_TRUE(notices.empty());
    }
  }
  // all in one file
  RestartBuilder file;
  const Folder folder;
  granular::Notices notices;
  granular::Progress progress;
  const std::string base = folder.write("a.base", file.file());
  const auto layout = granular::read_layout(*granular::open_file(base), notices, progress);
  EXPECT_EQ(places(layout), (Places{ { static_cast<std::int64_t>(file.file().size()), 0 } }));
  EXPECT_TRUE(notices.empty());
}

// What was not found is said where it is missed.
TEST(RestartLayout, FixesOfNoParticles)
{
  RestartBuilder file;
  for (const bool particles : { false, true })
  {
    file.peratom_fixes = { { "p\x01", "property/atom", 4 } };
    file.chunks = { ::particles(1, particles ? 1 : 0) };
    granular::Notices notices;
    granular::Progress progress;
    const std::string bytes = file.file();
    EXPECT_FALSE(granular::read_layout(*granular::open_memory(bytes), notices, progress).has_fixes);
    EXPECT_EQ(notices.size(), particles ? 1u : 0u);
  }
}

TEST(RestartLayout, Cancelled)
{
  RestartBuilder file = small_file();
  file.forces = std::string(4'000'000, '\x11');
  const std::string bytes = file.file();
  granular::Notices notices;
  Stop never;
  expect_small(granular::read_layout(*granular::open_memory(bytes), notices, never));
  EXPECT_GT(never.last, 0.9);
  Stop early(Stop::never, 0.4);
  EXPECT_THROW(
    granular::read_layout(*granular::open_memory(bytes), notices, early), granular::Cancelled);
}

TEST(RestartLayout, OneFileWithBaseInItsName)
{
  const Folder folder;
  expect_small(layout_of_file(folder.write("base.restart", small_file().file())));
}
}
