// SPDX-License-Identifier: BSD-3-Clause
// Files of real runs through the C interface: what a program in C sees.
#include "handles.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <thread>

namespace
{
using Triple = std::array<double, 3>;

Triple triple(const FrameHandle& frame, const char* name, std::size_t row)
{
  const std::vector<double> all = doubles(frame, name);
  return { all.at(3 * row), all.at(3 * row + 1), all.at(3 * row + 2) };
}

granular_run_facts facts_of(const RunHandle& run)
{
  granular_run_facts facts = {};
  EXPECT_EQ(granular_run_info(run.get(), &facts), GRANULAR_OK) << message();
  return facts;
}

std::map<std::string, granular_array_facts> offered(
  const RunHandle& run, std::int64_t frame, int table = 0)
{
  std::size_t count = 0;
  EXPECT_EQ(granular_arrays(run.get(), frame, table, nullptr, 0, &count), GRANULAR_OK) << message();
  std::vector<granular_array_facts> all(count);
  EXPECT_EQ(granular_arrays(run.get(), frame, table, all.data(), count, &count), GRANULAR_OK);
  std::map<std::string, granular_array_facts> named;
  for (const granular_array_facts& each : all)
  {
    named[each.name] = each;
  }
  return named;
}
}

TEST(CInterface, ADumpIsWhatItsLinesSay)
{
  granular_open_options options;
  granular_open_options_init(&options);
  options.timestep_size = 2e-5;
  const RunHandle run = open_run(good("grains.dump"), &options);
  const granular_run_facts facts = facts_of(run);
  EXPECT_EQ(facts.kind, GRANULAR_KIND_DUMP);
  EXPECT_EQ(facts.frames, 3);
  EXPECT_EQ(facts.files, 1);
  EXPECT_EQ(facts.tables, 1);
  const double times[] = { 0, 0.02, 0.04 };
  for (std::int64_t i = 0; i < 3; ++i)
  {
    granular_frame_facts about = {};
    ASSERT_EQ(granular_frame_info(run.get(), i, &about), GRANULAR_OK);
    EXPECT_EQ(about.timestep, 1000 * i);
    EXPECT_EQ(about.time, times[i]);
    EXPECT_EQ(about.rows, i == 0 ? 0 : 1200);
    EXPECT_STREQ(about.path, good("grains.dump").c_str());
  }
  const FrameHandle first = read_frame(run, 0);
  EXPECT_EQ(array_of(first, "points").rows, 0);
  const FrameHandle last = read_frame(run, 2);
  const struct // the first and the last line
  {
    std::size_t row;
    std::int64_t id;
    Triple point, v;
  } lines[] = { { 0, 72, { -0.0389465, -0.0490355, 0.00237037 },
                  { 0.00308347, -0.284815, 0.123711 } },
    { 1199, 974, { 0.0455729, 0.0368909, 0.103648 }, { 0, 0, -0.892302 } } };
  const granular_array id = array_of(last, "id");
  ASSERT_EQ(id.type, GRANULAR_INT64);
  ASSERT_EQ(id.rows, 1200);
  for (const auto& line : lines)
  {
    EXPECT_EQ(static_cast<const std::int64_t*>(id.data)[line.row], line.id);
    EXPECT_EQ(triple(last, "points", line.row), line.point);
    EXPECT_EQ(triple(last, "v", line.row), line.v);
  }
  EXPECT_EQ(std::ranges::count(doubles(last, "radius"), 0.0025), 902);
}

TEST(CInterface, FramesFromTheEndAndByTime)
{
  const RunHandle run = open_run(good("grains.dump"));
  granular_frame_facts about = {};
  ASSERT_EQ(granular_frame_info(run.get(), -1, &about), GRANULAR_OK);
  EXPECT_EQ(about.timestep, 2000);
  for (const auto& [time, expected] :
    { std::pair(1500.0, 1), { -1.0, 0 }, { 1e9, 2 }, { 1000.0, 1 } })
  {
    std::int64_t frame = -1;
    ASSERT_EQ(granular_find_frame(run.get(), time, &frame), GRANULAR_OK);
    EXPECT_EQ(frame, expected) << time;
  }
  for (const std::int64_t beyond : { 3, -4 })
  {
    EXPECT_EQ(granular_frame_info(run.get(), beyond, &about), GRANULAR_BAD_ARGUMENT);
    EXPECT_EQ(message(), "expected a frame from -3 to 2, got " + std::to_string(beyond));
  }
}

