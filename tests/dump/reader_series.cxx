// SPDX-License-Identifier: BSD-3-Clause
// Runs in many files, files that grow, and what the user says about them, through VTK.
#include "reader_helpers.h"

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
  Reader first({ Good("pieces_1000.2.dump") });
  first->Update();
  EXPECT_EQ(reader.Numbers("id")->GetComponent(0, 0), first.Numbers("id")->GetComponent(0, 0))
    << "in the order of the files";
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

TEST(ReaderSeries, RefreshOnUpdateSaysNothingTwice)
{
  const std::string file = WriteFile("a.dump", Particle(0) + "garbage\n" + Particle(10));
  Reader reader({ file });
  reader->SetRefreshOnUpdate(true);
  for (const long step : { 20, 30, 40 })
  {
    Append(file, Particle(step));
    reader->UpdateTimeStep(static_cast<double>(step));
    EXPECT_EQ(reader.Particles()->GetPoint(0)[0], static_cast<double>(step));
  }
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
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
