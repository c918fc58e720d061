// SPDX-License-Identifier: BSD-3-Clause
// vtkGranularPackingSource from C++: arrays, pieces, errors, stopping.
#include "vtkGranularPackingSource.h"

#include "../support/observer.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
struct Source : Watched<vtkGranularPackingSource>
{
  vtkPolyData* Grains() { return this->Get->GetOutput(); }
  vtkUnstructuredGrid* Box()
  {
    return vtkUnstructuredGrid::SafeDownCast(this->Get->GetOutputDataObject(1));
  }
  vtkPolyData* Bonds() { return vtkPolyData::SafeDownCast(this->Get->GetOutputDataObject(2)); }
  vtkDataArray* BondArray(const char* name) { return this->Bonds()->GetCellData()->GetArray(name); }
  vtkDataArray* Array(const char* name) { return this->Grains()->GetPointData()->GetArray(name); }
};

void ExpectEmpty(Source& source)
{
  EXPECT_EQ(source.Grains()->GetNumberOfPoints(), 0);
  EXPECT_EQ(source.Grains()->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(source.Box()->GetNumberOfCells(), 0);
  EXPECT_EQ(source.Bonds()->GetNumberOfPoints(), 0);
  EXPECT_EQ(source.Bonds()->GetNumberOfCells(), 0);
  EXPECT_EQ(source.Bonds()->GetCellData()->GetNumberOfArrays(), 0);
}
}

TEST(PackingSource, GivesWhatADumpWould)
{
  Source source;
  source->Update();
  EXPECT_EQ(source->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  ASSERT_EQ(source.Grains()->GetNumberOfPoints(), 1000);
  EXPECT_EQ(source.Grains()->GetNumberOfVerts(), 1000);
  EXPECT_NE(vtkTypeInt64Array::SafeDownCast(source.Array("id")), nullptr);
  EXPECT_EQ(source.Grains()->GetPointData()->GetPedigreeIds(), source.Array("id"));
  EXPECT_NE(vtkTypeInt32Array::SafeDownCast(source.Array("type")), nullptr);
  EXPECT_EQ(source.Array("v")->GetNumberOfComponents(), 3);
  double range[2];
  source.Array("radius")->GetRange(range);
  EXPECT_EQ(range[0], 0.003);
  EXPECT_EQ(range[1], 0.005);
  EXPECT_EQ(source.Box()->GetNumberOfCells(), 1);
  EXPECT_EQ(source.Bonds()->GetNumberOfCells(), 0);
  EXPECT_EQ(source.Bonds()->GetCellData()->GetNumberOfArrays(), 0);
  for (vtkDataObject* output : { static_cast<vtkDataObject*>(source.Grains()),
         static_cast<vtkDataObject*>(source.Box()), static_cast<vtkDataObject*>(source.Bonds()) })
  {
    vtkFieldData* data = output->GetFieldData();
    for (const char* name :
      { "Coordinates", "PointOrigin", "BoxOrigin", "BoxVectors", "Boundary", "timestep" })
    {
      EXPECT_NE(data->GetAbstractArray(name), nullptr) << name;
    }
    EXPECT_EQ(
      data->HasArray("Columns") != 0, output != source.Bonds()); // which are not of particles
  }
}

TEST(PackingSource, PiecesAreTheWholeAndTheBoxIsInTheFirst)
{
  Source whole;
  whole->SetSpeed(1);
  whole->Update();
  vtkIdType row = 0;
  for (int piece = 0; piece < 7; ++piece)
  {
    Source part;
    part->SetSpeed(1);
    part->UpdatePiece(piece, 7, 0);
    EXPECT_EQ(part.Box()->GetNumberOfCells(), piece == 0 ? 1 : 0);
    for (vtkIdType i = 0; i < part.Grains()->GetNumberOfPoints(); ++i, ++row)
    {
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_EQ(part.Grains()->GetPoint(i)[k], whole.Grains()->GetPoint(row)[k]);
        ASSERT_EQ(part.Array("v")->GetComponent(i, k), whole.Array("v")->GetComponent(row, k));
      }
      ASSERT_EQ(part.Array("id")->GetComponent(i, 0), static_cast<double>(row + 1));
      ASSERT_EQ(
        part.Array("radius")->GetComponent(i, 0), whole.Array("radius")->GetComponent(row, 0));
    }
  }
  EXPECT_EQ(row, 1000);
}

