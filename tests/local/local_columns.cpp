// SPDX-License-Identifier: BSD-3-Clause
// What columns mean that files do not name.
#include "local_files.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace
{
/// Returns the meaning that a file with these rows gets, the error behind its path, or the remark where no preset fits.
std::string taken(const std::string& columns, const std::vector<std::string>& rows)
{
  const std::string path = write_text("columns.dump", local_frame(columns, rows));
  LocalRun run({ path });
  std::string found;
  const std::string error = error_of([&] { found = run.found(); });
  return !error.empty()                               ? error.substr(path.size())
    : run.said().find("AsNamed") != std::string::npos ? found + run.said().substr(path.size())
                                                      : found;
}

constexpr const char* contacts = "x1 y1 z1 x2 y2 z2 id1 id2 periodic forcex forcey forcez";
constexpr const char* bonds = "x1 y1 z1 x2 y2 z2 id1 id2 btype forcex forcey forcez";
constexpr const char* walls = "x1 y1 z1 x2 y2 z2 mesh triangle id2 forcex forcey forcez";
}

TEST(LocalColumns, NamesThatSayIt)
{
  EXPECT_EQ(taken("batom1 batom2 btype", { "1 2 1" }), "id1 id2 btype");
  EXPECT_EQ(
    taken("x1 y1 z1 x2 y2 z2 id1 id2 periodic fx fy fz", { "1 1 1 2 2 2 1 2 0 0 0 1" }), contacts);
  EXPECT_EQ(
    taken("batom1x batom1y batom1z batom2x batom2y batom2z batom1 batom2 btype bforceX bforceY "
          "bforceZ btorqueX btorqueY btorqueZ beqdist",
      { "1 1 1 2 2 2 1 2 1 0 0 1 0 0 0 1.5" }),
    "x1 y1 z1 x2 y2 z2 id1 id2 btype forcex forcey forcez torquex torquey torquez "
    "equilibrium_length");
  EXPECT_EQ(taken("index natom1 natom2 c_d", { "1 1 2 0.5" }), "index id1 id2 c_d");
  EXPECT_EQ(taken("ParticleIdentifiers.A ParticleIdentifiers.B BondType", { "1 2 1", "2 3 2" }),
    "id1 id2 btype")
    << "as OVITO has them";
  EXPECT_EQ(taken("bond_id bond_type atom1 atom2", { "1 1 1 2" }), "bond_id btype id1 id2");
}

// Column 9 tells bonds from contacts, and from contacts with walls.
TEST(LocalColumns, TwelveColumns)
{
  const std::string names = silent_columns(12);
  EXPECT_EQ(taken(names, { "1 1 1 2 1 1 7 8 0 0 0 5", "2 1 1 3 1 1 8 9 0 0 0 5" }), contacts);
  EXPECT_EQ(taken(names,
              { "1 1 1 2 1 1 7 8 1 0 0 5", "2 1 1 3 1 1 8 9 2 0 0 5", "3 1 1 4 1 1 9 10 1 0 0 5" }),
    bonds);
  EXPECT_EQ(taken(names, { "1 1 1 2 1 1 7 8 1 0 0 5", "2 1 1 3 1 1 8 9 1 0 0 5" }), bonds)
    << "flags that are not those of the box";
  EXPECT_EQ(taken(names, { "1 1 1 9.5 1 1 7 8 1 0 0 5", "1 1 1 3 1 1 7 9 0 0 0 5" }), contacts);
  EXPECT_EQ(taken(names, { "1 1 0 1 1 0.5 1 40 7 0 0 5", "2 2 0 2 2 0.5 1 41 8 0 0 5" }), walls)
    << "the first id would be at two places";
  EXPECT_EQ(taken(names, { "1 1 0 1 1 0.5 0 40 7 0 0 5" }), walls) << "particles count from 1";
}

// Several presets that fit are an error that lists them; where none does, the names count, and a line says how to get lines.
TEST(LocalColumns, Undecidable)
{
  const std::string both = taken(silent_columns(12), { "1 1 1 9.5 1 1 7 8 1 0 0 5" });
  EXPECT_EQ(both.substr(0, both.find(" (x1")),
    ":1: expected columns whose names say what they hold, got " + silent_columns(12) +
      "; several presets fit the values: BondsForce");
  EXPECT_NE(both.find("ContactsForce"), std::string::npos);
  EXPECT_TRUE(both.ends_with("; set Preset or ColumnMap"));
  EXPECT_NE(
    taken(silent_columns(3), { "1 2 1", "1 3 1" }).find("several presets fit"), std::string::npos);
  EXPECT_NE(
    taken(silent_columns(3), { "0.5 2 1" }).find("no preset fits the values"), std::string::npos);
  EXPECT_EQ(taken("atype aatom1 aatom2 aatom3", { "1 1 2 3", "1 2 3 4" }),
    "atype aatom1 aatom2 aatom3:1: no preset has as many columns: the columns keep their names "
    "(Preset AsNamed), and no lines are drawn. To draw them, name the particles in ColumnMap, as "
    "in id1=2 id2=3, or the ends, x1 y1 z1 x2 y2 z2, or write the keywords of the compute there, "
    "as in pos id force\n");
}

