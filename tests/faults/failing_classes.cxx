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

#include "../support/dumps.h"
#include "../support/failing_calls.h"
#include "../support/observer.h"
#include "fault_numbers.h"
#include "reader_content.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace
{
// ---- faults ------------------------------------------------------------------------------------

/// A fault, and whether nothing may be seen of it.
struct Case
{
  const char* Name;
  unsigned Kinds;
  CallFault Fault;
  int Error = EIO;
  bool Harmless = false;
};

constexpr Case Reading[] = {
  { "a read gives nothing", calls::reading, CallFault::End },
  { "a call fails", calls::reading, CallFault::Error },
  { "a read gives one byte", calls::read, CallFault::Short, 0, true },
  { "a call is interrupted", calls::reading, CallFault::Interrupted, 0, true },
  { "closing fails", calls::close, CallFault::Error, EIO, true },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM },
  { "pages are refused", calls::map, CallFault::Error, ENOMEM },
  { "a thread is refused", calls::thread, CallFault::Error, EAGAIN, true },
};

constexpr Case Writing[] = {
  { "a file cannot be asked", calls::stat, CallFault::Error },
  { "no file can be made", calls::create, CallFault::Error, ENOSPC },
  { "the disk is full", calls::write, CallFault::Error, ENOSPC },
  { "one byte is written", calls::write, CallFault::Short, 0, true },
  { "a call is interrupted", calls::create | calls::write | calls::close, CallFault::Interrupted, 0,
    true },
  { "closing fails", calls::close, CallFault::Error },
  { "renaming fails", calls::rename, CallFault::Error, EACCES },
  { "the disk takes nothing", calls::sync, CallFault::Error },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM },
  { "pages are refused", calls::map, CallFault::Error, ENOMEM },
  { "a thread is refused", calls::thread, CallFault::Error, EAGAIN, true },
};

constexpr long MostOfMemory = 30; ///< calls that are tried, where not all are wanted

bool OfMemory(const Case& one)
{
  return (one.Kinds & (calls::memory | calls::map)) != 0;
}

FailingCalls Failing(const Case& one, long number, const std::string& folder)
{
  FailingCalls failing = { one.Fault, number, 1, one.Kinds, one.Error };
  failing.folder = folder.c_str();
  failing.caller = OfMemory(one) ? "libvtkGranular" : nullptr;
  return failing;
}

/// Calls use(number) until it returns fewer calls than that.
void FailEach(const Case& one, FaultCount& faults, const std::function<long(long number)>& use)
{
  long made = 0;
  bool fired = true;
  for (long number = 1; fired && !testing::Test::HasFailure();)
  {
    SCOPED_TRACE(std::string(one.Name) + ", call " + std::to_string(number));
    const long files = open_files();
    const long possible = use(number);
    EXPECT_EQ(open_files(), files) << "files are left open";
    made = std::max(made, possible);
    fired = possible >= number;
    faults.add(fired);
    number = OfMemory(one) ? next_number(number, made, MostOfMemory) : number + 1;
  }
}

// ---- readers -----------------------------------------------------------------------------------

const std::string Good = std::string(GRANULAR_DATA) + "/good/";

