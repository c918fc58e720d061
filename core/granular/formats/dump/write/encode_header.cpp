// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/encode_header.h"

#include "granular/common/archive.h"
#include "granular/common/words.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t most_int32 = std::numeric_limits<std::int32_t>::max();

/// numbers: of LIGGGHTS.
void add_box(std::string& text, const Box& box, bool lammps, NumberFormat numbers)
{
  const BoxBounds b = box.bounds();
  const double tilts[] = { b.xy, b.xz, b.yz };
  const char* const form = box.general ? "abc origin " : box.tilted ? "xy xz yz " : "";
  text.append("ITEM: BOX BOUNDS ").append(form).append(box.boundary);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto [x, y, z] = values_of(box.vectors[i]);
    const std::vector<double> line = box.general ? std::vector{ x, y, z, box.origin[i].value() }
      : box.tilted                               ? std::vector{ b.lo[i], b.hi[i], tilts[i] }
                                                 : std::vector{ b.lo[i], b.hi[i] };
    const char* gap = "\n";
    for (const double value : line)
    {
      char word[most_number_chars];
      char* const end = lammps
        ? std::to_chars(word, word + sizeof word, value, std::chars_format::scientific, 16).ptr
        : print_number(word, value, numbers);
      text.append(std::exchange(gap, " ")).append(word, end);
    }
  }
  text += '\n';
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
  std::string text;
  const auto item = [&](const std::string& name, const std::string& value)
  { text += "ITEM: " + name + '\n' + value + '\n'; };
  if (lammps && format.units && first)
  {
    item("UNITS", header.units);
  }
  if (lammps && format.time)
  {
    item("TIME", time_text(header.time.value_or(0)));
  }
  item("TIMESTEP", std::to_string(header.timestep));
  if (!lammps && custom && !header.box.tilted && !header.label.empty())
  {
    item("LABEL", header.label);
  }
  item("NUMBER OF " + header.counted, std::to_string(header.rows));
  if (header.has_box)
  {
    add_box(text, header.box, lammps, box);
  }
  return text + "ITEM: " + header.counted + " " + join_words(columns) +
    (has_trailing_blanks(format) ? " \n" : "\n");
}

/// A 32-bit integer.
void add_int(ArchiveWriter& writer, std::int64_t value)
{
  writer.number(static_cast<std::int32_t>(value));
}

void add_text(ArchiveWriter& writer, const std::string& text)
{
  if (static_cast<std::int64_t>(text.size()) > most_int32)
  {
    throw LimitError("expected the names of the columns to have less than 2^31 bytes, got " +
      std::to_string(text.size()));
  }
  add_int(writer, static_cast<std::int64_t>(text.size()));
  writer.bytes += text;
}

/// p, f, s, m as dumps number them; flags are "pp ff sm".
std::int64_t flag_number(char flag)
{
  constexpr std::string_view flags = "pfsm";
  const std::size_t found = flags.find(flag);
  return found == flags.npos ? 1 : static_cast<std::int64_t>(found);
}

void add_box(ArchiveWriter& writer, const Box& box)
{
  add_int(writer, box.general ? 2 : box.tilted ? 1 : 0);
  for (const std::size_t place : { 0U, 1U, 3U, 4U, 6U, 7U })
  {
    add_int(writer, flag_number(place < box.boundary.size() ? box.boundary[place] : 'f'));
  }
  if (box.general)
  {
    std::ranges::for_each(
      box.vectors, [&](const Twofold3& edge) { writer.number(values_of(edge)); });
    writer.number(values_of(box.origin));
    return;
  }
  const BoxBounds b = box.bounds();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    writer.number(b.lo[axis]);
    writer.number(b.hi[axis]);
  }
  if (box.tilted)
  {
    writer.number(Vector3{ b.xy, b.xz, b.yz });
  }
}

std::string encode_binary(const FrameHeader& header, const std::vector<std::string>& columns,
  const DumpFormat& format, const ChunkLengths& chunks, bool first)
{
  const bool magic = format.dialect == Dialect::Lammps;
  ArchiveWriter writer;
  if (magic)
  {
    const std::string_view name = format.style == DumpStyle::Atom ? "DUMPATOM" : "DUMPCUSTOM";
    writer.number(-static_cast<std::int64_t>(name.size()));
    writer.bytes += name;
    add_int(writer, 1); // of this byte order
    add_int(writer, 2); // revision
  }
  else if (header.timestep < 0)
  {
    throw LimitError("expected a timestep of at least 0 for a binary dump without names, got " +
      std::to_string(header.timestep));
  }
  writer.number(header.timestep);
  writer.number(header.rows);
  add_box(writer, header.box);
  add_int(writer, static_cast<std::int64_t>(columns.size()));
  if (magic)
  {
    add_text(writer, format.units && first ? header.units : "");
    writer.number(static_cast<char>(format.time ? 1 : 0));
    if (format.time)
    {
      writer.number(header.time.value_or(0));
    }
    add_text(writer, join_words(columns));
  }
  add_int(writer, chunks.chunks());
  if (header.rows == 0)
  {
    add_int(writer, 0); // of the one chunk that there is, which no row begins
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
