// SPDX-License-Identifier: BSD-3-Clause
// Kept indices of dumps with any of their numbers changed: see index_damage.h. References: the frames that are read
// without any index.
#include "../support/index_damage.h"

#include "../support/binary_dumps.h"
#include "../support/byte_source_packing.h"
#include "../support/frame_content.h"
#include "../support/series.h"

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using index_damage::damage;
using index_damage::Outcomes;

/// Rows of three frames, which differ in all that a header may say.
std::string text_run()
{
  return "ITEM: UNITS\nsi\n" + std::string("ITEM: TIME\n0.5\n") + grains(100, ids_from(1, 5)) +
    "ITEM: TIME\n1.5\n" + grains(200, ids_from(1, 8)) + "ITEM: TIME\n2.5\n" +
    replaced(
      header(300, 3, "id type element v_a word number x y z", "0 2"), "pp pp pp", "ff pp pp") +
    "1 1 Si 1.5 abc 4 1 1 1\n2 1 O 2 d 5 1 1.5 1\n3 2 C 1e10 e 6 1 1 1.25\n";
}

std::string shown(const granular::RunIndex& index, std::size_t frame)
{
  std::string seen;
  for (const int parts : { 1, 2 })
  {
    for (int part = 0; part < parts; ++part)
    {
      granular::DumpRequest request = everything();
      request.piece = part;
      request.pieces = parts;
      request.threads = parts;
      request.chunk_bytes = 64;
      granular::Notices notices;
      granular::Progress progress;
      const granular::DumpFrame got =
        granular::read_dump(index.pieces(frame), request, notices, progress);
      const FrameContent all = content_of(got);
      seen += all.head + std::to_string(all.rows) + "\n";
      for (const std::string& values : all.values)
      {
        seen += values;
      }
    }
  }
  return seen;
}

/// Of the last frame alone, as somebody sees who goes there at once.
std::string last_points(const granular::RunIndex& index, std::size_t frame)
{
  if (frame + 1 < index.size())
  {
    return "";
  }
  granular::Notices notices;
  granular::Progress progress;
  return content_of(granular::read_dump(index.pieces(frame), {}, notices, progress)).values.front();
}

index_damage::Run run_of(const std::vector<std::string>& files)
{
  index_damage::Run run;
  run.files = files;
  run.show = shown;
  return run;
}

std::vector<std::string> split(const std::string& names)
{
  std::istringstream words(names);
  return { std::istream_iterator<std::string>(words), {} };
}

void expect_none(const Outcomes& outcomes)
{
  EXPECT_EQ(outcomes.silent, "");
  EXPECT_GT(outcomes.told, outcomes.errors) << "most is found before a frame is read";
}
}

TEST(IndexDamage, Text)
{
  const Folder folder;
  expect_none(damage(run_of({ folder.write("a.dump", text_run()) })));
}

TEST(IndexDamage, Gzip)
{
  const Folder folder;
  expect_none(damage(run_of({ folder.write("a.dump.gz", packing::gzip(text_run())) })));
}

TEST(IndexDamage, Zstandard)
{
  const Folder folder;
  expect_none(
    damage(run_of({ folder.write("a.dump.zst", packing::zstd_frames(text_run(), 100)) })));
}

// Of a long file the index has windows, which what is behind them is made from. Of 40,000 bytes every thousandth is changed.
TEST(IndexDamage, SeekPoints)
{
  const Folder folder;
  std::string text;
  for (std::int64_t step = 0; step < 4; ++step)
  {
    text += header(step, 30'000);
    for (std::int64_t row = 1; row <= 30'000; ++row)
    {
      text += std::to_string(row) + " 0." + std::to_string(row * 7919 % 100'003 * (step + 1)) +
        " 0.5 0." + std::to_string(row * 104'729 % 99'991) + "\n";
    }
  }
  index_damage::Run run = run_of({ folder.write("a.dump.gz", packing::gzip(text)) });
  run.show = last_points;
  const Outcomes outcomes = damage(run, 997);
  EXPECT_EQ(outcomes.silent, "");
  EXPECT_GT(outcomes.errors, 10);
}

TEST(IndexDamage, Binary)
{
  const Folder folder;
  for (const char* const name : { "DUMPCUSTOM revision 2, little-endian", "plain, little-endian" })
  {
    const binary::Form& form = binary::form(name);
    index_damage::Run run = run_of({ folder.write("a.bin",
      binary::write(form, { binary::grains(form, 1, 5), binary::grains(form, 2, 9) }).bytes) });
    run.options.column_names = split(binary::names_for(form));
    expect_none(damage(run, 3));
  }
}

TEST(IndexDamage, PlainOfDumpAtom)
{
  const Folder folder;
  const binary::Form& form = binary::form("plain, little-endian");
  binary::Frame frame;
  frame.size_one = 5;
  frame.chunks = { { 1, 1, 0.1, 0.2, 0.3, 2, 1, 0.5, 0.25, 0.75 } };
  expect_none(damage(run_of({ folder.write("a.bin", binary::write(form, { frame }).bytes) })));
}

TEST(IndexDamage, Pieces)
{
  const Folder folder;
  const std::string first = grains(0, ids_from(1, 5)) + grains(7, ids_from(1, 3));
  const std::string second = grains(0, ids_from(6, 5)) + grains(7, ids_from(4, 7));
  expect_none(
    damage(run_of({ folder.write("a.0.dump", first), folder.write("a.1.dump", second) }), 3));
}
