// SPDX-License-Identifier: BSD-3-Clause
// A frame read by several threads, in chunks of any size, or in parts, is what one thread reads in one
// chunk, to the bit.
#include "../support/binary_dumps.h"
#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/frame_content.h"
#include "../support/series.h"

#include "granular/common/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
using granular::Notices;
using granular::Progress;
using granular::Request;

/// Compares a frame read in all manners with the plain one. bytes is its size.
void expect_same_in_all_manners(const ReadFrame& read, std::size_t bytes)
{
  const std::size_t small = std::max<std::size_t>(64, bytes / 100);
  int manner = 0;
  for (const Request& request : all_requests())
  {
    const Outcome whole = outcome_of(read, plainly(request));
    ASSERT_EQ(whole.error, "");
    for (const auto& [threads, chunk] :
      std::vector<std::pair<int, std::size_t>>{ { 1, small }, { 2, small }, { 5, 1000 }, { 3, 0 } })
    {
      const Request other = chunk > 0 ? in_chunks(request, threads, chunk) : request;
      EXPECT_EQ(outcome_of(read, other).difference(whole), "")
        << "request " << manner << ", " << threads << " threads, chunks of " << chunk;
    }
    for (const int pieces : { 2, 3, 7, manner % 3 == 0 ? 64 : 20 })
    {
      const Request other =
        in_chunks(request, 1 + pieces % 3, pieces > 7 ? std::size_t{ 1 } << 18 : 1000);
      EXPECT_EQ(outcome_of_parts(read, other, pieces).difference(whole), "")
        << "request " << manner << ", " << pieces << " pieces";
    }
    ++manner;
  }
}

void expect_same_in_all_manners(const Dump& dump)
{
  const std::size_t frame = dump.frames() - 1;
  expect_same_in_all_manners(
    [&](const Request& request, Notices& notices)
    {
      Decoded decoded = dump.read(request, frame);
      notices = decoded.notices;
      return std::move(decoded.frame);
    },
    static_cast<std::size_t>(dump.entry(frame).end - dump.entry(frame).offset));
}

}

// ---- real files --------------------------------------------------------------------------------

TEST(FrameParts, RealTexts)
{
  for (const char* const name : { "grains", "ortho_image", "ortho_scaled", "ortho_scaled_image",
         "ortho_unwrapped", "tri_plain", "tri_scaled_image", "tri_unwrapped", "chain" })
  {
    SCOPED_TRACE(name);
    expect_same_in_all_manners(Dump(data_file(std::string("good/") + name + ".dump")));
  }
}

TEST(FrameParts, RealBinaries)
{
  for (const char* const name :
    { "ortho_custom", "ortho_image", "ortho_scaled", "tri_custom", "tri_image", "tri_scaled" })
  {
    SCOPED_TRACE(name);
    expect_same_in_all_manners(Dump(data_file(std::string("good/") + name + ".bin")));
  }
  SCOPED_TRACE("without magic");
  expect_same_in_all_manners(
    Dump(data_file("good/grains.bin"), "id type x y z ix iy iz vx vy vz radius"));
}

TEST(FrameParts, RealCompressed)
{
  for (const char* const name : { "ortho_000000", "ortho_000100", "tri_000050" })
  {
    SCOPED_TRACE(name);
    expect_same_in_all_manners(Dump(data_file(std::string("good/") + name + ".dump.gz")));
  }
  const std::string text = data_file("good/grains_1000.dump");
  expect_same_in_all_manners(Dump(packing::gzip(text)));
  expect_same_in_all_manners(Dump(packing::zstd(text)));
  expect_same_in_all_manners(Dump(packing::zstd_frames(text, 4000)));
  expect_same_in_all_manners(Dump(packing::zstd(data_file("good/ortho_custom.bin"))));
}

