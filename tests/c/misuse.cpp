// SPDX-License-Identifier: BSD-3-Clause
// What cannot be: null where a pointer is needed, structs of other sizes, choices that there are not. Nothing crashes, and the
// message says what was expected.
#include "handles.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include <pthread.h>

namespace
{
void expect_null_error(granular_status status, const std::string& name)
{
  EXPECT_EQ(status, GRANULAR_BAD_ARGUMENT) << name;
  EXPECT_EQ(message(), "expected " + name + ", got null");
}
}

TEST(CMisuse, NullsAreErrors)
{
  const RunHandle run = open_run(good("grains.dump"));
  const FrameHandle frame = read_frame(run, -1);
  granular_run* new_run = nullptr;
  granular_frame* new_frame = nullptr;
  granular_writer* writer = nullptr;
  granular_names* names = nullptr;
  const char* const path = "a.dump";
  const char* const nothing[] = { nullptr };
  std::int64_t number = 0;
  std::size_t count = 0;
  granular_array array;

  expect_null_error(granular_open(&path, 1, nullptr, nullptr), "run");
  expect_null_error(granular_open(nullptr, 1, nullptr, &new_run), "names");
  expect_null_error(granular_open(nothing, 1, nullptr, &new_run), "a name");
  EXPECT_EQ(granular_open(&path, 0, nullptr, &new_run), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(message(), "expected at least one name, got none");
  expect_null_error(granular_refresh(nullptr, nullptr, nullptr, nullptr), "run");
  expect_null_error(granular_complete_box(nullptr), "box");
  expect_null_error(granular_run_info(nullptr, nullptr), "run");
  expect_null_error(granular_run_info(run.get(), nullptr), "facts");
  expect_null_error(granular_frame_info(nullptr, 0, nullptr), "run");
  expect_null_error(granular_frame_info(run.get(), 0, nullptr), "facts");
  expect_null_error(granular_file_info(nullptr, 0, nullptr), "run");
  expect_null_error(granular_file_info(run.get(), 0, nullptr), "facts");
  granular_file_facts file = {};
  EXPECT_EQ(granular_file_info(run.get(), 1, &file), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(message(), "expected a file from 0 to 0, got 1");
  expect_null_error(granular_find_frame(nullptr, 0, &number), "run");
  expect_null_error(granular_find_frame(run.get(), 0, nullptr), "frame");
  expect_null_error(granular_arrays(nullptr, 0, 0, nullptr, 0, &count), "run");
  expect_null_error(granular_arrays(run.get(), 0, 0, nullptr, 0, nullptr), "count");
  expect_null_error(granular_arrays(run.get(), 0, 0, nullptr, 1, &count), "arrays");
  expect_null_error(granular_read(nullptr, 0, nullptr, &new_frame), "run");
  expect_null_error(granular_read(run.get(), 0, nullptr, nullptr), "out");
  expect_null_error(granular_read_into(run.get(), 0, nullptr, nullptr, 1, nullptr), "destinations");
  const granular_destination nameless = {};
  expect_null_error(granular_read_into(run.get(), 0, nullptr, &nameless, 1, nullptr), "an array");
  expect_null_error(granular_header(nullptr, nullptr), "frame");
  expect_null_error(granular_header(frame.get(), nullptr), "header");
  expect_null_error(granular_array_at(nullptr, 0, &array), "frame");
  expect_null_error(granular_array_at(frame.get(), 0, nullptr), "array");
  expect_null_error(granular_take(nullptr, 0, nullptr), "frame");
  expect_null_error(granular_take(frame.get(), 0, nullptr), "data");
  expect_null_error(granular_array_named(frame.get(), nullptr, &array), "a name");
  expect_null_error(granular_array_named(nullptr, "id", &array), "frame");
  expect_null_error(granular_array_named(frame.get(), "id", nullptr), "array");
  expect_null_error(granular_create(nullptr, nullptr, &writer), "a path");
  expect_null_error(granular_create("a.dump", nullptr, nullptr), "writer");
  expect_null_error(granular_write(nullptr, nullptr), "content");
  granular_content content;
  granular_content_init(&content);
  content.array_count = 1;
  ASSERT_EQ(granular_create((std::string(GRANULAR_OUTPUT) + "/a.dump").c_str(), nullptr, &writer),
    GRANULAR_OK);
  expect_null_error(granular_write(writer, &content), "arrays");
  content.rows = -1;
  EXPECT_EQ(granular_write(writer, &content), GRANULAR_BAD_ARGUMENT);
  granular_abandon(writer);
  expect_null_error(granular_write_frame(nullptr, nullptr), "frame");
  expect_null_error(granular_write_frame(nullptr, frame.get()), "writer");
  expect_null_error(granular_finish(nullptr), "writer");
  granular_file* begun = nullptr;
  expect_null_error(granular_begin_file(nullptr, &begun), "a path");
  expect_null_error(granular_begin_file("a.csv", nullptr), "file");
  expect_null_error(granular_hold_file(nullptr, 0), "a file");
  expect_null_error(granular_finish_files(nullptr, 1, 0), "files");
  expect_null_error(granular_finish_files(&begun, 1, 0), "a file");
  EXPECT_EQ(granular_file_name(nullptr), nullptr);
  ASSERT_EQ(
    granular_begin_file((std::string(GRANULAR_OUTPUT) + "/a.csv").c_str(), &begun), GRANULAR_OK);
  ASSERT_EQ(granular_finish_files(&begun, 1, 0), GRANULAR_OK);
  EXPECT_EQ(granular_finish_files(&begun, 1, 0), GRANULAR_BAD_ARGUMENT);
  EXPECT_EQ(granular_hold_file(begun, 0), GRANULAR_BAD_ARGUMENT);
  granular_close_file(begun);
  granular_bytes* bytes = nullptr;
  expect_null_error(granular_open_bytes(nullptr, &bytes), "a path");
  expect_null_error(granular_open_bytes(path, nullptr), "bytes");
  expect_null_error(granular_read_bytes(nullptr, nullptr, 0, nullptr, nullptr), "bytes");
  granular_close_bytes(nullptr);
  expect_null_error(granular_find_files(nullptr, 1, &names), "names");
  expect_null_error(granular_find_files(&path, 1, nullptr), "names");
  EXPECT_EQ(granular_name_count(nullptr), 0u);
  EXPECT_EQ(granular_name_at(nullptr, 0), nullptr);

  // these do nothing
  granular_close(nullptr);
  granular_release(nullptr);
  granular_abandon(nullptr);
  granular_close_file(nullptr);
  granular_free_names(nullptr);
  granular_open_options_init(nullptr);
  granular_request_init(nullptr);
  granular_format_init(nullptr);
  granular_content_init(nullptr);
}

TEST(CMisuse, StructsOfOtherSizes)
{
  const RunHandle run = open_run(good("grains.dump"));
  granular_frame* frame = nullptr;
  granular_request request;
  std::memset(&request, 0, sizeof(request)); // nobody called the init function
  EXPECT_EQ(granular_read(run.get(), 0, &request, &frame), GRANULAR_BAD_ARGUMENT);
  EXPECT_NE(message().find("got size 0"), std::string::npos) << message();
  granular_request_init(&request);
  request.size = sizeof(request) + 8; // of a later version
  EXPECT_EQ(granular_read(run.get(), 0, &request, &frame), GRANULAR_BAD_ARGUMENT);
  // an earlier version without the last members: these have their defaults
  granular_request_init(&request);
  request.size = offsetof(granular_request, threads);
  request.threads = -77;
  request.notice = nullptr;
  EXPECT_EQ(granular_read(run.get(), 0, &request, &frame), GRANULAR_OK) << message();
  granular_release(frame);
}

TEST(CMisuse, ChoicesThatThereAreNot)
{
  const RunHandle run = open_run(good("grains.dump"));
  const std::string file = good("grains.dump");
  const char* const path = file.c_str();
  const auto refused = [&](auto change, const std::string& words)
  {
    granular_open_options options;
    granular_open_options_init(&options);
    change(options);
    granular_run* none = nullptr;
    EXPECT_EQ(granular_open(&path, 1, &options, &none), GRANULAR_BAD_ARGUMENT);
    EXPECT_EQ(none, nullptr);
    EXPECT_NE(message().find(words), std::string::npos) << message();
  };
  refused(
    [](auto& options) { options.kind = static_cast<granular_kind>(77); }, "granular_kind, got 77");
  refused([](auto& options) { options.timestep_size = 0; }, "timestep_size greater than 0");
  refused([](auto& options) { options.repeated_steps = 3; }, "repeated_steps from 0 to 2, got 3");
  refused([](auto& options) { options.history_layout = -1; }, "history_layout from 0 to 5, got -1");

  const auto refused_request = [&](auto change, const std::string& words)
  {
    granular_request request;
    granular_request_init(&request);
    change(request);
    granular_frame* frame = nullptr;
    EXPECT_EQ(granular_read(run.get(), 0, &request, &frame), GRANULAR_BAD_ARGUMENT);
    EXPECT_EQ(frame, nullptr);
    EXPECT_NE(message().find(words), std::string::npos) << message();
  };
  refused_request([](auto& request) { request.stride = 0; }, "stride of at least 1, got 0");
  refused_request([](auto& request) { request.table = 1; }, "expected table 0, got 1");
  refused_request(
    [](auto& request) { request.periodic_lines = 3; }, "periodic_lines from 0 to 2, got 3");
  refused_request([](auto& request)
    { request.coordinates = static_cast<granular_coordinates>(-77); },
    "coordinates from 0 to 2, got -77");
  refused_request([](auto& request) { request.array_count = 1; }, "names of arrays, got null");

  const auto refused_format = [&](auto change, const std::string& words)
  {
    granular_format format;
    granular_format_init(&format);
    change(format);
    granular_writer* writer = nullptr;
    const std::string to = std::string(GRANULAR_OUTPUT) + "/refused.dump";
    EXPECT_NE(granular_create(to.c_str(), &format, &writer), GRANULAR_OK);
    EXPECT_EQ(writer, nullptr);
    EXPECT_NE(message().find(words), std::string::npos) << message();
  };
  refused_format([](auto& format) { format.style = "xyz"; }, "got 'xyz'");
  refused_format([](auto& format) { format.dialect = "lammps"; },
    "expected a dialect of Automatic, LIGGGHTS, LAMMPS, got 'lammps'");
  refused_format([](auto& format) { format.numbers = "%d"; }, "got '%d'");
  refused_format(
    [](auto& format) { format.durable = 3; }, "durable of 0, 1 or 2 (automatic), got 3");
}

TEST(CMisuse, ArraysThatCannotBeWritten)
{
  const double x[] = { 1, 2, 3 };
  const std::int32_t word = 3;
  const char* const words[] = { "H" };
  const granular_array good_points = { "points", GRANULAR_FLOAT64, 3, 1, x, nullptr, 0, "", "", "",
    nullptr };
  const auto refused = [&](const granular_array& array, const std::string& expected)
  {
    const std::string path = std::string(GRANULAR_OUTPUT) + "/arrays.dump";
    granular_writer* writer = nullptr;
    ASSERT_EQ(granular_create(path.c_str(), nullptr, &writer), GRANULAR_OK) << message();
    const granular_array arrays[] = { good_points, array };
    granular_content content;
    granular_content_init(&content);
    content.rows = 1;
    content.arrays = arrays;
    content.array_count = 2;
    EXPECT_EQ(granular_write(writer, &content), GRANULAR_BAD_ARGUMENT);
    EXPECT_NE(message().find(expected), std::string::npos) << message();
    granular_abandon(writer);
    EXPECT_FALSE(std::ifstream(path).good());
  };
  refused(
    { nullptr, GRANULAR_FLOAT64, 1, 1, x, nullptr, 0, "", "", "", nullptr }, "expected a name");
  refused({ "a", static_cast<granular_type>(11), 1, 1, x, nullptr, 0, "", "", "", nullptr },
    "expected a type");
  refused(
    { "a", GRANULAR_FLOAT64, 0, 1, x, nullptr, 0, "", "", "", nullptr }, "at least one component");
  refused(
    { "a", GRANULAR_FLOAT64, 1, 1, nullptr, nullptr, 0, "", "", "", nullptr }, "data, got null");
  refused({ "a", GRANULAR_TEXT, 1, 1, &word, nullptr, 0, "", "", "", nullptr }, "words");
  refused({ "a", GRANULAR_TEXT, 1, 1, &word, words, 1, "", "", "", nullptr },
    "indices of 1 words, got 3");
  refused(
    { "points", GRANULAR_FLOAT64, 2, 1, x, nullptr, 0, "", "", "", nullptr }, "three components");
  const void* const between = reinterpret_cast<const char*>(x) + 1;
  refused({ "a", GRANULAR_FLOAT64, 1, 1, between, nullptr, 0, "", "", "", nullptr },
    "a multiple of 8 bytes");

  // a claim of rows that the arrays, or the memory of any machine, do not have
  for (const std::int64_t rows : { std::int64_t{ 0 }, std::int64_t{ 1 } })
  {
    const granular_array array = { "points", GRANULAR_FLOAT64, 3, rows, x, nullptr, 0, "", "", "",
      nullptr };
    granular_content content;
    granular_content_init(&content);
    content.rows = INT64_MAX;
    content.arrays = &array;
    content.array_count = 1;
    granular_writer* writer = nullptr;
    const std::string path = std::string(GRANULAR_OUTPUT) + "/rows.dump";
    ASSERT_EQ(granular_create(path.c_str(), nullptr, &writer), GRANULAR_OK);
    EXPECT_EQ(granular_write(writer, &content), GRANULAR_BAD_ARGUMENT);
    EXPECT_NE(message().find("9223372036854775807"), std::string::npos) << message();
    granular_abandon(writer);
  }

  granular_content nowhere;
  granular_content_init(&nowhere);
  nowhere.rows = 1;
  granular_writer* writer = nullptr;
  const std::string path = std::string(GRANULAR_OUTPUT) + "/nowhere.dump";
  ASSERT_EQ(granular_create(path.c_str(), nullptr, &writer), GRANULAR_OK);
  EXPECT_EQ(granular_write(writer, &nowhere), GRANULAR_BAD_ARGUMENT);
  EXPECT_NE(message().find("'points'"), std::string::npos) << message();
  granular_abandon(writer);
}

// As the threads of Python do when Python ends: no lock stays, and the run can be used.
TEST(CMisuse, AThreadThatEndsInTheProgress)
{
  const auto end = [](double, void*) -> int
  {
    ::pthread_exit(nullptr);
    return 0;
  };
  const auto ends = [](auto work)
  {
    bool is_through = false;
    std::thread(
      [&]
      {
        work();
        is_through = true;
      })
      .join();
    return !is_through;
  };
  for (const std::string name : { "grains.dump", "ortho_000000.dump.gz", "grains.bin",
         "data_file/full.data", "local/contacts.dump", "restart/fibres.restart" })
  {
    granular_open_options options;
    granular_open_options_init(&options);
    options.column_names = "id type x y z ix iy iz vx vy vz radius";
    const RunHandle run = open_run(good(name), &options);
    const std::string path = good(name);
    const char* const paths = path.c_str();
    options.progress = end;
    granular_run* opened = nullptr;
    ends(
      [&] { granular_open(&paths, 1, &options, &opened); }); // some are known, and need no progress
    granular_close(opened);
    granular_request request;
    granular_request_init(&request);
    request.threads = 3;
    request.progress = end;
    granular_frame* frame = nullptr;
    EXPECT_TRUE(ends([&] { granular_read(run.get(), -1, &request, &frame); })) << name;
    EXPECT_EQ(granular_refresh(run.get(), nullptr, nullptr, nullptr), GRANULAR_OK) << message();
    const FrameHandle whole = read_frame(run, -1);

    granular_format format;
    granular_format_init(&format);
    format.progress = end;
    const std::string to = std::string(GRANULAR_OUTPUT) + "/ended.dump";
    granular_writer* writer = nullptr;
    ASSERT_EQ(granular_create(to.c_str(), &format, &writer), GRANULAR_OK) << message();
    EXPECT_TRUE(ends([&] { granular_write_frame(writer, whole.get()); }) ||
      name.find(".dump") == name.npos || name.find("local") == 0)
      << name;
    granular_abandon(writer);
  }
}

TEST(CMisuse, ARefreshInTheProgressOfTheSameRun)
{
  const RunHandle run = open_run(good("grains.dump"));
  const RunHandle other = open_run(good("grains_1000.dump"));
  struct Seen
  {
    granular_run* run;
    granular_run* other;
    granular_status status;
    std::string message;
  } seen{ run.get(), other.get(), GRANULAR_OK, "" };
  granular_request request;
  granular_request_init(&request);
  request.user = &seen;
  request.progress = [](double, void* user)
  {
    auto& told = *static_cast<Seen*>(user);
    told.status = granular_refresh(told.run, nullptr, nullptr, nullptr);
    told.message = message();
    return granular_refresh(told.other, nullptr, nullptr, nullptr) == GRANULAR_OK ? 0 : 1;
  };
  const FrameHandle frame = read_frame(run, -1, &request);
  EXPECT_EQ(seen.status, GRANULAR_BAD_ARGUMENT);
  EXPECT_NE(seen.message.find("from a function for progress"), std::string::npos) << seen.message;
  EXPECT_EQ(granular_refresh(run.get(), request.progress, nullptr, &seen), GRANULAR_OK);
  EXPECT_EQ(granular_refresh(run.get(), nullptr, nullptr, nullptr), GRANULAR_OK) << message();
}

// Numbers at random, of which most cannot be: nothing crashes, each error has a message, and the run stays as it was.
TEST(CMisuse, AnyRequestsOfAnyFile)
{
  std::mt19937 random(1);
  const auto one_of = [&](const auto& choices) { return choices[random() % std::size(choices)]; };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::array<double, 7> reals = { 0, -1, 1e300, infinity, -infinity, std::nan(""), 0.02 };
  constexpr std::array<std::int64_t, 7> integers = { 0, 1, -1, 2, 7, INT64_MAX, INT64_MIN };
  constexpr std::array<int, 6> few = { 0, 1, 2, 3, -1, INT32_MAX };
  constexpr std::array<const char*, 8> names = { "id", "v", "points", "ends", "radius", "x", "",
    "no such" };
  for (const std::string name : { "grains.dump", "tri_scaled_image.dump", "grains.bin",
         "euler_1000.vtk", "decomposition_1000.vtk", "data_file/sphere.data", "local/contacts.dump",
         "restart/fibres.restart" })
  {
    granular_open_options options;
    granular_open_options_init(&options);
    options.column_names = "id type x y z ix iy iz vx vy vz radius";
    const RunHandle run = open_run(good(name), &options);
    int refused = 0;
    for (int i = 0; i < 300; ++i)
    {
      granular_request request;
      granular_request_init(&request);
      std::array<const char*, 3> wanted = { one_of(names), one_of(names), one_of(names) };
      request.arrays = random() % 2 ? wanted.data() : nullptr;
      request.array_count = request.arrays ? random() % 4 : 0;
      request.table = random() % 4 ? 0 : one_of(few);
      request.points = one_of(few);
      request.coordinates = static_cast<granular_coordinates>(random() % 4);
      request.single_precision = one_of(few);
      request.sort_by_id = one_of(few);
      request.stride = random() % 2 ? 1 : one_of(integers);
      request.threads = static_cast<int>(random() % 4) - 1;
      for (double& bound : request.region)
      {
        bound = random() % 2 ? bound : one_of(reals);
      }
      request.origin[random() % 3] = random() % 2 ? 0 : one_of(reals);
      if (i % 2 == 0) // only few kinds have parts
      {
        request.coordinates = GRANULAR_ABSOLUTE;
        request.sort_by_id = 0;
        request.stride = 1;
        request.region[0] = request.region[2] = request.region[4] = 1;
        request.region[1] = request.region[3] = request.region[5] = -1;
      }
      granular_frame* frame = nullptr;
      const granular_status status =
        granular_read(run.get(), random() % 2 ? -1 : one_of(integers), &request, &frame);
      EXPECT_EQ(frame == nullptr, status != GRANULAR_OK);
      refused += status == GRANULAR_OK ? 0 : 1;
      EXPECT_FALSE(status != GRANULAR_OK && message().empty()) << name << " " << i;
      granular_release(frame);
    }
    EXPECT_GT(refused, 50) << name;
    EXPECT_LT(refused, 295) << name;
    const FrameHandle whole = read_frame(run, -1);
    granular_frame_header header = {};
    EXPECT_EQ(granular_header(whole.get(), &header), GRANULAR_OK);
    EXPECT_GT(header.rows, 0) << name;
  }
}
