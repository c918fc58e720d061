// SPDX-License-Identifier: BSD-3-Clause
// The filter from C++: what lines get, what is said, inputs that are none, pieces, stopping, printing.
#include "vtkGranularLocalJoin.h"

#include "../support/hard_case.h"
#include "../support/observer.h"
#include "../support/quad.h"
#include "../support/vtk_arrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTrivialProducer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariantArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{
void AddText(vtkFieldData* data, const char* name, const char* text)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(text);
  data->AddArray(array);
}

/// Four particles in the box from 0 to 10, periodic along x: 11 and 12 at the lower face, 13 at the upper one, and 14.
vtkSmartPointer<vtkPolyData> MakeParticles(const Values& ids = { 11, 12, 13, 14 })
{
  auto particles = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(MakeArray("points", { 1, 5, 5, 1, 8, 9, 9, 5, 5, 4, 5, 5 }, 3));
  particles->SetPoints(points);
  vtkPointData* data = particles->GetPointData();
  data->AddArray(MakeArray<vtkTypeInt64Array>("id", ids));
  data->AddArray(MakeArray<vtkFloatArray>("radius", { 0.5, 1.5, 2.5, 4 }));
  data->AddArray(MakeArray("v", { 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 0, 0 }, 3));
  data->GetArray("v")->SetComponentName(1, "up");
  vtkFieldData* fields = particles->GetFieldData();
  fields->AddArray(MakeArray("BoxOrigin", { 0, 0, 0 }, 3));
  fields->AddArray(MakeArray("BoxVectors", { 10, 0, 0, 0, 10, 0, 0, 0, 10 }, 9));
  fields->AddArray(MakeArray<vtkTypeInt64Array>("timestep", { 100 }));
  AddText(fields, "Boundary", "pp ff ff");
  AddText(fields, "Columns", "id");
  return particles;
}

/// Rows with columns of ids, of different types.
vtkSmartPointer<vtkTable> MakeTable(const Values& id1, const Values& id2)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(MakeArray<vtkIntArray>("id1", id1));
  table->AddColumn(MakeArray("id2", id2));
  return table;
}

/// The bonds 11-12, 11-13, of which the second crosses a face, and 14-14.
vtkSmartPointer<vtkTable> MakeTable()
{
  return MakeTable({ 11, 11, 14 }, { 12, 13, 14 });
}

struct Filter : Watched<vtkGranularLocalJoin>
{
  Filter(vtkDataObject* particles, vtkDataObject* lines)
  {
    this->Get->SetController(nullptr);
    for (int port = 0; port < 2; ++port)
    {
      this->Inputs[port]->SetOutput(port == 0 ? particles : lines);
      this->Get->SetInputConnection(port, this->Inputs[port]->GetOutputPort());
    }
  }

  vtkPolyData* Lines() { return this->Get->GetOutput(); }
  vtkDataArray* Cells(const char* name) { return this->Lines()->GetCellData()->GetArray(name); }

  Values ValuesOf(const char* name) { return ::ValuesOf(this->Cells(name)); }

  /// x of both ends of each line.
  Values Xs()
  {
    Values xs;
    vtkNew<vtkIdList> ends;
    for (vtkIdType line = 0; line < this->Lines()->GetNumberOfCells(); ++line)
    {
      this->Lines()->GetCellPoints(line, ends);
      EXPECT_EQ(ends->GetNumberOfIds(), 2);
      xs.push_back(this->Lines()->GetPoint(ends->GetId(0))[0]);
      xs.push_back(this->Lines()->GetPoint(ends->GetId(1))[0]);
    }
    return xs;
  }

  vtkNew<vtkTrivialProducer> Inputs[2];
};

bool IsEmpty(Filter& filter)
{
  return filter.Lines()->GetNumberOfCells() == 0 && filter.Lines()->GetNumberOfPoints() == 0 &&
    filter->GetErrorCode() != static_cast<unsigned long>(vtkErrorCode::NoError);
}
}

