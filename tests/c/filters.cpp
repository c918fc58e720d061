// SPDX-License-Identifier: BSD-3-Clause
// Filters and sources of C on numbers that a person can check.
#include "granular_filters.h"
#include "handles.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace
{
using Frames = std::vector<FrameHandle>;

granular_setting number(const char* name, const double& value)
{
  return { name, nullptr, &value, 1 };
}

granular_task task_of(const char* filter, const std::vector<granular_setting>& settings)
{
  granular_task task;
  granular_task_init(&task);
  task.filter = filter;
  task.settings = settings.data();
  task.setting_count = settings.size();
  return task;
}

granular_status run_task(const granular_task& task, Frames& made)
{
  granular_frame* results[GRANULAR_MOST_RESULTS] = {};
  std::size_t count = 0;
  const granular_status status = granular_apply(&task, results, GRANULAR_MOST_RESULTS, &count);
  for (std::size_t i = 0; i < count; ++i)
  {
    made.emplace_back(results[i], granular_release);
  }
  return status;
}

template <class Value>
granular_array array(
  const char* name, granular_type type, const std::vector<Value>& values, int components = 1)
{
  granular_array made = {};
  made.name = name;
  made.type = type;
  made.components = components;
  made.data = values.data();
  return made;
}

/// Three particles in a periodic box of 10, the third of which is a duplicate of another rank's, and bonds between them.
struct Inputs
{
  std::vector<double> points = { 1, 5, 5, 9, 5, 5, 3, 5, 5 };
  std::vector<std::int64_t> ids = { 7, 8, 8 };
  std::vector<unsigned char> ghosts = { 0, 0, 1 };
  std::vector<double> rest = { 1.5, 1 };
  std::vector<std::int32_t> id1 = { 7, 7 };
  std::vector<std::int32_t> id2 = { 8, 9 };
  granular_array of_particles[3] = { array("points", GRANULAR_FLOAT64, points, 3),
    array("id", GRANULAR_INT64, ids), array(GRANULAR_GHOSTS, GRANULAR_UINT8, ghosts) };
  granular_array of_bonds[3] = { array("id1", GRANULAR_INT32, id1),
    array("id2", GRANULAR_INT32, id2), array("equilibrium_length", GRANULAR_FLOAT64, rest) };
  granular_box box = {};
  granular_content contents[2] = {};
  const char* failure = nullptr;
  std::vector<std::string> said;

  Inputs()
  {
    box.has_bounds = 1;
    box.bounds[1] = box.bounds[3] = box.bounds[5] = 10;
    box.boundary = "pp ff ff";
    for (granular_content& content : contents)
    {
      granular_content_init(&content);
      content.array_count = 3;
    }
    contents[0].arrays = of_particles;
    contents[0].rows = 3;
    contents[0].box = &box;
    contents[1].arrays = of_bonds;
    contents[1].rows = 2;
    contents[1].timestep = GRANULAR_NO_TIMESTEP;
  }

  /// Ports 0 and 3 have the particles, port 1 the bonds.
  granular_task task(
    const std::vector<granular_setting>& settings, const char* filter = "GranularLocalJoin")
  {
    granular_task made = task_of(filter, settings);
    made.user = this;
    made.input = [](std::size_t port, std::size_t, const granular_content** content,
                   const char** why, void* user)
    {
      auto& self = *static_cast<Inputs*>(user);
      *content = port == 2 ? nullptr : &self.contents[port % 3];
      *why = self.failure;
      return self.failure == nullptr ? 0 : 1;
    };
    made.notice = [](const granular_error* remark, void* user)
    { static_cast<Inputs*>(user)->said.emplace_back(remark->message); };
    return made;
  }
};
}

// Three spheres of diameter 1 that touch, from the low face on in the middle of a box of 4 x 2 x 2.
TEST(CFilters, PackingIsAChain)
{
  const double lengths[] = { 4, 2, 2 };
  const double radius = 0.5;
  const double chain = 4;
  const double one = 1;
  const double none = 0;
  const double three = 3;
  Frames made;
  const std::vector<granular_setting> settings = { number("Arrangement", chain),
    number("NumberOfGrains", three), number("Radius", radius), number("Radii", none),
    number("BondFactor", one), { "BoxLengths", nullptr, lengths, 3 },
    { "Boundary", "f f f", nullptr, 0 } };
  ASSERT_EQ(run_task(task_of("GranularPackingSource", settings), made), GRANULAR_OK) << message();
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(doubles(made[0], "points"), (std::vector<double>{ 0.5, 1, 1, 1.5, 1, 1, 2.5, 1, 1 }));
  EXPECT_EQ(doubles(made[0], "radius"), (std::vector<double>{ 0.5, 0.5, 0.5 }));
  EXPECT_EQ(
    doubles(made[1], "ends"), (std::vector<double>{ 0.5, 1, 1, 1.5, 1, 1, 1.5, 1, 1, 2.5, 1, 1 }));
  EXPECT_EQ(doubles(made[1], "length"), (std::vector<double>{ 1, 1 }));
  granular_frame_header header;
  ASSERT_EQ(granular_header(made[0].get(), &header), GRANULAR_OK);
  EXPECT_EQ(header.box.bounds[1], 4);
}

