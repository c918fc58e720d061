// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/point_forms.h"
#include "granular/subdomains/count_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <unordered_map>

namespace granular
{
namespace
{
constexpr std::size_t rows_per_chunk = 65536;
constexpr std::size_t most_rows = AbsolutePositions::most_rows;
constexpr double largest_rank = 2147483647;

/// The bounds of nothing.
Subdomain nothing_of(int rank)
{
  return { { HUGE_VAL, HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL }, 0, rank };
}

/// Extends bounds by others, or by a point of a particle.
void extend(Subdomain& bounds, const double* lo, const double* hi, std::int64_t particles) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    bounds.lo[axis] = std::min(bounds.lo[axis], lo[axis]);
    bounds.hi[axis] = std::max(bounds.hi[axis], hi[axis]);
  }
  bounds.particles += particles;
}

/// Bounds by rank.
class BoundsByRank
{
public:
  void add(const Subdomain& other)
  {
    Subdomain& own = bounds_.try_emplace(other.rank, nothing_of(other.rank)).first->second;
    extend(own, other.lo.data(), other.hi.data(), other.particles);
  }

  /// By rank. Which of -0 and 0 came first must not show: all are 0.
  std::vector<Subdomain> all() const
  {
    std::vector<Subdomain> all;
    for (const auto& [rank, bounds] : bounds_)
    {
      Subdomain& each = all.emplace_back(bounds);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        each.lo[axis] += 0.0;
        each.hi[axis] += 0.0;
      }
    }
    std::ranges::sort(all, {}, &Subdomain::rank);
    return all;
  }

private:
  std::unordered_map<int, Subdomain> bounds_;
};

int rank_of(double process, const ArrayView& array)
{
  if (!(process >= 0 && process <= largest_rank && process == std::floor(process)))
  {
    throw Error(
      "expected whole numbers of processes, from 0 to 2147483647, got " + to_text(process),
      { .column = array.name });
  }
  return static_cast<int>(process);
}

/// processes: of the rows; null: all are of process 0.
void add_rows(const FrameView& frame, const AbsolutePositions& positions,
  const ArrayView* processes, std::int64_t first, std::int64_t last, BoundsByRank& bounds,
  std::int64_t& outside)
{
  constexpr auto most = static_cast<std::int64_t>(most_rows);
  std::array<double, 3 * most_rows> buffer;
  std::array<double, most_rows> numbers = {}; // doubles: all that are right are exact
  std::array<std::int64_t, most_rows> rows;
  for (; first < last; first += most)
  {
    const auto count = static_cast<std::size_t>(std::min(most, last - first));
    if (processes)
    {
      std::iota(rows.begin(), rows.end(), first);
      load_numbers(component_of(*processes, 0), std::span(rows).first(count), numbers.data());
    }
    const double* x = positions.load(first, count, buffer.data());
    Subdomain run = nothing_of(0); // rows of one process
    double process = 0;
    const auto end_run = [&]
    {
      if (run.particles > 0)
      {
        bounds.add(run);
      }
    };
    for (std::size_t i = 0; i < count; ++i, x += 3)
    {
      if (frame.is_duplicate(first + static_cast<std::int64_t>(i)))
      {
        continue;
      }
      if (numbers[i] != process)
      {
        const int rank = rank_of(numbers[i], *processes);
        end_run();
        run = nothing_of(rank);
        process = numbers[i];
      }
      if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
      {
        extend(run, x, x, 1);
      }
      else
      {
        ++outside;
      }
    }
    end_run();
  }
}

ParticleBounds find_bounds(
  const FrameView& frame, const ArrayView* process, const Executor& executor, Progress& progress)
{
  if (frame.rows > 0 && !frame.points)
  {
    throw Error("expected points to find bounds of, got none");
  }
  const AbsolutePositions positions(frame, false);
  if (process && (process->size() != 1 || process->type == ValueType::Text))
  {
    throw Error("expected one whole number a row, got " +
        (process->type == ValueType::Text ? "texts" : std::to_string(process->size()) + " values"),
      { .column = process->name });
  }
  std::vector<BoundsByRank> bounds(static_cast<std::size_t>(executor.threads()));
  std::vector<std::int64_t> outside(bounds.size(), 0);
  executor.for_each_stretch(
    static_cast<std::size_t>(frame.rows), rows_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t worker)
    {
      add_rows(frame, positions, process, static_cast<std::int64_t>(first),
        static_cast<std::int64_t>(first + count), bounds[worker], outside[worker]);
    },
    progress);
  for (std::size_t worker = 1; worker < bounds.size(); ++worker)
  {
    std::ranges::for_each(
      bounds[worker].all(), [&](const Subdomain& each) { bounds[0].add(each); });
  }
  return { bounds[0].all(), std::accumulate(outside.begin(), outside.end(), std::int64_t{ 0 }) };
}
}

ParticleBounds bounds_by_process(
  const FrameView& frame, const ArrayView& process, const Executor& executor, Progress& progress)
{
  return find_bounds(frame, &process, executor, progress);
}

ParticleBounds bounds_of_particles(
  const FrameView& frame, const Executor& executor, Progress& progress)
{
  return find_bounds(frame, nullptr, executor, progress);
}

std::vector<Subdomain> join_by_process(std::span<const Subdomain> own, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      BoundsByRank joined; // one a process is sent
      std::ranges::for_each(own, [&](const Subdomain& each) { joined.add(each); });
      BoundsByRank all;
      for (const std::vector<Subdomain>& subdomains : gather(ranks, joined.all()))
      {
        std::ranges::for_each(subdomains, [&](const Subdomain& each) { all.add(each); });
      }
      return all.all();
    });
}
}
