// SPDX-License-Identifier: BSD-3-Clause
// The filter from C++: inputs of any kind, which stay as they are; pieces; stopping.
#include "vtkGranularContactSums.h"

#include "../support/observer.h"
#include "../support/vtk_arrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArraySelection.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersion.h"
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
#include "vtkAffineArray.h"
#endif

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
/// Points on the x axis.
vtkSmartPointer<vtkPoints> MakePoints(const Values& xs, int type = VTK_DOUBLE)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  for (const double x : xs)
  {
    points->InsertNextPoint(x, 0, 0);
  }
  return points;
}

/// Particles 0 to n - 1 at x = 0, 2, 4 and so on, of radius 1.
template <class Data = vtkPolyData>
vtkSmartPointer<Data> MakeParticles(int count, int type = VTK_DOUBLE)
{
  Values ids;
  Values xs;
  for (int i = 0; i < count; ++i)
  {
    ids.push_back(i);
    xs.push_back(2. * i);
  }
  auto particles = vtkSmartPointer<Data>::New();
  particles->SetPoints(MakePoints(xs, type));
  particles->GetPointData()->SetPedigreeIds(MakeArray<vtkTypeInt64Array>("id", ids));
  particles->GetPointData()->AddArray(MakeArray("radius", Values(ids.size(), 1)));
  return particles;
}

/// A chain: each pushes the next one with its number in N.
vtkSmartPointer<vtkPolyData> MakeLines(int count, int type = VTK_DOUBLE)
{
  Values id1;
  Values id2;
  Values xs;
  Values forces;
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < count; ++i)
  {
    id1.push_back(i);
    id2.push_back(i + 1);
    xs.insert(xs.end(), { 2. * i, 2. * (i + 1) });
    forces.insert(forces.end(), { -1. - i, 1, 0 });
    cells->InsertNextCell({ 2 * i, 2 * i + 1 });
  }
  auto lines = vtkSmartPointer<vtkPolyData>::New();
  lines->SetPoints(MakePoints(xs, type));
  lines->SetLines(cells);
  lines->GetCellData()->AddArray(MakeArray<vtkTypeInt64Array>("id1", id1));
  lines->GetCellData()->AddArray(MakeArray<vtkTypeInt64Array>("id2", id2));
  lines->GetCellData()->AddArray(MakeArray("force", forces, 3));
  return lines;
}

/// A filter with all its arrays on.
struct Filter : Watched<vtkGranularContactSums>
{
  explicit Filter(vtkDataObject* particles, vtkDataObject* lines = nullptr)
  {
    this->Get->SetController(nullptr);
    this->Get->SetInputDataObject(0, particles);
    this->Get->SetInputDataObject(1, lines);
    this->Get->GetArraySelection()->EnableAllArrays();
  }

  Values Points(const char* name) { return Of(this->Get->GetOutput()->GetPointData(), name); }
  Values Cells(const char* name) { return Of(this->Get->GetLinesOutput()->GetCellData(), name); }

  static Values Of(vtkDataSetAttributes* data, const char* name)
  {
    return ValuesOf(data->GetArray(name));
  }
};

constexpr const char* PointArrays[] = { "coordination", "contact_force", "contact_torque", "fabric",
  "contact_stress", "principal_stress", "von_mises", "rattler", "coordination_without_rattlers" };

void ExpectSame(Filter& filter, Filter& expected)
{
  for (const char* name : PointArrays)
  {
    EXPECT_EQ(filter.Points(name), expected.Points(name)) << name;
    EXPECT_FALSE(filter.Points(name).empty()) << name;
  }
  EXPECT_EQ(filter.Cells("mobilised_friction"), expected.Cells("mobilised_friction"));
}
}

TEST(ContactSums, AChain)
{
  Filter filter(MakeParticles(4), MakeLines(3));
  filter->Update();
  EXPECT_TRUE(filter.Seen->Said.empty());
  EXPECT_EQ(filter.Points("coordination"), (Values{ 1, 2, 2, 1 }));
  EXPECT_EQ(filter.Points("contact_force"), (Values{ -1, 1, 0, -1, 0, 0, -1, 0, 0, 3, -1, 0 }));
  EXPECT_EQ(filter.Points("rattler"), (Values{ 1, 1, 1, 1 }));
  EXPECT_EQ(filter.Cells("mobilised_friction"), (Values{ 1, 1. / 2, 1. / 3 }));
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetPedigreeIds()->GetName(), std::string("id"));
  EXPECT_EQ(filter->GetLinesOutput()->GetNumberOfLines(), 3);
  filter->SetFrictionCoefficient(0.5);
  filter->Update();
  EXPECT_EQ(filter.Cells("mobilised_friction"), (Values{ 2, 1, 2. / 3 }));
}

