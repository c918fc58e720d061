// SPDX-License-Identifier: BSD-3-Clause
// Files of real runs through the C interface: what a program in C sees, against the words in the files.
#include "handles.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <thread>

namespace
{
/// A frame of a text dump, word by word.
struct PlainFrame
{
  std::int64_t step = 0;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  double number(std::size_t row, const std::string& name) const
  {
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (names[i] == name)
      {
        return std::strtod(rows[row][i].c_str(), nullptr);
      }
    }
    ADD_FAILURE() << name;
    return 0;
  }
};

std::vector<std::string> words(const std::string& line)
{
  std::istringstream in(line);
  std::vector<std::string> all;
  for (std::string word; in >> word;)
  {
    all.push_back(word);
  }
  return all;
}

std::vector<PlainFrame> plain_frames(const std::string& path)
{
  std::vector<PlainFrame> frames;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
  {
    if (line.rfind("ITEM: TIMESTEP", 0) == 0)
    {
      frames.emplace_back();
      std::getline(in, line);
      frames.back().step = std::stoll(line);
    }
    else if (line.rfind("ITEM: ATOMS", 0) == 0)
    {
      const std::vector<std::string> all = words(line);
      frames.back().names.assign(all.begin() + 2, all.end());
    }
    else if (line.rfind("ITEM:", 0) != 0 && !frames.empty() && !frames.back().names.empty())
    {
      frames.back().rows.push_back(words(line));
    }
  }
  return frames;
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

TEST(CInterface, ADumpIsWhatItsWordsSay)
{
  granular_open_options options;
  granular_open_options_init(&options);
  options.timestep_size = 2e-5;
  const RunHandle run = open_run(good("grains.dump"), &options);
  const std::vector<PlainFrame> plain = plain_frames(good("grains.dump"));
  const granular_run_facts facts = facts_of(run);
  EXPECT_EQ(facts.kind, GRANULAR_KIND_DUMP);
  EXPECT_EQ(facts.frames, static_cast<std::int64_t>(plain.size()));
  EXPECT_EQ(facts.files, 1);
  EXPECT_EQ(facts.tables, 1);
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    const auto number = static_cast<std::int64_t>(i);
    granular_frame_facts about = {};
    ASSERT_EQ(granular_frame_info(run.get(), number, &about), GRANULAR_OK);
    EXPECT_EQ(about.timestep, plain[i].step);
    EXPECT_EQ(
      about.time, std::strtod((std::to_string(2 * plain[i].step) + "e-5").c_str(), nullptr));
    EXPECT_EQ(about.rows, static_cast<std::int64_t>(plain[i].rows.size()));
    EXPECT_STREQ(about.path, good("grains.dump").c_str());
    const FrameHandle frame = read_frame(run, number);
    const std::vector<double> points = doubles(frame, "points");
    const std::vector<double> v = doubles(frame, "v");
    const std::vector<double> radius = doubles(frame, "radius");
    const granular_array id = array_of(frame, "id");
    ASSERT_EQ(id.type, GRANULAR_INT64);
    ASSERT_EQ(radius.size(), plain[i].rows.size());
    for (std::size_t row = 0; row < radius.size(); ++row)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::string name(1, "xyz"[axis]);
        ASSERT_EQ(points[3 * row + axis], plain[i].number(row, name));
        ASSERT_EQ(v[3 * row + axis], plain[i].number(row, "v" + name));
      }
      ASSERT_EQ(radius[row], plain[i].number(row, "radius"));
      ASSERT_EQ(static_cast<const std::int64_t*>(id.data)[row],
        static_cast<std::int64_t>(plain[i].number(row, "id")));
    }
  }
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

TEST(CInterface, ArraysHaveUnitsAndMeanings)
{
  const RunHandle run = open_run(good("grains.dump"));
  const auto arrays = offered(run, -1);
  ASSERT_EQ(arrays.count("v"), 1u);
  EXPECT_EQ(arrays.at("v").components, 3);
  EXPECT_STREQ(arrays.at("v").unit, "m/s");
  EXPECT_STREQ(arrays.at("v").meaning, "velocity");
  EXPECT_EQ(arrays.at("v").is_usual, 1);
  EXPECT_STREQ(arrays.at("radius").unit, "m");
  EXPECT_EQ(arrays.at("x").is_usual, 0);
  EXPECT_EQ(arrays.at("id").type, GRANULAR_INT64);
}

