// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/join.h"

#include "granular/lines/fetch_particles.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t some = 1024; // rows at once, which stay in the cache
constexpr std::size_t rows_per_chunk = 32 * some;

using Places = std::span<const std::int64_t>;

/// The arrays of one particle array, and where they are written.
struct EndColumn
{
  const ArrayView* array;
  double* mean = nullptr; ///< null: not wanted
  double* difference = nullptr;
};

/// Finds the places of the particles at both ends of each row. Returns how many rows lack one.
std::size_t find_ends(const IdFinder& finder, Places id1, Places id2, std::int64_t* firsts,
  std::int64_t* seconds, const Executor& executor, Progress& progress)
{
  std::atomic<std::size_t> missing = 0;
  executor.for_each_stretch(
    id1.size(), rows_per_chunk,
    [&](std::size_t row, std::size_t count, std::size_t)
    {
      finder.find(id1.subspan(row, count), firsts + row);
      finder.find(id2.subspan(row, count), seconds + row);
      std::size_t here = 0;
      for (const std::size_t last = row + count; row < last; ++row)
      {
        here += firsts[row] == IdFinder::nowhere || seconds[row] == IdFinder::nowhere ? 1 : 0;
      }
      missing += here;
    },
    progress);
  return missing;
}

/// Leaves the places of `found` of so many rows, those of which both ends were found, and returns these rows.
std::vector<std::int64_t> keep_found(
  std::int64_t* firsts, std::int64_t* seconds, std::size_t all, std::size_t found)
{
  std::vector<std::int64_t> rows;
  rows.reserve(found);
  for (std::size_t row = 0; row < all; ++row)
  {
    if (firsts[row] != IdFinder::nowhere && seconds[row] != IdFinder::nowhere)
    {
      firsts[rows.size()] = firsts[row];
      seconds[rows.size()] = seconds[row];
      rows.push_back(static_cast<std::int64_t>(row));
    }
  }
  return rows;
}

void gather_points(const ParticleValues& particles, Places places, double* to) noexcept
{
  constexpr std::size_t ahead = 16; // particles that are being brought into the cache
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const std::int64_t soon = places[std::min(i + ahead, places.size() - 1)];
    __builtin_prefetch(particles.points + soon * particles.point_step);
    // two moves; std::copy_n would call memmove
    std::memcpy(
      to + 3 * i, particles.points + places[i] * particles.point_step, 3 * sizeof(double));
  }
}

/// Lines from number `begin` on.
void gather_column(const EndColumn& column, Places firsts, Places seconds, std::size_t begin)
{
  std::array<double, some> a;
  std::array<double, some> b;
  const auto size = static_cast<std::size_t>(column.array->size());
  for (std::size_t component = 0; component < size; ++component)
  {
    const ValueSource source = component_of(*column.array, static_cast<int>(component));
    load_numbers(source, firsts, a.data());
    load_numbers(source, seconds, b.data());
    const std::size_t at = begin * size + component;
    for (std::size_t i = 0; column.mean && i < firsts.size(); ++i)
    {
      column.mean[at + i * size] = std::midpoint(a[i], b[i]);
    }
    for (std::size_t i = 0; column.difference && i < firsts.size(); ++i)
    {
      column.difference[at + i * size] = b[i] - a[i];
    }
  }
}

/// Makes the memory of an array of lines, and returns it.
double* add_array(std::string name, int size, const JoinRequest& request, JoinedLines& lines)
{
  const auto numbers = static_cast<std::size_t>(lines.count * size);
  lines.arrays.push_back({ std::move(name), size, Block(numbers * sizeof(double), request.pool) });
  return static_cast<double*>(lines.arrays.back().values.data());
}

/// All means, then all differences, in the order in which they are wanted.
std::vector<EndColumn> make_arrays(
  const ParticleValues& particles, const JoinRequest& request, JoinedLines& lines)
{
  std::vector<EndColumn> columns;
  for (const ArrayView& array : particles.arrays)
  {
    columns.push_back({ &array });
  }
  const auto make = [&](const std::vector<std::string>& names, const char* suffix, auto member)
  {
    for (const std::string& name : names)
    {
      EndColumn& column = *std::ranges::find_if(
        columns, [&](const EndColumn& one) { return one.array->name == name; });
      if (!(column.*member))
      {
        column.*member = add_array(name + suffix, column.array->size(), request, lines);
      }
    }
  };
  make(request.means, "_mean", &EndColumn::mean);
  make(request.differences, "_difference", &EndColumn::difference);
  return columns;
}

