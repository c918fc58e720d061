// SPDX-License-Identifier: BSD-3-Clause
// Damaged copies of good files through the VTK readers, thousands in one process, through the same readers one after the other, as by
// a user who opens many files. Arguments: the seed, the first copy and the number of copies of each file, then files and folders. A
// copy depends on its number alone. Each copy must end within 10 s of processors, in memory of at most 20 times its files and 256 MiB, with valid
// outputs, or empty ones and an error that names the file. A crash, a hang, or anything else is a failure, told with the copy.
#include "../support/byte_source_packing.h"
#include "../support/file_damage.h"
#include "../support/largest_request.h"
#include "valid_outputs.h"

#include "granular/bytes/byte_source.h"

#include "vtkGranularDataFileReader.h"
#include "vtkGranularDecompositionReader.h"
#include "vtkGranularDumpReader.h"
#include "vtkGranularEulerReader.h"
#include "vtkGranularLocalReader.h"
#include "vtkGranularRestartReader.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <time.h>

namespace
{
namespace fs = std::filesystem;
using file_damage::below;
using file_damage::Random;

constexpr double longest = 10;       // s of processors
constexpr double longest_wait = 100; // s, on a machine that does much else
constexpr std::size_t most_times_of_files = 20;
constexpr std::size_t most_beside = std::size_t{ 256 } << 20;

void Require(bool holds, const std::string& what)
{
  if (!holds)
  {
    throw std::runtime_error(what);
  }
}

bool Once(Random& random, std::size_t times)
{
  return below(random, times) == 0;
}

// ---- limits ------------------------------------------------------------------------------------

double Seconds(clockid_t clock)
{
  timespec now = {};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What is done now, for who finds it hung or dead.
struct Now
{
  std::string What;
  std::atomic<bool> Busy{ false };
  double Start = 0;       ///< of CLOCK_MONOTONIC
  double StartOfWork = 0; ///< of CLOCK_PROCESS_CPUTIME_ID

  void Begin()
  {
    this->Start = Seconds(CLOCK_MONOTONIC);
    this->StartOfWork = Seconds(CLOCK_PROCESS_CPUTIME_ID);
    this->Busy = true;
  }
  double Worked() const { return Seconds(CLOCK_PROCESS_CPUTIME_ID) - this->StartOfWork; }
  double Waited() const { return Seconds(CLOCK_MONOTONIC) - this->Start; }
};

/// Ends the process when a copy takes too long.
class Watchdog
{
public:
  explicit Watchdog(const Now& now)
    : Thread([this, &now] { this->Watch(now); })
  {
  }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  ~Watchdog()
  {
    this->Ended = true;
    this->Thread.join();
  }

private:
  void Watch(const Now& now)
  {
    while (!this->Ended)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (now.Busy && (now.Worked() > longest || now.Waited() > longest_wait))
      {
        std::fprintf(stderr, "%s: longer than %g s of processors, or than %g s\n", now.What.c_str(),
          longest, longest_wait);
        std::_Exit(3);
      }
    }
  }

  std::atomic<bool> Ended{ false };
  std::thread Thread;
};

/// Memory of this process, in bytes, now and at most since reset.
class ResidentMemory
{
public:
  ResidentMemory() { this->Reset(); }

  void Reset()
  {
    std::ofstream("/proc/self/clear_refs") << "5";
    this->Base = Read("VmRSS:");
    largest_request = 0;
  }

  std::size_t Risen() const
  {
    const std::size_t peak = Read("VmHWM:");
    return std::max(peak > this->Base ? peak - this->Base : 0, largest_request);
  }

private:
  static std::size_t Read(const std::string& name)
  {
    std::ifstream status("/proc/self/status");
    std::size_t kibibytes = 0;
    for (std::string word; status >> word && word != name;)
    {
    }
    status >> kibibytes;
    return kibibytes * 1024;
  }

  std::size_t Base = 0;
};

// ---- readers -----------------------------------------------------------------------------------

/// Keeps what is said.
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }
  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings)
      .emplace_back(static_cast<const char*>(data));
  }
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

