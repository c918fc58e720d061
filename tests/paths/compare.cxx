// SPDX-License-Identifier: BSD-3-Clause
// The filter from C++: what particles and lines get, which frames are read, inputs that are none, pieces, stopping.
#include "vtkGranularCompare.h"

#include "../support/observer.h"
#include "../support/vtk_arrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
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
#include "vtkTrivialProducer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{
using Data = vtkSmartPointer<vtkPolyData>;

void AddBox(vtkFieldData* fields, double length)
{
  fields->AddArray(MakeArray("BoxOrigin", { 0, 0, 0 }, 3));
  fields->AddArray(MakeArray("BoxVectors", { length, 0, 0, 0, length, 0, 0, 0, length }, 9));
  vtkNew<vtkStringArray> flags;
  flags->SetName("Boundary");
  flags->InsertNextValue("pp pp pp");
  fields->AddArray(flags);
}

/// On the x axis, in a periodic box of length 16.
Data MakeParticles(const Values& ids, const Values& xs)
{
  auto particles = Data::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double x : xs)
  {
    points->InsertNextPoint(x, 1, 1);
  }
  particles->SetPoints(points);
  particles->GetPointData()->SetPedigreeIds(MakeArray<vtkTypeInt64Array>("id", ids));
  AddBox(particles->GetFieldData(), 16);
  return particles;
}

/// Lines from id to id, along the y axis at x = the first id.
Data MakeLines(const Values& id1, const Values& id2)
{
  auto lines = Data::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < id1.size(); ++i)
  {
    cells->InsertNextCell(2);
    cells->InsertCellPoint(points->InsertNextPoint(id1[i], 0, 0));
    cells->InsertCellPoint(points->InsertNextPoint(id1[i], id2[i], 0));
  }
  lines->SetPoints(points);
  lines->SetLines(cells);
  lines->GetCellData()->AddArray(MakeArray<vtkTypeInt64Array>("id1", id1));
  lines->GetCellData()->AddArray(MakeArray("id2", id2));
  return lines;
}

/// Shows frames at times 0, 1, 2 and so on, and keeps which of them it was asked for.
class Frames : public vtkPolyDataAlgorithm
{
public:
  static Frames* New();
  vtkTypeMacro(Frames, vtkPolyDataAlgorithm);

  std::vector<Data> All;
  bool HasTimes = true;
  int FailAt = -1;
  std::vector<int> Asked;

protected:
  Frames() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    Values times;
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      times.push_back(static_cast<double>(i));
    }
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
    if (this->HasTimes)
    {
      const double range[] = { times.front(), times.back() };
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(),
        static_cast<int>(times.size()));
    }
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
      ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
      : 0;
    const int frame = static_cast<int>(time);
    this->Asked.push_back(frame);
    vtkPolyData* output = vtkPolyData::GetData(outputs);
    output->ShallowCopy(this->All[static_cast<std::size_t>(frame)]);
    if (this->HasTimes)
    {
      output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), frame);
    }
    return frame == this->FailAt ? 0 : 1;
  }
};
vtkStandardNewMacro(Frames);

struct Filter : Watched<vtkGranularCompare>
{
  explicit Filter(std::vector<Data> particles, std::vector<Data> lines = {})
  {
    this->Get->SetController(nullptr);
    this->Particles->All = std::move(particles);
    this->Get->SetInputConnection(0, this->Particles->GetOutputPort());
    if (!lines.empty())
    {
      this->Lines->All = std::move(lines);
      this->Get->SetLinesConnection(this->Lines->GetOutputPort());
    }
  }

  Values Points(const char* name)
  {
    return ValuesOf(this->Get->GetOutput()->GetPointData()->GetArray(name));
  }
  Values Cells(const char* name)
  {
    return ValuesOf(this->Get->GetLinesOutput()->GetCellData()->GetArray(name));
  }

