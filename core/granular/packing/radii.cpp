// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/radii.h"

#include "granular/common/error.h"
#include "granular/packing/random_numbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace granular
{
namespace
{
/// Largest first, small grains find no place any more between much larger ones.
constexpr double largest_ratio = 20;

constexpr double class_ratio = 1.05;

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
{
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
  return this->part(this->dealt(grain, grains_));
}

std::int32_t Radii::type(std::int64_t grain) const noexcept
{
  return choice_.kind == RadiusChoice::Kind::Two && this->dealt(grain, grains_) < seconds_ ? 2 : 1;
}

/// The middle of one of as many equal parts of the range as there are grains.
double Radii::part(std::int64_t number) const noexcept
{
  const double part = (static_cast<double>(number) + 0.5) / static_cast<double>(grains_);
  return choice_.first + part * (choice_.second - choice_.first);
}

/// The same, the largest first.
double Radii::by_size(std::int64_t number) const noexcept
{
  return this->part(choice_.first < choice_.second ? grains_ - 1 - number : number);
}

std::vector<SizeClass> Radii::classes() const
{
  std::vector<SizeClass> found;
  switch (choice_.kind)
  {
    case RadiusChoice::Kind::One:
      found = { { choice_.first, grains_, 1 } };
      break;
    case RadiusChoice::Kind::Two:
      found = { { choice_.first, grains_ - seconds_, 1 }, { choice_.second, seconds_, 2 } };
      if (choice_.first < choice_.second)
      {
        std::swap(found[0], found[1]);
      }
      break;
    case RadiusChoice::Kind::Range:
      for (std::int64_t first = 0; first < grains_;)
      {
        const double radius = this->by_size(first);
        std::int64_t low = first; // in the class
        std::int64_t high = grains_;
        while (high - low > 1)
        {
          const std::int64_t middle = low + (high - low) / 2;
          (this->by_size(middle) * class_ratio >= radius ? low : high) = middle;
        }
        found.push_back({ radius, high - first, 1 });
        first = high;
      }
      break;
  }
  std::erase_if(found, [](const SizeClass& each) { return each.grains == 0; });
  for (std::size_t i = 1; i < found.size(); ++i)
  {
    found[i].first = found[i - 1].first + found[i - 1].grains;
  }
  return found;
}

double Radii::radius(const SizeClass& size_class, std::int64_t grain) const noexcept
{
  return choice_.kind == RadiusChoice::Kind::Range
    ? this->by_size(size_class.first + this->dealt(grain, size_class.grains))
    : size_class.radius;
}

/// Where one of some grains comes when all are shuffled: a Feistel network permutes the numbers of an even number
/// of bits; one that leads out of the grains is followed until it is back.
std::int64_t Radii::dealt(std::int64_t grain, std::int64_t grains) const noexcept
{
  const auto bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(grains - 1)));
  const int half_bits = std::max((bits + 1) / 2, 1);
  const std::uint64_t mask = (std::uint64_t{ 1 } << half_bits) - 1;
  auto number = static_cast<std::uint64_t>(grain);
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
  } while (number >= static_cast<std::uint64_t>(grains));
  return static_cast<std::int64_t>(number);
}
}