TEST(LocalJoinFilter, LinesGoToTheNearestImage)
{
  Filter filter(MakeParticles(), MakeTable());
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, -1, 4, 4 }));
  EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 2, 0 }));
  EXPECT_EQ(filter.ValuesOf("id1"), (Values{ 11, 11, 14 }));
  EXPECT_EQ(filter.ValuesOf("id2"), (Values{ 12, 13, 14 }));
  EXPECT_EQ(filter.Cells("id1")->GetDataType(), VTK_INT);
  EXPECT_EQ(filter.Lines()->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(filter.Lines()->GetNumberOfPoints(), 6);
  EXPECT_EQ(filter.Lines()->GetNumberOfLines(), 3);
  for (const char* name : { "elongation", "strain", "row" })
  {
    EXPECT_EQ(filter.Cells(name), nullptr) << name;
  }
  vtkFieldData* fields = filter.Lines()->GetFieldData();
  EXPECT_EQ(fields->GetArray("timestep")->GetComponent(0, 0), 100);
  EXPECT_TRUE(fields->HasArray("BoxVectors"));
  EXPECT_FALSE(fields->HasArray("Columns")); // those of particles

  filter->SetPeriodicLines(vtkGranularLocalJoin::AS_WRITTEN);
  filter->Update();
  EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, 9, 4, 4 }));
  EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 8, 0 }));
}

TEST(LocalJoinFilter, PartsOfSplitLinesHaveAllOfTheirRow)
{
  auto table = MakeTable();
  vtkNew<vtkStringArray> words;
  words->SetName("word");
  vtkNew<vtkVariantArray> variants;
  variants->SetName("variant");
  for (const char* word : { "a", "b", "c" })
  {
    words->InsertNextValue(word);
    variants->InsertNextValue(vtkVariant(word));
  }
  table->AddColumn(words);
  table->AddColumn(variants);
  table->AddColumn(MakeArray<vtkFloatArray>("force", { 1, 2, 3, 4, 5, 6, 7, 8, 9 }, 3));
  table->GetRowData()->GetArray("force")->SetComponentName(2, "down");
  Filter filter(MakeParticles(), table);
  filter->SetPeriodicLines(vtkGranularLocalJoin::SPLIT);
  filter->SetAverages("radius");
  filter->SetEquilibriumLength(1);
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, 0, 10, 9, 4, 4 }));
  EXPECT_EQ(filter.ValuesOf("row"), (Values{ 0, 1, 1, 2 }));
  EXPECT_NE(vtkTypeInt64Array::SafeDownCast(filter.Cells("row")), nullptr);
  EXPECT_EQ(filter.ValuesOf("part"), (Values{ 0, 0, 1, 0 }));
  EXPECT_NE(vtkTypeInt32Array::SafeDownCast(filter.Cells("part")), nullptr);
  EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 2, 2, 0 }));
  EXPECT_EQ(filter.ValuesOf("elongation"), (Values{ 4, 1, 1, -1 }));
  EXPECT_EQ(filter.ValuesOf("radius_mean"), (Values{ 1, 1.5, 1.5, 4 }));
  EXPECT_EQ(filter.ValuesOf("force"), (Values{ 1, 2, 3, 4, 5, 6, 4, 5, 6, 7, 8, 9 }));
  EXPECT_EQ(filter.Cells("force")->GetDataType(), VTK_FLOAT);
  EXPECT_STREQ(filter.Cells("force")->GetComponentName(2), "down");
  vtkCellData* data = filter.Lines()->GetCellData();
  for (const char* name : { "word", "variant" })
  {
    ASSERT_EQ(data->GetAbstractArray(name)->GetNumberOfTuples(), 4);
    EXPECT_EQ(data->GetAbstractArray(name)->GetVariantValue(2).ToString(), "b");
    EXPECT_EQ(data->GetAbstractArray(name)->GetVariantValue(3).ToString(), "c");
  }

  // what was split once is known by the number of the part, and counts once
  vtkNew<vtkPolyData> split;
  split->DeepCopy(filter.Lines());
  Filter again(MakeParticles(), split);
  again->SetAverages("radius");
  again->Update();
  again.ExpectSaid("");
  EXPECT_EQ(again.Xs(), (Values{ 1, 1, 1, -1, 4, 4 }));
  EXPECT_EQ(again.ValuesOf("row"), (Values{ 0, 1, 2 }));
  EXPECT_FALSE(again.Lines()->GetCellData()->HasArray("part"));
  EXPECT_EQ(again.ValuesOf("length"), (Values{ 5, 2, 0 }));
  EXPECT_FALSE(again.Cells("elongation")); // nothing is known of it now
  again->SetPeriodicLines(vtkGranularLocalJoin::SPLIT);
  again->Update();
  EXPECT_EQ(again.ValuesOf("row"), (Values{ 0, 1, 1, 2 }));
  EXPECT_EQ(again.ValuesOf("part"), (Values{ 0, 0, 1, 0 }));

  // parts in another order, of other lines with the same numbers, without their others: none is lost, none counts twice
  vtkNew<vtkPolyData> appended;
  appended->DeepCopy(filter.Lines());
  vtkNew<vtkIdList> order;
  for (const vtkIdType cell : { 2, 1, 1, 0, 3, 0, 2 })
  {
    order->InsertNextId(cell);
  }
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < order->GetNumberOfIds(); ++i)
  {
    cells->InsertNextCell(2);
    cells->InsertCellPoint(2 * order->GetId(i));
    cells->InsertCellPoint(2 * order->GetId(i) + 1);
  }
  appended->SetLines(cells);
  appended->GetCellData()->CopyAllocate(split->GetCellData());
  appended->GetCellData()->CopyData(split->GetCellData(), order);
  Filter both(MakeParticles(), appended);
  both->SetPeriodicLines(vtkGranularLocalJoin::SPLIT);
  both->Update();
  both.ExpectSaid("");
  EXPECT_EQ(both.Xs(), (Values{ 1, 0, 10, 9, 1, 0, 10, 9, 1, 1, 4, 4, 1, 1 }));
  EXPECT_EQ(both.ValuesOf("row"), (Values{ 0, 0, 1, 1, 2, 3, 4 }));
  EXPECT_EQ(both.ValuesOf("part"), (Values{ 0, 1, 0, 1, 0, 0, 0 }));
}

