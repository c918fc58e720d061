// SPDX-License-Identifier: BSD-3-Clause
// The reader from C++: its outputs and their pieces, extents and partitions, what changes from frame to frame, errors,
// stopping, printing.
#include "vtkGranularEulerReader.h"

#include "../dump/writer_helpers.h"
#include "../support/observer.h"
#include "../support/vtk_arrays.h"
#include "made_files.h"

#include "vtkCellData.h"
#include "vtkDataArraySelection.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkPartitionedDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <map>

namespace
{
using Texts = std::vector<std::string>;
using Pipeline = vtkStreamingDemandDrivenPipeline;
constexpr int Cells = vtkGranularEulerReader::IMAGE_DATA;

const std::vector<Place> Grid = Centres({ -1, 0, 2 }, { 0.5, 0.25, 1 }, { 2, 3, 4 });
const std::vector<Place> OtherGrid = Centres({ 0, 0, 2 }, { 1, 0.25, 1 }, { 3, 3, 4 });

struct CellReader : Watched<vtkGranularEulerReader>
{
  explicit CellReader(const Texts& paths, int output = vtkGranularEulerReader::POINTS)
  {
    for (const std::string& path : paths)
    {
      this->Get->AddFileName(path.c_str());
    }
    this->Get->SetOutputType(output);
  }

  template <class Data>
  Data* As()
  {
    vtkDataObject* output = this->Get->GetOutputDataObject(0);
    EXPECT_STREQ(output ? output->GetClassName() : "nothing", vtkNew<Data>()->GetClassName());
    return Data::SafeDownCast(output);
  }
  vtkPolyData* Points() { return this->As<vtkPolyData>(); }
  vtkImageData* Image() { return this->As<vtkImageData>(); }
  vtkPartitionedDataSet* Blocks() { return this->As<vtkPartitionedDataSet>(); }

