// SPDX-License-Identifier: BSD-3-Clause
#include "dump_writing.h"

#include "dumps.h"
#include "thread_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <random>
#include <utility>

using namespace granular;

namespace
{
const void* advanced(const void* data, ValueType type, std::int64_t values)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, sizeof(std::string) };
  return static_cast<const char*>(data) +
    static_cast<std::ptrdiff_t>(sizes[static_cast<std::size_t>(type)]) * values;
}

ArrayView view_of(const std::string& name, ValueType type, const void* data, std::size_t size)
{
  ArrayView view{ name, type, {}, static_cast<std::int64_t>(size) };
  for (std::size_t i = 0; i < size; ++i)
  {
    view.components.push_back(advanced(data, type, static_cast<std::int64_t>(i)));
  }
  return view;
}

void advance(ArrayView& array, std::int64_t rows)
{
  for (const void*& component : array.components)
  {
    component = advanced(component, array.type, rows * array.step);
  }
}

/// What a call throws.
std::string thrown_by(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  catch (const Cancelled&)
  {
    return "cancelled";
  }
  catch (const std::bad_alloc&)
  {
    return "out of memory";
  }
  return "";
}

Written write_as(const std::string& path, const Frames& frames, const DumpFormat& format,
  const WriteOptions& options, Communicator& ranks, Progress& progress)
{
  Written written;
  Notices notices;
  written.error = thrown_by(
    [&]
    {
      DumpWriter writer(path, format, options, ranks);
      for (const FrameView& frame : frames)
      {
        writer.write(frame, notices, progress);
      }
      writer.finish();
    });
  written.said = lines_of(notices);
  return written;
}
}

ReadFrameView::ReadFrameView(Table read)
  : frame(std::move(read))
{
  view.header = frame.header;
  view.rows = frame.rows;
  view.coordinates = frame.coordinates;
  const bool single =
    frame.points.bytes() == 3 * static_cast<std::size_t>(frame.rows) * sizeof(float);
  view.points =
    view_of("points", single ? ValueType::Float32 : ValueType::Float64, frame.points.data(), 3);
  for (const ColumnInfo& column : frame.schema.columns())
  {
    view.columns.push_back(column.name);
  }
  for (const TableArray& array : frame.arrays)
  {
    const void* data = array.block.data();
    if (array.info.type == ValueType::Text)
    {
      std::vector<std::string>& words = texts.emplace_back();
      const auto* indices = static_cast<const std::int32_t*>(data);
      std::transform(indices, indices + frame.rows, std::back_inserter(words),
        [&](std::int32_t index) { return array.words.at(static_cast<std::size_t>(index)); });
      data = words.data();
    }
    view.arrays.push_back(
      view_of(array.info.name, array.info.type, data, array.info.columns.size()));
  }
}

MadeRows::MadeRows(std::int64_t count, const Box& of, unsigned seed)
  : box(of)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> inside(-0.05, 1.05);
  std::uniform_int_distribution<std::int32_t> crossings(-3, 3);
  for (std::int64_t i = 0; i < count; ++i)
  {
    ids.push_back((i * 7919 + 13) % count + 1); // each once where 7919 does not divide count
    types.push_back(static_cast<std::int32_t>(1 + i % 3));
    const double lambda[] = { inside(random), inside(random), inside(random) };
    for (std::size_t k = 0; k < 3; ++k)
    {
      double x = box.origin[k].hi;
      for (std::size_t j = 0; j < 3; ++j)
      {
        x += lambda[j] * box.vectors[j][k].hi;
      }
      points.push_back(x);
      images.push_back(crossings(random));
      v.push_back(std::ldexp(inside(random) - 0.5, crossings(random) * 5));
    }
    radii.push_back(static_cast<float>(0.001 * inside(random) + 0.002));
    words.emplace_back(
      static_cast<std::size_t>(1 + random() % 40), static_cast<char>('A' + i % 26));
  }
}

FrameView MadeRows::view() const
{
  FrameView view;
  view.header.timestep = 100;
  view.header.box = box;
  view.rows = static_cast<std::int64_t>(ids.size());
  view.points = view_rows("points", ValueType::Float64, points.data(), 3);
  view.arrays.push_back(view_rows("id", ValueType::Int64, ids.data()));
  view.arrays.push_back(view_rows("type", ValueType::Int32, types.data()));
  view.arrays.push_back(view_rows("radius", ValueType::Float32, radii.data()));
  view.arrays.push_back(view_rows("v", ValueType::Float64, v.data(), 3));
  view.arrays.push_back(view_rows("image", ValueType::Int32, images.data(), 3));
  view.arrays.push_back(view_rows("element", ValueType::Text, words.data()));
  return view;
}

