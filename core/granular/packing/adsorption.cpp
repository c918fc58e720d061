// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/adsorption.h"

#include <algorithm>
#include <cmath>

namespace granular
{
namespace
{
double square_distance(const Vector3& a, const Vector3& b)
{
  const Vector3 way = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  return dot(way, way);
}

double square(double value)
{
  return value * value;
}
}

Adsorption::Adsorption(
  const AdsorptionGrid& grid, std::int64_t first, std::int64_t last, double margin)
  : grid_(grid)
  , first_(first)
  , last_(last)
  , levels_(grid.levels())
{
  const auto [low, high] = grid.window(first, last, margin);
  const bool periodic = grid.box().periodic[grid.axis(2)];
  for (std::size_t level = 0; first < last && level < levels_.size(); ++level)
  {
    const AdsorptionGrid::Cells& cells = grid.cells(level);
    const auto layers = static_cast<double>(cells[2]);
    double begin = std::floor(low * layers);
    double end = std::ceil(high * layers);
    if (!periodic)
    {
      begin = std::max(begin, 0.0);
      end = std::min(end, layers);
    }
    if (end - begin >= layers)
    {
      begin = 0;
      end = layers;
    }
    Level& made = levels_[level];
    made.begin = static_cast<std::int64_t>(begin < 0 ? begin + layers : begin);
    made.layers.resize(static_cast<std::size_t>(end - begin));
    for (Layer& layer : made.layers)
    {
      const auto count = static_cast<std::size_t>(cells[0] * cells[1]);
      layer.first.assign(count, none);
      layer.first_fresh.assign(count, none);
      layer.unknown.assign(count, 0);
    }
  }
}

const Adsorption::Layer* Adsorption::find(std::size_t level, std::int64_t layer) const noexcept
{
  const Level& on = levels_[level];
  const std::int64_t from_begin = layer - on.begin + (layer < on.begin ? grid_.cells(level)[2] : 0);
  const auto index = static_cast<std::size_t>(from_begin);
  return index < on.layers.size() ? &on.layers[index] : nullptr;
}

/// Calls visit(layer, cell, place) for the cells of a level that may have grains nearer than a distance, with the place as
/// it is seen from the cell, which may be one of a periodic image, until that returns true. The layer is null where
/// nothing is known.
template <class Visit>
bool Adsorption::any_near(std::size_t level, const Vector3& scaled, const Vector3& at,
  double distance, const Visit& visit) const
{
  const AdsorptionGrid::Cells& cells = grid_.cells(level);
  const AdsorptionGrid::Range across[] = { grid_.near(level, 0, scaled[0], distance),
    grid_.near(level, 1, scaled[1], distance), grid_.near(level, 2, scaled[2], distance) };
  const auto image = [&cells](std::size_t place, std::int64_t cell) -> std::int64_t
  {
    const std::int64_t all = cells[place];
    return cell >= 0 && cell < all ? 0 : cell >= 0 ? cell / all : -((all - 1 - cell) / all);
  };
  const auto moved = [this](Vector3 from, std::size_t place, std::int64_t images)
  {
    const Vector3& vector = grid_.box().vectors[grid_.axis(place)];
    for (std::size_t k = 0; images != 0 && k < 3; ++k)
    {
      from[k] -= static_cast<double>(images) * vector[k];
    }
    return from;
  };
  for (std::int64_t z = across[2].first; z <= across[2].last; ++z)
  {
    const std::int64_t of_z = image(2, z);
    const Layer* const layer = this->find(level, z - of_z * cells[2]);
    const Vector3 from_z = moved(at, 2, of_z);
    for (std::int64_t y = across[1].first; y <= across[1].last; ++y)
    {
      const std::int64_t of_y = image(1, y);
      const Vector3 from_y = moved(from_z, 1, of_y);
      const std::int64_t line = (y - of_y * cells[1]) * cells[0];
      for (std::int64_t x = across[0].first; x <= across[0].last; ++x)
      {
        const std::int64_t of_x = image(0, x);
        const auto cell = static_cast<std::size_t>(line + x - of_x * cells[0]);
        if (of_x == 0 ? visit(layer, cell, from_y) : visit(layer, cell, moved(from_y, 0, of_x)))
        {
          return true;
        }
      }
    }
  }
  return false;
}

/// Whether a grain of a cell is nearer to a place than this from its surface.
bool Adsorption::blocks(
  const Layer& layer, std::size_t cell, const Vector3& at, double clear) noexcept
{
  for (std::int32_t i = layer.first[cell]; i != none;)
  {
    const Grain& grain = layer.grains[static_cast<std::size_t>(i)];
    if (square_distance(grain.at, at) < square(clear + grain.radius))
    {
      return true;
    }
    i = grain.next;
  }
  return false;
}

/// Among those that stayed in earlier rounds. Tells the fresh one if it is near to what is unknown.
bool Adsorption::has_room(Fresh& fresh, const Arrivals& round, const Layer& layer) const
{
  const double clear = round.radius + grid_.gap();
  if (blocks(layer, static_cast<std::size_t>(fresh.cell), fresh.at, clear))
  {
    return false; // most of what is in the way is here
  }
  for (std::size_t level = round.level + 1; level-- > 0;)
  {
    if (this->any_near(level, fresh.scaled, fresh.at, clear + grid_.radius(level),
          [&](const Layer* near, std::size_t cell, const Vector3& from)
          {
            fresh.dim = fresh.dim || near == nullptr || near->unknown[cell] != 0;
            return near != nullptr && blocks(*near, cell, from, clear);
          }))
    {
      return false;
    }
  }
  return true;
}

void Adsorption::arrive(
  const Arrivals& round, std::int64_t layer, std::int64_t line, Layer& to) const
{
  const std::uint64_t count = round.count(layer, line);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    Fresh fresh = {};
    fresh.moment = round.moment(layer, line, i);
    if (fresh.moment > round.last)
    {
      continue;
    }
    const Vector3 parts = round.place(layer, line, fresh.moment);
    Vector3 scaled = {};
    for (std::size_t place = 0; place < 3; ++place)
    {
      fresh.scaled[place] = grid_.scaled(round.size_class, place, parts[place]);
      scaled[grid_.axis(place)] = fresh.scaled[place];
    }
    fresh.at = grid_.box().edge(scaled);
    const auto along = static_cast<std::int64_t>(parts[0] * static_cast<double>(round.cells[0]));
    fresh.cell =
      static_cast<std::int32_t>(line * round.cells[0] + std::min(along, round.cells[0] - 1));
    if (this->has_room(fresh, round, to))
    {
      std::int32_t& first = to.first_fresh[static_cast<std::size_t>(fresh.cell)];
      fresh.next = first;
      first = static_cast<std::int32_t>(to.fresh.size());
      to.fresh.push_back(fresh);
    }
  }
}

