// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: a call of the system fails on one rank, through each class that reads or writes with the others. All ranks have the
// same error, which names the file and the rank, or all have everything; and none waits for ever.
#include "vtkGranularDataFileReader.h"
#include "vtkGranularDecompositionReader.h"
#include "vtkGranularDecompositionWriter.h"
#include "vtkGranularDumpReader.h"
#include "vtkGranularDumpWriter.h"
#include "vtkGranularEulerReader.h"
#include "vtkGranularEulerWriter.h"
#include "vtkGranularLocalReader.h"
#include "vtkGranularLocalWriter.h"
#include "vtkGranularRestartReader.h"

#include "../support/failing_calls.h"
#include "../support/observer.h"
#include "../support/rank_tests.h"
#include "fault_numbers.h"
#include "reader_content.h"

#include "granular/mpi/mpi_communicator.h"

#include "vtkMPIController.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace
{
struct Case
{
  const char* Name;
  unsigned Kinds;
  CallFault Fault;
  int Error = EIO;
  bool Harmless = false;
};

constexpr Case Reading[] = {
  { "a call fails", calls::reading, CallFault::Error },
  { "a read gives nothing", calls::read, CallFault::End },
  { "a call is interrupted", calls::reading, CallFault::Interrupted, 0, true },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM },
  { "pages are refused", calls::map, CallFault::Error, ENOMEM },
};

constexpr Case Writing[] = {
  { "a file cannot be asked", calls::stat, CallFault::Error },
  { "no file can be made", calls::create, CallFault::Error, ENOSPC },
  { "the disk is full", calls::write, CallFault::Error, ENOSPC },
  { "one byte is written", calls::write, CallFault::Short, 0, true },
  { "a write is interrupted", calls::write, CallFault::Interrupted, 0, true },
  { "closing fails", calls::close, CallFault::Error },
  { "renaming fails", calls::rename, CallFault::Error, EACCES },
  { "the disk takes nothing", calls::sync, CallFault::Error },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM },
  { "pages are refused", calls::map, CallFault::Error, ENOMEM },
};

constexpr long MostOfMemory = 12; ///< calls that are tried, where not all are wanted

bool OfMemory(const Case& one)
{
  return (one.Kinds & (calls::memory | calls::map)) != 0;
}

const std::string Good = std::string(GRANULAR_DATA) + "/good/";
constexpr const char* Old = "what was there before";

/// Ends the program when a rank waits for too long, and says where.
class Watchdog
{
public:
  explicit Watchdog(int rank)
    : Thread(
        [this, rank](const std::stop_token& stop)
        {
          constexpr int limit = 20; // seconds
          long seen = -1;
          for (int waited = 0; !stop.stop_requested(); ++waited)
          {
            waited = this->Beats == seen ? waited : 0;
            seen = this->Beats;
            if (waited == 10 * limit)
            {
              std::printf("rank %d waits: %s\n", rank, this->What);
              std::fflush(stdout);
              std::_Exit(1);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
          }
        })
  {
  }

  void Begin(const char* test, const char* fault, int onRank, long number)
  {
    std::snprintf(
      this->What, sizeof this->What, "%s, %s on rank %d, call %ld", test, fault, onRank, number);
    ++this->Beats;
  }

private:
  std::atomic<long> Beats = 0;
  char What[256] = {};
  std::jthread Thread;
};

std::string BytesOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
}

/// What came of an update on a rank.
struct Result
{
  bool Failed = false;
  std::string Error;
};

class FailingRanks : public testing::Test
{
protected:
  int Rank() const { return this->Ranks.rank(); }
  int Size() const { return this->Ranks.size(); }
  void Wait() { this->Ranks.agree({}); }

  long OfRank(long value, int rank)
  {
    std::int64_t own = this->Rank() == rank ? value : 0;
    this->Ranks.sum({ &own, 1 });
    return own;
  }