TEST(CInterface, EveryKindOpens)
{
  const struct
  {
    std::string path;
    granular_kind kind;
    std::vector<const char*> arrays;
  } files[] = {
    { good("pieces_*.%.dump"), GRANULAR_KIND_DUMP, { "points", "id" } },
    { good("ortho_custom.bin"), GRANULAR_KIND_DUMP, { "points", "id" } },
    { good("ortho_*.dump.gz"), GRANULAR_KIND_DUMP, { "points", "id" } },
    { good("local/chain_bonds.dump"), GRANULAR_KIND_LOCAL, { "id1", "id2", "force" } },
    { good("local/contacts.dump"), GRANULAR_KIND_LOCAL, { "ends", "length", "id1", "force" } },
    { good("local/chain.data"), GRANULAR_KIND_DATA_FILE, { "points", "id", "type" } },
    { good("euler_*.vtk"), GRANULAR_KIND_EULER, { "points", "v_avg", "volumefraction" } },
    { good("grid/grid_*.dump"), GRANULAR_KIND_GRID, { "points", "v" } },
    { good("decomposition_*.vtk"), GRANULAR_KIND_DECOMPOSITION, { "lo", "hi" } },
    { std::string(GRANULAR_DATA) + "/../../samples/data/restart/fibres.*.restart",
      GRANULAR_KIND_RESTART, { "points", "id", "radius" } },
  };
  for (const auto& file : files)
  {
    SCOPED_TRACE(file.path);
    const RunHandle run = open_run(file.path);
    ASSERT_NE(run, nullptr);
    EXPECT_EQ(facts_of(run).kind, file.kind);
    EXPECT_EQ(facts_of(run).tables,
      file.kind == GRANULAR_KIND_RESTART || file.kind == GRANULAR_KIND_DATA_FILE ? 2 : 1);
    const FrameHandle frame = read_frame(run, -1);
    ASSERT_NE(frame, nullptr);
    for (const char* name : file.arrays)
    {
      const granular_array array = array_of(frame, name);
      EXPECT_GT(array.rows, 0) << name;
      EXPECT_NE(array.data, nullptr) << name;
    }
  }
}