  void ExpectError(const std::string& text)
  {
    EXPECT_NE(this->Get->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    EXPECT_EQ(this->TakeSaid(), Texts{ text });
  }

  /// An error of a file, once.
  void ExpectErrorOf(const std::string& path)
  {
    EXPECT_NE(this->Get->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    const Texts texts = this->TakeSaid();
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_EQ(texts[0].rfind(path, 0), 0u) << texts[0];
  }

  void ExpectNothingSaid()
  {
    EXPECT_EQ(this->Seen->Said, Texts{});
    EXPECT_EQ(this->OfPipeline->Said, Texts{});
  }
};

std::string Write(const std::string& name, const std::vector<Place>& centres)
{
  return WriteFile(name, EulerText(centres));
}

std::vector<double> Numbers(vtkFieldData* data, const char* name)
{
  vtkDataArray* array = data->GetArray(name);
  EXPECT_TRUE(array) << name;
  return ValuesOf(array);
}

TEST(EulerReader, Points)
{
  CellReader reader({ Write("euler_500.vtk", Grid) });
  reader->Update();
  reader.ExpectNothingSaid();
  vtkPolyData* points = reader.Points();
  ASSERT_EQ(points->GetNumberOfPoints(), 24);
  EXPECT_EQ(points->GetNumberOfVerts(), 24);
  EXPECT_EQ(points->GetNumberOfCells(), 24);
  EXPECT_EQ(points->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < 24; ++i)
  {
    Place place;
    points->GetPoint(i, place.data());
    EXPECT_EQ(place, Grid[i]) << i;
  }
  EXPECT_EQ(points->GetPointData()->GetNumberOfArrays(), 4);
  vtkDataArray* velocities = points->GetPointData()->GetVectors();
  ASSERT_TRUE(velocities);
  EXPECT_STREQ(velocities->GetName(), "v_avg");
  EXPECT_EQ(velocities->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(velocities->GetComponent(7, 1), -7);
  EXPECT_STREQ(points->GetPointData()->GetScalars()->GetName(), "volumefraction");
  EXPECT_EQ(points->GetPointData()->GetArray("volumefraction")->GetComponent(23, 0), 0.23);
  EXPECT_EQ(points->GetPointData()->GetArray("radius")->GetComponent(3, 0), 0.25);
  EXPECT_EQ(points->GetPointData()->GetArray("pressure")->GetComponent(20, 0), 20000);
  vtkFieldData* fields = points->GetFieldData();
  EXPECT_EQ(
    Numbers(fields, "BoxBounds"), (std::vector<double>{ -0.75, -0.25, 0.125, 0.625, 2.5, 5.5 }));
  EXPECT_EQ(Numbers(fields, "timestep"), std::vector<double>{ 500 });
  EXPECT_EQ(points->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 500);
}

TEST(EulerReader, Image)
{
  CellReader reader({ Write("euler_500.vtk", Grid) }, Cells);
  reader->Update();
  reader.ExpectNothingSaid();
  vtkImageData* image = reader.Image();
  ASSERT_EQ(image->GetNumberOfCells(), 24);
  const std::array<int, 6> extent = { 0, 2, 0, 3, 0, 4 };
  EXPECT_TRUE(std::equal(extent.begin(), extent.end(), image->GetExtent()));
  EXPECT_EQ(image->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(image->GetCellData()->GetNumberOfArrays(), 4);
  const double expected[] = { -1, 0, 0, 0.75, 2, 6 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(image->GetBounds()[i], expected[i], 1e-12) << i;
    EXPECT_NEAR(Numbers(image->GetFieldData(), "BoxBounds")[i], expected[i], 1e-12) << i;
  }
  for (vtkIdType i = 0; i < 24; ++i)
  {
    double bounds[6];
    image->GetCellBounds(i, bounds);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR((bounds[2 * axis] + bounds[2 * axis + 1]) / 2, Grid[i][axis], 1e-12) << i;
    }
    EXPECT_EQ(image->GetCellData()->GetVectors()->GetComponent(i, 0), static_cast<double>(i));
    EXPECT_NEAR(
      image->GetCellData()->GetScalars()->GetComponent(i, 0), static_cast<double>(i) / 100, 1e-15);
  }
}

/// Pieces of points: each one once, in order, whatever their number.
TEST(EulerReader, PiecesOfPoints)
{
  const std::string path = Write("euler_500.vtk", Grid);
  for (const int pieces : { 1, 2, 5, 30 })
  {
    std::vector<double> pressures;
    CellReader reader({ path });
    for (int piece = 0; piece < pieces; ++piece)
    {
      reader->UpdatePiece(piece, pieces, 0);
      vtkPolyData* points = reader.Points();
      EXPECT_EQ(points->GetNumberOfVerts(), points->GetNumberOfPoints());
      EXPECT_EQ(points->GetPointData()->GetNumberOfArrays(), 4);
      for (const double value : Numbers(points->GetPointData(), "pressure"))
      {
        pressures.push_back(value / 1000);
      }
      EXPECT_EQ(Numbers(points->GetFieldData(), "timestep"), std::vector<double>{ 500 });
    }
    ASSERT_EQ(pressures.size(), 24u) << pieces;
    for (std::size_t i = 0; i < 24; ++i)
    {
      EXPECT_EQ(pressures[i], static_cast<double>(i)) << pieces;
    }
    reader.ExpectNothingSaid();
  }
}

/// The number of each cell is where it is in space, whichever part of the image is asked for.
void CheckPlaces(vtkImageData* image, std::map<int, int>& times)
{
  vtkUnsignedCharArray* ghosts = image->GetCellGhostArray();
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    const auto number =
      static_cast<std::size_t>(image->GetCellData()->GetVectors()->GetComponent(cell, 0));
    double bounds[6];
    image->GetCellBounds(cell, bounds);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR((bounds[2 * axis] + bounds[2 * axis + 1]) / 2, Grid[number][axis], 1e-12);
    }
    if (!ghosts || ghosts->GetValue(cell) == 0)
    {
      ++times[static_cast<int>(number)];
    }
  }
}

TEST(EulerReader, PiecesOfAnImage)
{
  const std::string path = Write("euler_500.vtk", Grid);
  for (const int ghostLayers : { 0, 1 })
  {
    for (const int pieces : { 1, 2, 3, 5, 30 })
    {
      CellReader reader({ path }, Cells);
      std::map<int, int> times;
      for (int piece = 0; piece < pieces; ++piece)
      {
        reader->UpdatePiece(piece, pieces, ghostLayers);
        CheckPlaces(reader.Image(), times);
      }
      EXPECT_EQ(times.size(), 24u) << pieces;
      for (const auto& [cell, count] : times)
      {
        EXPECT_EQ(count, 1) << pieces << " pieces, cell " << cell;
      }
      reader.ExpectNothingSaid();
    }
  }
}

TEST(EulerReader, PartOfAnImage)
{
  CellReader reader({ Write("euler_500.vtk", Grid) }, Cells);
  reader->UpdateInformation();
  vtkInformation* info = reader->GetOutputInformation(0);
  const std::array<int, 6> all = { 0, 2, 0, 3, 0, 4 };
  EXPECT_TRUE(std::equal(all.begin(), all.end(), info->Get(Pipeline::WHOLE_EXTENT())));
  const int part[] = { 1, 2, 0, 2, 3, 4 };
  reader->UpdateExtent(part);
  vtkImageData* image = reader.Image();
  ASSERT_EQ(image->GetNumberOfCells(), 2);
  EXPECT_EQ(Numbers(image->GetCellData(), "pressure"), (std::vector<double>{ 19000, 21000 }));
  std::map<int, int> times;
  CheckPlaces(image, times);
  reader.ExpectNothingSaid();
}

TEST(EulerReader, GridsOfProcesses)
{
  CellReader reader({ Write("euler_500.vtk", Grid + OtherGrid) }, Cells);
  reader->Update();
  reader.ExpectNothingSaid();
  vtkPartitionedDataSet* blocks = reader.Blocks();
  ASSERT_EQ(blocks->GetNumberOfPartitions(), 2u);
  EXPECT_EQ(Numbers(blocks->GetFieldData(), "timestep"), std::vector<double>{ 500 });
  auto* first = vtkImageData::SafeDownCast(blocks->GetPartition(0));
  auto* second = vtkImageData::SafeDownCast(blocks->GetPartition(1));
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->GetNumberOfCells(), 24);
  ASSERT_EQ(second->GetNumberOfCells(), 36);
  EXPECT_EQ(Numbers(second->GetCellData(), "radius").size(), 36u);
  EXPECT_EQ(Numbers(second->GetCellData(), "pressure")[3], 27000);
  EXPECT_NEAR(second->GetSpacing()[0], 1, 1e-12);
  EXPECT_NEAR(second->GetOrigin()[2], 2, 1e-12);

