// SPDX-License-Identifier: BSD-3-Clause
// Runs in many files, files that grow, and what the user says about them, through VTK.
#include "reader_helpers.h"

#include "vtkCallbackCommand.h"

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

/// One particle at every step, whose x is the step.
std::string Particle(long step)
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
  for (const int wrong : { 7, -1 })
  {
    reader->SetRepeatedSteps(wrong);
    EXPECT_NE(reader.Said->Errors.back().find(
                "RepeatedSteps must be from 0 to 2, got " + std::to_string(wrong)),
      std::string::npos);
    EXPECT_EQ(reader->GetRepeatedSteps(), vtkGranularDumpReader::MERGE);
  }
}

// ---- files that grow ---------------------------------------------------------------------------

TEST(ReaderSeries, RefreshOnUpdateSeesWhatWasAppended)
{
  for (const bool refresh : { false, true })
  {
    const std::string file = WriteFile("a.dump", Particle(0));
    Reader reader({ file });
    reader->SetRefreshOnUpdate(refresh);
    EXPECT_EQ(reader->GetRefreshOnUpdate(), refresh);
    EXPECT_EQ(reader.Times(), std::vector<double>{ 0 });
    Append(file, Particle(10));
    // by information alone, as animations ask
    EXPECT_EQ(reader.Times().size(), refresh ? 2u : 1u);
    reader->UpdateTimeStep(10);
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], refresh ? 10 : 0);
    // by data
    Append(file, Particle(20));
    reader->UpdateTimeStep(20);
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], refresh ? 20 : 0);
    EXPECT_EQ(reader.Times().size(), refresh ? 3u : 1u);
    // by the other output
    Append(file, Particle(30));
    reader->GetOutputInformation(1)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 30.);
    reader->Update(1);
    EXPECT_EQ(
      reader.Box()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), refresh ? 30 : 0);
    EXPECT_TRUE(reader.Said->Errors.empty());
    EXPECT_TRUE(reader.Said->Warnings.empty());
  }
}

TEST(ReaderSeries, RefreshOnUpdateReadsNothingThatDidNotChange)
{
  const std::string file = WriteFile("a.dump", Particle(0) + Particle(10));
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
  Append(file, Particle(20).substr(0, 30));
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
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileNotFoundError));
  ExpectEmpty(reader);
  WriteFile("a.dump", Particle(0).substr(0, 40));
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 2u);
  EXPECT_EQ(reader.Said->Errors[1],
    file + ":1: expected a complete frame, got the end of the file in its header");
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileFormatError));
  ExpectEmpty(reader);
  Append(file, Particle(0).substr(40));
  reader->Update();
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1);
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.Said->Errors.size(), 2u);
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
  const std::string file = WriteFile("a.dump", Particle(0) + "garbage\n" + Particle(10));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  reader->Update();
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  for (long step = 20; step < 100; step += 10)
  {
    Append(file, Particle(step));
    reader->UpdateTimeStep(static_cast<double>(step));
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], static_cast<double>(step));
  }
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_TRUE(reader.Said->Errors.empty());
}

// ---- columns without names ---------------------------------------------------------------------

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
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::FileFormatError));
  ExpectEmpty(reader);
  ExpectGood(reader);

  Reader others({ Good("ortho_000000.dump.gz"), damaged, Good("ortho_000100.dump.gz") });
  EXPECT_EQ(others.Times(), (std::vector<double>{ 0, 100 }));
  ASSERT_EQ(others.Said->Warnings.size(), 1u);
  EXPECT_EQ(others.Said->Warnings[0].substr(0, damaged.size() + 1), damaged + "@");
  EXPECT_NE(others.Said->Warnings[0].find("; the file is left out"), std::string::npos);
  others->UpdateTimeStep(100);
  EXPECT_EQ(others.Particles()->GetNumberOfPoints(), 500);
  EXPECT_TRUE(others.Said->Errors.empty());
}
