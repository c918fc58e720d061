// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps that are damaged, cut or still being written: every one is an error that names a place,
// or the frames that are whole; never more memory than the file is worth.
#include "granular/formats/dump/grammar/binary_dump.h"
#include "granular/formats/dump/grammar/binary_header.h"
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/run_index.h"

#include "../support/binary_dumps.h"
#include "../support/dumps.h"

#include "../support/largest_request.h"
#include "../support/resident_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using binary::Bytes;
using binary::Field;
using binary::Form;
using binary::forms;
using binary::Frame;
using Doubles = std::vector<double>;
using Integers = std::vector<std::int64_t>;

constexpr std::size_t much = std::size_t{ 1 } << 26;

/// Memory that a test takes, in single requests and in all.
class MemoryCheck
{
public:
  MemoryCheck()
    : before_(restart_peak())
  {
    largest_request = 0;
  }

  ~MemoryCheck()
  {
    EXPECT_LT(largest_request, much);
    EXPECT_LT(peak_bytes() - before_, static_cast<std::int64_t>(much));
  }

private:
  std::int64_t before_;
};

std::string defect_of(const Dump& dump)
{
  return to_string(dump.index().defect.value_or(granular::Notice{ {}, "nothing" }));
}

/// The byte of "memory@byte: expected", or -1.
std::int64_t place_of(const std::string& said)
{
  const std::size_t colon = said.find(": expected ");
  return said.starts_with("memory@") && colon != said.npos && colon > 7
    ? std::stoll(said.substr(7, colon - 7))
    : -1;
}

bool is_whole(const Decoded& got, const Frame& frame)
{
  const auto integers = [](const Doubles& values)
  {
    Integers all;
    std::transform(values.begin(), values.end(), std::back_inserter(all),
      [](double value) { return static_cast<std::int64_t>(value); });
    return all;
  };
  return got.rows() == frame.rows() && got.integers("id") == integers(frame.values(0)) &&
    got.values("radius") == frame.values(11);
}

/// A number and what it is called in a message.
struct Value
{
  const char* name;
  std::int64_t number;
};

constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
constexpr Value values[] = {
  { "0", 0 },
  { "1", 1 },
  { "-1", -1 },
  { "7", 7 },
  { "2^15", 1 << 15 },
  { "2^31 - 1", 2147483647 },
  { "-2^31", -2147483648 },
  { "2^31", 2147483648 },
  { "2^40", std::int64_t{ 1 } << 40 },
  { "2^63 - 1", most },
  { "-2^63", -most - 1 },
};

bool holds(const Field& field, std::int64_t value)
{
  const int bits = static_cast<int>(8 * field.bytes) - 1;
  return field.bytes == 8 ||
    (value >= -(std::int64_t{ 1 } << bits) && value < std::int64_t{ 1 } << bits);
}

/// Whether the bounds can be those of a box: what a plain file is told by.
bool can_be_a_box(const Frame& frame)
{
  const bool tilted = frame.triclinic == 1;
  const double xy = tilted ? frame.box[6] : 0;
  const double xz = tilted ? frame.box[7] : 0;
  const double yz = tilted ? frame.box[8] : 0;
  const double lengths[] = { frame.box[1] - frame.box[0] - std::max({ 0.0, xy, xz, xy + xz }) +
      std::min({ 0.0, xy, xz, xy + xz }),
    frame.box[3] - frame.box[2] - std::max(0.0, yz) + std::min(0.0, yz),
    frame.box[5] - frame.box[4] };
  return std::all_of(std::begin(lengths), std::end(lengths),
    [](double length) { return length >= 0 && std::isfinite(length); });
}

/// Whether a header with another number in one place is still that of the frame.
bool is_legal(
  const Form& form, const Frame& frame, const Bytes& bytes, const Field& field, std::int64_t value)
{
  const bool magic = !form.magic.empty();
  if (field.name == "box")
  {
    Frame other = frame;
    const auto number = static_cast<std::size_t>(&field - &bytes.field("box"));
    other.box[number] = static_cast<double>(value);
    return magic || can_be_a_box(other);
  }
  return (field.name == "timestep" && (magic || value >= 0)) ||
    (field.name == "boundary" && value >= 0 && value <= 3) || field.name == "time" ||
    (field.name == "time flag" && value != 0) ||
    (!field.real && value == binary::integer_at(bytes.bytes, form, field));
}
}

