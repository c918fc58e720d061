// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/random_grains.h"

#include "granular/base/error.h"
#include "granular/base/executor.h"
#include "granular/packing/neighbours.h"
#include "granular/packing/random_numbers.h"
#include "granular/packing/region_store.h"
#include "granular/packing/regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace granular
{
namespace
{
/// What a grain may take to find a place; then the region is begun again, with other numbers, as long as it
/// has not taken what a region may.
constexpr std::int64_t most_tries = 100'000;
constexpr std::int64_t region_tries = 500'000;
constexpr std::int64_t region_tries_a_grain = 1'000;

/// And what it may take in the layer it was dealt, before it looks in all of its region.
constexpr std::int64_t layer_tries = 100;

/// Regions that a thread fills at a time.
constexpr std::size_t chunk_regions = 16;

/// Puts the grains of one region after the other to their places.
class Filler
{
public:
  Filler(const RandomGrains& all, const Regions& regions, RegionStore& store)
    : all_(all)
    , regions_(regions)
    , store_(store)
    , gap_(all.box.rounding())
  {
  }

  void fill(std::int64_t index);

private:
  std::size_t fill(const Regions::Region& region, const GrainRows& grains, RandomNumbers& numbers);
  void start(const Regions::Region& region, const GrainRows& grains);
  void sort_by_size(const GrainRows& grains);
  bool find_place(
    const Regions::Region& region, RandomNumbers& numbers, double radius, Vector3& place);
  Regions::Bounds inside(double radius) const noexcept;
  void add_images(const Vector3& place, double radius);
  [[noreturn]] void give_up(const GrainRows& grains, std::size_t placed) const;

  const RandomGrains& all_;
  const Regions& regions_;
  RegionStore& store_;
  double gap_;
  std::int64_t tries_left_ = 0; ///< of the region
  Regions::Bounds bounds_ = {};
  Neighbours neighbours_;
  std::vector<std::int64_t> order_;
};

void Filler::fill(std::int64_t index)
{
  const GrainRows grains = store_.grains(index);
  if (grains.count() == 0)
  {
    return;
  }
  const Regions::Region region = regions_.region(index);
  this->sort_by_size(grains);
  RandomNumbers numbers(all_.seed, Stream::Places, index);
  std::size_t most = 0;
  tries_left_ = region_tries + region_tries_a_grain * grains.count();
  while (tries_left_ > 0)
  {
    this->start(region, grains);
    const std::size_t placed = this->fill(region, grains, numbers);
    if (placed == order_.size())
    {
      return;
    }
    most = std::max(most, placed);
  }
  this->give_up(grains, most);
}

/// Gives how many found a place, before one that did not.
std::size_t Filler::fill(
  const Regions::Region& region, const GrainRows& grains, RandomNumbers& numbers)
{
  for (std::size_t placed = 0; placed < order_.size(); ++placed)
  {
    const std::int64_t i = order_[placed];
    Vector3 place = {};
    if (!this->find_place(region, numbers, grains.radius[i], place))
    {
      return placed;
    }
    std::copy(place.begin(), place.end(), grains.scaled + 3 * i);
    this->add_images(place, grains.radius[i]);
  }
  return order_.size();
}

/// Readies the neighbours: those within two radii of the region.
void Filler::start(const Regions::Region& region, const GrainRows& grains)
{
  const RadiusChoice& choice = all_.radii.choice();
  bounds_ = regions_.bounds(region);
  Regions::Bounds around = bounds_;
  double inner = 1;
  double outer = 1;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double reach = (2 * choice.largest() + gap_) / all_.box.heights[k];
    around.low[k] -= reach;
    around.high[k] += reach;
    inner *= bounds_.high[k] - bounds_.low[k];
    outer *= around.high[k] - around.low[k];
  }
  neighbours_.start(all_.box, around.low, around.high, choice.smallest(), choice.largest(), gap_,
    static_cast<double>(grains.count()) * (outer / inner));
  regions_.visit_rim(region,
    [this](std::int64_t rim, const Vector3& shift)
    {
      const GrainRows others = store_.grains(rim);
      for (std::int64_t i = 0; i < others.count(); ++i)
      {
        const double* const at = others.scaled + 3 * i;
        const Vector3 place = { at[0] + shift[0], at[1] + shift[1], at[2] + shift[2] };
        if (neighbours_.holds(place))
        {
          neighbours_.add(place, others.radius[i]);
        }
      }
    });
}

/// Large ones first: small ones still find a place between them.
void Filler::sort_by_size(const GrainRows& grains)
{
  order_.resize(static_cast<std::size_t>(grains.count()));
  std::iota(order_.begin(), order_.end(), 0);
  for (const std::int64_t i : order_)
  {
    grains.radius[i] = all_.radii.radius(grains.first + i);
  }
  if (all_.radii.choice().kind != RadiusChoice::Kind::One)
  {
    std::stable_sort(order_.begin(), order_.end(),
      [&grains](std::int64_t a, std::int64_t b) { return grains.radius[a] > grains.radius[b]; });
  }
}

bool Filler::find_place(
  const Regions::Region& region, RandomNumbers& numbers, double radius, Vector3& place)
{
  const Regions::Bounds whole = this->inside(radius);
  Regions::Bounds bounds = whole;
  int layer = Regions::outside;
  for (std::int64_t tries = 0; tries < most_tries && tries_left_ > 0; ++tries, --tries_left_)
  {
    if (tries == layer_tries)
    {
      bounds = whole;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      place[k] = bounds.low[k] + numbers.unit() * (bounds.high[k] - bounds.low[k]);
    }
    const int here = regions_.layer(region, place);
    if (here == Regions::outside ||
      (layer != Regions::outside && here != layer && tries < layer_tries))
    {
      continue;
    }
    if (neighbours_.has_room(place, radius))
    {
      return true;
    }
    if (layer == Regions::outside)
    {
      layer = here;
      regions_.narrow(region, place, bounds);
    }
  }
  return false;
}

/// The bounds of the region, away from faces that are not periodic.
Regions::Bounds Filler::inside(double radius) const noexcept
{
  Regions::Bounds bounds = bounds_;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (!all_.box.periodic[k])
    {
      const double least = std::min((radius + gap_) / all_.box.heights[k], 0.5);
      bounds.low[k] = std::max(bounds.low[k], least);
      bounds.high[k] = std::min(bounds.high[k], 1 - least);
    }
  }
  return bounds;
}