  // pieces hold each grid once
  std::array<int, 2> found = {};
  for (int piece = 0; piece < 5; ++piece)
  {
    reader->UpdatePiece(piece, 5, 0);
    ASSERT_EQ(reader.Blocks()->GetNumberOfPartitions(), 2u);
    for (unsigned int i = 0; i < 2; ++i)
    {
      found[i] += reader.Blocks()->GetPartition(i) ? 1 : 0;
    }
  }
  EXPECT_EQ(found, (std::array{ 1, 1 }));
  reader.ExpectNothingSaid();
}

/// Cells that are on no grid are points, and no image.
TEST(EulerReader, NoGrid)
{
  std::vector<Place> centres = Grid;
  centres[9] = { 77, 0, 0 };
  const std::string path = Write("euler_500.vtk", centres);
  CellReader reader({ path }, Cells);
  reader->Update();
  reader.ExpectErrorOf(path);
  EXPECT_EQ(reader.Image()->GetNumberOfCells(), 0);
  reader->SetOutputType(vtkGranularEulerReader::POINTS);
  reader->Update();
  EXPECT_EQ(reader.Points()->GetNumberOfPoints(), 24);
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
}

/// A frame without cells is empty, of the type of the others.
TEST(EulerReader, FramesWithoutCells)
{
  const Texts paths = { Write("euler_0.vtk", {}), Write("euler_10.vtk", Grid),
    Write("euler_20.vtk", {}) };
  for (const int output : { static_cast<int>(vtkGranularEulerReader::POINTS), Cells })
  {
    CellReader reader(paths, output);
    for (const double time : { 0.0, 10.0, 20.0, 0.0 })
    {
      reader->UpdateTimeStep(time);
      const int expected = time == 10 ? 24 : 0;
      auto* data = output == Cells ? static_cast<vtkDataSet*>(reader.Image()) : reader.Points();
      EXPECT_EQ(data->GetNumberOfCells(), expected) << time;
      EXPECT_EQ(Numbers(data->GetFieldData(), "timestep"), std::vector<double>{ time });
      EXPECT_EQ(data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), time);
    }
    reader.ExpectNothingSaid();
    CellReader none({ paths[0] }, output);
    none->Update();
    EXPECT_EQ((output == Cells ? static_cast<vtkDataSet*>(none.Image()) : none.Points())
                ->GetNumberOfCells(),
      0);
    none.ExpectNothingSaid();
  }
  CellReader blocks({ paths[0], Write("euler_30.vtk", Grid + OtherGrid) }, Cells);
  for (const double time : { 0.0, 30.0, 0.0 })
  {
    blocks->UpdateTimeStep(time);
    EXPECT_EQ(blocks.Blocks()->GetNumberOfPartitions(), time == 0 ? 0u : 2u);
  }
  blocks.ExpectNothingSaid();
}