  /// That the update fails with this text and leaves nothing.
  void ExpectRefused(const std::string& text)
  {
    this->Get->Update();
    this->ExpectSaid(text);
    EXPECT_EQ(this->Get->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(this->Get->GetLinesOutput()->GetNumberOfCells(), 0);
    EXPECT_NE(this->Get->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  }

  vtkNew<Frames> Particles;
  vtkNew<Frames> Lines;
};

/// Particle 3 comes, 1 goes; of the bonds 1-2, 2-4 the first breaks and 4-3 forms.
std::vector<Data> TwoFrames()
{
  return { MakeParticles({ 1, 2, 4 }, { 1, 2, 15 }), MakeParticles({ 4, 3, 2 }, { 1, 8, 2.5 }) };
}

std::vector<Data> TwoFramesOfBonds()
{
  return { MakeLines({ 1, 2 }, { 2, 4 }), MakeLines({ 4, 4 }, { 2, 3 }) };
}

bool AreNone(const Values& values)
{
  return std::ranges::all_of(values, [](double value) { return std::isnan(value); });
}
}

TEST(Compare, WhatCameWentAndMoved)
{
  Filter filter(TwoFrames(), TwoFramesOfBonds());
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(filter.Points("id"), (Values{ 4, 3, 2, 1 }));
  EXPECT_EQ(filter.Points("change"), (Values{ 0, 1, 0, 2 }));
  EXPECT_EQ(
    ValuesOf(output->GetPoints()->GetData()), (Values{ 1, 1, 1, 8, 1, 1, 2.5, 1, 1, 1, 1, 1 }));
  const Values moved = filter.Points("displacement");
  EXPECT_EQ(Values(moved.begin(), moved.begin() + 3), (Values{ 2, 0, 0 })); // across the face
  EXPECT_EQ(Values(moved.begin() + 6, moved.begin() + 9), (Values{ 0.5, 0, 0 }));
  EXPECT_TRUE(AreNone(Values(moved.begin() + 3, moved.begin() + 6)));
  EXPECT_TRUE(AreNone(Values(moved.begin() + 9, moved.end())));
  EXPECT_EQ(filter.Points("fragment"), (Values{ 2, 2, 2, 0 }));
  EXPECT_EQ(filter.Points("fragment_size"), (Values{ 3, 3, 3, 0 }));
  EXPECT_FALSE(output->GetPointData()->HasArray("fragment_mass"));
  EXPECT_EQ(output->GetNumberOfVerts(), 4);
  EXPECT_STREQ(output->GetPointData()->GetPedigreeIds()->GetName(), "id");
  EXPECT_TRUE(output->GetFieldData()->HasArray("BoxVectors"));
  EXPECT_EQ(output->GetPointData()->GetArray("change")->GetDataType(), VTK_TYPE_INT32);
  EXPECT_EQ(output->GetPointData()->GetArray("fragment")->GetDataType(), VTK_TYPE_INT64);
  EXPECT_EQ(output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 1);

  EXPECT_EQ(filter.Cells("id1"), (Values{ 4, 4, 1 }));
  EXPECT_EQ(filter.Cells("id2"), (Values{ 2, 3, 2 }));
  EXPECT_EQ(filter.Cells("change"), (Values{ 0, 1, 2 }));
  EXPECT_EQ(ValuesOf(filter->GetLinesOutput()->GetPoints()->GetData()),
    (Values{ 4, 0, 0, 4, 2, 0, 4, 0, 0, 4, 3, 0, 1, 0, 0, 1, 2, 0 }));
  EXPECT_EQ(filter->GetLinesOutput()->GetNumberOfLines(), 3);
}

TEST(Compare, OneFrameIsComparedWithItself)
{
  for (const bool times : { true, false })
  {
    Filter filter({ TwoFrames()[0] }, { TwoFramesOfBonds()[0] });
    filter.Particles->HasTimes = times;
    filter.Lines->HasTimes = times;
    for (const int reference : { 0, 1, 2 })
    {
      filter->SetReference(reference);
      filter->Update();
      filter.ExpectSaid("");
      EXPECT_EQ(filter.Points("change"), (Values{ 0, 0, 0 }));
      EXPECT_EQ(filter.Points("displacement"), Values(9, 0));
      EXPECT_EQ(filter.Cells("change"), (Values{ 0, 0 }));
    }
    EXPECT_EQ(filter.Particles->Asked, std::vector{ 0 });
  }
}

TEST(Compare, FramesAreReadOnce)
{
  std::vector<Data> frames;
  for (int i = 0; i < 5; ++i)
  {
    frames.push_back(MakeParticles({ 1 }, { i / 2. }));
  }
  Filter filter(frames);
  const auto show = [&](int frame)
  {
    filter.Particles->Asked.clear();
    filter->UpdateTimeStep(frame);
    // who shares the input finds the shown frame there
    vtkPolyData* given = filter.Particles->GetOutput();
    EXPECT_EQ(given->GetPoint(0)[0], frame / 2.);
    EXPECT_EQ(given->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), frame);
    return filter.Particles->Asked;
  };
  const auto moved = [&] { return filter.Points("displacement")[0]; };
  EXPECT_EQ(show(3), (std::vector{ 3, 0, 3 }));
  EXPECT_EQ(moved(), 1.5);
  EXPECT_EQ(show(4), std::vector{ 4 });
  EXPECT_EQ(show(1), std::vector{ 1 });
  EXPECT_EQ(moved(), 0.5);
  EXPECT_EQ(show(0), std::vector{ 0 });
  EXPECT_EQ(show(2), std::vector{ 2 });