namespace
{
/// The last frame of files, as one.
void expect_files_the_same(const Files& files, const std::string& column_names = "")
{
  Series series;
  for (const std::string_view name : granular::split_words(column_names))
  {
    series.options.column_names.emplace_back(name);
  }
  series.options.repeated_steps = granular::RepeatedSteps::Merge;
  series.update(files);
  ASSERT_EQ(series.said, "");
  expect_same_in_all_manners(
    [&](const Request& request, Notices& notices)
    {
      Progress progress;
      return read_dump(series.index.pieces(series.index.size() - 1), request, notices, progress);
    },
    100'000);
}
}

TEST(FrameParts, RealPieces)
{
  Files files;
  for (const char* const process : { "0", "1", "2", "3" })
  {
    for (const char* const step : { "0", "1000", "2000" })
    {
      files.push_back(
        std::string(GRANULAR_DATA) + "/good/pieces_" + step + "." + process + ".dump");
    }
  }
  expect_files_the_same(files);
}

/// Pieces packed in different manners, one of them without rows, and one of them plain.
TEST(FrameParts, PackedPieces)
{
  const Folder folder;
  Files files;
  for (const int process : { 0, 1, 2, 3, 4 })
  {
    const std::string name = "a." + std::to_string(process) + ".dump";
    const std::string text =
      particles(7, process == 2 ? Ids{} : ids_from(100 * process, 50 + 40 * process));
    files.push_back(process == 0 ? folder.write(name, text)
        : process % 2 == 1       ? folder.write(name + ".gz", packing::gzip(text))
                                 : folder.write(name + ".zst", packing::zstd(text)));
  }
  expect_files_the_same(files);
}

TEST(FrameParts, BinaryPieces)
{
  const Folder folder;
  const binary::Form& form = binary::form("plain, little-endian");
  Files files;
  for (const int process : { 0, 1, 2 })
  {
    binary::Frame frame = binary::particles(form, 3, process == 1 ? 0 : 20 + process);
    frame.box = { 0, 1, 0, 1, 0, 1 };
    files.push_back(
      folder.write("a." + std::to_string(process) + ".bin", binary::write(form, { frame }).bytes));
  }
  expect_files_the_same(files, binary::particle_columns);
}

// ---- hand-made files ---------------------------------------------------------------------------

namespace
{
/// Any number of threads, chunks of any size from one byte on, and more and more parts.
void expect_same_in_small_chunks(const std::string& bytes, const std::string& names = "")
{
  const Dump dump(bytes, names);
  ASSERT_GE(dump.frames(), 1u);
  const ReadFrame read = [&](const Request& request, Notices& notices)
  {
    Decoded decoded = dump.read(request);
    notices = decoded.notices;
    return std::move(decoded.frame);
  };
  for (Request request : { everything(), all_requests()[3], all_requests()[8] })
  {
    const Outcome whole = outcome_of(read, plainly(request));
    ASSERT_EQ(whole.error, "");
    for (std::size_t chunk = 1; chunk < std::min<std::size_t>(bytes.size() + 2, 260);
         chunk += chunk < 40 ? 1 : 11)
    {
      const int threads = 1 + static_cast<int>(chunk % 3);
      ASSERT_EQ(outcome_of(read, in_chunks(request, threads, chunk)).difference(whole), "")
        << threads << " threads, chunks of " << chunk << "\n"
        << bytes.substr(0, 1000);
    }
    for (int pieces = 1; pieces < 40; ++pieces)
    {
      ASSERT_EQ(outcome_of_parts(read, in_chunks(request, 1, 37), pieces).difference(whole), "")
        << pieces << " pieces\n"
        << bytes.substr(0, 1000);
    }
  }
}

/// The ids of all parts must be these, whoever decodes them.
void expect_ids(const std::string& bytes, const Ids& ids)
{
  const Dump dump(bytes);
  EXPECT_EQ(dump.read(in_chunks({}, 3, 16)).integers("id"), ids);
  Ids of_parts;
  for (int piece = 0; piece < 5; ++piece)
  {
    Request request = in_chunks({}, 2, 16);
    request.piece = piece;
    request.pieces = 5;
    const Ids part = dump.read(request).integers("id");
    of_parts.insert(of_parts.end(), part.begin(), part.end());
  }
  EXPECT_EQ(of_parts, ids);
}

constexpr const char* three_rows = "1 0.5 0.25 0 wet\n2 0.75 1e-3 0 dry\n3 1 0.5 0 wet\n";
}

TEST(FrameParts, TextsOfAllForms)
{
  const std::string plain = one_frame("id x y z state", three_rows);
  const std::string blank_lines =
    replaced(plain, "2 0.75", "\n \t\n\r\n2 0.75") + "\n\n   \n \t \r\n\n";
  for (const std::string& text : { plain, replaced(plain, "\n", "\r\n"),
         replaced(plain, " 0", "\t0"), replaced(plain, " 0 ", "    0\t\t "), blank_lines,
         replaced(blank_lines, "\n", "\r\n"), replaced(plain, "wet", "wet # words 1 2 3"),
         replaced(plain, "\n2", "\n  2"), replaced(plain, "\n2", "\n" + std::string(1, '\0') + "2"),
         plain + replaced(plain, "TIMESTEP\n0", "TIMESTEP\n5") })
  {
    expect_same_in_small_chunks(text);
    expect_ids(text, { 1, 2, 3 });
  }
}

TEST(FrameParts, NoRowsAndOneRow)
{
  expect_same_in_small_chunks(one_frame("id x y z", ""));
  expect_ids(one_frame("id x y z", ""), {});
  expect_same_in_small_chunks(one_frame("id x y z", "7 0 0 0\n"));
  expect_ids(one_frame("id x y z", "7 0 0 0\n"), { 7 });
  expect_same_in_small_chunks(one_frame("id x y z", "7 0 0 0\n") + "\n\n");
}

TEST(FrameParts, RowsLongerThanAChunk)
{
  std::string rows;
  for (int id = 1; id <= 12; ++id)
  {
    rows += std::to_string(id) + " 0 0 0" + std::string(id % 4 == 0 ? 3000 : 1, ' ') + "1\n";
  }
  const std::string text = one_frame("id x y z type", rows);
  expect_ids(text, ids_from(1, 12));
  expect_same_in_small_chunks(text);
}

TEST(FrameParts, ARowOfAMebibyte)
{
  const std::string blanks(std::size_t{ 1 } << 20, ' ');
  const std::string rows = "1 0 0 0 a\n2 0 0 0" + blanks + "b\n3 0 0 0 c\n";
  const Dump dump(one_frame("id x y z state", rows));
  for (const std::size_t chunk : { 1u << 14, 1u << 18, (1u << 20) + 100, 1u << 30 })
  {
    for (const int threads : { 1, 3 })
    {
      const Decoded decoded = dump.read(in_chunks({}, threads, chunk));
      EXPECT_EQ(decoded.integers("id"), Ids({ 1, 2, 3 }));
      EXPECT_EQ(decoded.texts("state"), std::vector<std::string>({ "a", "b", "c" }));
    }
  }
}

/// The longest row there may be, and one byte more.
TEST(FrameParts, TheLongestRow)
{
  constexpr std::size_t longest = std::size_t{ 1 } << 22;
  const std::string fits(longest - std::string("2 0 0 0b").size(), ' ');
  const Dump good(one_frame("id x y z state", "1 0 0 0 a\n2 0 0 0" + fits + "b\n3 0 0 0 c\n"));
  const Dump bad(one_frame("id x y z state", "1 0 0 0 a\n2 0 0 0" + fits + " b\n3 0 0 0 c\n"));
  for (const std::size_t chunk : { std::size_t{ 1 } << 18, std::size_t{ 3'000'000 },
         std::size_t{ 1 } << 22, std::size_t{ 1 } << 40, ~std::size_t{} })
  {
    const Request request = in_chunks({}, 2, chunk);
    EXPECT_EQ(good.read(request).integers("id"), Ids({ 1, 2, 3 }));
    EXPECT_EQ(
      bad.error(request), "memory:11: expected a row of at most 4194304 bytes, got a longer one");
  }
}

/// More rows in a part than its share of the bytes promises: the memory is made anew.
TEST(FrameParts, RowsOfVeryDifferentLengths)
{
  std::string rows;
  for (int id = 1; id <= 12'000; ++id)
  {
    rows += std::to_string(id) + " 0 0 0\n";
  }
  for (int id = 12'001; id <= 12'200; ++id)
  {
    rows += std::to_string(id) + " 0 0 0" + std::string(900, ' ') + "\n";
  }
  const Dump dump(one_frame("id x y z", rows));
  const ReadFrame read = [&](const Request& request, Notices&) { return dump.read(request).frame; };
  for (const Request& request : all_requests())
  {
    const Outcome whole = outcome_of(read, plainly(request));
    EXPECT_EQ(outcome_of_parts(read, in_chunks(request, 3, 5000), 2).difference(whole), "");
  }
}

TEST(FrameParts, WordsInTheOrderOfTheirFirstRow)
{
  std::string rows;
  for (int row = 0; row < 400; ++row)
  {
    // new words come all along, old ones again
    rows += "0 0 0 w" + std::to_string(row * row % 50 + row / 40) + "\n";
  }
  const Dump dump(one_frame("x y z state", rows));
  const Decoded plain = dump.read(plainly({}));
  std::vector<std::string> first;
  for (const std::string& text : plain.texts("state"))
  {
    if (std::ranges::find(first, text) == first.end())
    {
      first.push_back(text);
    }
  }
  EXPECT_EQ(plain.frame.arrays.at(0).words, first);
  for (const int threads : { 1, 4 })
  {
    EXPECT_EQ(dump.read(in_chunks({}, threads, 50)).frame.arrays.at(0).words, first);
  }
}

/// Every n-th row of the frame, not of the part.
TEST(FrameParts, StrideWithoutIdsCountsTheRowsOfTheFrame)
{
  std::string rows;
  for (int row = 0; row < 100; ++row)
  {
    rows += std::to_string(row) + " 0 0\n" + (row % 7 == 0 ? " \n" : "");
  }
  const Dump dump(replaced(one_frame("x y z", rows), "ATOMS\n115\n", "ATOMS\n100\n"));
  std::vector<double> expected;
  for (int row = 0; row < 100; row += 9)
  {
    expected.insert(expected.end(), { static_cast<double>(row), 0, 0 });
  }
  for (const int pieces : { 1, 2, 5, 33 })
  {
    std::vector<double> points;
    for (int piece = 0; piece < pieces; ++piece)
    {
      Request request = in_chunks({}, 1 + piece % 3, 40);
      request.stride = 9;
      request.piece = piece;
      request.pieces = pieces;
      const std::vector<double> part = dump.read(request).points();
      points.insert(points.end(), part.begin(), part.end());
    }
    EXPECT_EQ(points, expected) << pieces;
  }
}

TEST(FrameParts, BinaryRunsOfAllSizes)
{
  for (const binary::Form& form : binary::forms())
  {
    SCOPED_TRACE(form.name);
    binary::Frame frame = binary::particles(form, 1, 40);
    std::vector<double> values;
    for (const std::vector<double>& chunk : frame.chunks)
    {
      values.insert(values.end(), chunk.begin(), chunk.end());
    }
    frame.chunks = { {}, {} };
    std::size_t row = 0;
    for (const std::size_t rows : { 1u, 0u, 2u, 7u, 0u, 0u, 1u, 1u, 16u, 3u, 9u, 0u })
    {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(12 * row);
      frame.chunks.emplace_back(first, first + static_cast<std::ptrdiff_t>(12 * rows));
      row += rows;
    }
    ASSERT_EQ(row, 40u);
    const binary::Bytes bytes = binary::write(form, { frame });
    const Dump dump(bytes.bytes, binary::names_for(form));
    const ReadFrame read = [&](const Request& request, Notices&)
    { return dump.read(request).frame; };
    EXPECT_EQ(dump.read(in_chunks({}, 3, 100)).values("id"), frame.values(0));
    for (const Request& request : all_requests())
    {
      const Outcome whole = outcome_of(read, plainly(request));
      ASSERT_EQ(whole.error, "");
      for (const std::size_t rows : { 1u, 2u, 5u, 16u, 39u, 40u })
      {
        EXPECT_EQ(outcome_of(read, in_chunks(request, 3, 96 * rows)).difference(whole), "") << rows;
        EXPECT_EQ(outcome_of_parts(read, in_chunks(request, 2, 96 * rows), static_cast<int>(rows))
                    .difference(whole),
          "")
          << rows;
      }
    }
  }
}

TEST(FrameParts, APieceThatIsNone)
{
  const Dump dump(one_frame("id x y z", "7 0 0 0\n"));
  Request request;
  request.pieces = 3;
  for (const int piece : { -1, 3 })
  {
    request.piece = piece;
    EXPECT_EQ(
      dump.error(request), "expected a piece from 0 to below 3, got " + std::to_string(piece));
  }
}
