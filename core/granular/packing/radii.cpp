// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/radii.h"

#include "granular/base/error.h"
#include "granular/packing/random_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace granular
{
namespace
{
/// Regions of random grains are as large as their largest need.
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
  const double squares = first * first + second * second;
  const double mean_cubes[] = { cube(first), (1 - share) * cube(first) + share * cube(second),
    (first + second) * squares / 4 };
  return 4.0 / 3 * std::numbers::pi * mean_cubes[static_cast<std::size_t>(kind)];
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

Radii::Radii(const RadiusChoice& choice, std::int64_t grains, std::uint64_t seed) noexcept
  : choice_(choice)
  , grains_(grains)
  , seconds_(std::llround(choice.share * static_cast<double>(grains)))
  , seed_(seed)
  , half_bits_(1)
{
  while (half_bits_ < 31 && std::int64_t{ 1 } << 2 * half_bits_ < grains)
  {
    ++half_bits_;
  }
}

double Radii::radius(std::int64_t grain) const noexcept
{
  switch (choice_.kind)
  {
    case RadiusChoice::Kind::One:
      return choice_.first;
    case RadiusChoice::Kind::Two:
      return this->type(grain) == 2 ? choice_.second : choice_.first;
    case RadiusChoice::Kind::Range:
      break;
  }
  const double part =
    (static_cast<double>(this->dealt(grain)) + 0.5) / static_cast<double>(grains_);
  return choice_.first + part * (choice_.second - choice_.first);
}

std::int32_t Radii::type(std::int64_t grain) const noexcept
{
  return choice_.kind == RadiusChoice::Kind::Two && this->dealt(grain) < seconds_ ? 2 : 1;
}

/// Where the grain comes when all are shuffled: a Feistel network permutes the numbers of an even number
/// of bits; one that leads out of the grains is followed until it is back.
std::int64_t Radii::dealt(std::int64_t grain) const noexcept
{
  const std::uint64_t mask = (std::uint64_t{ 1 } << half_bits_) - 1;
  auto number = static_cast<std::uint64_t>(grain);
  do
  {
    std::uint64_t left = number >> half_bits_;
    std::uint64_t right = number & mask;
    for (int round = 0; round < 4; ++round)
    {
      RandomNumbers numbers(seed_, Stream::Sizes, static_cast<std::int64_t>(right) * 4 + round);
      const std::uint64_t next = left ^ (numbers.bits() & mask);
      left = right;
      right = next;
    }
    number = left << half_bits_ | right;
  } while (number >= static_cast<std::uint64_t>(grains_));
  return static_cast<std::int64_t>(number);
}
}
