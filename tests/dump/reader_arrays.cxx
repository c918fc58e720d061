// SPDX-License-Identifier: BSD-3-Clause
// Arrays, cells, field data and the box that come out of files of the real programs.
#include "reader_helpers.h"

#include "../support/many_columns.h"
#include "../support/vtk_arrays.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

TEST(ReaderArrays, HaveTheTypesThatNothingIsLostIn)
{
  Reader reader({ Good("grains.dump") });
  reader->UpdateTimeStep(1000);
  ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_TRUE(vtkTypeInt64Array::SafeDownCast(reader.Array("id")));
  EXPECT_TRUE(vtkTypeInt32Array::SafeDownCast(reader.Array("type")));
  EXPECT_TRUE(vtkTypeInt32Array::SafeDownCast(reader.Array("image")));
  for (const char* name : { "v", "f", "omega", "radius", "mass" })
  {
    EXPECT_TRUE(vtkDoubleArray::SafeDownCast(reader.Array(name))) << name;
  }
  for (const char* name : { "image", "v", "f", "omega" })
  {
    EXPECT_EQ(reader.Array(name)->GetNumberOfComponents(), 3) << name;
  }
  EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(), 8);
  EXPECT_EQ(reader.Particles()->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_TRUE(reader.Said->Errors.empty());
  EXPECT_TRUE(reader.Said->Warnings.empty());
}

TEST(ReaderArrays, IdsArePedigreeIds)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->Update();
  vtkPointData* data = reader.Particles()->GetPointData();
  ASSERT_TRUE(data->GetPedigreeIds());
  EXPECT_STREQ(data->GetPedigreeIds()->GetName(), "id");
  EXPECT_EQ(data->GetPedigreeIds(), reader.Array("id"));
}

TEST(ReaderArrays, ComponentsHaveTheNamesOfTheirColumns)
{
  const std::string file = WriteFile("components.dump",
    Frame(0, 1, "id x y z c_s[1] c_s[2] c_s[3] quat1 quat2 quat3 quat4",
      "1 1 2 3 11 12 13 1 0 0 0.5\n"));
  Reader reader({ file });
  reader->Update();
  ASSERT_EQ(reader.Numbers("c_s")->GetNumberOfComponents(), 3);
  EXPECT_EQ(reader.Numbers("c_s")->GetComponent(0, 1), 12);
  EXPECT_STREQ(reader.Array("c_s")->GetComponentName(1), "c_s[2]");
  ASSERT_EQ(reader.Numbers("quat")->GetNumberOfComponents(), 4);
  EXPECT_STREQ(reader.Array("quat")->GetComponentName(0), "quat1");
}

TEST(ReaderArrays, AFrameWithoutRowsHasTheArraysOfItsColumns)
{
  Reader reader({ Good("grains.dump") });
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader.Particles()->GetNumberOfCells(), 0);
  ASSERT_TRUE(reader.Particles()->GetPoints());
  EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(), 8);
  ASSERT_TRUE(vtkTypeInt64Array::SafeDownCast(reader.Array("id")));
  EXPECT_EQ(reader.Array("id")->GetNumberOfTuples(), 0);
  EXPECT_EQ(reader.Array("v")->GetNumberOfComponents(), 3);
  EXPECT_EQ(reader.Text("Coordinates"), "Absolute");
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
}

TEST(ReaderArrays, WhatIsSwitchedOffIsNotThere)
{
  Reader reader({ Good("grains.dump") });
  reader->UpdateInformation();
  vtkDataArraySelection* arrays = reader->GetPointDataArraySelection();
  EXPECT_EQ(arrays->GetNumberOfArrays(), 11);
  for (const char* name : { "x", "y", "z" })
  {
    EXPECT_TRUE(arrays->ArrayExists(name)) << name;
    EXPECT_FALSE(arrays->ArrayIsEnabled(name)) << name;
  }
  arrays->DisableAllArrays();
  arrays->EnableArray("radius");
  arrays->EnableArray("y");
  reader->UpdateTimeStep(1000);
  EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(), 2);
  ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_EQ(reader.Numbers("y")->GetComponent(1199, 0), reader.Particles()->GetPoint(1199)[1]);
  EXPECT_FALSE(reader.Particles()->GetPointData()->GetPedigreeIds());
  arrays->EnableArray("v");
  reader->UpdateTimeStep(1000);
  EXPECT_TRUE(reader.Array("v"));
}