TEST(CInterface, TheBoxIsThatOfTheFile)
{
  const RunHandle run = open_run(good("tri_image.dump"));
  const FrameHandle frame = read_frame(run, 0);
  granular_frame_header header = {};
  ASSERT_EQ(granular_header(frame.get(), &header), GRANULAR_OK);
  const std::vector<std::string> lines = [&]
  {
    std::istringstream in(content(good("tri_image.dump")));
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line) && all.size() < 9;)
    {
      all.push_back(line);
    }
    return all;
  }();
  std::size_t bounds = 0;
  while (lines[bounds].rfind("ITEM: BOX", 0) != 0)
  {
    ++bounds;
  }
  const double xy = std::strtod(words(lines[bounds + 1])[2].c_str(), nullptr);
  const double zlo = std::strtod(words(lines[bounds + 3])[0].c_str(), nullptr);
  EXPECT_EQ(header.has_box, 1);
  EXPECT_EQ(header.box.vectors[3], xy); // b = (xy, Ly, 0)
  EXPECT_EQ(header.box.origin[2], zlo);
  EXPECT_STREQ(header.box.boundary, words(lines[bounds])[6].c_str() == nullptr ? "" : "pp pp pp");
  EXPECT_STREQ(header.dialect, "LAMMPS");
  EXPECT_NE(std::string(header.columns).find("id"), std::string::npos);
  EXPECT_EQ(header.rows, 500);
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

TEST(CInterface, BondsAreTheSecondTable)
{
  for (const std::string& path : { good("local/chain.data"),
         std::string(GRANULAR_DATA) + "/../../samples/data/restart/fibres.40000.restart" })
  {
    SCOPED_TRACE(path);
    const RunHandle run = open_run(path);
    EXPECT_EQ(facts_of(run).tables, 2);
    granular_request request;
    granular_request_init(&request);
    request.table = 1;
    const FrameHandle bonds = read_frame(run, -1, &request);
    EXPECT_EQ(array_of(bonds, "id1").rows, path.ends_with("data") ? 96 : 79);
    EXPECT_EQ(array_of(bonds, "ends").components, 6);
    EXPECT_EQ(offered(run, -1, 1).count("id2"), 1u);
  }
}

