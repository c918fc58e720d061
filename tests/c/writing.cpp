// SPDX-License-Identifier: BSD-3-Clause
// Files that are written through the C interface: that of a real run gets its bytes back, and arrays of a program the text that
// it expects.
#include "handles.h"

#include <array>
#include <filesystem>
#include <iterator>

namespace
{
namespace fs = std::filesystem;

std::string output(const std::string& name)
{
  return std::string(GRANULAR_OUTPUT) + "/" + name;
}

granular_array numbers(const char* name, const std::vector<double>& values, int components = 1)
{
  return { name, GRANULAR_FLOAT64, components,
    static_cast<std::int64_t>(values.size()) / components, values.data(), nullptr, 0, "", "", "",
    nullptr };
}
}

TEST(CWriting, AFileOfARealRunGetsItsBytesBack)
{
  const RunHandle run = open_run(good("grains.dump"));
  granular_writer* writer = nullptr;
  ASSERT_EQ(granular_create(output("grains.dump").c_str(), nullptr, &writer), GRANULAR_OK);
  for (const std::int64_t i : { 0, 1, 2 })
  {
    ASSERT_EQ(granular_write_frame(writer, read_frame(run, i).get()), GRANULAR_OK) << message();
  }
  ASSERT_EQ(granular_finish(writer), GRANULAR_OK) << message();
  EXPECT_EQ(content(output("grains.dump")), content(good("grains.dump")));
}

TEST(CWriting, ArraysOfAProgram)
{
  const std::vector<double> x = { 0.5, 1, 1.5, 2, 2.5, 0.1 };
  const std::vector<double> v = { 1, 0, 0, 0, -1e-300, 3 };
  const std::vector<std::int32_t> id = { 7, 5 };
  const std::vector<std::int32_t> word = { 1, 0 };
  const char* const words[] = { "Cu", "Fe" };
  const granular_array arrays[] = { numbers("points", x, 3), numbers("v", v, 3),
    { "id", GRANULAR_INT32, 1, 2, id.data(), nullptr, 0, "", "", "", nullptr },
    { "element", GRANULAR_TEXT, 1, 2, word.data(), words, 2, "", "", "", nullptr } };
  const granular_box box = { {}, 0, { 0, 0, 0 }, { 3, 0, 0, 0, 4, 0, 0, 0, 5 }, "pp pp ff" };
  granular_content content_of;
  granular_content_init(&content_of);
  content_of.timestep = 42;
  content_of.box = &box;
  content_of.rows = 2;
  content_of.arrays = arrays;
  content_of.array_count = 4;
  granular_format format;
  granular_format_init(&format);
  format.dialect = "LIGGGHTS";
  format.columns = "id element x y z v";
  format.sort_by_id = 1;
  granular_writer* writer = nullptr;
  ASSERT_EQ(granular_create(output("mine.dump").c_str(), &format, &writer), GRANULAR_OK);
  ASSERT_EQ(granular_write(writer, &content_of), GRANULAR_OK) << message();
  ASSERT_EQ(granular_finish(writer), GRANULAR_OK) << message();
  EXPECT_EQ(content(output("mine.dump")),
    "ITEM: TIMESTEP\n42\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n0 3\n0 4\n0 5\n"
    "ITEM: ATOMS id element x y z vx vy vz \n5 Cu 2 2.5 0.1 0 -1e-300 3 \n7 Fe 0.5 1 1.5 1 0 0 \n");
}

// A frame that fails in its middle would leave a part of it in the file.
TEST(CWriting, NothingFollowsAFrameThatFailed)
{
  const std::string path = output("failed.dump");
  std::ofstream(path) << "the old file";
  const RunHandle run = open_run(good("grains.dump"));
  const FrameHandle frame = read_frame(run, -1);
  granular_format format;
  granular_format_init(&format);
  format.progress = [](double fraction, void*) { return fraction > 0.2 ? 1 : 0; };
  granular_writer* writer = nullptr;
  ASSERT_EQ(granular_create(path.c_str(), &format, &writer), GRANULAR_OK);
  EXPECT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_CANCELLED);
  EXPECT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_BAD_ARGUMENT);
  EXPECT_NE(message().find("failed in a frame before"), std::string::npos) << message();
  EXPECT_NE(granular_finish(writer), GRANULAR_OK);
  EXPECT_EQ(content(path), "the old file");
}

TEST(CWriting, AFrameOfAnotherKind)
{
  const RunHandle run = open_run(good("grains.dump"));
  const FrameHandle frame = read_frame(run, -1);
  granular_writer* writer = nullptr;
  ASSERT_EQ(granular_create(output("other.bonds").c_str(), nullptr, &writer), GRANULAR_OK);
  EXPECT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(message(), "expected a frame of lines for this style, got one of particles");
  granular_abandon(writer);
}

