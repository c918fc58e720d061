// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/fetch_particles.h"

#include "granular/common/error.h"
#include "granular/lines/id_finder.h"
#include "granular/numbers/number_print.h"
#include "granular/parallel/trade.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>

namespace granular
{
namespace
{
constexpr std::size_t rows_per_chunk = 65536;
constexpr std::size_t some = 1024; // rows at once, that stay in the cache

[[noreturn]] void refuse(const std::string& value, std::int64_t row)
{
  throw Error("expected a 64-bit integer as id, got " + value + " in row " + std::to_string(row) +
    " (the first is 0)");
}

/// Integers of any type; only large ones of UInt64 do not fit.
void load_integers(const ValueSource& source, std::span<const std::int64_t> rows, std::int64_t* to)
{
  load_numbers(source, rows, to);
  for (std::size_t i = 0; source.type == ValueType::UInt64 && i < rows.size(); ++i)
  {
    if (to[i] < 0)
    {
      refuse(std::to_string(static_cast<std::uint64_t>(to[i])), rows[i]);
    }
  }
}

void load_integral(const ValueSource& source, std::span<const std::int64_t> rows, std::int64_t* to)
{
  std::array<double, some> values;
  load_numbers(source, rows, values.data());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const double value = values[i];
    if (!(value >= -0x1p63 && value < 0x1p63) || std::trunc(value) != value)
    {
      refuse(to_text(value), rows[i]);
    }
    to[i] = static_cast<std::int64_t>(value);
  }
}

/// Returns particles by the places where they are shown: in how many periods they have been does not.
FrameView as_shown(const FrameView& frame)
{
  FrameView shown = frame;
  shown.coordinates =
    frame.coordinates == Coordinates::Unwrapped ? Coordinates::Absolute : frame.coordinates;
  return shown;
}

/// Doubles x y z of each row, one after the other, as they are wanted.
bool is_plain(const FrameView& frame) noexcept
{
  return frame.coordinates != Coordinates::Scaled && frame.point_origin == Vector3{} &&
    frame.points->are_triples();
}

void compute_points(
  const FrameView& frame, ParticleValues& particles, const Executor& executor, Progress& progress)
{
  const AbsolutePositions positions(frame, false);
  const auto rows = static_cast<std::size_t>(frame.rows);
  particles.own.resize(3 * rows);
  double* const points = particles.own.data();
  executor.for_each_stretch(
    rows, rows_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    { positions.store(static_cast<std::int64_t>(first), count, points + 3 * first); },
    progress);
  particles.points = points;
  particles.point_step = 3;
}

ArrayView view_array(const FrameView& frame, const std::string& name)
{
  const ArrayView* const array = frame.find(name);
  if (!array && frame.rows > 0)
  {
    throw Error("expected an array '" + name + "' of the particles, got none");
  }
  if (array && array->type == ValueType::Text)
  {
    throw Error("expected numbers in array '" + name + "' of the particles, got texts");
  }
  return array ? *array : ArrayView{ name };
}

/// 1 if a rank has rows, else 0; then the sizes of its arrays.
using ArraySizes = std::vector<int>;

/// Returns the size that the ranks with rows have, which must agree; if none has any, that of the first that knows it.
int size_among(const std::vector<ArraySizes>& all, std::size_t place, const std::string& name)
{
  int size = 0;
  bool counted = false; // on a rank with rows
  for (const ArraySizes& sizes : all)
  {
    const int here = sizes[place];
    const bool counts = sizes[0] != 0;
    if (counts && counted && here != size)
    {
      throw Error("expected as many numbers a particle in array '" + name +
        "' on all processes, got " + std::to_string(size) + " and " + std::to_string(here));
    }
    if (counts ? !counted : size == 0)
    {
      size = here;
    }
    counted = counted || counts;
  }
  return std::max(size, 1);
}

using Numbers = std::vector<std::int64_t>;

/// Points and arrays of a particle, one after the other.
std::size_t width_of(const ParticleValues& values)
{
  return std::accumulate(values.arrays.begin(), values.arrays.end(), std::size_t{ 3 },
    [](std::size_t sum, const ArrayView& array) { return sum + array.components.size(); });
}

std::vector<double> pack(const ParticleValues& values, const Numbers& rows)
{
  std::array<double, some> numbers;
  const std::size_t width = width_of(values);
  std::vector<double> packed(rows.size() * width);
  for (std::size_t first = 0; first < rows.size(); first += some)
  {
    const auto now = std::span(rows).subspan(first, std::min(some, rows.size() - first));
    double* to = packed.data() + first * width;
    for (std::size_t i = 0; i < now.size(); ++i)
    {
      std::copy_n(values.points + now[i] * values.point_step, 3, to + i * width);
    }
    to += 3;
    for (const ArrayView& array : values.arrays)
    {
      for (int component = 0; component < array.size(); ++component)
      {
        load_numbers(component_of(array, component), now, numbers.data());
        for (std::size_t i = 0; i < now.size(); ++i)
        {
          to[i * width] = numbers[i];
        }
        ++to;
      }
    }
  }
  return packed;
}

/// Lets points and arrays show what came.
void view_packed(ParticleValues& values, std::size_t width)
{
  const double* next = values.own.data();
  values.points = next;
  values.point_step = static_cast<std::int64_t>(width);
  next += 3;
  for (ArrayView& array : values.arrays)
  {
    array.type = ValueType::Float64;
    array.step = values.point_step;
    for (const void*& component : array.components)
    {
      component = next++;
    }
  }
}
}