TEST(CInterface, AnArrayThatThereIsNot)
{
  const RunHandle run = open_run(good("grains.dump"));
  granular_request request;
  granular_request_init(&request);
  request.array_count = 2;
  const char* const unknown[] = { "mass", "volume" };
  request.arrays = unknown;
  granular_frame* none = nullptr;
  EXPECT_EQ(granular_read(run.get(), -1, &request, &none), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(none, nullptr);
  EXPECT_NE(message().find("expected an array of id, type, x, y, z"), std::string::npos)
    << message();
  EXPECT_NE(message().find("got 'volume'"), std::string::npos) << message();
}

TEST(CInterface, MemoryOfTheCaller)
{
  const RunHandle run = open_run(good("grains.dump"));
  const FrameHandle frame = read_frame(run, -1);
  std::vector<float> x(3600, -1);
  std::vector<std::int32_t> ids(1200, -1);
  granular_destination to[] = { { "points", GRANULAR_FLOAT32, x.data(), x.size() },
    { "id", GRANULAR_INT32, ids.data(), ids.size() } };
  std::int64_t rows = 0;
  ASSERT_EQ(granular_read_into(run.get(), -1, nullptr, to, 2, &rows), GRANULAR_OK) << message();
  EXPECT_EQ(rows, 1200);
  const std::vector<double> points = doubles(frame, "points");
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    ASSERT_EQ(x[i], static_cast<float>(points[i]));
  }
  EXPECT_EQ(ids.back(), static_cast<const std::int64_t*>(array_of(frame, "id").data)[1199]);

  std::vector<char> packed(1 + 3600 * sizeof(double)); // at an address that doubles do not have
  to[0] = { "points", GRANULAR_FLOAT64, packed.data() + 1, 3600 };
  ASSERT_EQ(granular_read_into(run.get(), -1, nullptr, to, 1, &rows), GRANULAR_OK) << message();
  EXPECT_EQ(std::memcmp(packed.data() + 1, points.data(), 3600 * sizeof(double)), 0);
  to[0].type = static_cast<granular_type>(256 + GRANULAR_FLOAT64);
  EXPECT_EQ(granular_read_into(run.get(), -1, nullptr, to, 1, &rows), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(message(), "array 'points': expected a type of granular_type, got 265");
  to[0] = { "points", GRANULAR_FLOAT32, x.data(), x.size() };

  std::vector<std::int8_t> small(1200);
  to[1] = { "id", GRANULAR_INT8, small.data(), small.size() };
  EXPECT_EQ(granular_read_into(run.get(), -1, nullptr, to, 2, &rows), GRANULAR_BAD_ARGUMENT);
  EXPECT_NE(message().find("array 'id'"), std::string::npos) << message();
  to[1] = { "id", GRANULAR_INT64, x.data(), 100 };
  EXPECT_EQ(granular_read_into(run.get(), -1, nullptr, to, 2, &rows), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(message(), "array 'id': expected room for 1200 values, got 100");
  EXPECT_EQ(rows, 1200);
}

TEST(CInterface, WordsAreIndicesIntoAList)
{
  const RunHandle run = open_run(good("plain.dump"));
  const FrameHandle frame = read_frame(run, -1);
  const granular_array element = array_of(frame, "element");
  ASSERT_EQ(element.type, GRANULAR_TEXT);
  ASSERT_EQ(element.rows, 60);
  for (std::size_t row = 0; row < 60; ++row)
  {
    const std::int32_t word = static_cast<const std::int32_t*>(element.data)[row];
    ASSERT_LT(static_cast<std::uint32_t>(word), element.word_count);
    EXPECT_STREQ(element.words[word], row < 15 ? "Glass" : "Steel");
  }
}

TEST(CInterface, KindsGroupsColumnsAndRanges)
{
  granular_kind kind = GRANULAR_KIND_AUTOMATIC;
  EXPECT_EQ(granular_find_kind(good("restart/style_sphere.restart").c_str(), &kind), GRANULAR_OK);
  EXPECT_EQ(kind, GRANULAR_KIND_RESTART);
  EXPECT_EQ(granular_find_kind("no/such.dump", &kind), GRANULAR_OK);
  EXPECT_EQ(kind, GRANULAR_KIND_AUTOMATIC);
  granular_frame_header header = {};
  const FrameHandle restart = read_frame(open_run(good("restart/style_sphere.restart")), 0);
  ASSERT_EQ(granular_header(restart.get(), &header), GRANULAR_OK);
  ASSERT_GE(header.group_count, 1U);
  EXPECT_STREQ(header.groups[0], "all");

  granular_request request;
  granular_request_init(&request);
  request.ranges = 1;
  const FrameHandle grains = read_frame(open_run(good("grains.dump")), -1, &request);
  const granular_array v = array_of(grains, "v");
  EXPECT_STREQ(v.columns, "vx vy vz");
  const std::vector<double> values = doubles(grains, "v");
  ASSERT_NE(v.range, nullptr);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double least = values[axis];
    double most = values[axis];
    for (std::size_t i = axis; i < values.size(); i += 3)
    {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    EXPECT_EQ(v.range[2 * axis], least);
    EXPECT_EQ(v.range[2 * axis + 1], most);
  }
  EXPECT_EQ(array_of(read_frame(open_run(good("grains.dump")), -1), "v").range, nullptr);
}

TEST(CInterface, ErrorsSayWhere)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/broken.dump";
  std::ofstream(path)
    << "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
       "ITEM: ATOMS id x y z\n1 0 zero 0\n";
  const RunHandle run = open_run(path);
  granular_frame* frame = nullptr;
  EXPECT_EQ(granular_read(run.get(), 0, nullptr, &frame), GRANULAR_FORMAT_ERROR);
  const granular_error* const error = granular_last_error();
  EXPECT_EQ(error->status, GRANULAR_FORMAT_ERROR);
  EXPECT_EQ(error->path, path);
  EXPECT_EQ(error->line, 10);
  EXPECT_STREQ(error->column, "y");
  EXPECT_EQ(error->message, path + ":10: column 'y': " + error->text);

  granular_run* none = nullptr;
  const char* const nowhere = "no/such_*.dump";
  EXPECT_EQ(granular_open(&nowhere, 1, nullptr, &none), GRANULAR_IO_ERROR);
  EXPECT_EQ(none, nullptr);
  EXPECT_EQ(message(), "no/such_*.dump: no file fits the pattern");
}

TEST(CInterface, ColumnsOfUnknownMeaningAreListed)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/unknown.dump";
  std::ofstream(path)
    << "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
       "ITEM: ENTRIES c_c[1] c_c[2] c_c[3]\n1 2 1\n";
  const RunHandle run = open_run(path);
  const std::map<std::string, granular_array_facts> arrays = offered(run, 0);
  ASSERT_EQ(arrays.count("c_c"), 1U);
  EXPECT_STREQ(arrays.at("c_c").columns, "c_c[1] c_c[2] c_c[3]");
  granular_frame* frame = nullptr;
  EXPECT_EQ(granular_read(run.get(), 0, nullptr, &frame), GRANULAR_FORMAT_ERROR);
  EXPECT_NE(message().find("several presets fit the values"), std::string::npos) << message();
}

