// SPDX-License-Identifier: BSD-3-Clause
// Frames, times, files that grow, and pieces.
#include "reader_helpers.h"

#include "vtkCallbackCommand.h"

#include <cmath>
#include <functional>

namespace
{
double StepAt(Reader& reader, double time)
{
  reader->UpdateTimeStep(time);
  return reader.Field("timestep")->GetComponent(0, 0);
}

double DataTime(vtkDataObject* data)
{
  return data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
}
}

TEST(ReaderTime, IsTheTimestepByDefault)
{
  Reader reader({ Good("grains.dump") });
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1000, 2000 }));
  const double* range =
    reader->GetOutputInformation(1)->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  EXPECT_EQ(range[0], 0);
  EXPECT_EQ(range[1], 2000);
}

TEST(ReaderTime, IsTimestepTimesTimestepSize)
{
  Reader reader({ Good("grains.dump") });
  reader->SetTimestepSize(2e-5);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1000 * 2e-5, 2000 * 2e-5 }));
  EXPECT_EQ(StepAt(reader, 0.02), 1000);
  EXPECT_EQ(DataTime(reader.Particles()), 1000 * 2e-5);
  EXPECT_EQ(DataTime(reader.Box()), 1000 * 2e-5);
}

TEST(ReaderTime, TheTimeThatAPersonTypesIsThatOfTheFrame)
{
  Reader reader({ Good("grains.dump") });
  reader->SetTimestepSize(6e-5);
  EXPECT_EQ(StepAt(reader, std::nextafter(0.06, 0)), 1000);
  EXPECT_EQ(StepAt(reader, 0.06 - 1e-9), 0);
}

TEST(ReaderTime, IsThatOfTheFileWhereEveryFrameHasOne)
{
  Reader reader({ Good("ortho_unwrapped.dump") });
  reader->SetTimestepSize(17);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 0.5 }));
}

TEST(ReaderTime, ARequestShowsTheLastFrameAtOrBeforeIt)
{
  Reader reader({ Good("grains.dump") });
  EXPECT_EQ(StepAt(reader, -5), 0);
  EXPECT_EQ(StepAt(reader, 0), 0);
  EXPECT_EQ(StepAt(reader, 999.999), 0);
  EXPECT_EQ(StepAt(reader, 1000), 1000);
  EXPECT_EQ(StepAt(reader, 1999), 1000);
  EXPECT_EQ(DataTime(reader.Particles()), 1000);
  EXPECT_EQ(StepAt(reader, 1e9), 2000);
}

TEST(ReaderTime, BothOutputsOfATimeAreReadOnce)
{
  Reader reader({ Good("grains.dump") });
  reader->UpdateInformation();
  int executions = 0;
  const std::function<void()> count = [&executions] { ++executions; };
  vtkNew<vtkCallbackCommand> start;
  start->SetClientData(const_cast<std::function<void()>*>(&count));
  start->SetCallback([](vtkObject*, unsigned long, void* data, void*)
    { (*static_cast<std::function<void()>*>(data))(); });
  reader->AddObserver(vtkCommand::StartEvent, start);
  for (double time : { 1500., 2000. })
  {
    executions = 0;
    for (int round = 0; round < 2; ++round)
    {
      for (int port : { 0, 1 })
      {
        reader->GetOutputInformation(port)->Set(
          vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
        reader->Update(port);
      }
    }
    EXPECT_LE(executions, 2); // once; twice where the pipeline cannot tell that 1500 shows 1000
    EXPECT_EQ(DataTime(reader.Box()), DataTime(reader.Particles()));
  }
  EXPECT_EQ(executions, 1);
}

TEST(ReaderTime, TimestepSizeMustBeGreaterThanZero)
{
  Reader reader;
  for (double size : { 0., -1., std::nan("") })
  {
    reader->SetTimestepSize(size);
  }
  ASSERT_EQ(reader.Said->Errors.size(), 3u);
  EXPECT_EQ(reader.Said->Errors[1], "TimestepSize must be finite and greater than 0, got -1");
  EXPECT_EQ(reader->GetTimestepSize(), 1);
}

/// 3 x 1e-5 is 3e-5 by hand; the product of the doubles is 3.0000000000000004e-05.
TEST(ReaderTime, IsTheDoubleNearestToTheProductOfTheDecimals)
{
  const std::string file = WriteFile("clock.dump", Frame(3, 1, "id x y z", "1 0 0 0\n"));
  Reader reader({ file });
  reader->SetTimestepSize(1e-5);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 3e-5 }));
  reader->Update();
  EXPECT_EQ(DataTime(reader.Particles()), 3e-5);
}