/// Whether a fresh one stays: none does that overlaps an earlier one that stays. Threads may find the same at a time.
Adsorption::Fate Adsorption::fate(
  const Arrivals& round, const Layer& layer, std::size_t index) const
{
  const auto known = static_cast<Fate>(layer.fates[index].load(std::memory_order_relaxed));
  if (known != Open)
  {
    return known;
  }
  const Fresh& own = layer.fresh[index];
  const double clear = 2 * round.radius + grid_.gap();
  Fate found = own.dim ? Unknown : Stays;
  this->any_near(round.level, own.scaled, own.at, clear,
    [&](const Layer* near, std::size_t cell, const Vector3& from)
    {
      for (std::int32_t i = near == nullptr ? none : near->first_fresh[cell]; i != none;)
      {
        const auto at = static_cast<std::size_t>(i);
        const Fresh& other = near->fresh[at];
        i = other.next;
        if (other.moment < own.moment && square_distance(other.at, from) < square(clear))
        {
          const Fate before = this->fate(round, *near, at);
          if (before == Stays)
          {
            found = Leaves;
            return true;
          }
          found = before == Unknown ? Unknown : found;
        }
      }
      return false;
    });
  layer.fates[index].store(found, std::memory_order_relaxed);
  return found;
}

void Adsorption::settle(const Arrivals& round, Layer& layer) const
{
  for (std::size_t i = 0; i < layer.fresh.size(); ++i)
  {
    if (this->fate(round, layer, i) == Unknown)
    {
      layer.dim = true;
    }
  }
}

