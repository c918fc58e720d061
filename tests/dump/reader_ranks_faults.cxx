// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: what goes wrong on one rank is an error of all, and what goes right is whole.
#include "reader_ranks.h"

#include "vtkSmartPointer.h"

#include <chrono>
#include <functional>
#include <thread>

namespace
{
constexpr int Few = 30000; ///< several reports of progress on each rank

const std::string Text = GrainsFrame(0, Few);

/// The text with another word for the x of a row.
std::string WithBadRow(std::string text, int row)
{
  char word[16];
  std::snprintf(word, sizeof word, " 0.%06d", row);
  text.replace(text.find(word), 9, " 0.zero!!");
  return text;
}

/// A row in the middle of what a rank reads.
int RowOf(int rank, int size)
{
  return (2 * rank + 1) * Few / (2 * size);
}
}

TEST_F(ReaderRanks, AFileIsMissingOnOne)
{
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    Write("run.dump", Text);
    if (this->Rank() == rank)
    {
      std::filesystem::remove("run.dump");
    }
    Reader reader({ "run.dump" });
    this->UpdateOwnPiece(reader);
    this->ExpectError(reader, vtkErrorCode::FileNotFoundError, "run.dump: cannot open", rank);
    Write("run.dump", Text);
    reader->Modified();
    this->UpdateOwnPiece(reader);
    this->ExpectWhole(reader, Few);
  }
}

/// A column that holds a word where one rank reads holds words on all.
TEST_F(ReaderRanks, AColumnIsOfOneTypeOnAll)
{
  Write("run.dump",
    Frame(
      0, 6, "id x y z tag", "1 0 0 0 1\n2 0 0 0 2\n3 0 0 0 3\n4 0 0 0 4\n5 0 0 0 5\n6 0 0 0 no\n"));
  Reader reader({ "run.dump" });
  this->UpdateOwnPiece(reader);
  this->ExpectWhole(reader, 6);
  this->ExpectSame(reader.Array("tag")->GetClassName());
  EXPECT_TRUE(reader.Array("tag")->IsA("vtkStringArray"));
  EXPECT_EQ(reader.Said->Warnings.size(), this->Rank() == 0 ? 1u : 0u);
}

TEST_F(ReaderRanks, OneIsCancelledAtAnyReport)
{
  Write("run.dump", Text);
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    for (int at = 1;; ++at)
    {
      Reader reader({ "run.dump" });
      vtkNew<Stopper> stopper;
      stopper->At = this->Rank() == rank ? at : 0;
      reader->AddObserver(vtkCommand::ProgressEvent, stopper);
      this->UpdateOwnPiece(reader);
      if (this->OnAny(reader.Particles()->GetNumberOfPoints() > 0))
      {
        // the last report comes when all is done, too late for anything
        EXPECT_GT(at, 4);
        this->ExpectWhole(reader, Few);
        break;
      }
      ExpectEmpty(reader);
      EXPECT_EQ(Outcome(reader), "code 0");
      EXPECT_EQ(reader->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED()), 1);
      stopper->At = 0;
      this->UpdateOwnPiece(reader);
      this->ExpectWhole(reader, Few);
    }
  }
}

TEST_F(ReaderRanks, OneIsCancelledBeforehand)
{
  Write("run.dump", Text);
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    Reader reader({ "run.dump" });
    const auto abort = [&] { reader->SetAbortExecute(this->Rank() == rank ? 1 : 0); };
    abort();
    this->UpdateOwnPiece(reader);
    ExpectEmpty(reader);
    this->UpdateOwnPiece(reader);
    this->ExpectWhole(reader, Few);

    // where there is nothing to do there is nothing to stop
    abort();
    this->UpdateOwnPiece(reader);
    this->ExpectWhole(reader, Few);
    reader->Modified();
    this->UpdateOwnPiece(reader);
    ExpectEmpty(reader);
    this->UpdateOwnPiece(reader);
    this->ExpectWhole(reader, Few);
  }
}

/// The wish of one rank to stop does not outlast the error of another.
TEST_F(ReaderRanks, OneIsCancelledWhileAnotherFails)
{
  Write("run.dump", Text);
  const int failing = this->Size() - 1;
  if (this->Rank() == failing)
  {
    Write("run.dump", WithBadRow(Text, RowOf(failing, this->Size())));
  }
  Reader reader({ "run.dump" });
  reader->UpdateInformation();
  vtkNew<Stopper> stopper;
  stopper->At = this->Rank() == 0 ? 2 : 0;
  reader->AddObserver(vtkCommand::ProgressEvent, stopper);
  this->UpdateOwnPiece(reader); // whichever comes first
  this->ExpectSame(Outcome(reader));
  ExpectEmpty(reader);
  this->ExpectSame(std::to_string(reader->GetOutputInformation(0)->Get(vtkAlgorithm::ABORTED())));
  Write("run.dump", Text);
  stopper->At = 0;
  reader->Modified();
  this->UpdateOwnPiece(reader);
  this->ExpectWhole(reader, Few);
}