/// Arrays of any numbers and layout, points in single precision, grids as particles and as lines, cells in any order.
TEST(ContactSums, InputsOfAnyKind)
{
  Filter expected(MakeParticles(4), MakeLines(3));
  expected->Update();

  Filter single(MakeParticles(4, VTK_FLOAT), MakeLines(3, VTK_FLOAT));
  single->Update();
  ExpectSame(single, expected);

  const auto grid = MakeParticles<vtkUnstructuredGrid>(4);
  Filter unstructured(grid, MakeLines(3));
  unstructured->Update();
  ExpectSame(unstructured, expected);
  EXPECT_EQ(unstructured->GetOutput()->GetNumberOfVerts(), 4);

  const auto structured = MakeParticles<vtkStructuredGrid>(4);
  structured->SetDimensions(4, 1, 1);
  Filter regular(structured, MakeLines(3));
  regular->Update();
  ExpectSame(regular, expected);

  const auto particles = MakeParticles(4);
  particles->GetPointData()->AddArray(MakeArray<vtkIntArray>("id", { 0, 1, 2, 3 }));
  particles->GetPointData()->AddArray(MakeArray<vtkFloatArray>("radius", { 1, 1, 1, 1 }));
  const auto lines = MakeLines(3);
  lines->GetCellData()->AddArray(MakeArray("id1", { 0, 1, 2 }));
  lines->GetCellData()->AddArray(MakeArray<vtkTypeInt32Array>("id2", { 1, 2, 3 }));
  lines->GetCellData()->AddArray(
    MakeArray<vtkSOADataArrayTemplate<float>>("force", { -1, 1, 0, -2, 1, 0, -3, 1, 0 }, 3));
  Filter other(particles, lines);
  other->Update();
  ExpectSame(other, expected);

  vtkNew<vtkTable> rows;
  for (const char* name : { "id1", "id2", "force" })
  {
    rows->AddColumn(lines->GetCellData()->GetArray(name));
  }
  Filter table(MakeParticles(4), rows);
  table->Update();
  for (const char* name : PointArrays)
  {
    EXPECT_EQ(table.Points(name), expected.Points(name)) << name;
  }
  EXPECT_EQ(table->GetLinesOutput()->GetNumberOfCells(), 0);
}

/// Lines as other filters leave them: points that lines share, polylines, an unstructured grid, duplicates of other ranks.
TEST(ContactSums, LinesOfAnyKind)
{
  Filter expected(MakeParticles(4), MakeLines(3));
  expected->Update();
  const auto arrays = MakeLines(3);
  vtkNew<vtkPolyData> shared;
  shared->SetPoints(MakePoints({ 6, 4, 2, 0, 5 }));
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 3, 2 });
  cells->InsertNextCell({ 2, 4, 1 }); // there and back: from its first to its last point
  cells->InsertNextCell({ 1, 0 });
  shared->SetLines(cells);
  shared->GetCellData()->ShallowCopy(arrays->GetCellData());
  Filter sharing(MakeParticles(4), shared);
  sharing->Update();
  ExpectSame(sharing, expected);
  EXPECT_EQ(sharing->GetLinesOutput()->GetNumberOfLines(), 3);

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(shared->GetPoints());
  grid->SetCells(VTK_POLY_LINE, cells);
  grid->GetCellData()->ShallowCopy(arrays->GetCellData());
  Filter unstructured(MakeParticles(4), grid);
  unstructured->Update();
  ExpectSame(unstructured, expected);

  const auto doubled = MakeLines(4);
  doubled->GetCellData()->AddArray(
    MakeArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), { 0, 0, 0, 1 }));
  Filter ghosts(MakeParticles(4), doubled);
  ghosts->Update();
  EXPECT_TRUE(ghosts.Seen->Said.empty());
  ExpectSame(ghosts, expected);
}

