// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps that are damaged, cut or still being written: every one is an error that names a place,
// or the frames that are whole; never more memory than the file is worth.
#include "granular/dump/binary_header.h"
#include "granular/dump/frame_index.h"

#include "binary_dumps.h"
#include "dumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace
{
std::size_t largest_request = 0; ///< of memory, since it was last set to 0
}

// NOLINTBEGIN: every allocation of the program is seen
[[gnu::noinline]] void* operator new(std::size_t bytes)
{
  largest_request = std::max(largest_request, bytes);
  if (void* memory = std::malloc(std::max(bytes, std::size_t{ 1 })))
  {
    return memory;
  }
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new[](std::size_t bytes)
{
  return operator new(bytes);
}

[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete[](void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}
// NOLINTEND

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

/// The most memory that the process has held, in bytes.
std::size_t peak_memory()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// Memory that a test takes, in single requests and in all. A sanitizer keeps freed memory.
class MemoryCheck
{
public:
  MemoryCheck()
    : before_(peak_memory())
  {
    largest_request = 0;
  }

  ~MemoryCheck()
  {
    EXPECT_LT(largest_request, much);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(peak_memory() - before_, much);
#endif
  }

private:
  std::size_t before_;
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
  return field.bytes == 8 || (value >= -(std::int64_t{ 1 } << bits) && value < std::int64_t{ 1 } << bits);
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
    frame.box[3] - frame.box[2] - std::max(0.0, yz) + std::min(0.0, yz), frame.box[5] - frame.box[4] };
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
    (field.name == "time flag" && value != 0) || (!field.real && value == binary::integer_at(bytes.bytes, form, field));
}
}

// ---- numbers of the header ---------------------------------------------------------------------------

TEST(BinaryBadInput, EveryNumberOfTheHeaderChanged)
{
  const MemoryCheck memory;
  std::map<std::string, int> said;
  for (const Form& form : forms())
  {
    for (int triclinic = 0; triclinic <= form.most_triclinic(); ++triclinic)
    {
      const Frame frame = binary::grains(form, 3, 5, triclinic);
      const Bytes good = binary::write(form, { frame });
      const std::string behind = binary::write(form, { binary::grains(form, 4, 1, triclinic) }).bytes;
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
            SCOPED_TRACE(form.name + ", triclinic " + std::to_string(triclinic) + ": " + field.name + " at " +
              std::to_string(field.offset) + " is " + value.name +
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
            ++said[form.name + " " + field.name + " " + value.name + (bytes.size() > bad.size() ? " +" : "") + " " + std::to_string(place-static_cast<std::int64_t>(field.offset)) +": "+ defect];
          }
        }
      }
    }
  }
  if (std::getenv("SHOW"))
  for (auto& [a, b] : said) printf("%s\n", a.c_str());
}
