// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/error.h"
#include "granular/formats/restart/header_fields.h"
#include "granular/formats/restart/restart_bytes.h"
#include "granular/formats/restart/restart_layout.h"
#include "granular/frames/other_files.h"
#include "granular/geometry/compensated.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

namespace granular
{
namespace
{
/// The value of a flag, as what its kind says.
struct Value
{
  std::int64_t byte = -1; ///< where it is; -1: nowhere
  std::int64_t whole = 0;
  double real = 0;
  std::string text;
};

class HeaderReader
{
public:
  explicit HeaderReader(RestartBytes& bytes)
    : bytes_(bytes)
  {
  }

  RestartHeader read()
  {
    this->find_byte_order();
    while (this->read_field())
    {
    }
    for (std::size_t i = 0; i < header_fields.size(); ++i)
    {
      if (header_fields[i].needed && !this->has(i))
      {
        bytes_.refuse(
          std::string(header_fields[i].name) + " (flag " + std::to_string(i) + ") in the header",
          "the end of the header", at_);
      }
    }
    this->check_grid();
    this->take_values();
    this->take_box();
    header_.end = at_;
    return std::move(header_);
  }

private:
  bool has(std::size_t i) const { return values_[i].byte >= 0; }

  [[noreturn]] void fail(std::size_t i, const std::string& expected, const std::string& got) const
  {
    bytes_.refuse(expected, got, values_[i].byte);
  }

  /// The first flag is 0 in either order; behind it is the length of a text.
  void find_byte_order()
  {
    refuse_other(bytes_.source(), "a restart file of LIGGGHTS");
    bytes_.set_swapped(false);
    const auto first = bytes_.number_at<std::int32_t>(0, "the header of a restart file");
    bytes_.set_swapped(bytes_.text_end(4) < 0);
    if (first != 0 || bytes_.text_end(4) < 0)
    {
      bytes_.set_swapped(false);
      bytes_.refuse("the header of a restart file, which begins with the version of the program",
        "other bytes", 0);
    }
  }

  std::int64_t next_int(std::string_view what) { return bytes_.next<std::int32_t>(at_, what); }

  /// False at the end of the header.
  bool read_field()
  {
    const std::int64_t begin = at_;
    const std::int64_t number = this->next_int("a flag of the header");
    if (number == -1)
    {
      return false;
    }
    if (number < 0 || number >= static_cast<std::int64_t>(header_fields.size()))
    {
      bytes_.refuse("a flag of the header, -1 to " + std::to_string(header_fields.size() - 1),
        std::to_string(number), begin);
    }
    const auto i = static_cast<std::size_t>(number);
    if (this->has(i))
    {
      bytes_.refuse(std::string(header_fields[i].name) + " once in the header", "it again", begin);
    }
    this->read_value(i);
    if (i == flag::atom_style)
    {
      this->read_styles();
    }
    return true;
  }

  void read_value(std::size_t i)
  {
    const HeaderField& field = header_fields[i];
    Value& value = values_[i];
    value.byte = at_;
    switch (field.kind)
    {
      case FieldKind::Text:
        value.text = bytes_.next_text(at_, field.name);
        break;
      case FieldKind::Int:
        value.whole = this->next_int(field.name);
        this->check_whole(i);
        break;
      case FieldKind::Count:
        this->read_count(i);
        this->check_whole(i);
        break;
      case FieldKind::Real:
        value.real = bytes_.next<double>(at_, field.name);
        if (!std::isfinite(value.real))
        {
          this->fail(i, std::string("a number for ") + field.name, std::to_string(value.real));
        }
        break;
    }
  }

  void read_count(std::size_t i)
  {
    if (!this->has(flag::count_bytes))
    {
      this->fail(i,
        header_fields[flag::count_bytes].name + std::string(" (flag 3) before any count"),
        header_fields[i].name);
    }
    const bool is_short = values_[flag::count_bytes].whole == 4;
    values_[i].whole = is_short ? this->next_int(header_fields[i].name)
                                : bytes_.next<std::int64_t>(at_, header_fields[i].name);
  }

  void check_whole(std::size_t i) const
  {
    const HeaderField& field = header_fields[i];
    const std::int64_t number = values_[i].whole;
    const bool size = i == flag::tag_bytes || i == flag::count_bytes;
    if (number < field.low || number > field.high || (size && number != 4 && number != 8))
    {
      std::string range = std::to_string(field.low);
      if (field.high == std::numeric_limits<std::int64_t>::max())
      {
        range += " or more";
      }
      else if (field.low != field.high)
      {
        range += (size ? " or " : " to ") + std::to_string(field.high);
      }
      this->fail(i, std::string(field.name) + ", " + range, std::to_string(number));
    }
  }

