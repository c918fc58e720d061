// SPDX-License-Identifier: BSD-3-Clause
// What exact positions cost: time to read a row, memory, and error, for ways to print positions and
// ways to keep them, in boxes near to and far from the origin.
//
// The simulation holds each coordinate as a double in the box [lo, lo + 1]: that is the true
// position. It is printed as LIGGGHTS and LAMMPS do, scaled ones being (x - lo) / 1 in doubles.
// What the text says is worked out in 113 bits: its distance from the true position is what the
// digits of the text lose; the distance of the points from it is what reading loses.
#include "bench.h"
#include "dump_text.h"

#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

namespace bench
{
namespace
{
/// 113 bits.
__extension__ typedef __float128 Quad;

constexpr double box_length = 1;
constexpr double smallest_radius = 1e-3;

Quad magnitude(Quad value)
{
  return value < 0 ? -value : value;
}

/// The value of a decimal as append() prints it, within 2^-112 of itself.
Quad value_of(std::string_view word)
{
  const std::size_t exponent = std::min(word.find('e'), word.size());
  Quad digits = 0;
  int power = 0;
  bool behind_point = false;
  for (const char c : word.substr(0, exponent))
  {
    if (c >= '0' && c <= '9')
    {
      digits = digits * 10 + (c - '0');
      power -= behind_point ? 1 : 0;
    }
    behind_point = behind_point || c == '.';
  }
  if (exponent < word.size())
  {
    power += std::stoi(std::string(word.substr(exponent + 1)));
  }
  Quad scale = 1;
  for (int i = 0; i < std::abs(power); ++i)
  {
    scale *= 10;
  }
  const Quad value = power < 0 ? digits / scale : digits * scale;
  return word.starts_with('-') ? -value : value;
}

/// How positions and box are printed.
struct Text
{
  const char* name;
  bool scaled;
  Print print;
  Print box;
};

constexpr std::array<Text, 5> texts = { {
  { "x y z %g", false, Print::General, Print::General },
  { "x y z %.16e", false, Print::Full, Print::Full },
  { "xs ys zs %g, box %g", true, Print::General, Print::General },
  { "xs ys zs %g, box %.16e", true, Print::General, Print::Full },
  { "xs ys zs %.16e, box %.16e", true, Print::Full, Print::Full },
} };

struct BoxPlace
{
  const char* name;
  double lo;
};

constexpr std::array<BoxPlace, 3> places = { { { "0", 0 }, { "1e3", 1e3 }, { "1e6", 1e6 } } };

/// A file, the true positions, and what its text says.
struct Dump
{
  Dump(const Text& how, double lo, std::int64_t count);

  TemporaryFile file;
  granular::RunIndex index;
  std::vector<double> truth;
  std::vector<Quad> told;
  std::vector<Quad> slack; ///< what rounding the words of the text to doubles may move
};

std::string print(double value, Print how)
{
  std::string word;
  append(word, value, how);
  return word;
}

/// Half the distance to the next number with so many bits: 53 for a double, 24 for a float.
Quad half_step(double value, int bits)
{
  return value == 0 ? 0 : std::ldexp(1.0, std::ilogb(value) - bits);
}

Dump::Dump(const Text& how, double lo, std::int64_t count)
{
  const double hi = lo + box_length;
  const Quad told_lo = value_of(print(lo, how.box));
  const Quad told_hi = value_of(print(hi, how.box));
  Rows rows;
  rows.columns = how.scaled ? "id type xs ys zs radius " : "id type x y z radius ";
  Random random(7);
  for (std::int64_t row = 0; row < count; ++row)
  {
    append(rows.text, row + 1);
    rows.text += " 1 ";
    for (int k = 0; k < 3; ++k)
    {
      const double x = lo + box_length * random.unit();
      const std::string word = print(how.scaled ? (x - lo) / (hi - lo) : x, how.print);
      const Quad value = value_of(word);
      const Quad length = how.scaled ? told_hi - told_lo : 1;
      truth.push_back(x);
      told.push_back(how.scaled ? told_lo + value * length : value);
      slack.push_back(half_step(std::strtod(word.c_str(), nullptr), 53) * length);
      rows.text += word;
      rows.text += ' ';
    }
    append(rows.text, random.between(smallest_radius, 2 * smallest_radius), Print::General);
    rows.text += " \n";
  }
  file.append(header(0, count, lo, hi, how.box, rows));
  file.append(rows.text);
  granular::Notices notices;
  granular::Progress progress;
  index.update({ file.path() }, { .format = &granular::dump_format() }, notices, progress);
}

/// Largest and root of the mean square.
struct Error
{
  Quad largest = 0;
  Quad squares = 0;

  void add(Quad error)
  {
    largest = std::max(largest, magnitude(error));
    squares += error * error;
  }

  double rms(std::size_t count) const
  {
    return std::sqrt(static_cast<double>(squares / static_cast<Quad>(count)));
  }
};

/// One way to read one file.
struct Case
{
  std::string name;
  const Dump* dump;
  granular::DumpRequest request;
  Error of_text;
  Error of_reading;
  Error together;
  double bytes = 0; ///< a row
  bool right = true;

