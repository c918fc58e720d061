// SPDX-License-Identifier: BSD-3-Clause
// Damaged copies of files: bytes changed, words put in, parts lost, doubled or taken from another file.
#ifndef granular_tests_support_file_damage_h
#define granular_tests_support_file_damage_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

namespace file_damage
{
using Random = std::mt19937_64;

inline std::size_t below(Random& random, std::size_t end)
{
  return end == 0 ? 0 : static_cast<std::size_t>(random() % end);
}

inline std::string content_of(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

using Mutation = void (*)(std::string& bytes, const std::string& other, Random& random);

/// One more byte, or one less, or another one: most often among the first, where headers are.
inline std::size_t place_in(const std::string& bytes, Random& random)
{
  const std::size_t ends[] = { 512, bytes.size(), bytes.size(), bytes.size() };
  return below(random, std::min(bytes.size(), ends[below(random, std::size(ends))]));
}

inline constexpr Mutation mutations[] = {
  [](std::string& bytes, const std::string&, Random& random)
  {
    char& byte = bytes[place_in(bytes, random)];
    byte = static_cast<char>(byte ^ (1 << below(random, 8)));
  },
  [](std::string& bytes, const std::string&, Random& random)
  { bytes[place_in(bytes, random)] = static_cast<char>(random()); },
  [](std::string& bytes, const std::string&, Random& random)
  {
    constexpr std::string_view likely = "0123456789-+.eExyz cv_[]#\n\t\r\"ITM:";
    bytes[place_in(bytes, random)] = likely[below(random, likely.size())];
  },
  [](std::string& bytes, const std::string&, Random& random)
  {
    constexpr std::string_view words[] = { "nan", "-1", "1e308", "-inf", "0.5", "word", " ",
      "9223372036854775807", "4294967296", "\nITEM: TIMESTEP\n", "ITEM: ", " c_a[1] c_a[2] ", "id ",
      "position1 ", "x1 y1 z1 x2 y2 z2 ", "Bonds\n\n" };
    bytes.insert(place_in(bytes, random), words[below(random, std::size(words))]);
  },
  [](std::string& bytes, const std::string&, Random& random)
  { bytes.erase(place_in(bytes, random), below(random, 40) + 1); },
  [](std::string& bytes, const std::string&, Random& random)
  { bytes.resize(below(random, bytes.size()) + 1); },
  [](std::string& bytes, const std::string&, Random& random)
  {
    const std::string part = bytes.substr(place_in(bytes, random), below(random, 400));
    bytes.insert(place_in(bytes, random), part);
  },
  [](std::string& bytes, const std::string& other, Random& random)
  {
    const std::string part = other.substr(place_in(other, random), below(random, 2000));
    bytes.replace(place_in(bytes, random), below(random, 2000), part);
  },
  [](std::string& bytes, const std::string&, Random& random)
  {
    constexpr std::uint64_t numbers[] = { 0, 1, 5, 8, 0x7fffffff, 0x80000000, 0xffffffff,
      0x7fffffffffffffff, 0xffffffffffffffff, 0x7ff0000000000000, 0x7ff8000000000000 };
    const std::uint64_t number = numbers[below(random, std::size(numbers))];
    const std::size_t at = place_in(bytes, random) / 4 * 4;
    const std::size_t size = below(random, 2) == 0 ? 4 : 8;
    bytes.replace(at, size, reinterpret_cast<const char*>(&number), size);
  },
};

inline std::string damage(std::string bytes, const std::string& other, Random& random)
{
  for (std::size_t left = below(random, 3) + 1; left > 0 && !bytes.empty(); --left)
  {
    mutations[below(random, std::size(mutations))](bytes, other, random);
  }
  return bytes;
}
}
#endif
