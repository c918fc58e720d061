// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/write/encode_header.h"

#include "granular/common/archive.h"
#include "granular/common/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

namespace granular
{
namespace
{
constexpr std::int64_t most_int32 = std::numeric_limits<std::int32_t>::max();

class TextHeaderWriter
{
public:
  TextHeaderWriter(Dialect dialect, NumberFormat box)
    : dialect_(dialect)
    , box_(box)
  {
  }

  void line(std::string_view text)
  {
    text_ += text;
    text_ += '\n';
  }

  void item(std::string_view name, std::string_view value)
  {
    this->line("ITEM: " + std::string(name));
    this->line(value);
  }

  /// Numbers of the box in a line.
  void numbers(std::initializer_list<double> values)
  {
    std::string_view gap;
    for (const double value : values)
    {
      char word[most_number_chars];
      char* const end = dialect_ == Dialect::Lammps
        ? std::to_chars(word, word + sizeof word, value, std::chars_format::scientific, 16).ptr
        : print_number(word, value, box_);
      text_.append(gap).append(word, end);
      gap = " ";
    }
    text_ += '\n';
  }

  std::string take() { return std::move(text_); }

private:
  Dialect dialect_;
  NumberFormat box_; ///< of LIGGGHTS
  std::string text_;
};

void add_box(TextHeaderWriter& writer, const Box& box)
{
  const BoxBounds b = box.bounds();
  const double tilts[] = { b.xy, b.xz, b.yz };
  const char* const form = box.general ? "abc origin " : box.tilted ? "xy xz yz " : "";
  writer.line(std::string("ITEM: BOX BOUNDS ") + form + box.boundary);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Twofold3& edge = box.vectors[i];
    if (box.general)
    {
      writer.numbers({ edge[0].value(), edge[1].value(), edge[2].value(), box.origin[i].value() });
    }
    else if (box.tilted)
    {
      writer.numbers({ b.lo[i], b.hi[i], tilts[i] });
    }
    else
    {
      writer.numbers({ b.lo[i], b.hi[i] });
    }
  }
}

/// With 16 digits, as LAMMPS prints it, and with 17 where that number would be another.
std::string time_text(double time)
{
  constexpr NumberFormat lammps = { 16 };
  return to_text(time, as_printed(time, lammps) == time ? lammps : NumberFormat{ 17 });
}

std::string encode_text(const FrameHeader& header, const std::vector<std::string>& columns,
  const DumpFormat& format, bool first, NumberFormat box)
{
  const bool lammps = format.dialect == Dialect::Lammps;
  const bool custom = format.style == DumpStyle::Custom;
  TextHeaderWriter writer(lammps ? Dialect::Lammps : Dialect::Liggghts, box);
  if (lammps && format.units && first)
  {
    writer.item("UNITS", header.units);
  }
  if (lammps && format.time)
  {
    writer.item("TIME", time_text(header.time.value_or(0)));
  }
  writer.item("TIMESTEP", std::to_string(header.timestep));
  if (!lammps && custom && !header.box.tilted && !header.label.empty())
  {
    writer.item("LABEL", header.label);
  }
  writer.item("NUMBER OF " + header.counted, std::to_string(header.rows));
  if (header.has_box)
  {
    add_box(writer, header.box);
  }
  writer.line("ITEM: " + header.counted + " " + join_words(columns) +
    (has_trailing_blanks(format) ? " " : ""));
  return writer.take();
}

struct BinaryHeaderWriter : ArchiveWriter
{
  void int32(std::int64_t value) { this->number(static_cast<std::int32_t>(value)); }

  void counted_text(std::string_view value)
  {
    if (static_cast<std::int64_t>(value.size()) > most_int32)
    {
      throw LimitError("expected the names of the columns to have less than 2^31 bytes, got " +
        std::to_string(value.size()));
    }
    this->int32(static_cast<std::int64_t>(value.size()));
    bytes += value;
  }

