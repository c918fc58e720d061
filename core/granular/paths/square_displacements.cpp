// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/paths.h"

#include "granular/common/simd.h"
#include "granular/particles/point_forms.h"
#include "granular/paths/path_frame.h"
#include "granular/paths/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t particles_per_chunk = std::size_t{ 1 } << 12; // even: see square_rows
constexpr std::size_t ahead = 12; // particles that are being brought into the cache

/// Terms for two particles side by side.
[[gnu::always_inline]] inline void square_rows(
  std::span<const double> displacements, SumScale::Terms* terms) noexcept
{
  for (std::size_t i = 0; 3 * i < displacements.size(); ++i)
  {
    double* const to = terms[i / 2].data() + 4 * (i % 2);
    CompensatedSum length;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double part = displacements[3 * i + axis];
      to[axis] = part * part;
      length.add_product(part, part);
    }
    to[3] = length.value();
  }
}

#if GRANULAR_X86
/// The same operations; std::fma is an instruction here and a function call there.
__attribute__((target("fma"))) void square_fma(
  std::span<const double> displacements, SumScale::Terms* terms) noexcept
{
  square_rows(displacements, terms);
}
#endif

void square(std::span<const double> displacements, SumScale::Terms* terms) noexcept
{
#if GRANULAR_X86
  static const bool has_fma = __builtin_cpu_supports("fma");
  if (has_fma)
  {
    square_fma(displacements, terms);
    return;
  }
#endif
  square_rows(displacements, terms);
}
}

/// Finds the particles among those of the first frame.
void SquareDisplacements::find_places(
  const PathFrame& frame, const NameRows& name_rows, Progress& progress)
{
  const std::size_t rows = frame.ids.size();
  places_.resize(rows);
  executor_.for_each_stretch(
    rows, particles_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    { finder_.find(std::span(frame.ids).subspan(first, count), places_.data() + first); },
    progress);
  rows_.assign(particles_.size(), -1);
  IdTable others; // that the first frame does not have
  for (std::size_t i = 0; i < rows; ++i)
  {
    const auto row = static_cast<std::int64_t>(i);
    std::int64_t before = -1;
    if (places_[i] != IdFinder::nowhere)
    {
      before = std::exchange(rows_[static_cast<std::size_t>(places_[i])], row);
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
}

/// Moves particles on to the frame, and finds their displacements: zero of those that are not in the first frame.
void SquareDisplacements::move_chunk(
  const PathFrame& frame, std::size_t begin, std::size_t count, Chunk& chunk)
{
  const bool first = unwrapper_.frames() == 1;
  const PositionPlan plan = plan_form(Coordinates::Absolute, ColumnRole::UnwrappedPosition);
  chunk.points.assign(3 * count, 0);
  chunk.counts.assign(3 * count, 0);
  const auto particle_at = [&](std::size_t i) -> Particle*
  {
    const std::int64_t place = places_[begin + i];
    return place == IdFinder::nowhere ? nullptr : &particles_[static_cast<std::size_t>(place)];
  };
  for (std::size_t i = 0; i < count; ++i)
  {
    if (const Particle* const soon = particle_at(std::min(i + ahead, count - 1)))
    {
      __builtin_prefetch(soon);
      __builtin_prefetch(reinterpret_cast<const char*>(soon) + 64);
      __builtin_prefetch(reinterpret_cast<const char*>(soon) + 128);
    }
    if (Particle* const particle = particle_at(i))
    {
      PathState& state = particle->state;
      chunk.long_steps += unwrapper_.advance(state, frame, begin + i).is_long ? 1 : 0;
      std::copy_n(state.point.begin(), 3, chunk.points.data() + 3 * i);
      std::copy_n(state.counts.begin(), 3, chunk.counts.data() + 3 * i);
    }
  }
  convert_positions(plan, frame.header.box, {}, chunk.counts, chunk.points);
  for (std::size_t i = 0; i < count; ++i)
  {
    double* const point = chunk.points.data() + 3 * i;
    Particle* const particle = particle_at(i);
    for (std::size_t k = 0; particle && k < 3; ++k)
    {
      const double place = point[k] + particle->state.drift[k];
      particle->start[k] = first ? place : particle->start[k];
      point[k] = place - particle->start[k];
    }
  }
}

/// The squares of the displacements of all particles, as terms. Returns the sums over all chunks.
SquareDisplacements::Chunk SquareDisplacements::find_squares(
  const PathFrame& frame, Progress& progress)
{
  const std::size_t rows = frame.ids.size();
  terms_.resize((rows + 1) / 2);
  if (rows > 0)
  {
    terms_.back() = {};
  }
  std::vector<Chunk> workers(static_cast<std::size_t>(executor_.threads()));
  executor_.for_each_stretch(
    rows, particles_per_chunk,
    [&](std::size_t begin, std::size_t count, std::size_t worker)
    {
      Chunk& chunk = workers[worker];
      this->move_chunk(frame, begin, count, chunk);
      const std::span<SumScale::Terms> terms(terms_.data() + begin / 2, (count + 1) / 2);
      square(chunk.points, terms.data());
      for (SumScale::Terms& term : terms)
      {
        for (std::size_t lane = 0; lane < SumScale::lanes; ++lane)
        {
          chunk.odd[lane % sums] += std::isfinite(term[lane]) ? 0 : 1;
          term[lane] = std::isfinite(term[lane]) ? term[lane] : 0;
        }
      }
    },
    progress);
  Chunk all;
  for (const Chunk& worker : workers)
  {
    all.long_steps += worker.long_steps;
    std::ranges::transform(worker.odd, all.odd, all.odd.begin(), std::plus());
  }
  return all;
}

SquareDisplacements::Means SquareDisplacements::add(
  PathFrame& frame, const NameRows& name_rows, Progress& progress)
{
  return do_together(ranks_,
    [&]
    {
      std::vector<PathFrame> frames(1);
      frames[0] = std::move(frame);
      expect_none(share_kinds(frames, ranks_));
      const bool first = unwrapper_.frames() == 0;
      Means means;
      means.count = std::ssize(frames[0].ids);
      ranks_.sum({ &means.count, 1 });
      if (first && means.count == 0)
      {
        ++empty_frames_;
        frame = std::move(frames[0]);
        constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
        return Means{ 0, { nothing, nothing, nothing }, nothing };
      }
      first_ids_ = first ? share_out(frames, ranks_) : std::move(first_ids_);
      exchange_frames(frames, first_ids_, ranks_);
      const PathFrame& own = frames[0];
      if (first)
      {
        finder_ = IdFinder(own.ids);
        particles_.resize(own.ids.size());
      }
      unwrapper_.add_box(less_origin(own.header.box, origin_));
      this->find_places(own, name_rows, progress);
      means.count = std::ranges::count_if(
        places_, [](std::int64_t place) { return place != IdFinder::nowhere; });
      ranks_.sum({ &means.count, 1 });
      Chunk found = this->find_squares(own, progress);
      long_steps_ += found.long_steps;
      ranks_.sum(found.odd);
      const SumScale::Terms squares = sum_exactly(terms_, sums, ranks_, executor_);
      frame = std::move(frames[0]);
      const auto mean_of = [&](std::size_t sum)
      {
        return found.odd[sum] > 0 ? std::numeric_limits<double>::quiet_NaN()
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