TEST(ReaderArrays, ChoicesStayWhenTheFilesAreReadAgain)
{
  Reader reader({ Good("grains.dump") });
  reader->GetPointDataArraySelection()->DisableArray("mass"); // before anything is known
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableArray("v");
  reader->GetPointDataArraySelection()->EnableArray("x");
  reader->Refresh();
  reader->UpdateTimeStep(1000);
  EXPECT_FALSE(reader.Array("mass"));
  EXPECT_FALSE(reader.Array("v"));
  EXPECT_TRUE(reader.Array("x"));
  EXPECT_TRUE(reader.Array("f"));
}

TEST(ReaderArrays, SelectionHoldsTheArraysOfAllFramesAndOfNoOtherFile)
{
  const std::string file = WriteFile("changing.dump",
    Frame(0, 1, "id x y z", "1 1 2 3\n") + Frame(1, 1, "id x y z q", "1 1 2 3 4\n"));
  Reader reader({ file });
  reader->Update();
  EXPECT_TRUE(reader->GetPointDataArraySelection()->ArrayIsEnabled("q"));
  EXPECT_FALSE(reader.Array("q"));
  reader->UpdateTimeStep(1);
  EXPECT_TRUE(reader.Array("q"));
  reader.Open(Good("grains_label.dump"));
  reader->Update();
  EXPECT_FALSE(reader->GetPointDataArraySelection()->ArrayExists("q"));
  EXPECT_TRUE(reader->GetPointDataArraySelection()->ArrayIsEnabled("radius"));
}

TEST(ReaderArrays, MemoryIsThatOfTheOutputAndGrowsLikeAnyArray)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->Update();
  auto* radius = vtkDoubleArray::SafeDownCast(reader.Array("radius"));
  ASSERT_TRUE(radius);
  EXPECT_EQ(radius->GetSize(), 1200);
  const double last = radius->GetValue(1199);
  radius->InsertNextValue(7); // reallocates memory that the array did not make itself
  EXPECT_EQ(radius->GetValue(1199), last);
  EXPECT_EQ(radius->GetValue(1200), 7);
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(reader.Particles());
  reader.Open(Good("grains_2000.dump"));
  reader->Update();
  EXPECT_EQ(copy->GetPointData()->GetArray("radius")->GetComponent(1199, 0), last);
}

TEST(ReaderCells, VertexIsOneCellAPoint)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->Update();
  vtkPolyData* particles = reader.Particles();
  ASSERT_EQ(particles->GetNumberOfVerts(), 1200);
  EXPECT_EQ(particles->GetNumberOfCells(), 1200);
  EXPECT_FALSE(particles->GetVerts()->IsStorage64Bit());
  for (vtkIdType i = 0; i < 1200; ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    particles->GetVerts()->GetCellAtId(i, size, points);
    ASSERT_EQ(size, 1);
    ASSERT_EQ(points[0], i);
  }
}

TEST(ReaderCells, PolyVertexIsOneCellAndNoneIsNone)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->SetVertices(vtkGranularDumpReader::POLY_VERTEX);
  reader->Update();
  ASSERT_EQ(reader.Particles()->GetNumberOfVerts(), 1);
  EXPECT_EQ(reader.Particles()->GetCellType(0), VTK_POLY_VERTEX);
  EXPECT_EQ(reader.Particles()->GetCellSize(0), 1200);
  reader->SetVertices(vtkGranularDumpReader::NO_VERTICES);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfCells(), 0);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
}

