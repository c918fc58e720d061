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

#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/observer.h"
#include "../support/rank_tests.h"
#include "failing_cases.h"
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
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace
{
constexpr long Most = 3; ///< calls that are tried, where not all are wanted
constexpr long MostOfMemory = 2;

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
  void Judge(const FailingCase& one, int rank, const Result& own, const std::string& folder)
  {
    for (const std::string& other : this->Ranks.all_gather(own.Failed ? own.Error : ""))
    {
      EXPECT_EQ(own.Failed ? own.Error : "", other);
    }
    EXPECT_TRUE(!own.Failed || !own.Error.empty());
    EXPECT_TRUE(!one.harmless || !own.Failed) << own.Error;
    if (own.Failed)
    {
      const std::string on = "(on rank " + std::to_string(rank) + " of ";
      EXPECT_NE(own.Error.find(on), std::string::npos) << own.Error;
      EXPECT_TRUE(of_memory(one) || own.Error.find(folder) != std::string::npos) << own.Error;
    }
  }

  /// Calls use(case, rank, number) for each call on each rank; use returns how many there were that might fail. Each case comes
  /// up on some rank. Memory must not grow; MPI and VTK keep some for good, but not each time.
  void FailEach(std::span<const FailingCase> cases,
    const std::function<long(const FailingCase& one, int rank, long number)>& use)
  {
    FaultCount faults(this->Rank() == 0);
    for (const FailingCase& one : cases)
    {
      long delivered = 0;
      for (int rank = 0; rank < this->Size(); ++rank)
      {
        if (rank > 0 && rank < this->Size() - 1 && !all_faults_wanted())
        {
          continue; // who is neither the first one nor the last one
        }
        long made = 0;
        bool fired = true;
        for (long number = 1; fired;)
        {
          const long possible = this->FailOne(one, rank, number, use);
          made = std::max(made, possible);
          fired = possible >= number;
          faults.add(fired);
          delivered += fired ? 1 : 0;
          if (this->OfAny(HasFailure()))
          {
            return;
          }
          number = next_number(number, made, of_memory(one) ? MostOfMemory : Most);
        }
      }
      expect_delivered(one.name, delivered);
    }
  }

  long FailOne(const FailingCase& one, int rank, long number,
    const std::function<long(const FailingCase& one, int rank, long number)>& use)
  {
    constexpr int mostTries = 10; // MPI takes memory for messages now and then, and keeps it
    SCOPED_TRACE(std::string(one.name) + " on rank " + std::to_string(rank) + ", call " +
      std::to_string(number));
    this->Dog.Begin(
      testing::UnitTest::GetInstance()->current_test_info()->name(), one.name, rank, number);
    const long files = open_files();
    long possible = 0;
    bool grown = true;
    for (int tries = 0; this->OfAny(grown) && tries < mostTries; ++tries)
    {
      const long blocks = live_blocks();
      possible = this->OfRank(use(one, rank, number), rank);
      grown = live_blocks() > blocks;
    }
    EXPECT_FALSE(grown && !HasFailure()) << "memory is lost";
    EXPECT_EQ(open_files(), files) << "files are left open";
    return possible;
  }

  bool OfAny(bool here)
  {
    std::int64_t count = here ? 1 : 0;
    this->Ranks.sum({ &count, 1 });
    return count > 0;
  }

  void Fail(const FailingCase& one, int rank, long number, const std::string& folder) const
  {
    FailingCalls failing = failing_calls_of(one, number, folder);
    failing.fault = this->Rank() == rank ? one.fault : CallFault::None;
    failing.caller = of_memory(one) ? "libvtkGranular" : nullptr;
    make_fail(failing);
  }

  template <class Reader>
  static void Open(Watched<Reader>& reader, const std::vector<std::string>& files, int threads = 1)
  {
    for (const std::string& file : files)
    {
      reader->AddFileName((file.starts_with('/') ? file : Good + file).c_str());
    }
    reader->SetThreads(threads);
    if constexpr (requires { reader->SetSortById(true); })
    {
      reader->SetSortById(true); // the ranks exchange particles
    }
  }

  template <class Reader>
  void TryReader(const std::vector<std::string>& files,
    std::span<const FailingCase> cases = reader_cases, const std::string& folder = Good)
  {
    const auto update = [&](Watched<Reader>& reader)
    { reader->UpdatePiece(this->Rank(), this->Size(), 0); };
    const int threads = cases.data() == large_cases ? 2 : 1;
    Watched<Reader> undisturbed;
    Open(undisturbed, files, threads);
    update(undisturbed);
    const std::string whole = Content(undisturbed.Get);
    const std::string usual = Words(undisturbed.Seen->Said);
    ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
    this->FailEach(cases,
      [&](const FailingCase& one, int rank, long number)
      {
        Watched<Reader> reader;
        Open(reader, files, threads);
        this->Fail(one, rank, number, folder);
        update(reader);
        stop_failing();
        const long possible = calls_that_may_fail();
        const bool failed = reader->GetErrorCode() != 0;
        const std::vector<std::string>& said = reader.Seen->Said;
        const std::string last = said.empty() ? "" : Words({ said.back() });
        const bool told =
          this->OfAny(Words(said) != usual); // a notice may be the first rank's alone
        this->Judge(one, rank, { failed, last }, folder);
        EXPECT_TRUE(!failed || IsEmpty(reader.Get));
        EXPECT_TRUE(failed || told || Content(reader.Get) == whole);
        if (one.harmless)
        {
          EXPECT_TRUE(Content(reader.Get) == whole);
          EXPECT_EQ(Words(said), usual);
        }
        update(reader);
        EXPECT_TRUE(!failed || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole))
          << Words(said);
        return possible;
      });
  }

  /// All ranks write what a reader shows to a file of that name.
  template <class Reader, class Writer>
  void TryWriter(const std::string& from, const std::string& to, int mode)
  {
    const std::string folder = std::string(GRANULAR_OUTPUT) + "/" +
      testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(this->Size());
    const std::string path = folder + "/" + to;
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
    const auto write = [&]
    {
      Watched<Writer> writer;
      open(writer);
      return writer->Write() == 1;
    };
    const auto begin = [&](const FailingCase* one)
    {
      this->Begin(folder, path);
      if (one && one->leaves == Leaves::Older)
      {
        make_fail(leaving_calls(folder));
        EXPECT_FALSE(write());
        stop_failing();
        this->Wait();
      }
    };
    begin(nullptr);
    ASSERT_TRUE(write());
    this->Wait();
    const std::string whole = bytes_of_file(path);
    this->Wait();
    long writtenBut = 0;
    this->FailEach(writer_cases,
      [&](const FailingCase& one, int rank, long number)
      {
        begin(&one);
        Watched<Writer> writer;
        open(writer);
        this->Fail(one, rank, number, folder);
        const bool written = writer->Write() == 1;
        stop_failing();
        const long possible = calls_that_may_fail();
        const std::string last = writer->GetErrorMessage();
        // Open MPI does not do again what was interrupted
        const bool byMpi = mode == vtkGranularWriter::MPI_IO && one.fault == CallFault::Interrupted;
        FailingCase judged = one;
        judged.harmless = one.harmless && !byMpi;
        this->Judge(judged, rank, { !written, last }, path);
        const bool renamed = last.find(": written, but") != std::string::npos;
        writtenBut += renamed ? 1 : 0;
        this->Wait();
        EXPECT_TRUE(bytes_of_file(path) == (written || renamed ? whole : Old)) << last;
        const bool fired = this->OfRank(possible, 0) >= number && rank == 0;
        this->ExpectHidden(folder, one, fired, mode == vtkGranularWriter::MPI_IO);
        this->Wait();
        EXPECT_EQ(writer->Write(), 1) << writer->GetErrorMessage();
        this->Wait();
        EXPECT_TRUE(bytes_of_file(path) == whole);
        if (one.leaves != Leaves::Nothing || one.kinds == calls::stat)
        {
          EXPECT_TRUE(write()); // by a writer that does not know what the first one has written
        }
        this->Wait();
        EXPECT_EQ(count_hidden(folder), 0) << last;
        this->Wait();
        reader.Seen->Said = {};
        reader.OfPipeline->Said = {};
        return possible;
      });
    EXPECT_GT(writtenBut, 0) << "of the folder, which is behind the file";
  }

  /// How many hidden files there are. Those of Open MPI, in which it tries locks, are its own.
  static long CountHidden(const std::string& folder)
  {
    return std::ranges::count_if(std::filesystem::directory_iterator(folder),
      [](const auto& entry)
      {
        const std::string name = entry.path().filename().string();
        return is_hidden(name) && name.find("locktest") == std::string::npos;
      });
  }

  void Begin(const std::string& folder, const std::string& path)
  {
    if (this->Rank() == 0)
    {
      std::filesystem::remove_all(folder);
      std::filesystem::create_directories(folder);
      std::ofstream(path) << Old;
    }
    this->Wait();
  }

  /// The first rank's file is left where removing fails; with another one beside it where MPI writes into that, whose lock also
  /// stays where the system does not tell whose it is.
  static void ExpectHidden(
    const std::string& folder, const FailingCase& one, bool fired, bool byMpi)
  {
    const long hidden = CountHidden(folder);
    const bool leaves = fired && one.leaves != Leaves::Nothing;
    const bool asks = fired && byMpi && one.kinds == calls::stat;
    const long least = leaves ? 1 : 0;
    const long most = !leaves && !asks ? 0 : byMpi && leaves ? 3 : 1;
    EXPECT_TRUE(least <= hidden && hidden <= most) << names_in(folder);
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

/// Pages for the memory of rows, and threads.
TEST_F(FailingRanks, DumpReaderOfManyRows)
{
  const std::string folder = std::string(GRANULAR_OUTPUT) + "/rows" + std::to_string(this->Size());
  const std::string path = folder + "/made.dump";
  this->Begin(folder, path);
  if (this->Rank() == 0)
  {
    std::ofstream(path) << dump_of_rows(20000);
  }
  this->Wait();
  this->TryReader<vtkGranularDumpReader>({ path }, large_cases, folder);
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

/// The quick form has that by MPI.
TEST_F(FailingRanks, DumpWriterOfBinary)
{
  if (!all_faults_wanted())
  {
    GTEST_SKIP();
  }
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>(
    "chain.dump", "new.bin", vtkGranularWriter::GATHER);
}

TEST_F(FailingRanks, DumpWriterOfGzip)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>(
    "chain.dump", "new.dump.gz", vtkGranularWriter::GATHER);
}

TEST_F(FailingRanks, DumpWriterOfBinaryByMpi)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>(
    "chain.dump", "new.bin", vtkGranularWriter::MPI_IO);
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

TEST_F(FailingRanks, DecompositionWriterOfXml)
{
  this->TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.vtu", vtkGranularWriter::GATHER);
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