TEST(PackingSource, BondsOfABlockAreLines)
{
  Source source;
  source->SetArrangement(vtkGranularPackingSource::SIMPLE_CUBIC);
  source->SetRadii(vtkGranularPackingSource::ONE);
  source->SetRadius(0.005);
  source->SetNumberOfGrains(0);
  source->SetBoxLengths(0.1, 0.1, 0.1);
  source->SetBoundary("p f f");
  source->SetBondFactor(1.05);
  source->Update();
  ASSERT_EQ(source.Grains()->GetNumberOfPoints(), 1000);
  // ten cubed: along each line across a wall nine, along each periodic one ten
  ASSERT_EQ(source.Bonds()->GetNumberOfLines(), 100 * (10 + 9 + 9));
  ASSERT_EQ(source.Bonds()->GetNumberOfPoints(), 2 * source.Bonds()->GetNumberOfLines());
  EXPECT_EQ(source.Bonds()->GetNumberOfCells(), source.Bonds()->GetNumberOfLines());
  EXPECT_NE(vtkTypeInt64Array::SafeDownCast(source.BondArray("id1")), nullptr);
  EXPECT_NE(vtkTypeInt64Array::SafeDownCast(source.BondArray("id2")), nullptr);
  EXPECT_NE(vtkTypeInt32Array::SafeDownCast(source.BondArray("btype")), nullptr);
  for (vtkIdType bond = 0; bond < source.Bonds()->GetNumberOfCells(); ++bond)
  {
    vtkIdType size = 0;
    const vtkIdType* ends = nullptr;
    source.Bonds()->GetCellPoints(bond, size, ends);
    ASSERT_EQ(size, 2);
    const auto id = static_cast<vtkIdType>(source.BondArray("id1")->GetTuple1(bond));
    double first[3];
    double second[3];
    source.Bonds()->GetPoint(ends[0], first);
    source.Bonds()->GetPoint(ends[1], second);
    ASSERT_TRUE(std::equal(first, first + 3, source.Grains()->GetPoint(id - 1)));
    ASSERT_NEAR(vtkMath::Distance2BetweenPoints(first, second), 1e-4, 1e-16);
    ASSERT_NEAR(source.BondArray("equilibrium_length")->GetTuple1(bond), 0.01, 1e-15);
    ASSERT_EQ(source.BondArray("length")->GetTuple1(bond),
      source.BondArray("equilibrium_length")->GetTuple1(bond));
    ASSERT_EQ(source.BondArray("btype")->GetTuple1(bond), 1);
  }
  source->SetBondFactor(0);
  source->Update();
  EXPECT_EQ(source.Bonds()->GetNumberOfCells(), 0);
}

TEST(PackingSource, AChainHasBonds)
{
  Source source;
  source->SetArrangement(vtkGranularPackingSource::CHAIN);
  source->SetNumberOfGrains(45);
  source->SetBondFactor(1);
  source->Update();
  ASSERT_EQ(source.Grains()->GetNumberOfPoints(), 45);
  EXPECT_EQ(source.Bonds()->GetNumberOfLines(), 44);
  ASSERT_NE(vtkTypeInt64Array::SafeDownCast(source.Array("mol")), nullptr);
  EXPECT_EQ(source.Array("mol")->GetRange()[0], 1);
  EXPECT_EQ(source.Array("mol")->GetRange()[1], 1);
}

TEST(PackingSource, TiltedBox)
{
  Source source;
  source->SetArrangement(vtkGranularPackingSource::FACE_CENTRED_CUBIC);
  source->SetNumberOfGrains(0);
  source->SetBoxOrigin(1, 2, 3);
  source->SetBoxLengths(0.1, 0.1, 0.1);
  source->SetBoxTilts(0.01, 0.02, -0.03);
  source->SetBoundary("p p p");
  source->Update();
  EXPECT_GT(source.Grains()->GetNumberOfPoints(), 100);
  double bounds[6];
  source.Box()->GetBounds(bounds);
  const double expected[] = { 1, 1.13, 1.97, 2.1, 3, 3.1 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-12);
  }
}

