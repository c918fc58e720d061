// SPDX-License-Identifier: BSD-3-Clause
// Progress, and what happens when somebody asks to stop.
#include "reader_helpers.h"

#include "vtkErrorCode.h"

#include <algorithm>

namespace
{
/// A dump large enough for several reports.
std::string LargeFile()
{
  static const std::string file = []
  {
    std::string rows;
    for (int i = 1; i <= 200000; ++i)
    {
      rows += std::to_string(i) + " 0.123456789012345 0.123456789012345 0.123456789012345\n";
    }
    return WriteFile("large.dump", Frame(5, 200000, "id x y z", rows));
  }();
  return file;
}

void ExpectAborted(Reader& reader)
{
  EXPECT_TRUE(reader.Said->Errors.empty());
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 1);
  ExpectEmpty(reader);
}

void ExpectWhole(Reader& reader)
{
  EXPECT_TRUE(reader.Said->Errors.empty());
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 200000);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
  EXPECT_EQ(reader->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 0);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 5 }));
}
}

TEST(ReaderAbort, ProgressIsReportedAndNeverGoesBack)
{
  Reader reader({ LargeFile() });
  reader->UpdateInformation();
  vtkNew<Stopper> progress;
  reader->AddObserver(vtkCommand::ProgressEvent, progress);
  reader->Update();
  EXPECT_GE(progress->Reported.size(), 4u);
  EXPECT_TRUE(std::is_sorted(progress->Reported.begin(), progress->Reported.end()));
  EXPECT_EQ(progress->Reported.front(), 0);
  EXPECT_EQ(progress->Reported.back(), 1);
  ExpectWhole(reader);
}

TEST(ReaderAbort, AtAnyReportLeavesNothingAndTheNextUpdateGivesAll)
{
  // the last report comes from the pipeline when all is done, too late for anything
  Reader counted({ LargeFile() });
  counted->SetThreads(1); // several share the reports as they come
  vtkNew<Stopper> counter;
  counted->AddObserver(vtkCommand::ProgressEvent, counter);
  counted->Update();
  const int reports = static_cast<int>(counter->Reported.size());
  ASSERT_GE(reports, 5);
  for (int at = 1; at < reports; ++at)
  {
    Reader reader({ LargeFile() });
    reader->SetThreads(1);
    vtkNew<Stopper> stopper;
    stopper->At = at;
    reader->AddObserver(vtkCommand::ProgressEvent, stopper);
    reader->Update();
    ExpectAborted(reader);
    reader->Update();
    ExpectWhole(reader);
  }
}

TEST(ReaderAbort, ByAnObserverThatNeverStopsAsking)
{
  Reader reader({ LargeFile() });
  vtkNew<Stopper> stopper;
  stopper->At = Stopper::Every;
  reader->AddObserver(vtkCommand::ProgressEvent, stopper);
  reader->Update();
  ExpectAborted(reader);
  reader->Update();
  ExpectAborted(reader);
  stopper->At = Stopper::Never;
  reader->Update();
  ExpectWhole(reader);
}

TEST(ReaderAbort, OfASecondFrameAndOfARefresh)
{
  Reader reader({ Good("grains.dump") });
  reader->UpdateTimeStep(1000);
  ASSERT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  vtkNew<Stopper> stopper;
  stopper->At = 1;
  reader->AddObserver(vtkCommand::ProgressEvent, stopper);
  reader->UpdateTimeStep(2000);
  ExpectAborted(reader);
  reader->UpdateTimeStep(2000);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  stopper->Reported.clear();
  reader->Refresh();
  reader->UpdateTimeStep(2000);
  ExpectAborted(reader);
  reader->UpdateTimeStep(2000);
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
}
