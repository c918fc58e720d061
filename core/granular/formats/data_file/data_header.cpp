// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/data_header.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <utility>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;

/// The things that the header counts.
constexpr std::pair<std::string_view, std::int64_t DataLayout::*> counted[] = {
  { "atoms", &DataLayout::atoms }, { "bonds", &DataLayout::bonds },
  { "ellipsoids", &DataLayout::ellipsoids }, { "lines", &DataLayout::lines },
  { "triangles", &DataLayout::triangles }, { "bodies", &DataLayout::bodies },
  { "atom types", &DataLayout::atom_types }, { "bond types", &DataLayout::bond_types }
};

/// A line of the header that describes the box, by the words behind its numbers.
struct BoxLine
{
  std::string_view words;
  std::size_t numbers;
};

enum BoxLines : std::uint8_t
{
  BoundsX,
  BoundsY,
  BoundsZ,
  Tilts,
  VectorA,
  VectorB,
  VectorC,
  Origin,
  BoxLineCount
};

constexpr BoxLine box_lines[BoxLineCount] = { { "xlo xhi", 2 }, { "ylo yhi", 2 }, { "zlo zhi", 2 },
  { "xy xz yz", 3 }, { "avec", 3 }, { "bvec", 3 }, { "cvec", 3 }, { "abc origin", 3 } };

/// Returns the words behind the numbers of a line.
std::string words_behind(const Words& words, std::size_t numbers)
{
  const auto first = static_cast<std::ptrdiff_t>(std::min(numbers, words.size()));
  return join_words(Words(words.begin() + first, words.end()));
}

Vector3 read_numbers(const Words& words, std::size_t count, const Where& where)
{
  Vector3 numbers = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!parse_double(words[i].data(), words[i].data() + words[i].size(), numbers[i]))
    {
      throw FormatError("expected a number, got " + quoted(words[i]), where);
    }
  }
  return numbers;
}
}

Words data_words(std::string_view line)
{
  return split_words(line.substr(0, line.find('#')));
}

char first_letter(std::string_view line) noexcept
{
  const auto first = std::ranges::find_if_not(line, is_blank);
  return first == line.end() ? '\0' : *first;
}

bool names_section(std::string_view line) noexcept
{
  return std::isalpha(static_cast<unsigned char>(first_letter(line))) != 0;
}

bool is_integer(std::string_view word, std::int64_t& value)
{
  return static_cast<bool>(parse_int64(word.data(), word.data() + word.size(), value));
}

bool is_type(std::string_view word, const TypeLabels* labels, std::int64_t& type)
{
  const bool is_label = labels && labels->contains(word);
  type = is_label ? labels->find(word)->second : 0;
  return is_label || is_integer(word, type);
}

void take_title(std::string_view title, DataLayout& layout)
{
  const Words words = split_words(title);
  for (std::size_t i = 2; i < words.size(); ++i)
  {
    const std::string_view value = words[i].substr(0, words[i].find(','));
    std::int64_t number = 0;
    if (words[i - 1] == "=" && words[i - 2] == "timestep" && is_integer(value, number))
    {
      layout.timestep = number;
    }
    if (words[i - 1] == "=" && words[i - 2] == "units")
    {
      layout.units = value;
    }
  }
}

void HeaderLines::take(std::string_view line, const Where& where, DataLayout& layout)
{
  const Words words = data_words(line);
  for (const auto& [name, place] : counted)
  {
    if (words.size() > 1 && words_behind(words, 1) == name)
    {
      if (!is_integer(words[0], layout.*place) || layout.*place < 0)
      {
        throw FormatError(
          "expected a number of " + std::string(name) + ", got " + quoted(words[0]), where);
      }
      counts_atoms = counts_atoms || name == "atoms";
    }
  }
  for (std::size_t i = 0; i < BoxLineCount; ++i)
  {
    const std::size_t numbers = box_lines[i].numbers;
    if (words.size() > numbers && words_behind(words, numbers) == box_lines[i].words)
    {
      numbers_[i] = read_numbers(words, numbers, where);
    }
  }
}

Box HeaderLines::box() const
{
  constexpr Vector3 usual = { -0.5, 0.5, 0 };
  if (numbers_[VectorA] || numbers_[VectorB] || numbers_[VectorC])
  {
    return Box::from_vectors(numbers_[Origin].value_or(Vector3{}),
      { numbers_[VectorA].value_or(Vector3{ 1, 0, 0 }),
        numbers_[VectorB].value_or(Vector3{ 0, 1, 0 }),
        numbers_[VectorC].value_or(Vector3{ 0, 0, 1 }) });
  }
  const Vector3 x = numbers_[BoundsX].value_or(usual);
  const Vector3 y = numbers_[BoundsY].value_or(usual);
  const Vector3 z = numbers_[BoundsZ].value_or(usual);
  Box box = Box::from_bounds({ x[0], y[0], z[0] }, { x[1], y[1], z[1] });
  if (numbers_[Tilts]) // the bounds are those of the box, not of what is around it as in dumps
  {
    const auto [xy, xz, yz] = *numbers_[Tilts];
    box.tilted = true;
    box.vectors[1][0] = { xy, 0 };
    box.vectors[2][0] = { xz, 0 };
    box.vectors[2][1] = { yz, 0 };
  }
  return box;
}

bool HeaderLines::describes_box() const
{
  return std::ranges::any_of(numbers_, [](const auto& numbers) { return numbers.has_value(); });
}

bool starts_data_file(std::string_view first_bytes)
{
  const std::size_t title = first_bytes.find('\n');
  HeaderLines header;
  DataLayout layout;
  bool has_section = false;
  for (std::size_t feed = title; feed != first_bytes.npos;)
  {
    const std::size_t next = first_bytes.find('\n', feed + 1);
    const std::string_view line = first_bytes.substr(feed + 1, next - feed - 1);
    if (names_section(line))
    {
      has_section = is_known_section(join_words(data_words(line)));
      break;
    }
    try
    {
      header.take(line, {}, layout);
    }
    catch (const FormatError&) // says so when it is read
    {
    }
    feed = next;
  }
  return header.counts_atoms && (has_section || header.describes_box() || layout.bonds > 0);
}
}
