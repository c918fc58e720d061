// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/reproducible_sum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace granular
{
namespace
{
__extension__ using Wide = __int128;

/// Below it no number has bits.
constexpr int least_exponent = -1074;

/// Levels of 21 bits and more each, as 2^40 terms leave them.
constexpr std::size_t most_levels = 128;

/// So many bits and more of a sum, and whether there are others, are enough to round it.
constexpr Wide enough = Wide{ 1 } << 62;

/// sum * 2^exponent, rounded once if it is a normal number.
double round_wide(Wide sum, int exponent) noexcept
{
  __extension__ using Unsigned = unsigned __int128;
  const Unsigned magnitude = sum < 0 ? -static_cast<Unsigned>(sum) : static_cast<Unsigned>(sum);
  const auto high = static_cast<std::uint64_t>(magnitude >> 62);
  const int shift = static_cast<int>(std::bit_width(high)); // what is above 62 bits
  const bool lost = (magnitude & ((Unsigned{ 1 } << shift) - 1)) != 0;
  const auto kept = static_cast<std::int64_t>(magnitude >> shift) | std::int64_t{ lost };
  const auto value = static_cast<double>(sum < 0 ? -kept : kept);
  const int power = exponent + shift;
  if (power > -1000 && power < 960) // much faster than ldexp, and as exact
  {
    return value * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + power) << 52);
  }
  return std::ldexp(value, power);
}

/// A sum of n pieces of w bits has w + log2(n), and one for the sign.
int width_of(std::int64_t terms) noexcept
{
  const auto most = static_cast<std::uint64_t>(std::max<std::int64_t>(terms, 1));
  return std::min(62 - static_cast<int>(std::bit_width(most)), 50);
}

/// Eight numbers at once, in whatever registers there are.
using Reals [[gnu::vector_size(64)]] = double;
using Bits [[gnu::vector_size(64)]] = std::uint64_t;

template <class To>
[[gnu::always_inline]] inline void copy(const void* from, To& to) noexcept
{
  std::memcpy(&to, from, sizeof to);
}

/// Returns true if all are 0; -0 is.
[[gnu::always_inline]] inline bool all_zero(const Reals& numbers) noexcept
{
  using Four [[gnu::vector_size(32)]] = std::uint64_t;
  using Two [[gnu::vector_size(16)]] = std::uint64_t;
  Bits bits;
  copy(&numbers, bits);
  bits <<= 1;
  std::array<Four, 2> four;
  copy(&bits, four);
  four[0] |= four[1];
  std::array<Two, 2> two;
  copy(&four[0], two);
  two[0] |= two[1];
  return (two[0][0] | two[0][1]) == 0;
}

/// Cuts the pieces of a cell's terms and adds them, level by level.
[[gnu::always_inline]] inline void add_terms(std::span<const SumScale::Terms> shifts,
  const SumScale::Terms& terms, std::int64_t* sums) noexcept
{
  Reals rest;
  copy(terms.data(), rest);
  for (std::size_t k = 0; k < shifts.size(); ++k)
  {
    Reals shift;
    copy(shifts[k].data(), shift);
    const Reals shifted = rest + shift;
    // unsigned numbers may wrap around, and the difference of the bits is the piece
    Bits sum;
    Bits more;
    Bits less;
    copy(sums, sum);
    copy(&shifted, more);
    copy(&shift, less);
    sum += more - less;
    std::memcpy(sums, &sum, sizeof sum);
    rest -= shifted - shift;
    // the first level hardly ever is enough
    if (k > 0 && k + 1 < shifts.size() && all_zero(rest))
    {
      return;
    }
    sums += SumScale::lanes;
  }
}

using Shifts = std::span<const SumScale::Terms>;

[[gnu::always_inline]] inline void add_all(
  Shifts shifts, Shifts terms, const std::int64_t* cells, std::int64_t* sums) noexcept
{
  const auto size = static_cast<std::int64_t>(SumScale::lanes * shifts.size());
  for (const SumScale::Terms& one : terms)
  {
    add_terms(shifts, one, sums + *cells++ * size);
  }
}

