// SPDX-License-Identifier: BSD-3-Clause
// Runs in many files, files that grow, and what the user says about them, through VTK.
#include "reader_helpers.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"

#include <iterator>

namespace
{
namespace fs = std::filesystem;

std::vector<std::string> Pieces(const std::vector<std::string>& steps)
{
  std::vector<std::string> files;
  for (const std::string& step : steps)
  {
    for (const char* process : { "2", "0", "3", "1" })
    {
      files.push_back(Good("pieces_" + step + "." + process + ".dump"));
    }
  }
  return files;
}

/// One grain at every step, whose x is the step.
std::string Grain(long step)
{
  return Frame(step, 1, "id x y z", "1 " + std::to_string(step) + " 0 0\n");
}

void Append(const std::string& file, const std::string& text)
{
  std::ofstream(file, std::ios::binary | std::ios::app) << text;
}

std::string ReadAll(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), {} };
}

void ExpectNothing(Reader& reader, unsigned long code)
{
  EXPECT_EQ(reader->GetErrorCode(), code);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reader.Particles()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 0);
}

void ExpectGrainsAgain(Reader& reader)
{
  reader.Open(Good("grains_1000.dump"));
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
}

/// A filter behind the reader, as there is in every pipeline.
class Pass : public vtkPolyDataAlgorithm
{
public:
  static Pass* New();
  vtkTypeMacro(Pass, vtkPolyDataAlgorithm);

protected:
  int RequestData(vtkInformation*, vtkInformationVector** in, vtkInformationVector* out) override
  {
    vtkPolyData::GetData(out)->ShallowCopy(vtkPolyData::GetData(in[0]));
    return 1;
  }
};
vtkStandardNewMacro(Pass);

/// Counts how often a reader reads.
class Executions
{
public:
  explicit Executions(Reader& reader)
  {
    vtkNew<vtkCallbackCommand> start;
    start->SetClientData(&this->Count);
    start->SetCallback(
      [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
    reader->AddObserver(vtkCommand::StartEvent, start);
  }

  int Count = 0;
};
}

// ---- pieces ------------------------------------------------------------------------------------

TEST(ReaderSeries, PiecesAreOneFrame)
{
  Reader reader(Pieces({ "2000", "1000", "0" }));
  reader->SetSortById(true);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1000, 2000 }));
  for (const double time : { 2000., 0., 1000. })
  {
    reader->UpdateTimeStep(time);
    ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), time > 0 ? 1200 : 0);
    EXPECT_EQ(reader.Particles()->GetNumberOfVerts(), time > 0 ? 1200 : 0);
    EXPECT_EQ(reader.Field("timestep")->GetComponent(0, 0), time);
    EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
  }
  vtkDataArray* ids = reader.Numbers("id");
  ASSERT_NE(ids, nullptr);
  for (vtkIdType i = 0; i < 1200; ++i)
  {
    ASSERT_EQ(ids->GetComponent(i, 0), static_cast<double>(i + 1));
  }
  // every row of every file is there
  for (int process = 0; process < 4; ++process)
  {
    const PlainFrame plain =
      ReadPlain(Good("pieces_1000." + std::to_string(process) + ".dump")).at(0);
    for (std::size_t row = 0; row < plain.rows; ++row)
    {
      const auto point = static_cast<vtkIdType>(plain.Number("id", row)) - 1;
      ASSERT_EQ(reader.Particles()->GetPoint(point)[2], plain.Number("z", row));
      ASSERT_EQ(reader.Numbers("radius")->GetComponent(point, 0), plain.Number("radius", row));
    }
  }
  EXPECT_TRUE(reader.Said->Errors.empty());
  EXPECT_TRUE(reader.Said->Warnings.empty());
}

TEST(ReaderSeries, RepeatedStepsSaysWhetherTheyAre)
{
  Reader reader(Pieces({ "1000" }));
  EXPECT_EQ(reader->GetRepeatedSteps(), vtkGranularDumpReader::AUTO);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  reader->SetRepeatedSteps(vtkGranularDumpReader::LAST);
  reader->Update();
  EXPECT_EQ(
    reader.Particles()->GetNumberOfPoints(), 293); // the last one given is that of process 1
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(reader.Said->Warnings[0].find("set RepeatedSteps to Merge"), std::string::npos);
  reader->SetRepeatedSteps(vtkGranularDumpReader::MERGE);
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_EQ(reader.Numbers("id")->GetComponent(0, 0),
    ReadPlain(Good("pieces_1000.2.dump"))[0].Number("id", 0)); // in the order of the files
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  // beyond the ends
  reader->SetRepeatedSteps(7);
  EXPECT_EQ(reader->GetRepeatedSteps(), vtkGranularDumpReader::LAST);
  reader->SetRepeatedSteps(-1);
  EXPECT_EQ(reader->GetRepeatedSteps(), vtkGranularDumpReader::AUTO);
}

