// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: calls of the system that fail, through each VTK class that reads or writes; on several ranks, where one of them fails,
// through those of dumps. An error event names the file and the rank, the output is empty, the next update looks again, and no rank
// waits for ever. The reference is what a class gives that was not disturbed. Memory is refused where our library asks for it; VTK does
// not survive everywhere that its own is.
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

/// What may be done where an update has failed.
enum class Again
{
  Update,  ///< another update
  Refresh, ///< one after Refresh
  Follow   ///< one that looks whether files have changed
};

class FailingClasses : public testing::Test
{
protected:
  /// Calls a function with a call that fails on a rank; it returns how many calls there were that might.
  using Use = std::function<long(int rank, long number)>;

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

  // ---- faults ----------------------------------------------------------------------------------

  void Fail(const FailingCase& one, int rank, long number, const std::string& folder) const
  {
    FailingCalls failing = failing_calls_of(one, number, folder);
    failing.fault = this->Rank() == rank ? one.fault : CallFault::None;
    failing.caller = of_memory(one) ? "libvtkGranular" : nullptr;
    make_fail(failing);
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
    EXPECT_TRUE(!failed || !error.empty());
    const std::string on = "(on rank " + std::to_string(rank) + " of ";
    EXPECT_TRUE(!failed || this->Size() == 1 || error.find(on) != std::string::npos) << error;
    EXPECT_TRUE(!failed || of_memory(one) || error.find(path) != std::string::npos) << error;
  }

