// SPDX-License-Identifier: BSD-3-Clause
// Frames of local data, held against the particles of the same run, and what is read in parts; reader.py has every number.
#include "local_files.h"

#include "../support/many_columns.h"
#include "../support/thread_ranks.h"

#include "granular/formats/dump/grammar/dump_files.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

// A bed at rest: what acts on a particle is its weight and the forces of its contacts, which are opposite on both ends,
// but for those of the ground.
TEST(LocalReader, ForcesAddUp)
{
  constexpr double gravity = 9.81;
  LocalRun run({ local_file("settled_contacts.dump.gz") });
  const granular::Table contacts = run.read(0);
  ASSERT_EQ(contacts.rows, 698);
  granular::RunIndex index;
  granular::Notices notices;
  granular::Progress progress;
  index.update({ local_file("settled_grains.dump.gz") }, { .format = &granular::dump_format() },
    notices, progress);
  const granular::Table particles = granular::read_dump(index.pieces(0), {}, notices, progress);
  ASSERT_EQ(particles.rows, 300);
  const auto ids = values<std::int64_t>(particles, "id");
  std::map<std::int64_t, std::size_t> row_of;
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    row_of[ids[row]] = row;
  }
  const auto* const centres = static_cast<const double*>(particles.points.data());
  const auto radius = values<double>(particles, "radius");
  const auto mass = values<double>(particles, "mass");
  const auto total = values<double>(particles, "f");
  const auto force = values<double>(contacts, "force");
  std::vector<double> sums(total.begin(), total.end());
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    sums[3 * row + 2] += gravity * mass[row];
  }
  const auto* const lengths = static_cast<const double*>(contacts.lines.lengths.data());
  for (std::size_t i = 0; i < 698; ++i)
  {
    const std::size_t first = row_of.at(values<std::int64_t>(contacts, "id1")[i]);
    const std::size_t second = row_of.at(values<std::int64_t>(contacts, "id2")[i]);
    EXPECT_GE(radius[first] + radius[second] - lengths[i], -1e-10);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sums[3 * first + axis] -= force[3 * i + axis];
      sums[3 * second + axis] += force[3 * i + axis];
    }
  }
  std::size_t inside = 0;
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    if (centres[3 * row + 2] < radius[row])
    {
      EXPECT_GT(sums[3 * row + 2], 0) << "the ground bears it";
      continue;
    }
    ++inside;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(sums[3 * row + axis], 0, 1e-9 * gravity * mass[row] + 1e-11);
    }
  }
  EXPECT_GT(inside, 200u);
}