TEST(ReaderSeries, AMissingPieceIsSaidOnce)
{
  std::vector<std::string> files = Pieces({ "0", "1000", "2000" });
  files.erase(files.begin() + 4);
  Reader reader(files);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 2000 }));
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_EQ(reader.Said->Warnings[0],
    Good("pieces_1000.0.dump") +
      ":1: expected 4 pieces of timestep 1000, got 3 (none for 2); the frame is left out");
  for (int round = 0; round < 3; ++round)
  {
    reader->Refresh();
    reader->Update();
  }
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_TRUE(reader.Said->Errors.empty());
}

// ---- files that grow ---------------------------------------------------------------------------

TEST(ReaderSeries, RefreshOnUpdateSeesWhatWasAppended)
{
  for (const bool refresh : { false, true })
  {
    const std::string file = WriteFile("a.dump", Grain(0));
    Reader reader({ file });
    reader->SetRefreshOnUpdate(refresh);
    EXPECT_EQ(reader->GetRefreshOnUpdate(), refresh);
    EXPECT_EQ(reader.Times(), std::vector<double>{ 0 });
    Append(file, Grain(10));
    // by information alone, as animations ask
    EXPECT_EQ(reader.Times().size(), refresh ? 2u : 1u);
    reader->UpdateTimeStep(10);
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], refresh ? 10 : 0);
    // by data
    Append(file, Grain(20));
    reader->UpdateTimeStep(20);
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], refresh ? 20 : 0);
    EXPECT_EQ(reader.Times().size(), refresh ? 3u : 1u);
    // by the other output
    Append(file, Grain(30));
    reader->GetOutputInformation(1)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 30.);
    reader->Update(1);
    EXPECT_EQ(
      reader.Box()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), refresh ? 30 : 0);
    EXPECT_TRUE(reader.Said->Errors.empty());
    EXPECT_TRUE(reader.Said->Warnings.empty());
  }
}

TEST(ReaderSeries, RefreshOnUpdateOfAFilterBehindIt)
{
  const std::string file = WriteFile("a.dump", Grain(0));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  vtkNew<Pass> first;
  vtkNew<Pass> second;
  first->SetInputConnection(reader->GetOutputPort());
  second->SetInputConnection(first->GetOutputPort());
  second->Update();
  for (const long step : { 10L, 20L, 30L })
  {
    Append(file, Grain(step));
    second->UpdateTimeStep(static_cast<double>(step));
    ASSERT_EQ(second->GetOutput()->GetNumberOfPoints(), 1);
    EXPECT_EQ(second->GetOutput()->GetPoint(0)[0], static_cast<double>(step));
    EXPECT_EQ(
      second->GetOutputInformation(0)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()),
      static_cast<int>(step) / 10 + 1);
  }
}

TEST(ReaderSeries, RefreshOnUpdateReadsNothingThatDidNotChange)
{
  const std::string file = WriteFile("a.dump", Grain(0) + Grain(10));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  const Executions executions(reader);
  reader->UpdateTimeStep(0);
  EXPECT_EQ(executions.Count, 1);
  const vtkMTimeType time = reader->GetMTime();
  for (int round = 0; round < 10; ++round)
  {
    reader->UpdateTimeStep(0);
    reader->UpdateInformation();
  }
  EXPECT_EQ(executions.Count, 1);
  EXPECT_EQ(reader->GetMTime(), time);
  // a part of a frame changes no frame, but the file was looked at
  Append(file, Grain(20).substr(0, 30));
  reader->UpdateTimeStep(0);
  const int after = executions.Count;
  for (int round = 0; round < 10; ++round)
  {
    reader->UpdateTimeStep(0);
  }
  EXPECT_EQ(executions.Count, after);
  EXPECT_EQ(reader.Times().size(), 2u);
}

