// SPDX-License-Identifier: BSD-3-Clause
// Particles out of restart files: against the dumps that the programs wrote beside them, and files made by hand.
#include "restart_runs.h"
#include "shared_file.h"

#include "../local/text_frames.h"

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/formats/restart/record_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace
{
using granular::Request;
using granular::Table;
using granular::TableArray;
using granular::ValueType;
using restart_builder::Particle;
using restart_builder::Record;
using restart_builder::RestartBuilder;

RestartRun read_file(const std::string& path, const Request& request = {})
{
  return read_run(*granular::open_file(path), request);
}

std::string style_file(const std::string& name)
{
  return std::string(GRANULAR_DATA) + "/good/restart/style_" + name;
}

/// Rows of one frame of a text dump, by id: each column by its name.
using DumpRows = std::map<std::int64_t, std::map<std::string, double>>;

DumpRows dump_rows(const std::string& path, long timestep)
{
  DumpRows rows;
  for (const TextFrame& frame : read_text_frames(path))
  {
    for (std::size_t i = 0; frame.timestep == timestep && i < frame.rows.size(); ++i)
    {
      std::map<std::string, double> row;
      for (std::size_t column = 0; column < frame.columns.size(); ++column)
      {
        row[frame.columns[column]] = frame.rows[i].at(column);
      }
      rows[static_cast<std::int64_t>(row.at("id"))] = row;
    }
  }
  return rows;
}

double value_at(const TableArray& array, std::size_t row, std::size_t component)
{
  const std::size_t i = row * array.info.columns.size() + component;
  const void* const data = array.block.data();
  switch (array.info.type)
  {
    case ValueType::Int32:
      return static_cast<const std::int32_t*>(data)[i];
    case ValueType::Int64:
      return static_cast<double>(static_cast<const std::int64_t*>(data)[i]);
    default:
      return static_cast<const double*>(data)[i];
  }
}

/// Expects the values of all columns that both have, as the dump prints them with so many digits. Returns how many columns.
std::size_t expect_rows(const Table& frame, const DumpRows& rows, int digits)
{
  EXPECT_EQ(static_cast<std::size_t>(frame.rows), rows.size());
  const auto ids = values_of<std::int64_t>(frame, "id");
  const auto expect_value =
    [&](double value, double printed, const std::string& name, std::int64_t id)
  {
    // half a unit of the last digit that is printed; with 17 digits the very same
    const double allowed = digits == 17
      ? 0
      : 0.5000001 * std::pow(10, std::floor(std::log10(std::abs(printed) + 1e-300)) + 1 - digits);
    EXPECT_LE(std::abs(value - printed), allowed) << name << " of " << id;
  };
  std::size_t columns = 0;
  for (const TableArray& array : frame.arrays)
  {
    for (std::size_t component = 0; component < array.info.columns.size(); ++component)
    {
      const auto column = static_cast<std::size_t>(array.info.columns[component]);
      const std::string& name = frame.schema.columns()[column].name;
      if (!rows.begin()->second.contains(name))
      {
        continue;
      }
      ++columns;
      for (std::size_t row = 0; row < ids.size(); ++row)
      {
        expect_value(value_at(array, row, component), rows.at(ids[row]).at(name), name, ids[row]);
      }
    }
  }
  const auto points = points_of(frame);
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    const auto& printed = rows.at(ids[row]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::string name(1, "xyz"[axis]);
      expect_value(points[3 * row + axis], printed.at(name), name, ids[row]);
    }
  }
  return columns;
}

/// A file of one style with these records.
RestartBuilder file_of(const std::string& style, const std::vector<Record>& records)
{
  RestartBuilder builder;
  builder.atom_style = style;
  builder.chunks = { records };
  return builder;
}

/// One part of a style: common values, then these.
Record part_of(const Particle& particle, const std::vector<double>& more)
{
  Record record = restart_builder::common_block(particle);
  restart_builder::append(record, more);
  return record;
}
}