/// A pipeline knows one image for all times; several grids may be others each time.
TEST(EulerReader, OtherGridLater)
{
  const std::string first = Write("euler_10.vtk", Grid);
  const std::string other = Write("euler_20.vtk", OtherGrid);
  const std::string two = Write("euler_30.vtk", Grid + OtherGrid);
  CellReader reader({ first, other, two }, Cells);
  reader->UpdateTimeStep(20);
  reader.ExpectError(other +
    ":1: expected a grid of 2 x 3 x 4 cells as at timestep 10, got 3 x 3 x 4: with the output "
    "Points all can be shown");
  EXPECT_EQ(reader.Image()->GetNumberOfCells(), 0);
  reader->UpdateTimeStep(30);
  reader.ExpectError(two +
    ":1: expected a grid of 2 x 3 x 4 cells as at timestep 10, got 2 grids: with the output "
    "Points all can be shown");
  reader->UpdateTimeStep(10);
  EXPECT_EQ(reader.Image()->GetNumberOfCells(), 24);
  EXPECT_EQ(reader.Seen->Said, Texts{});
  reader->SetOutputType(vtkGranularEulerReader::POINTS);
  reader->UpdateTimeStep(30);
  EXPECT_EQ(reader.Points()->GetNumberOfPoints(), 60);
  EXPECT_EQ(reader.Seen->Said, Texts{});

  CellReader blocks({ Write("b_10.vtk", Grid + OtherGrid), Write("b_20.vtk", OtherGrid) }, Cells);
  blocks->UpdateTimeStep(20);
  EXPECT_EQ(blocks.Blocks()->GetNumberOfPartitions(), 1u);
  blocks->UpdateTimeStep(10);
  EXPECT_EQ(blocks.Blocks()->GetNumberOfPartitions(), 2u);
  blocks.ExpectNothingSaid();
}

/// The files are others when they are read again, and so may be the type of the output.
TEST(EulerReader, Refresh)
{
  const std::string path = Write("euler_10.vtk", Grid);
  CellReader reader({ path }, Cells);
  reader->Update();
  EXPECT_EQ(reader.Image()->GetNumberOfCells(), 24);
  WriteFile("euler_10.vtk", EulerText(Grid + OtherGrid));
  reader->Refresh();
  reader->Update();
  EXPECT_EQ(reader.Blocks()->GetNumberOfPartitions(), 2u);
  reader->SetRefreshOnUpdate(true);
  WriteFile("euler_10.vtk", EulerText(OtherGrid));
  reader->Update();
  EXPECT_EQ(reader.Image()->GetNumberOfCells(), 36);
  reader.ExpectNothingSaid();
}

TEST(EulerReader, Selection)
{
  CellReader reader({ Write("euler_10.vtk", Grid) });
  vtkDataArraySelection* arrays = reader->GetPointDataArraySelection();
  reader->UpdateInformation();
  EXPECT_EQ(arrays->GetNumberOfArrays(), 4);
  arrays->DisableArray("radius");
  arrays->DisableArray("v_avg");
  for (const int output : { static_cast<int>(vtkGranularEulerReader::POINTS), Cells })
  {
    reader->SetOutputType(output);
    reader->Update();
    vtkDataSetAttributes* data = output == Cells
      ? static_cast<vtkDataSetAttributes*>(reader.Image()->GetCellData())
      : reader.Points()->GetPointData();
    EXPECT_EQ(data->GetNumberOfArrays(), 2);
    EXPECT_FALSE(data->HasArray("radius"));
    EXPECT_TRUE(data->HasArray("pressure"));
  }
  arrays->EnableArray("radius");
  reader->Update();
  EXPECT_TRUE(reader.Image()->GetCellData()->HasArray("radius"));
  reader->Refresh();
  reader->Update();
  EXPECT_EQ(arrays->ArrayIsEnabled("v_avg"), 0); // stays
  reader.ExpectNothingSaid();
}

TEST(EulerReader, Errors)
{
  CellReader nothing({});
  nothing->Update();
  nothing.ExpectError("no file to read: set FileNames first");
  for (const int output : { static_cast<int>(vtkGranularEulerReader::POINTS), Cells })
  {
    const std::string path = NewName("gone.vtk");
    CellReader gone({ path }, output);
    gone->Update();
    gone.ExpectErrorOf(path);
    EXPECT_EQ(gone->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileNotFoundError));
    Write("gone.vtk", Grid);
    gone->Refresh();
    gone->Update();
    EXPECT_EQ(gone->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    auto* data = output == Cells ? static_cast<vtkDataSet*>(gone.Image()) : gone.Points();
    EXPECT_EQ(data->GetNumberOfCells(), 24);

    std::string text = EulerText(Grid);
    text.replace(text.rfind("23000.0"), 7, "23000,0");
    const std::string bad = WriteFile("euler_1.vtk", text);
    CellReader word({ bad }, output);
    word->Update();
    word.ExpectErrorOf(bad + ":158: ");
    auto* empty = output == Cells ? static_cast<vtkDataSet*>(word.Image()) : word.Points();
    EXPECT_EQ(empty->GetNumberOfCells(), 0);
  }
}