TEST(PackingSource, ErrorsLeaveNothingAndAreGoneWhenMended)
{
  const struct
  {
    void (*Spoil)(vtkGranularPackingSource*);
    const char* Text;
  } cases[] = {
    // values of earlier versions, which state files may have
    { [](vtkGranularPackingSource* s) { s->SetArrangement(3); },
      "expected the Arrangement 0 (Random), 1 (SimpleCubic), 2 (FaceCentredCubic) or 4 (Chain), "
      "got 3" },
    { [](vtkGranularPackingSource* s) { s->SetRadii(2); },
      "expected the Radii 0 (One) or 1 (Two), got 2" },
    { [](vtkGranularPackingSource* s) { s->SetBoxLengths(0.1, -0.1, 0.1); },
      "expected BoxLengths greater than 0, got -0.100000" },
    { [](vtkGranularPackingSource* s) { s->SetNumberOfGrains(4000); }, "at most 0.74" },
    { [](vtkGranularPackingSource* s)
      {
        s->SetBoxLengths(0, 0, 0);
        s->SetBoxTilts(0, 0.1, 0);
      },
      "expected BoxLengths of the box that BoxTilts are of, got none" },
  };
  for (const auto& each : cases)
  {
    Source source;
    source->SetBoxLengths(0.1, 0.1, 0.1);
    each.Spoil(source.Get);
    source->Update();
    ASSERT_EQ(source.Seen->Said.size(), 1u) << each.Text;
    EXPECT_NE(source.Seen->Said[0].find(each.Text), std::string::npos) << source.Seen->Said[0];
    EXPECT_NE(source->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    ExpectEmpty(source);
    // what does not fit is not tried again before something changes
    const vtkMTimeType changed = source->GetMTime();
    source->Update();
    EXPECT_EQ(source->GetMTime(), changed) << each.Text;
    source->SetArrangement(vtkGranularPackingSource::RANDOM);
    source->SetRadii(vtkGranularPackingSource::TWO);
    source->SetBoxLengths(0.1, 0.1, 0.1);
    source->SetBoxTilts(0, 0, 0);
    source->SetNumberOfGrains(10);
    source->Update();
    EXPECT_EQ(source.Grains()->GetNumberOfPoints(), 10);
    EXPECT_EQ(source->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  }
  Source threads;
  threads->SetThreads(-1);
  EXPECT_EQ(threads.Seen->Said.size(), 1u);
  EXPECT_EQ(threads->GetThreads(), 0);
}

TEST(PackingSource, StopsAtAnyReportAndStartsAfresh)
{
  for (const bool lattice : { false, true })
  {
    const auto prepare = [lattice](Source& source)
    {
      source->SetArrangement(
        lattice ? vtkGranularPackingSource::SIMPLE_CUBIC : vtkGranularPackingSource::RANDOM);
      source->SetNumberOfGrains(5000);
      source->SetBondFactor(1.2);
      source->SetThreads(1);
    };
    Source counted;
    prepare(counted);
    counted->Update();
    const std::vector<double> reported = counted.Seen->Reported;
    ASSERT_GE(reported.size(), 5u);
    EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
    // the last report comes from the pipeline when all is done, too late for anything
    for (std::size_t at = 1; at + 1 < reported.size(); ++at)
    {
      Source source;
      prepare(source);
      source.Seen->StopAt = at;
      source->Update();
      EXPECT_TRUE(source.Seen->Said.empty());
      ExpectEmpty(source);
      source->Update();
      EXPECT_EQ(source.Grains()->GetNumberOfPoints(), 5000);
      EXPECT_EQ(source.Box()->GetNumberOfCells(), 1);
      EXPECT_EQ(source.Bonds()->GetNumberOfCells(), counted.Bonds()->GetNumberOfCells());
    }
  }
}