TEST(CInterface, SeveralThreadsReadOneRun)
{
  const RunHandle run = open_run(good("grains.dump"));
  const std::vector<double> expected = doubles(read_frame(run, -1), "points");
  std::vector<std::thread> threads;
  std::vector<int> same(4);
  for (std::size_t t = 0; t < same.size(); ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (int turn = 0; turn < 20; ++turn)
        {
          granular_frame* frame = nullptr;
          granular_request request;
          granular_request_init(&request);
          request.threads = 1;
          const bool read = granular_read(run.get(), -1, &request, &frame) == GRANULAR_OK;
          granular_array points = {};
          same[t] += read && granular_array_named(frame, "points", &points) == GRANULAR_OK &&
              std::memcmp(points.data, expected.data(), 8 * expected.size()) == 0
            ? 1
            : 0;
          granular_release(frame);
          // an error of this thread is no other's
          EXPECT_EQ(granular_frame_info(run.get(), 100 + turn, nullptr), GRANULAR_BAD_ARGUMENT);
          EXPECT_NE(message().find("got " + std::to_string(100 + turn)), std::string::npos);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(same, std::vector<int>(4, 20));
}

// Files of cells are asked for their arrays one by one, and anew after each refresh.
TEST(CInterface, ThreadsReadARunThatAnotherRefreshes)
{
  const RunHandle run = open_run(good("euler_*.vtk"));
  std::vector<std::thread> threads;
  std::vector<int> same(3);
  for (std::size_t t = 0; t < same.size(); ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (int turn = 0; turn < 80; ++turn)
        {
          std::size_t count = 0;
          same[t] +=
            granular_arrays(run.get(), turn % 4, 0, nullptr, 0, &count) == GRANULAR_OK && count == 4
            ? 1
            : 0;
        }
      });
  }
  for (int turn = 0; turn < 40; ++turn)
  {
    EXPECT_EQ(granular_refresh(run.get(), nullptr, nullptr, nullptr), GRANULAR_OK) << message();
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(same, std::vector<int>(3, 80));
}

TEST(CInterface, FindsFilesInTheOrderOfTheirNumbers)
{
  granular_names* names = nullptr;
  const std::string pattern = good("pieces_*.%.dump");
  const char* const text = pattern.c_str();
  ASSERT_EQ(granular_find_files(&text, 1, &names), GRANULAR_OK) << message();
  EXPECT_EQ(granular_name_count(names), 12u);
  EXPECT_EQ(granular_name_at(names, 4), good("pieces_1000.0.dump"));
  EXPECT_EQ(granular_name_at(names, 12), nullptr);
  granular_free_names(names);
}

TEST(CInterface, AFileOfWhichTheSystemDoesNotTellIsAnError)
{
  const std::string link = std::string(GRANULAR_OUTPUT) + "/circle_5.dump";
  std::filesystem::remove(link);
  std::filesystem::create_symlink(link, link);
  granular_names* names = nullptr;
  const std::string pattern = std::string(GRANULAR_OUTPUT) + "/circle_*.dump";
  const char* const text = pattern.c_str();
  EXPECT_EQ(granular_find_files(&text, 1, &names), GRANULAR_IO_ERROR);
  EXPECT_NE(message().find("cannot open"), std::string::npos) << message();
}

TEST(CInterface, Version)
{
  const std::string version = std::to_string(GRANULAR_VERSION_MAJOR) + "." +
    std::to_string(GRANULAR_VERSION_MINOR) + "." + std::to_string(GRANULAR_VERSION_PATCH);
  EXPECT_EQ(granular_version(), version);
}

TEST(CInterface, TheLargestNumbersOfATypeFit)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/limits.dump";
  std::ofstream(path)
    << "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
       "ITEM: ATOMS id x y z c_a c_b c_c c_d\n1 0 0 0 127 2147483647 1e300 1.0000000596\n";
  const RunHandle run = open_run(path);
  std::int8_t a = 0;
  std::int32_t b = 0;
  float c = 0;
  const granular_destination fitting[] = { { "c_a", GRANULAR_INT8, &a, 1 },
    { "c_b", GRANULAR_INT32, &b, 1 } };
  EXPECT_EQ(granular_read_into(run.get(), 0, nullptr, fitting, 2, nullptr), GRANULAR_OK)
    << message();
  EXPECT_EQ(a, 127);
  EXPECT_EQ(b, 2147483647);
  const granular_destination large[] = { { "c_c", GRANULAR_FLOAT32, &c, 1 } };
  EXPECT_EQ(granular_read_into(run.get(), 0, nullptr, large, 1, nullptr), GRANULAR_BAD_ARGUMENT);
  const granular_destination whole[] = { { "c_d", GRANULAR_INT32, &b, 1 } };
  EXPECT_EQ(granular_read_into(run.get(), 0, nullptr, whole, 1, nullptr), GRANULAR_BAD_ARGUMENT);
  EXPECT_NE(message().find("got 1.0000000596"), std::string::npos) << message();
}