  /// All have failed with the same words, or none has; where the fault is of a file, the words say it and the rank.
  void Judge(const Case& one, int rank, const Result& own, const std::string& folder)
  {
    for (const std::string& other : this->Ranks.all_gather(own.Failed ? own.Error : ""))
    {
      EXPECT_EQ(own.Failed ? own.Error : "", other);
    }
    EXPECT_TRUE(!own.Failed || !own.Error.empty());
    EXPECT_TRUE(!one.Harmless || !own.Failed) << own.Error;
    if (own.Failed)
    {
      const std::string on = "(on rank " + std::to_string(rank) + " of ";
      EXPECT_NE(own.Error.find(on), std::string::npos) << own.Error;
      EXPECT_TRUE(OfMemory(one) || own.Error.find(folder) != std::string::npos) << own.Error;
    }
  }

  /// Calls use(case, rank, number) for each call on each rank; use returns how many there were that might fail.
  template <std::size_t N>
  void FailEach(
    const Case (&cases)[N], const std::function<long(const Case& one, int rank, long number)>& use)
  {
    const char* const test = testing::UnitTest::GetInstance()->current_test_info()->name();
    FaultCount faults(this->Rank() == 0);
    for (const Case& one : cases)
    {
      for (int rank = 0; rank < this->Size(); ++rank)
      {
        long made = 0;
        for (long number = 1, possible = 1; number <= possible;)
        {
          SCOPED_TRACE(std::string(one.Name) + " on rank " + std::to_string(rank) + ", call " +
            std::to_string(number));
          this->Dog.Begin(test, one.Name, rank, number);
          const long files = open_files();
          possible = this->OfRank(use(one, rank, number), rank);
          EXPECT_EQ(open_files(), files) << "files are left open";
          made = std::max(made, possible);
          faults.add(possible >= number);
          if (this->OfAny(HasFailure()))
          {
            return;
          }
          number = OfMemory(one) ? next_number(number, made, MostOfMemory) : number + 1;
        }
      }
    }
  }

  bool OfAny(bool here)
  {
    std::int64_t count = here ? 1 : 0;
    this->Ranks.sum({ &count, 1 });
    return count > 0;
  }

  void Fail(const Case& one, int rank, long number, const std::string& folder) const
  {
    FailingCalls failing;
    failing.kinds = one.Kinds;
    failing.fault = this->Rank() == rank ? one.Fault : CallFault::None;
    failing.first = number;
    failing.error = one.Error;
    failing.folder = folder.c_str();
    failing.caller = OfMemory(one) ? "libvtkGranular" : nullptr;
    make_fail(failing);
  }

  template <class Reader>
  static void Open(Watched<Reader>& reader, const std::vector<std::string>& files)
  {
    for (const std::string& file : files)
    {
      reader->AddFileName((Good + file).c_str());
    }
    reader->SetThreads(1);
    if constexpr (requires { reader->SetSortById(true); })
    {
      reader->SetSortById(true); // the ranks exchange particles
    }
  }