// Also where the program does not look at what a frame returned.
TEST(CWriting, AnErrorLeavesTheOldFile)
{
  granular_writer* writer = nullptr;
  for (const std::string name : { "old.dump", "old.bonds", "old.euler", "old.decomposition" })
  {
    const std::string path = output(name);
    std::ofstream(path) << "the old file";
    granular_content nothing;
    granular_content_init(&nothing);
    nothing.rows = 3;
    for (const bool ends : { false, true })
    {
      ASSERT_EQ(granular_create(path.c_str(), nullptr, &writer), GRANULAR_OK);
      EXPECT_NE(granular_write(writer, &nothing), GRANULAR_OK) << name;
      if (ends)
      {
        EXPECT_EQ(granular_finish(writer), GRANULAR_BAD_ARGUMENT) << name;
        EXPECT_EQ(message(),
          path +
            ": expected a writer whose frames are whole, got one that failed in a frame before");
      }
      else
      {
        granular_abandon(writer);
      }
      EXPECT_EQ(content(path), "the old file") << name;
    }
    ASSERT_EQ(granular_create(path.c_str(), nullptr, &writer), GRANULAR_OK);
    EXPECT_EQ(granular_finish(writer), GRANULAR_BAD_ARGUMENT) << name;
    EXPECT_EQ(message(), path + ": expected at least one frame, got none");
    EXPECT_EQ(content(path), "the old file") << name;
  }
  EXPECT_EQ(granular_create(output("gone/a.dump").c_str(), nullptr, &writer), GRANULAR_IO_ERROR);
  EXPECT_EQ(writer, nullptr);
  for (const auto& entry : fs::directory_iterator(GRANULAR_OUTPUT))
  {
    EXPECT_EQ(entry.path().filename().string().find(".granular"), std::string::npos)
      << entry.path();
  }
}

// Readers would show one of them.
TEST(CWriting, TwoFramesOfOneTimestep)
{
  granular_format format;
  granular_format_init(&format);
  for (const auto& [from, to, dialect] : { std::array{ "grains.dump", "twice.dump", "" },
         std::array{ "euler_4000.vtk", "twice_*.euler", "" },
         std::array{ "decomposition_1000.vtk", "twice.decomposition", "PUBLIC" } })
  {
    format.dialect = dialect;
    const RunHandle run = open_run(good(from));
    const FrameHandle frame = read_frame(run, 0);
    granular_writer* writer = nullptr;
    ASSERT_EQ(granular_create(output(to).c_str(), &format, &writer), GRANULAR_OK) << message();
    ASSERT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_OK) << message();
    EXPECT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_BAD_ARGUMENT) << to;
    EXPECT_NE(message().find("expected a timestep of its own for each frame"), std::string::npos)
      << message();
    granular_abandon(writer);
  }
}

// As programs may write them: in place, or as others that get the name.
TEST(CWriting, FilesThatAProgramWritesItself)
{
  const std::string folder = output("own");
  fs::remove_all(folder);
  fs::create_directory(folder);
  const std::string paths[] = { folder + "/a", folder + "/b" };
  std::ofstream(paths[0]) << "old";
  fs::permissions(paths[0], fs::perms::owner_read | fs::perms::owner_write);
  for (const bool finished : { false, true })
  {
    granular_file* files[2] = {};
    for (int i = 0; i < 2; ++i)
    {
      ASSERT_EQ(granular_begin_file(paths[i].c_str(), &files[i]), GRANULAR_OK) << message();
    }
    std::ofstream(granular_file_name(files[0])) << "new a";
    std::ofstream(folder + "/other") << "new b";
    fs::rename(folder + "/other", granular_file_name(files[1]));
    EXPECT_EQ(granular_hold_file(files[1], 0), GRANULAR_OK) << message();
    EXPECT_EQ(content(paths[0]), "old");
    if (finished)
    {
      EXPECT_EQ(granular_finish_files(files, 2, 1), GRANULAR_OK) << message();
    }
    granular_close_file(files[0]);
    granular_close_file(files[1]);
    EXPECT_EQ(content(paths[0]), finished ? "new a" : "old");
    EXPECT_EQ(fs::exists(paths[1]), finished);
  }
  EXPECT_EQ(content(paths[1]), "new b");
  EXPECT_EQ(fs::status(paths[0]).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
  granular_file* file = nullptr;
  EXPECT_EQ(granular_begin_file(folder.c_str(), &file), GRANULAR_IO_ERROR);
  EXPECT_EQ(message(), folder + ": cannot write: Is a directory");
}
