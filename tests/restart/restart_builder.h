// SPDX-License-Identifier: BSD-3-Clause
// Restart files made by hand, byte for byte after the description of the format, with nothing of the code under test.
#ifndef granular_tests_restart_restart_builder_h
#define granular_tests_restart_restart_builder_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace restart_builder
{
/// A record of a particle, or a block of one: doubles, of which the first is set to how many there are.
using Record = std::vector<double>;

/// The bits of a whole number in a double, as newer programs store them.
inline double bits_of(std::int64_t number)
{
  double slot = 0;
  std::memcpy(&slot, &number, sizeof(slot));
  return slot;
}

/// Image flags as programs keep them: three fields, each biased.
inline std::int64_t image_of(std::int64_t x, std::int64_t y, std::int64_t z, int field_bits = 10)
{
  const std::int64_t bias = std::int64_t{ 1 } << (field_bits - 1);
  return (x + bias) | ((y + bias) << field_bits) | ((z + bias) << (2 * field_bits));
}

/// What all atom styles begin with. bits: whole numbers are bits, else values.
struct Particle
{
  std::int64_t tag = 1;
  std::int64_t type = 1;
  std::int64_t mask = 1;
  std::int64_t image = image_of(0, 0, 0);
  std::array<double, 3> x = { 0.5, 0.5, 0.5 };
  std::array<double, 3> v = {};
  bool bits = true;
};

/// The 11 doubles of all styles; the first is 11.
inline Record common_block(const Particle& particle)
{
  const auto slot = [&](std::int64_t number)
  { return particle.bits ? bits_of(number) : static_cast<double>(number); };
  return { 11, particle.x[0], particle.x[1], particle.x[2], slot(particle.tag), slot(particle.type),
    slot(particle.mask), slot(particle.image), particle.v[0], particle.v[1], particle.v[2] };
}

inline void append(Record& record, const std::vector<double>& more)
{
  record.insert(record.end(), more.begin(), more.end());
  record[0] = static_cast<double>(record.size());
}

/// Style granular (sphere): 17 doubles. Density 2500.
inline Record granular_record(
  const Particle& particle, double radius = 0.1, const std::array<double, 3>& omega = {})
{
  constexpr double density = 2500;
  Record record = common_block(particle);
  append(record,
    { radius, 4. / 3 * 3.14159265358979323846 * radius * radius * radius * density, density,
      omega[0], omega[1], omega[2] });
  return record;
}

struct BondOf
{
  std::int64_t type = 1;
  std::int64_t partner = 2;
  std::vector<double> history; ///< as many as all others
};

/// Style bond/gran: the 11 doubles, molecule, bonds, type and partner of each; then, unless history_values is 0, this number and the
/// history of each.
inline Record bond_block(const Particle& particle, const std::vector<BondOf>& bonds,
  int history_values, std::int64_t molecule = 0)
{
  Record record = common_block(particle);
  append(record, { static_cast<double>(molecule), static_cast<double>(bonds.size()) });
  for (const BondOf& bond : bonds)
  {
    append(record, { static_cast<double>(bond.type), static_cast<double>(bond.partner) });
  }
  if (history_values > 0)
  {
    append(record, { static_cast<double>(history_values) });
    for (const BondOf& bond : bonds)
    {
      append(record, bond.history);
    }
  }
  return record;
}

/// Blocks of a hybrid, each with a length of its own but the first, which has that of all.
inline Record join(const std::vector<Record>& blocks)
{
  Record record;
  for (const Record& block : blocks)
  {
    record.insert(record.end(), block.begin(), block.end());
  }
  record[0] = static_cast<double>(record.size());
  return record;
}

struct GlobalFix
{
  std::string id;
  std::string style;
  std::string state;
};

struct PeratomFix
{
  std::string id;
  std::string style;
  std::int32_t most = 0;
};

struct BondStyle
{
  std::int32_t types = 1;
  std::int32_t per_atom = 6;
};

/// A restart file; every member may be set before file(), base() or part() is called.
struct RestartBuilder
{
  bool swapped = false; ///< the other byte order
  int tag_bytes = 4;
  int count_bytes = 8;
  std::string version = "Version LIGGGHTS-PUBLIC 3.8.0, by hand";
  std::string units = "si";
  std::int64_t timestep = 0;
  std::optional<double> time; ///< flag 52
  std::int32_t dimension = 3;
  std::array<std::int32_t, 3> grid = { 1, 1, 1 }; ///< of processes
  std::optional<std::int32_t> processes;          ///< else as many as chunks
  std::int32_t newton_pair = 0;
  std::int32_t newton_bond = 0;
  std::array<std::int32_t, 3> periodic = { 1, 1, 0 };
  std::array<std::int32_t, 6> boundary = { 0, 0, 0, 0, 1, 1 }; ///< xlo xhi ylo ...
  std::string atom_style = "granular";
  std::vector<std::string> styles;    ///< of a hybrid
  std::vector<BondStyle> bond_styles; ///< of each bond/gran
  std::optional<std::int64_t> atoms;  ///< else as many as records
  std::int32_t types = 1;
  std::int64_t bonds = 0;
  std::int32_t bond_types = 0;
  std::int32_t bonds_per_atom = 0;
  std::array<double, 3> lo = { 0, 0, 0 };
  std::array<double, 3> hi = { 1, 1, 1 };
  std::optional<std::array<double, 3>> tilts;  ///< xy xz yz
  std::vector<std::string> groups = { "all" }; ///< an empty name: an empty slot
  std::vector<double> masses;                  ///< none: no array
  std::string forces = std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8); ///< two ends by default
  std::vector<GlobalFix> global_fixes;
  std::vector<PeratomFix> peratom_fixes;
  std::vector<std::vector<Record>> chunks = { {} }; ///< of each process
  std::string behind;                               ///< the particles

  template <class Number>
  void put(std::string& out, Number number) const
  {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof(Number));
    if (swapped)
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    out.append(bytes.data(), bytes.size());
  }

  void put_int(std::string& out, std::int64_t number) const
  {
    this->put(out, static_cast<std::int32_t>(number));
  }

  void put_count(std::string& out, std::int64_t number) const
  {
    if (count_bytes == 8)
    {
      this->put(out, number);
    }
    else
    {
      this->put_int(out, number);
    }
  }

  void put_string(std::string& out, const std::string& text) const
  {
    this->put_int(out, static_cast<std::int64_t>(text.size()) + 1);
    out.append(text.c_str(), text.size() + 1);
  }

  void put_ints(std::string& out, std::int32_t flag, const std::vector<std::int32_t>& numbers) const
  {
    for (const std::int32_t number : numbers)
    {
      this->put_int(out, flag++);
      this->put_int(out, number);
    }
  }

  void put_counts(std::string& out, std::int32_t flag, std::int64_t number) const
  {
    this->put_int(out, flag);
    this->put_count(out, number);
  }

  void put_reals(std::string& out, std::int32_t flag, const std::vector<double>& numbers) const
  {
    for (const double number : numbers)
    {
      this->put_int(out, flag++);
      this->put(out, number);
    }
  }

  std::int64_t records() const
  {
    std::size_t records = 0;
    for (const auto& chunk : chunks)
    {
      records += chunk.size();
    }
    return static_cast<std::int64_t>(records);
  }

  void put_styles(std::string& out) const
  {
    this->put_int(out, 22);
    this->put_string(out, atom_style);
    if (atom_style == "hybrid")
    {
      this->put_int(out, static_cast<std::int64_t>(styles.size()));
      for (const std::string& style : styles)
      {
        this->put_string(out, style);
      }
    }
    for (const BondStyle& style : bond_styles)
    {
      this->put_int(out, style.types);
      this->put_int(out, style.per_atom);
    }
  }

  std::string header() const
  {
    std::string out;
    this->put_int(out, 0);
    this->put_string(out, version);
    this->put_ints(out, 1, { 4, tag_bytes, count_bytes });
    this->put_int(out, 4);
    this->put_string(out, units);
    this->put_counts(out, 5, timestep);
    this->put_ints(out, 6,
      { dimension, processes.value_or(static_cast<std::int32_t>(chunks.size())), grid[0], grid[1],
        grid[2], newton_pair, newton_bond, periodic[0], periodic[1], periodic[2], boundary[0],
        boundary[1], boundary[2], boundary[3], boundary[4], boundary[5] });
    this->put_styles(out);
    this->put_counts(out, 23, atoms.value_or(this->records()));
    this->put_ints(out, 24, { types });
    this->put_counts(out, 25, bonds);
    this->put_ints(out, 26, { bond_types, bonds_per_atom });
    for (const std::int32_t flag : { 28, 31, 34 })
    {
      this->put_counts(out, flag, 0);
      this->put_ints(out, flag + 1, { 0, 0 });
    }
    this->put_reals(out, 37, { lo[0], hi[0], lo[1], hi[1], lo[2], hi[2], 0, 0, 0, 0, 0, 0 });
    if (tilts)
    {
      this->put_reals(out, 49, { (*tilts)[0], (*tilts)[1], (*tilts)[2] });
    }
    if (time)
    {
      this->put_reals(out, 52, { *time });
    }
    this->put_int(out, -1);
    return out;
  }

  std::string groups_and_masses() const
  {
    std::string out;
    this->put_int(out,
      static_cast<std::int64_t>(groups.size()) -
        std::count(groups.begin(), groups.end(), std::string()));
    for (const std::string& group : groups)
    {
      if (group.empty())
      {
        this->put_int(out, 0);
      }
      else
      {
        this->put_string(out, group);
      }
    }
    if (!masses.empty())
    {
      this->put_int(out, 0);
      for (const double mass : masses)
      {
        this->put(out, mass);
      }
    }
    this->put_int(out, -1);
    return out;
  }

  std::string fixes() const
  {
    std::string out;
    this->put_int(out, static_cast<std::int64_t>(global_fixes.size()));
    for (const GlobalFix& fix : global_fixes)
    {
      this->put_string(out, fix.id);
      this->put_string(out, fix.style);
      this->put_int(out, static_cast<std::int64_t>(fix.state.size()));
      out += fix.state;
    }
    this->put_int(out, static_cast<std::int64_t>(peratom_fixes.size()));
    for (const PeratomFix& fix : peratom_fixes)
    {
      this->put_string(out, fix.id);
      this->put_string(out, fix.style);
      this->put_int(out, fix.most);
    }
    return out;
  }

  /// The file `base` of a restart file of several files: all but the particles.
  std::string base() const
  {
    return this->header() + this->groups_and_masses() + forces + this->fixes();
  }

  /// The file of a process of these.
  std::string part(std::size_t process) const
  {
    std::size_t doubles = 0;
    for (const Record& record : chunks[process])
    {
      doubles += record.size();
    }
    std::string out;
    this->put_int(out, static_cast<std::int64_t>(doubles));
    for (const Record& record : chunks[process])
    {
      for (const double number : record)
      {
        this->put(out, number);
      }
    }
    return out;
  }

  std::string file() const
  {
    std::string out = this->base();
    for (std::size_t process = 0; process < chunks.size(); ++process)
    {
      out += this->part(process);
    }
    return out + behind;
  }
};
}
#endif
