// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/random_grains.h"

#include "granular/common/error.h"
#include "granular/common/shares.h"
#include "granular/packing/random_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace granular
{
namespace
{
/// How many arrivals there may be for each grain; for few grains more, in several attempts: each ends when so many
/// found no place in a row.
constexpr double tries_a_grain = 1'000;
constexpr double tries_at_least = 500'000;
constexpr double idle_tries = 20'000;

/// The n-th least of the values of all ranks, n from 1 on: byte by byte. Collective.
std::uint64_t nth_least(
  const std::vector<std::uint64_t>& values, std::int64_t n, Communicator& ranks)
{
  std::uint64_t found = 0;
  for (int shift = 56; shift >= 0; shift -= 8)
  {
    std::array<std::int64_t, 256> counts = {};
    for (const std::uint64_t value : values)
    {
      if (shift == 56 || (value ^ found) >> shift >> 8 == 0)
      {
        ++counts[value >> shift & 255];
      }
    }
    ranks.sum(counts);
    std::uint64_t byte = 0;
    for (; counts[byte] < n; ++byte)
    {
      n -= counts[byte];
    }
    found |= byte << shift;
    if (counts[byte] == 1) // the rank that has it tells the rest of it
    {
      std::array<std::int64_t, 1> one = {};
      for (const std::uint64_t value : values)
      {
        one[0] += (value ^ found) >> shift == 0 ? std::bit_cast<std::int64_t>(value) : 0;
      }
      ranks.sum(one);
      return std::bit_cast<std::uint64_t>(one[0]);
    }
  }
  return found;
}
}

RandomGrains::RandomGrains(const BoxShape& box, const Radii& radii, std::uint64_t seed,
  Communicator& ranks, int threads, Progress& progress)
  : radii_(radii)
  , grid_(box, radii.classes())
  , seed_(seed)
{
  own_.shelves = { begin_of_part(grid_.shelves(), ranks.rank(), ranks.size()),
    begin_of_part(grid_.shelves(), ranks.rank() + 1, ranks.size()) };
  const SizeClass& last = grid_.classes().back();
  const auto grains = static_cast<double>(last.first + last.grains);
  const Executor executor(threads);
  double tries = tries_at_least + tries_a_grain * grains; // that are left, in all attempts
  while (!this->adsorb_all(ranks, tries, executor, progress))
  {
    if (tries <= 0)
    {
      this->give_up();
    }
  }
  this->count(ranks);
}

/// One attempt. Gives false where no place is found any more.
bool RandomGrains::adsorb_all(
  Communicator& ranks, double& tries, const Executor& executor, Progress& progress)
{
  rounds_.clear();
  own_.found.reset();
  PartialProgress part(progress);
  for (std::size_t i = 0; i < grid_.classes().size(); ++i)
  {
    if (!this->adsorb(i, ranks, tries, executor, part))
    {
      return false;
    }
  }
  own_.found->finish(rounds_, executor);
  return true;
}

/// All grains of a class.
bool RandomGrains::adsorb(std::size_t size_class, Communicator& ranks, double& tries,
  const Executor& executor, PartialProgress& progress)
{
  const std::vector<SizeClass>& classes = grid_.classes();
  const AdsorptionGrid::Cells& cells = grid_.cells(grid_.level_of(size_class));
  const auto lines = static_cast<double>(cells[1] * cells[2]);
  const auto all = static_cast<double>(classes.back().first + classes.back().grains);
  std::int64_t missing = classes[size_class].grains;
  double staying = 1; // of those that arrive
  double idle = 0;    // tries since the last grain that stayed
  while (missing > 0)
  {
    const std::int64_t placed = classes[size_class].first + classes[size_class].grains - missing;
    most_ = std::max(most_, placed);
    if (tries <= 0 || idle > idle_tries)
    {
      return false;
    }
    const double done = static_cast<double>(placed) / all;
    progress.set_part(done, done);
    const double mean = this->arrivals_on_a_line(size_class, missing, staying);
    const std::uint64_t seed = RandomNumbers(seed_, Stream::Places, rounds_begun_++).bits();
    rounds_.emplace_back(grid_, size_class, seed, mean);
    this->follow(own_, executor, progress);
    const std::vector<std::uint64_t> moments = own_.found->moments();
    std::array<std::int64_t, 1> stayed = { static_cast<std::int64_t>(moments.size()) };
    ranks.sum(stayed);
    if (stayed[0] > missing)
    {
      rounds_.back().last = nth_least(moments, missing, ranks);
      stayed[0] = missing;
    }
    missing -= stayed[0];
    tries -= mean * lines;
    idle = stayed[0] > 0 ? 0 : idle + mean * lines;
    staying = std::max(static_cast<double>(stayed[0]), 0.5) / (mean * lines);
  }
  return true;
}

/// So many that all missing grains are likely to be among them; but at most one in two cells that stays, for short
/// chains of those that wait for each other.
double RandomGrains::arrivals_on_a_line(
  std::size_t size_class, std::int64_t missing, double staying) const noexcept
{
  constexpr double most = 512; // of Poisson's numbers 1024 are then out of reach
  const AdsorptionGrid::Cells& cells = grid_.cells(grid_.level_of(size_class));
  const auto grains = static_cast<double>(missing);
  const double enough =
    (grains + 4 * std::sqrt(grains) + 4) / static_cast<double>(cells[1] * cells[2]);
  return std::min(std::min(enough, 0.5 * static_cast<double>(cells[0])) / staying, most);
}

/// Lets arrive what has not yet, with as wide a margin as it needs.
void RandomGrains::follow(Part& part, const Executor& executor, Progress& progress) const
{
  while (!part.found || !part.found->follow(rounds_, executor, progress))
  {
    part.margin *= part.found ? 2 : 1;
    part.found =
      std::make_unique<Adsorption>(grid_, part.shelves.first, part.shelves.last, part.margin);
  }
}

/// How many grains of each class are before each shelf.
void RandomGrains::count(Communicator& ranks)
{
  const std::size_t classes = grid_.classes().size();
  const auto shelves = static_cast<std::size_t>(grid_.shelves());
  counts_.assign((shelves + 1) * classes, 0);
  rows_.assign(shelves + 1, 0);
  for (std::int64_t shelf = own_.shelves.first; shelf < own_.shelves.last; ++shelf)
  {
    std::int64_t* const counts = &counts_[(static_cast<std::size_t>(shelf) + 1) * classes];
    grid_.for_layers(shelf, shelf + 1,
      [&](std::size_t level, std::int64_t layer)
      {
        for (const Adsorption::Grain& grain : own_.found->grains(level, layer))
        {
          ++counts[grain.size_class];
        }
      });
  }
  ranks.sum(counts_);
  for (std::size_t shelf = 1; shelf <= shelves; ++shelf)
  {
    for (std::size_t i = 0; i < classes; ++i)
    {
      counts_[shelf * classes + i] += counts_[(shelf - 1) * classes + i];
      rows_[shelf] += counts_[shelf * classes + i];
    }
  }
}

void RandomGrains::give_up() const
{
  const std::vector<SizeClass>& classes = grid_.classes();
  const std::int64_t grains = classes.back().first + classes.back().grains;
  const double asked =
    static_cast<double>(grains) * radii_.choice().mean_volume() / grid_.box().volume;
  double all = 0;
  double reached = 0;
  double radius = 0;
  for (const SizeClass& each : classes)
  {
    const double volume = each.radius * each.radius * each.radius;
    const std::int64_t placed = std::clamp<std::int64_t>(most_ - each.first, 0, each.grains);
    all += volume * static_cast<double>(each.grains);
    reached += volume * static_cast<double>(placed);
    radius = each.first <= most_ ? each.radius : radius;
  }
  throw LimitError("no place was found for a random grain of radius " + std::to_string(radius) +
    " when " + std::to_string(most_) + " of " + std::to_string(grains) +
    " had theirs: expected a solid fraction of at most about 0.3, and less where walls are near, "
    "got " +
    std::to_string(asked) + ", of which " + std::to_string(asked * reached / all) + " was reached");
}

std::int64_t RandomGrains::shelf_of(std::int64_t row) const noexcept
{
  return std::upper_bound(rows_.begin(), rows_.end(), row) - rows_.begin() - 1;
}

void RandomGrains::place(const GrainRows& rows, int threads, Progress& progress) const
{
  if (rows.count() == 0)
  {
    return;
  }
  const Executor executor(threads);
  Part made = { { this->shelf_of(rows.first), this->shelf_of(rows.last - 1) + 1 }, least_margin,
    {} };
  const Adsorption* found = own_.found.get();
  if (!found->has(made.shelves.first, made.shelves.last))
  {
    this->follow(made, executor, progress);
    made.found->finish(rounds_, executor);
    found = made.found.get();
  }
  executor.parallel_for(
    static_cast<std::size_t>(made.shelves.count()),
    [&](std::size_t i, std::size_t)
    { this->place(*found, made.shelves.first + static_cast<std::int64_t>(i), rows); },
    progress);
}

/// Those of the rows that are in a shelf.
void RandomGrains::place(const Adsorption& found, std::int64_t shelf, const GrainRows& rows) const
{
  const std::vector<SizeClass>& classes = grid_.classes();
  const Vector3& origin = grid_.box().origin;
  const auto before =
    counts_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(shelf) * classes.size());
  std::vector<std::int64_t> counts(before, before + static_cast<std::ptrdiff_t>(classes.size()));
  std::int64_t row = rows_[static_cast<std::size_t>(shelf)] - rows.first;
  grid_.for_layers(shelf, shelf + 1,
    [&](std::size_t level, std::int64_t layer)
    {
      for (const Adsorption::Grain& grain : found.grains(level, layer))
      {
        const auto i = static_cast<std::size_t>(grain.size_class);
        const std::int64_t number = counts[i]++;
        if (row >= 0 && row < rows.count())
        {
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            rows.points[3 * row + static_cast<std::int64_t>(axis)] = origin[axis] + grain.at[axis];
          }
          rows.radius[row] = radii_.radius(classes[i], number);
          rows.type[row] = classes[i].type;
        }
        ++row;
      }
    });
}

std::vector<RowRange> RandomGrains::rows_near(const RowRange& rows, double distance) const
{
  const std::int64_t shelves = grid_.shelves();
  const std::int64_t low = this->shelf_of(rows.first);
  const std::int64_t high = this->shelf_of(rows.last - 1);
  const std::int64_t reach = grid_.shelves_within(distance);
  const std::int64_t end = std::min(high + reach + 1, shelves);
  const bool periodic = grid_.box().periodic[grid_.axis(2)];
  const std::int64_t top = std::clamp(periodic ? low + shelves - reach : shelves, end, shelves);
  const auto row = [this](std::int64_t shelf) { return rows_[static_cast<std::size_t>(shelf)]; };
  return { { rows.last, row(end) }, { row(top), row(shelves) } };
}
}