  template <class Reader>
  void TryReader(const std::vector<std::string>& files)
  {
    const auto update = [&](Watched<Reader>& reader)
    { reader->UpdatePiece(this->Rank(), this->Size(), 0); };
    Watched<Reader> undisturbed;
    Open(undisturbed, files);
    update(undisturbed);
    const std::string whole = Content(undisturbed.Get);
    ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
    this->FailEach(Reading,
      [&](const Case& one, int rank, long number)
      {
        Watched<Reader> reader;
        Open(reader, files);
        this->Fail(one, rank, number, Good);
        update(reader);
        stop_failing();
        const long possible = calls_that_may_fail();
        const bool failed = reader->GetErrorCode() != 0;
        const std::vector<std::string>& said = reader.Seen->Said;
        const std::string last = said.empty() ? "" : said.back();
        const std::string of = "): "; // behind the address of the reader
        this->Judge(one, rank, { failed, last.substr(std::min(last.find(of), last.size())) }, Good);
        EXPECT_TRUE(!failed || IsEmpty(reader.Get));
        EXPECT_TRUE(failed || !said.empty() || Content(reader.Get) == whole);
        update(reader);
        const std::string again = said.empty() ? "" : said.back();
        EXPECT_TRUE(!failed || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole))
          << again;
        return possible;
      });
  }

  template <class Reader, class Writer>
  void TryWriter(const std::string& from, const std::string& to, int mode)
  {
    const std::string folder = std::string(GRANULAR_OUTPUT) + "/" +
      testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(this->Size());
    const std::string path = folder + "/" + to;
    const auto begin = [&]
    {
      if (this->Rank() == 0)
      {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        std::ofstream(path) << Old;
      }
      this->Wait();
    };
    Watched<Reader> reader;
    Open(reader, { from });
    reader->UpdatePiece(this->Rank(), this->Size(), 0);
    const auto open = [&](Watched<Writer>& writer)
    {
      writer->SetInputConnection(reader->GetOutputPort());
      writer->SetFileName(path.c_str());
      writer->SetParallelMode(mode);
      writer->SetThreads(1);
    };
    begin();
    Watched<Writer> undisturbed;
    open(undisturbed);
    ASSERT_EQ(undisturbed->Write(), 1) << undisturbed->GetErrorMessage();
    this->Wait();
    const std::string whole = BytesOf(path);
    this->Wait();
    this->FailEach(Writing,
      [&](const Case& one, int rank, long number)
      {
        begin();
        Watched<Writer> writer;
        open(writer);
        this->Fail(one, rank, number, folder);
        const bool written = writer->Write() == 1;
        stop_failing();
        const long possible = calls_that_may_fail();
        const std::string last = writer->GetErrorMessage();
        // Open MPI does not write again what was interrupted
        const bool byMpi = mode == vtkGranularWriter::MPI_IO && one.Fault == CallFault::Interrupted;
        Case judged = one;
        judged.Harmless = one.Harmless && !byMpi;
        this->Judge(judged, rank, { !written, last }, path);
        const bool renamed = last.find(": written, but") != std::string::npos;
        this->Wait();
        EXPECT_TRUE(BytesOf(path) == (written || renamed ? whole : Old)) << last;
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << last;
        this->Wait();
        EXPECT_EQ(writer->Write(), 1);
        this->Wait();
        EXPECT_TRUE(BytesOf(path) == whole);
        this->Wait();
        return possible;
      });
  }

  granular::MpiCommunicator Ranks{ MPI_COMM_WORLD };
  Watchdog Dog{ Ranks.rank() };
};
}

TEST_F(FailingRanks, DumpReader)
{
  this->TryReader<vtkGranularDumpReader>({ "chain.dump" });
}

TEST_F(FailingRanks, DumpReaderOfPieces)
{
  this->TryReader<vtkGranularDumpReader>(
    { "pieces_1000.0.dump", "pieces_1000.1.dump", "pieces_1000.2.dump", "pieces_1000.3.dump" });
}

TEST_F(FailingRanks, LocalReader)
{
  this->TryReader<vtkGranularLocalReader>({ "local/contacts.dump" });
}

TEST_F(FailingRanks, DataFileReader)
{
  this->TryReader<vtkGranularDataFileReader>({ "data_file/full.data" });
}

TEST_F(FailingRanks, RestartReader)
{
  this->TryReader<vtkGranularRestartReader>({ "restart/half.restart" });
}

TEST_F(FailingRanks, EulerReader)
{
  this->TryReader<vtkGranularEulerReader>({ "euler_1000.vtk" });
}

TEST_F(FailingRanks, DecompositionReader)
{
  this->TryReader<vtkGranularDecompositionReader>({ "decomposition_1000.vtk" });
}

TEST_F(FailingRanks, DumpWriter)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>(
    "chain.dump", "new.dump", vtkGranularWriter::GATHER);
}

TEST_F(FailingRanks, DumpWriterByMpi)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>(
    "chain.dump", "new.dump", vtkGranularWriter::MPI_IO);
}

TEST_F(FailingRanks, LocalWriter)
{
  this->TryWriter<vtkGranularLocalReader, vtkGranularLocalWriter>(
    "local/contacts.dump", "new.bonds", vtkGranularWriter::GATHER);
}

TEST_F(FailingRanks, EulerWriter)
{
  this->TryWriter<vtkGranularEulerReader, vtkGranularEulerWriter>(
    "euler_1000.vtk", "new.euler", vtkGranularWriter::GATHER);
}

TEST_F(FailingRanks, DecompositionWriter)
{
  this->TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.decomposition", vtkGranularWriter::GATHER);
}

int main(int argc, char** argv)
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  const int failed = run_tests_on_ranks(&argc, argv);
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return failed;
}