TEST(CInterface, OnlyWhatIsWanted)
{
  const RunHandle run = open_run(good("grains.dump"));
  const FrameHandle all = read_frame(run, -1);
  const char* const names[] = { "radius", "x" };
  granular_request request;
  granular_request_init(&request);
  request.arrays = names;
  request.array_count = 2;
  request.stride = 7;
  const FrameHandle some = read_frame(run, -1, &request);
  granular_frame_header header = {};
  ASSERT_EQ(granular_header(some.get(), &header), GRANULAR_OK);
  EXPECT_EQ(header.arrays, 2u);
  const granular_array ids = array_of(all, "id");
  const std::vector<double> radii = doubles(all, "radius");
  const std::vector<double> points = doubles(all, "points");
  std::vector<double> expected;
  std::vector<double> expected_x;
  for (std::size_t row = 0; row < radii.size(); ++row)
  {
    if (static_cast<const std::int64_t*>(ids.data)[row] % 7 == 0)
    {
      expected.push_back(radii[row]);
      expected_x.push_back(points[3 * row]);
    }
  }
  EXPECT_EQ(doubles(some, "radius"), expected);
  EXPECT_EQ(doubles(some, "x"), expected_x);

  const char* const unknown[] = { "mass", "volume" };
  request.arrays = unknown;
  granular_frame* none = nullptr;
  EXPECT_EQ(granular_read(run.get(), -1, &request, &none), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(none, nullptr);
  EXPECT_NE(message().find("expected an array of id, type, x, y, z"), std::string::npos)
    << message();
  EXPECT_NE(message().find("got 'volume'"), std::string::npos) << message();
}

TEST(CInterface, RegionsOriginsAndSingles)
{
  const RunHandle run = open_run(good("grains.dump"));
  const std::vector<double> all = doubles(read_frame(run, -1), "points");
  granular_request request;
  granular_request_init(&request);
  request.single_precision = 1;
  request.region[4] = 0;
  request.region[5] = 0.01;
  request.origin[2] = 0.005;
  const FrameHandle some = read_frame(run, -1, &request);
  const granular_array points = array_of(some, "points");
  ASSERT_EQ(points.type, GRANULAR_FLOAT32);
  std::vector<float> expected;
  for (std::size_t i = 0; i < all.size(); i += 3)
  {
    if (all[i + 2] >= 0 && all[i + 2] <= 0.01)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        expected.push_back(static_cast<float>(all[i + axis] - (axis == 2 ? 0.005 : 0)));
      }
    }
  }
  const auto* const got = static_cast<const float*>(points.data);
  EXPECT_EQ(std::vector<float>(got, got + 3 * points.rows), expected);
  EXPECT_GT(points.rows, 10);
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
  ASSERT_GT(element.word_count, 0u);
  const std::vector<PlainFrame> plain = plain_frames(good("plain.dump"));
  const PlainFrame& last = plain.back();
  std::size_t column = 0;
  while (last.names[column] != "element")
  {
    ++column;
  }
  for (std::size_t row = 0; row < last.rows.size(); ++row)
  {
    const std::int32_t word = static_cast<const std::int32_t*>(element.data)[row];
    ASSERT_EQ(element.words[word], last.rows[row][column]);
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

TEST(CInterface, NoticesAndProgressReachTheCaller)
{
  struct Seen
  {
    std::vector<std::string> notices;
    std::vector<double> fractions;
    int stop_after = 1000000;
  } seen;
  granular_request request;
  granular_request_init(&request);
  request.user = &seen;
  request.notice = [](const granular_error* remark, void* user)
  { static_cast<Seen*>(user)->notices.emplace_back(remark->message); };
  request.progress = [](double fraction, void* user)
  {
    auto* const mine = static_cast<Seen*>(user);
    mine->fractions.push_back(fraction);
    return static_cast<int>(mine->fractions.size()) > mine->stop_after ? 1 : 0;
  };
  const RunHandle run = open_run(good("local/chain_bonds.dump"));
  read_frame(run, -1, &request);
  ASSERT_FALSE(seen.fractions.empty());
  EXPECT_TRUE(std::ranges::is_sorted(seen.fractions));
  EXPECT_FALSE(seen.notices.empty()); // which columns were taken for what

  seen = {};
  seen.stop_after = 0;
  granular_frame* frame = nullptr;
  EXPECT_EQ(granular_read(run.get(), -1, &request, &frame), GRANULAR_CANCELLED);
  EXPECT_EQ(frame, nullptr);
}

TEST(CInterface, ARunThatGrows)
{
  const std::string path = std::string(GRANULAR_OUTPUT) + "/growing.dump";
  const std::string all = content(good("grains.dump"));
  const std::size_t third = all.find("ITEM: TIMESTEP\n2000");
  std::ofstream(path) << all.substr(0, third);
  const RunHandle run = open_run(path);
  EXPECT_EQ(facts_of(run).frames, 2);
  std::ofstream(path, std::ios::app) << all.substr(third);
  ASSERT_EQ(granular_refresh(run.get(), nullptr, nullptr, nullptr), GRANULAR_OK) << message();
  EXPECT_EQ(facts_of(run).frames, 3);
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

TEST(CInterface, ReadsTheContentOfAPackedFileAsFarAsItGoes)
{
  const std::string packed = content(good("tri_000050.dump.gz"));
  const std::string path = std::string(GRANULAR_OUTPUT) + "/content.gz";
  for (const std::size_t cut : { std::size_t{ 0 }, std::size_t{ 100 } })
  {
    std::ofstream(path, std::ios::binary) << packed.substr(0, packed.size() - cut);
    granular_bytes* bytes = nullptr;
    ASSERT_EQ(granular_open_bytes(path.c_str(), &bytes), GRANULAR_OK) << message();
    std::string text(1 << 20, ' ');
    std::size_t got = 0;
    int is_cut = -1;
    EXPECT_EQ(granular_read_bytes(bytes, text.data(), text.size(), &got, &is_cut), GRANULAR_OK);
    EXPECT_EQ(text.substr(0, 14), "ITEM: TIMESTEP");
    EXPECT_EQ(is_cut, cut == 0 ? 0 : 1);
    EXPECT_EQ(got == 16699, cut == 0) << got; // by zcat
    EXPECT_EQ(granular_read_bytes(bytes, text.data(), text.size(), &got, &is_cut), GRANULAR_OK);
    EXPECT_EQ(got, 0u);
    granular_close_bytes(bytes);
  }
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
