// SPDX-License-Identifier: BSD-3-Clause
// Calls of the system that fail once, through each VTK class that reads or writes: an error event names the file, the output is
// empty, and the next update looks again. The reference is what a class gives that was not disturbed. Memory is refused where our
// library asks for it; VTK does not survive everywhere that its own is.
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
#include "failing_cases.h"
#include "reader_content.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace
{
// ---- faults ------------------------------------------------------------------------------------

constexpr long MostOfMemory = 20; ///< calls that are tried, where not all are wanted

FailingCalls Failing(const FailingCase& one, long number, const std::string& folder)
{
  FailingCalls failing = failing_calls_of(one, number, folder);
  failing.caller = of_memory(one) ? "libvtkGranular" : nullptr;
  return failing;
}

/// Calls use(number) for each call that may fail in a way, which must come up.
void FailEach(
  const FailingCase& one, FaultCount& faults, const std::function<long(long number)>& use)
{
  expect_delivered(one.name, fail_each(one.name, of_memory(one) ? MostOfMemory : 0, faults, use));
}

// ---- readers -----------------------------------------------------------------------------------

const std::string Good = std::string(GRANULAR_DATA) + "/good/";

/// Of tests/data/good, or with their whole path.
template <class Algorithm>
void Open(Watched<Algorithm>& reader, const std::vector<std::string>& files)
{
  for (const std::string& file : files)
  {
    reader->AddFileName((file.starts_with('/') ? file : Good + file).c_str());
  }
  reader->SetThreads(2);
}

/// What may be done where an update has failed.
enum class Again
{
  Update,  ///< another update
  Refresh, ///< one after Refresh
  Follow   ///< one that looks whether files have changed
};

/// Files, and what a reader shows of them that was not disturbed.
struct Whole
{
  std::vector<std::string> Files;
  std::string Folder;
  std::string Content;
  std::vector<std::string> Said;
};

/// Fails a call of an update. Returns how many there were that might.
template <class Algorithm>
long TryOne(const Whole& whole, const FailingCase& one, long number, Again again)
{
  Watched<Algorithm> reader;
  Open(reader, whole.Files);
  reader->SetRefreshOnUpdate(again == Again::Follow);
  make_fail(Failing(one, number, whole.Folder));
  reader->Update();
  stop_failing();
  const long possible = calls_that_may_fail();
  const std::vector<std::string>& messages = reader.Seen->Said;
  const std::string last = messages.empty() ? "" : messages.back();
  const bool failed = reader->GetErrorCode() != 0;
  const bool told = failed || messages.size() > whole.Said.size();
  EXPECT_TRUE(told || Content(reader.Get) == whole.Content);
  EXPECT_TRUE(!failed || (!messages.empty() && IsEmpty(reader.Get))) << last;
  EXPECT_TRUE(!failed || of_memory(one) || last.find(whole.Folder) != std::string::npos) << last;
  if (one.harmless || possible < number)
  {
    EXPECT_TRUE(!failed && Content(reader.Get) == whole.Content) << last;
    EXPECT_EQ(Words(messages), Words(whole.Said));
  }
  if (again == Again::Refresh)
  {
    reader->Refresh();
  }
  reader->Update();
  const bool looks = failed || again != Again::Update;
  EXPECT_TRUE(!looks || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole.Content))
    << "again " << static_cast<int>(again) << " after " << last << ": "
    << (messages.empty() ? "" : messages.back());
  return possible;
}

template <class Algorithm>
void TryAll(const std::vector<std::string>& files,
  std::span<const FailingCase> cases = reader_cases, const std::string& folder = Good)
{
  Watched<Algorithm> undisturbed;
  Open(undisturbed, files);
  undisturbed->Update();
  const Whole whole = { files, folder, Content(undisturbed.Get), undisturbed.Seen->Said };
  ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
  FaultCount faults;
  for (const FailingCase& one : cases)
  {
    for (const Again again : { Again::Update, Again::Refresh, Again::Follow })
    {
      if (again == Again::Update || (!of_memory(one) && !one.harmless))
      {
        FailEach(
          one, faults, [&](long number) { return TryOne<Algorithm>(whole, one, number, again); });
      }
    }
  }
}

// ---- writers -----------------------------------------------------------------------------------

constexpr const char* Old = "what was there before";