/// Ends in order, in each form in which VTK stores cells.
TEST(ContactSums, CellsOfAnyStorage)
{
  Filter expected(MakeParticles(4), MakeLines(3));
  expected->Update();
  const auto ids = MakeArray<vtkTypeInt32Array>("", { 0, 1, 2, 3, 4, 5 });
  vtkNew<vtkCellArray> narrow;
  narrow->SetData(MakeArray<vtkTypeInt32Array>("", { 0, 2, 4, 6 }), ids);
  vtkNew<vtkCellArray> sized; // from VTK 9.6 on without offsets
  sized->SetData(2, ids);
  std::vector<vtkCellArray*> storages = { narrow, sized };
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  vtkNew<vtkAffineArray<vtkTypeInt64>> counted;
  counted->ConstructBackend(1, 0);
  counted->SetNumberOfValues(6);
  vtkNew<vtkCellArray> ruled;
  ruled->SetData(2, counted);
  storages.push_back(ruled);
#endif
  for (vtkCellArray* const cells : storages)
  {
    const auto lines = MakeLines(3);
    lines->SetLines(cells);
    Filter filter(MakeParticles(4), lines);
    filter->Update();
    ExpectSame(filter, expected);
    EXPECT_EQ(filter->GetLinesOutput()->GetNumberOfLines(), 3);
  }
}

/// Duplicates of other ranks are no particles of their own; hidden ones are.
TEST(ContactSums, GhostParticles)
{
  const auto particles = MakeParticles(5);
  particles->GetPointData()->AddArray(
    MakeArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), { 0, 0, 2, 0, 1 }));
  Filter filter(particles, MakeLines(4));
  filter->Update();
  EXPECT_EQ(filter.Points("coordination"), (Values{ 1, 2, 2, 2, 0 }));
  EXPECT_EQ(
    filter->GetOutput()->GetFieldData()->GetArray("mean_coordination")->GetTuple1(0), 7. / 4);
  ASSERT_EQ(filter.Seen->Said.size(), 1U);
  EXPECT_NE(filter.Seen->Said[0].find("1 of 4 contacts name a particle that is not there"),
    std::string::npos);
}

TEST(ContactSums, InputsStayAsTheyAre)
{
  const auto particles = MakeParticles(4);
  const auto lines = MakeLines(3);
  const vtkMTimeType times[] = { particles->GetMTime(), lines->GetMTime() };
  const int arrays[] = { particles->GetPointData()->GetNumberOfArrays(),
    lines->GetCellData()->GetNumberOfArrays() };
  Filter filter(particles, lines);
  filter->Update();
  filter->GetOutput()->GetPointData()->GetArray("contact_force")->FillComponent(0, 7);
  EXPECT_EQ(particles->GetMTime(), times[0]);
  EXPECT_EQ(lines->GetMTime(), times[1]);
  EXPECT_EQ(particles->GetPointData()->GetNumberOfArrays(), arrays[0]);
  EXPECT_EQ(lines->GetCellData()->GetNumberOfArrays(), arrays[1]);
  EXPECT_EQ(particles->GetFieldData()->GetNumberOfArrays(), 0);
}

/// A filter after another one: arrays of the first are replaced.
TEST(ContactSums, OnItsOwnOutput)
{
  Filter first(MakeParticles(4), MakeLines(3));
  first->Update();
  Filter second(first->GetOutput(), MakeLines(2));
  second->Update();
  EXPECT_EQ(second.Points("coordination"), (Values{ 1, 2, 1, 0 }));
  EXPECT_EQ(second->GetOutput()->GetPointData()->GetNumberOfArrays(),
    first->GetOutput()->GetPointData()->GetNumberOfArrays());
  EXPECT_EQ(first.Points("coordination"), (Values{ 1, 2, 2, 1 }));
}