TEST(ReaderFieldData, SaysWhatThePointsAre)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->Update();
  for (vtkFieldData* data : { reader.Particles()->GetFieldData(), reader.Box()->GetFieldData() })
  {
    ASSERT_EQ(data->GetNumberOfArrays(), 10); // no label, units or time: the file has none
    const auto tuple = [data](const char* name)
    {
      EXPECT_EQ(data->GetArray(name)->GetNumberOfTuples(), 1) << name;
      return ValuesOf(data->GetArray(name));
    };
    EXPECT_EQ(tuple("BoxOrigin"), (Values{ -0.05, -0.05, 0 }));
    EXPECT_EQ(tuple("BoxVectors"), (Values{ 0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.15 }));
    EXPECT_EQ(tuple("BoxBounds"), (Values{ -0.05, 0.05, -0.05, 0.05, 0, 0.15 }));
    EXPECT_EQ(tuple("PointOrigin"), (Values{ 0, 0, 0 }));
    EXPECT_TRUE(vtkTypeInt64Array::SafeDownCast(data->GetAbstractArray("timestep")));
    EXPECT_EQ(tuple("timestep"), Values{ 1000 });
  }
  EXPECT_EQ(reader.Text("Coordinates"), "Absolute");
  EXPECT_EQ(reader.Text("Boundary"), "pp pp ff");
  const std::vector<std::string> columns = { "id", "type", "xs", "ys", "zs", "ix", "iy", "iz",
    "radius" };
  EXPECT_EQ(
    reader.Particles()->GetFieldData()->GetAbstractArray("Columns")->GetNumberOfValues(), 9);
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_EQ(reader.Text("Columns", i), columns[i]);
  }
  EXPECT_EQ(reader.Text("Dialect"), "LIGGGHTS");
  // xs ys zs have six, radii are 0.0025 and 0.0035, the others are integers
  EXPECT_EQ(ValuesOf(reader.Field("ColumnDigits")), (Values{ 0, 0, 6, 6, 6, 0, 0, 0, 2 }));
}

TEST(ReaderFieldData, HasLabelUnitsAndTimeWhereTheFileHasThem)
{
  Reader label({ Good("grains_label.dump") });
  label->UpdateTimeStep(1000);
  EXPECT_EQ(label.Text("label"), "0.125");
  EXPECT_FALSE(label.Field("time"));
  EXPECT_EQ(label.Text("units"), "(none)");
  Reader time({ Good("ortho_unwrapped.dump") });
  time->UpdateTimeStep(0.5);
  EXPECT_EQ(time.Text("units"), "lj");
  ASSERT_TRUE(time.Field("time"));
  EXPECT_EQ(time.Field("time")->GetComponent(0, 0), 0.5);
  EXPECT_EQ(time.Field("timestep")->GetComponent(0, 0), 100);
  EXPECT_EQ(time.Text("label"), "(none)");
}

TEST(ReaderBox, IsOneHexahedron)
{
  Reader reader({ Good("grains_1000.dump") });
  reader->Update();
  ASSERT_EQ(reader.Box()->GetNumberOfCells(), 1);
  EXPECT_EQ(reader.Box()->GetCellType(0), VTK_HEXAHEDRON);
  EXPECT_EQ(reader.Box()->GetPoints()->GetDataType(), VTK_DOUBLE);
  const double* bounds = reader.Box()->GetBounds();
  EXPECT_EQ(Values(bounds, bounds + 6), (Values{ -0.05, 0.05, -0.05, 0.05, 0, 0.15 }));
}

