// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: a call of the system fails on one rank while all read or write a dump together. All ranks have the same error, which
// names the file and the rank, or all have everything; and none waits for ever. Other classes: failing_classes.cxx.
#include "vtkGranularDumpReader.h"
#include "vtkGranularDumpWriter.h"

#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/observer.h"
#include "../support/rank_tests.h"
#include "failing_cases.h"
#include "reader_content.h"

#include "granular/mpi/mpi_communicator.h"

#include "vtkMPIController.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <csignal>
#include <unistd.h>

namespace
{
constexpr long Most = 3; ///< calls that are tried, where not all are wanted
constexpr long MostOfMemory = 2;

const std::string Good = std::string(GRANULAR_DATA) + "/good/";
constexpr const char* Old = "what was there before";

char Now[256] = {}; ///< the fault, for a rank that waits for too long

void EndAfter(unsigned seconds)
{
  std::signal(SIGALRM,
    [](int)
    {
      [[maybe_unused]] const ssize_t told = ::write(STDERR_FILENO, Now, std::strlen(Now));
      ::_exit(1);
    });
  ::alarm(seconds);
}

class FailingRanks : public testing::Test
{
protected:
  /// Calls a function with a call that fails on a rank; it returns how many calls there were that might.
  using Use = std::function<long(const FailingCase& one, int rank, long number)>;

  int Rank() const { return this->Ranks.rank(); }
  int Size() const { return this->Ranks.size(); }
  void Wait() { this->Ranks.agree({}); }

  long OfRank(long value, int rank)
  {
    std::int64_t own = this->Rank() == rank ? value : 0;
    this->Ranks.sum({ &own, 1 });
    return own;
  }

  bool OfAny(bool here)
  {
    std::int64_t count = here ? 1 : 0;
    this->Ranks.sum({ &count, 1 });
    return count > 0;
  }

  /// All have failed with the same words, or none has; where the fault is of a file, the words say it and the rank.
  void Judge(const FailingCase& one, int rank, bool failed, const std::string& error,
    const std::string& path)
  {
    for (const std::string& other : this->Ranks.all_gather(failed ? error : ""))
    {
      EXPECT_EQ(failed ? error : "", other);
    }
    EXPECT_TRUE(!one.harmless || !failed) << error;
    if (failed)
    {
      const std::string on = "(on rank " + std::to_string(rank) + " of ";
      EXPECT_NE(error.find(on), std::string::npos) << error;
      EXPECT_TRUE(of_memory(one) || error.find(path) != std::string::npos) << error;
    }
  }

