// SPDX-License-Identifier: BSD-3-Clause
// What vtkGranularEulerWriter writes of which data, under which names, and what it refuses.
#include "vtkGranularEulerWriter.h"

#include "../support/vtk_arrays.h"
#include "../support/whole_file_writers.h"
#include "made_files.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

namespace
{
using CellWriter = WholeFileWriter<vtkGranularEulerWriter>;

template <class Array = vtkDoubleArray>
void AddValues(
  vtkDataSetAttributes* data, const char* name, int components, const std::vector<double>& values)
{
  data->AddArray(MakeArray<Array>(name, values, components));
}

/// The values that EulerText writes, of cells from the first on.
void AddCells(vtkDataSetAttributes* data, std::size_t count, std::size_t first = 0)
{
  std::vector<double> velocities, fractions, pressures;
  for (std::size_t i = first; i < first + count; ++i)
  {
    const auto value = static_cast<double>(i);
    velocities.insert(velocities.end(), { value, -value, 0.5 });
    fractions.push_back(0.01 * value);
    pressures.push_back(1000 * value);
  }
  AddValues<vtkFloatArray>(data, "v_avg", 3, velocities);
  AddValues(data, "volumefraction", 1, fractions);
  AddValues(data, "radius", 1, std::vector<double>(count, 0.25));
  AddValues(data, "pressure", 1, pressures);
}

vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<Place>& centres, std::size_t first = 0)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Place& centre : centres)
  {
    points->InsertNextPoint(centre.data());
  }
  data->SetPoints(points);
  AddCells(data->GetPointData(), centres.size(), first);
  return data;
}

const std::vector<Place> Grid = Centres({ -1, 0, 2 }, { 0.5, 0.25, 1 }, { 2, 3, 4 });
const std::string GridText = EulerText(Grid);

/// Another file of the same folder.
std::string Near(const std::string& path, const std::string& name)
{
  return (std::filesystem::path(path).parent_path() / name).string();
}

vtkSmartPointer<vtkImageData> MakeImage(std::size_t first = 0)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetOrigin(-1, 0, 2);
  image->SetSpacing(0.5, 0.25, 1);
  image->SetExtent(0, 2, 0, 3, 0, 4);
  AddCells(image->GetCellData(), 24, first);
  return image;
}
}

TEST(EulerWriter, Points)
{
  for (const char* name : { "a.euler", "a.vtk", "a", "a.txt" })
  {
    EXPECT_EQ(CellWriter(NewName(name), MakePoints(Grid)).Bytes(), GridText);
  }
}

TEST(EulerWriter, Image)
{
  EXPECT_EQ(CellWriter(NewName("a.euler"), MakeImage()).Bytes(), GridText);
  // where an extent begins says where the cells are
  auto image = MakeImage();
  image->SetOrigin(-3, -1, 5);
  image->SetExtent(4, 6, 4, 7, -3, 1);
  EXPECT_EQ(CellWriter(NewName("a.euler"), image).Bytes(), GridText);
}

TEST(EulerWriter, FlatImage)
{
  vtkNew<vtkImageData> flat;
  flat->SetOrigin(0, 0, 7);
  flat->SetExtent(0, 2, 0, 1, 3, 3);
  AddCells(flat->GetCellData(), 2);
  EXPECT_EQ(CellWriter(NewName("a.euler"), flat).Bytes(),
    EulerText({ { 0.5, 0.5, 10 }, { 1.5, 0.5, 10 } }));
}

TEST(EulerWriter, TurnedImage)
{
  auto image = MakeImage();
  image->GetDirectionMatrix()->SetElement(0, 1, 0.5);
  CellWriter writer(NewName("a.euler"), image);
  writer.ExpectUnsupported("expected an image along the axes, got a turned one");
}

TEST(EulerWriter, RectilinearGrid)
{
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetExtent(1, 3, 0, 1, 0, 1);
  const auto faces = [](const std::vector<double>& values)
  {
    vtkNew<vtkDoubleArray> array;
    for (const double value : values)
    {
      array->InsertNextValue(value);
    }
    return vtkSmartPointer<vtkDataArray>(array.Get());
  };
  grid->SetXCoordinates(faces({ 0, 1, 5 }));
  grid->SetYCoordinates(faces({ -1, 1 }));
  grid->SetZCoordinates(faces({ 2, 2.5 }));
  AddCells(grid->GetCellData(), 2);
  EXPECT_EQ(
    CellWriter(NewName("a.euler"), grid).Bytes(), EulerText({ { 0.5, 0, 2.25 }, { 3, 0, 2.25 } }));
}

