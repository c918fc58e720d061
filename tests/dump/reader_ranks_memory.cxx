// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: each allocation of an update fails once, on each rank. All ranks must go on together, and
// say the same. The operators new here are those of all libraries of the program.
#include "reader_ranks.h"

#include "vtkObjectFactory.h"

#include <cstdlib>
#include <cstring>
#include <functional>
#include <new>

#include <dlfcn.h>

namespace
{
thread_local long Left = 0; ///< allocations until one fails, if not 0
thread_local bool Armed = false;

/// VTK's own objects do not bear that their constructors throw.
bool IsOfVtk(const void* caller)
{
  Dl_info library = {};
  const bool found = dladdr(caller, &library) != 0 && library.dli_fname;
  return found && std::strstr(library.dli_fname, "libvtk") &&
    !std::strstr(library.dli_fname, "libvtkGranular");
}

/// Null where memory has run out.
void* Allocate(std::size_t size, const void* caller) noexcept
{
  const bool refused = Armed && Left > 0 && !IsOfVtk(caller) && --Left == 0;
  return refused ? nullptr : std::malloc(size > 0 ? size : 1);
}
}

[[gnu::noinline]] void* operator new(std::size_t size)
{
  if (void* memory = Allocate(size, __builtin_return_address(0)))
  {
    return memory;
  }
  throw std::bad_alloc();
}

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  return Allocate(size, __builtin_return_address(0));
}

[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace
{
/// A reader in whose own work, not VTK's around it, memory may run out.
class ScarceReader : public vtkGranularDumpReader
{
public:
  static ScarceReader* New();
  vtkTypeMacro(ScarceReader, vtkGranularDumpReader);

protected:
  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** in,
    vtkInformationVector* out, int port, vtkMTimeType* mtime) override
  {
    return Scarce(
      [&] { return this->Superclass::ComputePipelineMTime(request, in, out, port, mtime); });
  }

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override
  {
    return Scarce([&] { return this->Superclass::RequestInformation(request, in, out); });
  }

  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override
  {
    return Scarce([&] { return this->Superclass::RequestData(request, in, out); });
  }

private:
  static int Scarce(const std::function<int()>& work)
  {
    Armed = true;
    const int result = work();
    Armed = false;
    return result;
  }
};
vtkStandardNewMacro(ScarceReader);

class ScarceMemory : public ReaderRanks
{
protected:
  static bool IsThere(ScarceReader* reader)
  {
    return reader->GetOutput()->GetPointData()->GetNumberOfArrays() > 0;
  }

  /// Lets allocations of an update fail in turn, every third, others on each rank: the ranks do much the same.
  void Check(const std::function<void(ScarceReader*)>& prepare,
    const std::function<void(ScarceReader*)>& update)
  {
    for (int rank = 0; rank < this->Size(); ++rank)
    {
      int failed = 0;
      bool all = false;
      for (long count = 1 + rank; !all; count += 3)
      {
        vtkNew<ScarceReader> reader;
        vtkNew<Messages> said;
        vtkNew<Messages> ofPipeline;
        reader->AddObserver(vtkCommand::ErrorEvent, said);
        reader->AddObserver(vtkCommand::WarningEvent, said);
        reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, ofPipeline);
        prepare(reader);
        Left = this->Rank() == rank ? count : 0;
        update(reader);
        all = this->OnAny(this->Rank() == rank && Left > 0);
        Left = 0;
        std::string text = std::to_string(reader->GetErrorCode());
        for (const std::string& error : said->Errors)
        {
          text += ": " + error;
        }
        this->ExpectSame(text);
        failed += said->Errors.empty() ? 0 : 1;
        const bool whole = IsThere(reader);
        EXPECT_EQ(whole, said->Errors.empty()) << text;
        EXPECT_EQ(this->OnAny(whole), whole);
        reader->Refresh();
        update(reader);
        EXPECT_TRUE(IsThere(reader)) << reader->GetErrorCode();
        if (this->HasFailure())
        {
          std::cout << "rank " << rank << ", allocation " << count << ": " << text << std::endl;
          all = true;
        }
        all = this->OnAny(all);
      }
      EXPECT_GT(failed, 10);
    }
  }

  void UpdateFirst(ScarceReader* reader) { reader->UpdatePiece(this->Rank(), this->Size(), 0); }
};
}

TEST_F(ScarceMemory, OfAFirstUpdate)
{
  Write("warm.dump", GrainsFrame(0, 10));
  Write("run.dump",
    Frame(0, 6, "id x y z element tag",
      "1 0 0 0 H 1\n2 0 0 0 H 2\n3 0 0 0 H 3\n"
      "4 0 0 0 H 4\n5 0 0 0 H 5\n6 0 0 0 O no\n"));
  this->Check(
    [](ScarceReader* reader)
    {
      // the ranks have met
      reader->AddFileName("warm.dump");
      reader->UpdateInformation();
      reader->ClearFileNames();
      reader->AddFileName("run.dump");
    },
    [&](ScarceReader* reader) { this->UpdateFirst(reader); });
}

TEST_F(ScarceMemory, OfSorting)
{
  Write("run.dump", GrainsFrame(0, 10));
  this->Check(
    [](ScarceReader* reader)
    {
      reader->AddFileName("run.dump");
      reader->SortByIdOn();
      reader->UpdateInformation();
    },
    [&](ScarceReader* reader) { this->UpdateFirst(reader); });
}

TEST_F(ScarceMemory, OfARefreshByEachAlone)
{
  Write("run.dump", GrainsFrame(0, 10) + GrainsFrame(1, 20));
  this->Check(
    [](ScarceReader* reader)
    {
      reader->AddFileName("run.dump");
      reader->RefreshOnUpdateOn();
      reader->UpdateInformation();
    },
    [&](ScarceReader* reader) { reader->UpdateTimeStep(this->Rank() == 1 ? 1 : 0); });
}

int main(int argc, char** argv)
{
  return RunWithController(argc, argv);
}
