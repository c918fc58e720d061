// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/square_displacements.h"

#include "granular/particles/point_forms.h"
#include "granular/paths/exchange_frames.h"
#include "granular/paths/statistics.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t particles_per_chunk = std::size_t{ 1 } << 15;
constexpr std::size_t sums = 4; ///< of squares of x, y, z and of the length

std::size_t chunks_of(std::size_t rows) noexcept
{
  return (rows + particles_per_chunk - 1) / particles_per_chunk;
}

/// Of each sum, the terms that are not finite, which are left out of it.
using Odd = std::array<std::int64_t, sums>;

/// Terms for two particles side by side.
std::vector<SumScale::Terms> square(const std::vector<Vector3>& displacements, Odd& odd)
{
  std::vector<SumScale::Terms> terms((displacements.size() + 1) / 2);
  for (std::size_t i = 0; i < displacements.size(); ++i)
  {
    double* const to = terms[i / 2].data() + sums * (i % 2);
    CompensatedSum length;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double part = displacements[i][axis];
      to[axis] = part * part;
      length.add_product(part, part);
    }
    to[3] = length.value();
    for (std::size_t sum = 0; sum < sums; ++sum)
    {
      odd[sum] += std::isfinite(to[sum]) ? 0 : 1;
      to[sum] = std::isfinite(to[sum]) ? to[sum] : 0;
    }
  }
  return terms;
}
}

/// Finds the particles among those of the first frame.
std::vector<std::int64_t> SquareDisplacements::find_places(
  const PathFrame& frame, const NameRows& name_rows, Progress& progress)
{
  const std::size_t rows = frame.ids.size();
  std::vector<std::int64_t> places(rows);
  executor_.parallel_for(
    chunks_of(rows),
    [&](std::size_t chunk, std::size_t)
    {
      const std::size_t begin = chunk * particles_per_chunk;
      const std::size_t count = std::min(particles_per_chunk, rows - begin);
      finder_.find(std::span(frame.ids).subspan(begin, count), places.data() + begin);
    },
    progress);
  std::vector<std::int64_t> seen(states_.size(), -1);
  IdTable others; // that the first frame does not have
  for (std::size_t i = 0; i < rows; ++i)
  {
    const auto row = static_cast<std::int64_t>(i);
    const bool known = places[i] != IdFinder::nowhere;
    std::int64_t before = -1;
    if (known)
    {
      before = std::exchange(seen[static_cast<std::size_t>(places[i])], row);
    }
    else if (!others.add(frame.ids[i], row))
    {
      before = others.find(frame.ids[i]);
    }
    if (before >= 0)
    {
      if (name_rows)
      {
        name_rows(frame.ids[i]);
      }
      const auto row_of = [&](std::size_t at) { return frame.has_rows ? frame.rows[at] : -1; };
      throw_repeated(
        frame.ids[i], frame.header.timestep, row_of(static_cast<std::size_t>(before)), row_of(i));
    }
  }
  return places;
}

/// The displacements of all particles; zero of those that are not in the first frame.
std::vector<Vector3> SquareDisplacements::find_displacements(
  const PathFrame& frame, const std::vector<std::int64_t>& places, Progress& progress)
{
  const bool first = unwrapper_.frames() == 1;
  const std::size_t rows = frame.ids.size();
  std::vector<Vector3> found(rows);
  const PositionPlan plan = plan_form(Coordinates::Absolute, ColumnRole::UnwrappedPosition);
  std::atomic<std::int64_t> long_steps = 0;
  executor_.parallel_for(
    chunks_of(rows),
    [&](std::size_t chunk, std::size_t)
    {
      const std::size_t begin = chunk * particles_per_chunk;
      const std::size_t count = std::min(particles_per_chunk, rows - begin);
      const std::span<const std::int64_t> at(places.data() + begin, count);
      std::vector<double> points(3 * count);
      std::vector<double> counts(3 * count);
      std::int64_t long_here = 0;
      for (std::size_t i = 0; i < count; ++i)
      {
        if (at[i] != IdFinder::nowhere)
        {
          PathState& state = states_[static_cast<std::size_t>(at[i])];
          long_here += unwrapper_.advance(state, frame, begin + i).is_long ? 1 : 0;
          std::copy_n(state.point.begin(), 3, points.data() + 3 * i);
          std::copy_n(state.counts.begin(), 3, counts.data() + 3 * i);
        }
      }
      long_steps += long_here;
      convert_positions(plan, frame.header.box, {}, counts, points);
      for (std::size_t i = 0; i < count; ++i)
      {
        if (at[i] != IdFinder::nowhere)
        {
          Vector3& start = firsts_[static_cast<std::size_t>(at[i])];
          const Vector3& drift = states_[static_cast<std::size_t>(at[i])].drift;
          const double* const point = points.data() + 3 * i;
          const Vector3 place = { point[0] + drift[0], point[1] + drift[1], point[2] + drift[2] };
          start = first ? place : start;
          found[begin + i] = { place[0] - start[0], place[1] - start[1], place[2] - start[2] };
        }
      }
    },
    progress);
  long_steps_ += long_steps;
  return found;
}

SquareDisplacements::Means SquareDisplacements::add(
  PathFrame frame, const NameRows& name_rows, Progress& progress)
{
  return do_together(ranks_,
    [&]
    {
      std::vector<PathFrame> frames(1);
      frames[0] = std::move(frame);
      expect_none(share_kinds(frames, ranks_));
      const bool first = unwrapper_.frames() == 0;
      first_ids_ = first ? share_out(frames, ranks_) : std::move(first_ids_);
      exchange_frames(frames, first_ids_, ranks_);
      const PathFrame& own = frames[0];
      if (first)
      {
        finder_ = IdFinder(own.ids);
        states_.resize(own.ids.size());
        firsts_.resize(own.ids.size());
      }
      unwrapper_.add_box(own.header.box);
      const std::vector<std::int64_t> places = this->find_places(own, name_rows, progress);
      Means means;
      means.count = std::ranges::count_if(
        places, [](std::int64_t place) { return place != IdFinder::nowhere; });
      ranks_.sum({ &means.count, 1 });
      Odd odd = {};
      const auto terms = square(this->find_displacements(own, places, progress), odd);
      ranks_.sum(odd);
      const SumScale::Terms squares = sum_exactly(terms, sums, ranks_);
      const auto mean_of = [&](std::size_t sum)
      {
        return odd[sum] > 0 ? std::numeric_limits<double>::quiet_NaN()
                            : squares[sum] / static_cast<double>(means.count); // 0: nan
      };
      means.axes = { mean_of(0), mean_of(1), mean_of(2) };
      means.total = mean_of(3);
      return means;
    });
}

std::int64_t SquareDisplacements::count_long_steps() const
{
  std::int64_t all = long_steps_;
  ranks_.sum({ &all, 1 });
  return all;
}
}
