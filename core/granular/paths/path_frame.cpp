// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/path_frame.h"

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/lines/fetch_particles.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/trade.h"
#include "granular/particles/absolute_positions.h"
#include "granular/particles/point_forms.h"
#include "granular/particles/table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
constexpr const char* image_array = "image";

/// The rows of selected particles.
void choose_rows(const FrameView& frame, std::span<const std::int64_t> ids,
  const IdSelection& selection, std::vector<std::int64_t>& rows)
{
  if (selection.is_all() && !frame.ghosts)
  {
    rows.resize(ids.size());
    std::iota(rows.begin(), rows.end(), std::int64_t{ 0 });
    return;
  }
  rows.clear();
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    const auto number = static_cast<std::int64_t>(row);
    if (selection.holds(ids[row]) && !frame.is_duplicate(number))
    {
      rows.push_back(number);
    }
  }
}

constexpr std::size_t rows_per_chunk = std::size_t{ 1 } << 14;

/// Loads the rows of one component, as numbers of a type, into every size-th word.
template <class Number>
void load_words(const ValueSource& source, std::span<const std::int64_t> rows, std::size_t size,
  std::int64_t* words)
{
  std::array<Number, 2048> numbers;
  for (std::size_t begin = 0; begin < rows.size(); begin += numbers.size())
  {
    const std::size_t count = std::min(numbers.size(), rows.size() - begin);
    load_numbers(source, rows.subspan(begin, count), numbers.data());
    for (std::size_t i = 0; i < count; ++i)
    {
      words[(begin + i) * size] = std::bit_cast<std::int64_t>(numbers[i]);
    }
  }
}

/// Fills the array, whose memory is used again.
void pick_array(const ArrayView& view, std::span<const std::int64_t> rows, PathArray& array,
  const Executor& executor, Progress& progress)
{
  // integers above 2^63 have no place among std::int64_t
  array.integers = is_integer(view.type) && view.type != ValueType::UInt64;
  array.size = view.size();
  const auto size = static_cast<std::size_t>(array.size);
  array.words.resize(rows.size() * size);
  executor.for_each_stretch(
    rows.size(), rows_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      for (std::size_t i = 0; i < size; ++i)
      {
        const ValueSource source = component_of(view, static_cast<int>(i));
        std::int64_t* const words = array.words.data() + first * size + i;
        const std::span<const std::int64_t> some = rows.subspan(first, count);
        array.integers ? load_words<std::int64_t>(source, some, size, words)
                       : load_words<double>(source, some, size, words);
      }
    },
    progress);
}

[[noreturn]] void refuse_texts(const std::string& name, const Where& where = {})
{
  throw Error("expected numbers in array '" + name + "' of the particles, got texts", where);
}

void load_points(const FrameView& frame, std::span<const std::int64_t> rows, const Vector3& origin,
  std::vector<double>& points, const Executor& executor, Progress& progress)
{
  const AbsolutePositions positions(frame, false, origin);
  const bool all = is_consecutive(rows); // then they may need no conversion
  points.resize(3 * rows.size());
  executor.for_each_stretch(
    rows.size(), rows_per_chunk,
    [&](std::size_t first, std::size_t count, std::size_t)
    {
      double* const to = points.data() + 3 * first;
      all ? positions.store(rows[first], count, to)
          : positions.store(rows.subspan(first, count), to);
    },
    progress);
}

void pick_points(const FrameView& frame, const PathRequest& request, PathFrame& picked,
  const Executor& executor, Progress& progress)
{
  if (!frame.points)
  {
    throw Error("expected points of the particles, got none");
  }
  FrameView wanted = frame;
  if (picked.coordinates == Coordinates::Unwrapped)
  {
    picked.coordinates = request.absolute ? Coordinates::Absolute : Coordinates::Unwrapped;
    // taken for absolute ones, unwrapped points stay as they are
    wanted.coordinates = request.absolute ? Coordinates::Unwrapped : Coordinates::Absolute;
  }
  load_points(wanted, picked.rows, request.origin, picked.points, executor, progress);
  const ArrayView* const images = frame.find(image_array);
  if (picked.coordinates == Coordinates::Absolute && images && images->size() == 3 &&
    is_integer(images->type) && images->type != ValueType::UInt64)
  {
    picked.has_images = true;
    PathArray counts;
    counts.words = std::move(picked.images);
    pick_array(*images, picked.rows, counts, executor, progress);
    picked.images = std::move(counts.words);
  }
  else
  {
    picked.images.clear();
  }
}
}