/// Blocks one after the other, as LIGGGHTS writes the grids of its processes.
TEST(EulerWriter, Composite)
{
  const std::vector<Place> three = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, -1 } };
  vtkNew<vtkPartitionedDataSet> blocks;
  blocks->SetPartition(0, MakePoints(three));
  blocks->SetPartition(3, MakeImage(3));
  blocks->SetPartition(4, vtkNew<vtkPolyData>());
  AddField(blocks, "timestep", { 70 });
  CellWriter writer(FreshName("a_*.euler"), blocks);
  writer.ExpectWritten();
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{ "a_70.euler" });
  EXPECT_EQ(Content(Near(writer->GetFileName(), "a_70.euler")), EulerText(three + Grid));

  vtkNew<vtkMultiBlockDataSet> nested;
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, MakePoints(three));
  AddField(inner->GetBlock(0), "timestep", { 80 });
  nested->SetBlock(0, inner);
  nested->SetBlock(2, MakeImage(3));
  CellWriter other(FreshName("b_*.euler"), nested);
  other.ExpectWritten();
  EXPECT_EQ(Beside(other->GetFileName()), Lines{ "b_80.euler" });
  EXPECT_EQ(Content(Near(other->GetFileName(), "b_80.euler")), EulerText(three + Grid));
}

/// Absolute coordinates are written, whatever the points are less.
TEST(EulerWriter, Origin)
{
  std::vector<Place> moved = Grid;
  for (Place& place : moved)
  {
    place[0] -= 100;
  }
  auto points = MakePoints(moved);
  AddField(points, "PointOrigin", { 100, 0, 0 });
  EXPECT_EQ(CellWriter(NewName("a.euler"), points).Bytes(), GridText);
  auto image = MakeImage();
  image->SetOrigin(-101, 0, 2);
  AddField(image, "PointOrigin", { 100, 0, 0 });
  AddText(image, "Coordinates", "Unwrapped");
  EXPECT_EQ(CellWriter(NewName("a.euler"), image).Bytes(), GridText);
  auto scaled = MakePoints({ { 0.5, 0.25, 0 } });
  AddText(scaled, "Coordinates", "Scaled");
  AddField(scaled, "BoxOrigin", { 1, 0, 0 });
  AddField(scaled, "BoxVectors", { 2, 0, 0, 0, 4, 0, 0, 0, 1 });
  EXPECT_EQ(CellWriter(NewName("a.euler"), scaled).Bytes(), EulerText({ { 2, 1, 0 } }));
}

TEST(EulerWriter, Ghosts)
{
  const char* ghosts = vtkDataSetAttributes::GhostArrayName();
  std::vector<double> last(24, 0);
  last[23] = vtkDataSetAttributes::DUPLICATEPOINT;
  last[1] = vtkDataSetAttributes::HIDDENPOINT; // still its own
  auto points = MakePoints(Grid);
  AddValues<vtkUnsignedCharArray>(points->GetPointData(), ghosts, 1, last);
  std::vector<Place> most = Grid;
  most.pop_back();
  EXPECT_EQ(CellWriter(NewName("a.euler"), points).Bytes(), EulerText(most));
  auto image = MakeImage();
  AddValues<vtkUnsignedCharArray>(image->GetCellData(), ghosts, 1, last);
  EXPECT_EQ(CellWriter(NewName("a.euler"), image).Bytes(), EulerText(most));
}

TEST(EulerWriter, NoCells)
{
  vtkNew<vtkPolyData> nothing;
  EXPECT_EQ(CellWriter(NewName("a.euler"), nothing).Bytes(), EulerText({}));
  vtkNew<vtkImageData> none;
  EXPECT_EQ(CellWriter(NewName("a.euler"), none).Bytes(), EulerText({}));
  vtkNew<vtkPartitionedDataSet> no;
  EXPECT_EQ(CellWriter(NewName("a.euler"), no).Bytes(), EulerText({}));
}