TEST(ReaderSeries, RefreshOnUpdateBeforeThereIsAnything)
{
  // the simulation has not begun to write
  const std::string file = WriteFile("a.dump", "");
  fs::remove(file);
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  ExpectNothing(reader, vtkErrorCode::FileNotFoundError);
  WriteFile("a.dump", Grain(0).substr(0, 40));
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 2u);
  EXPECT_EQ(reader.Said->Errors[1],
    file + ":1: expected a complete frame, got the end of the file in its header");
  ExpectNothing(reader, vtkErrorCode::FileFormatError);
  Append(file, Grain(0).substr(40));
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1);
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.Said->Errors.size(), 2u);
}

TEST(ReaderSeries, RefreshOnUpdateOfAFileThatIsReplacedOrRemoved)
{
  const std::string file = WriteFile("a.dump", Grain(0) + Grain(10) + Grain(20));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 10, 20 }));
  WriteFile("a.dump", Grain(5));
  EXPECT_EQ(reader.Times(), std::vector<double>{ 5 });
  reader->UpdateTimeStep(20);
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], 5);
  fs::remove(file);
  reader->Update();
  ExpectNothing(reader, vtkErrorCode::FileNotFoundError);
  WriteFile("a.dump", Grain(7) + Grain(8));
  reader->UpdateTimeStep(8);
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], 8);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 7, 8 }));
  EXPECT_EQ(reader.Said->Errors.size(), 1u);
}

TEST(ReaderSeries, WhatWasChosenStaysWhenFramesAreAdded)
{
  const std::string file =
    WriteFile("a.dump", Frame(0, 1, "id x y z vx vy vz q", "1 0 0 0 1 2 3 4\n"));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  reader->Update();
  reader->GetPointDataArraySelection()->DisableArray("v");
  Append(file, Frame(10, 1, "id x y z vx vy vz q fx fy fz", "1 0 0 0 1 2 3 4 5 6 7\n"));
  reader->UpdateTimeStep(10);
  EXPECT_EQ(reader.Array("v"), nullptr);
  EXPECT_NE(reader.Array("q"), nullptr);
  EXPECT_NE(reader.Array("f"), nullptr) << "new arrays are on";
}

TEST(ReaderSeries, AGrowingFileSaysNothingTwice)
{
  const std::string file = WriteFile("a.dump", Grain(0) + "garbage\n" + Grain(10));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  reader->Update();
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  for (long step = 20; step < 100; step += 10)
  {
    Append(file, Grain(step));
    reader->UpdateTimeStep(static_cast<double>(step));
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], static_cast<double>(step));
  }
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_TRUE(reader.Said->Errors.empty());
}

// ---- columns without names ---------------------------------------------------------------------

TEST(ReaderSeries, ColumnNamesAreForFilesThatHaveNone)
{
  Reader reader({ Good("grains.bin") });
  EXPECT_STREQ(reader->GetColumnNames(), "");
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_NE(reader.Said->Errors[0].find("expected 12 names in ColumnNames"), std::string::npos)
    << reader.Said->Errors[0];
  ExpectNothing(reader, vtkErrorCode::FileFormatError);

  reader->SetColumnNames("id type x y z ix iy iz vx vy vz radius");
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1000, 2000 }));
  reader->SetSortById(true);
  reader->UpdateTimeStep(1000);
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  for (const char* name : { "id", "type", "image", "v", "radius" })
  {
    EXPECT_NE(reader.Array(name), nullptr) << name;
  }
  const double radius = reader.Numbers("radius")->GetComponent(0, 0);
  EXPECT_TRUE(radius == 0.0025 || radius == 0.0035) << radius;
  EXPECT_EQ(reader.Text("Columns", 11), "radius");

  // another word for the same numbers, and what was chosen stays
  reader->GetPointDataArraySelection()->DisableArray("v");
  reader->SetColumnNames("id type x y z ix iy iz vx vy vz size");
  reader->UpdateTimeStep(1000);
  EXPECT_EQ(reader.Array("radius"), nullptr);
  ASSERT_NE(reader.Array("size"), nullptr);
  EXPECT_EQ(reader.Numbers("size")->GetComponent(0, 0), radius);
  EXPECT_EQ(reader.Array("v"), nullptr);
  EXPECT_EQ(reader.Said->Errors.size(), 1u);

  // too few of them
  reader->SetColumnNames("id x y z");
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 2u);
  EXPECT_NE(
    reader.Said->Errors[1].find("expected 12 names in ColumnNames, got 4"), std::string::npos)
    << reader.Said->Errors[1];
  ExpectNothing(reader, vtkErrorCode::FileFormatError);
  reader->SetColumnNames(nullptr);
  EXPECT_STREQ(reader->GetColumnNames(), "");
  ExpectGrainsAgain(reader);
}