// ---- numbers of the header ---------------------------------------------------------------------------

TEST(BinaryBadInput, EveryNumberOfTheHeaderChanged)
{
  const MemoryCheck memory;
  for (const Form& form : forms())
  {
    for (int triclinic = 0; triclinic <= form.most_triclinic(); ++triclinic)
    {
      const Frame frame = binary::particles(form, 3, 5, triclinic);
      const Bytes good = binary::write(form, { frame });
      const std::string behind =
        binary::write(form, { binary::particles(form, 4, 1, triclinic) }).bytes;
      for (const Field& field : good.fields)
      {
        for (const Value& value : values)
        {
          if (!field.real && !holds(field, value.number))
          {
            continue;
          }
          const std::string bad = binary::with_field(good, form, field, value.number);
          for (const std::string& bytes : { bad, bad + behind })
          {
            SCOPED_TRACE(form.name + ", triclinic " + std::to_string(triclinic) + ": " +
              field.name + " at " + std::to_string(field.offset) + " is " + value.name +
              (bytes.size() > bad.size() ? ", a frame behind" : ""));
            const Dump dump(bytes, binary::names_for(form));
            if (is_legal(form, frame, good, field, value.number))
            {
              ASSERT_EQ(dump.frames(), bytes.size() > bad.size() ? 2u : 1u) << defect_of(dump);
              EXPECT_TRUE(is_whole(dump.read(), frame));
              EXPECT_EQ(dump.said(), "");
              continue;
            }
            EXPECT_EQ(dump.frames(), 0u) << dump.said();
            EXPECT_EQ(dump.said(), "");
            const std::string defect = defect_of(dump);
            const std::int64_t place = place_of(defect);
            EXPECT_GE(place, 0) << defect;
            EXPECT_LT(place, static_cast<std::int64_t>(bytes.size())) << defect;
          }
        }
      }
    }
  }
}

// What a file with magic says, and one that is plain, is clear; of other layouts there is one that came
// furthest.
TEST(BinaryBadInput, TheFieldAtFaultIsNamed)
{
  struct Case
  {
    const char* field;
    std::int64_t value;
    const char* said;
  };
  const Case cases[] = {
    { "magic length", -65, "expected the length of a magic word, -8 or -10, got -65" },
    { "endian", 2, "expected the mark of the byte order, 1, got 2" },
    { "revision", 3, "expected revision 1 or 2, got 3" },
    { "atoms", -1, "expected a number of atoms, got -1" },
    { "triclinic", 3, "expected triclinic 0, 1 or 2, got 3" },
    { "triclinic", 2, "expected triclinic 0 or 1, got 2" },
    { "boundary", 4, "expected a boundary flag from 0 to 3, got 4" },
    { "size_one", 0, "expected 1 to 5000 columns, got 0" },
    { "size_one", 5001, "expected 1 to 5000 columns, got 5001" },
    { "units length", -1, "expected the length of the units, got -1" },
    { "columns length", 1048577, "expected the length of the names of the columns, got 1048577" },
    { "nchunk", 0, "expected 1 to 16777216 chunks, got 0" },
    { "nchunk", 16777217, "expected 1 to 16777216 chunks, got 16777217" },
    { "n", 13, "expected the number of values in a chunk, a multiple of 12 and 60 in all, got 13" },
    { "n", -12,
      "expected the number of values in a chunk, a multiple of 12 and 60 in all, got -12" },
    { "n", 72, "expected the number of values in a chunk, a multiple of 12 and 60 in all, got 72" },
  };
  for (const Form& form : forms())
  {
    const bool magic = !form.magic.empty();
    const Bytes good = binary::write(form, { binary::particles(form, 3, 5) });
    for (const Case& one : cases)
    {
      const bool there = std::any_of(good.fields.begin(), good.fields.end(),
        [&](const Field& field) { return field.name == one.field; });
      const bool only_plain = std::string(one.said).find("triclinic 0 or 1") != std::string::npos;
      const bool only_magic = std::string(one.said).find("0, 1 or 2") != std::string::npos;
      const bool told = magic
        ? !(form.big && one.value == -65)
        : form.name.starts_with("plain, little") || form.name.starts_with("plain, big");
      if (there && told && !(magic && only_plain) && !(!magic && only_magic))
      {
        const Field& field = good.field(one.field);
        EXPECT_EQ(defect_of(Dump(
                    binary::with_field(good, form, field, one.value), binary::names_for(form))),
          "memory@" + std::to_string(field.offset) + ": " + one.said +
            (magic ? "" : "; no known layout of a binary dump fits"))
          << form.name;
      }
    }
  }
}

