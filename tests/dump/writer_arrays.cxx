// SPDX-License-Identifier: BSD-3-Clause
// What arrays and field data become.
#include "writer_helpers.h"

#include "vtkBitArray.h"
#include "vtkCharArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariantArray.h"

#include <cmath>
#include <limits>

namespace
{
using Lines = std::vector<std::string>;

template <typename T>
class WriterIntegers : public testing::Test
{
};

using Integers = testing::Types<vtkCharArray, vtkSignedCharArray, vtkUnsignedCharArray,
  vtkShortArray, vtkUnsignedShortArray, vtkIntArray, vtkUnsignedIntArray, vtkLongArray,
  vtkUnsignedLongArray, vtkLongLongArray, vtkUnsignedLongLongArray, vtkIdTypeArray,
  vtkSOADataArrayTemplate<int>, vtkSOADataArrayTemplate<unsigned short>>;
TYPED_TEST_SUITE(WriterIntegers, Integers);

TYPED_TEST(WriterIntegers, HaveAllTheirDigits)
{
  using Value = typename TypeParam::ValueType;
  // of what dumps hold: 64 bits with sign
  constexpr bool wide = std::is_unsigned_v<Value> && sizeof(Value) == 8;
  const Value least = std::numeric_limits<Value>::min();
  const Value most = wide ? static_cast<Value>(std::numeric_limits<std::int64_t>::max())
                          : std::numeric_limits<Value>::max();
  auto data = MakeParticles(3);
  AddArray<TypeParam>(data, "id", { 1, 2, 3 });
  AddArray<TypeParam>(data, "n", { least, most, 7 });
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer->SetColumns("id n");
  EXPECT_EQ(
    writer.Rows(), (Lines{ "1 " + std::to_string(+least), "2 " + std::to_string(+most), "3 7" }));
  EXPECT_TRUE(writer.Said->Warnings.empty());
}

/// A writer of three particles with the array n, whose column alone is written.
template <typename Fill>
Lines RowsOf(const char* columns, const char* format, const Fill& fill)
{
  auto data = MakeParticles(3);
  fill(data);
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer->SetColumns(columns);
  writer->SetNumberFormat(format);
  const Lines rows = writer.Rows();
  EXPECT_EQ(writer.Said->Warnings, Lines{});
  return rows;
}
}

TEST(WriterArrays, Reals)
{
  EXPECT_EQ(RowsOf("n", "%g",
              [](vtkPolyData* data) {
                AddArray<vtkDoubleArray>(data, "n", { 1.0 / 3, -1e300, 1234567 });
              }),
    (Lines{ "0.333333", "-1e+300", "1.23457e+06" }));
  EXPECT_EQ(RowsOf("n", "shortest",
              [](vtkPolyData* data) {
                AddArray<vtkFloatArray>(data, "n", { 0.1F, 2, 16777216 });
              }),
    (Lines{ "0.10000000149011612", "2", "16777216" }));
  EXPECT_EQ(RowsOf("n", "%.17g",
              [](vtkPolyData* data) {
                AddArray<vtkSOADataArrayTemplate<double>>(data, "n", { 0.1, -0.0, 1e22 });
              }),
    (Lines{ "0.10000000000000001", "-0", "1e+22" }));
}

TEST(WriterArrays, BitsAre0And1)
{
  EXPECT_EQ(RowsOf("n", "%g",
              [](vtkPolyData* data)
              {
                vtkNew<vtkBitArray> bits;
                bits->SetName("n");
                bits->SetNumberOfComponents(2);
                bits->SetNumberOfTuples(3);
                for (int i = 0; i < 6; ++i)
                {
                  bits->SetValue(i, i == 1 || i == 4);
                }
                data->GetPointData()->AddArray(bits);
              }),
    (Lines{ "0 1", "0 0", "1 0" }));
}

TEST(WriterArrays, SeveralComponentsInAnyLayout)
{
  const auto fill = [](vtkDataArray* array, vtkPolyData* data)
  {
    array->SetName("v");
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(3);
    for (int i = 0; i < 9; ++i)
    {
      array->SetComponent(i / 3, i % 3, i + 0.5);
    }
    data->GetPointData()->AddArray(array);
  };
  const Lines expected = { "0.5 1.5 2.5 0", "3.5 4.5 5.5 1", "6.5 7.5 8.5 2" };
  EXPECT_EQ(RowsOf("v x", "%g",
              [&](vtkPolyData* data) { fill(vtkNew<vtkDoubleArray>().GetPointer(), data); }),
    expected);
  EXPECT_EQ(RowsOf("v x", "%g",
              [&](vtkPolyData* data)
              { fill(vtkNew<vtkSOADataArrayTemplate<double>>().GetPointer(), data); }),
    expected);
}

TEST(WriterArrays, Texts)
{
  EXPECT_EQ(RowsOf("x element", "%g",
              [](vtkPolyData* data)
              {
                vtkNew<vtkStringArray> texts;
                texts->SetName("element");
                for (const char* text : { "Fe", "C", "Si_3" })
                {
                  texts->InsertNextValue(text);
                }
                data->GetPointData()->AddArray(texts);
              }),
    (Lines{ "0 Fe", "1 C", "2 Si_3" }));
}

