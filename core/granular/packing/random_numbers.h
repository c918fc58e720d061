// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_random_numbers_h
#define granular_packing_random_numbers_h

#include <cmath>
#include <cstdint>

namespace granular
{
/// Spreads every bit of a number over all others (the finaliser of SplitMix64: G. Steele, D. Lea,
/// C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
constexpr std::uint64_t scramble(std::uint64_t value) noexcept
{
  value += 0x9e3779b97f4a7c15;
  value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9;
  value = (value ^ value >> 27) * 0x94d049bb133111eb;
  return value ^ value >> 31;
}

/// Returns a number in [0, 1) from random bits.
constexpr double unit_of(std::uint64_t bits) noexcept
{
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// The purposes of random numbers.
enum class Stream : std::uint64_t
{
  Places = 1,
  Sizes,
  Velocities
};

/// The random numbers of one item, such as a particle, by position and not by earlier draws: they are the same in any order
/// of requests. They use only integers, sums, products, divisions and roots, which are the same on all machines.
class RandomNumbers
{
public:
  constexpr RandomNumbers(std::uint64_t seed, Stream stream, std::int64_t thing) noexcept
    : key_(scramble(scramble(scramble(seed) ^ static_cast<std::uint64_t>(stream)) ^
        static_cast<std::uint64_t>(thing)))
  {
  }

  constexpr std::uint64_t bits() noexcept { return scramble(key_ + step * count_++); }

  /// Returns a uniform number in [0, 1).
  constexpr double unit() noexcept { return unit_of(this->bits()); }

  /// Returns a number of the normal distribution with mean 0 and standard deviation 1 (G. Marsaglia's polar method).
  double normal() noexcept
  {
    double x = 0;
    double square = 0;
    do
    {
      x = 2 * this->unit() - 1;
      const double y = 2 * this->unit() - 1;
      square = x * x + y * y;
    } while (square >= 1 || square == 0);
    return x * std::sqrt(-2 * logarithm(square) / square);
  }

private:
  static constexpr std::uint64_t step = 0xd1342543de82ef95; // odd: no number comes twice

  /// Returns the natural logarithm, to some ulps. Those of C libraries differ from machine to machine.
  static double logarithm(double value) noexcept
  {
    int exponent = 0;
    double mantissa = std::frexp(value, &exponent);
    if (mantissa < 0.70710678118654752)
    {
      mantissa *= 2;
      --exponent;
    }
    const double t = (mantissa - 1) / (mantissa + 1); // ln m = 2 artanh t
    double sum = 0;
    for (int n = 23; n >= 1; n -= 2)
    {
      sum = sum * t * t + 1.0 / n;
    }
    return 2 * t * sum + exponent * 0.69314718055994531;
  }

  std::uint64_t key_;
  std::uint64_t count_ = 0;
};
}
#endif
