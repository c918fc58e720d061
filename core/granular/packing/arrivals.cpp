// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/arrivals.h"

#include "granular/packing/random_numbers.h"

#include <algorithm>

namespace granular
{
namespace
{
constexpr double below_one = 1 - 0x1p-53;

/// The distribution function of Poisson's numbers. Sums, products and quotients alone: the same on all machines.
std::vector<double> poisson(double mean)
{
  std::vector<double> terms = { 1 };
  double sum = 1;
  while (static_cast<double>(terms.size()) < mean || terms.back() > 1e-20 * sum)
  {
    terms.push_back(terms.back() * mean / static_cast<double>(terms.size()));
    sum += terms.back();
  }
  double up_to = 0;
  for (double& term : terms)
  {
    up_to += term / sum;
    term = up_to;
  }
  return terms;
}

double part_of(std::int64_t whole, std::uint64_t bits, std::int64_t cells)
{
  return std::min(
    (static_cast<double>(whole) + unit_of(bits)) / static_cast<double>(cells), below_one);
}
}

Arrivals::Arrivals(
  const AdsorptionGrid& grid, std::size_t of_class, std::uint64_t seed, double on_a_line)
  : size_class(of_class)
  , level(grid.level_of(of_class))
  , cells(grid.cells(level))
  , radius(grid.classes()[of_class].radius)
  , mean(on_a_line)
  , counts_seed_(scramble(seed))
  , moments_seed_(scramble(counts_seed_))
  , up_to_(poisson(on_a_line))
{
}

std::uint64_t Arrivals::count(std::int64_t layer, std::int64_t line) const noexcept
{
  const double drawn = unit_of(scramble(counts_seed_ ^ this->number(layer, line)));
  const auto found = std::upper_bound(up_to_.begin(), up_to_.end() - 1, drawn);
  return static_cast<std::uint64_t>(found - up_to_.begin());
}

std::uint64_t Arrivals::moment(
  std::int64_t layer, std::int64_t line, std::uint64_t arrival) const noexcept
{
  // scrambling is one to one, and there are less than 1024 arrivals on a line
  return scramble(moments_seed_ ^ (this->number(layer, line) << 10 | arrival));
}

Vector3 Arrivals::place(std::int64_t layer, std::int64_t line, std::uint64_t moment) const noexcept
{
  return { unit_of(scramble(moment ^ 1)), part_of(line, scramble(moment ^ 2), cells[1]),
    part_of(layer, scramble(moment ^ 3), cells[2]) };
}
}