TEST(CInterface, ABoxIsCompletedFromItsBounds)
{
  granular_box box = { { -1, 1, -2, 2, -3, 3, 0.1, -0.2, 0.3 }, 1, {}, {}, "pp pp pp" };
  ASSERT_EQ(granular_complete_box(&box), GRANULAR_OK) << message();
  const double edges[] = { 1.7, 0, 0, 0.1, 3.7, 0, -0.2, 0.3, 6 };
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_EQ(box.vectors[i], edges[i]) << i;
  }
  EXPECT_EQ(box.origin[0], -0.8);
}

// A refresh that fails leaves the run as it was.
TEST(CInterface, ARefreshThatFails)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/vanishing.dump";
  std::ofstream(path) << content(good("grains.dump"));
  const RunHandle run = open_run(path);
  std::remove(path.c_str());
  EXPECT_EQ(granular_refresh(run.get(), nullptr, nullptr, nullptr), GRANULAR_IO_ERROR);
  granular_frame_facts facts = {};
  EXPECT_EQ(granular_frame_info(run.get(), 2, &facts), GRANULAR_OK);
  EXPECT_EQ(facts.timestep, 2000);
  EXPECT_EQ(facts_of(run).frames, 3);
}

#ifdef _WIN32
constexpr bool heap_is_malloc = false; // has a function of its own to free aligned memory
#else
constexpr bool heap_is_malloc = true;
#endif

