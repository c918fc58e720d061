// SPDX-License-Identifier: BSD-3-Clause
// Files that are written through the C interface: those of real runs get their bytes back, and arrays of a program the text
// that it expects.
#include "handles.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>

namespace
{
namespace fs = std::filesystem;

std::string output(const std::string& name)
{
  return std::string(GRANULAR_OUTPUT) + "/" + name;
}

/// Writes all frames of a run, with the arrays that its file has.
void copy_run(const std::string& from, const std::string& to,
  const granular_format* format = nullptr, const granular_open_options* options = nullptr)
{
  const RunHandle run = open_run(from, options);
  ASSERT_NE(run, nullptr);
  granular_run_facts facts = {};
  granular_run_info(run.get(), &facts);
  granular_writer* writer = nullptr;
  ASSERT_EQ(granular_create(to.c_str(), format, &writer), GRANULAR_OK) << message();
  for (std::int64_t i = 0; i < facts.frames; ++i)
  {
    std::size_t count = 0;
    granular_arrays(run.get(), i, 0, nullptr, 0, &count);
    std::vector<granular_array_facts> arrays(count);
    granular_arrays(run.get(), i, 0, arrays.data(), count, &count);
    std::vector<const char*> names = { "points" };
    for (const granular_array_facts& array : arrays)
    {
      // of a dump, coordinates are the points; of local data, ends are as the file has them
      if (array.is_usual != 0 || facts.kind == GRANULAR_KIND_LOCAL)
      {
        names.push_back(array.name);
      }
    }
    granular_request request;
    granular_request_init(&request);
    request.arrays = names.data();
    request.array_count = names.size();
    const FrameHandle frame = read_frame(run, i, &request);
    ASSERT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_OK) << message();
  }
  ASSERT_EQ(granular_finish(writer), GRANULAR_OK) << message();
}

granular_array numbers(const char* name, const std::vector<double>& values, int components = 1)
{
  return { name, GRANULAR_FLOAT64, components,
    static_cast<std::int64_t>(values.size()) / components, values.data(), nullptr, 0, "", "", "",
    nullptr };
}
}

TEST(CWriting, FilesOfRealRunsGetTheirBytesBack)
{
  for (const std::string name : { "grains.dump", "ortho_plain.dump", "ortho_scaled.dump",
         "tri_image.dump", "tri_plain.dump", "chain.dump" })
  {
    SCOPED_TRACE(name);
    copy_run(good(name), output(name));
    EXPECT_EQ(content(output(name)), content(good(name)));
  }
  granular_format bonds;
  granular_format_init(&bonds);
  bonds.style = "local";
  copy_run(good("euler_4000.vtk"), output("cells.euler"));
  EXPECT_EQ(content(output("cells.euler")), content(good("euler_4000.vtk")));
}

TEST(CWriting, DecompositionsOfTheirDialects)
{
  granular_format format;
  granular_format_init(&format);
  format.dialect = "PUBLIC";
  copy_run(good("decomposition_1000.vtk"), output("public.decomposition"), &format);
  EXPECT_EQ(content(output("public.decomposition")), content(good("decomposition_1000.vtk")));
  copy_run(good("decomposition_1000.vtk"), output("inl.decomposition"));
  granular_open_options
    options; // without counts of particles nothing in the file says that these are subdomains
  granular_open_options_init(&options);
  options.kind = GRANULAR_KIND_DECOMPOSITION;
  const RunHandle again = open_run(output("inl.decomposition"), &options);
  const RunHandle first = open_run(good("decomposition_1000.vtk"));
  for (const char* name : { "lo", "hi" })
  {
    EXPECT_EQ(doubles(read_frame(again, 0), name), doubles(read_frame(first, 0), name));
  }
}

TEST(CWriting, AFileForEachFrameAndPacked)
{
  copy_run(good("grains.dump"), output("step_*.dump.gz"));
  for (const int step : { 0, 1000, 2000 })
  {
    EXPECT_TRUE(fs::exists(output("step_" + std::to_string(step) + ".dump.gz"))) << step;
  }
  const RunHandle run = open_run(output("step_*.dump.gz"));
  const RunHandle first = open_run(good("grains.dump"));
  EXPECT_EQ(doubles(read_frame(run, -1), "v"), doubles(read_frame(first, -1), "v"));
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

TEST(CWriting, BondsAndCellsAndSubdomainsOfAProgram)
{
  const std::vector<double> ends = { 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0 };
  const std::vector<double> id1 = { 1, 2 };
  const std::vector<double> id2 = { 2, 3 };
  const granular_array lines[] = { numbers("id1", id1), numbers("id2", id2),
    numbers("ends", ends, 6) };
  const auto write =
    [](const std::string& path, const granular_array* arrays, std::size_t count, std::int64_t rows)
  {
    granular_content made;
    granular_content_init(&made);
    made.rows = rows;
    made.arrays = arrays;
    made.array_count = count;
    granular_writer* writer = nullptr;
    ASSERT_EQ(granular_create(path.c_str(), nullptr, &writer), GRANULAR_OK) << message();
    ASSERT_EQ(granular_write(writer, &made), GRANULAR_OK) << message();
    ASSERT_EQ(granular_finish(writer), GRANULAR_OK) << message();
  };
  write(output("mine.bonds"), lines, 3, 2);
  EXPECT_EQ(content(output("mine.bonds")),
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n2\nITEM: ENTRIES id1 id2 x1 y1 z1 x2 y2 z2 \n"
    "1 2 0 0 0 1 0 0 \n2 3 1 0 0 1 1 0 \n");
  const RunHandle bonds = open_run(output("mine.bonds"));
  EXPECT_EQ(doubles(read_frame(bonds, 0), "ends"), ends);

  const std::vector<double> centres = { 0.5, 0.5, 0.5, 1.5, 0.5, 0.5 };
  const std::vector<double> v = { 1, 2, 3, 1.0 / 3, 0, 0 };
  const std::vector<double> ones = { 0.25, 1.0 / 3 };
  const granular_array cells[] = { numbers("points", centres, 3), numbers("v_avg", v, 3),
    numbers("volumefraction", ones), numbers("radius", ones), numbers("pressure", ones) };
  write(output("mine.euler"), cells, 5, 2);
  EXPECT_EQ(doubles(read_frame(open_run(output("mine.euler")), 0), "v_avg"), v);

  const std::vector<double> lo = { 0, 0, 0, 1, 0, 0 };
  const std::vector<double> hi = { 1, 1, 1, 2, 1, 1 };
  const std::vector<std::int64_t> nlocal = { 10, 20 };
  const granular_array domains[] = { numbers("lo", lo, 3), numbers("hi", hi, 3),
    { "nlocal", GRANULAR_INT64, 1, 2, nlocal.data(), nullptr, 0, "", "", "", nullptr } };
  write(output("mine.decomposition"), domains, 3, 2);
  const FrameHandle read = read_frame(open_run(output("mine.decomposition")), 0);
  EXPECT_EQ(doubles(read, "hi"), hi);
  EXPECT_EQ(static_cast<const std::int64_t*>(array_of(read, "nlocal").data)[1], 20);
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
