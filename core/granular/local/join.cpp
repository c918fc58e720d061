// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/join.h"

#include "granular/local/fetch_particles.h"
#include "granular/local/id_finder.h"
#include "granular/local/ids.h"
#include "granular/local/particle_values.h"
#include "granular/parallel/executor.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
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

/// The places of the particles at both ends of the rows where these were found, chunk by chunk: the first so many of those
/// that the chunk has room for.
struct FoundEnds
{
  Block firsts; ///< std::int64_t
  Block seconds;
  std::vector<std::size_t> counts;                ///< of each chunk
  std::vector<std::vector<std::int64_t>> missing; ///< the other rows of each
};

/// The arrays of one particle array, and where they are written.
struct EndColumn
{
  const ArrayView* array;
  double* mean = nullptr; ///< null: not wanted
  double* difference = nullptr;
};

std::vector<std::string> distinct_names(const JoinRequest& request)
{
  std::vector<std::string> names;
  for (const auto* const wanted : { &request.means, &request.differences })
  {
    for (const std::string& name : *wanted)
    {
      if (std::ranges::find(names, name) == names.end())
      {
        names.push_back(name);
      }
    }
  }
  return names;
}

Ids find_ids(const FrameView& particles, const Executor& executor, Progress& progress)
{
  const ArrayView* const array = particles.find("id");
  if (!array && particles.rows > 0)
  {
    throw Error("expected an array 'id' of the particles, got none");
  }
  return array ? Ids(*array, particles.rows, executor, progress) : Ids();
}

void find_chunk(const IdFinder& finder, Places id1, Places id2, std::size_t chunk, FoundEnds& ends)
{
  std::array<std::int64_t, some> firsts;
  std::array<std::int64_t, some> seconds;
  const std::size_t begin = chunk * rows_per_chunk;
  const std::size_t end = std::min(begin + rows_per_chunk, id1.size());
  std::int64_t* const found_firsts = static_cast<std::int64_t*>(ends.firsts.data()) + begin;
  std::int64_t* const found_seconds = static_cast<std::int64_t*>(ends.seconds.data()) + begin;
  std::size_t found = 0;
  for (std::size_t row = begin; row < end; row += some)
  {
    const std::size_t count = std::min(some, end - row);
    finder.find(id1.subspan(row, count), firsts.data());
    finder.find(id2.subspan(row, count), seconds.data());
    for (std::size_t i = 0; i < count; ++i)
    {
      if (firsts[i] == IdFinder::nowhere || seconds[i] == IdFinder::nowhere)
      {
        ends.missing[chunk].push_back(static_cast<std::int64_t>(row + i));
        continue;
      }
      found_firsts[found] = firsts[i];
      found_seconds[found++] = seconds[i];
    }
  }
  ends.counts[chunk] = found;
}

FoundEnds find_ends(const IdFinder& finder, Places id1, Places id2, const JoinRequest& request,
  const Executor& executor, Progress& progress)
{
  const std::size_t bytes = id1.size() * sizeof(std::int64_t);
  const std::size_t chunks = (id1.size() + rows_per_chunk - 1) / rows_per_chunk;
  FoundEnds ends{ Block(bytes, request.pool), Block(bytes, request.pool),
    std::vector<std::size_t>(chunks), std::vector<std::vector<std::int64_t>>(chunks) };
  executor.parallel_for(
    chunks, [&](std::size_t chunk, std::size_t) { find_chunk(finder, id1, id2, chunk, ends); },
    progress);
  return ends;
}

/// Returns, of so many rows, those that are not missing, as JoinedLines has them.
std::vector<std::int64_t> list_rows(const FoundEnds& ends, std::size_t all, std::size_t found)
{
  std::vector<std::int64_t> rows;
  if (found < all)
  {
    rows.reserve(found);
    std::int64_t row = 0;
    const auto list_up_to = [&](std::int64_t missing)
    {
      for (; row < missing; ++row)
      {
        rows.push_back(row);
      }
      ++row;
    };
    for (const std::vector<std::int64_t>& missing : ends.missing)
    {
      std::ranges::for_each(missing, list_up_to);
    }
    list_up_to(static_cast<std::int64_t>(all));
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
  progress.set_part(0.3, 0.6);
  const FoundEnds ends = find_ends(finder, id1, id2, request, executor, progress);
  std::vector<std::size_t> begins(ends.counts.size());
  std::exclusive_scan(ends.counts.begin(), ends.counts.end(), begins.begin(), std::size_t{ 0 });
  const std::size_t count = begins.empty() ? 0 : begins.back() + ends.counts.back();
  JoinedLines lines;
  lines.count = static_cast<std::int64_t>(count);
  lines.rows = list_rows(ends, id1.size(), count);
  lines.missing = static_cast<std::int64_t>(id1.size() - count);
  const std::size_t bytes = count * 3 * sizeof(double);
  lines.first = Block(bytes, request.pool);
  lines.second = Block(bytes, request.pool);
  const std::vector<EndColumn> columns = make_arrays(particles, request, lines);
  const auto places_of = [](const Block& block)
  { return Places(static_cast<const std::int64_t*>(block.data()), block.bytes() / 8); };
  progress.set_part(0.6, 1);
  executor.parallel_for(
    begins.size(),
    [&](std::size_t chunk, std::size_t)
    {
      for (std::size_t done = 0; done < ends.counts[chunk]; done += some)
      {
        const std::size_t from = chunk * rows_per_chunk + done;
        const std::size_t now = std::min(some, ends.counts[chunk] - done);
        const std::size_t to = begins[chunk] + done;
        const Places firsts = places_of(ends.firsts).subspan(from, now);
        const Places seconds = places_of(ends.seconds).subspan(from, now);
        gather_points(particles, firsts, static_cast<double*>(lines.first.data()) + 3 * to);
        gather_points(particles, seconds, static_cast<double*>(lines.second.data()) + 3 * to);
        for (const EndColumn& column : columns)
        {
          gather_column(column, firsts, seconds, to);
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
      const Ids ids = find_ids(particles, executor, parts);
      parts.set_part(0.1, 0.2);
      ParticleValues values = view_particles(particles, distinct_names(request), executor, parts);
      share_sizes(values, particles.rows, ranks);
      const bool alone = ranks.size() == 1;
      FetchedParticles fetched;
      if (!alone)
      {
        fetched = fetch_particles({ ids.values(), particles.ghosts, values }, id1, id2, ranks);
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