/// Writes all that a reader shows to a file of that name, whatever fails.
template <class FromReader, class ToWriter>
class WriterTrial
{
public:
  WriterTrial(const std::string& from, std::string to, bool allFrames = false)
    : To(std::move(to))
    , Path(Own.path(To))
    , AllFrames(allFrames)
  {
    Open(this->Reader, { from });
    this->Reader->Update();
  }

  void Run()
  {
    Watched<ToWriter> undisturbed;
    this->Connect(undisturbed);
    ASSERT_EQ(undisturbed->Write(), 1);
    this->Whole = bytes_of_file(this->Path);
    ASSERT_FALSE(this->Whole.empty());
    this->Said = undisturbed.Seen->Said;
    FaultCount faults;
    for (const FailingCase& one : writer_cases)
    {
      FailEach(one, faults, [&](long number) { return this->TryOne(one, number); });
    }
    EXPECT_GT(this->WrittenBut, 0) << "of the folder, which is behind the file";
  }

private:
  void Connect(Watched<ToWriter>& writer)
  {
    writer->SetInputConnection(this->Reader->GetOutputPort());
    writer->SetFileName(this->Path.c_str());
    writer->SetWriteTimeSteps(this->AllFrames);
    writer->SetThreads(2);
  }

  void Begin(const FailingCase& one)
  {
    this->Own.write(this->To, Old);
    if (one.leaves == Leaves::Older)
    {
      Watched<ToWriter> writer;
      this->Connect(writer);
      make_fail(leaving_calls(this->Folder));
      EXPECT_EQ(writer->Write(), 0);
      stop_failing();
    }
  }

  long TryOne(const FailingCase& one, long number)
  {
    this->Begin(one);
    Watched<ToWriter> writer;
    this->Connect(writer);
    make_fail(Failing(one, number, this->Folder));
    const bool written = writer->Write() == 1;
    stop_failing();
    const long possible = calls_that_may_fail();
    const bool fired = possible >= number;
    const std::string last = writer.Seen->Said.empty() ? "" : writer.Seen->Said.back();
    EXPECT_EQ(written, writer->GetErrorCode() == 0) << last;
    EXPECT_TRUE(written || of_memory(one) || last.find(this->Path) != std::string::npos) << last;
    EXPECT_TRUE(written || !last.empty());
    if (one.harmless || !fired)
    {
      EXPECT_TRUE(written) << last;
      EXPECT_EQ(Words(writer.Seen->Said), Words(this->Said));
    }
    const bool renamed = last.find(": written, but") != std::string::npos;
    this->WrittenBut += renamed ? 1 : 0;
    EXPECT_TRUE(bytes_of_file(this->Path) == (written || renamed ? this->Whole : Old)) << last;
    EXPECT_EQ(count_hidden(this->Folder), fired && one.leaves != Leaves::Nothing ? 1 : 0) << last;
    EXPECT_EQ(writer->Write(), 1);
    EXPECT_TRUE(bytes_of_file(this->Path) == this->Whole);
    if (one.leaves != Leaves::Nothing)
    {
      Watched<ToWriter> other; // which does not know what the first one has written
      this->Connect(other);
      EXPECT_EQ(other->Write(), 1);
    }
    EXPECT_EQ(names_in(this->Folder), this->To) << last;
    this->Reader.Seen->Said = {}; // it may have had no memory, too
    this->Reader.OfPipeline->Said = {};
    return possible;
  }

  ::Folder Own;
  Watched<FromReader> Reader;
  std::string To;
  std::string Path;
  std::string Folder = without_slash(Own.path(""));
  bool AllFrames;
  std::string Whole;
  std::vector<std::string> Said;
  long WrittenBut = 0;
};

template <class FromReader, class ToWriter>
void TryWriter(const std::string& from, const std::string& to, bool allFrames = false)
{
  WriterTrial<FromReader, ToWriter>(from, to, allFrames).Run();
}

