// SPDX-License-Identifier: BSD-3-Clause
#include "dump_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace bench
{
namespace
{
using granular::ColumnSink;

/// Ids in no order, as several processes leave them: each once if count is a power of ten.
std::int64_t id_of(std::int64_t row, std::int64_t count)
{
  constexpr std::int64_t step = 7919; // a prime
  return row * step % count + 1;
}

void append_atom(std::string& text, Random& random)
{
  append(text, static_cast<std::int64_t>(1 + random.bits() % 3));
  for (int k = 0; k < 3; ++k)
  {
    text += ' ';
    append(text, random.unit(), Print::General);
  }
  for (int k = 0; k < 3; ++k)
  {
    text += ' ';
    append(text, static_cast<std::int64_t>(random.bits() % 5) - 2);
  }
}

/// The ten columns of doubles of a custom row: places in a box of 1 m, velocities of 0.1 m/s,
/// forces of 10 mN, radii of 1 to 2 mm.
void append_custom(std::string& text, Random& random, Form form)
{
  const Print print = form == Form::CustomFull ? Print::Full
    : form == Form::CustomFixed                ? Print::Fixed
                                               : Print::General;
  const bool rests = form == Form::CustomAtRest && random.bits() % 2 == 0;
  append(text, static_cast<std::int64_t>(1 + random.bits() % 3));
  for (int k = 0; k < 10; ++k)
  {
    double value = k < 3 ? random.unit()
      : k < 6            ? 0.1 * random.bell()
      : k < 9            ? 0.01 * random.bell()
                         : random.between(1e-3, 2e-3);
    if (form == Form::Tiny || form == Form::Extreme)
    {
      const double power = form == Form::Tiny ? random.between(-40, -5) : random.between(-300, 300);
      value = (k % 2 == 0 ? 1 : -1) * std::pow(10, power);
    }
    text += ' ';
    append(text, rests && k >= 3 && k < 9 ? 0.0 : value, print);
  }
  text += ' '; // `dump custom` ends its rows so
}

void append_integers(std::string& text, Random& random)
{
  append(text, static_cast<std::int64_t>(1 + random.bits() % 3));
  std::uint64_t range = 10;
  for (int k = 0; k < 10; ++k)
  {
    const auto value = static_cast<std::int64_t>(random.bits() % range);
    text += ' ';
    append(text, k % 3 == 2 ? -value : value);
    range *= 10;
  }
}

const std::vector<Array>& arrays_of(Form form)
{
  static const std::vector<Array> atom = { { ValueType::Int64, 1 }, { ValueType::Int32, 1 },
    { ValueType::Float64, 3 }, { ValueType::Int32, 3 } };
  static const std::vector<Array> custom = { { ValueType::Int64, 1 }, { ValueType::Int32, 1 },
    { ValueType::Float64, 3 }, { ValueType::Float64, 3 }, { ValueType::Float64, 3 },
    { ValueType::Float64, 1 } };
  static const std::vector<Array> integers = { { ValueType::Int64, 1 }, { ValueType::Int32, 1 },
    { ValueType::Int64, 10 } };
  return form == Form::Atom ? atom : form == Form::Integers ? integers : custom;
}

bool is_space(char c)
{
  return c == ' ' || c == '\n';
}

/// The values of a row that an array gets; null where one is no number.
template <typename T>
const char* store(const char* first, const char* last, Output::Place& place)
{
  for (std::size_t k = 0; k < place.array.components; ++k)
  {
    while (first != last && is_space(*first))
    {
      ++first;
    }
    T value{};
    const auto [ptr, ec] = std::from_chars(first, last, value);
    if (ec != std::errc{})
    {
      return nullptr;
    }
    std::memcpy(place.data, &value, sizeof value);
    place.data += sizeof value;
    first = ptr;
  }
  return first;
}
}

void append(std::string& text, double value, Print print)
{
  constexpr std::chars_format formats[] = { std::chars_format::general,
    std::chars_format::scientific, std::chars_format::fixed };
  constexpr int digits[] = { 6, 16, 6 };
  const auto index = static_cast<std::size_t>(print);
  char word[400];
  const auto [end, ec] =
    std::to_chars(word, word + sizeof word, value, formats[index], digits[index]);
  if (ec != std::errc{})
  {
    throw std::logic_error("a number is too long");
  }
  text.append(word, end);
}

void append(std::string& text, std::int64_t value)
{
  char word[24];
  text.append(word, std::to_chars(word, word + sizeof word, value).ptr);
}

std::size_t Array::bytes_a_row() const
{
  return size_of(kind) * components;
}

std::uint32_t Rows::words() const
{
  std::size_t count_words = 0;
  for (const Array& array : arrays)
  {
    count_words += array.components;
  }
  return static_cast<std::uint32_t>(count_words);
}

Rows make_rows(Form form, std::int64_t count)
{
  Rows rows;
  rows.columns = form == Form::Atom ? "id type xs ys zs ix iy iz"
    : form == Form::Integers        ? "id type i_1 i_2 i_3 i_4 i_5 i_6 i_7 i_8 i_9 i_10 "
                                    : "id type x y z vx vy vz fx fy fz radius ";
  rows.arrays = arrays_of(form);
  rows.count = count;
  Random random(static_cast<std::uint64_t>(form) + 1);
  for (std::int64_t row = 0; row < count; ++row)
  {
    append(rows.text, id_of(row, count));
    rows.text += ' ';
    if (form == Form::Atom)
    {
      append_atom(rows.text, random);
    }
    else if (form == Form::Integers)
    {
      append_integers(rows.text, random);
    }
    else
    {
      append_custom(rows.text, random, form);
    }
    rows.text += '\n';
  }
  return rows;
}

granular::PaddedBuffer padded(const std::string& text)
{
  granular::PaddedBuffer buffer(text.size());
  std::memcpy(buffer.data(), text.data(), text.size());
  return buffer;
}

std::vector<Slice> cut(const char* first, const char* last, std::size_t bytes)
{
  std::vector<Slice> slices;
  std::int64_t row = 0;
  while (first < last)
  {
    const char* const about =
      static_cast<std::size_t>(last - first) <= bytes ? last - 1 : first + bytes;
    const char* const end = std::find(about, last, '\n') + 1;
    const std::int64_t rows = std::count(first, end, '\n');
    slices.push_back({ first, end, row, rows });
    row += rows;
    first = end;
  }
  return slices;
}

std::string header(
  std::int64_t timestep, std::int64_t rows, double lo, double hi, Print print, const Rows& form)
{
  std::string bounds;
  append(bounds, lo, print);
  bounds += ' ';
  append(bounds, hi, print);
  bounds += '\n';
  return "ITEM: TIMESTEP\n" + std::to_string(timestep) + "\nITEM: NUMBER OF ATOMS\n" +
    std::to_string(rows) + "\nITEM: BOX BOUNDS pp pp pp\n" + bounds + bounds + bounds +
    "ITEM: ATOMS " + form.columns + "\n";
}

Output::Output(const Rows& form, std::int64_t rows)
  : arrays_(form.arrays)
{
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    memory_.emplace_back(static_cast<std::size_t>(rows) * this->bytes_a_row(i), '\xff');
  }
}