  filter->SetReference(vtkGranularCompare::TIME);
  filter->SetReferenceTime(1.75);
  EXPECT_EQ(show(3), (std::vector{ 3, 1, 3 }));
  EXPECT_EQ(moved(), 1);
  EXPECT_EQ(show(4), std::vector{ 4 });
  filter.Particles->Modified(); // there may be others now
  EXPECT_EQ(show(3), (std::vector{ 3, 1, 3 }));

  filter->SetReference(vtkGranularCompare::PREVIOUS);
  EXPECT_EQ(show(0), std::vector{ 0 });
  EXPECT_EQ(moved(), 0);
  for (const int frame : { 1, 2, 3, 4 })
  {
    EXPECT_EQ(show(frame), std::vector{ frame });
    EXPECT_EQ(moved(), 0.5);
  }
  EXPECT_EQ(show(2), (std::vector{ 2, 1, 2 }));
  EXPECT_EQ(show(1), (std::vector{ 1, 0, 1 }));
  EXPECT_EQ(moved(), 0.5);
}

/// Arrays of one frame only, of other types, of texts, and single-precision points.
TEST(Compare, LostParticlesHaveWhatBothFramesHave)
{
  std::vector<Data> frames = { MakeParticles({ 5, 6 }, { 1, 2 }), MakeParticles({ 5 }, { 1 }) };
  vtkPointData* before = frames[0]->GetPointData();
  vtkPointData* now = frames[1]->GetPointData();
  before->AddArray(MakeArray<vtkFloatArray>("same", { 10, 20 }));
  now->AddArray(MakeArray<vtkFloatArray>("same", { 11 }));
  before->AddArray(MakeArray("kind", { 10, 20 }));
  now->AddArray(MakeArray<vtkTypeInt32Array>("kind", { 3 }));
  before->AddArray(MakeArray("wide", { 1, 2, 3, 4 }, 2));
  now->AddArray(MakeArray("wide", { 1, 2, 3 }, 3));
  before->AddArray(MakeArray("gone", { 1, 2 }));
  now->AddArray(MakeArray("fresh", { 1 }));
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  names->InsertNextValue("glass");
  now->AddArray(names);
  Filter filter(frames);
  filter->SetDifferences("*, kind");
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Points("same"), (Values{ 11, 20 }));
  EXPECT_EQ(filter.Points("kind"), (Values{ 3, 0 }));
  EXPECT_EQ(filter.Points("wide").size(), 6U);
  EXPECT_TRUE(std::isnan(filter.Points("wide")[4]));
  EXPECT_TRUE(std::isnan(filter.Points("fresh")[1]));
  vtkPointData* data = filter->GetOutput()->GetPointData();
  EXPECT_FALSE(data->HasArray("gone"));
  auto* texts = vtkStringArray::SafeDownCast(data->GetAbstractArray("name"));
  ASSERT_TRUE(texts);
  EXPECT_EQ(texts->GetValue(0), "glass");
  EXPECT_EQ(texts->GetValue(1), "");
  EXPECT_EQ(filter.Points("same_difference")[0], 1);
  EXPECT_EQ(filter.Points("kind_difference")[0], -7);
  EXPECT_TRUE(std::isnan(filter.Points("kind_difference")[1]));
  EXPECT_FALSE(data->HasArray("wide_difference"));
  EXPECT_FALSE(data->HasArray("fresh_difference"));
}