  /// Fails the calls of each rank in turn. Each case comes up on some rank.
  void FailEach(std::span<const FailingCase> cases, const Use& use)
  {
    FaultCount faults(this->Rank() == 0);
    for (const FailingCase& one : cases)
    {
      long delivered = 0;
      for (int rank = 0; rank < this->Size(); ++rank)
      {
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

  /// Memory must not grow; MPI and VTK keep some for good, but not each time.
  long FailOne(const FailingCase& one, int rank, long number, const Use& use)
  {
    constexpr int mostTries = 10; // MPI takes memory for messages now and then, and keeps it
    std::snprintf(
      Now, sizeof Now, "a rank waits: %s on rank %d, call %ld\n", one.name, rank, number);
    SCOPED_TRACE(Now);
    EndAfter(60);
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
    EndAfter(0);
    return possible;
  }

  void Fail(const FailingCase& one, int rank, long number, const std::string& folder) const
  {
    FailingCalls failing = failing_calls_of(one, number, folder);
    failing.fault = this->Rank() == rank ? one.fault : CallFault::None;
    failing.caller = of_memory(one) ? "libvtkGranular" : nullptr;
    make_fail(failing);
  }

  void Read(Watched<vtkGranularDumpReader>& reader)
  {
    reader->AddFileName((Good + "chain.dump").c_str());
    reader->SetThreads(1);
    reader->SetSortById(true); // the ranks exchange particles
  }

  void TryWriter(const std::string& to, int mode);

  /// The old file alone.
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
  /// stays where the system does not tell whose it is. Files in which Open MPI tries locks are its own.
  static void ExpectHidden(
    const std::string& folder, const FailingCase& one, bool fired, bool byMpi)
  {
    const long hidden = std::ranges::count_if(std::filesystem::directory_iterator(folder),
      [](const auto& entry)
      {
        const std::string name = entry.path().filename().string();
        return is_hidden(name) && name.find("locktest") == std::string::npos;
      });
    const bool leaves = fired && one.leaves != Leaves::Nothing;
    const bool asks = fired && byMpi && one.kinds == calls::stat;
    const long least = leaves ? 1 : 0;
    const long most = !leaves && !asks ? 0 : byMpi && leaves ? 3 : 1;
    EXPECT_TRUE(least <= hidden && hidden <= most) << names_in(folder);
  }

  granular::MpiCommunicator Ranks{ MPI_COMM_WORLD };
};

void FailingRanks::TryWriter(const std::string& to, int mode)
{
  const std::string folder = std::string(GRANULAR_OUTPUT) + "/" +
    testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(this->Size());
  const std::string path = folder + "/" + to;
  const bool byMpi = mode == vtkGranularWriter::MPI_IO;
  Watched<vtkGranularDumpReader> reader;
  this->Read(reader);
  reader->UpdatePiece(this->Rank(), this->Size(), 0);
  const auto open = [&](Watched<vtkGranularDumpWriter>& writer)
  {
    writer->SetInputConnection(reader->GetOutputPort());
    writer->SetFileName(path.c_str());
    writer->SetParallelMode(mode);
    writer->SetThreads(1);
  };
  const auto write = [&]
  {
    Watched<vtkGranularDumpWriter> writer;
    open(writer);
    const bool written = writer->Write() == 1;
    this->Wait();
    return written;
  };
  this->Begin(folder, path);
  ASSERT_TRUE(write());
  const std::string whole = bytes_of_file(path);
  this->Wait();
  long writtenBut = 0;
  this->FailEach(writer_cases,
    [&](const FailingCase& one, int rank, long number)
    {
      this->Begin(folder, path);
      if (one.leaves == Leaves::Older)
      {
        make_fail(leaving_calls(folder));
        EXPECT_FALSE(write());
        stop_failing();
      }
      Watched<vtkGranularDumpWriter> writer;
      open(writer);
      this->Fail(one, rank, number, folder);
      const bool written = writer->Write() == 1;
      stop_failing();
      const long possible = calls_that_may_fail();
      const std::string last = writer->GetErrorMessage();
      FailingCase judged = one;
      // Open MPI does not do again what was interrupted
      judged.harmless = one.harmless && !(byMpi && one.fault == CallFault::Interrupted);
      this->Judge(judged, rank, !written, last, path);
      const bool renamed = last.find(": written, but") != std::string::npos;
      writtenBut += renamed ? 1 : 0;
      this->Wait();
      EXPECT_TRUE(bytes_of_file(path) == (written || renamed ? whole : Old)) << last;
      ExpectHidden(folder, one, this->OfRank(possible, 0) >= number && rank == 0, byMpi);
      this->Wait();
      EXPECT_EQ(writer->Write(), 1) << writer->GetErrorMessage();
      this->Wait();
      EXPECT_TRUE(bytes_of_file(path) == whole);
      EXPECT_TRUE(write()); // by a writer that does not know what the first one has written
      EXPECT_EQ(count_hidden(folder), 0) << last;
      this->Wait();
      reader.Seen->Said = {};
      reader.OfPipeline->Said = {};
      return possible;
    });
  EXPECT_GT(writtenBut, 0) << "of the folder, which is behind the file";
}
}

TEST_F(FailingRanks, DumpReader)
{
  const auto update = [&](Watched<vtkGranularDumpReader>& reader)
  { reader->UpdatePiece(this->Rank(), this->Size(), 0); };
  Watched<vtkGranularDumpReader> undisturbed;
  this->Read(undisturbed);
  update(undisturbed);
  const std::string whole = Content(undisturbed.Get);
  const std::string usual = Words(undisturbed.Seen->Said);
  ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
  this->FailEach(reader_cases,
    [&](const FailingCase& one, int rank, long number)
    {
      Watched<vtkGranularDumpReader> reader;
      this->Read(reader);
      this->Fail(one, rank, number, Good);
      update(reader);
      stop_failing();
      const long possible = calls_that_may_fail();
      const bool failed = reader->GetErrorCode() != 0;
      const std::vector<std::string>& said = reader.Seen->Said;
      const bool told = this->OfAny(Words(said) != usual); // a notice may be the first rank's alone
      this->Judge(one, rank, failed, said.empty() ? "" : Words({ said.back() }), Good);
      EXPECT_TRUE(!failed || IsEmpty(reader.Get));
      EXPECT_TRUE(failed || (told && !one.harmless) || Content(reader.Get) == whole);
      EXPECT_TRUE(!one.harmless || Words(said) == usual);
      update(reader);
      EXPECT_TRUE(!failed || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole))
        << Words(said);
      return possible;
    });
}

TEST_F(FailingRanks, DumpWriterThatGathers)
{
  this->TryWriter("new.dump", vtkGranularWriter::GATHER);
}

TEST_F(FailingRanks, DumpWriterByMpi)
{
  this->TryWriter("new.bin", vtkGranularWriter::MPI_IO);
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
