// SPDX-License-Identifier: BSD-3-Clause
// Source and filter from C++: pieces, ghosts, inputs that are none, stopping.
#include "vtkGranularDecomposition.h"
#include "vtkGranularDecompositionSource.h"

#include "../support/observer.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTrivialProducer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{
template <class Algorithm>
struct WatchedVoxels : Watched<Algorithm>
{
  vtkUnstructuredGrid* Grid() { return this->Get->GetOutput(); }
  vtkDataArray* Cells(const char* name) { return this->Grid()->GetCellData()->GetArray(name); }
};

using Source = WatchedVoxels<vtkGranularDecompositionSource>;
using Filter = WatchedVoxels<vtkGranularDecomposition>;

/// Points without any field data.
vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<std::vector<double>>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const std::vector<double>& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

/// The unit cube from -1 to 1, cut in two along each axis.
void CutInEight(Filter& filter)
{
  filter->SetBounds(-1, 1, -1, 1, -1, 1);
  filter->SetProcessorGrid(2, 2, 2);
}

double Sum(vtkDataArray* array)
{
  double sum = 0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    sum += array->GetComponent(i, 0);
  }
  return sum;
}
}

TEST(DecompositionSource, PiecesAreTheWhole)
{
  Source whole;
  whole->SetProcessorGrid(3, 5, 7);
  whole->Update();
  ASSERT_EQ(whole.Grid()->GetNumberOfCells(), 105);
  EXPECT_EQ(whole.Grid()->GetNumberOfPoints(), 840);
  EXPECT_EQ(whole.Grid()->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_NE(vtkTypeInt64Array::SafeDownCast(whole.Cells("nlocal")), nullptr);
  EXPECT_NE(vtkTypeInt32Array::SafeDownCast(whole.Cells("proc")), nullptr);
  vtkIdType cell = 0;
  for (int piece = 0; piece < 8; ++piece)
  {
    Source part;
    part->SetProcessorGrid(3, 5, 7);
    part->UpdatePiece(piece, 8, 0);
    for (vtkIdType i = 0; i < part.Grid()->GetNumberOfCells(); ++i, ++cell)
    {
      double own[6];
      double same[6];
      part.Grid()->GetCellBounds(i, own);
      whole.Grid()->GetCellBounds(cell, same);
      for (int k = 0; k < 6; ++k)
      {
        ASSERT_EQ(own[k], same[k]);
      }
      ASSERT_EQ(part.Cells("proc")->GetComponent(i, 0), static_cast<double>(cell));
    }
  }
  EXPECT_EQ(cell, 105);
}

TEST(DecompositionSource, ErrorsLeaveNothingAndAreGoneWhenMended)
{
  const struct
  {
    void (*Spoil)(vtkGranularDecompositionSource*);
    const char* Text;
  } cases[] = {
    { [](vtkGranularDecompositionSource* s) { s->SetBounds(0, -1, 0, 1, 0, 1); }, "along x" },
    { [](vtkGranularDecompositionSource* s) { s->SetNumberOfProcesses(3); }, "got 3" },
    { [](vtkGranularDecompositionSource* s) { s->SetProcessorGrid(0, 2, 2); }, "got 0" },
    { [](vtkGranularDecompositionSource* s)
      {
        s->AddYCut(0.5);
        s->AddYCut(0.25);
        s->SetProcessorGrid(1, 3, 1);
      },
      "along y" },
    { [](vtkGranularDecompositionSource* s) { s->AddZCut(0.5); }, "along z" },
  };
  for (const auto& each : cases)
  {
    Source source;
    each.Spoil(source.Get);
    source->Update();
    ASSERT_EQ(source.Seen->Said.size(), 1u) << each.Text;
    EXPECT_NE(source.Seen->Said[0].find(each.Text), std::string::npos) << source.Seen->Said[0];
    EXPECT_NE(source->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_EQ(source.Grid()->GetNumberOfCells(), 0);
    source->SetBounds(0, 1, 0, 1, 0, 1);
    source->SetNumberOfProcesses(0);
    source->SetProcessorGrid(1, 1, 1);
    source->ClearYCuts();
    source->ClearZCuts();
    source->Update();
    EXPECT_EQ(source.Grid()->GetNumberOfCells(), 1);
    EXPECT_EQ(source->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  }
}

TEST(Decomposition, FacesBelongToTheProcessAboveAndTheLastToTheBox)
{
  vtkNew<vtkTrivialProducer> points;
  points->SetOutput(MakePoints({ { 0, 0, 0 }, { -1, -1, -1 }, { 1, 1, 1 }, { -0.0, -0.5, 0.5 },
    { 1, -1, 0 }, { 1.0000000000000002, 0, 0 } }));
  Filter filter;
  CutInEight(filter);
  filter->SetInputConnection(points->GetOutputPort());
  filter->Update();
  EXPECT_EQ(filter.Cells("nlocal")->GetComponent(0, 0), 1);
  EXPECT_EQ(filter.Cells("nlocal")->GetComponent(7, 0), 2);
  EXPECT_EQ(Sum(filter.Cells("nlocal")), 5);
  EXPECT_EQ(filter.Grid()->GetFieldData()->GetArray("outside")->GetComponent(0, 0), 1);
  EXPECT_EQ(filter.Grid()->GetFieldData()->GetArray("imbalance")->GetComponent(0, 0), 2 / (5. / 8));
  ASSERT_EQ(filter.Seen->Said.size(), 1u);
  EXPECT_NE(filter.Seen->Said[0].find("1 particles are outside"), std::string::npos);
}

TEST(Decomposition, AnyPieceHasTheCountsOfTheWhole)
{
  Source division;
  division->SetBounds(-1, 1, -1, 1, -1, 1);
  division->SetProcessorGrid(2, 2, 2);
  vtkNew<vtkTrivialProducer> points;
  points->SetOutput(MakePoints({ { 0.5, 0.5, 0.5 }, { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.6 } }));
  for (const int mode :
    { vtkGranularDecomposition::PROCESSOR_GRID, vtkGranularDecomposition::SUBDOMAINS })
  {
    double sum = 0;
    vtkIdType cells = 0;
    for (int piece = 0; piece < 3; ++piece)
    {
      Filter filter;
      CutInEight(filter);
      filter->SetMode(mode);
      filter->SetInputConnection(points->GetOutputPort());
      filter->SetSubdomainsConnection(division->GetOutputPort());
      filter->UpdatePiece(piece, 3, 0);
      cells += filter.Grid()->GetNumberOfCells();
      sum += Sum(filter.Cells("nlocal"));
      EXPECT_EQ(
        filter.Grid()->GetFieldData()->GetArray("imbalance")->GetComponent(0, 0), 2 / (3. / 8));
    }
    EXPECT_EQ(cells, 8);
    EXPECT_EQ(sum, 3);
  }
}

TEST(Decomposition, DuplicatesAreLeftOut)
{
  auto data = MakePoints({ { 0.5, 0.5, 0.5 }, { 0.6, 0.5, 0.5 }, { -0.5, 0.5, 0.5 } });
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (const unsigned char ghost : { 0, 1, 1 })
  {
    ghosts->InsertNextValue(ghost);
  }
  data->GetPointData()->AddArray(ghosts);
  vtkNew<vtkDoubleArray> owner;
  owner->SetName("proc");
  for (const double rank : { 3, 3, 1 })
  {
    owner->InsertNextValue(rank);
  }
  data->GetPointData()->AddArray(owner);
  vtkNew<vtkTrivialProducer> points;
  points->SetOutput(data);
  Filter filter;
  CutInEight(filter);
  filter->SetInputConnection(points->GetOutputPort());
  filter->Update();
  EXPECT_EQ(Sum(filter.Cells("nlocal")), 1);
  filter->SetMode(vtkGranularDecomposition::PROCESS_ARRAY);
  filter->Update();
  ASSERT_EQ(filter.Grid()->GetNumberOfCells(), 1);
  EXPECT_EQ(filter.Cells("proc")->GetComponent(0, 0), 3);
  EXPECT_EQ(filter.Grid()->GetFieldData()->GetArray("imbalance")->GetComponent(0, 0), 4);
  filter->SetMode(vtkGranularDecomposition::RANKS);
  filter->Update();
  EXPECT_EQ(Sum(filter.Cells("nlocal")), 1);
}

TEST(Decomposition, WhatIsMissingIsAnError)
{
  vtkNew<vtkTrivialProducer> points;
  points->SetOutput(MakePoints({ { 0, 0, 0 } }));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakePoints({ { 0, 0, 0 } }));
  vtkNew<vtkTrivialProducer> composite;
  composite->SetOutput(blocks);
  const struct
  {
    vtkAlgorithm* Input;
    int Mode;
    const char* Text;
  } cases[] = { { points, vtkGranularDecomposition::PROCESSOR_GRID, "give Bounds" },
    { points, vtkGranularDecomposition::PROCESS_ARRAY, "'proc'" },
    { points, vtkGranularDecomposition::SUBDOMAINS, "second input" },
    { composite, vtkGranularDecomposition::RANKS, "MergeBlocks" } };
  for (const auto& each : cases)
  {
    Filter filter;
    filter->SetMode(each.Mode);
    filter->SetInputConnection(each.Input->GetOutputPort());
    filter->Update();
    ASSERT_EQ(filter.Seen->Said.size(), 1u) << each.Text;
    EXPECT_NE(filter.Seen->Said[0].find(each.Text), std::string::npos) << filter.Seen->Said[0];
    EXPECT_EQ(filter.Grid()->GetNumberOfCells(), 0);
  }
}

TEST(Decomposition, StopsAtAnyReportAndStartsAfresh)
{
  auto data = MakePoints({});
  for (int i = 0; i < 100000; ++i)
  {
    data->GetPoints()->InsertNextPoint(1e-5 * i, 0, 0);
  }
  vtkNew<vtkTrivialProducer> points;
  points->SetOutput(data);
  const auto prepare = [&](Filter& filter)
  {
    CutInEight(filter);
    filter->SetThreads(1);
    filter->SetInputConnection(points->GetOutputPort());
  };
  Filter counted;
  prepare(counted);
  counted->Update();
  ASSERT_GE(counted.Seen->Reported.size(), 3u);
  // the last report comes from the pipeline when all is done, too late for anything
  for (std::size_t at = 1; at + 1 < counted.Seen->Reported.size(); ++at)
  {
    Filter filter;
    prepare(filter);
    filter.Seen->StopAt = at;
    filter->Update();
    EXPECT_TRUE(filter.Seen->Said.empty());
    EXPECT_EQ(filter.Grid()->GetNumberOfCells(), 0) << at;
    filter->Update();
    EXPECT_EQ(Sum(filter.Cells("nlocal")), 100000);
  }
}