/// Returns the values of the lines between particles that are here.
JoinedLines join_here(const ParticleValues& particles, const IdFinder& finder, Places id1,
  Places id2, const JoinRequest& request, PartialProgress& progress)
{
  const Executor executor(request.threads);
  const std::size_t all = id1.size();
  const Block places[] = { Block(all * sizeof(std::int64_t), request.pool),
    Block(all * sizeof(std::int64_t), request.pool) };
  auto* const firsts = static_cast<std::int64_t*>(places[0].data());
  auto* const seconds = static_cast<std::int64_t*>(places[1].data());
  progress.set_part(0.3, 0.6);
  const std::size_t missing = find_ends(finder, id1, id2, firsts, seconds, executor, progress);
  const std::size_t count = all - missing;
  JoinedLines lines;
  lines.count = static_cast<std::int64_t>(count);
  lines.missing = static_cast<std::int64_t>(missing);
  if (missing > 0)
  {
    lines.rows = keep_found(firsts, seconds, all, count);
  }
  const std::size_t bytes = count * 3 * sizeof(double);
  lines.first = Block(bytes, request.pool);
  lines.second = Block(bytes, request.pool);
  const std::vector<EndColumn> columns = make_arrays(particles, request, lines);
  progress.set_part(0.6, 1);
  executor.for_each_stretch(
    count, rows_per_chunk,
    [&](std::size_t line, std::size_t lines_here, std::size_t)
    {
      for (const std::size_t last = line + lines_here; line < last; line += some)
      {
        const std::size_t now = std::min(some, last - line);
        const Places first = { firsts + line, now };
        const Places second = { seconds + line, now };
        gather_points(particles, first, static_cast<double*>(lines.first.data()) + 3 * line);
        gather_points(particles, second, static_cast<double*>(lines.second.data()) + 3 * line);
        for (const EndColumn& column : columns)
        {
          gather_column(column, first, second, line);
        }
      }
    },
    progress);
  return lines;
}
}

JoinedLines join_lines(const FrameView& particles, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, const JoinRequest& request, Communicator& ranks,
  Progress& progress)
{
  SharedProgress shared(progress, ranks);
  PartialProgress parts(shared);
  return do_together(ranks,
    [&]
    {
      if (id1.size() != id2.size())
      {
        throw Error("expected as many ids of second ends as of first ones, " +
          std::to_string(id1.size()) + ", got " + std::to_string(id2.size()));
      }
      const Executor executor(request.threads);
      parts.set_part(0, 0.1);
      const Ids ids = load_ids(particles, "particles", executor, parts);
      parts.set_part(0.1, 0.2);
      std::vector<std::string> names = request.means;
      names.insert(names.end(), request.differences.begin(), request.differences.end());
      names = distinct_names(std::move(names));
      ParticleValues values = view_particles(particles, names, executor, parts);
      share_sizes(values, particles.rows, ranks);
      const bool alone = ranks.size() == 1;
      FetchedParticles fetched;
      if (!alone)
      {
        const IdDirectory directory(ids.values(), particles.ghosts, ranks);
        fetched = fetch_particles(values, directory, distinct_ids(id1, id2), ranks);
      }
      const IdFinder finder(alone ? ids.values() : fetched.ids, alone ? particles.ghosts : nullptr);
      const ParticleValues& ends = alone ? values : fetched.values;
      JoinedLines lines = join_here(ends, finder, id1, id2, request, parts);
      lines.repeated = alone ? finder.repeated() : fetched.repeated;
      std::array<std::int64_t, 2> sums = { lines.missing, lines.repeated };
      ranks.sum(sums);
      lines.missing = sums[0];
      lines.repeated = sums[1];
      return lines;
    });
}
}