PathFrame pick_particles(const FrameView& frame, const PathRequest& request, std::int64_t first_row,
  const Executor& executor, Progress& progress, PathFrame spent)
{
  PathFrame picked;
  picked.loaded = true;
  picked.header = frame.header;
  picked.header.has_box = frame.has_box;
  picked.coordinates =
    frame.coordinates == Coordinates::Unwrapped ? Coordinates::Unwrapped : Coordinates::Absolute;
  spent.arrays.resize(request.arrays.size());
  for (const std::string& name : request.arrays)
  {
    picked.arrays.push_back({ name });
  }
  if (frame.rows == 0)
  {
    return picked;
  }
  const ArrayView* const id_array = frame.find("id");
  if (!id_array)
  {
    throw Error("expected an array 'id' of the particles, got none: paths need ids");
  }
  const Ids ids(*id_array, frame.rows, executor, progress);
  picked.has_rows = true;
  picked.rows = std::move(spent.rows);
  choose_rows(frame, ids.values(), request.selection, picked.rows);
  const std::span<const std::int64_t> rows = picked.rows;
  picked.ids = std::move(spent.ids);
  picked.ids.resize(rows.size());
  std::ranges::transform(rows, picked.ids.begin(),
    [&](std::int64_t row) { return ids.values()[static_cast<std::size_t>(row)]; });
  for (std::size_t i = 0; i < picked.arrays.size(); ++i)
  {
    if (const ArrayView* const view = frame.find(picked.arrays[i].name))
    {
      if (view->type == ValueType::Text)
      {
        refuse_texts(picked.arrays[i].name);
      }
      picked.arrays[i].words = std::move(spent.arrays[i].words);
      pick_array(*view, rows, picked.arrays[i], executor, progress);
    }
  }
  if (request.points)
  {
    picked.points = std::move(spent.points);
    picked.images = std::move(spent.images);
    pick_points(frame, request, picked, executor, progress);
  }
  for (std::int64_t& row : picked.rows)
  {
    row += first_row;
  }
  return picked;
}

PathFrame read_particles(const std::vector<FramePiece>& pieces, const PathRequest& request,
  const Request& base, Notices& notices, Progress& progress, PathFrame spent)
{
  Request wanted = base;
  wanted.points = request.points;
  wanted.single_precision = false;
  wanted.point_origin = request.origin;
  wanted.ranges = false;
  wanted.sort_by_id = false;
  const bool images = request.points && base.coordinates == Coordinates::Absolute;
  wanted.wanted = [&names = request.arrays, images](std::string_view name, bool)
  {
    return name == "id" || (images && name == image_array) ||
      std::ranges::find(names, name) != names.end();
  };
  if (!request.selection.is_all())
  {
    wanted.keep_id = [&selection = request.selection](std::int64_t id)
    { return selection.holds(id); };
  }
  const Table frame = read_dump(pieces, wanted, notices, progress);
  const bool lacks_ids = std::ranges::none_of(
    frame.arrays, [](const TableArray& array) { return array.info.name == "id"; });
  if (frame.header.rows > 0 && frame.schema.find(ColumnRole::Id) < 0 &&
    (lacks_ids || frame.rows == 0))
  {
    throw FormatError("expected a column id: paths need ids", where_of(pieces.front()));
  }
  for (const TableArray& array : frame.arrays) // the view has none of them
  {
    if (array.info.type == ValueType::Text &&
      std::ranges::find(request.arrays, array.info.name) != request.arrays.end())
    {
      refuse_texts(array.info.name, where_of(pieces.front()));
    }
  }
  FrameView view = view_frame(frame);
  view.point_origin = request.origin;
  PathFrame picked =
    pick_particles(view, request, 0, Executor(wanted.threads), progress, std::move(spent));
  if (wanted.keep_id || base.pieces > 1 || frame.rows != frame.header.rows)
  {
    // those of the rows that were kept
    picked.has_rows = false;
    picked.rows.clear();
  }
  return picked;
}

std::vector<std::int64_t> ids_in_region(const PathFrame& frame, Region region)
{
  std::vector<std::int64_t> ids;
  for (std::size_t i = 0; i < frame.ids.size(); ++i)
  {
    if (contains(region, frame.points.data() + 3 * i))
    {
      ids.push_back(frame.ids[i]);
    }
  }
  return ids;
}

void expect_distinct_ids(const PathFrame& frame,
  const std::function<void(std::int64_t id)>& name_rows, Communicator& ranks)
{
  if (ranks.size() == 1 && IdFinder(frame.ids).repeated() == 0)
  {
    return;
  }
  const auto repeated = IdDirectory(frame.ids, nullptr, ranks).find_repeated(ranks);
  if (!repeated)
  {
    return;
  }
  do_together(ranks,
    [&]
    {
      if (name_rows && ranks.rank() == 0)
      {
        name_rows(repeated->id);
      }
    });
  // those of the frame: other particles may have been left out
  std::vector<std::int64_t> own;
  for (std::size_t i = 0; i < frame.ids.size(); ++i)
  {
    if (frame.ids[i] == repeated->id)
    {
      own.push_back(frame.has_rows ? frame.rows[i] : -1);
    }
  }
  std::vector<std::int64_t> rows;
  for (const std::vector<std::int64_t>& some : gather(ranks, own))
  {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  throw_repeated(repeated->id, frame.header.timestep, rows.at(0), rows.at(1));
}

void throw_repeated(std::int64_t id, std::int64_t timestep, std::int64_t first_row,
  std::int64_t second_row, const Where& where)
{
  throw Error("expected each id once in a frame, got id " + std::to_string(id) + " in rows " +
      std::to_string(first_row) + " and " + std::to_string(second_row) + " of timestep " +
      std::to_string(timestep) + " (rows are counted from 0)",
    where);
}
}