/// Arrays of the input with the names of those that tell parts.
TEST(LocalJoinFilter, RowsAndPartsOfOthers)
{
  auto table = MakeTable();
  table->AddColumn(MakeArray("part", { 0.5, 0, 7 })); // no integers: none of ours
  table->AddColumn(MakeArray("row", { 5, 5, 5 }));
  Filter filter(MakeParticles(), table);
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.ValuesOf("part"), (Values{ 0.5, 0, 7 }));
  EXPECT_EQ(filter.ValuesOf("row"), (Values{ 5, 5, 5 }));
  filter->SetPeriodicLines(vtkGranularLocalJoin::SPLIT);
  filter->Update();
  EXPECT_EQ(filter.ValuesOf("part"), (Values{ 0, 0, 1, 0 }));
  EXPECT_EQ(filter.ValuesOf("row"), (Values{ 0, 1, 1, 2 }));
  table->GetRowData()->AddArray(MakeArray<vtkIntArray>("part", { 0 }));
  filter->Modified();
  filter->Update();
  filter.ExpectSaid("expected a value for each of 3 rows, got 1");
  EXPECT_TRUE(IsEmpty(filter));
}

/// The cells of any data set name particles, whatever they look like.
TEST(LocalJoinFilter, CellsOfOtherDataSets)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  grid->SetPoints(points);
  vtkIdType point = 0;
  for (int cell = 0; cell < 3; ++cell)
  {
    grid->InsertNextCell(VTK_VERTEX, 1, &point);
  }
  grid->GetCellData()->PassData(MakeTable()->GetRowData());
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 2, 2);
  image->GetCellData()->PassData(MakeTable()->GetRowData());
  for (vtkDataSet* cells : { static_cast<vtkDataSet*>(grid), static_cast<vtkDataSet*>(image) })
  {
    Filter filter(MakeParticles(), cells);
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, -1, 4, 4 }));
  }
}