// Threads, pieces and ranks change nothing.
TEST(LocalReader, PartsAreTheWhole)
{
  std::vector<std::string> rows;
  for (int i = 0; i < 20'000; ++i)
  {
    rows.push_back(std::to_string(i % 97) + " " + std::to_string(i * 7 % 1009) + " 0.25 9." +
      std::to_string(i) + " 1 2 3 4 " + std::to_string(i % 5));
  }
  const std::string columns = "id1 id2 x1 y1 z1 x2 y2 z2 c_v";
  const std::string path = write_text("parts.dump", local_frame(columns, rows));
  for (const granular::PeriodicLines periodic :
    { granular::PeriodicLines::MinimumImage, granular::PeriodicLines::Split })
  {
    LocalRun run({ path });
    granular::Request request;
    request.periodic_lines = periodic;
    const std::vector<std::string> names = granular::name_columns(run.columns());
    const granular::Table whole = run.read(0, request, names);
    const auto points_of = [](const granular::Table& frame)
    {
      const auto* points = static_cast<const double*>(frame.lines.points.data());
      return std::vector<double>(points, points + 6 * frame.lines.count);
    };
    for (const int ranks : { 1, 2, 3 })
    {
      std::vector<std::vector<double>> points(static_cast<std::size_t>(ranks));
      std::vector<std::int64_t> first(static_cast<std::size_t>(ranks));
      std::vector<std::int64_t> counts(static_cast<std::size_t>(ranks));
      run_ranks(ranks,
        [&](granular::Communicator& communicator)
        {
          const auto rank = static_cast<std::size_t>(communicator.rank());
          granular::Request own = request;
          own.piece = communicator.rank();
          own.pieces = ranks;
          own.threads = 2;
          granular::Notices notices;
          granular::Progress progress;
          const granular::Table part = granular::read_local(
            run.index().pieces(0), names, own, communicator, notices, progress);
          points[rank] = points_of(part);
          first[rank] = part.first_row;
          counts[rank] = part.rows;
        });
      std::vector<double> joined;
      std::int64_t before = 0;
      for (std::size_t rank = 0; rank < points.size(); ++rank)
      {
        joined.insert(joined.end(), points[rank].begin(), points[rank].end());
        EXPECT_EQ(first[rank], before);
        before += counts[rank];
      }
      EXPECT_EQ(joined, points_of(whole));
    }
  }
}

// Flags that are none: the columns are something else.
TEST(LocalReader, FlagsThatAreNone)
{
  const std::string path = write_text(
    "flags.dump", local_frame("x1 y1 z1 x2 y2 z2 id1 id2 periodic", { "1 1 1 2 1 1 1 2 7" }));
  LocalRun run({ path });
  EXPECT_EQ(error_of([&] { run.read(0); }),
    path +
      ":1: expected the flags 0 and 1 in the column that is taken for periodic, got 7: bonds have "
      "their type there, contacts with walls a particle (wall_id in ColumnMap)");
}

// 0.5 is no integer: the column is kept as doubles, and is what it is there, too.
TEST(LocalReader, FlagsThatAreNoIntegers)
{
  LocalRun run({ write_text("a.dump", local_frame("id1 id2 periodic", { "1 2 0", "2 3 0.5" })) });
  EXPECT_NE(
    error_of([&] { run.read(0); }).find("in the column that is taken for periodic, got 0.5"),
    std::string::npos);
}

// A word in one of the pieces makes the column one of texts in all of them: no sample for the presets.
TEST(LocalReader, TextsOfAPiece)
{
  const std::string names[] = { "a b c", "c_1[1] c_1[2] c", "c_1[1] c_1[2] c_1[3]" };
  for (const std::string& columns : names)
  {
    LocalRun run({ write_text("a.0.dump", local_frame(columns, { "1 2 3" })),
      write_text("a.1.dump", local_frame(columns, { "2 3 no", "3 4 yes", "4 5 no" })) });
    ASSERT_EQ(run.pieces(0), 2u) << columns;
    granular::Progress progress;
    const granular::FrameKind& kind = *run.index().first_piece(0).entry.kind;
    if (columns == names[2])
    {
      EXPECT_NE(
        error_of([&] { run.read(0); }).find("expected a number, got 'no'"), std::string::npos);
      continue;
    }
    EXPECT_EQ(granular::read_sample(run.index(), kind, progress).rows, 0u);
    const granular::Table frame = run.read(0);
    ASSERT_EQ(frame.rows, 4);
    const granular::TableArray& texts = frame.arrays.back();
    std::string words;
    for (const std::int32_t word : values<std::int32_t>(frame, "c"))
    {
      words += texts.words.at(static_cast<std::size_t>(word)) + " ";
    }
    EXPECT_EQ(words, "3 no yes no ");
  }
}

// Columns with the names of the arrays that lines are made of are none of these.
TEST(LocalReader, ColumnsNamedAsEnds)
{
  for (const char* columns : { "id1 id2 position1 position2", "position1 position2 id1 id2" })
  {
    LocalRun run({ write_text("a.dump", local_frame(columns, { "1 2 3 4", "2 3 4 5" })) });
    const granular::Table frame = run.read(0);
    EXPECT_FALSE(frame.has_lines);
    EXPECT_EQ(frame.rows, 2);
  }
}

TEST(LocalReader, AsManyColumnsAsThereMayBe)
{
  constexpr int many = many_columns;
  for (const std::string form : { "c_#[4999]", "c_a[#]" })
  {
    const std::string columns = line_of_many("", form);
    const std::string row = line_of_many("", "#");
    LocalRun run({ write_text("a.dump", local_frame(columns, { row, row })) });
    const granular::Table frame = run.read(0, {}, run.columns());
    EXPECT_EQ(frame.rows, 2);
    EXPECT_EQ(frame.arrays.size(), form == "c_a[#]" ? 1u : many) << form;
    granular::Progress progress;
    const granular::FrameKind& kind = *run.index().first_piece(0).entry.kind;
    EXPECT_EQ(granular::read_sample(run.index(), kind, progress).values.size(), 2u * many);
  }
  const std::string columns = line_of_many("", "c_a[#]", many + 1);
  const std::string file = write_text("b.dump", local_frame(columns, {}));
  EXPECT_EQ(error_of([&] { const LocalRun run({ file }); }),
    file + ":9: expected at most 5000 columns, got 5001");
}

// %g has six digits: of ids that are printed with an exponent the others are lost.
TEST(LocalReader, RoundedIdsAreCounted)
{
  const auto said = [](const std::vector<std::string>& rows)
  {
    const std::string path = write_text("rounded.dump", local_frame("id1 id2", rows));
    LocalRun run({ path });
    run.read(0);
    const std::string text = run.said();
    return text.empty() ? text : text.substr(path.size(), text.find(" ids") - path.size());
  };
  EXPECT_EQ(said({ "1 2", "999999 -999999" }), "");
  EXPECT_EQ(said({ "1 2", "1e+06 3", "1.23457e+06 1.2345e+09" }), ":1: column 'id1 and id2': 3");
  EXPECT_EQ(said({ "1 2", "1000000 2000000" }), "") << "printed as they are";
  EXPECT_EQ(said({ "1 2", "1234567 2000000" }), "");
  EXPECT_EQ(said({ "-1e+06 2" }), ":1: column 'id1 and id2': 1");
}

// The column dist says how far apart the ends are.
TEST(LocalReader, LinesThatAreNotAsLongAsDistSays)
{
  const auto said = [](const std::string& row)
  {
    const std::string path =
      write_text("dist.dump", local_frame("x1 y1 z1 x2 y2 z2 dist", { row, "1 1 1 1 1 2 1" }));
    LocalRun run({ path });
    run.read(0);
    return run.said().substr(run.said().empty() ? 0 : path.size());
  };
  EXPECT_EQ(said("1 1 1 9.5 1 1 1.5"), "");
  EXPECT_EQ(said("1 1 1 7 1 1 6"),
    ":1: column 'dist': 1 of 2 lines are not as long as the column dist says\n");
}