/// A part of the whole, as a process asks for that is alone: the sums are those of all contacts.
TEST(ContactSums, Pieces)
{
  Filter whole(MakeParticles(11), MakeLines(10));
  whole->Update();
  for (const int pieces : { 2, 3, 20 })
  {
    for (const bool grid : { false, true })
    {
      Values found[3];
      for (int piece = 0; piece < pieces; ++piece)
      {
        vtkSmartPointer<vtkDataObject> particles = MakeParticles(11);
        if (grid)
        {
          particles = MakeParticles<vtkUnstructuredGrid>(11);
        }
        Filter filter(particles, MakeLines(10));
        filter->UpdatePiece(piece, pieces, 0);
        EXPECT_TRUE(filter.Seen->Said.empty());
        vtkPolyData* const output = filter->GetOutput();
        EXPECT_EQ(output->GetNumberOfVerts(), output->GetNumberOfPoints());
        EXPECT_EQ(output->GetFieldData()->GetArray("mean_coordination")->GetTuple1(0), 20. / 11);
        int i = 0;
        for (const char* name : { "id", "contact_force", "coordination" })
        {
          const Values values = filter.Points(name);
          found[i].insert(found[i].end(), values.begin(), values.end());
          ++i;
        }
        for (vtkIdType row = 0; row < output->GetNumberOfPoints(); ++row)
        {
          EXPECT_EQ(
            output->GetPoint(row)[0], 2 * filter.Points("id")[static_cast<std::size_t>(row)]);
        }
      }
      EXPECT_EQ(found[0], whole.Points("id")) << pieces;
      EXPECT_EQ(found[1], whole.Points("contact_force")) << pieces;
      EXPECT_EQ(found[2], whole.Points("coordination")) << pieces;
    }
  }
}

/// Through the second output: each line once.
TEST(ContactSums, PiecesOfLines)
{
  Filter whole(MakeParticles(11), MakeLines(10));
  whole->Update();
  Values found;
  for (int piece = 0; piece < 3; ++piece)
  {
    Filter filter(MakeParticles(11), MakeLines(10));
    filter->UpdateInformation();
    vtkInformation* const info = filter->GetOutputInformation(1);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 3);
    filter->Update(1);
    const Values friction = filter.Cells("mobilised_friction");
    found.insert(found.end(), friction.begin(), friction.end());
    EXPECT_EQ(filter->GetLinesOutput()->GetNumberOfLines(), std::ssize(friction));
  }
  EXPECT_EQ(found, whole.Cells("mobilised_friction"));
  EXPECT_EQ(found.size(), 10U);
}

/// Nothing to take a part of: no points at all.
TEST(ContactSums, PiecesOfNothing)
{
  for (const int piece : { 0, 1, 2 })
  {
    vtkNew<vtkPolyData> nothing;
    Filter filter(nothing, MakeLines(0));
    filter->UpdatePiece(piece, 3, 0);
    EXPECT_TRUE(filter.Seen->Said.empty());
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::NoError);
    vtkNew<vtkUnstructuredGrid> grid;
    Filter other(grid, MakeLines(0));
    other->UpdatePiece(piece, 3, 0);
    EXPECT_EQ(other->GetErrorCode(), vtkErrorCode::NoError);
    EXPECT_EQ(other->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST(ContactSums, StopsWhereverItIsAsked)
{
  const auto particles = MakeParticles(6000);
  const auto lines = MakeLines(5999);
  Filter counted(particles, lines);
  counted->SetThreads(1);
  counted->Update();
  EXPECT_GT(counted.Seen->Reported.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(counted.Seen->Reported));
  EXPECT_GE(counted.Seen->Reported.front(), 0);
  EXPECT_EQ(counted.Seen->Reported.back(), 1);
  for (std::size_t at = 1; at + 1 < counted.Seen->Reported.size(); at += 1 + at / 8)
  {
    Filter filter(particles, lines);
    filter->SetThreads(1);
    filter.Seen->StopAt = at;
    filter->Update();
    EXPECT_TRUE(filter.Seen->Said.empty());
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << at;
    EXPECT_EQ(filter->GetLinesOutput()->GetNumberOfCells(), 0) << at;
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 6000) << at;
  }
}

/// A choice of arrays is a change of the filter; one that is already made is none.
TEST(ContactSums, ChangesOfTheSelection)
{
  Filter filter(MakeParticles(4), MakeLines(3));
  filter->Update();
  const vtkMTimeType time = filter->GetMTime();
  filter->GetArraySelection()->EnableArray("fabric");
  EXPECT_EQ(filter->GetMTime(), time);
  filter->GetArraySelection()->DisableArray("fabric");
  EXPECT_GT(filter->GetMTime(), time);
  filter->Update();
  EXPECT_TRUE(filter.Points("fabric").empty());
  EXPECT_FALSE(filter.Points("contact_stress").empty());
}