  void numbers(std::initializer_list<double> values)
  {
    for (const double value : values)
    {
      this->number(value);
    }
  }
};

/// p, f, s, m as dumps number them; flags are "pp ff sm".
std::int64_t flag_number(char flag)
{
  constexpr std::string_view flags = "pfsm";
  const std::size_t found = flags.find(flag);
  return found == flags.npos ? 1 : static_cast<std::int64_t>(found);
}

void add_box(BinaryHeaderWriter& writer, const Box& box)
{
  writer.int32(box.general ? 2 : box.tilted ? 1 : 0);
  constexpr std::size_t places[] = { 0, 1, 3, 4, 6, 7 };
  for (const std::size_t place : places)
  {
    writer.int32(flag_number(place < box.boundary.size() ? box.boundary[place] : 'f'));
  }
  if (box.general)
  {
    for (const Twofold3& edge : box.vectors)
    {
      writer.numbers({ edge[0].value(), edge[1].value(), edge[2].value() });
    }
    writer.numbers({ box.origin[0].value(), box.origin[1].value(), box.origin[2].value() });
    return;
  }
  const BoxBounds b = box.bounds();
  writer.numbers({ b.lo[0], b.hi[0], b.lo[1], b.hi[1], b.lo[2], b.hi[2] });
  if (box.tilted)
  {
    writer.numbers({ b.xy, b.xz, b.yz });
  }
}

std::string encode_binary(const FrameHeader& header, const std::vector<std::string>& columns,
  const DumpFormat& format, const ChunkLengths& chunks, bool first)
{
  const bool magic = format.dialect == Dialect::Lammps;
  BinaryHeaderWriter writer;
  if (magic)
  {
    const std::string_view name = format.style == DumpStyle::Atom ? "DUMPATOM" : "DUMPCUSTOM";
    writer.number(-static_cast<std::int64_t>(name.size()));
    writer.bytes += name;
    writer.int32(1); // of this byte order
    writer.int32(2); // revision
  }
  else if (header.timestep < 0)
  {
    throw LimitError("expected a timestep of at least 0 for a binary dump without names, got " +
      std::to_string(header.timestep));
  }
  writer.number(header.timestep);
  writer.number(header.rows);
  add_box(writer, header.box);
  writer.int32(static_cast<std::int64_t>(columns.size()));
  if (magic)
  {
    writer.counted_text(format.units && first ? header.units : "");
    writer.number(static_cast<char>(format.time ? 1 : 0));
    if (format.time)
    {
      writer.number(header.time.value_or(0));
    }
    writer.counted_text(join_words(columns));
  }
  writer.int32(chunks.chunks());
  if (header.rows == 0)
  {
    writer.int32(0); // of the one chunk that there is, which no row begins
  }
  return std::move(writer.bytes);
}
}

ChunkLengths::ChunkLengths(std::int64_t rows, std::int64_t size_one, std::int64_t most_values)
  : rows_(rows)
  , size_one_(size_one)
  , rows_per_chunk_(size_one > 0 ? most_values / size_one : 0)
{
  if (rows_per_chunk_ == 0)
  {
    throw LimitError("expected 1 to " + std::to_string(most_values) +
      " columns in a binary dump, got " + std::to_string(size_one));
  }
  const std::int64_t chunks =
    std::max<std::int64_t>(1, rows / rows_per_chunk_ + (rows % rows_per_chunk_ != 0 ? 1 : 0));
  if (chunks > most_int32)
  {
    throw LimitError("expected at most " + std::to_string(most_int32) +
      " chunks in a binary dump, which counts them with 32 bits, got " + std::to_string(chunks) +
      " of " + std::to_string(rows_per_chunk_) + " rows");
  }
  chunks_ = static_cast<std::int32_t>(chunks);
}

std::int32_t ChunkLengths::values(std::int64_t first_row) const noexcept
{
  return static_cast<std::int32_t>(std::min(rows_per_chunk_, rows_ - first_row) * size_one_);
}

std::int64_t ChunkLengths::offset(std::int64_t row) const noexcept
{
  const std::int64_t lengths = (row + rows_per_chunk_ - 1) / rows_per_chunk_;
  return lengths * static_cast<std::int64_t>(sizeof(std::int32_t)) +
    row * size_one_ * static_cast<std::int64_t>(sizeof(double));
}

bool has_trailing_blanks(const DumpFormat& format) noexcept
{
  return format.style == DumpStyle::Local ||
    (format.style == DumpStyle::Custom && format.dialect == Dialect::Liggghts);
}

std::string encode_header(const FrameHeader& header, const std::vector<std::string>& columns,
  const DumpFormat& format, const ChunkLengths& chunks, bool first, NumberFormat box)
{
  if (header.box.general && format.dialect == Dialect::Liggghts)
  {
    throw UnsupportedError("expected a box with its first vector along x and its second in the xy "
                           "plane for LIGGGHTS, got a "
                           "general one");
  }
  return format.binary ? encode_binary(header, columns, format, chunks, first)
                       : encode_text(header, columns, format, first, box);
}
}
