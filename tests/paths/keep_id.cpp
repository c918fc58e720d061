// SPDX-License-Identifier: BSD-3-Clause
// Particles chosen by their ids while a dump is read: those that a whole reading has, and no others.
#include "../support/binary_dumps.h"
#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/series.h"

#include "granular/paths/path_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

using namespace granular;

namespace
{
using Keep = std::function<bool(std::int64_t)>;

/// The rows of a decoded frame as text, all arrays and points.
std::vector<std::string> rows_of(const Decoded& decoded)
{
  std::vector<std::string> rows(static_cast<std::size_t>(decoded.rows()));
  const auto add = [&](const auto& values)
  {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      std::ostringstream text;
      text.precision(17);
      text << values[i] << ' ';
      rows[i / (values.size() / rows.size())] += text.str();
    }
  };
  for (const TableArray& array : decoded.frame.arrays)
  {
    if (array.info.type == ValueType::Text)
    {
      add(decoded.texts(array.info.name));
    }
    else
    {
      add(decoded.values(array.info.name));
    }
  }
  if (decoded.frame.points.data())
  {
    add(decoded.points());
  }
  return rows;
}

/// Reads with keep_id, in many ways, what a whole reading has of those rows.
void check(const Dump& dump, const Keep& keep, std::size_t frame = 0)
{
  Request request;
  const Decoded whole = dump.read(request, frame);
  const std::vector<std::string> all = rows_of(whole);
  const std::vector<std::int64_t> ids = whole.integers("id");
  std::vector<std::string> expected;
  for (std::size_t row = 0; row < all.size(); ++row)
  {
    if (keep(ids[row]))
    {
      expected.push_back(all[row]);
    }
  }
  request.keep_id = keep;
  for (const int threads : { 1, 2, 5 })
  {
    for (const std::size_t chunk :
      { std::size_t{ 200 }, std::size_t{ 5000 }, std::size_t{ 1 } << 18 })
    {
      request.threads = threads;
      request.chunk_bytes = chunk;
      EXPECT_EQ(rows_of(dump.read(request, frame)), expected) << threads << " " << chunk;
    }
    std::vector<std::string> parts;
    for (request.pieces = 3, request.piece = 0; request.piece < 3; ++request.piece)
    {
      for (const std::string& row : rows_of(dump.read(request, frame)))
      {
        parts.push_back(row);
      }
    }
    request.piece = 0;
    request.pieces = 1;
    EXPECT_EQ(parts, expected) << threads;
  }
  // together with others that choose
  std::vector<std::string> fewer;
  for (std::size_t row = 0; row < all.size(); ++row)
  {
    if (keep(ids[row]) && ids[row] % 3 == 0)
    {
      fewer.push_back(all[row]);
    }
  }
  request.stride = 3;
  EXPECT_EQ(rows_of(dump.read(request, frame)), fewer);
  // the ids themselves need not be wanted
  request.wanted = [](std::string_view name, bool) { return name == "type"; };
  const Decoded without = dump.read(request, frame);
  EXPECT_FALSE(without.has("id"));
  EXPECT_EQ(without.rows(), std::ssize(fewer));
}

void check_all(const Dump& dump, std::size_t frame = 0)
{
  check(
    dump, [](std::int64_t id) { return id % 5 == 2; }, frame);
  check(
    dump, [](std::int64_t) { return true; }, frame);
  check(
    dump, [](std::int64_t) { return false; }, frame);
  check(
    dump, [](std::int64_t id) { return id == 17; }, frame);
}

/// Two thousand rows with words of this form as ids.
std::string text_of(const std::function<std::string(int)>& id)
{
  std::string rows;
  for (int i = 0; i < 2000; ++i)
  {
    rows += id(i) + " 1 0." + std::to_string(1000 + i) + " 0.5 0.25\n";
  }
  return one_frame("id type x y z", rows);
}
}

TEST(KeepId, TextsAndBinaries)
{
  check_all(Dump(data_file("good/grains.dump")), 0); // no particles
  check_all(Dump(data_file("good/grains.dump")), 2);
  check_all(Dump(data_file("good/ortho_image.dump")), 1);
  check_all(Dump(data_file("good/tri_unwrapped.dump")), 1);
  check_all(Dump(data_file("good/ortho_custom.bin")), 1);
  check_all(Dump(data_file("good/grains.bin"), "id type x y z ix iy iz vx vy vz radius"), 2);
  check_all(Dump(data_file("good/tri_000050.dump.gz")));
  check_all(Dump(packing::zstd_frames(data_file("good/grains_1000.dump"), 4000)));
}

TEST(KeepId, BinariesOfAllForms)
{
  for (const binary::Form& form : binary::forms())
  {
    SCOPED_TRACE(form.name);
    const binary::Bytes bytes = binary::write(form, { binary::particles(form, 5, 90) });
    const Dump dump(bytes.bytes, binary::names_for(form));
    if (dump.read().has("id"))
    {
      check(dump, [](std::int64_t id) { return id % 2 == 0; });
    }
  }
}