TEST(LocalJoinFilter, MeansAndDifferences)
{
  Filter filter(MakeParticles(), MakeTable());
  filter->SetAverages(" radius,v  radius ");
  filter->SetDifferences("v");
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.ValuesOf("radius_mean"), (Values{ 1, 1.5, 4 }));
  EXPECT_EQ(filter.ValuesOf("v_mean"), (Values{ 2.5, 3.5, 4.5, 4, 5, 6, 0, 0, 0 }));
  EXPECT_EQ(filter.ValuesOf("v_difference"), (Values{ 3, 3, 3, 6, 6, 6, 0, 0, 0 }));
  EXPECT_STREQ(filter.Cells("v_mean")->GetComponentName(1), "up");
  EXPECT_EQ(filter.Cells("radius_difference"), nullptr);

  filter->SetAverages(nullptr);
  filter->SetDifferences("*");
  filter->Update();
  EXPECT_EQ(filter.ValuesOf("radius_difference"), (Values{ 1, 2, 0 }));
  EXPECT_EQ(filter.ValuesOf("v_difference"), (Values{ 3, 3, 3, 6, 6, 6, 0, 0, 0 }));
  EXPECT_EQ(filter.Cells("id_difference"), nullptr);
  EXPECT_EQ(filter.Cells("v_mean"), nullptr);

  auto particles = MakeParticles();
  particles->GetPointData()->GetArray("radius")->SetName("my radius, doubled");
  Filter blanks(particles, MakeTable());
  blanks->SetAverages("*");
  blanks->Update();
  blanks.ExpectSaid("");
  EXPECT_EQ(blanks.ValuesOf("my radius, doubled_mean"), (Values{ 1, 1.5, 4 }));
  EXPECT_EQ(blanks.ValuesOf("v_mean"), (Values{ 2.5, 3.5, 4.5, 4, 5, 6, 0, 0, 0 }));
}

TEST(LocalJoinFilter, ElongationAndStrain)
{
  auto table = MakeTable();
  table->AddColumn(MakeArray("equilibrium_length", { 4, -4, 0 }));
  table->AddColumn(MakeArray("length", { 7, 7, 7 })); // of something else
  table->AddColumn(MakeArray("l0", { 5, 1, 1 }));
  Filter filter(MakeParticles(), table);
  filter->SetEquilibriumLength(2); // not used where there is the array
  filter->Update();
  filter.ExpectSaid("1 of 3 lines have an equilibrium length of 0");
  Values elongation = filter.ValuesOf("elongation");
  Values strain = filter.ValuesOf("strain");
  EXPECT_TRUE(std::isnan(elongation.back()) && std::isnan(strain.back()));
  elongation.pop_back();
  strain.pop_back();
  EXPECT_EQ(elongation, (Values{ 1, -2 }));
  EXPECT_EQ(strain, (Values{ 0.25, -0.5 }));
  EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 2, 0 }));

  filter->SetEquilibriumLengthArray("l0");
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.ValuesOf("strain"), (Values{ 0, 1, -1 }));

  filter->SetEquilibriumLengthArray("not there");
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.ValuesOf("strain"), (Values{ 1.5, 0, -1 }));

  // a frame without rows has the same arrays
  auto none = MakeTable({}, {});
  none->AddColumn(MakeArray("equilibrium_length", {}));
  Filter empty(MakeParticles(), none);
  empty->Update();
  empty.ExpectSaid("");
  for (const char* name : { "elongation", "strain" })
  {
    ASSERT_NE(empty.Cells(name), nullptr) << name;
    EXPECT_EQ(empty.Cells(name)->GetNumberOfTuples(), 0);
  }
}

/// Lines lie where the points are, and are as long as in the simulation.
/// The strain of bonds from 1e-9 to 1e6 long that are stretched by 1e-12 to 1, against 113 bits.
TEST(LocalJoinFilter, StrainsOfShortAndLongBonds)
{
  HardCase hard("strains",
    "bonds 1e-9 to 1e6 long, ends up to 1e6 away, strains of 1e-12 to 1: error", "2^-52", 2);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  constexpr std::size_t bonds = 2000;
  Values points;
  Values ids;
  Values rest;
  std::vector<Quad> expected;
  for (std::size_t i = 0; i < bonds; ++i)
  {
    const double size = std::pow(10, -1.5 + 7.5 * unit(random));
    Quad square = 0;
    Values second;
    for (int axis = 0; axis < 3; ++axis)
    {
      points.push_back(1e6 * unit(random) * (i % 2));
      second.push_back(points.back() + size * unit(random));
      const Quad along = static_cast<Quad>(second.back()) - points.back();
      square += along * along;
    }
    points.insert(points.end(), second.begin(), second.end());
    ids.push_back(static_cast<double>(2 * i + 1));
    const double nearest = std::sqrt(static_cast<double>(square));
    const Quad length = (nearest + square / nearest) / 2; // a step of Newton's: 106 bits
    rest.push_back(nearest / (1 + std::pow(10, -6 + 6 * unit(random))));
    expected.push_back((length - rest.back()) / rest.back());
  }
  Values second_ids;
  Values all;
  for (const double id : ids)
  {
    second_ids.push_back(id + 1);
    all.insert(all.end(), { id, id + 1 });
  }
  vtkNew<vtkPolyData> particles;
  vtkNew<vtkPoints> places;
  places->SetData(MakeArray("points", points, 3));
  particles->SetPoints(places);
  particles->GetPointData()->AddArray(MakeArray<vtkTypeInt64Array>("id", all));
  const auto table = MakeTable(ids, second_ids);
  table->AddColumn(MakeArray("equilibrium_length", rest));
  Filter filter(particles, table);
  filter->Update();
  const Values strains = filter.ValuesOf("strain");
  ASSERT_EQ(strains.size(), bonds);
  for (std::size_t i = 0; i < bonds; ++i)
  {
    hard.add(static_cast<double>(absolute(static_cast<Quad>(strains[i]) - expected[i])) / 0x1p-52);
  }
}