  /// Fails the calls of each rank in turn, of many calls only some. The case comes up on some rank.
  void FailEach(const FailingCase& one, const Use& use)
  {
    const long most = this->Size() > 1 ? 2 : of_memory(one) ? 8 : 6;
    long delivered = 0;
    for (int rank = 0; rank < this->Size(); ++rank)
    {
      const auto ofRank = [&](long number) { return this->FailOne(one, rank, number, use); };
      const Turns turns(most, ofRank);
      bool fired = true;
      for (long number = 1; fired && number <= turns.last; number = turns.after(number))
      {
        fired = ofRank(number) >= number;
        delivered += fired ? 1 : 0;
        if (this->OfAny(HasFailure()))
        {
          return;
        }
      }
    }
    expect_delivered(one.name, delivered);
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
      possible = this->OfRank(use(rank, number), rank);
      grown = live_blocks() > blocks;
    }
    EXPECT_FALSE(grown && !HasFailure()) << "memory is lost";
    EXPECT_EQ(open_files(), files) << "files are left open";
    EndAfter(0);
    return possible;
  }

  // ---- readers ---------------------------------------------------------------------------------

  /// Of tests/data/good, or with their whole path.
  template <class Algorithm>
  void Open(Watched<Algorithm>& reader, const std::vector<std::string>& files)
  {
    for (const std::string& file : files)
    {
      reader->AddFileName((file.starts_with('/') ? file : Good + file).c_str());
    }
    reader->SetThreads(this->Size() == 1 ? 2 : 1);
    if constexpr (requires { reader->SetSortById(true); })
    {
      reader->SetSortById(this->Size() > 1); // the ranks exchange particles
    }
  }

  template <class Algorithm>
  void TryReader(const std::vector<std::string>& files,
    std::span<const FailingCase> cases = reader_cases, const std::string& folder = Good)
  {
    Watched<Algorithm> undisturbed;
    this->Open(undisturbed, files);
    const auto update = [&](Watched<Algorithm>& reader)
    { reader->UpdatePiece(this->Rank(), this->Size(), 0); };
    update(undisturbed);
    ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
    const std::string whole = Content(undisturbed.Get);
    const std::string usual = Words(undisturbed.Seen->Said);
    const auto tryOne = [&](const FailingCase& one, int rank, long number, Again again)
    {
      Watched<Algorithm> reader;
      this->Open(reader, files);
      reader->SetRefreshOnUpdate(again == Again::Follow);
      this->Fail(one, rank, number, folder);
      update(reader);
      stop_failing();
      const long possible = calls_that_may_fail();
      const std::vector<std::string>& said = reader.Seen->Said;
      const bool failed = reader->GetErrorCode() != 0;
      const bool told = this->OfAny(Words(said) != usual); // a notice may be the first rank's alone
      this->Judge(one, rank, failed, said.empty() ? "" : Words({ said.back() }), folder);
      EXPECT_TRUE(!failed || IsEmpty(reader.Get));
      EXPECT_TRUE(told || Content(reader.Get) == whole);
      if (one.harmless || this->OfRank(possible, rank) < number)
      {
        EXPECT_TRUE(!failed && Content(reader.Get) == whole);
        EXPECT_EQ(Words(said), usual);
      }
      if (again == Again::Refresh)
      {
        reader->Refresh();
      }
      update(reader);
      const bool looks = failed || again != Again::Update;
      EXPECT_TRUE(!looks || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole))
        << "again " << static_cast<int>(again) << " after " << Words(said);
      return possible;
    };
    for (const FailingCase& one : cases)
    {
      for (const Again again : { Again::Update, Again::Refresh, Again::Follow })
      {
        if (again == Again::Update || (this->Size() == 1 && !of_memory(one) && !one.harmless))
        {
          this->FailEach(
            one, [&](int rank, long number) { return tryOne(one, rank, number, again); });
        }
      }
    }
  }

  // ---- writers ---------------------------------------------------------------------------------

  std::string FolderOfTest() const
  {
    return std::string(GRANULAR_OUTPUT) + "/" +
      testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(this->Size());
  }

  /// The old file alone.
  void Begin(const std::string& path)
  {
    if (this->Rank() == 0)
    {
      const std::filesystem::path folder = std::filesystem::path(path).parent_path();
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

  /// Writes all that a reader shows to a file of that name, whatever fails.
  template <class FromReader, class ToWriter>
  void TryWriter(const std::string& from, const std::string& to, bool allFrames = false,
    int mode = ToWriter::GATHER)
  {
    const std::string folder = this->FolderOfTest();
    const std::string path = folder + "/" + to;
    const bool byMpi = this->Size() > 1 && mode == ToWriter::MPI_IO;
    Watched<FromReader> reader;
    this->Open(reader, { from });
    reader->UpdatePiece(this->Rank(), this->Size(), 0);
    const auto connect = [&](Watched<ToWriter>& writer)
    {
      writer->SetInputConnection(reader->GetOutputPort());
      writer->SetFileName(path.c_str());
      writer->SetWriteTimeSteps(allFrames);
      writer->SetParallelMode(mode);
      writer->SetThreads(this->Size() == 1 ? 2 : 1);
    };
    const auto write = [&]
    {
      Watched<ToWriter> writer;
      connect(writer);
      const bool written = writer->Write() == 1;
      this->Wait();
      return written;
    };
    this->Begin(path);
    ASSERT_TRUE(write());
    const std::string whole = bytes_of_file(path);
    ASSERT_NE(whole, Old);
    this->Wait();
    long writtenBut = 0;
    const auto tryOne = [&](const FailingCase& one, int rank, long number)
    {
      this->Begin(path);
      if (one.leaves == Leaves::Older)
      {
        make_fail(leaving_calls(folder));
        EXPECT_FALSE(write());
        stop_failing();
      }
      Watched<ToWriter> writer;
      connect(writer);
      this->Fail(one, rank, number, folder);
      const bool written = writer->Write() == 1;
      stop_failing();
      const long possible = calls_that_may_fail();
      const bool fired = this->OfRank(possible, rank) >= number;
      const std::string last = writer->GetErrorMessage() ? writer->GetErrorMessage() : "";
      EXPECT_EQ(written, writer->GetErrorCode() == 0) << last;
      FailingCase judged = one;
      // Open MPI does not do again what was interrupted
      judged.harmless = !fired || (one.harmless && !(byMpi && one.fault == CallFault::Interrupted));
      this->Judge(judged, rank, !written, last, path);
      EXPECT_TRUE(!judged.harmless || Words(writer.Seen->Said).empty());
      const bool renamed = last.find(": written, but") != std::string::npos;
      writtenBut += renamed ? 1 : 0;
      this->Wait();
      EXPECT_TRUE(bytes_of_file(path) == (written || renamed ? whole : Old)) << last;
      ExpectHidden(folder, one, fired && rank == 0, byMpi);
      this->Wait();
      EXPECT_EQ(writer->Write(), 1) << writer->GetErrorMessage();
      this->Wait();
      EXPECT_TRUE(bytes_of_file(path) == whole);
      EXPECT_TRUE(write()); // by a writer that does not know what the first one has written
      EXPECT_EQ(count_hidden(folder), 0) << last;
      this->Wait();
      reader.Seen->Said = {}; // it may have had no memory, too
      reader.OfPipeline->Said = {};
      return possible;
    };
    for (const FailingCase& one : writer_cases)
    {
      this->FailEach(one, [&](int rank, long number) { return tryOne(one, rank, number); });
    }
    EXPECT_GT(writtenBut, 0) << "of the folder, which is behind the file";
  }

  /// A file waits for the disk twice, for its bytes and for its name, if Durable says so; with Automatic those of a series do not.
  template <class FromReader, class ToWriter>
  void TryDurable(const std::string& from, const std::string& ending)
  {
    this->Begin(this->FolderOfTest() + "/old");
    Watched<FromReader> reader;
    this->Open(reader, { from });
    const auto expectWaits = [&](const std::string& name, int durable, long waits)
    {
      Watched<ToWriter> writer;
      EXPECT_EQ(writer->GetDurable(), ToWriter::DURABLE_AUTOMATIC);
      writer->SetInputConnection(reader->GetOutputPort());
      writer->SetFileName((this->FolderOfTest() + "/" + name + ending).c_str());
      writer->SetDurable(durable);
      make_fail({ CallFault::Error, FailingCalls::always, 1, calls::sync });
      EXPECT_EQ(writer->Write(), 1);
      stop_failing();
      EXPECT_EQ(calls_that_may_fail(), waits) << name << " " << durable;
      EXPECT_EQ(Words(writer.Seen->Said), "");
    };
    for (const bool series : { false, true })
    {
      const std::string name = series ? "many_*" : "one";
      expectWaits(name, ToWriter::DURABLE_AUTOMATIC, series ? 0 : 2);
      expectWaits(name, ToWriter::DURABLE_ON, 2);
      expectWaits(name, ToWriter::DURABLE_OFF, 0);
    }
    Watched<ToWriter> writer;
    writer->SetDurable(3);
    EXPECT_EQ(writer->GetDurable(), ToWriter::DURABLE_AUTOMATIC);
    EXPECT_NE(Words(writer.Seen->Said).find("expected Durable"), std::string::npos);
  }

  granular::MpiCommunicator Ranks{ MPI_COMM_WORLD };
};

/// A process alone: each class, and every call.
class FailingAlone : public FailingClasses
{
protected:
  void SetUp() override
  {
    if (this->Size() > 1)
    {
      GTEST_SKIP() << "several ranks read and write alike";
    }
  }
};
}

