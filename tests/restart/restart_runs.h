// SPDX-License-Identifier: BSD-3-Clause
// Restart files made by hand, read and easy to look at.
#ifndef granular_tests_restart_restart_runs_h
#define granular_tests_restart_restart_runs_h

#include "granular/bytes/byte_source.h"
#include "granular/formats/restart/restart_layout.h"
#include "granular/formats/restart/restart_reader.h"

#include "restart_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// A restart file that was read.
struct RestartRun
{
  granular::RestartLayout layout;
  granular::Tables frame;
  granular::Notices notices;

  std::string said() const
  {
    std::string text;
    for (const granular::Notice& notice : notices)
    {
      text += to_string(notice) + "\n";
    }
    return text;
  }
};

inline RestartRun read_run(const granular::ByteSource& source,
  const granular::Request& request = {}, int history_layout = granular::automatic_history)
{
  RestartRun run;
  granular::Progress progress;
  run.layout = granular::read_layout(source, run.notices, progress);
  run.notices.clear();
  run.frame =
    granular::read_restart(source, run.layout, history_layout, request, run.notices, progress);
  return run;
}

inline RestartRun read_run(const restart_builder::RestartBuilder& builder,
  const granular::Request& request = {}, int history_layout = granular::automatic_history)
{
  const std::string bytes = builder.file();
  return read_run(*granular::open_memory(bytes), request, history_layout);
}

/// A file, by the layout of another one.
inline RestartRun read_as(
  const std::string& layout, const std::string& bytes, const granular::Request& request = {})
{
  RestartRun run;
  granular::Progress progress;
  run.layout = granular::read_layout(*granular::open_memory(layout), run.notices, progress);
  run.notices.clear();
  run.frame = granular::read_restart(*granular::open_memory(bytes), run.layout,
    granular::automatic_history, request, run.notices, progress);
  return run;
}

/// An array, or null.
inline const granular::TableArray* array_of(const granular::Table& frame, std::string_view name)
{
  for (const granular::TableArray& array : frame.arrays)
  {
    if (array.info.name == name)
    {
      return &array;
    }
  }
  return nullptr;
}

/// Its values, row by row; none if it is not there.
template <class Value>
std::vector<Value> values_of(const granular::Table& frame, std::string_view name)
{
  const granular::TableArray* const array = array_of(frame, name);
  if (!array)
  {
    return {};
  }
  EXPECT_EQ(array->block.bytes(),
    static_cast<std::size_t>(frame.rows) * array->info.columns.size() * sizeof(Value))
    << name;
  const auto* const values = static_cast<const Value*>(array->block.data());
  return { values, values + array->block.bytes() / sizeof(Value) };
}

inline std::vector<double> points_of(const granular::Table& frame)
{
  const auto* const values = static_cast<const double*>(frame.points.data());
  return { values, values + 3 * frame.rows };
}

inline std::vector<double> line_points_of(const granular::Table& frame)
{
  const auto* const values = static_cast<const double*>(frame.lines.points.data());
  return { values, values + 6 * frame.lines.count };
}

/// Everything that was read, byte for byte.
inline std::string bytes_of(const granular::Table& frame)
{
  std::string bytes = std::to_string(frame.rows) + " of " + std::to_string(frame.header.rows) +
    ": " + frame.schema.text();
  for (const granular::TableArray& array : frame.arrays)
  {
    bytes += "|" + array.info.name + "|";
    bytes.append(static_cast<const char*>(array.block.data()), array.block.bytes());
  }
  bytes += "|points|";
  return bytes.append(static_cast<const char*>(frame.points.data()), frame.points.bytes());
}

inline std::string bytes_of(const granular::Tables& frame)
{
  std::string bytes = bytes_of(frame.rows) + bytes_of(frame.bonds);
  const granular::Lines& lines = frame.bonds.lines;
  bytes.append(static_cast<const char*>(lines.points.data()), lines.points.bytes());
  return bytes.append(static_cast<const char*>(lines.lengths.data()), lines.lengths.bytes());
}

/// A bond that a particle holds.
struct HeldBond
{
  std::int64_t type = 1;
  std::int64_t partner = 2;
  std::vector<double> history = {}; ///< as many as all others
};

/// A file of the style hybrid granular bond/gran: particle id, the bonds it holds, and where it is.
struct BondedParticle
{
  std::int64_t id = 1;
  std::vector<HeldBond> bonds = {};
  double x = 0.5;
};

inline restart_builder::RestartBuilder bonded_file(
  const std::vector<BondedParticle>& particles, int history_values = 0)
{
  restart_builder::RestartBuilder builder;
  builder.atom_style = "hybrid";
  builder.styles = { "granular", "bond/gran" };
  std::int32_t most = 6;
  for (const BondedParticle& of : particles)
  {
    most = std::max(most, static_cast<std::int32_t>(of.bonds.size()));
    restart_builder::Particle particle;
    particle.tag = of.id;
    particle.x[0] = of.x;
    restart_builder::Particle values = particle;
    values.bits = false;
    std::vector<restart_builder::BondOf> bonds;
    for (const HeldBond& bond : of.bonds)
    {
      bonds.push_back({ bond.type, bond.partner, bond.history });
    }
    builder.chunks[0].push_back(restart_builder::join({ restart_builder::granular_record(particle),
      restart_builder::bond_block(values, bonds, history_values) }));
  }
  builder.bond_styles = { { 1, most } };
  builder.bonds_per_atom = most;
  builder.bond_types = 1;
  return builder;
}
#endif
