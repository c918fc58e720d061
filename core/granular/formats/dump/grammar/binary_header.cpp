// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/binary_header.h"

#include "granular/common/words.h"
#include "granular/formats/dump/grammar/text_header.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <string_view>

namespace granular
{
namespace
{
// clang-format off
constexpr BinaryLayout layouts[] = {
  // name                                                    magic  wide   triclinic boundary swapped
  { "of LAMMPS, with DUMPATOM or DUMPCUSTOM",                true,  true,  true,     true,    false },
  { "of LAMMPS, with DUMPATOM or DUMPCUSTOM, swapped",       true,  true,  true,     true,    true },
  { "of LAMMPS, 32-bit integers",                            true,  false, true,     true,    false },
  { "of LAMMPS, 32-bit integers, swapped",                   true,  false, true,     true,    true },
  { "plain",                                                 false, true,  true,     true,    false },
  { "plain, swapped",                                        false, true,  true,     true,    true },
  { "plain, 32-bit integers",                                false, false, true,     true,    false },
  { "plain, 32-bit integers, swapped",                       false, false, true,     true,    true },
  { "plain, before 2011, with tilts",                        false, false, true,     false,   false },
  { "plain, before 2011, with tilts, swapped",               false, false, true,     false,   true },
  { "plain, before 2011",                                    false, false, false,    false,   false },
  { "plain, before 2011, swapped",                           false, false, false,    false,   true },
};
// clang-format on

constexpr std::int32_t most_chunks = 1 << 24;
constexpr std::int32_t longest_text = 1 << 20;
constexpr std::int64_t longest_magic = 64;
constexpr std::int64_t longest_magic_word = 10;
constexpr std::string_view magic_words[] = { "DUMPATOM", "DUMPCUSTOM" };
constexpr int all_faults = 100; // more than there are fields

/// Returns true if a box can be that of a simulation, as far as a file without magic can be told by it: small
/// integers, of which other files are full, are tiny as doubles.
bool plausible_box(const Box& box) noexcept
{
  const auto tiny = [](double value)
  { return value != 0 && std::abs(value) < std::numeric_limits<double>::min(); };
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double origin = box.origin[axis].hi;
    const double length = box.vectors[axis][axis].hi;
    if (!std::isfinite(origin) || !std::isfinite(length) || !(length >= 0) || tiny(origin) ||
      tiny(length))
    {
      return false;
    }
    longest = std::max(longest, length);
  }
  return longest > 0;
}

/// Returns true if bounds are the wrong way round. Others that are not plausible may come of a simulation that
/// failed.
bool inverted_box(const Box& box) noexcept
{
  return box.vectors[0][0].hi < 0 || box.vectors[1][1].hi < 0 || box.vectors[2][2].hi < 0;
}

/// Reads the fields one after the other, also behind one that cannot be: how many there are tells
/// which layout is meant.
class HeaderReader
{
public:
  HeaderReader(const ByteSource& source, std::int64_t offset, const BinaryLayout& layout)
    : source_(source)
    , layout_(layout)
    , cursor_(source, offset, layout.swapped)
  {
  }

  /// False at the end of the source.
  bool run()
  {
    header.frame.dialect = layout_.magic ? Dialect::Lammps : Dialect::Liggghts;
    if (this->read_magic())
    {
      this->read_counts();
      this->read_box();
      this->read_columns();
      header.chunks_offset = cursor_.offset();
    }
    return !cursor_.ended();
  }

  BinaryHeader header;
  std::optional<FormatError> error; ///< about the first field that cannot be
  int faults = 0;                   ///< fields that cannot be

private:
  template <typename T>
  T take()
  {
    field_ = cursor_.offset();
    return cursor_.take<T>();
  }

  std::int64_t take_count()
  {
    return layout_.wide ? this->take<std::int64_t>() : this->take<std::int32_t>();
  }

  Vector3 take_vector()
  {
    const double x = this->take<double>();
    const double y = this->take<double>();
    return { x, y, this->take<double>() };
  }