TEST(BinaryBadInput, AnUnknownMagicWord)
{
  const Form& form = binary::form("DUMPATOM revision 2, big-endian");
  std::string bytes = binary::write(form, { binary::particles(form, 3, 5) }).bytes;
  bytes.replace(8, 8, "DUMPGRID");
  EXPECT_EQ(defect_of(Dump(bytes)), "memory@8: expected DUMPATOM or DUMPCUSTOM, got 'DUMPGRID'");
  // this is not DUMPCUSTOM either
  bytes = binary::write(form, { binary::particles(form, 3, 5) }).bytes;
  bytes[7] = '\xf6';
  EXPECT_EQ(Dump(bytes).frames(), 0u);
}

// The user sees the place of the box, whatever the layout.
TEST(BinaryBadInput, ABoxThatIsNoneIsNamed)
{
  for (const Form& form : forms())
  {
    if (form.name.starts_with("plain, little") || form.name.starts_with("plain, big"))
    {
      Frame frame = binary::particles(form, 3, 5);
      frame.box = { 1, 0, 0, 1, 0, 1 };
      const Bytes bytes = binary::write(form, { frame });
      const std::string defect = defect_of(Dump(bytes.bytes, binary::names_for(form)));
      EXPECT_TRUE(defect.starts_with("memory@44: expected the bounds of a box")) << defect;
    }
  }
}

// ---- frames in the middle --------------------------------------------------------------------------

TEST(BinaryBadInput, ADamagedFrameEndsTheFileAndIsSaid)
{
  for (const Form& form : forms())
  {
    SCOPED_TRACE(form.name);
    const Bytes good = binary::write(form,
      { binary::particles(form, 1, 3), binary::particles(form, 2, 3),
        binary::particles(form, 3, 3) });
    const auto second = std::find_if(good.fields.begin() + 20, good.fields.end(),
      [&](const Field& field) { return field.name == "size_one" && field.offset > good.ends[0]; });
    const Dump dump(binary::with_field(good, form, *second, 0), binary::names_for(form));
    ASSERT_EQ(dump.frames(), 1u);
    EXPECT_TRUE(is_whole(dump.read(), binary::particles(form, 1, 3)));
    EXPECT_EQ(dump.said(),
      "memory@" + std::to_string(second->offset) +
        ": expected 1 to 5000 columns, got 0; the frame and all that follow are left out\n");
    // something else behind the last frame
    const Dump behind(good.bytes + std::string(200, '\x55'), binary::names_for(form));
    EXPECT_EQ(behind.frames(), 3u);
    EXPECT_TRUE(behind.said().starts_with("memory@")) << behind.said();
    EXPECT_TRUE(behind.said().ends_with("; the frame and all that follow are left out\n"));
    // zeros that a file system put there when the machine lost power
    const Dump zeros(good.bytes + std::string(4096, '\0'), binary::names_for(form));
    EXPECT_EQ(zeros.frames(), 3u);
    EXPECT_TRUE(zeros.said().ends_with("; the frame and all that follow are left out\n"));
  }
}

TEST(BinaryBadInput, AFrameOfAnotherLayoutEndsTheFile)
{
  for (const Form& form : forms())
  {
    for (const Form& other : forms())
    {
      // forms that are told apart by the first frame alone
      if (other.magic.empty() != form.magic.empty() || other.big != form.big ||
        other.wide != form.wide || other.boundary != form.boundary)
      {
        Bytes bytes = binary::write(form, { binary::particles(form, 1, 3) });
        binary::add(bytes, other, binary::particles(other, 2, 3));
        const Dump dump(bytes.bytes, binary::names_for(form));
        EXPECT_EQ(dump.frames(), 1u) << form.name << " then " << other.name;
        EXPECT_TRUE(is_whole(dump.read(), binary::particles(form, 1, 3)));
      }
    }
  }
}

// ---- cut files ---------------------------------------------------------------------------------------