/// Ids up to the ends of 64 bits.
TEST(KeepId, LargeIds)
{
  const std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  const Dump large(
    text_of([=](int i) { return std::to_string(i % 2 == 0 ? highest - i : -highest + i); }));
  check(large, [=](std::int64_t id) { return id > highest - 100 || id == -highest + 1; });
}

/// A column of which one number is no integer holds no ids.
TEST(KeepId, IdsThatAreNone)
{
  const binary::Form& form = binary::form("plain, little-endian");
  binary::Frame frame = binary::particles(form, 5, 9);
  frame.chunks[0][12] = 7.5;
  const Dump dump(binary::write(form, { frame }).bytes, binary::names_for(form));
  Request request;
  request.keep_id = [](std::int64_t) { return true; };
  const Decoded decoded = dump.read(request);
  EXPECT_EQ(decoded.type("id"), ValueType::Float64);
  EXPECT_EQ(decoded.rows(), 0);
  EXPECT_NE(decoded.said().find("column 'id': expected an integer, got '7.5'"), std::string::npos);
}

TEST(KeepId, WithoutIdsNoneIsKept)
{
  const Dump dump(one_frame("type x y z", "1 0.5 0.5 0.5\n2 0.25 0.5 0.5\n"));
  Request request;
  request.keep_id = [](std::int64_t) { return true; };
  EXPECT_EQ(dump.read(request).rows(), 0);
}

/// Of rows that stay away, only ids are looked at: their other words decide nothing. The number of words still counts.
TEST(KeepId, WordsOfOthersNeedNotBeNumbers)
{
  const auto rows_with = [](const std::string& other)
  {
    std::string rows;
    for (int i = 0; i < 900; ++i)
    {
      rows += std::to_string(i) + (i % 3 == 1 ? other : " 4 0.5 0.25 0.125") + "\n";
    }
    std::string text = one_frame("id type x y z", rows);
    return text.replace(text.find("\n51 "), 1, "\n \t\n\n");
  };
  Request request;
  request.keep_id = [](std::int64_t id) { return id % 3 == 0; };
  const std::vector<std::string> expected =
    rows_of(Dump(rows_with(" 4 0.5 0.25 0.125")).read(request));
  ASSERT_EQ(expected.size(), 300U);
  for (const std::string other : { " 4.5 0.5 0.25 0.125", " 4 0.5 word 0.125", " a b c d" })
  {
    const Dump dump(rows_with(other));
    for (const int threads : { 1, 3 })
    {
      request.threads = threads;
      request.chunk_bytes = 400;
      const Decoded found = dump.read(request);
      EXPECT_EQ(rows_of(found), expected) << other;
      EXPECT_EQ(found.type("type"), ValueType::Int32) << other;
      EXPECT_EQ(found.said(), "") << other;
    }
    Request others = request;
    others.keep_id = [](std::int64_t id) { return id % 3 == 1; };
    const std::string error = error_of([&] { dump.read(others); });
    EXPECT_EQ(
      error.find("memory:11: column 'y': expected a number, got 'word'") != std::string::npos,
      other.find("word") != std::string::npos)
      << error;
  }
  const std::string error = error_of([&] { Dump(rows_with(" 4 0.5 0.25")).read(request); });
  EXPECT_NE(error.find("expected 5 words in a row, got 4"), std::string::npos) << error;
}

/// Rows that are chosen by a stride are chosen in the same way.
TEST(KeepId, WordsOfRowsBetweenNeedNotBeNumbers)
{
  const Dump dump(one_frame("id x y z", "1 a 0 0\n2 0.5 0 0\n4 0.25 0 0\n3 b 0 0\n"));
  Request request;
  request.stride = 2;
  EXPECT_EQ(dump.read(request).integers("id"), (std::vector<std::int64_t>{ 2, 4 }));
}

// ---- particles for paths -----------------------------------------------------------------------

namespace
{
PathFrame particles_of(const std::string& file, const PathRequest& request,
  const Request& base = {}, PathFrame spent = {})
{
  Series run;
  run.update({ file });
  Progress progress;
  Notices notices;
  return read_particles(
    run.index.pieces(run.index.size() - 1), request, base, notices, progress, std::move(spent));
}
}