TEST(LocalJoinFilter, PointsOfAllKinds)
{
  auto particles = MakeParticles();
  vtkFieldData* fields = particles->GetFieldData();
  fields->AddArray(MakeArray("PointOrigin", { -100, 0, 0 }, 3));
  fields->AddArray(MakeArray("BoxOrigin", { -100, 0, 0 }, 3));
  {
    Filter filter(particles, MakeTable());
    filter->SetPeriodicLines(vtkGranularLocalJoin::SPLIT);
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, 0, 10, 9, 4, 4 }));
    EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 2, 2, 0 }));
  }
  // three periods on: the end that was found last is drawn next to the first, split or not
  AddText(fields, "Coordinates", "Unwrapped");
  particles->GetPoints()->SetPoint(0, 31, 5, 5);
  for (const int way : { vtkGranularLocalJoin::MINIMUM_IMAGE, vtkGranularLocalJoin::SPLIT })
  {
    Filter filter(particles, MakeTable());
    filter->SetPeriodicLines(way);
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Xs(), (Values{ 31, 31, 31, 29, 4, 4 }));
    EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 2, 0 }));
  }
  // in units of the box, less an origin in such units
  AddText(fields, "Coordinates", "Scaled");
  fields->AddArray(MakeArray("PointOrigin", { 0.25, 0, 0 }, 3));
  particles->GetPoints()->SetData(
    MakeArray("points", { -0.125, 0.5, 0.5, -0.125, 0.75, 0.5, 0.625, 0.5, 0.5, 0, 0, 0 }, 3));
  {
    Filter filter(particles, MakeTable());
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Xs(), (Values{ -0.125, -0.125, -0.125, -0.375, 0, 0 }));
    EXPECT_EQ(filter.ValuesOf("length"), (Values{ 2.5, 2.5, 0 }));
    EXPECT_EQ(filter.Lines()->GetPoint(1)[1], 0.75);
    filter->SetPeriodicLines(vtkGranularLocalJoin::SPLIT);
    filter->Update();
    EXPECT_EQ(filter.Xs(), (Values{ -0.125, -0.125, -0.125, -0.25, 0.75, 0.625, 0, 0 }));
  }
  fields->RemoveArray("BoxVectors");
  Filter filter(particles, MakeTable());
  filter->Update();
  filter.ExpectSaid("expected the box of scaled points");
  EXPECT_TRUE(IsEmpty(filter));
}

TEST(LocalJoinFilter, WithoutABoxAsWritten)
{
  auto particles = MakeParticles();
  particles->GetFieldData()->Initialize();
  Filter filter(particles, MakeTable());
  filter->Update();
  filter.ExpectSaid("neither the particles nor the lines have a box in their field data");
  EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, 9, 4, 4 }));
  EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 8, 0 }));
  filter->SetPeriodicLines(vtkGranularLocalJoin::AS_WRITTEN); // is asked for
  filter->Update();
  filter.ExpectSaid("");
}

TEST(LocalJoinFilter, TheBoxOfTheLinesWhereTheParticlesHaveNone)
{
  auto particles = MakeParticles();
  auto table = MakeTable();
  table->GetFieldData()->PassData(particles->GetFieldData());
  particles->GetFieldData()->Initialize();
  Filter filter(particles, table);
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Xs(), (Values{ 1, 1, 1, -1, 4, 4 }));
  EXPECT_EQ(filter.ValuesOf("length"), (Values{ 5, 2, 0 }));
  vtkFieldData* fields = filter.Lines()->GetFieldData();
  EXPECT_TRUE(fields->HasArray("BoxVectors") && fields->HasArray("Boundary"));
  EXPECT_FALSE(fields->HasArray("timestep"));

  // else that of the particles
  particles = MakeParticles();
  table->GetFieldData()->AddArray(MakeArray("BoxVectors", { 100, 0, 0, 0, 100, 0, 0, 0, 100 }, 9));
  Filter own(particles, table);
  own->Update();
  own.ExpectSaid("");
  EXPECT_EQ(own.ValuesOf("length"), (Values{ 5, 2, 0 }));
  EXPECT_EQ(own.Lines()->GetFieldData()->GetArray("BoxVectors")->GetComponent(0, 0), 10);
}