Ids::Ids(const ArrayView& array, std::int64_t rows, const Executor& executor, Progress& progress)
try
{
  if (array.type == ValueType::Text || array.size() != 1)
  {
    throw Error(std::string("expected one number a row, got ") +
      (array.type == ValueType::Text ? "texts" : std::to_string(array.size())));
  }
  const ValueSource source = component_of(array, 0);
  if (source.type == ValueType::Int64 && source.step == 1)
  {
    values_ = { static_cast<const std::int64_t*>(source.data), static_cast<std::size_t>(rows) };
    return;
  }
  own_.resize(static_cast<std::size_t>(rows));
  values_ = own_;
  auto* const load = is_integer(source.type) ? load_integers : load_integral;
  executor.for_each_stretch(
    own_.size(), rows_per_chunk,
    [&](std::size_t row, std::size_t count, std::size_t)
    {
      std::array<std::int64_t, some> numbers;
      for (const std::size_t last = row + count; row < last; row += some)
      {
        const auto now = std::span(numbers).first(std::min(some, last - row));
        std::iota(now.begin(), now.end(), static_cast<std::int64_t>(row));
        load(source, now, own_.data() + row);
      }
    },
    progress);
}
catch (const Error& error)
{
  throw Error(error.text(), { {}, 0, -1, array.name });
}

Ids load_ids(
  const FrameView& frame, const std::string& whose, const Executor& executor, Progress& progress)
{
  const ArrayView* const array = frame.find("id");
  if (!array && frame.rows > 0)
  {
    throw Error("expected an array 'id' of the " + whose + ", got none");
  }
  return array ? Ids(*array, frame.rows, executor, progress) : Ids();
}

std::vector<std::string> distinct_names(std::vector<std::string> names)
{
  std::vector<std::string> distinct;
  for (std::string& name : names)
  {
    if (std::ranges::find(distinct, name) == distinct.end())
    {
      distinct.push_back(std::move(name));
    }
  }
  return distinct;
}

ParticleValues view_particles(const FrameView& frame, std::span<const std::string> names,
  const Executor& executor, Progress& progress)
{
  ParticleValues particles;
  for (const std::string& name : names)
  {
    particles.arrays.push_back(view_array(frame, name));
  }
  if (frame.rows == 0)
  {
    return particles;
  }
  if (!frame.points)
  {
    throw Error("expected points of the particles, got none");
  }
  const FrameView shown = as_shown(frame);
  if (is_plain(shown))
  {
    particles.points = static_cast<const double*>(shown.points->components[0]);
    particles.point_step = shown.points->step;
  }
  else
  {
    compute_points(shown, particles, executor, progress);
  }
  return particles;
}

void share_sizes(ParticleValues& particles, std::int64_t rows, Communicator& ranks)
{
  ArraySizes own = { rows > 0 ? 1 : 0 };
  std::ranges::transform(particles.arrays, std::back_inserter(own), &ArrayView::size);
  const std::vector<ArraySizes> all = gather(ranks, own);
  for (std::size_t i = 0; i < particles.arrays.size(); ++i)
  {
    ArrayView& array = particles.arrays[i];
    array.components.resize(static_cast<std::size_t>(size_among(all, i + 1, array.name)));
  }
}

FetchedParticles fetch_particles(const ParticleValues& own, const IdDirectory& directory,
  const Numbers& wanted, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const auto size = static_cast<std::size_t>(ranks.size());
      const std::vector<ParticleHome> homes = directory.find(wanted, ranks);
      const ByRank requests = sort_by_rank(homes.size(), size,
        [&](std::size_t i)
        { return homes[i].rank < 0 ? size : static_cast<std::size_t>(homes[i].rank); });
      FetchedParticles fetched;
      fetched.ids = pick(wanted, requests.places);
      Numbers rows(requests.places.size());
      std::ranges::transform(requests.places, rows.begin(),
        [&](std::int64_t place) { return homes[static_cast<std::size_t>(place)].row; });
      fetched.values.arrays = own.arrays;
      const Numbers wanted_here = swap_numbers(requests.counts, ranks);
      rows = trade(rows, requests.counts, wanted_here, ranks);
      const std::size_t width = width_of(own);
      fetched.values.own = trade(pack(own, rows), wanted_here, requests.counts, ranks, width);
      view_packed(fetched.values, width);
      fetched.repeated = directory.repeated();
      return fetched;
    });
}
}