TEST(ReaderSeries, ColumnNamesAreNotForFilesThatHaveThem)
{
  for (const char* name : { "grains_1000.dump", "ortho_custom.bin", "ortho_000050.dump.gz" })
  {
    Reader plain({ Good(name) });
    plain->Update();
    Reader reader({ Good(name) });
    reader->SetColumnNames("these are not used");
    reader->Update();
    EXPECT_TRUE(reader.Said->Errors.empty());
    EXPECT_TRUE(reader.Said->Warnings.empty());
    EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(),
      plain.Particles()->GetPointData()->GetNumberOfArrays());
    EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), plain.Particles()->GetNumberOfPoints());
    EXPECT_GT(reader.Particles()->GetNumberOfPoints(), 0);
  }
}

// ---- compressed files --------------------------------------------------------------------------

TEST(ReaderSeries, CompressedFilesOfARun)
{
  for (const std::string& box : { std::string("ortho"), std::string("tri") })
  {
    Reader reader({ Good(box + "_000100.dump.gz"), Good(box + "_000000.dump.gz"),
      Good(box + "_000050.dump.gz") });
    EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 50, 100 }));
    Reader plain({ Good(box + "_scaled.dump") });
    for (const double time : { 100., 0. })
    {
      reader->UpdateTimeStep(time);
      plain->UpdateTimeStep(time);
      ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 500);
      for (vtkIdType i = 0; i < 500; i += 100)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          EXPECT_NEAR(
            reader.Particles()->GetPoint(i)[axis], plain.Particles()->GetPoint(i)[axis], 1e-4);
        }
      }
    }
    EXPECT_TRUE(reader.Said->Warnings.empty());
    EXPECT_TRUE(reader.Said->Errors.empty());
  }
}

TEST(ReaderSeries, ADamagedFileIsAnErrorAndAmongOthersAWarning)
{
  std::string bytes = ReadAll(Good("ortho_000050.dump.gz"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  bytes[bytes.size() / 2 + 1] = static_cast<char>(bytes[bytes.size() / 2 + 1] ^ 0x55);
  const std::string damaged = WriteFile("ortho_000050.dump.gz", bytes);
  Reader reader({ damaged });
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_EQ(reader.Said->Errors[0].substr(0, damaged.size() + 1), damaged + "@");
  ExpectNothing(reader, vtkErrorCode::FileFormatError);
  ExpectGrainsAgain(reader);

  Reader others({ Good("ortho_000000.dump.gz"), damaged, Good("ortho_000100.dump.gz") });
  EXPECT_EQ(others.Times(), (std::vector<double>{ 0, 100 }));
  ASSERT_EQ(others.Said->Warnings.size(), 1u);
  EXPECT_EQ(others.Said->Warnings[0].substr(0, damaged.size() + 1), damaged + "@");
  EXPECT_NE(others.Said->Warnings[0].find("; the file is left out"), std::string::npos);
  others->UpdateTimeStep(100);
  EXPECT_EQ(others.Particles()->GetNumberOfPoints(), 500);
  EXPECT_TRUE(others.Said->Errors.empty());
}

TEST(ReaderSeries, AFileThatIsCutIsReadAsFarAsItGoes)
{
  const std::string bytes = ReadAll(Good("ortho_000050.dump.gz"));
  const std::string cut = WriteFile("ortho_000050.dump.gz", bytes.substr(0, bytes.size() - 100));
  Reader reader({ Good("ortho_000000.dump.gz"), cut, Good("ortho_000100.dump.gz") });
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 100 }));
  EXPECT_TRUE(reader.Said->Errors.empty());
  // and when the rest has come
  reader->SetRefreshOnUpdate(true);
  Append(cut, bytes.substr(bytes.size() - 100));
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 50, 100 }));
}

TEST(ReaderSeries, OtherFramesBehindTheSameStampAreNotShown)
{
  const std::string file = WriteFile("exchanged.dump", Grain(100) + Grain(200));
  const auto time = fs::last_write_time(file);
  Reader reader({ file });
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 100, 200 }));
  WriteFile("exchanged.dump", Grain(300) + Grain(400));
  fs::last_write_time(file, time);
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_NE(reader.Said->Errors[0].find("changed since it was indexed"), std::string::npos)
    << reader.Said->Errors[0];
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
}