  granular::DumpFrame read() const
  {
    granular::Notices notices;
    granular::Progress progress;
    return granular::read_dump(dump->index.pieces(0), request, notices, progress);
  }

  void measure_errors();
};

/// Compares points plus origin with what the text says and with the truth. Reading is right where
/// it loses no more than rounding the words to doubles, the sum to a double, and that to a float.
void Case::measure_errors()
{
  const granular::DumpFrame frame = this->read();
  const auto rows = static_cast<std::size_t>(frame.rows);
  bytes = static_cast<double>(frame.points.bytes());
  for (const granular::DumpArray& array : frame.arrays)
  {
    bytes += static_cast<double>(array.block.bytes());
  }
  bytes /= static_cast<double>(rows);
  right = 3 * rows == dump->truth.size();
  const auto* const doubles = static_cast<const double*>(frame.points.data());
  const auto* const floats = static_cast<const float*>(frame.points.data());
  for (std::size_t i = 0; right && i < 3 * rows; ++i)
  {
    const bool single = request.single_precision;
    const double point = single ? static_cast<double>(floats[i]) : doubles[i];
    const Quad position = static_cast<Quad>(point) + request.point_origin[i % 3];
    Quad allowed = dump->slack[i] + half_step(point, 53);
    allowed += single ? half_step(point, 24) : 0;
    of_text.add(dump->told[i] - dump->truth[i]);
    of_reading.add(position - dump->told[i]);
    together.add(position - dump->truth[i]);
    right = magnitude(position - dump->told[i]) <= allowed * (1 + 1e-9) + 1e-30;
  }
}

/// All ways, each read once a round in turns.
class Ways
{
public:
  Ways(std::int64_t rows, std::int64_t rounds)
  {
    for (const BoxPlace& place : places)
    {
      for (const Text& text : texts)
      {
        if (text.scaled && print(place.lo, text.box) == print(place.lo + box_length, text.box))
        {
          continue; // such a box has no length to scale by: to read it is an error
        }
        dumps_.push_back(std::make_unique<Dump>(text, place.lo, rows));
        const std::string name = std::string("box at ") + place.name + "; " + text.name;
        for (const bool single : { false, true })
        {
          this->add(name, single, {});
          const double centre = place.lo + box_length / 2;
          this->add(name, single, { centre, centre, centre });
        }
      }
    }
    for (Case& each : cases)
    {
      each.measure_errors();
      times.add(each.name, [&each] { return each.read().rows > 0; });
    }
    for (std::int64_t round = 0; round < rounds; ++round)
    {
      times.run(static_cast<double>(rows));
    }
  }

  std::vector<Case> cases;
  Rounds times;

private:
  void add(const std::string& name, bool single, const granular::Vector3& origin)
  {
    Case way;
    way.name = name + "; " + (single ? "single" : "double") + "; " +
      (origin == granular::Vector3{} ? "no origin" : "box centre");
    way.dump = dumps_.back().get();
    way.request.single_precision = single;
    way.request.point_origin = origin;
    cases.push_back(std::move(way));
  }

  std::vector<std::unique_ptr<Dump>> dumps_;
};

void tell_error(
  benchmark::State& state, const std::string& what, const Error& error, std::size_t count)
{
  const auto largest = static_cast<double>(error.largest);
  const double rms = error.rms(count);
  tell(state, what + ", largest", largest / box_length, "box length");
  tell(state, what + ", rms", rms / box_length, "box length");
  tell(state, what + ", largest", largest / smallest_radius, "smallest radius");
  tell(state, what + ", rms", rms / smallest_radius, "smallest radius");
}

void one_way(benchmark::State& state, Ways& ways, std::size_t index)
{
  const Case& way = ways.cases[index];
  const Samples& times = ways.times.of(way.name);
  const std::size_t count = way.dump->truth.size();
  std::size_t round = 0;
  for (auto _ : state)
  {
    state.SetIterationTime(times[round++] * static_cast<double>(count / 3));
  }
  if (!way.right)
  {
    fail(state, "points are further from the text than rounding explains");
    return;
  }
  tell(state, "time", 1e9 * median(times), "ns/row");
  const Samples& first = ways.times.of(ways.cases.front().name);
  tell(state, "time against the first way", median_ratio(times, first), "1");
  tell(state, "memory", way.bytes, "B/row");
  tell_error(state, "error of text", way.of_text, count);
  tell_error(state, "error of reading", way.of_reading, count);
  tell_error(state, "error", way.together, count);
}
}

void add_benchmarks(const Size& size)
{
  const std::int64_t rounds = size.pick(15, 1);
  const auto ways = std::make_shared<Ways>(size.pick(100'000, 2'000), rounds);
  for (std::size_t i = 0; i < ways->cases.size(); ++i)
  {
    add("positions/" + ways->cases[i].name, rounds,
      [ways, i](benchmark::State& state) { one_way(state, *ways, i); });
  }
}
}
