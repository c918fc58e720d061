// SPDX-License-Identifier: BSD-3-Clause
// Files that were cut anywhere, or claim anything: the right rows, or an error that says where, in bounded memory; and the
// same whether a file was looked at once or while it grew. Other damage is for the fuzz targets.
#include "local_files.h"

#include "../support/memory_file.h"

#include "granular/bytes/compression.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace
{
const std::string tilted_box = "BOX BOUNDS xy xz yz pp pp ff\n0 12 2\n0 11 1\n-1 10 1";

/// A run in one of the forms that there are.
struct Form
{
  const char* name;
  std::vector<std::string> texts; ///< one a file
};

std::vector<Form> forms()
{
  const std::string ends = "x1 y1 z1 x2 y2 z2 id1 id2 dist";
  const std::vector<std::string> lines = { "1 1 1 2 1 1 7 8 1", "9.5 1 1 0.5 1 1 8 12345 9" };
  const std::string ids = "index c_b[1] c_b[2] c_b[3]";
  const std::vector<std::string> bonds = { "1 11 12 -1", "2 12 1e+06 2", "3 13 14 1.5" };
  return {
    { "box", { local_frame(ends, lines, "BOX BOUNDS pp pp ff\n0 10\n0 10\n0 10") } },
    { "tilted", { local_frame(ends, lines, tilted_box) } },
    { "boxless", { local_frame(ids, bonds, "") + local_frame(ids, {}, "", "ENTRIES", 5) } },
    { "label",
      { local_frame("id1 id2", { "1 2" }, "", "BOND IDS", 3) +
        local_frame("id1 id2 btype", { "1 2 3", "2 3 1" }, "", "BOND IDS", 4) } },
    { "time", { "ITEM: UNITS\nlj\nITEM: TIME\n0.5\n" + local_frame("id1 id2", { "1 2" }, "") } },
    { "pieces",
      { local_frame("id1 id2 btype", { "1 2 1" }, "", "BONDS", 5), "3 4 1 \n5 67 1 \n" } },
  };
}

std::string name_of(const std::string& folder, const Form& form, std::size_t file)
{
  return folder + "/" + form.name + "." + std::to_string(file) + ".dump";
}

/// A new file: file systems take their time to write over one.
std::string put(const std::string& name, const std::string& text)
{
  std::filesystem::remove(own_path(name));
  return write_text(name, text);
}

std::vector<std::string> write_all(const std::string& folder, const Form& form)
{
  std::vector<std::string> paths;
  for (std::size_t file = 0; file < form.texts.size(); ++file)
  {
    paths.push_back(put(name_of(folder, form, file), form.texts[file]));
  }
  return paths;
}

/// As many values as rows, and both ends of each line.
void check(const granular::Table& frame)
{
  const auto rows = static_cast<std::size_t>(frame.rows);
  for (const granular::TableArray& array : frame.arrays)
  {
    const bool words = array.info.type == granular::ValueType::Text;
    const std::size_t size = words ? 4 : granular::size_of(array.info.type);
    ASSERT_EQ(array.block.bytes(), rows * array.info.columns.size() * size) << array.info.name;
  }
  ASSERT_EQ(frame.lines.count, frame.has_lines ? frame.rows : 0);
  ASSERT_EQ(frame.lines.points.bytes(), static_cast<std::size_t>(frame.lines.count) * 48);
}

/// All that is in a frame, with the columns as they are named.
std::string content_of(LocalRun& run, std::size_t frame)
{
  const granular::Table local = run.read(frame, {}, granular::name_columns(run.columns(frame)));
  check(local);
  std::string content = std::to_string(run.step(frame)) + " " + std::to_string(local.rows);
  for (const granular::TableArray& array : local.arrays)
  {
    content += " " + array.info.name + " ";
    content.append(static_cast<const char*>(array.block.data()), array.block.bytes());
  }
  return content.append(
    static_cast<const char*>(local.lines.points.data()), local.lines.points.bytes());
}

std::vector<std::string> contents_of(LocalRun& run)
{
  std::vector<std::string> contents;
  for (std::size_t frame = 0; frame < run.size(); ++frame)
  {
    contents.push_back(content_of(run, frame));
  }
  return contents;
}

/// The error of a run that has one of these files.
void expect_place(const granular::Error& error, const std::vector<std::string>& paths)
{
  EXPECT_NE(std::ranges::find(paths, error.where().path), paths.end()) << error.what();
}

/// Whatever the files hold: frames that are what they say, or an error of them.
void read_all(const std::vector<std::string>& paths)
{
  try
  {
    LocalRun run(paths);
    for (std::size_t frame = 0; frame < run.size(); ++frame)
    {
      try
      {
        run.found(frame);
        check(run.read(frame));
      }
      catch (const granular::Error& error)
      {
        expect_place(error, paths);
      }
      try
      {
        content_of(run, frame);
      }
      catch (const granular::Error& error)
      {
        expect_place(error, paths);
        EXPECT_GT(error.where().line, 0) << error.what();
      }
    }
  }
  catch (const granular::Error& error)
  {
    expect_place(error, paths);
  }
}
}

