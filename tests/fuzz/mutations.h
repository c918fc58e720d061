// SPDX-License-Identifier: BSD-3-Clause
// What the mutators of fuzz targets share: bytes that are changed so that counts and lengths still fit.
#ifndef granular_tests_fuzz_mutations_h
#define granular_tests_fuzz_mutations_h

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <string>

/// One of libFuzzer's own mutations. Returns the new size.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace granular::fuzz
{
using Random = std::minstd_rand;

/// Returns a number below end, or 0.
inline std::size_t below(Random& random, std::size_t end)
{
  return end == 0 ? 0 : static_cast<std::size_t>(random()) % end;
}

inline bool one_in(Random& random, std::size_t many)
{
  return below(random, many) == 0;
}

/// Changes bytes anyhow.
inline void mutate_bytes(std::string& bytes, std::size_t most)
{
  const std::size_t size = bytes.size();
  bytes.resize(std::max({ size, most, std::size_t{ 1 } }));
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
}

/// Returns a number in this machine's order of bytes or the other one; 0 if it is not there.
template <typename T>
T load(const std::string& bytes, std::size_t at, bool swapped = false)
{
  std::array<char, sizeof(T)> own = {};
  if (at <= bytes.size() && bytes.size() - at >= own.size())
  {
    bytes.copy(own.data(), own.size(), at);
  }
  if (swapped)
  {
    std::ranges::reverse(own);
  }
  return std::bit_cast<T>(own);
}

template <typename T>
void store(std::string& bytes, std::size_t at, T value, bool swapped = false)
{
  auto own = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (swapped)
  {
    std::ranges::reverse(own);
  }
  if (at <= bytes.size() && bytes.size() - at >= own.size())
  {
    bytes.replace(at, own.size(), own.data(), own.size());
  }
}

template <typename T>
void append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// An integer near a limit, near the old one, or any.
template <typename T>
T other_integer(T old, Random& random)
{
  constexpr std::int64_t likely[] = { 0, 1, 2, 3, -1, 127, 4096, 65536, 1 << 24, INT32_MAX,
    INT32_MIN, std::int64_t{ 1 } << 32, std::int64_t{ 1 } << 53, INT64_MAX, INT64_MIN };
  switch (below(random, 3))
  {
    case 0:
      return static_cast<T>(likely[below(random, std::size(likely))]);
    case 1:
      return static_cast<T>(static_cast<std::uint64_t>(old) + below(random, 5) - 2);
    default:
      return static_cast<T>(std::uint64_t{ random() } << below(random, 34));
  }
}

/// A double that readers treat in a way of its own, a small integer, or any.
inline double other_double(Random& random)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double likely[] = { 0.0, -0.0, 1, -1, 0.5, 2, 1e308, -1e308, 5e-324, 2147483647,
    2147483648, -2147483649.0, 9007199254740992.0, 9007199254740994.0, 9223372036854775808.0,
    infinite, -infinite, std::numeric_limits<double>::quiet_NaN() };
  switch (below(random, 3))
  {
    case 0:
      return likely[below(random, std::size(likely))];
    case 1:
      return static_cast<double>(below(random, 32)) - 4;
    default:
    {
      const std::uint64_t bits =
        std::uint64_t{ random() } << 33 ^ std::uint64_t{ random() } << 11 ^ random();
      return std::bit_cast<double>(bits);
    }
  }
}

/// The target's own mutator.
void mutate(std::string& bytes, Random& random, std::size_t most);
}

/// Keeps what comes of the target's own mutator if it fits. This header belongs to the one source of a target.
extern "C" std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
  granular::fuzz::Random random(seed | 1u);
  random.discard(2); // the first numbers of near seeds are near
  std::string bytes(reinterpret_cast<const char*>(data), size);
  granular::fuzz::mutate(bytes, random, most);
  if (bytes.empty() || bytes.size() > most)
  {
    return LLVMFuzzerMutate(data, size, most);
  }
  bytes.copy(reinterpret_cast<char*>(data), bytes.size());
  return bytes.size();
}

#endif