/// A file waits for the disk twice, for its bytes and for its name, if Durable says so; with Automatic those of a series do not.
template <class FromReader, class ToWriter>
void TryDurable(const std::string& from, const std::string& ending)
{
  const Folder folder;
  Watched<FromReader> reader;
  Open(reader, { from });
  const auto expectWaits = [&](const std::string& name, int durable, long waits)
  {
    Watched<ToWriter> writer;
    EXPECT_EQ(writer->GetDurable(), ToWriter::DURABLE_AUTOMATIC);
    writer->SetInputConnection(reader->GetOutputPort());
    writer->SetFileName(folder.path(name + ending).c_str());
    writer->SetDurable(durable);
    make_fail({ CallFault::Error, FailingCalls::always, 1, calls::sync });
    EXPECT_EQ(writer->Write(), 1);
    stop_failing();
    EXPECT_EQ(calls_that_may_fail(), waits) << name << " " << durable;
    EXPECT_EQ(Words(writer.Seen->Said), "");
  };
  expectWaits("one", ToWriter::DURABLE_AUTOMATIC, 2);
  expectWaits("one", ToWriter::DURABLE_ON, 2);
  expectWaits("one", ToWriter::DURABLE_OFF, 0);
  expectWaits("many_*", ToWriter::DURABLE_AUTOMATIC, 0);
  expectWaits("many_*", ToWriter::DURABLE_ON, 2);
  expectWaits("many_*", ToWriter::DURABLE_OFF, 0);
  Watched<ToWriter> writer;
  writer->SetDurable(3);
  EXPECT_EQ(writer->GetDurable(), ToWriter::DURABLE_AUTOMATIC);
  EXPECT_NE(Words(writer.Seen->Said).find("expected Durable"), std::string::npos);
}
}

TEST(FailingClasses, DumpReaderOfText)
{
  TryAll<vtkGranularDumpReader>({ "chain.dump" });
}

TEST(FailingClasses, DumpReaderOfBinary)
{
  TryAll<vtkGranularDumpReader>({ "ortho_scaled.bin" });
}

TEST(FailingClasses, DumpReaderOfCompressed)
{
  TryAll<vtkGranularDumpReader>({ "ortho_000000.dump.gz", "ortho_000050.dump.gz" });
}

/// Pages for the memory of rows, and threads.
TEST(FailingClasses, DumpReaderOfManyRows)
{
  const Folder folder;
  folder.write("made.dump", dump_of_rows(20000));
  TryAll<vtkGranularDumpReader>({ folder.path("made.dump") }, large_cases, folder.path(""));
}

TEST(FailingClasses, LocalReader)
{
  TryAll<vtkGranularLocalReader>({ "local/pieces_3000.0.dump", "local/pieces_3000.1.dump",
    "local/pieces_3000.2.dump", "local/pieces_3000.3.dump" });
}

TEST(FailingClasses, DataFileReader)
{
  TryAll<vtkGranularDataFileReader>({ "data_file/full.data" });
}

TEST(FailingClasses, RestartReader)
{
  TryAll<vtkGranularRestartReader>({ "restart/half.restart" });
  TryAll<vtkGranularRestartReader>({ "restart/parts.base.restart" });
}

TEST(FailingClasses, EulerReader)
{
  TryAll<vtkGranularEulerReader>({ "euler_1000.vtk", "euler_2000.vtk" });
}

TEST(FailingClasses, DecompositionReader)
{
  TryAll<vtkGranularDecompositionReader>({ "decomposition_1000.vtk", "decomposition_2000.vtk" });
  TryAll<vtkGranularDecompositionReader>({ "decomposition/text.vtu" });
}

TEST(FailingClasses, DumpWriter)
{
  TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>("plain.dump", "new.dump", true);
  TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", "new.bin");
  TryWriter<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", "new.dump.gz");
  TryDurable<vtkGranularDumpReader, vtkGranularDumpWriter>("chain.dump", ".dump");
}

TEST(FailingClasses, LocalWriter)
{
  TryWriter<vtkGranularLocalReader, vtkGranularLocalWriter>("local/contacts.dump", "new.bonds");
  TryDurable<vtkGranularLocalReader, vtkGranularLocalWriter>("local/contacts.dump", ".bonds");
}

TEST(FailingClasses, EulerWriter)
{
  TryWriter<vtkGranularEulerReader, vtkGranularEulerWriter>("euler_1000.vtk", "new.euler");
  TryDurable<vtkGranularEulerReader, vtkGranularEulerWriter>("euler_1000.vtk", ".euler");
}

TEST(FailingClasses, DecompositionWriter)
{
  TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.decomposition");
  TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.vtu");
  TryDurable<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", ".decomposition");
}