// The bond goes through the face at 0: from 1 to -1, which is 2 long, and 0.5 longer than at rest. The other one has no end.
TEST(CFilters, JoinDrawsLinesAndTellsWhatIsLeftOut)
{
  Inputs inputs;
  Frames made;
  ASSERT_EQ(run_task(inputs.task({}), made), GRANULAR_OK) << message();
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(doubles(made[0], "ends"), (std::vector<double>{ 1, 5, 5, -1, 5, 5 }));
  EXPECT_EQ(doubles(made[0], "length"), (std::vector<double>{ 2 }));
  EXPECT_EQ(doubles(made[0], "elongation"), (std::vector<double>{ 0.5 }));
  EXPECT_EQ(*static_cast<const std::int64_t*>(array_of(made[0], "input_row").data), 0);
  EXPECT_EQ(doubles(made[1], "box_of_lines"), (std::vector<double>{ 0 }));
  EXPECT_EQ(inputs.said,
    (std::vector<std::string>{
      "1 of 2 lines are left out: no particle has the id of an end, as in 7 and 9" }));

  const double split = 1;
  made.clear();
  ASSERT_EQ(run_task(inputs.task({ number("PeriodicLines", split) }), made), GRANULAR_OK);
  EXPECT_EQ(doubles(made[0], "ends"), (std::vector<double>{ 1, 5, 5, 0, 5, 5, 10, 5, 5, 9, 5, 5 }));
  EXPECT_EQ(doubles(made[0], "elongation"), (std::vector<double>{ 0.5, 0.5 }));
  EXPECT_EQ(static_cast<const std::int32_t*>(array_of(made[0], "part").data)[1], 1);
}

// Of the bonds as contacts, one is between both particles, and one names a third that is not there.
TEST(CFilters, ContactsAreSummed)
{
  Inputs inputs;
  Frames made;
  const std::vector<granular_setting> arrays = { { "Arrays", "coordination missing", nullptr, 0 } };
  ASSERT_EQ(run_task(inputs.task(arrays, "GranularContactSums"), made), GRANULAR_OK) << message();
  ASSERT_EQ(made.size(), 2U);
  const auto* const counts =
    static_cast<const std::int32_t*>(array_of(made[0], "coordination").data);
  EXPECT_EQ(std::vector<int>(counts, counts + 3), (std::vector<int>{ 2, 1, 0 }));
  EXPECT_EQ(doubles(made[1], "mean_coordination"), (std::vector<double>{ 1.5 }));
  ASSERT_EQ(inputs.said.size(), 2U);
  EXPECT_EQ(inputs.said[1].find("there is no array 'missing': Arrays may name coordination, "), 0U);
  int on = -1;
  EXPECT_STREQ(granular_made_array("GranularContactSums", 5, &on), "principal_stress");
  EXPECT_EQ(on, 0);
  EXPECT_EQ(granular_made_array("GranularContactSums", 10, &on), nullptr);
  EXPECT_EQ(granular_made_array("GranularLocalJoin", 0, nullptr), nullptr);
}

// Particles of mass 1, one in each half of the box, and none within 1 of the duplicate.
TEST(CFilters, ParticlesAreAveraged)
{
  Inputs inputs;
  Frames made;
  const double none = 0;
  const double one = 1;
  const double heaviside = 4;
  const double counts[] = { 2, 1, 1 };
  const granular_setting arrays = { "Arrays", "density", nullptr, 0 };
  const std::vector<granular_setting> of_cells = { arrays, number("Output", none),
    number("Weights", none), { "CellCounts", nullptr, counts, 3 } };
  granular_task task = inputs.task(of_cells, "GranularEulerAverage");
  ASSERT_EQ(run_task(task, made), GRANULAR_OK) << message();
  ASSERT_EQ(made.size(), 2U);
  EXPECT_EQ(doubles(made[0], "points"), (std::vector<double>{ 2.5, 5, 5, 7.5, 5, 5 }));
  EXPECT_EQ(doubles(made[0], "density"), (std::vector<double>{ 1.0 / 500, 1.0 / 500 }));
  EXPECT_EQ(doubles(made[1], "counts"), (std::vector<double>{ 2, 1, 1 }));

  made.clear();
  const std::vector<granular_setting> of_points = { arrays, number("Kernel", heaviside),
    number("KernelWidth", one) };
  task = inputs.task(of_points, "GranularPointAverage");
  ASSERT_EQ(run_task(task, made), GRANULAR_OK) << message();
  const std::vector<double> density = doubles(made[0], "density");
  EXPECT_NEAR(density[0], 0.75 / 3.14159265358979, 1e-12);
  EXPECT_EQ(density[1], density[0]);
  EXPECT_EQ(density[2], 0);
}