TEST(RestartRecords, ParticlesAsTheirDump)
{
  const std::string restart = shared_file("liggghts/grains.restart");
  if (restart.empty())
  {
    GTEST_SKIP() << "the file is not there";
  }
  const RestartRun run = read_file(restart);
  const DumpRows rows = dump_rows(shared_file("liggghts/grains.dump"), 4000);
  ASSERT_EQ(rows.size(), 1200u);
  EXPECT_EQ(run.frame.rows.header.timestep, 4000);
  EXPECT_EQ(run.frame.rows.header.rows, 1200);
  EXPECT_EQ(run.said(), "");
  // id type ix iy iz vx vy vz radius omega..., all but positions
  EXPECT_GE(expect_rows(run.frame.rows, rows, 6), 9u);
  EXPECT_FALSE(run.frame.bonds.has_lines);
  const auto mass = values_of<double>(run.frame.rows, "mass");
  const auto radius = values_of<double>(run.frame.rows, "radius");
  const auto density = values_of<double>(run.frame.rows, "density");
  ASSERT_EQ(mass.size(), 1200u);
  for (std::size_t i = 0; i < mass.size(); ++i)
  {
    const double pi = std::acos(-1.);
    EXPECT_NEAR(
      mass[i], density[i] * 4 / 3 * pi * radius[i] * radius[i] * radius[i], 1e-12 * mass[i]);
  }
}