TEST(ReadParticles, OnlyWhatIsWanted)
{
  const std::string file = std::string(GRANULAR_DATA) + "/good/ortho_image.dump";
  const Decoded whole = Dump(data_file("good/ortho_image.dump")).read({}, 1);
  const std::vector<std::int64_t> ids = whole.integers("id");
  const std::vector<std::int64_t> images = whole.integers("image");
  const std::vector<double> points = whole.points();
  for (const char* text : { "", "5, 100-200:7 499-1000" })
  {
    for (const int pieces : { 1, 4 })
    {
      const PathRequest request{ IdSelection(text), { "type", "image", "mass" } };
      PathFrame expected;
      PathFrame found;
      Request base;
      base.pieces = pieces;
      base.threads = pieces;
      for (base.piece = 0; base.piece < pieces; ++base.piece)
      {
        const PathFrame part = particles_of(file, request, base);
        EXPECT_TRUE(part.loaded);
        EXPECT_EQ(part.has_images, !part.ids.empty());
        EXPECT_EQ(part.has_rows, pieces == 1 && request.selection.is_all());
        EXPECT_EQ(part.header.timestep, 100);
        EXPECT_EQ(part.header.box.boundary, "pp pp pp");
        ASSERT_EQ(part.arrays.size(), 3U);
        EXPECT_EQ(part.arrays[2].size, 0);
        found.ids.insert(found.ids.end(), part.ids.begin(), part.ids.end());
        found.points.insert(found.points.end(), part.points.begin(), part.points.end());
        found.images.insert(found.images.end(), part.images.begin(), part.images.end());
        EXPECT_EQ(part.arrays[1].words, part.images);
        EXPECT_TRUE(part.arrays[1].integers);
      }
      for (std::size_t row = 0; row < ids.size(); ++row)
      {
        if (request.selection.holds(ids[row]))
        {
          expected.ids.push_back(ids[row]);
          expected.points.insert(expected.points.end(),
            points.begin() + 3 * static_cast<std::ptrdiff_t>(row),
            points.begin() + 3 * static_cast<std::ptrdiff_t>(row) + 3);
          expected.images.insert(expected.images.end(),
            images.begin() + 3 * static_cast<std::ptrdiff_t>(row),
            images.begin() + 3 * static_cast<std::ptrdiff_t>(row) + 3);
        }
      }
      EXPECT_EQ(found.ids, expected.ids);
      EXPECT_EQ(found.points, expected.points);
      EXPECT_EQ(found.images, expected.images);
    }
  }
}

/// Rows are those of the file, or not known.
TEST(ReadParticles, RowsOfTheFile)
{
  const std::string file = std::string(GRANULAR_DATA) + "/good/ortho_image.dump";
  Request base;
  PathFrame frame = particles_of(file, {}, base);
  ASSERT_TRUE(frame.has_rows);
  EXPECT_EQ(frame.rows.back(), 499);
  base.region = { 0, 3, 1, -1, 1, -1 };
  frame = particles_of(file, {}, base);
  EXPECT_LT(frame.ids.size(), 400U);
  EXPECT_FALSE(frame.has_rows);
  base = {};
  base.stride = 2;
  EXPECT_FALSE(particles_of(file, {}, base).has_rows);
}

/// What a frame before had leaves nothing behind.
TEST(ReadParticles, MemoryOfSpentFrames)
{
  const std::string file = std::string(GRANULAR_DATA) + "/good/ortho_image.dump";
  const std::vector<PathRequest> requests = { { {}, { "type", "image" } },
    { IdSelection("7-90:3"), { "image" } }, { {}, { "mass", "type" }, false }, { {}, {} } };
  Request unwrapped;
  unwrapped.coordinates = Coordinates::Unwrapped;
  PathFrame spent;
  for (int round = 0; round < 2; ++round)
  {
    for (const PathRequest& request : requests)
    {
      for (const Request& base : { Request(), unwrapped })
      {
        const PathFrame fresh = particles_of(file, request, base);
        spent = particles_of(file, request, base, std::move(spent));
        EXPECT_EQ(spent.ids, fresh.ids);
        EXPECT_EQ(spent.has_rows, fresh.has_rows);
        EXPECT_EQ(spent.rows, fresh.rows);
        EXPECT_EQ(spent.points, fresh.points);
        EXPECT_EQ(spent.has_images, fresh.has_images);
        EXPECT_EQ(spent.images, fresh.images);
        ASSERT_EQ(spent.arrays.size(), fresh.arrays.size());
        for (std::size_t i = 0; i < fresh.arrays.size(); ++i)
        {
          EXPECT_EQ(spent.arrays[i].name, fresh.arrays[i].name);
          EXPECT_EQ(spent.arrays[i].size, fresh.arrays[i].size);
          EXPECT_EQ(spent.arrays[i].integers, fresh.arrays[i].integers);
          EXPECT_EQ(spent.arrays[i].words, fresh.arrays[i].words);
        }
      }
    }
  }
}

TEST(ReadParticles, WithoutPoints)
{
  PathRequest request{ {}, { "type" }, false };
  const PathFrame frame =
    particles_of(std::string(GRANULAR_DATA) + "/good/ortho_image.dump", request);
  EXPECT_EQ(frame.ids.size(), 500U);
  EXPECT_TRUE(frame.points.empty() && frame.images.empty() && !frame.has_images);
  EXPECT_EQ(frame.arrays[0].words.size(), 500U);
}

TEST(ReadParticles, FilesWithoutIds)
{
  const Folder folder;
  const std::string file = folder.write("none.dump", one_frame("type x y z", "1 0.5 0.5 0.5\n"));
  for (const char* ids : { "", "1-100" })
  {
    const std::string error = ::error_of([&] { particles_of(file, { IdSelection(ids), {} }); });
    EXPECT_NE(error.find(": paths need ids"), std::string::npos) << error;
  }
  const std::string empty = folder.write("empty.dump", one_frame("type x y z", ""));
  EXPECT_TRUE(particles_of(empty, {}).ids.empty());
}