// Particle 1 stays, 3 moves by 0.5, 4 is new and 2 is lost.
TEST(CFilters, CompareFindsWhatHasMovedComeAndGone)
{
  struct Run
  {
    std::vector<double> points[2] = { { 1, 0, 0, 2, 0, 0, 3, 0, 0 },
      { 3.5, 0, 0, 1, 0, 0, 9, 0, 0 } };
    std::vector<std::int64_t> ids[2] = { { 1, 2, 3 }, { 3, 1, 4 } };
    granular_array arrays[2][2];
    granular_content contents[2];
  } run;
  for (std::size_t i = 0; i < 2; ++i)
  {
    run.arrays[i][0] = array("points", GRANULAR_FLOAT64, run.points[i], 3);
    run.arrays[i][1] = array("id", GRANULAR_INT64, run.ids[i]);
    granular_content_init(&run.contents[i]);
    run.contents[i].arrays = run.arrays[i];
    run.contents[i].array_count = 2;
    run.contents[i].rows = 3;
  }
  const double times[] = { 0, 2 };
  granular_task task = task_of("GranularCompare", {});
  task.frames = 2;
  task.times = times;
  task.shown = 1;
  task.user = &run;
  task.input = [](std::size_t port, std::size_t frame, const granular_content** content,
                 const char**, void* user)
  {
    *content = port == 0 ? &static_cast<Run*>(user)->contents[frame] : nullptr;
    return 0;
  };
  Frames made;
  ASSERT_EQ(run_task(task, made), GRANULAR_OK) << message();
  const auto* const changes = static_cast<const std::int32_t*>(array_of(made[0], "change").data);
  EXPECT_EQ(
    std::vector<std::int32_t>(changes, changes + 4), (std::vector<std::int32_t>{ 0, 0, 1, 2 }));
  const auto* const rows = static_cast<const std::int64_t*>(array_of(made[0], "input_row").data);
  EXPECT_EQ(std::vector<std::int64_t>(rows, rows + 4), (std::vector<std::int64_t>{ 0, 1, 2, 1 }));
  const std::vector<double> moved = doubles(made[0], "displacement");
  EXPECT_EQ(moved[0], 0.5);
  EXPECT_EQ(moved[3], 0);
  EXPECT_TRUE(std::isnan(moved[6]) && std::isnan(moved[9]));
}

TEST(CFilters, ErrorsSayWhatWasExpected)
{
  const double half = 0.5;
  const double one = 1;
  const auto error = [](const granular_task& task)
  {
    Frames made;
    EXPECT_NE(run_task(task, made), GRANULAR_OK);
    EXPECT_TRUE(made.empty());
    return message();
  };
  const std::string unknown = error(task_of("Sieve", {}));
  EXPECT_EQ(unknown.find("expected a filter of GranularPackingSource, GranularLocalJoin, "), 0U);
  EXPECT_NE(unknown.find(", got 'Sieve'"), std::string::npos);
  EXPECT_EQ(error(task_of("GranularLocalJoin", {})), "expected an input 0, got none");
  const std::pair<granular_setting, const char*> settings[] = {
    { number("Seed", half), "setting 'Seed': expected a whole number of up to 2^53, got 0.5" },
    { number("Boundary", one), "setting 'Boundary': expected a text, got numbers" },
    { number("BoxLengths", one), "setting 'BoxLengths': expected as many numbers as 3, got 1" },
    { { "Radius", "big", nullptr, 0 },
      "setting 'Radius': expected as many numbers as 1, got a text" },
    { { "Radius", nullptr, nullptr, 0 },
      "setting 'Radius': expected a name, and either a text or numbers" },
  };
  for (const auto& [setting, text] : settings)
  {
    EXPECT_EQ(error(task_of("GranularPackingSource", { setting })), text);
  }
  EXPECT_NE(error(task_of("GranularPackingSource", { number("Colour", one) })).find("got 'Colour'"),
    std::string::npos);
  Inputs inputs;
  inputs.failure = "the file is gone";
  EXPECT_EQ(error(inputs.task({})), "the file is gone");
}