#if GRANULAR_X86
[[gnu::target("avx512f,avx512dq,avx512vl")]] void add_avx512(
  Shifts shifts, Shifts terms, const std::int64_t* cells, std::int64_t* sums) noexcept
{
  add_all(shifts, terms, cells, sums);
}
#endif
}

SumScale::SumScale(const std::array<Range, lanes>& ranges, std::int64_t terms)
  : width_(width_of(terms))
{
  std::size_t levels = 1;
  for (std::size_t i = 0; i < lanes; ++i)
  {
    const int bits = ranges[i].top - std::max(ranges[i].bottom, least_exponent);
    levels = std::max(levels, static_cast<std::size_t>(std::max(bits + width_ - 1, 0) / width_));
  }
  shifts_.resize(levels);
  for (std::size_t i = 0; i < lanes; ++i)
  {
    // the lowest level still has to be one of numbers
    top_[i] = std::max(ranges[i].top, least_exponent + static_cast<int>(levels) * width_);
    for (std::size_t k = 0; k < levels; ++k)
    {
      shifts_[k][i] = std::ldexp(1.5, 52 + top_[i] - static_cast<int>(k + 1) * width_);
    }
  }
}

SumScale::Terms SumScale::values(const std::int64_t* sums) const noexcept
{
  Terms values = {};
  if (std::all_of(sums, sums + this->size(), [](std::int64_t sum) { return sum == 0; }))
  {
    return values; // most cells of some grids are empty
  }
  for (std::size_t i = 0; i < lanes; ++i)
  {
    values[i] = this->value(sums, i);
  }
  return values;
}

/// Takes levels together until there are bits enough; of those below only the sign counts.
double SumScale::value(const std::int64_t* sums, std::size_t lane) const noexcept
{
  const std::size_t count = shifts_.size();
  if (count <= 2)
  {
    Wide sum = sums[lane];
    sum = count == 2 ? (sum << width_) + sums[lanes + lane] : sum;
    return round_wide(sum, top_[lane] - static_cast<int>(count) * width_);
  }
  // from below, so that each level holds less than one unit of the next
  std::array<std::int64_t, most_levels> digits;
  const std::int64_t half = std::int64_t{ 1 } << (width_ - 1);
  std::int64_t carry = 0;
  std::size_t used = 0; // levels down to the last that is not 0
  for (std::size_t k = count; k-- > 0;)
  {
    const std::int64_t digit = sums[k * lanes + lane] + carry;
    carry = k > 0 ? (digit + half) >> width_ : 0;
    digits[k] = digit - (carry << width_);
    used = used == 0 && digits[k] != 0 ? k + 1 : used;
  }
  Wide sum = 0;
  std::size_t k = 0;
  for (; k < used && sum < enough && sum > -enough; ++k)
  {
    sum = (sum << width_) + digits[k];
  }
  // of those below only the sign of the first counts
  const auto next = std::find_if(digits.begin() + static_cast<std::ptrdiff_t>(k),
    digits.begin() + static_cast<std::ptrdiff_t>(used),
    [](std::int64_t digit) { return digit != 0; });
  const int sticky = k < used ? (*next > 0 ? 1 : -1) : 0;
  return round_wide((sum << 2) + sticky, top_[lane] - static_cast<int>(k) * width_ - 2);
}

void SumScale::add(std::span<const Terms> terms, const std::int64_t* cells, std::int64_t* sums,
  Simd simd) const noexcept
{
#if GRANULAR_X86
  if (simd == Simd::Avx512) // in registers of half the size GCC makes it slower than without them
  {
    return add_avx512(shifts_, terms, cells, sums);
  }
#endif
  static_cast<void>(simd);
  add_all(shifts_, terms, cells, sums);
}
}