template <class Algorithm>
void Open(Watched<Algorithm>& reader, const std::vector<std::string>& files)
{
  for (const std::string& file : files)
  {
    reader->AddFileName((Good + file).c_str());
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

/// Fails a call of an update. Returns how many there were that might.
template <class Algorithm>
long TryOne(const std::vector<std::string>& files, const Case& one, long number, Again again,
  const std::string& whole, std::size_t said)
{
  Watched<Algorithm> reader;
  Open(reader, files);
  reader->SetRefreshOnUpdate(again == Again::Follow);
  make_fail(Failing(one, number, Good));
  reader->Update();
  stop_failing();
  const long possible = calls_that_may_fail();
  const std::vector<std::string>& messages = reader.Seen->Said;
  const std::string last = messages.empty() ? "" : messages.back();
  const bool failed = reader->GetErrorCode() != 0;
  EXPECT_TRUE(failed || messages.size() > said || Content(reader.Get) == whole);
  EXPECT_TRUE(!failed || (!messages.empty() && IsEmpty(reader.Get))) << last;
  EXPECT_TRUE(!failed || OfMemory(one) || last.find(Good) != std::string::npos) << last;
  EXPECT_TRUE(!one.Harmless || !failed) << last;
  if (again == Again::Refresh)
  {
    reader->Refresh();
  }
  reader->Update();
  const bool looks = failed || again != Again::Update;
  EXPECT_TRUE(!looks || (reader->GetErrorCode() == 0 && Content(reader.Get) == whole))
    << "again " << static_cast<int>(again) << " after " << last << ": "
    << (messages.empty() ? "" : messages.back());
  return possible;
}

template <class Algorithm>
void TryAll(const std::vector<std::string>& files)
{
  Watched<Algorithm> undisturbed;
  Open(undisturbed, files);
  undisturbed->Update();
  const std::string whole = Content(undisturbed.Get);
  const std::size_t said = undisturbed.Seen->Said.size();
  ASSERT_EQ(undisturbed->GetErrorCode(), 0u);
  FaultCount faults;
  for (const Case& one : Reading)
  {
    for (const Again again : { Again::Update, Again::Refresh, Again::Follow })
    {
      if (again == Again::Update || (!OfMemory(one) && !one.Harmless))
      {
        FailEach(one, faults,
          [&](long number) { return TryOne<Algorithm>(files, one, number, again, whole, said); });
      }
    }
  }
}

// ---- writers -----------------------------------------------------------------------------------

constexpr const char* Old = "what was there before";

std::string BytesOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
}

/// Writes all that a reader shows to a file of that name, whatever fails.
template <class FromReader, class ToWriter>
void TryWriter(const std::string& from, const std::string& to, bool allFrames = false)
{
  const Folder folder;
  Watched<FromReader> reader;
  Open(reader, { from });
  reader->Update();
  const std::string path = folder.path(to);
  const auto open = [&](Watched<ToWriter>& writer)
  {
    writer->SetInputConnection(reader->GetOutputPort());
    writer->SetFileName(path.c_str());
    writer->SetWriteTimeSteps(allFrames);
    writer->SetThreads(2);
  };
  Watched<ToWriter> undisturbed;
  open(undisturbed);
  ASSERT_EQ(undisturbed->Write(), 1);
  const std::string whole = BytesOf(path);
  ASSERT_FALSE(whole.empty());
  FaultCount faults;
  for (const Case& one : Writing)
  {
    FailEach(one, faults,
      [&](long number)
      {
        folder.write(to, Old);
        Watched<ToWriter> writer;
        open(writer);
        make_fail(Failing(one, number, folder.path("")));
        const bool written = writer->Write() == 1;
        stop_failing();
        const long possible = calls_that_may_fail();
        const std::string last = writer.Seen->Said.empty() ? "" : writer.Seen->Said.back();
        EXPECT_EQ(written, writer->GetErrorCode() == 0) << last;
        EXPECT_TRUE(written || OfMemory(one) || last.find(path) != std::string::npos) << last;
        EXPECT_TRUE(written || !last.empty());
        EXPECT_TRUE(!one.Harmless || written) << last;
        const bool renamed = last.find(": written, but") != std::string::npos;
        EXPECT_TRUE(BytesOf(path) == (written || renamed ? whole : Old)) << last;
        EXPECT_EQ(names_in(folder.path("")), to) << last;
        EXPECT_EQ(writer->Write(), 1);
        EXPECT_TRUE(BytesOf(path) == whole);
        return possible;
      });
  }
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
}

TEST(FailingClasses, LocalWriter)
{
  TryWriter<vtkGranularLocalReader, vtkGranularLocalWriter>("local/contacts.dump", "new.bonds");
}

TEST(FailingClasses, EulerWriter)
{
  TryWriter<vtkGranularEulerReader, vtkGranularEulerWriter>("euler_1000.vtk", "new.euler");
}

TEST(FailingClasses, DecompositionWriter)
{
  TryWriter<vtkGranularDecompositionReader, vtkGranularDecompositionWriter>(
    "decomposition_1000.vtk", "new.decomposition");
}