// The values of the history are looked up by hand in the bytes of the file.
TEST(RestartRecords, BeamOfBonds)
{
  const std::string path = shared_file("reference/beam.restart");
  if (path.empty())
  {
    GTEST_SKIP() << "the file is not there";
  }
  const RestartRun run = read_file(path);
  EXPECT_EQ(run.frame.rows.rows, 11);
  EXPECT_EQ(run.said(), "");
  const Table& table = run.frame.bonds;
  ASSERT_EQ(table.rows, 10);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  const auto number = [&](std::size_t at)
  {
    double value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const auto id1 = values_of<std::int64_t>(table, "id1");
  const auto id2 = values_of<std::int64_t>(table, "id2");
  std::size_t at = 999; // of the first record, behind the number of doubles
  std::size_t bond = 0;
  for (std::int64_t particle = 1; particle <= 11; ++particle)
  {
    const std::size_t part = at + 17 * 8;
    ASSERT_EQ(number(part + 4 * 8), static_cast<double>(particle));
    const auto held = static_cast<std::size_t>(number(part + 12 * 8));
    ASSERT_EQ(number(part + (13 + 2 * held) * 8), 12);
    for (std::size_t i = 0; i < held; ++i)
    {
      const double partner = number(part + (14 + 2 * i) * 8);
      if (partner < static_cast<double>(particle))
      {
        continue; // the copy of the other one counts
      }
      EXPECT_EQ(id1[bond], particle);
      EXPECT_EQ(static_cast<double>(id2[bond]), partner);
      const std::size_t history = part + (14 + 2 * held + 12 * i) * 8;
      std::size_t value = 0;
      for (const char* const name :
        { "force_normal", "force_tangential", "torque_normal", "torque_tangential" })
      {
        for (std::size_t axis = 0; axis < 3; ++axis, ++value)
        {
          EXPECT_EQ(values_of<double>(table, name)[3 * bond + axis], number(history + value * 8));
        }
      }
      ++bond;
    }
    at += static_cast<std::size_t>(number(at)) * 8;
  }
  EXPECT_EQ(bond, 10u);
}

// Each by LIGGGHTS 3.8.0, with a dump of 17 digits.
TEST(RestartRecords, StylesAsTheirDumps)
{
  for (const std::string name :
    { "atomic", "charge", "sphere", "full", "ellipsoid", "tri", "sph", "sph_var", "molecular" })
  {
    const RestartRun run = read_file(style_file(name + ".restart"));
    const DumpRows rows = dump_rows(style_file(name + ".dump"), 0);
    ASSERT_FALSE(rows.empty()) << name;
    const std::size_t forms = 3; // x y z, which points are
    EXPECT_EQ(expect_rows(run.frame.rows, rows, 17), rows.begin()->second.size() - forms) << name;
    EXPECT_EQ(run.said(), "") << name;
    const auto masks = values_of<std::int32_t>(run.frame.rows, "mask");
    const auto ids = values_of<std::int64_t>(run.frame.rows, "id");
    for (std::size_t i = 0; i < ids.size() && name != "molecular"; ++i)
    {
      EXPECT_EQ(masks[i], ids[i] == 1 || ids[i] == 3 ? 3 : 1) << name;
    }
  }
}

// Written by LIGGGHTS: a chain of four, and what fixes have.
TEST(RestartRecords, BondsAndFixesOfMolecules)
{
  const RestartRun run = read_file(style_file("molecular.restart"));
  const Table& table = run.frame.bonds;
  EXPECT_EQ(values_of<std::int64_t>(table, "id1"), (std::vector<std::int64_t>{ 3, 1, 2 }));
  EXPECT_EQ(values_of<std::int64_t>(table, "id2"), (std::vector<std::int64_t>{ 4, 2, 3 }));
  EXPECT_EQ(values_of<std::int32_t>(table, "btype"), (std::vector<std::int32_t>{ 2, 1, 1 }));
  EXPECT_EQ(values_of<double>(run.frame.rows, "f_1"), std::vector<double>(4, 2.5));
  EXPECT_EQ(
    values_of<double>(run.frame.rows, "f_two"), (std::vector<double>{ 1, 2, 1, 2, 1, 2, 1, 2 }));
}

TEST(RestartRecords, WholeNumbers)
{
  for (const bool bits : { false, true })
  {
    for (const bool swapped : { false, true })
    {
      Particle particle{ (std::int64_t{ 1 } << 53) - 1, 1, 7, 0, { 0.25, 0.5, 0.75 }, { 1, 2, 3 },
        bits };
      RestartBuilder builder =
        file_of("granular", { restart_builder::granular_record(particle, 0.5, { 4, 5, 6 }) });
      builder.swapped = swapped;
      builder.tag_bytes = 8;
      const Table frame = read_run(builder).frame.rows;
      EXPECT_EQ(values_of<std::int64_t>(frame, "id"),
        std::vector<std::int64_t>{ (std::int64_t{ 1 } << 53) - 1 });
      EXPECT_EQ(values_of<std::int32_t>(frame, "type"), std::vector<std::int32_t>{ 1 });
      EXPECT_EQ(values_of<std::int32_t>(frame, "mask"), std::vector<std::int32_t>{ 7 });
      EXPECT_EQ(values_of<double>(frame, "v"), (std::vector<double>{ 1, 2, 3 }));
      EXPECT_EQ(values_of<double>(frame, "omega"), (std::vector<double>{ 4, 5, 6 }));
      EXPECT_EQ(values_of<double>(frame, "radius"), std::vector<double>{ 0.5 });
      EXPECT_EQ(points_of(frame), (std::vector<double>{ 0.25, 0.5, 0.75 }));
    }
  }
}

// Beside ids that are values the image is a value or bits, in fields of 10 or 21; beside ids that are bits it is bits.
TEST(RestartRecords, Images)
{
  for (const int bits : { 10, 21 })
  {
    const std::int64_t half = std::int64_t{ 1 } << (bits - 1);
    for (const std::int64_t count : { -half, std::int64_t{ -1 }, std::int64_t{ 0 }, half - 1 })
    {
      for (const bool as_bits : { false, true })
      {
        if (!as_bits && bits == 21)
        {
          continue; // a double has not so many
        }
        const std::int64_t image = restart_builder::image_of(1, count, count, bits);
        Particle values;
        values.bits = false;
        Record record = restart_builder::granular_record(values);
        record[7] = as_bits ? restart_builder::bits_of(image) : static_cast<double>(image);
        RestartBuilder builder = file_of("granular", { record });
        builder.tag_bytes = bits == 21 ? 8 : 4;
        const auto number = static_cast<std::int32_t>(count);
        EXPECT_EQ(values_of<std::int32_t>(read_run(builder).frame.rows, "image"),
          (std::vector<std::int32_t>{ 1, number, number }))
          << bits << " " << as_bits;
      }
    }
  }
}

// The bits of a count of 52224 and more along z are a double of 2^52 and more, which is whole.
TEST(RestartRecords, LargeImages)
{
  constexpr std::int32_t half = 1 << 20;
  for (const granular::ImageCounts& counts :
    { granular::ImageCounts{ 5, -7, 60000 }, granular::ImageCounts{ -half, -half, -half },
      granular::ImageCounts{ half - 1, half - 1, half - 1 }, granular::ImageCounts{ 0, 0, 52223 },
      granular::ImageCounts{ 1, 2, 52224 }, granular::ImageCounts{ -1, half - 1, 65536 } })
  {
    Particle particle;
    particle.image = restart_builder::image_of(counts.x, counts.y, counts.z, 21);
    RestartBuilder builder = file_of("granular", { restart_builder::granular_record(particle) });
    builder.tag_bytes = 8;
    EXPECT_EQ(values_of<std::int32_t>(read_run(builder).frame.rows, "image"),
      (std::vector<std::int32_t>{ counts.x, counts.y, counts.z }));
  }
}

TEST(RestartRecords, RequestsAndColumns)
{
  Particle particle;
  particle.x = { 10.25, 0.5, 0.75 };
  RestartBuilder builder = file_of("granular", { restart_builder::granular_record(particle) });
  builder.hi = { 20, 1, 1 };
  builder.timestep = 77;
  builder.time = 0.125;
  Request request;
  request.point_origin = { 10, 0, 0 };
  request.wanted = [](std::string_view name, bool) { return name == "radius" || name == "x"; };
  const Table frame = read_run(builder, request).frame.rows;
  ASSERT_EQ(frame.arrays.size(), 2u);
  EXPECT_EQ(values_of<double>(frame, "x"), std::vector<double>{ 10.25 });
  EXPECT_EQ(points_of(frame), (std::vector<double>{ 0.25, 0.5, 0.75 }));
  EXPECT_EQ(frame.schema.text(),
    "id type mask x y z ix iy iz vx vy vz radius mass density omegax omegay omegaz");
  EXPECT_EQ(frame.header.timestep, 77);
  EXPECT_EQ(frame.header.time, 0.125);
  EXPECT_EQ(frame.header.units, "si");
  EXPECT_EQ(frame.header.box.boundary, "pp pp ff");

  const std::string bytes = builder.file();
  const auto source = granular::open_memory(bytes);
  granular::Notices notices;
  granular::Progress progress;
  const auto columns = granular::find_restart_columns(
    *source, granular::read_layout(*source, notices, progress), notices, progress);
  EXPECT_EQ(granular::ColumnSchema(columns.particles), frame.schema);
  EXPECT_FALSE(columns.has_bonds);
}

TEST(RestartRecords, UnknownStyles)
{
  Particle particle;
  particle.v = { 1, 2, 3 };
  const RestartRun alone = read_run(file_of("peri/secret", { part_of(particle, { 1, 2, 3, 4 }) }));
  EXPECT_EQ(values_of<double>(alone.frame.rows, "v"), (std::vector<double>{ 1, 2, 3 }));
  EXPECT_EQ(alone.notices.size(), 1u);
  EXPECT_NE(alone.said().find("'peri/secret'"), std::string::npos);

  // first of a hybrid: where it ends is found
  RestartBuilder builder = file_of("hybrid",
    { restart_builder::join({ part_of(particle, { 11, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 }),
        restart_builder::granular_record(particle, 0.75) }),
      restart_builder::join(
        { part_of(particle, { 1 }), restart_builder::granular_record(particle, 0.5) }) });
  builder.styles = { "peri/secret", "granular" };
  const RestartRun first = read_run(builder);
  EXPECT_EQ(values_of<double>(first.frame.rows, "radius"), (std::vector<double>{ 0.75, 0.5 }));
  EXPECT_EQ(first.notices.size(), 1u);

  // another length than the table says
  builder = file_of("hybrid",
    { restart_builder::join(
      { restart_builder::granular_record(particle, 0.75), part_of(particle, { 1, 2 }) }) });
  builder.styles = { "granular", "charge" };
  const RestartRun other = read_run(builder);
  EXPECT_EQ(values_of<double>(other.frame.rows, "radius"), std::vector<double>{ 0.75 });
  EXPECT_EQ(array_of(other.frame.rows, "q"), nullptr);
  EXPECT_NE(other.said().find("'charge'"), std::string::npos);
}

// Each style of the table, alone and behind another one, with lists of some length.
TEST(RestartRecords, EveryStyleOfTheTable)
{
  for (const std::string name : { "atomic", "charge", "granular", "sphere", "bond", "molecular",
         "full", "ellipsoid", "line", "tri", "sph", "sph/var", "superquadric",
         "granular_superquadric" }) // bond/gran: see RestartBonds
  {
    ASSERT_NE(granular::find_style(name), nullptr) << name;
    const granular::StyleLayout& style = *granular::find_style(name);
    for (const bool bits : { false, true })
    {
      std::vector<double> more;
      for (std::size_t i = granular::RecordSlots::common; i < style.values; ++i)
      {
        more.push_back(bits && style.columns.find("mol") != style.columns.npos
            ? restart_builder::bits_of(static_cast<std::int64_t>(i))
            : static_cast<double>(i));
      }
      std::int64_t entries = 1;
      for (const std::size_t width : style.lists)
      {
        if (width > 0)
        {
          more.push_back(bits ? restart_builder::bits_of(entries) : static_cast<double>(entries));
          // each bond is with particle 1
          more.insert(more.end(), width * static_cast<std::size_t>(entries),
            bits ? restart_builder::bits_of(1) : 1);
          entries = 2 - entries;
        }
      }
      Particle particle;
      particle.bits = bits;
      const RestartRun alone = read_run(file_of(name, { part_of(particle, more) }));
      RestartBuilder builder = file_of("hybrid",
        { restart_builder::join(
          { part_of(particle, more), restart_builder::granular_record(particle, 0.75) }) });
      builder.styles = { name, "granular" };
      const RestartRun both = read_run(builder);
      for (const RestartRun* const run : { &alone, &both })
      {
        EXPECT_EQ(run->said().find("is not known"), std::string::npos) << name;
        std::size_t slot = granular::RecordSlots::common;
        std::istringstream columns{ std::string(style.columns) };
        for (std::string column; columns >> column; ++slot)
        {
          if (column == "mol")
          {
            EXPECT_EQ(values_of<std::int64_t>(run->frame.rows, "mol"),
              std::vector<std::int64_t>{ static_cast<std::int64_t>(slot) });
          }
        }
        EXPECT_EQ(slot, style.values) << name;
        EXPECT_EQ(run->frame.bonds.rows, style.bonds ? 1 : 0) << name;
      }
    }
  }
}

TEST(RestartRecords, WhatFixesHave)
{
  const auto file = [](const std::vector<std::vector<double>>& behind)
  {
    std::vector<Record> records;
    for (std::size_t i = 0; i < behind.size(); ++i)
    {
      Particle particle;
      particle.tag = static_cast<std::int64_t>(i) + 1;
      records.push_back(restart_builder::granular_record(particle));
      restart_builder::append(records.back(), behind[i]);
    }
    RestartBuilder builder = file_of("granular", records);
    builder.peratom_fixes = { { "one", "property/atom", 2 }, { "contacts", "contacthistory", 40 },
      { "three", "property/atom", 4 } };
    return builder;
  };
  const RestartRun run =
    read_run(file({ { 2, 5, 6, 0, 1, 1, 1, 1, 4, 7, 8, 9 }, { 2, 6, 2, 0, 4, 1, 2, 3 } }));
  EXPECT_EQ(run.said(), "");
  EXPECT_EQ(values_of<double>(run.frame.rows, "f_one"), (std::vector<double>{ 5, 6 }));
  EXPECT_EQ(
    values_of<double>(run.frame.rows, "f_three"), (std::vector<double>{ 7, 8, 9, 1, 2, 3 }));
  EXPECT_EQ(array_of(run.frame.rows, "f_contacts"), nullptr);
  // lengths that lie: none, and all else
  for (const std::vector<std::vector<double>>& behind :
    std::vector<std::vector<std::vector<double>>>{
      { { 3, 5, 6, 3, 0, 0, 4, 1, 2, 3 }, { 2, 6, 2, 0, 4, 1, 2, 3 } },
      { { 2, 6, 2, 0, 4, 1, 2, 3 }, { 2, 6, 2, 0, 5, 1, 2, 3 } },
      { { 2, 6, 2, 0, 4, 1, 2, 3 }, { 2, 6, 2, 0 } },
      { { 2, 6, 2, 0, 4, 1, 2, 3 }, { 3, 6, 7, 2, 0, 4, 1, 2, 3 } } })
  {
    for (int piece = 0; piece < 2; ++piece)
    {
      Request request;
      request.piece = piece;
      request.pieces = 2;
      const RestartRun lie = read_run(file(behind), request);
      EXPECT_EQ(array_of(lie.frame.rows, "f_one"), nullptr);
      EXPECT_EQ(array_of(lie.frame.rows, "f_three"), nullptr);
      EXPECT_EQ(values_of<double>(lie.frame.rows, "radius"), std::vector<double>{ 0.1 });
      EXPECT_EQ(lie.notices.size(), 1u);
    }
  }
}

// As LIGGGHTS writes them when a fix was defined again: its part is the last of the records, in the list it stays where it was.
TEST(RestartRecords, FixesInAnotherOrder)
{
  using Fixes = std::vector<restart_builder::PeratomFix>;
  const auto run = [](const Fixes& fixes, const std::vector<double>& behind)
  {
    Record record = restart_builder::granular_record({});
    restart_builder::append(record, behind);
    RestartBuilder builder = file_of("granular", { record });
    builder.peratom_fixes = fixes;
    return read_run(builder);
  };
  const Fixes fixes = { { "a", "property/atom", 3 }, { "b", "property/atom", 5 },
    { "contacts", "contacthistory", 2 }, { "c", "property/atom", 4 }, { "hold", "other", 9 } };
  const RestartRun all =
    run(fixes, { 5, 1, 2, 3, 4, 2, 0, 7, 1, 1, 1, 1, 1, 1, 4, 7, 8, 9, 3, 5, 6 });
  EXPECT_EQ(all.said(), "");
  EXPECT_EQ(values_of<double>(all.frame.rows, "f_a"), (std::vector<double>{ 5, 6 }));
  EXPECT_EQ(values_of<double>(all.frame.rows, "f_b"), (std::vector<double>{ 1, 2, 3, 4 }));
  EXPECT_EQ(values_of<double>(all.frame.rows, "f_c"), (std::vector<double>{ 7, 8, 9 }));
  // more than one way, and none: two fixes as long, a part as long of a fix without columns, one that is too long
  for (const auto& [of, behind] :
    std::vector<std::pair<Fixes, std::vector<double>>>{
      { { { "a", "property/atom", 2 }, { "b", "property/atom", 2 }, { "c", "property/atom", 4 } },
        { 2, 5, 4, 7, 8, 9, 2, 6 } },
      { { { "a", "property/atom", 2 }, { "c", "property/atom", 4 },
          { "contacts", "contacthistory", 2 } },
        { 4, 7, 8, 9, 2, 5, 2, 0 } },
      { { { "contacts", "contacthistory", 2 }, { "c", "property/atom", 4 } },
        { 4, 7, 8, 9, 3, 0, 0 } } })
  {
    const RestartRun none = run(of, behind);
    EXPECT_EQ(array_of(none.frame.rows, "f_a"), nullptr);
    EXPECT_EQ(array_of(none.frame.rows, "f_c"), nullptr);
    EXPECT_NE(none.said().find("what fixes have of particles is not where it should be"),
      std::string::npos);
    EXPECT_EQ(values_of<double>(none.frame.rows, "radius"), std::vector<double>{ 0.1 });
  }
}

// A style of which the records are longer than the table says, with no fix that could have made them so.
TEST(RestartRecords, LongerThanTheTable)
{
  Particle particle;
  particle.v = { 1, 2, 3 };
  const Record longer = part_of(particle, { 0.5, 4, 5, 7, 7, 7, 1, 2, 3 });
  RestartBuilder builder = file_of("granular", { longer, longer });
  for (const bool has_fix : { false, true })
  {
    if (has_fix)
    {
      builder.peratom_fixes = { { "one", "property/atom", 2 } };
      for (Record& record : builder.chunks[0])
      {
        restart_builder::append(record, { 2, 9 });
      }
    }
    const RestartRun run = read_run(builder);
    EXPECT_NE(run.said().find("'granular' have in restart files is not known of this program"),
      std::string::npos)
      << run.said();
    EXPECT_EQ(run.notices.size(), 1u);
    EXPECT_EQ(array_of(run.frame.rows, "omega"), nullptr);
    EXPECT_EQ(array_of(run.frame.rows, "radius"), nullptr);
    EXPECT_EQ(array_of(run.frame.rows, "f_one"), nullptr);
    EXPECT_EQ(values_of<double>(run.frame.rows, "v"), (std::vector<double>{ 1, 2, 3, 1, 2, 3 }));
  }
}

TEST(RestartRecords, AnyThreadsAndPieces)
{
  std::vector<std::vector<Record>> chunks(3);
  std::string ids;
  for (std::int64_t id = 1; id <= 60000; ++id)
  {
    Particle particle;
    particle.tag = id;
    particle.x[1] = static_cast<double>(id) / 65536;
    chunks[id < 100   ? 0
        : id % 7 == 0 ? 1
                      : 2]
      .push_back(restart_builder::granular_record(particle));
  }
  RestartBuilder builder = file_of("granular", {});
  builder.chunks = chunks;
  builder.grid = { 3, 1, 1 };
  const std::string bytes = builder.file();
  const auto source = granular::open_memory(bytes);
  const RestartRun whole = read_run(*source);
  const auto expected = values_of<std::int64_t>(whole.frame.rows, "id");
  ASSERT_EQ(expected.size(), 60000u);
  for (std::size_t i = 0, chunk = 0, in_chunk = 0; i < expected.size(); ++i)
  {
    while (in_chunk == chunks[chunk].size())
    {
      ++chunk;
      in_chunk = 0;
    }
    ASSERT_EQ(restart_builder::bits_of(expected[i]), chunks[chunk][in_chunk++][4]);
  }
  for (const int threads : { 1, 3 })
  {
    for (const int pieces : { 1, 2, 5, 70000 })
    {
      std::vector<std::int64_t> found;
      for (int piece = 0; piece<pieces; piece += pieces> 5 ? 6999 : 1)
      {
        Request request;
        request.threads = threads;
        request.piece = piece;
        request.pieces = pieces;
        const RestartRun part = read_run(*source, request);
        const auto more = values_of<std::int64_t>(part.frame.rows, "id");
        EXPECT_EQ(part.frame.rows.header.rows, 60000);
        if (pieces > 5)
        {
          EXPECT_LE(more.size(), 1u);
        }
        found.insert(found.end(), more.begin(), more.end());
      }
      EXPECT_TRUE(pieces > 5 || found == expected) << threads << " " << pieces;
    }
  }
}