// At work a program has written the first bytes: the frames that are complete, and no others.
TEST(LocalDamage, CutAnywhere)
{
  for (const Form& form : forms())
  {
    SCOPED_TRACE(form.name);
    const std::vector<std::string> paths = write_all("cut", form);
    LocalRun whole(paths);
    const std::vector<std::string> expected = contents_of(whole);
    for (std::size_t cut = 0; cut < paths.size(); ++cut)
    {
      const std::string& text = form.texts[cut];
      put(name_of("cut", form, cut), "");
      LocalRun grown;
      for (std::size_t bytes = 0; bytes <= text.size(); ++bytes)
      {
        SCOPED_TRACE(std::to_string(bytes) + " bytes of file " + std::to_string(cut));
        std::ofstream(paths[cut], std::ios::binary | std::ios::app)
          << text.substr(bytes > 0 ? bytes - 1 : 0, bytes > 0 ? 1 : 0);
        LocalRun once;
        const std::string error = error_of([&] { once.update(paths); });
        EXPECT_EQ(error_of([&] { grown.update(paths); }), error);
        const std::vector<std::string> contents = contents_of(once);
        ASSERT_EQ(contents_of(grown), contents);
        if (cut == 0 && form.texts.size() == 1)
        {
          ASSERT_LE(contents.size(), expected.size());
          EXPECT_TRUE(std::equal(contents.begin(), contents.end(), expected.begin()));
        }
        else if (cut > 0) // of rows without a header nobody knows how many there will be
        {
          const std::string written = text.substr(0, bytes);
          EXPECT_EQ(once.read(0, {}, { "id1", "id2", "btype" }).rows,
            1 + std::count(written.begin(), written.end(), '\n'));
        }
      }
      EXPECT_EQ(contents_of(grown), expected);
    }
  }
}

// A count is a claim: there is no memory for rows that are not there.
TEST(LocalDamage, ClaimsOfAnySize)
{
  const std::int64_t before = restart_peak();
  for (const Form& form : forms())
  {
    SCOPED_TRACE(form.name);
    const std::string& text = form.texts[0];
    LocalRun good({ put("claims/good.dump", text) });
    for (const char* claim :
      { "10000000000000", "9223372036854775807", "9223372036854775808", "1000000000", "-1" })
    {
      const std::string path = "claims/claim.dump";
      const std::size_t at = text.find('\n', text.find("ITEM: NUMBER")) + 1;
      const std::string bad = text.substr(0, at) + claim + text.substr(at + 1);
      for (const bool packed : { false, true })
      {
        const std::string bytes =
          packed ? granular::compress(bad, granular::Compression::Gzip) : bad;
        LocalRun run;
        const std::string error = error_of([&] { run.update({ put(path, bytes) }); });
        EXPECT_TRUE(run.size() == good.size() - 1 || error.starts_with(GRANULAR_OUTPUT))
          << claim << ": " << error;
        read_all({ put(path, bytes) });
      }
    }
  }
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 64 } << 20);
}
