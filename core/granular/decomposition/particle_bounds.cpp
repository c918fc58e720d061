// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/error.h"
#include "granular/decomposition/count_particles.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/gather.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/column_arrays.h"
#include "granular/particles/point_forms.h"

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
constexpr std::int64_t rows_per_chunk = 65536;
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
  Subdomain& of(int rank)
  {
    if (bounds_.empty() || bounds_[last_].rank != rank)
    {
      last_ = numbers_.try_emplace(rank, bounds_.size()).first->second;
      if (last_ == bounds_.size())
      {
        bounds_.push_back(nothing_of(rank));
      }
    }
    return bounds_[last_];
  }

  void add(const Subdomain& other)
  {
    extend(this->of(other.rank), other.lo.data(), other.hi.data(), other.particles);
  }

  void add(std::span<const Subdomain> others)
  {
    std::ranges::for_each(others, [this](const Subdomain& other) { this->add(other); });
  }

  const std::vector<Subdomain>& all() const noexcept { return bounds_; }

  /// By rank. Which of -0 and 0 came first must not show: all are 0.
  std::vector<Subdomain> sorted() &&
  {
    std::ranges::sort(bounds_, {}, &Subdomain::rank);
    for (Subdomain& bounds : bounds_)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        bounds.lo[axis] += 0.0;
        bounds.hi[axis] += 0.0;
      }
    }
    return std::move(bounds_);
  }

private:
  std::vector<Subdomain> bounds_;
  std::unordered_map<int, std::size_t> numbers_;
  std::size_t last_ = 0;
};

/// The processes of rows, as doubles: all that are right are exact.
class Processes
{
public:
  /// null: all rows are of process 0
  explicit Processes(const ArrayView* array)
    : array_(array)
  {
    if (array && (array->size() != 1 || array->type == ValueType::Text))
    {
      throw Error("expected one whole number a row, got " +
          (array->type == ValueType::Text ? "texts" : std::to_string(array->size()) + " values"),
        { .column = array->name });
    }
  }

  void load(std::int64_t first, std::size_t count, double* to) const
  {
    if (!array_)
    {
      std::fill_n(to, count, 0.0);
      return;
    }
    std::array<std::int64_t, most_rows> rows;
    std::iota(rows.begin(), rows.end(), first);
    load_numbers(component_of(*array_, 0), std::span(rows).first(count), to);
  }

  int rank_of(double process) const
  {
    if (!(process >= 0 && process <= largest_rank && process == std::floor(process)))
    {
      throw Error(
        "expected whole numbers of processes, from 0 to 2147483647, got " + to_text(process),
        { .column = array_->name });
    }
    return static_cast<int>(process);
  }

private:
  const ArrayView* array_;
};

void add_rows(const FrameView& frame, const AbsolutePositions& positions,
  const Processes& processes, std::int64_t first, std::int64_t last, BoundsByRank& bounds,
  std::int64_t& outside)
{
  constexpr auto most = static_cast<std::int64_t>(most_rows);
  std::array<double, 3 * most_rows> buffer;
  std::array<double, most_rows> numbers;
  for (; first < last; first += most)
  {
    const auto count = static_cast<std::size_t>(std::min(most, last - first));
    processes.load(first, count, numbers.data());
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
        const int rank = processes.rank_of(numbers[i]);
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
  const Processes processes(process);
  const auto chunks = static_cast<std::size_t>((frame.rows + rows_per_chunk - 1) / rows_per_chunk);
  std::vector<BoundsByRank> bounds(executor.workers(chunks));
  std::vector<std::int64_t> outside(bounds.size(), 0);
  executor.parallel_for(
    chunks,
    [&](std::size_t chunk, std::size_t worker)
    {
      const std::int64_t first = static_cast<std::int64_t>(chunk) * rows_per_chunk;
      add_rows(frame, positions, processes, first, std::min(first + rows_per_chunk, frame.rows),
        bounds[worker], outside[worker]);
    },
    progress);
  for (std::size_t worker = 1; worker < bounds.size(); ++worker)
  {
    bounds[0].add(bounds[worker].all());
  }
  return { std::move(bounds[0]).sorted(),
    std::accumulate(outside.begin(), outside.end(), std::int64_t{ 0 }) };
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
      joined.add(own);
      BoundsByRank all;
      for (const std::vector<Subdomain>& subdomains : gather(ranks, joined.all()))
      {
        all.add(subdomains);
      }
      return std::move(all).sorted();
    });
}
}