  /// Reads the values behind the atom style, which have no flags: the styles of a hybrid, then two numbers for each bond/gran
  /// (write_restart_settings of these styles).
  void read_styles()
  {
    const std::string& style = values_[flag::atom_style].text;
    header_.styles = { { style } };
    if (style == "hybrid")
    {
      const int count = this->next_count("the number of atom styles of the hybrid", 1, 100);
      header_.styles.resize(static_cast<std::size_t>(count));
      for (RestartStyle& one : header_.styles)
      {
        one.name = bytes_.next_text(at_, "an atom style of the hybrid");
      }
    }
    for (RestartStyle& one : header_.styles)
    {
      if (one.name == "bond/gran")
      {
        one.bond_types = this->next_count("the bond types of bond/gran", 0, most_restart_types);
        one.bonds_per_atom =
          this->next_count("the bonds per particle of bond/gran", 0, most_restart_types);
      }
    }
  }

  int next_count(const std::string& what, std::int64_t least, std::int64_t most)
  {
    const std::int64_t number = this->next_int(what);
    if (number < least || number > most)
    {
      bytes_.refuse(what + ", " + std::to_string(least) + " to " + std::to_string(most),
        std::to_string(number), at_ - 4);
    }
    return static_cast<int>(number);
  }

  /// At most 10^21: as a double it is right where it matters.
  void check_grid() const
  {
    double product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      product *= static_cast<double>(values_[flag::grid + axis].whole);
    }
    const std::int64_t processes = values_[flag::processes].whole;
    if (product != static_cast<double>(processes))
    {
      this->fail(flag::grid, "a grid of " + std::to_string(processes) + " processes",
        std::to_string(values_[flag::grid].whole) + " x " +
          std::to_string(values_[flag::grid + 1].whole) + " x " +
          std::to_string(values_[flag::grid + 2].whole));
    }
  }

  void take_values()
  {
    const auto small = [&](std::size_t i) { return static_cast<int>(values_[i].whole); };
    header_.version = values_[flag::version].text;
    header_.tag_bytes = small(flag::tag_bytes);
    header_.count_bytes = small(flag::count_bytes);
    header_.units = values_[flag::units].text;
    header_.timestep = values_[flag::timestep].whole;
    if (this->has(flag::time))
    {
      header_.time = values_[flag::time].real;
    }
    header_.dimension = small(flag::dimension);
    header_.processes = small(flag::processes);
    header_.newton_bond = values_[flag::newton_bond].whole == 1;
    header_.atoms = values_[flag::atoms].whole;
    header_.bonds = values_[flag::bonds].whole;
    header_.types = small(flag::types);
    header_.atom_style = values_[flag::atom_style].text;
  }

  /// Unlike a dump, a restart file holds the box itself, and not the bounds of a tilted one.
  void take_box()
  {
    Vector3 lo;
    Vector3 hi;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t i = flag::box + 2 * axis;
      lo[axis] = values_[i].real;
      hi[axis] = values_[i + 1].real;
      if (!(lo[axis] <= hi[axis]) || !std::isfinite(hi[axis] - lo[axis]))
      {
        this->fail(i + 1, std::string(header_fields[i + 1].name) + " above the lower one",
          std::to_string(hi[axis]) + " and " + std::to_string(lo[axis]));
      }
    }
    header_.box = Box::from_bounds(lo, hi);
    header_.box.boundary = this->boundary();
    if (!this->has(flag::tilts) && !this->has(flag::tilts + 1) && !this->has(flag::tilts + 2))
    {
      return;
    }
    const auto tilt = [&](std::size_t i)
    {
      if (!this->has(flag::tilts + i))
      {
        bytes_.refuse(
          "three tilts", std::string("none for ") + header_fields[flag::tilts + i].name, at_);
      }
      return Twofold{ values_[flag::tilts + i].real, 0 };
    };
    header_.box.tilted = true;
    header_.box.vectors[1][0] = tilt(0);
    header_.box.vectors[2][0] = tilt(1);
    header_.box.vectors[2][1] = tilt(2);
  }

  std::string boundary() const
  {
    constexpr std::string_view letters = "pfsm";
    std::string text;
    for (std::size_t face = 0; face < 6; ++face)
    {
      const std::size_t i = flag::boundary + face;
      const std::int64_t number = values_[i].whole;
      const bool periodic = values_[flag::periodic + face / 2].whole == 1;
      if (periodic != (number == 0))
      {
        this->fail(i,
          std::string(header_fields[i].name) + " to be " + (periodic ? "0" : "1, 2 or 3") +
            ", as " + std::string(1, "xyz"[face / 2]) + " is " + (periodic ? "" : "not ") +
            "periodic",
          std::to_string(number));
      }
      text += face == 2 || face == 4 ? " " : "";
      text += letters[static_cast<std::size_t>(number)];
    }
    return text;
  }

  RestartBytes& bytes_;
  std::int64_t at_ = 0;
  std::array<Value, header_fields.size()> values_;
  RestartHeader header_;
};
}

RestartHeader read_header(RestartBytes& bytes)
{
  return HeaderReader(bytes).read();
}
}