/// What nobody observes: readers say all by their own events.
class Unheard : public vtkOutputWindow
{
public:
  static Unheard* New();
  vtkTypeMacro(Unheard, vtkOutputWindow);
  void DisplayText(const char* text) override { this->Said += text; }
  std::string Said;
};
vtkStandardNewMacro(Unheard);

void Choose(vtkDataArraySelection* arrays, Random& random)
{
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    arrays->SetArraySetting(arrays->GetArrayName(i), Once(random, 3) ? 0 : 1);
  }
}

using SetUp = void (*)(vtkGranularSeriesReader& reader, Random& random);

void SetUpDump(vtkGranularSeriesReader& base, Random& random)
{
  constexpr const char* names[] = { "", "", "id type x y z",
    "id type x y z ix iy iz vx vy vz radius element", "id type xs ys zs ix iy iz", "a b c d e" };
  auto& reader = static_cast<vtkGranularDumpReader&>(base);
  reader.SetColumnNames(names[below(random, std::size(names))]);
  reader.SetCoordinates(static_cast<int>(below(random, 3)));
  reader.SetPointPrecision(static_cast<int>(below(random, 2)));
  reader.SetSortById(Once(random, 2));
  reader.SetVertices(static_cast<int>(below(random, 3)));
  reader.SetStride(Once(random, 3) ? 3 : 1);
  reader.SetPointOrigin(Once(random, 3) ? 1e3 : 0, 0, 0);
  reader.SetRegionOfInterest(Once(random, 3) ? 0 : 1, Once(random, 2) ? 0.05 : -1, 1, -1, 1, -1);
  Choose(reader.GetPointDataArraySelection(), random);
}

void SetUpLocal(vtkGranularSeriesReader& base, Random& random)
{
  auto& reader = static_cast<vtkGranularLocalReader&>(base);
  reader.SetPreset(Once(random, 2) ? 0 : static_cast<int>(below(random, 13)));
  reader.SetPeriodicLines(static_cast<int>(below(random, 3)));
  Choose(reader.GetCellDataArraySelection(), random);
}

void SetUpDataFile(vtkGranularSeriesReader& base, Random& random)
{
  constexpr const char* styles[] = { "", "", "sphere", "full", "ellipsoid", "hybrid sphere bond" };
  constexpr const char* boundaries[] = { "", "p p p", "f f f" };
  auto& reader = static_cast<vtkGranularDataFileReader&>(base);
  reader.SetAtomStyle(styles[below(random, std::size(styles))]);
  reader.SetBoundary(boundaries[below(random, std::size(boundaries))]);
  reader.SetCoordinates(static_cast<int>(below(random, 3)));
  reader.SetPeriodicLines(static_cast<int>(below(random, 3)));
  reader.SetSortById(Once(random, 2));
  reader.SetStride(Once(random, 3) ? 3 : 1);
  Choose(reader.GetPointDataArraySelection(), random);
  Choose(reader.GetCellDataArraySelection(), random);
}

void SetUpEuler(vtkGranularSeriesReader& base, Random& random)
{
  auto& reader = static_cast<vtkGranularEulerReader&>(base);
  reader.SetOutputType(static_cast<int>(below(random, 2)));
  Choose(reader.GetPointDataArraySelection(), random);
}

void SetUpDecomposition(vtkGranularSeriesReader& base, Random& random)
{
  auto& reader = static_cast<vtkGranularDecompositionReader&>(base);
  reader.SetCheckOverlap(static_cast<int>(below(random, 3)));
  reader.SetCheckGaps(static_cast<int>(below(random, 3)));
}

void SetUpRestart(vtkGranularSeriesReader& base, Random& random)
{
  auto& reader = static_cast<vtkGranularRestartReader&>(base);
  reader.SetHistoryLayout(Once(random, 2) ? 0 : static_cast<int>(below(random, 6)));
  reader.SetPeriodicLines(static_cast<int>(below(random, 3)));
  Choose(reader.GetPointDataArraySelection(), random);
  Choose(reader.GetCellDataArraySelection(), random);
}