TEST(LocalJoinFilter, WhatIsLeftOutIsTold)
{
  Filter missing(MakeParticles(), MakeTable({ 11, 11, 7, 13 }, { 12, 3, 11, 8 }));
  missing->Update();
  missing.ExpectSaid("3 of 4 lines are left out: no particle has the id of an end, as in 11 and 3");
  EXPECT_EQ(missing.ValuesOf("id2"), Values{ 12 });

  Filter repeated(MakeParticles({ 11, 12, 13, 12 }), MakeTable({ 11 }, { 12 }));
  repeated->Update();
  repeated.ExpectSaid("1 particles have the id of another one: lines go to the first");
  EXPECT_EQ(repeated.Xs(), (Values{ 1, 1 }));

  auto table = MakeTable();
  table->AddColumn(MakeArray("dist", { 5.0004, 2.2, 0 }));
  Filter misfit(MakeParticles(), table);
  misfit->Update();
  misfit.ExpectSaid("1 of 3 lines are not as long as their array dist says");
  misfit->SetPeriodicLines(vtkGranularLocalJoin::AS_WRITTEN); // is asked for
  misfit->Update();
  misfit.ExpectSaid("");

  table->RemoveColumnByName("dist");
  table->AddColumn(MakeArray("dist", { 9, 9, 9, 9, 9, 9 }, 2)); // of something else
  table->GetFieldData()->AddArray(MakeArray<vtkTypeInt64Array>("timestep", { 200 }));
  AddText(table->GetFieldData(), "Columns", "id1");
  Filter other(MakeParticles(), table);
  const double times[] = { 0, 1 };
  for (const int count : { 0, 1, 2 }) // lines without times, or of one, are those of all
  {
    if (count > 0)
    {
      other.Inputs[1]->GetOutputInformation(0)->Set(
        vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, count);
    }
    other->Modified();
    other->Update();
    other.ExpectSaid(count > 1 ? "the particles are of timestep 100, the lines of 200" : "");
  }
  EXPECT_EQ(other.Lines()->GetFieldData()->GetArray("timestep")->GetComponent(0, 0), 100);
  EXPECT_EQ(
    other.Lines()->GetFieldData()->GetAbstractArray("Columns")->GetVariantValue(0).ToString(),
    "id1");
}

namespace
{
void HaveTimes(vtkInformation* info)
{
  const double times[] = { 0, 1, 2, 3 };
  const double range[] = { 0, 3 };
  info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 4);
  info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
}

/// One line, which only at the time 2 has particles at both ends.
class Frames : public vtkPolyDataAlgorithm
{
public:
  static Frames* New();
  vtkTypeMacro(Frames, vtkPolyDataAlgorithm);

protected:
  Frames() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    HaveTimes(outputs->GetInformationObject(0));
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const double time = outputs->GetInformationObject(0)->Get(Pipeline::UPDATE_TIME_STEP());
    auto* lines = vtkPolyData::GetData(outputs);
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0, 0, 0);
    lines->SetPoints(points);
    vtkNew<vtkCellArray> cells;
    const vtkIdType ends[] = { 0, 0 };
    cells->InsertNextCell(2, ends);
    lines->SetLines(cells);
    lines->GetCellData()->AddArray(MakeArray("id1", { time == 2 ? 11. : 99 }));
    lines->GetCellData()->AddArray(MakeArray("id2", { 12 }));
    return 1;
  }

private:
  using Pipeline = vtkStreamingDemandDrivenPipeline;
};
vtkStandardNewMacro(Frames);
}