// Large arrays of a frame that is read to be taken lie in the heap; those of others are copied there.
TEST(CInterface, AnArrayIsTaken)
{
  const std::string source = std::string(GRANULAR_OUTPUT) + "/many.dump";
  std::ofstream file(source);
  file << "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n200000\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 "
          "1\n0 1\n"
          "ITEM: ATOMS id x y z\n";
  for (int id = 1; id <= 200000; ++id)
  {
    file << id << " 0.25 0.5 " << id << '\n';
  }
  file.close();
  const RunHandle run = open_run(source);
  granular_request request;
  granular_request_init(&request);
  for (const int take : { 1, 0 })
  {
    request.take = take;
    const FrameHandle frame = read_frame(run, 0, &request);
    const FrameHandle same = read_frame(run, 0);
    granular_frame_header header = {};
    granular_header(frame.get(), &header);
    EXPECT_EQ(header.arrays, 2u);
    for (std::size_t i = 0; i < header.arrays; ++i)
    {
      granular_array array = {};
      granular_array expected = {};
      granular_array_at(frame.get(), i, &array);
      granular_array_at(same.get(), i, &expected);
      void* data = nullptr;
      ASSERT_EQ(granular_take(frame.get(), i, &data), GRANULAR_OK) << message();
      EXPECT_EQ(data == array.data, take == 1 && heap_is_malloc) << array.name;
      const auto bytes = static_cast<std::size_t>(array.rows * array.components) * 8;
      EXPECT_EQ(std::memcmp(data, expected.data, bytes), 0) << array.name;
      std::free(data);
      granular_array_at(frame.get(), i, &array);
      EXPECT_EQ(array.data, nullptr);
    }
    void* data = frame.get();
    EXPECT_EQ(granular_take(frame.get(), 1, &data), GRANULAR_BAD_ARGUMENT);
    EXPECT_EQ(data, nullptr);
    const std::string path = std::string(GRANULAR_OUTPUT) + "/taken.dump";
    granular_writer* writer = nullptr;
    granular_create(path.c_str(), nullptr, &writer);
    EXPECT_EQ(granular_write_frame(writer, frame.get()), GRANULAR_BAD_ARGUMENT);
    EXPECT_NE(message().find("memory was taken"), std::string::npos) << message();
    granular_abandon(writer);
  }
}

TEST(CInterface, EachArrayAloneIsThatOfTheWhole)
{
  for (const std::string name : { "grains.dump", "tri_scaled_image.dump", "euler_1000.vtk",
         "decomposition_1000.vtk", "data_file/granular.data", "local/contacts.dump",
         "restart/fibres.restart", "local/chain.data" })
  {
    const RunHandle run = open_run(good(name));
    const std::int64_t last = facts_of(run).frames - 1;
    for (int table = 0; table < facts_of(run).tables; ++table)
    {
      granular_request request;
      granular_request_init(&request);
      request.table = table;
      const FrameHandle whole = read_frame(run, last, &request);
      granular_frame_header header = {};
      granular_header(whole.get(), &header);
      const char* none = "";
      request.arrays = &none;
      const FrameHandle empty = read_frame(run, last, &request);
      granular_frame_header bare = {};
      granular_header(empty.get(), &bare);
      EXPECT_EQ(bare.rows, header.rows) << name;
      for (std::size_t i = 0; i < header.arrays; ++i)
      {
        granular_array array = {};
        granular_array_at(whole.get(), i, &array);
        SCOPED_TRACE(name + ": " + array.name);
        request.arrays = &array.name;
        request.array_count = 1;
        const FrameHandle alone = read_frame(run, last, &request);
        const granular_array one = array_of(alone, array.name);
        ASSERT_EQ(one.rows, array.rows);
        ASSERT_EQ(one.type, array.type);
        const std::size_t size =
          array.type == GRANULAR_TEXT || array.type == GRANULAR_INT32 ? 4 : 8;
        EXPECT_EQ(0,
          std::memcmp(
            one.data, array.data, size * static_cast<std::size_t>(array.rows * array.components)));
      }
    }
  }
}

TEST(CInterface, PackedContentThatIsCutSaysSo)
{
  const std::string packed = content(good("tri_000050.dump.gz"));
  const std::string path = std::string(GRANULAR_OUTPUT) + "/content.gz";
  std::ofstream(path, std::ios::binary) << packed.substr(0, packed.size() - 100);
  granular_bytes* bytes = nullptr;
  ASSERT_EQ(granular_open_bytes(path.c_str(), &bytes), GRANULAR_OK) << message();
  std::string text(1 << 20, ' ');
  std::size_t got = 0;
  int is_cut = 0;
  EXPECT_EQ(granular_read_bytes(bytes, text.data(), text.size(), &got, &is_cut), GRANULAR_OK);
  EXPECT_GT(got, 0u);
  EXPECT_EQ(is_cut, 1);
  granular_close_bytes(bytes);
}