  std::string take_text(const char* what)
  {
    const auto length = this->take<std::int32_t>();
    const bool good = length >= 0 && length <= longest_text;
    this->require(good, std::string("the length of ") + what, length);
    return good ? cursor_.take_text(length) : std::string();
  }

  void require(bool good, const std::string& expected, std::int64_t got)
  {
    if (!good)
    {
      this->blame(FormatError(
        "expected " + expected + ", got " + std::to_string(got), { source_.path(), 0, field_ }));
    }
  }

  /// A field that is not there is not at fault.
  void blame(const FormatError& fault)
  {
    if (!cursor_.ended())
    {
      ++faults;
      error = error ? error : fault;
    }
  }

  /// False if there is none where one should be: nothing behind it means anything then.
  bool read_magic()
  {
    if (!layout_.magic)
    {
      return true;
    }
    const std::int64_t length = this->take_count();
    const std::int64_t word = cursor_.offset();
    const std::string text = cursor_.take_text(longest_magic_word);
    const auto magic = std::ranges::find_if(
      magic_words, [&](std::string_view known) { return text.starts_with(known); });
    const bool good = length < 0 && length >= -longest_magic;
    this->require(good, "the length of a magic word, -8 or -10", length);
    if (magic == std::end(magic_words) && !cursor_.ended())
    {
      std::string other(good ? static_cast<std::size_t>(-length) : 0, '\0');
      other.resize(source_.read(word, other.data(), other.size()));
      this->blame(FormatError(
        "expected DUMPATOM or DUMPCUSTOM, got " + quoted(other), { source_.path(), 0, word }));
      const bool is_word =
        !other.empty() && std::ranges::all_of(other, [](char c) { return c >= '0' && c <= 'Z'; });
      faults = is_word ? 1 : all_faults;
    }
    if (magic == std::end(magic_words))
    {
      return false;
    }
    this->require(length == -static_cast<std::int64_t>(magic->size()),
      "the length of " + std::string(*magic), length);
    cursor_.go_to(word + static_cast<std::int64_t>(magic->size()));
    const auto endian = this->take<std::int32_t>();
    this->require(endian == 1, "the mark of the byte order, 1", endian);
    revision_ = this->take<std::int32_t>();
    this->require(revision_ == 1 || revision_ == 2, "revision 1 or 2", revision_);
    return true;
  }

  void read_counts()
  {
    FrameHeader& frame = header.frame;
    frame.timestep = this->take_count();
    this->require(layout_.magic || frame.timestep >= 0, "a timestep >= 0", frame.timestep);
    frame.rows = this->take_count();
    constexpr std::int64_t most_rows = std::numeric_limits<std::int64_t>::max() /
      (std::int64_t{ most_columns } * std::int64_t{ sizeof(double) });
    this->require(frame.rows >= 0 && frame.rows <= most_rows, "a number of atoms", frame.rows);
  }

  void read_box()
  {
    triclinic_ = layout_.triclinic ? this->take<std::int32_t>() : 0;
    const int largest = layout_.magic ? 2 : 1;
    this->require(triclinic_ >= 0 && triclinic_ <= largest,
      largest == 2 ? "triclinic 0, 1 or 2" : "triclinic 0 or 1", triclinic_);
    triclinic_ = triclinic_ >= 0 && triclinic_ <= largest ? triclinic_ : 0;
    std::string boundary;
    for (int face = 0; layout_.boundary && face < 6; ++face)
    {
      const auto flag = this->take<std::int32_t>();
      this->require(flag >= 0 && flag <= 3, "a boundary flag from 0 to 3", flag);
      boundary += face > 0 && face % 2 == 0 ? " " : "";
      boundary += "pfsm"[flag & 3];
    }
    Box& box = header.frame.box;
    header.box_offset = cursor_.offset();
    if (triclinic_ == 2)
    {
      const Vector3 a = this->take_vector();
      const Vector3 b = this->take_vector();
      const Vector3 c = this->take_vector();
      box = Box::from_vectors(this->take_vector(), { a, b, c });
    }
    else
    {
      Vector3 lo = {};
      Vector3 hi = {};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        lo[axis] = this->take<double>();
        hi[axis] = this->take<double>();
      }
      const Vector3 tilts = triclinic_ == 1 ? this->take_vector() : Vector3{};
      box = triclinic_ == 1 ? Box::from_tilted_bounds(lo, hi, tilts[0], tilts[1], tilts[2])
                            : Box::from_bounds(lo, hi);
    }
    box.boundary = boundary;
  }