/// What holds for all frames is told of the first, and again when it came back or something may have changed it.
TEST(LocalJoinFilter, WarningsAreNotToldOfEachFrame)
{
  vtkNew<Frames> frames;
  Filter filter(MakeParticles(), nullptr);
  filter->SetInputConnection(1, frames->GetOutputPort());
  HaveTimes(filter.Inputs[0]->GetOutputInformation(0)); // the times are those of the particles
  const char* const said = "1 of 1 lines are left out: no particle has the id of an end";
  const auto see = [&](double time, const char* text)
  {
    filter->UpdateTimeStep(time);
    filter.ExpectSaid(text);
    EXPECT_EQ(filter.Lines()->GetNumberOfCells(), time == 2 ? 1 : 0);
  };
  see(0, said);
  see(1, "");
  see(2, "");
  see(3, said);
  see(1, "");
  filter->SetAverages("radius");
  see(1, said);
  see(0, "");
  frames->Modified();
  see(0, said);
  filter.Inputs[0]->SetOutput(MakeParticles());
  see(1, said);
}

TEST(LocalJoinFilter, DuplicatesAreLeftOut)
{
  auto particles = MakeParticles({ 11, 12, 12, 14 });
  auto ghosts = MakeArray<vtkUnsignedCharArray>("vtkGhostType", { 0, 1, 0, 1 });
  particles->GetPointData()->AddArray(ghosts);
  auto table = MakeTable({ 11, 11, 11 }, { 12, 12, 14 });
  table->AddColumn(MakeArray<vtkUnsignedCharArray>("vtkGhostType", { 0, 1, 0 }));
  Filter filter(particles, table);
  filter->Update();
  filter.ExpectSaid("1 of 2 lines are left out: no particle has the id of an end, as in 11 and 14");
  EXPECT_EQ(filter.Xs(), (Values{ 1, -1 }));
  EXPECT_FALSE(filter.Lines()->GetCellData()->HasArray("vtkGhostType"));
}

TEST(LocalJoinFilter, NothingOnEitherSide)
{
  vtkNew<vtkPolyData> nobody;
  vtkNew<vtkTable> noRows;
  {
    Filter filter(nobody, MakeTable());
    filter->SetAverages("radius");
    filter->Update();
    filter.ExpectSaid("3 of 3 lines are left out");
    EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 0);
    EXPECT_NE(filter.Cells("id1"), nullptr);
    EXPECT_NE(filter.Cells("radius_mean"), nullptr);
  }
  {
    Filter filter(MakeParticles(), noRows);
    filter->SetDifferences("*");
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter.Cells("v_difference")->GetNumberOfComponents(), 3);
  }
  {
    // the lines of a reader whose file has ids alone: there are none, and the rows are its second output
    for (const char* column : { "dist", "x1" })
    {
      vtkNew<vtkPolyData> noLines;
      vtkNew<vtkStringArray> columns;
      columns->SetName("Columns");
      for (const char* name : { "id1", "id2", column })
      {
        columns->InsertNextValue(name);
      }
      noLines->GetFieldData()->AddArray(columns);
      if (column == std::string("x1"))
      {
        noLines->GetCellData()->AddArray(MakeArray("id1", {}));
        noLines->GetCellData()->AddArray(MakeArray("id2", {}));
      }
      Filter filter(MakeParticles(), noLines);
      filter->Update();
      filter.ExpectSaid(
        column == std::string("x1") ? "" : "take the rows, the second output of the reader");
      EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 0);
    }
  }
  Filter filter(nobody, noRows);
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 0);
}