/// Stopped at any of its reports the reader shows nothing, says nothing, and the next update is whole.
TEST(EulerReader, Stopped)
{
  const std::string path = Write("euler_10.vtk", Centres({ 0, 0, 0 }, { 1, 1, 1 }, { 20, 20, 20 }));
  for (const int output : { static_cast<int>(vtkGranularEulerReader::POINTS), Cells })
  {
    CellReader whole({ path }, output);
    whole->Update();
    const std::size_t reports = whole.Seen->Reported.size();
    EXPECT_GE(reports, 4u);
    for (std::size_t at = 1; at < reports; ++at)
    {
      CellReader reader({ path }, output);
      reader.Seen->StopAt = at;
      reader->Update();
      vtkDataObject* data = reader->GetOutputDataObject(0);
      EXPECT_EQ(data->GetNumberOfElements(vtkDataObject::CELL), 0) << at;
      EXPECT_EQ(reader.Seen->Said, Texts{});
      reader.Seen->StopAt = 0;
      reader->Update();
      data = reader->GetOutputDataObject(0);
      EXPECT_EQ(data->GetNumberOfElements(vtkDataObject::CELL), 8000) << at;
      EXPECT_EQ(reader.Seen->Said, Texts{});
    }
  }
}

TEST(EulerReader, CanReadFile)
{
  const auto can = [](const std::string& path)
  { return vtkGranularEulerReader::CanReadFile(path.c_str()); };
  EXPECT_EQ(can(Write("any.name", Grid)), 1);
  EXPECT_EQ(can(Good("euler_1000.vtk")), 1);
  EXPECT_EQ(can(Good("decomposition_1000.vtk")), 0);
  EXPECT_EQ(can(Good("grains.dump")), 0);
  EXPECT_EQ(can("/nonexistent"), 0);
  EXPECT_EQ(vtkGranularEulerReader::CanReadFile(nullptr), 0);
}

/// Of several files of a timestep the last counts, unless they are said to be pieces.
TEST(EulerReader, FilesOfOneStep)
{
  const std::string first = Write("run_0_10.vtk", Grid);
  CellReader reader({ first, Write("run_0_20.vtk", Grid), Write("run_1_10.vtk", OtherGrid),
                      Write("run_1_20.vtk", OtherGrid) },
    Cells);
  reader->UpdateTimeStep(10);
  EXPECT_EQ(reader.Image()->GetNumberOfCells(), 36);
  const Texts said = reader.TakeSaid(); // that there are files that nobody sees
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].rfind(first + ": no frame of this file", 0), 0u) << said[0];
  reader->SetRepeatedSteps(vtkGranularEulerReader::MERGE);
  reader->UpdateTimeStep(10);
  vtkPartitionedDataSet* blocks = reader.Blocks();
  ASSERT_EQ(blocks->GetNumberOfPartitions(), 2u);
  auto* second = vtkImageData::SafeDownCast(blocks->GetPartition(1));
  EXPECT_EQ(Numbers(second->GetCellData(), "pressure")[3], 3000); // counted in its file
  reader->SetOutputType(vtkGranularEulerReader::POINTS);
  reader->UpdateTimeStep(10);
  EXPECT_EQ(reader.Points()->GetNumberOfPoints(), 60);
  EXPECT_EQ(Numbers(reader.Points()->GetPointData(), "pressure")[24], 0);
  reader.ExpectNothingSaid();
}

/// A file without cells has no arrays, and takes none from others; arrays that not all have are named.
TEST(EulerReader, FilesOfOneStepWithOtherArrays)
{
  const std::vector<Place> none;
  CellReader reader({ Write("part_0_10.vtk", none), Write("part_0_20.vtk", none),
                      Write("part_1_10.vtk", OtherGrid), Write("part_1_20.vtk", OtherGrid) },
    vtkGranularEulerReader::POINTS);
  reader->SetRepeatedSteps(vtkGranularEulerReader::MERGE);
  reader->UpdateTimeStep(10);
  EXPECT_EQ(reader.Points()->GetNumberOfPoints(), 36);
  EXPECT_EQ(reader.Points()->GetPointData()->GetNumberOfArrays(), 4);
  reader.ExpectNothingSaid();
}
}