std::vector<Output::Place> Output::places(std::int64_t row)
{
  std::vector<Place> places;
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    const std::size_t offset = static_cast<std::size_t>(row) * arrays_[i].bytes_a_row();
    places.push_back({ arrays_[i], memory_[i].data() + offset });
  }
  return places;
}

std::vector<ColumnSink> Output::sinks(std::int64_t row)
{
  std::vector<ColumnSink> sinks;
  for (const Place& place : this->places(row))
  {
    for (std::size_t k = 0; k < place.array.components; ++k)
    {
      sinks.push_back({ static_cast<std::uint32_t>(sinks.size()), place.array.kind,
        place.data + k * size_of(place.array.kind),
        static_cast<std::ptrdiff_t>(place.array.bytes_a_row()) });
    }
  }
  return sinks;
}

void Output::spoil()
{
  for (std::vector<char>& memory : memory_)
  {
    std::fill(memory.begin(), memory.end(), '\xff');
  }
}

const char* parse_plainly(
  const char* first, const char* last, std::span<Output::Place> places, std::int64_t rows)
{
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (Output::Place& place : places)
    {
      first = place.array.kind == ValueType::Float64 ? store<double>(first, last, place)
        : place.array.kind == ValueType::Int32       ? store<std::int32_t>(first, last, place)
                                                     : store<std::int64_t>(first, last, place);
      if (!first)
      {
        return nullptr;
      }
    }
  }
  return first;
}

bool parse_slowly(const char* first, std::span<ColumnSink> sinks, std::int64_t rows)
{
  for (std::int64_t row = 0; row < rows; ++row)
  {
    for (ColumnSink& sink : sinks)
    {
      char* end = nullptr;
      if (sink.type == ValueType::Float64)
      {
        const double value = std::strtod(first, &end);
        std::memcpy(sink.data, &value, sizeof value);
      }
      else
      {
        const std::int64_t value = std::strtoll(first, &end, 10);
        const auto narrow = static_cast<std::int32_t>(value);
        const void* const from =
          sink.type == ValueType::Int32 ? static_cast<const void*>(&narrow) : &value;
        std::memcpy(sink.data, from, size_of(sink.type));
      }
      if (end == first)
      {
        return false;
      }
      first = end;
      sink.data += sink.stride;
    }
  }
  return true;
}

TextInMemory::TextInMemory(const Rows& rows, std::int64_t repeats)
  : text_(rows.text.size() * static_cast<std::size_t>(repeats))
  , output_(rows, rows.count * repeats)
  , words_(rows.words())
  , count_(rows.count * repeats)
{
  for (std::size_t at = 0; at < text_.size(); at += rows.text.size())
  {
    std::memcpy(text_.data() + at, rows.text.data(), rows.text.size());
  }
}

bool TextInMemory::decode()
{
  std::vector<ColumnSink> sinks = output_.sinks(0);
  const granular::RowResult result = granular::decode_rows(text_.data(),
    text_.data() + text_.size(), words_, sinks, std::numeric_limits<std::int64_t>::max());
  return result.status == granular::RowStatus::Done && result.rows == count_;
}

bool TextInMemory::parse()
{
  std::vector<Output::Place> places = output_.places(0);
  return parse_plainly(text_.data(), text_.data() + text_.size(), places, count_) != nullptr;
}

TemporaryFile::TemporaryFile(const char* extension)
{
  static int number = 0;
  path_ = std::string(GRANULAR_OUTPUT) + "/" + std::to_string(::getpid()) + "_" +
    std::to_string(number++) + extension;
  std::filesystem::create_directories(GRANULAR_OUTPUT);
  std::filesystem::remove(path_);
}

TemporaryFile::~TemporaryFile()
{
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void TemporaryFile::append(std::string_view text)
{
  std::ofstream out(path_, std::ios::binary | std::ios::app);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out)
  {
    throw std::runtime_error("cannot write " + path_);
  }
}

void write_frame(TemporaryFile& file, const Rows& rows, std::int64_t count)
{
  file.append(header(0, count, 0, 1, Print::Full, rows));
  for (std::int64_t row = 0; row < count; row += rows.count)
  {
    file.append(rows.text);
  }
}
}