  void read_columns()
  {
    header.size_one = this->take<std::int32_t>();
    header.size_one_offset = field_;
    this->require(header.size_one >= 1 && header.size_one <= most_columns,
      "1 to " + std::to_string(most_columns) + " columns", header.size_one);
    if (revision_ > 1)
    {
      header.frame.units = this->take_text("the units");
      if (this->take<char>() != 0)
      {
        header.frame.time = this->take<double>();
      }
      const std::string columns = this->take_text("the names of the columns");
      for (const std::string_view name : split_words(columns))
      {
        header.columns.emplace_back(name);
      }
    }
    header.chunks = this->take<std::int32_t>();
    this->require(header.chunks >= 1 && header.chunks <= most_chunks,
      "1 to " + std::to_string(most_chunks) + " chunks", header.chunks);
  }

  const ByteSource& source_;
  const BinaryLayout& layout_;
  BinaryCursor cursor_;
  std::int64_t field_ = 0; ///< place of the last number
  std::int32_t revision_ = 0;
  std::int32_t triclinic_ = 0;
};

}

std::span<const BinaryLayout> binary_layouts() noexcept
{
  return layouts;
}

void BinaryCursor::copy(char* to, std::size_t bytes)
{
  const std::int64_t at = offset_ - buffer_offset_;
  if (at < 0 || at + static_cast<std::int64_t>(bytes) > static_cast<std::int64_t>(buffered_))
  {
    buffer_offset_ = offset_;
    buffered_ = source_.read(offset_, buffer_.data(), buffer_.size());
  }
  offset_ += static_cast<std::int64_t>(bytes);
  if (offset_ > buffer_offset_ + static_cast<std::int64_t>(buffered_))
  {
    ended_ = true;
    return;
  }
  std::memcpy(
    to, buffer_.data() + (offset_ - static_cast<std::int64_t>(bytes) - buffer_offset_), bytes);
}

std::string BinaryCursor::take_text(std::int64_t bytes)
{
  std::string text(static_cast<std::size_t>(std::max(std::int64_t{ 0 }, bytes)), '\0');
  const std::size_t got = source_.read(offset_, text.data(), text.size());
  offset_ += bytes;
  ended_ = ended_ || got < text.size();
  return text;
}

std::optional<BinaryHeader> read_binary_header(
  const ByteSource& source, std::int64_t offset, const BinaryLayout& layout)
{
  HeaderReader reader(source, offset, layout);
  const bool whole = reader.run();
  if (reader.error)
  {
    throw FormatError(*reader.error);
  }
  return whole ? std::optional(std::move(reader.header)) : std::nullopt;
}

HeaderCheck check_binary_header(const ByteSource& source, const BinaryLayout& layout)
{
  HeaderReader reader(source, 0, layout);
  HeaderCheck check;
  const bool whole = reader.run();
  check.faults = reader.faults;
  check.error = reader.error;
  const bool good = !check.error && (layout.magic || !inverted_box(reader.header.frame.box));
  if (whole && !layout.magic && !plausible_box(reader.header.frame.box))
  {
    ++check.faults;
    check.error = check.error ? check.error
                              : FormatError("expected the bounds of a box, got none",
                                  { source.path(), 0, reader.header.box_offset });
  }
  if (whole && good)
  {
    check.header = std::move(reader.header);
  }
  return check;
}
}