/// Those that stay become grains.
void Adsorption::keep(const Arrivals& round, Layer& layer) const
{
  for (std::size_t i = 0; i < layer.fresh.size(); ++i)
  {
    const Fresh& fresh = layer.fresh[i];
    const auto cell = static_cast<std::size_t>(fresh.cell);
    layer.first_fresh[cell] = none;
    if (fresh.moment > round.last)
    {
      continue;
    }
    const auto found = static_cast<Fate>(layer.fates[i].load(std::memory_order_relaxed));
    if (found == Stays)
    {
      layer.grains.push_back(
        { fresh.at, round.radius, static_cast<std::int32_t>(round.size_class), layer.first[cell] });
      layer.first[cell] = static_cast<std::int32_t>(layer.grains.size() - 1);
    }
    if (found == Unknown)
    {
      layer.unknown[cell] = 1;
    }
  }
  layer.fresh.clear();
}

/// Calls work(layer) for the number of each layer of a round that is here; several at a time.
template <class Work>
void Adsorption::for_layers(
  const Arrivals& round, const Executor& executor, Progress& progress, const Work& work)
{
  constexpr double arrivals_a_chunk = 4096;
  const std::size_t layers = levels_[round.level].layers.size();
  const double arrivals = round.mean * static_cast<double>(round.cells[1]);
  const double wanted = std::ceil(arrivals_a_chunk / arrivals);
  const std::size_t each = wanted < static_cast<double>(layers) ? static_cast<std::size_t>(wanted)
                                                                : std::max<std::size_t>(layers, 1);
  executor.parallel_for((layers + each - 1) / each,
    [&](std::size_t chunk, std::size_t)
    {
      for (std::size_t i = chunk * each; i < std::min(layers, (chunk + 1) * each); ++i)
      {
        work(i);
      }
    },
    progress);
}

bool Adsorption::follow(
  const std::vector<Arrivals>& rounds, const Executor& executor, Progress& progress)
{
  Progress none_told;
  while (rounds_ < rounds.size())
  {
    this->finish(rounds, executor);
    const Arrivals& round = rounds[rounds_++];
    Level& level = levels_[round.level];
    this->for_layers(round, executor, progress,
      [&](std::size_t i)
      {
        const std::int64_t layer = (level.begin + static_cast<std::int64_t>(i)) % round.cells[2];
        for (std::int64_t line = 0; line < round.cells[1]; ++line)
        {
          this->arrive(round, layer, line, level.layers[i]);
        }
        level.layers[i].fates =
          std::vector<std::atomic<std::uint8_t>>(level.layers[i].fresh.size());
      });
    this->for_layers(
      round, executor, none_told, [&](std::size_t i) { this->settle(round, level.layers[i]); });
    settled_ = false;
    if (!this->has(first_, last_))
    {
      return false;
    }
  }
  return true;
}

std::vector<std::uint64_t> Adsorption::moments() const
{
  std::vector<std::uint64_t> found;
  grid_.for_layers(first_, last_,
    [&](std::size_t level, std::int64_t at)
    {
      const Layer& layer = *this->find(level, at);
      for (std::size_t i = 0; i < layer.fresh.size(); ++i)
      {
        if (layer.fates[i].load(std::memory_order_relaxed) == Stays)
        {
          found.push_back(layer.fresh[i].moment);
        }
      }
    });
  return found;
}

void Adsorption::finish(const std::vector<Arrivals>& rounds, const Executor& executor)
{
  if (settled_)
  {
    return;
  }
  const Arrivals& last = rounds[rounds_ - 1];
  Progress none_told;
  Level& level = levels_[last.level];
  this->for_layers(
    last, executor, none_told, [&](std::size_t i) { this->keep(last, level.layers[i]); });
  settled_ = true;
}

bool Adsorption::has(std::int64_t first, std::int64_t last) const noexcept
{
  bool known = true;
  grid_.for_layers(first, last,
    [&](std::size_t level, std::int64_t at)
    {
      const Layer* const layer = this->find(level, at);
      known = known && layer != nullptr && !layer->dim;
    });
  return known;
}
}
