// SPDX-License-Identifier: BSD-3-Clause
#include "granular/columns/column.h"

#include "../support/dumps.h"

#include "granular/common/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using granular::ArrayInfo;
using granular::ColumnRole;
using granular::ColumnSchema;
using granular::ValueType;

ColumnSchema schema_of(const std::string& names)
{
  const std::vector<std::string_view> words = granular::split_words(names);
  return ColumnSchema(std::vector<std::string>(words.begin(), words.end()));
}

/// "name(columns)" of each array, the columns from 0.
std::string arrays_of(const std::string& names)
{
  const ColumnSchema schema = schema_of(names);
  std::string text;
  for (const ArrayInfo& array : schema.arrays())
  {
    text += text.empty() ? "" : " ";
    text += array.name + "(";
    for (const int column : array.columns)
    {
      text += (text.back() == '(' ? "" : ",") + std::to_string(column);
    }
    text += ")";
  }
  return text;
}

const ArrayInfo& array_of(const ColumnSchema& schema, const std::string& name)
{
  const int index = schema.find_array(name);
  if (index < 0)
  {
    throw std::out_of_range("no array " + name);
  }
  return schema.arrays()[static_cast<std::size_t>(index)];
}

ValueType type_of(const std::string& name)
{
  return schema_of(name).arrays().at(0).type;
}
}

// ---- the table ---------------------------------------------------------------------------------

TEST(KnownColumns, EveryWordOfDumpCustomIsThere)
{
  // LIGGGHTS 3.8.0 dump_custom.cpp, LIGGGHTS-PFM, LAMMPS
  for (const char* name : { "id", "mask", "mol", "id_multisphere", "type", "element", "mass", "x",
         "y", "z", "xs", "ys", "zs", "xu", "yu", "zu", "xsu", "ysu", "zsu", "ix", "iy", "iz", "vx",
         "vy", "vz", "fx", "fy", "fz", "q", "density", "p", "rho", "mux", "muy", "muz", "mu",
         "radius", "diameter", "omegax", "omegay", "omegaz", "angmomx", "angmomy", "angmomz", "tqx",
         "tqy", "tqz", "spin", "eradius", "ervel", "erforce", "shapex", "shapey", "shapez", "quat1",
         "quat2", "quat3", "quat4", "blockiness1", "blockiness2", "roundness1", "roundness2",
         "inertiax", "inertiay", "inertiaz", "heatflow", "temperature", "thread", "proc", "procp1",
         "c_a", "c_a[1]", "f_b", "f_b[12]", "v_c", "d_d", "i_e", "i2_f[2]", "d2_g[3]" })
  {
    EXPECT_NE(granular::find_known_column(name), nullptr) << name;
  }
  for (const char* name : { "", "ID", "X", "xx", "id2", "c", "quat5", "vel", "c[1]", "i", "xsus" })
  {
    EXPECT_EQ(granular::find_known_column(name), nullptr) << name;
  }
}