TEST(EulerWriter, Wide)
{
  auto points = MakePoints({ { 1.0 / 3, 0, 0 } });
  AddValues(points->GetPointData(), "sigma", 3, { 1e-9, 2, 3 });
  AddValues(points->GetPointData(), "tau", 3, { 4, 5, 0.1 });
  CellWriter writer(NewName("a.euler"), points);
  const std::string text = writer.Bytes(); // Automatic: six decimals would lose something
  writer->SetDialect(vtkGranularEulerWriter::WIDE);
  EXPECT_EQ(writer.Bytes(), text);
  writer->SetDialect(vtkGranularEulerWriter::LIGGGHTS);
  EXPECT_EQ(writer.Bytes(), EulerText({ { 1.0 / 3, 0, 0 } }));
  for (const char* part : { "POINTS 1 double\n0.3333333333333333 ",
         "VECTORS sigma double\n1e-09 2 3\n", "VECTORS tau double\n4 5 0.1\n" })
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(EulerWriter, MissingArrays)
{
  for (const char* name : { "v_avg", "volumefraction", "radius", "pressure" })
  {
    auto points = MakePoints(Grid);
    points->GetPointData()->RemoveArray(name);
    CellWriter writer(WriteFile("a.euler", "old"), points);
    const std::string what =
      "column '" + std::string(name) + "': expected the array in the data of the ";
    writer.ExpectUnsupported(what + "points, got none");
    AddValues(points->GetCellData(), name, 1, {});
    writer.ExpectUnsupported(
      what + "points, got none: the filter CellCenters makes points of cells");
    auto image = MakeImage();
    image->GetCellData()->RemoveArray(name);
    writer->SetInputData(image);
    writer.ExpectUnsupported(what + "cells, got none");
    EXPECT_EQ(Content(writer->GetFileName()), "old");
    EXPECT_EQ(Beside(writer->GetFileName()), Lines{ "a.euler" });
  }
}

TEST(EulerWriter, OtherArrays)
{
  auto points = MakePoints(Grid);
  AddValues(points->GetPointData(), "v_avg", 1, std::vector<double>(24, 1));
  CellWriter writer(NewName("a.euler"), points);
  writer.ExpectUnsupported(
    "column 'v_avg': expected 3 components for each of 24 points, got 1 for 24");
  AddValues(points->GetPointData(), "v_avg", 3, { 1, 2, 3 });
  writer.ExpectUnsupported(
    "column 'v_avg': expected 3 components for each of 24 points, got 3 for 1");
}

TEST(EulerWriter, OtherData)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkTable>());
  CellWriter writer(WriteFile("a.euler", "old"), blocks);
  const std::string text =
    "expected points, a vtkImageData or a vtkRectilinearGrid of cells to write, got a vtkTable";
  writer.ExpectUnsupported(text);
  writer->SetInputData(vtkNew<vtkTable>());
  writer.ExpectUnsupported(text);
  EXPECT_EQ(Content(writer->GetFileName()), "old");
}

TEST(EulerWriter, Refused)
{
  CellWriter writer(NewName("a%.euler"), MakeImage());
  writer.ExpectUnsupported(
    "expected a name without '%': one file holds the cells of all processes");
  writer->SetDialect(3);
  EXPECT_EQ(writer.Said->Errors,
    Lines{ "expected Dialect 0 (LIGGGHTS) or 1 (Wide) or 2 (Automatic), got 3" });
  EXPECT_EQ(writer->GetDialect(), vtkGranularEulerWriter::AUTOMATIC);
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{});
}

/// What is below six decimals is told, of the file.
TEST(EulerWriter, Lost)
{
  auto points = MakePoints(Grid);
  AddValues(points->GetPointData(), "radius", 1, std::vector<double>(24, 1e-8));
  CellWriter writer(NewName("a.euler"), points);
  writer->SetDialect(vtkGranularEulerWriter::LIGGGHTS);
  writer.ExpectWritten();
  ASSERT_EQ(writer.Said->Warnings.size(), 1u);
  EXPECT_EQ(writer.Said->Warnings[0].rfind(writer->GetFileName(), 0), 0u)
    << writer.Said->Warnings[0];
  CellWriter wide(NewName("a.euler"), points);
  wide->SetDialect(vtkGranularEulerWriter::WIDE);
  wide.ExpectWritten();
  EXPECT_EQ(wide.Said->Warnings, Lines{});
}

TEST(EulerWriter, Aborted)
{
  CellWriter writer(
    WriteFile("a.euler", "old"), MakePoints(Centres({ 0, 0, 0 }, { 1, 1, 1 }, { 30, 30, 30 })));
  vtkNew<Stopper> stopper;
  const unsigned long tag = writer->AddObserver(vtkCommand::ProgressEvent, stopper);
  stopper->At = 3;
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_EQ(writer.Said->Errors, Lines{});
  EXPECT_EQ(Content(writer->GetFileName()), "old");
  EXPECT_EQ(Beside(writer->GetFileName()), Lines{ "a.euler" });
  writer->RemoveObserver(tag);
  writer.ExpectWritten();
}