TEST(ReaderTime, TimestepsThatNoDoubleTellsApartAreSaidAndAllAreShown)
{
  std::string text;
  std::vector<double> expected;
  for (const char* step : { "9007199254740992", "9007199254740993", "9007199254740994" })
  {
    std::string frame = Frame(0, 1, "id x y z", "1 0 0 " + std::to_string(expected.size()) + "\n");
    text += frame.replace(frame.find("TIMESTEP\n0") + 9, 1, step);
    expected.push_back(0x1p53 + 2 * static_cast<double>(expected.size()));
  }
  Reader reader({ WriteFile("large.dump", text) });
  EXPECT_EQ(reader.Times(), expected);
  ASSERT_EQ(reader.Said->Warnings.size(), 1u);
  EXPECT_NE(
    reader.Said->Warnings[0].find("got 9007199254740992 and 9007199254740993: 2 of 3 frames"),
    std::string::npos);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    reader->UpdateTimeStep(expected[i]);
    EXPECT_EQ(reader.Particles()->GetPoint(0)[2], static_cast<double>(i));
  }
  EXPECT_EQ(reader.Said->Warnings.size(), 1u);
}

TEST(ReaderTime, ASizeThatMakesTimesInfiniteIsAnError)
{
  Reader reader({ Good("grains.dump") });
  reader->SetTimestepSize(1e306);
  reader->Update();
  ASSERT_EQ(reader.Said->Errors.size(), 1u);
  EXPECT_NE(
    reader.Said->Errors[0].find("expected a TimestepSize that gives finite times, got 1e+306: "
                                "timestep 1000 is at infinity"),
    std::string::npos);
  reader->SetTimestepSize(1);
  reader->Update();
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1000, 2000 }));
}

TEST(ReaderFiles, OfOneFrameEachAreOneRunInTheOrderOfTheirSteps)
{
  Reader reader({ Good("grains_2000.dump"), Good("grains_0.dump"), Good("grains_1000.dump") });
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1000, 2000 }));
  EXPECT_EQ(StepAt(reader, 1000), 1000);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_EQ(StepAt(reader, 0), 0);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
}

TEST(ReaderFiles, AStepThatOccursAgainIsTakenWhereItStandsLast)
{
  const std::string first = WriteFile("restart_1.dump",
    Frame(0, 1, "id x y z", "1 0 0 0\n") + Frame(10, 1, "id x y z", "1 1 0 0\n") +
      Frame(20, 1, "id x y z", "1 2 0 0\n"));
  const std::string second = WriteFile("restart_2.dump",
    Frame(10, 1, "id x y z", "1 7 0 0\n") + Frame(20, 1, "id x y z", "1 8 0 0\n") +
      Frame(20, 1, "id x y z", "1 9 0 0\n"));
  Reader reader({ first, second });
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 10, 20 }));
  reader->UpdateTimeStep(10);
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], 7);
  reader->UpdateTimeStep(20);
  EXPECT_EQ(reader.Particles()->GetPoint(0)[0], 9);
}

TEST(ReaderFiles, AnIncompleteLastFrameAppearsWhenItIsComplete)
{
  const std::string whole = Frame(0, 1, "id x y z", "1 0 0 0\n");
  const std::string next = Frame(10, 2, "id x y z", "1 0 0 1\n2 0 0 2.5\n");
  const std::string file = WriteFile("growing.dump", whole + next.substr(0, next.size() - 2));
  Reader reader({ file });
  reader->Update();
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0 }));
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1);
  EXPECT_TRUE(reader.Said->Errors.empty());

  WriteFile("growing.dump", whole + next);
  reader->Update(); // nobody said that the files are to be looked at again
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0 }));
  reader->Refresh();
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 10 }));
  EXPECT_EQ(StepAt(reader, 10), 10);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 2);
  EXPECT_EQ(reader.Particles()->GetPoint(1)[2], 2.5);
}

TEST(ReaderFiles, AFileThatGrewIsStillReadBeforeARefresh)
{
  const std::string text = Frame(0, 1, "id x y z", "1 0 0 0\n");
  const std::string file = WriteFile("grown.dump", text);
  Reader reader({ file });
  reader->Update();
  WriteFile("grown.dump", text + Frame(10, 1, "id x y z", "1 0 0 1\n"));
  reader->SetVertices(vtkGranularDumpReader::NO_VERTICES);
  reader->Update();
  EXPECT_TRUE(reader.Said->Errors.empty());
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1);
}