TEST(LocalJoinFilter, WhatCannotBeIsAnError)
{
  vtkNew<vtkTable> noIds;
  noIds->AddColumn(MakeArray("id1", { 11 }));
  vtkNew<vtkTable> vectors;
  vectors->AddColumn(MakeArray("id1", { 11, 12 }, 2));
  vectors->AddColumn(MakeArray("id2", { 11 }));
  vtkNew<vtkTable> texts;
  AddText(texts->GetRowData(), "id1", "11");
  texts->AddColumn(MakeArray("id2", { 11 }));
  vtkNew<vtkPolyData> shortArray;
  shortArray->DeepCopy(MakeParticles());
  shortArray->GetCellData()->AddArray(MakeArray("id1", { 11 }));
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType point = 0; point < 2; ++point)
  {
    vertices->InsertNextCell(1, &point);
  }
  shortArray->SetVerts(vertices);
  auto withoutId = MakeParticles();
  withoutId->GetPointData()->RemoveArray("id");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeParticles());
  const struct
  {
    vtkSmartPointer<vtkDataObject> Particles;
    vtkSmartPointer<vtkDataObject> Lines;
    const char* Text;
  } cases[] = {
    { MakeParticles(), noIds, "expected an array 'id2' of the lines, got none" },
    { MakeParticles(), vectors,
      "expected one number a row in the array 'id1' of the lines, got 2" },
    { MakeParticles(), texts,
      "expected one number a row in the array 'id1' of the lines, got the type string" },
    { MakeParticles(), MakeTable({ 11 }, { 11.5 }),
      "column 'id2': expected a 64-bit integer as id, got 11.5 in row 0" },
    { MakeParticles(), shortArray, "expected a value for each of 2 rows, got 1" },
    { withoutId, MakeTable(), "expected an array 'id' of the particles, got none" },
    { MakeTable(), MakeTable(), "expected a vtkPointSet of particles, got a vtkTable" },
    { blocks, MakeTable(), "MergeBlocks" },
    { MakeParticles(), blocks, "got a vtkMultiBlockDataSet: the filter MergeBlocks" },
  };
  for (const auto& each : cases)
  {
    Filter filter(each.Particles, each.Lines);
    filter->Update();
    filter.ExpectSaid(each.Text);
    EXPECT_TRUE(IsEmpty(filter)) << each.Text;
    filter.Inputs[0]->SetOutput(MakeParticles());
    filter.Inputs[1]->SetOutput(MakeTable());
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 3);
  }
}

TEST(LocalJoinFilter, PropertiesThatCannotBeAreErrors)
{
  Filter filter(MakeParticles(), MakeTable());
  filter->SetThreads(-1);
  filter.ExpectSaid("Threads must be at least 0, got -1");
  for (const double length :
    { -1., std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    filter->SetEquilibriumLength(length);
    filter->Update();
    filter.ExpectSaid("expected an EquilibriumLength of 0 or more, got ");
    EXPECT_TRUE(IsEmpty(filter));
  }
  filter->SetEquilibriumLength(0);
  filter->SetAverages("radius mass");
  filter->Update();
  filter.ExpectSaid("expected an array 'mass' of the particles, got none");
  EXPECT_TRUE(IsEmpty(filter));
  filter->SetAverages("radius");
  filter->Update();
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 3);
}

TEST(LocalJoinFilter, PiecesAreTheWhole)
{
  for (const int way : { vtkGranularLocalJoin::MINIMUM_IMAGE, vtkGranularLocalJoin::SPLIT })
  {
    Filter whole(MakeParticles(), MakeTable());
    whole->SetPeriodicLines(way);
    whole->Update();
    Values xs;
    Values lengths;
    Values rows;
    for (int piece = 0; piece < 2; ++piece)
    {
      Filter part(MakeParticles(), MakeTable());
      part->SetPeriodicLines(way);
      part->UpdatePiece(piece, 2, 0);
      part.ExpectSaid("");
      for (const double x : part.Xs())
      {
        xs.push_back(x);
      }
      for (const double length : part.ValuesOf("length"))
      {
        lengths.push_back(length);
      }
      for (const double row : part.ValuesOf("row"))
      {
        rows.push_back(row);
      }
    }
    EXPECT_EQ(xs, whole.Xs());
    EXPECT_EQ(lengths, whole.ValuesOf("length"));
    EXPECT_EQ(rows, whole.ValuesOf("row"));
  }
}

TEST(LocalJoinFilter, StopsAtAnyReportAndStartsAfresh)
{
  const Values first(100000, 11);
  const Values second(100000, 13);
  const auto table = MakeTable(first, second);
  Filter counted(MakeParticles(), table);
  counted->SetThreads(1);
  counted->Update();
  ASSERT_GE(counted.Seen->Reported.size(), 5u);
  EXPECT_TRUE(std::is_sorted(counted.Seen->Reported.begin(), counted.Seen->Reported.end()));
  // the last report comes from the pipeline when all is done, too late for anything
  for (std::size_t at = 1; at + 1 < counted.Seen->Reported.size(); ++at)
  {
    Filter filter(MakeParticles(), table);
    filter->SetThreads(1);
    filter.Seen->StopAt = at;
    filter->Update();
    filter.ExpectSaid("");
    EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 0) << at;
    filter->Update();
    EXPECT_EQ(filter.Lines()->GetNumberOfCells(), 100000);
  }
}