/// A reader that lives as long as the process.
struct Reader
{
  const char* Name;
  int (*CanRead)(const char*);
  SetUp Set;
  vtkSmartPointer<vtkGranularSeriesReader> Get;
  vtkNew<Listener> Said;
  vtkNew<Listener> OfPipeline;

  template <class Type>
  static std::unique_ptr<Reader> Make(const char* name, SetUp set)
  {
    auto reader = std::make_unique<Reader>();
    reader->Name = name;
    reader->CanRead = &Type::CanReadFile;
    reader->Set = set;
    reader->Get = vtkSmartPointer<Type>::New();
    reader->Get->AddObserver(vtkCommand::ErrorEvent, reader->Said);
    reader->Get->AddObserver(vtkCommand::WarningEvent, reader->Said);
    reader->Get->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, reader->OfPipeline);
    return reader;
  }
};

struct Counts
{
  std::size_t Read = 0;
  std::size_t Refused = 0;
  std::size_t Memory = 0; ///< bytes beyond those before
  std::string MemoryOf;
  double Time = 0; ///< s of processors
  std::string TimeOf;
  std::map<std::string, std::size_t> ByReader;
};

/// One update: valid outputs, or an error and empty ones. What an error is about must be named.
void UpdateAndCheck(
  Reader& reader, const std::function<void()>& update, const fs::path& folder, Counts& counts)
{
  for (Listener* listener : { reader.Said.Get(), reader.OfPipeline.Get() })
  {
    listener->Errors.clear();
    listener->Warnings.clear();
  }
  update();
  const bool failed = reader.Get->GetErrorCode() != vtkErrorCode::NoError;
  const std::string message = reader.Get->GetErrorMessage();
  Require(failed != message.empty(),
    "an error without a message, or a message without an error: " + message);
  Require(failed || reader.Said->Errors.empty(), "an error was told, but nothing failed");
  Require(!failed || message.find(folder.string()) != std::string::npos,
    "an error that names no file: " + message);
  for (int port = 0; port < reader.Get->GetNumberOfOutputPorts(); ++port)
  {
    const std::string wrong = WrongIn(reader.Get->GetOutputDataObject(port), failed);
    Require(wrong.empty(), "output " + std::to_string(port) + ": " + wrong);
  }
  ++(failed ? counts.Refused : counts.Read);
  counts.ByReader[reader.Name] += failed ? 0 : 1;
}

/// Any of the times that it offers; 0: it offers none.
double TimeOf(vtkGranularSeriesReader& reader, Random& random)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const information = reader.GetOutputInformation(0);
  const int steps =
    information->Has(Pipeline::TIME_STEPS()) ? information->Length(Pipeline::TIME_STEPS()) : 0;
  return steps == 0 ? 0
                    : information->Get(Pipeline::TIME_STEPS(),
                        static_cast<int>(below(random, static_cast<std::size_t>(steps))));
}

/// A user of that reader: opens, looks at some times and pieces, changes properties.
void Use(Reader& reader, const std::vector<std::string>& paths, const fs::path& folder,
  Random& random, Counts& counts)
{
  vtkGranularSeriesReader& get = *reader.Get;
  get.ClearFileNames();
  for (const std::string& path : paths)
  {
    get.AddFileName(path.c_str());
  }
  get.Refresh(); // the names are those of the copy before
  get.SetThreads(static_cast<int>(below(random, 4)));
  get.SetRepeatedSteps(static_cast<int>(below(random, 3)));
  get.SetTimestepSize(Once(random, 8) ? 1e300 : 1e-5);
  reader.Set(get, random);
  const auto check = [&](const std::function<void()>& update)
  { UpdateAndCheck(reader, update, folder, counts); };
  check([&] { get.UpdateInformation(); });
  reader.Set(get, random); // now the arrays are known
  for (int i = 0; i < 2; ++i)
  {
    const double time =
      TimeOf(get, random); // the update before may have failed, or others be there now
    const int pieces = Once(random, 3) ? 3 : 1;
    const int piece = static_cast<int>(below(random, static_cast<std::size_t>(pieces)));
    check([&] { get.UpdateTimeStep(time, piece, pieces); });
  }
}

