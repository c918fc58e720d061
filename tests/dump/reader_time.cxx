// SPDX-License-Identifier: BSD-3-Clause
// Frames and times.
#include "reader_helpers.h"

#include <cmath>

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
  Executions executions(reader);
  for (double time : { 1500., 2000. })
  {
    executions.Count = 0;
    for (int round = 0; round < 2; ++round)
    {
      for (int port : { 0, 1 })
      {
        reader->GetOutputInformation(port)->Set(
          vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
        reader->Update(port);
      }
    }
    EXPECT_LE(
      executions.Count, 2); // once; twice where the pipeline cannot tell that 1500 shows 1000
    EXPECT_EQ(DataTime(reader.Box()), DataTime(reader.Particles()));
  }
  EXPECT_EQ(executions.Count, 1);
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