// Two contacts with two walls, or two bonds of two types: few rows do not say which.
TEST(LocalColumns, FewRowsOfWalls)
{
  const std::string both =
    taken(silent_columns(12), { "1 1 0 1 1 0.5 1 40 7 0 0 5", "2 2 0 2 2 0.5 2 41 8 0 0 5" });
  EXPECT_NE(both.find("several presets fit the values: BondsForce"), std::string::npos) << both;
  EXPECT_NE(both.find("WallContactsForce"), std::string::npos);
}

// What stands where forces should may be contact points.
TEST(LocalColumns, ForcesThatAreNone)
{
  const std::vector<std::string> ends = { "1 1 1 2 1 1 7 8 0 ", "2 1 1 3 1 1 8 9 0 ",
    "3 1 1 4 1 1 9 10 0 " };
  const auto with = [&](const std::vector<std::string>& last)
  {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < ends.size(); ++i)
    {
      rows.push_back(ends[i] + last[i]);
    }
    return taken(silent_columns(12), rows);
  };
  EXPECT_EQ(with({ "0 0 5", "0.5 0 0", "1 2 3.5" }), contacts);
  EXPECT_EQ(with({ "0 0 0", "0 0 0", "0 0 0" }), contacts) << "no force acts";
  EXPECT_NE(with({ "1.5 1 1", "2.5 1 1", "3.5 1 1" }).find("no preset fits"), std::string::npos);
}

// Without a box nobody knows which contacts cross a face: the flag is taken at its word.
TEST(LocalColumns, WithoutABox)
{
  const std::string path = write_text("boxless.dump",
    local_frame(silent_columns(12),
      { "1 1 1 9.5 1 1 7 8 1 0 0.5 5", "2 1 1 3 1 1 8 9 0 0 0.5 5", "2 2 1 3 2 1 5 6 0 0 0.5 5" },
      ""));
  EXPECT_EQ(LocalRun({ path }).found(), contacts);
}

TEST(LocalColumns, TypesHaveFewValues)
{
  std::vector<std::string> type_first;
  std::vector<std::string> type_last;
  for (int i = 1; i <= 9; ++i)
  {
    const std::string ids = std::to_string(i) + " " + std::to_string(i + 1);
    const std::string type = std::to_string(i % 2 + 1);
    type_first.push_back(type + " " + ids);
    type_last.push_back(ids + " " + type);
  }
  EXPECT_EQ(taken(silent_columns(3), type_first), "btype id1 id2");
  EXPECT_EQ(taken(silent_columns(3), type_last), "id1 id2 btype");
  type_last[4] = "5 6 -2"; // breaking
  EXPECT_EQ(taken(silent_columns(3), type_last), "id1 id2 btype");
  type_last[4] = "5 6 0"; // damaged
  EXPECT_TRUE(
    taken(silent_columns(3), type_last)
      .ends_with("; no preset fits the values, but for a few rows: BondIds (id1 id2 btype); "
                 "set Preset or ColumnMap"));
}

// One frame with rows says what all are.
TEST(LocalColumns, TheFrameWithMostRowsDecides)
{
  const std::string names = silent_columns(12);
  const std::string path = write_text("most.dump",
    local_frame(names, {}) +
      local_frame(names, { "1 1 1 9.5 1 1 7 8 1 0 0 5" }, "BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10",
        "ENTRIES", 1) +
      local_frame(names, { "1 1 1 2 1 1 7 8 0 0 0 5", "2 1 1 3 1 1 8 9 0 0 0 5" },
        "BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10", "ENTRIES", 2));
  for (std::size_t frame = 0; frame < 3; ++frame)
  {
    EXPECT_EQ(LocalRun({ path }).found(frame), contacts);
  }
}

TEST(LocalColumns, ComponentsOfArrays)
{
  using Names = std::vector<std::string>;
  EXPECT_EQ(granular::local_component_names("force", 3), (Names{ "forcex", "forcey", "forcez" }));
  EXPECT_EQ(granular::local_component_names("position2", 3), (Names{ "x2", "y2", "z2" }));
  EXPECT_EQ(granular::local_component_names("force", 1), Names{});
  EXPECT_EQ(granular::local_component_names("id1", 1), Names{});
  EXPECT_EQ(granular::local_component_names("", 1), Names{});
  // they are read back as the array they are of
  for (const granular::KnownColumn& column : granular::local_known_columns())
  {
    const Names names = granular::local_component_names(column.array, column.components);
    const granular::ColumnSchema schema = granular::make_local_schema(names);
    EXPECT_EQ(names.empty(), column.array.empty()) << column.name;
    EXPECT_EQ(schema.arrays().size(), column.array.empty() ? 0u : 1u) << column.name;
  }
}