TEST(Compare, MassesAreGivenOrOfSpheres)
{
  const auto make = []
  {
    Filter filter({ MakeParticles({ 1, 2, 3 }, { 1, 2, 3 }) }, { MakeLines({ 1 }, { 3 }) });
    return filter.Particles->All[0];
  };
  const Data given = make();
  given->GetPointData()->AddArray(MakeArray<vtkFloatArray>("mass", { 0.5, 7, 0.25 }));
  Filter one({ given }, { MakeLines({ 1 }, { 3 }) });
  one->Update();
  EXPECT_EQ(one.Points("fragment_mass"), (Values{ 0.75, 7, 0.75 }));
  const Data spheres = make();
  spheres->GetPointData()->AddArray(MakeArray("density", { 3, 3, 6 }));
  spheres->GetPointData()->AddArray(MakeArray("radius", { 1, 2, 1 }));
  Filter other({ spheres }, { MakeLines({ 1 }, { 3 }) });
  other->Update();
  EXPECT_NEAR(other.Points("fragment_mass")[0], 12 * vtkMath::Pi(), 1e-13);
  EXPECT_NEAR(other.Points("fragment_mass")[1], 32 * vtkMath::Pi(), 1e-13);
  one->SetMassArray("density");
  one->Update();
  EXPECT_FALSE(one->GetOutput()->GetPointData()->HasArray("fragment_mass"));
}

TEST(Compare, LinesAlone)
{
  Filter filter(TwoFramesOfBonds());
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  vtkCellData* cells = filter->GetOutput()->GetCellData();
  EXPECT_EQ(ValuesOf(cells->GetArray("id1")), (Values{ 4, 4, 1 }));
  EXPECT_EQ(ValuesOf(cells->GetArray("change")), (Values{ 0, 1, 2 }));
  EXPECT_EQ(filter->GetLinesOutput()->GetNumberOfCells(), 0);
  // none now: all are lost, and they still are lines
  filter.Particles->All[1] = Data::New();
  filter.Particles->Modified();
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  EXPECT_EQ(ValuesOf(filter->GetOutput()->GetCellData()->GetArray("change")), (Values{ 2, 2 }));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfLines(), 2);
}

/// Lines in several parts count once, and all parts are shown.
TEST(Compare, SplitLines)
{
  std::vector<Data> bonds = { MakeLines({ 1, 1, 2 }, { 2, 2, 4 }),
    MakeLines({ 2, 4, 4 }, { 4, 3, 3 }) };
  bonds[0]->GetCellData()->AddArray(MakeArray<vtkTypeInt32Array>("part", { 0, 1, 0 }));
  bonds[1]->GetCellData()->AddArray(MakeArray<vtkTypeInt32Array>("part", { 0, 0, 1 }));
  Filter filter(TwoFrames(), bonds);
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Cells("change"), (Values{ 0, 1, 1, 2, 2 }));
  EXPECT_EQ(filter.Cells("part"), (Values{ 0, 0, 1, 0, 1 }));
  EXPECT_EQ(filter.Points("fragment"), (Values{ 2, 2, 2, 0 }));
}

TEST(Compare, GhostsAreLeftOut)
{
  std::vector<Data> frames = { MakeParticles({ 1, 2, 9 }, { 1, 2, 3 }),
    MakeParticles({ 2, 2, 8 }, { 2, 5, 3 }) };
  frames[0]->GetPointData()->AddArray(MakeArray<vtkUnsignedCharArray>("vtkGhostType", { 0, 0, 1 }));
  frames[1]->GetPointData()->AddArray(MakeArray<vtkUnsignedCharArray>("vtkGhostType", { 0, 1, 0 }));
  Filter filter(frames);
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  EXPECT_EQ(filter.Points("id"), (Values{ 2, 8, 1 }));
  EXPECT_EQ(filter.Points("change"), (Values{ 0, 1, 2 }));
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("vtkGhostType"));
}

/// Who asks for pieces gets each particle and line once.
TEST(Compare, Pieces)
{
  Filter whole(TwoFrames(), TwoFramesOfBonds());
  whole->UpdateTimeStep(1);
  for (const int pieces : { 2, 3, 7 })
  {
    Values ids;
    Values fragments;
    Values changes;
    Values ends;
    for (int piece = 0; piece < pieces; ++piece)
    {
      Filter filter(TwoFrames(), TwoFramesOfBonds());
      filter->UpdateTimeStep(1, piece, pieces);
      const auto add = [](Values& all, const Values& some)
      { all.insert(all.end(), some.begin(), some.end()); };
      add(ids, filter.Points("id"));
      add(fragments, filter.Points("fragment"));
      vtkNew<vtkInformationVector> requests;
      requests->SetNumberOfInformationObjects(2);
      vtkInformation* request = requests->GetInformationObject(1);
      request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
      request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
      request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 1);
      filter->Update(1, requests);
      add(changes, filter.Cells("change"));
      add(ends, filter.Cells("id1"));
    }
    const auto sorted = [](Values values)
    {
      std::ranges::sort(values);
      return values;
    };
    EXPECT_EQ(sorted(ids), sorted(whole.Points("id"))) << pieces;
    EXPECT_EQ(sorted(fragments), sorted(whole.Points("fragment"))) << pieces;
    EXPECT_EQ(sorted(changes), sorted(whole.Cells("change"))) << pieces;
    EXPECT_EQ(sorted(ends), sorted(whole.Cells("id1"))) << pieces;
  }
}

