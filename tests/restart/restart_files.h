// SPDX-License-Identifier: BSD-3-Clause
// Restart files in memory and on disk, for tests.
#ifndef granular_tests_restart_restart_files_h
#define granular_tests_restart_restart_files_h

#include "granular/formats/restart/restart_layout.h"

#include "restart_builder.h"

#include <filesystem>
#include <string>
#include <string_view>

/// The layout of a file in memory.
inline granular::RestartLayout layout_of(std::string_view bytes, const std::string& name = "memory")
{
  granular::Notices notices;
  granular::Progress progress;
  return granular::read_layout(*granular::open_memory(bytes, name), notices, progress);
}

/// The same of a file on disk, which may be packed.
inline granular::RestartLayout layout_of_file(const std::string& path)
{
  granular::Notices notices;
  granular::Progress progress;
  return granular::read_layout(*granular::unpack(granular::open_file(path)), notices, progress);
}

/// Grains with ids from `first` on, in the box from 0 to 1.
inline std::vector<restart_builder::Record> particles(std::int64_t first, std::size_t count)
{
  std::vector<restart_builder::Record> records;
  for (std::size_t i = 0; i < count; ++i)
  {
    restart_builder::Particle particle;
    particle.tag = first + static_cast<std::int64_t>(i);
    particle.x[0] = 0.1 + 0.8 * static_cast<double>(i) / static_cast<double>(count);
    records.push_back(restart_builder::granular_record(particle));
  }
  return records;
}

/// A small file with a bit of everything: two processes, masses, groups with a free slot, forces and fixes.
inline restart_builder::RestartBuilder small_file()
{
  restart_builder::RestartBuilder file;
  file.timestep = 1234;
  file.types = 2;
  file.grid = { 2, 1, 1 };
  file.groups = { "all", "", "walls" };
  file.masses = { 1.5, 2.5 };
  file.forces = "any bytes \x01\x02 of a force field";
  file.global_fixes = { { "pts1", "particletemplate/sphere", std::string(16, '\x07') } };
  file.peratom_fixes = { { "contacthistory", "contacthistory", 9 }, { "pa", "property/atom", 4 } };
  file.chunks = { particles(1, 3), particles(4, 2) };
  return file;
}
#endif