TEST(WriterArrays, FloatPointsAndNoOtherThanPoints)
{
  auto data = MakeParticles(2);
  data->GetPoints()->SetDataTypeToFloat();
  data->GetPoints()->SetNumberOfPoints(2);
  data->GetPoints()->SetPoint(0, 0.1, 0.2, 0.3);
  data->GetPoints()->SetPoint(1, 4, 5, 6);
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer->SetNumberFormat("%.9g");
  EXPECT_EQ(writer.Rows(), (Lines{ "1 1 0.100000001 0.200000003 0.300000012", "2 1 4 5 6" }));
  EXPECT_EQ(writer.Said->Warnings,
    (Lines{ "no array 'id': ids are the numbers of the rows, from 1",
      "no array 'type': the type of all is 1" }));
}

TEST(WriterArrays, WhatIsNoColumnIsLeftOutWithAWarning)
{
  auto data = MakeParticles(2);
  AddArray<vtkIntArray>(data, "id", { 1, 2 });
  AddArray<vtkIntArray>(data, "type", { 1, 2 });
  vtkNew<vtkVariantArray> variants;
  variants->SetName("mixed");
  variants->InsertNextValue(1);
  variants->InsertNextValue("two");
  data->GetPointData()->AddArray(variants);
  vtkNew<vtkDoubleArray> nameless;
  nameless->SetNumberOfTuples(2);
  data->GetPointData()->AddArray(nameless);
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  EXPECT_EQ(writer.Rows(), (Lines{ "1 1 0 0.5 0.25", "2 2 1 0.5 0.25" }));
  EXPECT_EQ(writer.Said->Warnings,
    (Lines{ "the array 'mixed' of the type variant is left out",
      "an array without a name is left out" }));
}

TEST(WriterArrays, OfAnotherLengthThanThePointsAreAnError)
{
  auto data = MakeParticles(3);
  AddArray<vtkDoubleArray>(data, "n", { 1, 2 });
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer.ExpectError(
    vtkErrorCode::UnknownError, "column 'n': expected a value for each of 3 points, got 2");
  data->GetPointData()->RemoveArray("n");
  AddArray<vtkUnsignedCharArray>(data, vtkDataSetAttributes::GhostArrayName(), { 0, 1 });
  writer.ExpectError(vtkErrorCode::UnknownError,
    "column 'vtkGhostType': expected a value for each of 3 points, got 2");
}

TEST(WriterArrays, DuplicatesAreLeftOut)
{
  auto data = MakeParticles(5);
  AddArray<vtkUnsignedCharArray>(data, vtkDataSetAttributes::GhostArrayName(),
    { 0, vtkDataSetAttributes::DUPLICATEPOINT, vtkDataSetAttributes::HIDDENPOINT, 0,
      vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT });
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer->SetColumns("x");
  EXPECT_EQ(writer.Rows(), (Lines{ "0", "2", "3" }));
  EXPECT_NE(Content(writer->GetFileName()).find("NUMBER OF ATOMS\n3\n"), std::string::npos);
}

TEST(WriterArrays, NoPoints)
{
  for (const bool arrays : { false, true })
  {
    auto data = MakeParticles(0);
    if (arrays)
    {
      AddArray<vtkIntArray>(data, "id", {});
    }
    Writer writer(NewName("a.dump"));
    writer->SetInputData(data);
    EXPECT_EQ(writer.Rows(), Lines{});
    EXPECT_NE(Content(writer->GetFileName()).find("ITEM: NUMBER OF ATOMS\n0\n"), std::string::npos);
  }
  vtkNew<vtkPolyData> nothing;
  Writer writer(NewName("a.dump"));
  writer->SetInputData(nothing);
  EXPECT_EQ(writer.Rows(), Lines{});
  vtkNew<vtkUnstructuredGrid> grid;
  writer->SetInputData(grid);
  EXPECT_EQ(writer.Rows(), Lines{});
}

TEST(WriterArrays, ABoxOfTheWritersOwn)
{
  auto data = MakeParticles(1);
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer->SetColumns("x xs");
  writer->SetDialect(vtkGranularDumpWriter::LIGGGHTS);
  writer->SetBoxOrigin(-1, -2, -3);
  const double vectors[9] = { 2, 0, 0, 0.5, 4, 0, -0.25, 0.75, 8 };
  writer->SetBoxVectors(vectors);
  writer->SetBoundary("pp ff sm");
  writer.Rows();
  // bounds of a tilted box hold all corners
  EXPECT_NE(
    Content(writer->GetFileName())
      .find("ITEM: BOX BOUNDS xy xz yz pp ff sm\n-1.25 1.5 0.5\n-2 2.75 -0.25\n-3 5 0.75\n"),
    std::string::npos);
}

TEST(WriterArrays, ABoxOfTheParticlesAndNumbersOfFrames)
{
  auto data = MakeParticles(3);
  data->GetFieldData()->Initialize();
  AddArray<vtkDoubleArray>(data, "radius", { 0.5, 1, 0.25 });
  Writer writer(NewName("a.dump"));
  writer->SetInputData(data);
  writer->SetDialect(vtkGranularDumpWriter::LIGGGHTS);
  writer.Rows();
  EXPECT_EQ(Content(writer->GetFileName())
              .find("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS ff ff ff\n"
                    "-0.5 2.25\n-0.5 1.5\n-0.75 1.25\n"),
    0u);
  EXPECT_EQ(writer.Said->Warnings.size(), 4u); // timestep, box, id, type
}