TEST(Compare, InputsThatAreNone)
{
  Filter fraction({ MakeParticles({ 3 }, { 1 }) });
  fraction.Particles->All[0]->GetPointData()->AddArray(MakeArray("id", { 0.5 }));
  fraction.ExpectRefused("expected a 64-bit integer as id, got 0.5");
  Filter lines({ MakeLines({ 1 }, { 2 }) }, { MakeLines({ 1 }, { 2 }) });
  lines.ExpectRefused("expected particles with the point array 'id' as Input of Lines, got lines");
  Filter vertices({ MakeParticles({ 3 }, { 1 }) }, { MakeLines({ 3 }, { 3 }) });
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0 });
  vertices.Lines->All[0]->SetLines(nullptr);
  vertices.Lines->All[0]->SetVerts(cells);
  vertices.ExpectRefused("expected lines as cells, got a cell of the VTK type 1 in row 0");
  Filter time(TwoFrames());
  time->SetReference(vtkGranularCompare::TIME);
  time->SetReferenceTime(std::numeric_limits<double>::quiet_NaN());
  time.ExpectRefused("expected a finite ReferenceTime, got nan");
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(blocks);
  Filter composite(TwoFrames());
  composite->SetInputConnection(0, producer->GetOutputPort());
  composite->SetReference(vtkGranularCompare::FIRST);
  composite->Update();
  EXPECT_EQ(composite->GetOutput()->GetNumberOfPoints(), 0);
}

/// A reference frame that fails is an error, and the next update tries again.
TEST(Compare, AFrameThatFails)
{
  Filter filter(TwoFrames());
  filter.Particles->FailAt = 0;
  vtkNew<Observer> quiet;
  filter.Particles->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, quiet);
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("the input could not be made: see the messages before");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  filter.Particles->FailAt = -1;
  filter.Particles->Modified();
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 4);
}

TEST(Compare, WarningsAreToldOnce)
{
  std::vector<Data> frames = { MakeParticles({ 1, 2 }, { 1, 2 }), MakeParticles({ 1, 2 }, { 6, 2 }),
    MakeParticles({ 1, 2 }, { 7, 8 }), MakeParticles({ 1, 2 }, { 1, 2 }) };
  Filter filter(frames);
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("1 particles moved more than a quarter of a period of the box");
  filter->UpdateTimeStep(2);
  filter.ExpectSaid("");
  filter->UpdateTimeStep(3);
  filter.ExpectSaid("");
  filter->UpdateTimeStep(2); // came back
  filter.ExpectSaid("2 particles moved more than a quarter of a period of the box");
  for (const Data& frame : frames)
  {
    frame->GetFieldData()->RemoveArray("BoxOrigin");
  }
  filter.Particles->Modified();
  filter->UpdateTimeStep(1);
  filter.ExpectSaid("neither frame has a box");
  EXPECT_EQ(filter.Points("displacement")[0], 5);
}

TEST(Compare, StopsWhereverItIsAsked)
{
  Values ids(50000);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ids[i] = static_cast<double>(i);
  }
  const Values xs(ids.size(), 1);
  const std::vector<Data> frames = { MakeParticles(ids, xs), MakeParticles(ids, xs) };
  const std::vector<Data> bonds = { MakeLines({ 1 }, { 2 }), MakeLines({ 1 }, { 2 }) };
  Filter counted(frames, bonds);
  counted->SetThreads(1);
  counted->UpdateTimeStep(1);
  EXPECT_GT(counted.Seen->Reported.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(counted.Seen->Reported));
  EXPECT_EQ(counted.Seen->Reported.back(), 1);
  for (std::size_t at = 1; at + 1 < counted.Seen->Reported.size(); ++at)
  {
    Filter filter(frames, bonds);
    filter->SetThreads(1);
    filter.Seen->StopAt = at;
    filter->UpdateTimeStep(1);
    filter.ExpectSaid("");
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << at;
    filter->UpdateTimeStep(1);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 50000) << at;
  }
}
