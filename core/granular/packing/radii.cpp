// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/radii.h"

#include "granular/common/error.h"
#include "granular/packing/random_numbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace granular
{
namespace
{
/// Between much larger particles, small ones rarely find a place.
constexpr double largest_ratio = 20;

double cube(double value)
{
  return value * value * value;
}
}

double RadiusChoice::smallest() const noexcept
{
  return kind == Kind::One ? first : std::min(first, second);
}

double RadiusChoice::largest() const noexcept
{
  return kind == Kind::One ? first : std::max(first, second);
}

double RadiusChoice::mean_volume() const noexcept
{
  const double seconds = kind == Kind::Two ? share : 0;
  return 4.0 / 3 * std::numbers::pi * ((1 - seconds) * cube(first) + seconds * cube(second));
}

void check(const RadiusChoice& choice)
{
  const double values[] = { choice.first, choice.second };
  for (int i = 0; i < (choice.kind == RadiusChoice::Kind::One ? 1 : 2); ++i)
  {
    if (!(values[i] > 0) || !std::isfinite(values[i]))
    {
      throw LimitError("expected a finite radius greater than 0, got " + std::to_string(values[i]));
    }
  }
  if (choice.kind == RadiusChoice::Kind::Two && !(choice.share >= 0 && choice.share <= 1))
  {
    throw LimitError(
      "expected a share of the second radius from 0 to 1, got " + std::to_string(choice.share));
  }
  const double ratio = choice.largest() / choice.smallest();
  if (!(ratio <= largest_ratio))
  {
    throw LimitError("expected radii of which the largest is at most 20 times the smallest, got " +
      std::to_string(ratio) + " times");
  }
}

Radii::Radii(const RadiusChoice& choice, std::int64_t particles, std::uint64_t seed) noexcept
  : choice_(choice)
  , particles_(particles)
  , seconds_(choice.kind == RadiusChoice::Kind::Two
        ? std::llround(choice.share * static_cast<double>(particles))
        : 0)
  , seed_(seed)
{
}

double Radii::radius(std::int64_t row) const noexcept
{
  return this->type(row) == 2 ? choice_.second : choice_.first;
}

std::int32_t Radii::type(std::int64_t row) const noexcept
{
  return seconds_ > 0 && this->dealt(row) < seconds_ ? 2 : 1;
}

std::vector<SizeClass> Radii::by_size() const
{
  std::vector<SizeClass> sizes = { { choice_.first, particles_ - seconds_, 1 },
    { choice_.second, seconds_, 2 } };
  std::erase_if(sizes, [](const SizeClass& each) { return each.particles == 0; });
  std::ranges::stable_sort(sizes, std::ranges::greater(), &SizeClass::radius);
  return sizes;
}

/// Returns the place of a particle when all are shuffled: a Feistel network permutes the numbers of an even number of bits;
/// a number that leads out of the particles is followed until it is back.
std::int64_t Radii::dealt(std::int64_t row) const noexcept
{
  const auto bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(particles_ - 1)));
  const int half_bits = std::max((bits + 1) / 2, 1);
  const std::uint64_t mask = (std::uint64_t{ 1 } << half_bits) - 1;
  auto number = static_cast<std::uint64_t>(row);
  do
  {
    std::uint64_t left = number >> half_bits;
    std::uint64_t right = number & mask;
    for (int round = 0; round < 4; ++round)
    {
      RandomNumbers numbers(seed_, Stream::Sizes, static_cast<std::int64_t>(right) * 4 + round);
      const std::uint64_t next = left ^ (numbers.bits() & mask);
      left = right;
      right = next;
    }
    number = left << half_bits | right;
  } while (number >= static_cast<std::uint64_t>(particles_));
  return static_cast<std::int64_t>(number);
}
}