/// The others hear of it in the middle of their work, and do not finish it.
TEST_F(ReaderRanks, AFailureStopsTheOthers)
{
  constexpr int many = 600000;
  Write("run.dump", GrainsFrame(0, many));
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    const std::string mark = "../stopped_" + std::to_string(rank);
    std::filesystem::remove(mark);
    this->OnAny(false);
    Reader reader({ "run.dump" });
    reader->SetThreads(1);
    reader->UpdateInformation();
    double last = 0;
    // one stops at its second report; at theirs the others wait for that, and are slow from then on
    const auto report = [&, reports = 0](vtkObject* caller, unsigned long, void* data) mutable
    {
      last = *static_cast<double*>(data) < 1 ? *static_cast<double*>(data) : last;
      if (++reports < 2 || *static_cast<double*>(data) == 1)
      {
        return;
      }
      if (this->Rank() == rank)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
        std::ofstream(mark) << "now";
        return;
      }
      while (!std::filesystem::exists(mark))
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    };
    struct Report : vtkCommand
    {
      std::function<void(vtkObject*, unsigned long, void*)> Call;
      void Execute(vtkObject* caller, unsigned long event, void* data) override
      {
        this->Call(caller, event, data);
      }
    };
    auto command = vtkSmartPointer<Report>::Take(new Report);
    command->Call = report;
    reader->AddObserver(vtkCommand::ProgressEvent, command);
    this->UpdateOwnPiece(reader);
    EXPECT_LT(last, 0.9);
    ExpectEmpty(reader);
    reader->RemoveObservers(vtkCommand::ProgressEvent);
    this->UpdateOwnPiece(reader);
    this->ExpectWhole(reader, many);
  }
}

TEST_F(ReaderRanks, ALaterFrameIsWrongOnOne)
{
  const std::string frames = GrainsFrame(0, Few) + GrainsFrame(1, Few);
  for (int rank = 0; rank < this->Size(); ++rank)
  {
    const int row = RowOf(rank, this->Size());
    Write("run.dump", frames + Text + frames);
    if (this->Rank() == rank)
    {
      Write("run.dump",
        GrainsFrame(0, Few) + WithBadRow(GrainsFrame(1, Few), row) + GrainsFrame(2, Few));
    }
    else
    {
      Write("run.dump", frames + GrainsFrame(2, Few));
    }
    Reader reader({ "run.dump" });
    this->UpdateOwnPiece(reader, 0);
    this->ExpectWhole(reader, Few);
    this->UpdateOwnPiece(reader, 1);
    this->ExpectError(reader, vtkErrorCode::FileFormatError,
      "run.dump:" + std::to_string(Few + 9 + row + 9) + ": column 'x'", rank);
    this->UpdateOwnPiece(reader, 2);
    this->ExpectWhole(reader, Few);
    this->UpdateOwnPiece(reader, 0);
    this->ExpectWhole(reader, Few);
  }
}

/// Rank 0 alone looks at the files: what it sees is there for all, and what others lack is an error.
TEST_F(ReaderRanks, AFileGrows)
{
  Write("run.dump", GrainsFrame(0, 100));
  Reader reader({ "run.dump" });
  reader->RefreshOnUpdateOn();
  this->UpdateOwnPiece(reader);
  this->ExpectWhole(reader, 100);
  this->UpdateOwnPiece(reader);
  this->ExpectWhole(reader, 100);
  if (this->Rank() == 0)
  {
    Write("run.dump", GrainsFrame(0, 100) + GrainsFrame(1, 200));
  }
  this->UpdateOwnPiece(reader, 1);
  this->ExpectError(
    reader, vtkErrorCode::PrematureEndOfFileError, "run.dump: the file was shortened", 1);
  Write("run.dump", GrainsFrame(0, 100) + GrainsFrame(1, 200));
  reader->Modified();
  this->UpdateOwnPiece(reader, 1);
  this->ExpectWhole(reader, 200);
  EXPECT_EQ(reader.Times(), (std::vector<double>{ 0, 1 }));
  this->OnAny(false);
  if (this->Rank() == 0)
  {
    std::filesystem::remove("run.dump");
  }
  this->UpdateOwnPiece(reader, 1);
  this->ExpectError(reader, vtkErrorCode::FileNotFoundError, "run.dump: cannot open", 0);
}