TEST(BinaryBadInput, EveryTruncation)
{
  const MemoryCheck memory;
  for (const Form& form : forms())
  {
    // the byte order does not move anything
    for (int triclinic = form.big ? form.most_triclinic() : 0; triclinic <= form.most_triclinic();
         ++triclinic)
    {
      for (const std::int64_t rows : { 0, 2 })
      {
        const std::vector<Frame> frames = { binary::particles(form, 1, rows, triclinic),
          binary::particles(form, 2, 1, triclinic) };
        const Bytes whole = binary::write(form, frames);
        const auto source = granular::open_memory(whole.bytes);
        const Dump all(whole.bytes, binary::names_for(form));
        ASSERT_EQ(all.frames(), 2u);
        for (std::size_t size = 0; size < whole.bytes.size(); ++size)
        {
          SCOPED_TRACE(form.name + ", triclinic " + std::to_string(triclinic) + ", rows " +
            std::to_string(rows) + ", cut to " + std::to_string(size));
          const Dump dump(whole.bytes.substr(0, size), binary::names_for(form));
          ASSERT_EQ(dump.frames(), size < whole.ends[0] ? 0u : 1u);
          EXPECT_EQ(dump.said(), "") << "its writer is still at work";
          // the buffers that rows are read through are large
          const bool read = size % 16 == 0 || size + 1 >= whole.bytes.size();
          if (read && size >= whole.ends[0])
          {
            ASSERT_TRUE(is_whole(dump.read(), frames[0]));
          }
          // it grows
          granular::FileIndex grown = dump.index();
          granular::Progress progress;
          index_dump(*source, grown, progress);
          ASSERT_EQ(grown.frames.size(), 2u) << defect_of(dump);
          for (std::size_t i = 0; i < 2; ++i)
          {
            const granular::FrameEntry& entry = grown.frames[i];
            EXPECT_EQ(entry.offset, all.entry(i).offset);
            EXPECT_EQ(entry.end, all.entry(i).end);
            EXPECT_EQ(entry.shape, all.entry(i).shape);
            EXPECT_EQ(entry.kind->layout, all.entry(i).kind->layout);
            if (read)
            {
              Decoded got;
              got.frame = read_dump(*source, entry, {}, got.notices, progress);
              ASSERT_TRUE(is_whole(got, frames[i]));
            }
          }
        }
      }
    }
  }
}

TEST(BinaryBadInput, WhatIsSaidOfACutFile)
{
  for (const Form& form : forms())
  {
    const Bytes whole = binary::write(form, { binary::particles(form, 1, 3) });
    for (std::size_t size = 1; size < whole.bytes.size(); ++size)
    {
      const std::string first = whole.bytes.substr(0, size);
      // before the first byte that no text has, anything may come
      EXPECT_EQ(defect_of(Dump(first, binary::names_for(form))),
        granular::holds_binary(first)
          ? "memory@0: expected a complete frame, got the end of the file in it"
          : "nothing")
        << form.name << " cut to " << size;
    }
  }
}

// The file was replaced since it was indexed, by one of the same size.
TEST(BinaryBadInput, AFileThatChangedSinceItWasIndexed)
{
  const MemoryCheck memory;
  for (const Form& form : forms())
  {
    const Frame frame = binary::particles(form, 258, 3, form.triclinic ? 1 : 0);
    const Bytes good = binary::write(form, { frame });
    const Dump dump(good.bytes, binary::names_for(form));
    const auto read = [&](const std::string& bytes)
    {
      const auto source = granular::open_memory(bytes);
      Decoded got;
      granular::Progress progress;
      const std::string error =
        error_of([&] { got.frame = read_dump(*source, dump.entry(), {}, got.notices, progress); });
      EXPECT_TRUE(!error.empty() || is_whole(got, frame));
      return error;
    };
    for (const Field& field : good.fields)
    {
      for (const Value& value : values)
      {
        if (field.real || holds(field, value.number))
        {
          const std::string error = read(binary::with_field(good, form, field, value.number));
          const bool harmless = field.name == "time" || field.name == "time flag" ||
            field.name == "nchunk" ||
            (!field.real && value.number == binary::integer_at(good.bytes, form, field)) ||
            (field.name == "box" &&
              good.bytes == binary::with_field(good, form, field, value.number));
          EXPECT_TRUE(harmless || error.find("changed") != error.npos ||
            error.find("shortened") != error.npos)
            << form.name << ": " << field.name << " at " << field.offset << " is " << value.name
            << ": '" << error << "'";
        }
      }
    }
    for (std::size_t size = 0; size < good.bytes.size(); ++size)
    {
      EXPECT_NE(read(good.bytes.substr(0, size)), "") << form.name << " " << size;
    }
  }
}