// ---- copies ------------------------------------------------------------------------------------

struct File
{
  fs::path Path;
  std::string Bytes;
  std::string Content; ///< decompressed; empty: Bytes are not compressed
  std::vector<std::size_t> Readers;
};

/// Compressed files are damaged themselves or, so that something is left to read, in what they hold.
std::string DamagedCopy(const File& file, const File& other, Random& random)
{
  if (file.Content.empty() || Once(random, 3))
  {
    return file_damage::damage(file.Bytes, other.Bytes, random);
  }
  const std::string content = file_damage::damage(file.Content, other.Content, random);
  return Once(random, 4) ? packing::zstd(content)
                         : packing::gzip(content, { .level = 1, .flush_every = 50'000 });
}

class Session
{
public:
  Session(std::vector<File> files, fs::path folder)
    : Files(std::move(files))
    , Folder(std::move(folder))
  {
    vtkOutputWindow::SetInstance(this->Window);
    this->Readers.push_back(Reader::Make<vtkGranularDumpReader>("dump", SetUpDump));
    this->Readers.push_back(Reader::Make<vtkGranularLocalReader>("local", SetUpLocal));
    this->Readers.push_back(Reader::Make<vtkGranularDataFileReader>("data_file", SetUpDataFile));
    this->Readers.push_back(Reader::Make<vtkGranularEulerReader>("euler", SetUpEuler));
    this->Readers.push_back(
      Reader::Make<vtkGranularDecompositionReader>("decomposition", SetUpDecomposition));
    this->Readers.push_back(Reader::Make<vtkGranularRestartReader>("restart", SetUpRestart));
    std::erase_if(this->Files,
      [&](File& file)
      {
        for (std::size_t i = 0; i < this->Readers.size(); ++i)
        {
          if (this->Readers[i]->CanRead(file.Path.c_str()))
          {
            file.Readers.push_back(i);
          }
        }
        return file.Readers.empty();
      });
  }

  std::size_t Size() const { return this->Files.size(); }
  const Counts& Found() const { return this->Seen; }

  /// Throws std::runtime_error with what was wrong.
  void Read(std::size_t number, std::uint64_t seed, std::uint64_t copy)
  {
    const File& file = this->Files[number];
    // by the name, so that a file alone gives the same copies as among others
    Random random(
      std::hash<std::string>()(file.Path.filename().string()) ^ (seed * 1'000'003 + copy * 10'007));
    this->Now.What = "seed " + std::to_string(seed) + " copy " + std::to_string(copy) + " of " +
      file.Path.string();
    std::size_t bytes = 0;
    const std::vector<std::string> paths = this->Write(file, random, bytes);
    this->Memory.Reset();
    this->Now.Begin();
    for (const auto& reader : this->Readers)
    {
      reader->CanRead(paths.front().c_str());
    }
    Use(*this->Readers[file.Readers[below(random, file.Readers.size())]], paths, this->Folder,
      random, this->Seen);
    if (Once(random, 8))
    {
      Use(*this->Readers[below(random, this->Readers.size())], paths, this->Folder, random,
        this->Seen);
    }
    this->Now.Busy = false;
    this->Note(this->Now.Worked(), bytes);
    const std::string unheard = std::exchange(this->Window->Said, {});
    Require(unheard.empty(), "said where nobody observes: " + unheard);
  }

  const std::string& What() const { return this->Now.What; }

private:
  /// A copy, or two; the second may be the file as it was.
  std::vector<std::string> Write(const File& file, Random& random, std::size_t& bytes)
  {
    std::vector<std::string> paths;
    for (std::size_t pieces = Once(random, 4) ? 2 : 1; paths.size() < pieces;)
    {
      const File& other = this->Files[below(random, this->Files.size())];
      paths.push_back(
        (this->Folder / ("a." + std::to_string(paths.size()) + file.Path.extension().string()))
          .string());
      const std::string copy =
        paths.size() == 2 && Once(random, 2) ? file.Bytes : DamagedCopy(file, other, random);
      bytes += std::max(copy.size(), file.Content.size());
      std::ofstream(paths.back(), std::ios::binary) << copy;
    }
    return paths;
  }

  void Note(double time, std::size_t bytes)
  {
    if (time > this->Seen.Time)
    {
      this->Seen.Time = time;
      this->Seen.TimeOf = this->Now.What;
    }
    const std::size_t risen = this->Memory.Risen();
    if (risen > this->Seen.Memory)
    {
      this->Seen.Memory = risen;
      this->Seen.MemoryOf = this->Now.What;
    }
    Require(risen <= most_times_of_files * bytes + most_beside,
      std::to_string(risen >> 20) + " MiB of memory for " + std::to_string(bytes) + " bytes");
  }

  std::vector<File> Files;
  fs::path Folder;
  vtkNew<Unheard> Window;
  std::vector<std::unique_ptr<Reader>> Readers;
  ResidentMemory Memory;
  struct Now Now;
  Watchdog Dog{ this->Now };
  Counts Seen;
};

std::vector<File> FilesOf(int argc, char** argv)
{
  std::vector<fs::path> paths;
  for (int i = 4; i < argc; ++i)
  {
    if (!fs::is_directory(argv[i]))
    {
      paths.emplace_back(argv[i]);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(argv[i]))
    {
      if (entry.is_regular_file() && entry.file_size() > 0)
      {
        paths.push_back(entry.path());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<File> files;
  for (const fs::path& path : paths)
  {
    const auto source = granular::unpack(granular::open_file(path.string()));
    files.push_back({ path, file_damage::content_of(path),
      source->compressed() ? packing::read_all(*source) : "", {} });
  }
  return files;
}
}

int main(int argc, char** argv)
{
  if (argc < 5)
  {
    std::fprintf(stderr, "usage: %s SEED FIRST COPIES FILE_OR_FOLDER...\n", argv[0]);
    return 2;
  }
  const std::uint64_t seed = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10);
  const std::uint64_t copies = std::strtoull(argv[3], nullptr, 10);
  const fs::path folder =
    fs::current_path() / ("mutate_readers." + std::to_string(seed) + "." + std::to_string(first));
  fs::remove_all(folder); // of a run that crashed or was killed
  fs::create_directories(folder);
  std::size_t wrong = 0;
  {
    Session session(FilesOf(argc, argv), folder);
    for (std::uint64_t copy = first; copy < first + copies; ++copy)
    {
      for (std::size_t i = 0; i < session.Size(); ++i)
      {
        try
        {
          session.Read(i, seed, copy);
        }
        catch (const std::exception& error)
        {
          ++wrong;
          std::fprintf(stderr, "%s: %s\n", session.What().c_str(), error.what());
        }
      }
    }
    const Counts& found = session.Found();
    std::printf("%zu files, %llu copies of each: %zu updates gave data, %zu were refused, %zu "
                "copies failed\n",
      session.Size(), static_cast<unsigned long long>(copies), found.Read, found.Refused, wrong);
    for (const auto& [name, read] : found.ByReader)
    {
      std::printf("  %s: %zu updates gave data\n", name.c_str(), read);
    }
    std::printf("longest: %.3f s of processors (%s)\nmost memory: %.1f MiB (%s)\n", found.Time,
      found.TimeOf.c_str(), static_cast<double>(found.Memory) / (1 << 20), found.MemoryOf.c_str());
    wrong += found.Read == 0 ? 1 : 0;
  }
  fs::remove_all(folder);
  return wrong == 0 ? 0 : 1;
}
