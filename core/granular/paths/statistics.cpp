// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/statistics.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"
#include "granular/sorting/sort_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>

namespace granular
{
namespace
{
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The bounds of the magnitudes of terms that are not 0.
struct Magnitudes
{
  std::array<double, SumScale::lanes> least;
  std::array<double, SumScale::lanes> greatest = {};
  std::int64_t terms = 0;

  Magnitudes() noexcept { least.fill(std::numeric_limits<double>::infinity()); }

  void include(const Magnitudes& other) noexcept
  {
    for (std::size_t i = 0; i < SumScale::lanes; ++i)
    {
      least[i] = std::min(least[i], other.least[i]);
      greatest[i] = std::max(greatest[i], other.greatest[i]);
    }
    terms += other.terms;
  }
};

Magnitudes measure(std::span<const SumScale::Terms> terms) noexcept
{
  Magnitudes found;
  for (const SumScale::Terms& one : terms)
  {
    for (std::size_t i = 0; i < SumScale::lanes; ++i)
    {
      const double size = std::abs(one[i]);
      found.greatest[i] = size > found.greatest[i] ? size : found.greatest[i];
      const double least = size > 0 ? size : found.least[i];
      found.least[i] = least < found.least[i] ? least : found.least[i];
    }
  }
  found.terms = static_cast<std::int64_t>(terms.size());
  return found;
}

constexpr std::size_t terms_per_stretch = std::size_t{ 1 } << 13;

SumScale::Range range_of(double least, double greatest)
{
  if (greatest == 0)
  {
    return { 1, 0 };
  }
  if (!(greatest < 0x1p900))
  {
    throw LimitError("expected numbers below 2^900 for sums, got " + to_text(greatest));
  }
  // no double has bits below 2^-1074
  return { std::ilogb(greatest) + 1, std::max(std::ilogb(least) - 52, -1074) };
}

/// Doubles in their order, but -0, as integers.
std::int64_t key_of(double number) noexcept
{
  const auto bits = std::bit_cast<std::int64_t>(number);
  return bits < 0 ? bits ^ std::numeric_limits<std::int64_t>::max() : bits;
}

double number_of(std::int64_t key) noexcept
{
  return std::bit_cast<double>(key < 0 ? key ^ std::numeric_limits<std::int64_t>::max() : key);
}

/// The place of a quantile among sorted numbers.
std::int64_t place_of(double quantile, std::int64_t count) noexcept
{
  const auto all = static_cast<double>(count);
  auto upto = static_cast<std::int64_t>(quantile * all);
  upto += static_cast<double>(upto) / all < quantile ? 1 : 0;
  return std::clamp<std::int64_t>(upto - 1, 0, count - 1);
}

/// The numbers that have these places, ascending, among those of all ranks.
std::vector<double> select(
  std::vector<double>& numbers, const std::vector<std::int64_t>& places, Communicator& ranks)
{
  std::vector<double> chosen;
  if (ranks.size() == 1)
  {
    auto begin = numbers.begin();
    for (const std::int64_t place : places)
    {
      const auto at = numbers.begin() + place;
      std::nth_element(begin, at, numbers.end()); // what is before is smaller
      chosen.push_back(*at);
      begin = at;
    }
    return chosen;
  }
  std::vector<std::int64_t> keys(numbers.size());
  std::ranges::transform(numbers, keys.begin(), key_of);
  std::sort(keys.begin(), keys.end());
  for (const std::int64_t key : find_ids_at(places, keys, ranks))
  {
    chosen.push_back(number_of(key));
  }
  return chosen;
}
}

std::vector<SumScale::Terms> terms_of(std::span<const double> numbers)
{
  std::vector<SumScale::Terms> terms((numbers.size() + SumScale::lanes - 1) / SumScale::lanes);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    terms[i / SumScale::lanes][i % SumScale::lanes] = numbers[i];
  }
  return terms;
}

SumScale make_scale(std::span<const SumScale::Terms> terms, std::size_t sums, Communicator& ranks,
  const Executor& executor)
{
  std::mutex mutex;
  Magnitudes own;
  Progress quiet; // a moment
  executor.for_each_stretch(
    terms.size(), terms_per_stretch,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      const Magnitudes found = measure(terms.subspan(first, count));
      const std::lock_guard lock(mutex);
      own.include(found);
    },
    quiet);
  Magnitudes all;
  for (const Magnitudes& each : gather(ranks, own))
  {
    all.include(each);
  }
  std::array<SumScale::Range, SumScale::lanes> ranges;
  for (std::size_t i = 0; i < SumScale::lanes; ++i)
  {
    const std::size_t sum = i % sums;
    all.least[sum] = std::min(all.least[sum], all.least[i]);
    all.greatest[sum] = std::max(all.greatest[sum], all.greatest[i]);
  }
  for (std::size_t i = 0; i < SumScale::lanes; ++i)
  {
    ranges[i] = range_of(all.least[i % sums], all.greatest[i % sums]);
  }
  return { ranges, all.terms * static_cast<std::int64_t>(SumScale::lanes / sums) };
}

SumScale::Terms sum_exactly(std::span<const SumScale::Terms> terms, std::size_t sums,
  Communicator& ranks, const Executor& executor)
{
  const SumScale scale = make_scale(terms, sums, ranks, executor);
  std::mutex mutex;
  std::vector<std::int64_t> parts(scale.size());
  const std::vector<std::int64_t> cells(std::min(terms_per_stretch, terms.size())); // all are one
  Progress quiet;
  executor.for_each_stretch(
    terms.size(), terms_per_stretch,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      std::vector<std::int64_t> own(scale.size());
      scale.add(terms.subspan(first, count), cells.data(), own.data());
      const std::lock_guard lock(mutex);
      std::ranges::transform(own, parts, parts.begin(), std::plus());
    },
    quiet);
  for (std::size_t level = 0; level < scale.size(); level += SumScale::lanes)
  {
    for (std::size_t i = sums; i < SumScale::lanes; ++i)
    {
      parts[level + i % sums] += parts[level + i];
      parts[level + i] = 0;
    }
  }
  ranks.sum(parts);
  return scale.values(parts.data());
}

Statistics find_statistics(
  std::vector<double> numbers, std::span<const double> quantiles, Communicator& ranks)
{
  std::erase_if(numbers, [](double number) { return !std::isfinite(number); });
  for (double& number : numbers)
  {
    number += 0.0; // of zeros of both signs any could be chosen
  }
  Statistics found;
  found.count = static_cast<std::int64_t>(numbers.size());
  ranks.sum({ &found.count, 1 });
  if (found.count == 0)
  {
    found.mean = found.least = found.greatest = nothing;
    found.quantiles.assign(quantiles.size(), nothing);
    return found;
  }
  found.mean = sum_exactly(terms_of(numbers), 1, ranks)[0] / static_cast<double>(found.count);

  std::vector<std::int64_t> places = { 0, found.count - 1 };
  for (const double quantile : quantiles)
  {
    places.push_back(place_of(quantile, found.count));
  }
  std::vector<std::int64_t> ascending = places;
  std::sort(ascending.begin(), ascending.end());
  const std::vector<double> chosen = select(numbers, ascending, ranks);
  const auto number_at = [&](std::int64_t place)
  {
    return chosen[static_cast<std::size_t>(
      std::lower_bound(ascending.begin(), ascending.end(), place) - ascending.begin())];
  };
  found.least = number_at(places[0]);
  found.greatest = number_at(places[1]);
  for (std::size_t i = 2; i < places.size(); ++i)
  {
    found.quantiles.push_back(number_at(places[i]));
  }
  return found;
}
}