TEST(ColumnMap, NamesAndKeywords)
{
  using granular::join_words;
  using granular::name_columns;
  const std::vector<std::string> three = { "index", "c_a[1]", "c_a[2]" };
  EXPECT_EQ(join_words(name_columns(three, std::string("index id1,id2"))), "index id1 id2");
  EXPECT_EQ(join_words(name_columns(three, std::string("id1=2 id2=c_a[2]"))), "index id1 id2");
  EXPECT_EQ(join_words(name_columns(three, std::string("batom1=2 mine=3"))), "index id1 mine");
  const std::vector<std::string> many(22, "c");
  const std::string order =
    "x1 y1 z1 x2 y2 z2 vx1 vy1 vz1 vx2 vy2 vz2 id1 id2 periodic forcex forcey forcez "
    "torquex torquey torquez delta";
  EXPECT_EQ(join_words(name_columns(many, std::string("pos vel id force torque delta"))), order);
  EXPECT_EQ(join_words(name_columns(many, std::string("delta torque force id vel pos"))), order)
    << "a compute prints in an order of its own";
  EXPECT_EQ(
    join_words(name_columns(std::vector<std::string>(4, "c"), std::string("index wall_id"))),
    "index mesh triangle id2");
  // a name that the file has, too, is the user's now
  EXPECT_EQ(join_words(name_columns({ "id1", "id2", "c_x", "c_y" }, std::string("id1=c_x id2=4"))),
    "id1_file id2_file id1 id2");
  EXPECT_EQ(join_words(name_columns(std::vector<std::string>(6, "c"), std::string("history id"))),
    "id1 id2 periodic history1 history2 history3");
  // one name a column: of LAMMPS, whose force is a number
  EXPECT_EQ(join_words(name_columns(
              std::vector<std::string>(7, "c"), std::string("index patom1 patom2 force fx fy fz"))),
    "index id1 id2 force forcex forcey forcez");
}

// History stands for fewer columns if the last ones of a compute were not dumped, and all behind it are others.
TEST(ColumnMap, HistoryThatIsContradicted)
{
  // two contacts of pair/gran/local pos id history contactArea contactPoint ms_id, with three numbers of history
  const std::vector<std::string> rows = {
    "0 0 0 2 0 0 1 2 0 -0.1 0.2 0.3 0.5 1 0 0 7 8",
    "0 0 3 0 2 3 1 3 0 0.2 -0.2 0.1 0.6 0 1 3 7 -1",
  };
  const auto error = [&](std::size_t left_out, const std::string& map)
  {
    std::vector<std::string> cut;
    for (const std::string& row : rows)
    {
      std::vector<std::string_view> words = granular::split_words(row);
      words.resize(words.size() - left_out);
      cut.push_back(granular::join_words(words));
    }
    const std::string path =
      write_text("cut.dump", local_frame(silent_columns(static_cast<int>(18 - left_out)), cut, ""));
    LocalRun run({ path });
    granular::Progress progress;
    const granular::LocalSample sample =
      granular::read_sample(run.index(), *run.index().first_piece(0).entry.kind, progress);
    return error_of(
      [&] {
        granular::check_history(run.columns(), granular::name_columns(run.columns(), map), sample);
      });
  };
  const std::string map = "pos id history contactArea contactPoint ";
  EXPECT_EQ(error(0, map + "ms_id"), "");
  EXPECT_EQ(error(1, map + "ms_id"),
    "expected points between the ends, got none, in the column c_a[13] that is taken for "
    "contact_pointx: history in ColumnMap stands for the columns that are left, here 2; the last "
    "columns of the compute may not be in the file");
  EXPECT_EQ(error(2, map + "ms_id").substr(0, 84),
    "expected no negative numbers, got -0.2, in the column c_a[11] that is taken for cont");
  EXPECT_EQ(error(2, map), "");
  EXPECT_NE(error(3, map), "");
}

TEST(ColumnMap, Errors)
{
  const std::vector<std::string> columns = { "c_a[1]", "c_a[2]", "c_a[3]" };
  const auto error = [&](const char* map)
  { return error_of([&] { granular::name_columns(columns, std::string(map)); }); };
  EXPECT_EQ(error("id1 id2 id1"), "expected each name once in the column map, got 'id1' twice");
  EXPECT_EQ(error("id1=1 batom1=2"), "expected each name once in the column map, got 'id1' twice");
  EXPECT_EQ(error("id1=1 id2=c_a[1]"),
    "expected each column once in the column map, got c_a[1] as 'id1' and as 'id2'");
  EXPECT_EQ(error("id1=4").substr(0, 30), "expected a column, or its numb");
  EXPECT_EQ(
    error("id1=1 id2"), "expected NAME=COLUMN in the column map, as in its other words, got 'id2'");
  EXPECT_EQ(
    error("id1="), "expected NAME=COLUMN in the column map, as in its other words, got 'id1='");
}

TEST(Presets, ColumnsAreInTheTable)
{
  std::set<std::string_view> names;
  for (const granular::LocalPreset& preset : granular::local_presets())
  {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    for (const std::string_view column : granular::split_words(preset.columns))
    {
      EXPECT_NE(granular::find_known_column(column, granular::local_known_columns()), nullptr)
        << column;
    }
  }
  EXPECT_EQ(names.size(), 11u);
}