TEST(ReaderBox, IsRightWhereItIsTilted)
{
  Reader reader({ Good("tri_plain.dump") });
  reader->Update();
  std::ifstream in(Good("tri_plain.dump"));
  std::string line;
  for (int i = 0; i < 5; ++i)
  {
    std::getline(in, line); // as far as the bounds
  }
  double b[9];
  for (double& number : b)
  {
    in >> number;
  }
  const double xy = b[2], xz = b[5], yz = b[8];
  const double lo[] = { b[0] - std::min({ 0., xy, xz, xy + xz }), b[3] - std::min(0., yz), b[6] };
  const double hi[] = { b[1] - std::max({ 0., xy, xz, xy + xz }), b[4] - std::max(0., yz), b[7] };
  const double corners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
    { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  vtkNew<vtkIdList> list;
  reader.Box()->GetCellPoints(0, size, ids, list);
  ASSERT_EQ(size, 8);
  for (int i = 0; i < 8; ++i)
  {
    const double* c = corners[i];
    const double* p = reader.Box()->GetPoint(ids[i]);
    EXPECT_NEAR(p[0], lo[0] + (hi[0] - lo[0]) * c[0] + xy * c[1] + xz * c[2], 1e-14);
    EXPECT_NEAR(p[1], lo[1] + (hi[1] - lo[1]) * c[1] + yz * c[2], 1e-14);
    EXPECT_NEAR(p[2], lo[2] + (hi[2] - lo[2]) * c[2], 1e-14);
  }
}

TEST(ReaderBox, FollowsTheFrameOfReferenceOfThePoints)
{
  Reader reader({ Good("tri_plain.dump") });
  reader->SetPointOrigin(1, 2, 3);
  reader->Update();
  const double* moved = reader.Box()->GetPoint(0);
  EXPECT_EQ(Values(moved, moved + 3), (Values{ -1, -2, -3 }));
  reader->SetPointOrigin(0, 0, 0);
  reader->SetCoordinates(vtkGranularDumpReader::SCALED);
  reader->Update();
  EXPECT_EQ(reader.Text("Coordinates"), "Scaled");
  const double* bounds = reader.Box()->GetBounds();
  EXPECT_EQ(Values(bounds, bounds + 6), (Values{ 0, 1, 0, 1, 0, 1 }));
}

TEST(ReaderArrays, ASecondIdColumnIsAnArrayAndNotThePedigree)
{
  Reader reader({ WriteFile("ids.dump", Frame(0, 2, "id id x y z", "5 7 0 0 0\n3 9 1 0 0\n")) });
  reader->SetSortById(true);
  reader->Update();
  vtkPointData* data = reader.Particles()->GetPointData();
  EXPECT_STREQ(data->GetPedigreeIds()->GetName(), "id");
  EXPECT_EQ(reader.Numbers("id")->GetComponent(0, 0), 3);
  EXPECT_EQ(reader.Numbers("id_2")->GetComponent(0, 0), 9);
}

TEST(ReaderArrays, AsManyAsThereMayBe)
{
  constexpr int many = many_columns - 4;
  const std::string path = WriteFile("many.dump",
    Frame(0, 1, line_of_many("id x y z", "a"), line_of_many("1 0.5 0.5 0.5", "#") + "\n"));
  vtkNew<vtkGranularDumpReader> reader;
  reader->SetController(nullptr);
  reader->AddFileName(path.c_str());
  reader->UpdateInformation();
  vtkDataArraySelection* choice = reader->GetPointDataArraySelection();
  ASSERT_EQ(choice->GetNumberOfArrays(), many + 4);
  EXPECT_STREQ(choice->GetArrayName(many + 3), "a_4996");
  EXPECT_EQ(choice->GetNumberOfArraysEnabled(), many + 1); // x, y and z are points
  choice->DisableArray("a");
  reader->Update();
  vtkPointData* data = reader->GetOutput()->GetPointData();
  ASSERT_EQ(data->GetNumberOfArrays(), many);
  EXPECT_EQ(data->GetArray("a"), nullptr);
  vtkDataArray* last = data->GetArray(many - 1);
  EXPECT_STREQ(last->GetName(), "a_4996");
  EXPECT_EQ(last->GetComponent(0, 0), many);
  reader->Refresh();
  reader->Update();
  EXPECT_EQ(choice->GetNumberOfArraysEnabled(), many);
  EXPECT_EQ(data->GetNumberOfArrays(), many);
}