TEST(KnownColumns, NoNameTwice)
{
  std::set<std::string> names;
  for (const granular::KnownColumn& column : granular::known_columns())
  {
    EXPECT_TRUE(names.insert(std::string(column.name)).second) << column.name;
    EXPECT_LT(column.component, std::max(column.components, 3)) << column.name;
    EXPECT_EQ(column.components > 1, !column.array.empty()) << column.name;
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
}

TEST(KnownColumns, Types)
{
  EXPECT_EQ(type_of("id"), ValueType::Int64);
  EXPECT_EQ(type_of("type"), ValueType::Int32);
  EXPECT_EQ(type_of("mask"), ValueType::Int32);
  for (const char* name :
    { "mol", "id_multisphere", "proc", "procp1", "thread", "spin", "i_any", "i2_a[1]" })
  {
    EXPECT_EQ(type_of(name), ValueType::Int64) << name;
  }
  EXPECT_EQ(type_of("element"), ValueType::Text);
  for (const char* name :
    { "x", "radius", "c_a", "c_a[3]", "f_b[1]", "v_c", "d_e", "mass", "unheard", "q" })
  {
    EXPECT_EQ(type_of(name), ValueType::Float64) << name;
  }
  EXPECT_EQ(array_of(schema_of("ix iy iz"), "image").type, ValueType::Int32);
  EXPECT_EQ(granular::size_of(ValueType::Int32), 4u);
  EXPECT_EQ(granular::size_of(ValueType::Int64), 8u);
  EXPECT_EQ(granular::size_of(ValueType::Float64), 8u);
}

// ---- arrays ------------------------------------------------------------------------------------

TEST(ColumnSchema, VectorsOfTheTable)
{
  EXPECT_EQ(arrays_of("vx vy vz"), "v(0,1,2)");
  EXPECT_EQ(arrays_of("fx fy fz"), "f(0,1,2)");
  EXPECT_EQ(arrays_of("omegax omegay omegaz"), "omega(0,1,2)");
  EXPECT_EQ(arrays_of("angmomx angmomy angmomz"), "angmom(0,1,2)");
  EXPECT_EQ(arrays_of("tqx tqy tqz"), "tq(0,1,2)");
  EXPECT_EQ(arrays_of("mux muy muz"), "mu(0,1,2)");
  EXPECT_EQ(arrays_of("shapex shapey shapez"), "shape(0,1,2)");
  EXPECT_EQ(arrays_of("quat1 quat2 quat3 quat4"), "quat(0,1,2,3)");
  EXPECT_EQ(arrays_of("quatw quati quatj quatk"), "quat(0,1,2,3)");
  for (const std::string name : { "blockiness", "block", "roundness" })
  {
    EXPECT_EQ(arrays_of(name + "2 " + name + "1"), "blockiness(1,0)");
  }
  EXPECT_EQ(arrays_of("ix iy iz"), "image(0,1,2)");
  // named by the axis, so the order of the columns does not matter
  EXPECT_EQ(arrays_of("vz id vx vy"), "v(2,3,0) id(1)");
}

TEST(ColumnSchema, SizesOfShapesAreWhatTheProgramMeans)
{
  using granular::ShapeSizes;
  const auto sizes = [](const std::string& columns, bool lammps = false)
  { return granular::find_shape_sizes(schema_of(columns), lammps); };
  EXPECT_EQ(sizes("id shapex shapey"), ShapeSizes::None);
  EXPECT_EQ(sizes("id shapex shapey shapez"), ShapeSizes::HalfAxes);
  EXPECT_EQ(sizes("id shapex shapey shapez", true), ShapeSizes::Diameters);
  EXPECT_EQ(sizes("id shapex shapey shapez quatw"), ShapeSizes::Diameters);
  EXPECT_EQ(sizes("block1 shapex shapey shapez"), ShapeSizes::Diameters);
  EXPECT_EQ(sizes("id shapex shapey shapez quat1", true), ShapeSizes::HalfAxes);
  EXPECT_EQ(sizes("id shapex shapey shapez blockiness1", true), ShapeSizes::HalfAxes);
}

TEST(ColumnSchema, IncompleteVectorsStayColumns)
{
  EXPECT_EQ(arrays_of("vx vy"), "vx(0) vy(1)");
  EXPECT_EQ(arrays_of("quat1 quat2 quat4"), "quat1(0) quat2(1) quat4(2)");
  EXPECT_EQ(arrays_of("ix iz"), "ix(0) iz(1)");
  EXPECT_EQ(arrays_of("inertiax inertiay inertiaz"), "inertiax(0) inertiay(1) inertiaz(2)");
}

// The 19 columns of a LIGGGHTS tutorial.
TEST(ColumnSchema, ATypicalDump)
{
  const ColumnSchema schema =
    schema_of("id type type x y z ix iy iz vx vy vz fx fy fz omegax omegay omegaz radius");
  std::string names;
  for (const ArrayInfo& array : schema.arrays())
  {
    names += array.name + (array.position_form ? "* " : " ");
  }
  EXPECT_EQ(names, "id type type_2 x* y* z* image v f omega radius ");
  EXPECT_EQ(array_of(schema, "id").role, ColumnRole::Id);
  EXPECT_EQ(array_of(schema, "radius").role, ColumnRole::Radius);
  EXPECT_EQ(array_of(schema, "omega").components(), 3);
  EXPECT_EQ(schema.find(ColumnRole::Position, 1), 4);
  EXPECT_EQ(schema.find(ColumnRole::Image, 2), 8);
  EXPECT_EQ(schema.find(ColumnRole::ScaledPosition, 0), -1);
  EXPECT_EQ(schema.find_array("vx"), -1);
}

TEST(ColumnSchema, TrapElementsOfComputesFixesAndVariables)
{
  EXPECT_EQ(arrays_of("c_a[1] c_a[2] c_a[3]"), "c_a(0,1,2)");
  EXPECT_EQ(arrays_of("f_xyz[1] f_xyz[2]"), "f_xyz(0,1)");
  EXPECT_EQ(
    arrays_of("v_a[1] v_a[2] d2_b[1] d2_b[2] i2_c[1] i2_c[2]"), "v_a(0,1) d2_b(2,3) i2_c(4,5)");
  EXPECT_EQ(arrays_of("id c_a[1] x c_a[2]"), "id(0) c_a(1,3) x(2)");
  EXPECT_EQ(arrays_of("c_a[1] c_b[1] c_a[2] c_b[2]"), "c_a(0,2) c_b(1,3)");
}

TEST(ColumnSchema, ElementsThatAreNotAllThereStayColumns)
{
  EXPECT_EQ(arrays_of("c_a[1]"), "c_a[1](0)");
  EXPECT_EQ(arrays_of("c_a[2] c_a[3]"), "c_a[2](0) c_a[3](1)");
  EXPECT_EQ(arrays_of("c_a[1] c_a[3]"), "c_a[1](0) c_a[3](1)");
  EXPECT_EQ(arrays_of("c_a[1] c_a[2] c_a[4]"), "c_a[1](0) c_a[2](1) c_a[4](2)");
  EXPECT_EQ(arrays_of("c_a[1] c_a[4000000000]"), "c_a[1](0) c_a[4000000000](1)");
  EXPECT_EQ(arrays_of("c_a[1] c_a[1000000000]"), "c_a[1](0) c_a[1000000000](1)");
  EXPECT_EQ(arrays_of("c_a[0] c_a[1]"), "c_a(0,1)") << "own codes count from 0";
  EXPECT_EQ(arrays_of("c_a[0] c_a[2]"), "c_a[0](0) c_a[2](1)");
  EXPECT_EQ(arrays_of("c_a[-1] c_a[1x] c_a[] c_a[1"), "c_a[-1](0) c_a[1x](1) c_a[](2) c_a[1(3)");
  EXPECT_EQ(arrays_of("x_a[1] x_a[2] [1] [2]"), "x_a[1](0) x_a[2](1) [1](2) [2](3)");
}

TEST(ColumnSchema, ElementsOutOfOrderStayColumns)
{
  EXPECT_EQ(arrays_of("c_a[2] c_a[1]"), "c_a[2](0) c_a[1](1)");
  EXPECT_EQ(arrays_of("c_a[1] c_a[3] c_a[2]"), "c_a[1](0) c_a[3](1) c_a[2](2)");
}

// VTK's own order of a symmetric tensor is another one: a reader that changes places must say so,
// this one does not change them.
TEST(ColumnSchema, TrapSixElementsAreNotReordered)
{
  EXPECT_EQ(arrays_of("c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6]"), "c_s(0,1,2,3,4,5)");
  EXPECT_EQ(arrays_of("c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6] c_s[7] c_s[8] c_s[9] c_s[10]"),
    "c_s(0,1,2,3,4,5,6,7,8,9)");
}

TEST(ColumnSchema, TrapDuplicateNames)
{
  EXPECT_EQ(arrays_of("id id id"), "id(0) id_2(1) id_3(2)");
  EXPECT_EQ(arrays_of("q q_2 q"), "q(0) q_2(1) q_3(2)");
  EXPECT_EQ(arrays_of("x x"), "x(0) x_2(1)");
  // as in an example of LIGGGHTS-INL
  EXPECT_EQ(arrays_of("c_cmpbond[1] c_cmpbond[1] c_cmpbond[3]"),
    "c_cmpbond[1](0) c_cmpbond[1]_2(1) c_cmpbond[3](2)");
  EXPECT_EQ(arrays_of("c_a[1] c_a[2] c_a[1]"), "c_a(0,1) c_a[1](2)");
  EXPECT_EQ(arrays_of("vx vy vz vx"), "v(0,1,2) vx(3)");
  EXPECT_EQ(arrays_of("v vx vy vz"), "v(0) v_2(1,2,3)");
  EXPECT_EQ(arrays_of("mu mux muy muz"), "mu(0) mu_2(1,2,3)");
  EXPECT_EQ(arrays_of("c_a c_a[1] c_a[2]"), "c_a(0) c_a_2(1,2)");
}

TEST(ColumnSchema, ARoleIsTheFirstColumns)
{
  const ColumnSchema schema = schema_of("id id x y z x radius radius");
  EXPECT_EQ(schema.find(ColumnRole::Id), 0);
  EXPECT_EQ(array_of(schema, "id").role, ColumnRole::Id);
  EXPECT_EQ(array_of(schema, "id_2").role, ColumnRole::Other);
  EXPECT_EQ(array_of(schema, "id_2").type, ValueType::Int64);
  EXPECT_FALSE(array_of(schema, "x_2").position_form);
}

TEST(ColumnSchema, NoColumnIsLost)
{
  const std::string names =
    "id c_a[1] c_a[1] vx vx vy vz quat1 quat1 c_b[2] c_b[1] diameter diameter ix ix iy iz iz [1] x";
  const ColumnSchema schema = schema_of(names);
  std::set<int> seen;
  std::set<std::string> unique;
  for (const ArrayInfo& array : schema.arrays())
  {
    seen.insert(array.columns.begin(), array.columns.end());
    EXPECT_TRUE(unique.insert(array.name).second) << array.name;
  }
  EXPECT_EQ(seen.size(), schema.columns().size());
  EXPECT_EQ(schema.text(), names);
}

TEST(ColumnSchema, RadiusFromDiameter)
{
  const ColumnSchema schema = schema_of("id diameter");
  EXPECT_EQ(arrays_of("id diameter"), "id(0) diameter(1) radius(1)");
  EXPECT_EQ(array_of(schema, "radius").scale, 0.5);
  EXPECT_EQ(array_of(schema, "radius").role, ColumnRole::Radius);
  EXPECT_EQ(array_of(schema, "diameter").scale, 1);
  EXPECT_EQ(arrays_of("diameter radius"), "diameter(0) radius(1)");
  EXPECT_EQ(array_of(schema_of("diameter radius"), "radius").scale, 1);
}

TEST(ColumnSchema, SetTypeReachesTheWholeVector)
{
  ColumnSchema schema = schema_of("id ix iy iz unheard");
  schema.set_type(2, ValueType::Float64);
  schema.set_type(4, ValueType::Text);
  EXPECT_EQ(array_of(schema, "image").type, ValueType::Float64);
  EXPECT_EQ(schema.columns()[1].type, ValueType::Float64);
  EXPECT_EQ(schema.columns()[3].type, ValueType::Float64);
  EXPECT_EQ(array_of(schema, "unheard").type, ValueType::Text);
  EXPECT_EQ(array_of(schema, "id").type, ValueType::Int64);
  EXPECT_FALSE(schema == schema_of("id ix iy iz unheard"));
}

TEST(ColumnSchema, AVectorOfWordsIsNone)
{
  ColumnSchema schema = schema_of("id c_a[1] c_a[2] c_a f_b[1] f_b[2]");
  ASSERT_EQ(schema.arrays().size(), 4u);
  schema.set_type(2, ValueType::Text);
  std::string arrays;
  for (const ArrayInfo& array : schema.arrays())
  {
    arrays += array.name + (array.type == ValueType::Text ? "(text, " : "(") +
      std::to_string(array.components()) +
      (array.group.empty() ? ") " : " of " + array.group + ") ");
  }
  EXPECT_EQ(arrays, "id(1) c_a[1](1 of c_a) c_a[2](text, 1 of c_a) c_a(1) f_b(2) ");
  EXPECT_EQ(schema.columns()[1].type, ValueType::Float64);
  schema.set_type(2, ValueType::Float64); // the same as if there had been no word
  EXPECT_TRUE(schema == schema_of("id c_a[1] c_a[2] c_a f_b[1] f_b[2]"));
  EXPECT_EQ(schema.arrays().size(), 4u);
}

TEST(ColumnSchema, EqualityIsOfNamesAndTypes)
{
  EXPECT_TRUE(schema_of("id x y") == schema_of("id x y"));
  EXPECT_FALSE(schema_of("id x y") == schema_of("id y x"));
  EXPECT_FALSE(schema_of("id x y") == schema_of("id x"));
  EXPECT_TRUE(ColumnSchema() == schema_of(""));
  EXPECT_EQ(schema_of("").text(), "");
}

TEST(ColumnSchema, ThousandsOfColumns)
{
  std::string names = "id";
  for (int i = 1; i <= 3000; ++i)
  {
    names += " c_many[" + std::to_string(i) + "]";
  }
  const ColumnSchema schema = schema_of(names);
  ASSERT_EQ(schema.arrays().size(), 2u);
  EXPECT_EQ(schema.arrays()[1].components(), 3000);
}

TEST(ColumnSchema, AtMostFiveThousandColumns)
{
  constexpr std::size_t many = 5000;
  const auto make = [](std::size_t count)
  {
    ColumnSchema schema(
      std::vector<std::string>(count, "q"), granular::known_columns(), { "a", 9 });
    return schema.arrays();
  };
  EXPECT_EQ(make(many).size(), many);
  EXPECT_EQ(make(many).back().name, "q_5000");
  EXPECT_EQ(error_of([&] { make(many + 1); }), "a:9: expected at most 5000 columns, got 5001");
}