AtomRows MadeRows::atoms(bool image) const
{
  return { static_cast<std::int64_t>(ids.size()), ids.data(), types.data(), points.data(),
    image ? images.data() : nullptr };
}

Box small_box(bool tilted)
{
  Box box = tilted ? Box::from_tilted_bounds({ -1.5, 0, 2 }, { 12.25, 9, 10.5 }, 2.5, -1.5, 1.25)
                   : Box::from_bounds({ -1.5, 0, 2 }, { 8.5, 7.75, 10.5 });
  box.boundary = "pp fs mm";
  return box;
}

FrameView rows_of(const FrameView& whole, std::int64_t first, std::int64_t count)
{
  FrameView part = whole;
  part.rows = count;
  part.ghosts = whole.ghosts ? whole.ghosts + first : nullptr;
  if (part.points)
  {
    advance(*part.points, first);
  }
  for (ArrayView& array : part.arrays)
  {
    advance(array, first);
  }
  return part;
}

std::vector<Frames> cut(const Frames& whole, const std::vector<std::int64_t>& shares)
{
  std::vector<Frames> ranks(shares.size());
  for (const FrameView& frame : whole)
  {
    std::int64_t first = 0;
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
    {
      if (shares[rank] == knows_nothing)
      {
        ranks[rank].emplace_back();
        continue;
      }
      const std::int64_t left = frame.rows - first;
      const bool last = std::all_of(shares.begin() + static_cast<std::ptrdiff_t>(rank) + 1,
        shares.end(), [](std::int64_t share) { return share <= 0; });
      const std::int64_t rows = last && shares[rank] > 0 ? left : std::min(left, shares[rank]);
      ranks[rank].push_back(rows_of(frame, first, rows));
      first += rows;
    }
  }
  return ranks;
}

Written write_dump(const std::string& path, const Frames& frames, const DumpFormat& format,
  const WriteOptions& options)
{
  SerialCommunicator alone;
  Progress progress;
  Written written = write_as(path, frames, format, options, alone, progress);
  written.bytes = bytes_of_file(path);
  return written;
}

Written write_dump(const std::string& path, const std::vector<Frames>& ranks,
  const DumpFormat& format, const WriteOptions& options, const MakeProgress& make_progress)
{
  std::vector<Written> all(ranks.size());
  run_ranks(static_cast<int>(ranks.size()),
    [&](Communicator& own)
    {
      const auto rank = static_cast<std::size_t>(own.rank());
      const std::unique_ptr<Progress> progress =
        make_progress ? make_progress(own.rank()) : std::make_unique<Progress>();
      all[rank] = write_as(path, ranks[rank], format, options, own, *progress);
    });
  for (const Written& written : all)
  {
    EXPECT_EQ(written.error, all.front().error);
    EXPECT_EQ(written.said, all.front().said);
  }
  all.front().bytes = bytes_of_file(path);
  return all.front();
}

std::string bytes_of_file(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
  {
    return "";
  }
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

std::string difference(const std::string& one, const std::string& other)
{
  if (one == other)
  {
    return "";
  }
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(one, other).in1 - one.begin());
  const std::size_t begin = at < 30 ? 0 : at - 30;
  return "at byte " + std::to_string(at) + " of " + std::to_string(one.size()) + " and " +
    std::to_string(other.size()) + ": '" + one.substr(begin, 80) + "' and '" +
    other.substr(std::min(begin, other.size()), 80) + "'";
}

std::string Form::name() const
{
  return std::string(tilted ? "tilted" : "orthogonal") + (atom.scaled ? " scaled" : "") +
    (atom.image ? " image" : "") + (binary ? " binary" : " text");
}

std::vector<Form> all_forms()
{
  std::vector<Form> forms;
  for (int bits = 0; bits < 16; ++bits)
  {
    forms.push_back({ { (bits & 1) != 0, (bits & 2) != 0 }, (bits & 4) != 0, (bits & 8) != 0 });
  }
  return forms;
}

DumpFormat atom_format(const Form& form, Dialect dialect)
{
  DumpFormat format;
  format.style = DumpStyle::Atom;
  format.dialect = dialect;
  format.binary = form.binary;
  format.atom = form.atom;
  return format;
}