TEST_F(ReaderRanks, EachMayAskForAnotherFrame)
{
  Write("run.dump", GrainsFrame(0, 10) + GrainsFrame(1, 21) + GrainsFrame(2, 32));
  Reader reader({ "run.dump" });
  for (int turn = 0; turn < 6; ++turn)
  {
    const int frame = (this->Rank() + turn) % 3;
    reader->UpdateTimeStep(frame);
    EXPECT_EQ(Outcome(reader), "code 0");
    EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 10 + 11 * frame);
    EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
  }
}

TEST_F(ReaderRanks, EachMayAskForAnyPiece)
{
  Write("run.dump", GrainsFrame(0, 100));
  for (const bool sorted : { false, true })
  {
    Reader reader({ "run.dump" });
    reader->SetSortById(sorted);
    const int last = this->Size() - 1;
    reader->UpdatePiece(last - this->Rank(), this->Size(), 0);
    const std::vector<vtkTypeInt64> ids = this->Ids(reader);
    EXPECT_EQ(ids.size(), 100u);
    EXPECT_TRUE(ids.front() > ids.back() && *std::max_element(ids.begin(), ids.end()) == 100);
    EXPECT_EQ(reader.Box()->GetNumberOfCells(), this->Rank() == last ? 1 : 0);

    reader->UpdatePiece(this->Rank(), 2 * this->Size(), 0);
    const std::size_t half = this->Ids(reader).size();
    reader->UpdatePiece(this->Size() + this->Rank(), 2 * this->Size(), 0);
    EXPECT_EQ(half + this->Ids(reader).size(), 100u);

    reader->UpdatePiece(0, 1, 0);
    EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 100);
    this->UpdateOwnPiece(reader);
    this->ExpectWhole(reader, 100);
    EXPECT_EQ(Outcome(reader), "code 0");
  }
}

/// Ranks with other properties do not read together; each gets what it asked for.
TEST_F(ReaderRanks, EachMayAskForOtherRows)
{
  Write("run.dump", GrainsFrame(0, 100));
  Reader reader({ "run.dump" });
  reader->UpdateInformation();
  reader->SetSortById(this->Rank() == 1);
  if (this->Rank() == 0)
  {
    reader->GetPointDataArraySelection()->DisableArray("element");
  }
  reader->Modified();
  this->UpdateOwnPiece(reader);
  EXPECT_EQ(reader.Array("element") == nullptr, this->Rank() == 0);
  const vtkIdType points = reader.Particles()->GetNumberOfPoints();
  EXPECT_TRUE(30 <= points && points <= 37) << points;
}

/// Also a rank alone says what it found.
TEST_F(ReaderRanks, NoticesOfOneAreTold)
{
  Write("run.dump",
    Frame(0, 1, "id x y z tag", "1 0 0 0 1\n") +
      Frame(1, 2, "id x y z tag", "1 0 0 0 1\n2 0 0 0 no\n"));
  Reader reader({ "run.dump" });
  reader->UpdateTimeStep(this->Rank() == 1 ? 1 : 0);
  EXPECT_EQ(reader.Said->Warnings.size(), this->Rank() == 1 ? 1u : 0u);
}

TEST_F(ReaderRanks, OneWithoutControllerIsAlone)
{
  Write("run.dump", GrainsFrame(0, 100));
  Write("other.dump", GrainsFrame(0, 7));
  Reader reader({ "run.dump" });
  this->UpdateOwnPiece(reader);
  this->ExpectWhole(reader, 100);
  vtkMultiProcessController* const all = reader->GetController();
  if (this->Rank() == 1)
  {
    Reader alone({ "other.dump" });
    alone->SetController(nullptr);
    alone->Update();
    EXPECT_EQ(alone.Particles()->GetNumberOfPoints(), 7);
  }
  // what one has read alone is not what all read
  reader->SetController(nullptr);
  if (this->Rank() == 1)
  {
    reader.Open("other.dump");
    reader->Update();
    EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 7);
    reader.Open("run.dump");
  }
  reader->SetController(all);
  reader->Modified();
  this->UpdateOwnPiece(reader);
  this->ExpectWhole(reader, 100);
}

int main(int argc, char** argv)
{
  return RunWithController(argc, argv);
}