/// A grain, and its periodic images along the axes that are one block.
void Filler::add_images(const Vector3& place, double radius)
{
  const auto along = [this](std::size_t axis) { return regions_.wraps(axis) ? 1 : 0; };
  for (int z = -along(2); z <= along(2); ++z)
  {
    for (int y = -along(1); y <= along(1); ++y)
    {
      for (int x = -along(0); x <= along(0); ++x)
      {
        const Vector3 image = { place[0] + x, place[1] + y, place[2] + z };
        if (neighbours_.holds(image))
        {
          neighbours_.add(image, radius);
        }
      }
    }
  }
}

void Filler::give_up(const GrainRows& grains, std::size_t placed) const
{
  const double part = static_cast<double>(placed) / static_cast<double>(grains.count());
  const double volume = all_.radii.choice().mean_volume();
  const double asked = static_cast<double>(all_.grains) * volume / all_.box.volume;
  throw LimitError("no place was found for a random grain of radius " +
    std::to_string(grains.radius[order_[placed]]) + " when " + std::to_string(placed) + " of " +
    std::to_string(grains.count()) +
    " of its part of the box had theirs: expected a solid fraction " +
    "of at most about 0.3, and less where walls are near, got " + std::to_string(asked) +
    ", of which " + std::to_string(part * asked) + " was reached");
}

/// Regions of one kind, several at a time.
void fill_all(std::vector<Filler>& fillers, const std::vector<std::int64_t>& regions,
  const Executor& executor, Progress& progress)
{
  const std::size_t chunks = (regions.size() + chunk_regions - 1) / chunk_regions;
  executor.parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t worker)
    {
      const std::size_t end = std::min(regions.size(), (chunk + 1) * chunk_regions);
      for (std::size_t i = chunk * chunk_regions; i < end; ++i)
      {
        fillers[worker].fill(regions[i]);
      }
    },
    progress);
}

/// Back into the box, what lies beyond a periodic face.
void wrap(const BoxShape& box, const GrainRows& rows)
{
  for (std::int64_t i = 0; i < 3 * rows.count(); ++i)
  {
    double& place = rows.scaled[i];
    if (box.periodic[static_cast<std::size_t>(i % 3)])
    {
      place -= std::floor(place);
      place = place < 1 ? place : 0;
    }
  }
}

Regions regions_of(const RandomGrains& all)
{
  constexpr double slack = 1 + 1e-9; // for the rounding of scaled coordinates
  const RadiusChoice& choice = all.radii.choice();
  const double radius = (choice.largest() + all.box.rounding()) * slack;
  const double inset = (choice.smallest() + choice.largest()) / 2;
  return { all.box, radius, inset, all.grains };
}
}

void place(const RandomGrains& all, const GrainRows& rows, int threads, Progress& progress)
{
  const Regions regions = regions_of(all);
  RegionStore store(regions, rows);
  const Executor executor(threads);
  std::vector<Filler> fillers(
    static_cast<std::size_t>(executor.threads()), Filler(all, regions, store));
  PartialProgress part(progress);
  const double ends[] = { 0.95, 0.4, 0.2, 0.1 };
  double done = 0;
  for (const int planes : { 3, 2, 1, 0 })
  {
    part.set_part(done, ends[planes]);
    fill_all(fillers, store.with_planes(planes), executor, part);
    done = ends[planes];
  }
  store.finish();
  wrap(all.box, rows);
  progress.step(1);
}

std::vector<RowRange> rows_near(const RandomGrains& all, const RowRange& rows)
{
  return regions_of(all).rows_near(rows);
}
}