TEST_F(FailingClasses, DumpReaderOfText)
{
  this->TryReader<vtkGranularDumpReader>({ "chain.dump" });
}

TEST_F(FailingClasses, DumpWriterOfText)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", "new.dump");
}

TEST_F(FailingClasses, DumpWriterOfBinary)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>(
    "chain.dump", "new.bin", false, vtkGranularDumpWriter::MPI_IO);
}

TEST_F(FailingAlone, DumpReaders)
{
  this->TryReader<vtkGranularDumpReader>({ "ortho_scaled.bin" });
  this->TryReader<vtkGranularDumpReader>({ "ortho_000000.dump.gz", "ortho_000050.dump.gz" });
}

/// Pages for the memory of rows, and threads.
TEST_F(FailingAlone, DumpReaderOfManyRows)
{
  const Folder folder;
  folder.write("made.dump", dump_of_rows(20000));
  this->TryReader<vtkGranularDumpReader>(
    { folder.path("made.dump") }, large_cases, folder.path(""));
}

TEST_F(FailingAlone, LocalReader)
{
  this->TryReader<vtkGranularLocalReader>({ "local/pieces_3000.0.dump", "local/pieces_3000.1.dump",
    "local/pieces_3000.2.dump", "local/pieces_3000.3.dump" });
}

TEST_F(FailingAlone, DataFileReader)
{
  this->TryReader<vtkGranularDataFileReader>({ "data_file/full.data" });
}

TEST_F(FailingAlone, RestartReader)
{
  this->TryReader<vtkGranularRestartReader>({ "restart/half.restart" });
  this->TryReader<vtkGranularRestartReader>({ "restart/parts.base.restart" });
}

TEST_F(FailingAlone, EulerReader)
{
  this->TryReader<vtkGranularEulerReader>({ "euler_1000.vtk", "euler_2000.vtk" });
}

TEST_F(FailingAlone, DecompositionReader)
{
  this->TryReader<vtkGranularDecompositionReader>(
    { "decomposition_1000.vtk", "decomposition_2000.vtk" });
  this->TryReader<vtkGranularDecompositionReader>({ "decomposition/text.vtu" });
}

TEST_F(FailingAlone, DumpWriters)
{
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>("plain.dump", "new.dump", true);
  this->TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", "new.dump.gz");
  this->TryDurable<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", ".dump");
}

TEST_F(FailingAlone, LocalWriter)
{
  this->TryWriter<vtkGranularLocalReader, vtkGranularLocalWriter>(
    "local/contacts.dump", "new.bonds");
  this->TryDurable<vtkGranularLocalReader, vtkGranularLocalWriter>("local/contacts.dump", ".bonds");
}

TEST_F(FailingAlone, EulerWriter)
{
  this->TryWriter<vtkGranularEulerReader, vtkGranularEulerWriter>("euler_1000.vtk", "new.euler");
  this->TryDurable<vtkGranularEulerReader, vtkGranularEulerWriter>("euler_1000.vtk", ".euler");
}

TEST_F(FailingAlone, DecompositionWriter)
{
  this->TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.decomposition");
  this->TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.vtu");
  this->TryDurable<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", ".decomposition");
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
