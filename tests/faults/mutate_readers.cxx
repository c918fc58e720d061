// SPDX-License-Identifier: BSD-3-Clause
// Damaged copies of good files through the VTK readers, all in one process, through the same readers one after the other, as by a user
// who opens many files. A copy depends on the seed and its number alone: GRANULAR_SEED, and GRANULAR_COPIES of each file. Each copy
// must end within 10 s of processors, in memory of at most 20 times its files and 256 MiB, with valid outputs, or empty ones and an
// error that names the file. After a crash or a hang, the file `last` in the folder of the test says which copy it was.
#include "../support/byte_source_packing.h"
#include "../support/dumps.h"
#include "../support/file_damage.h"
#include "../support/largest_request.h"
#include "../support/observer.h"
#include "load.h"
#include "reader_content.h"

#include "granular/bytes/byte_source.h"

#include "vtkGranularDataFileReader.h"
#include "vtkGranularDecompositionReader.h"
#include "vtkGranularDumpReader.h"
#include "vtkGranularEulerReader.h"
#include "vtkGranularLocalReader.h"
#include "vtkGranularRestartReader.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArraySelection.h"
#include "vtkErrorCode.h"
#include "vtkIdList.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <unistd.h>

namespace
{
namespace fs = std::filesystem;
using file_damage::below;
using file_damage::Random;

constexpr double longest = 10;        // s of processors
constexpr unsigned longestWait = 100; // s, on a machine that does much else
constexpr std::int64_t mostTimesOfFiles = 20;
constexpr std::int64_t mostBeside = 256 * mebibyte;

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

// ---- outputs -----------------------------------------------------------------------------------

volatile unsigned touched = 0; ///< a sum that no compiler may leave out

/// Reads every byte: a memory checker sees those that are not there.
void Touch(vtkAbstractArray* array)
{
  unsigned sum = 0;
  if (auto* const texts = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
    {
      sum += static_cast<unsigned>(texts->GetValue(i).size());
    }
  }
  else
  {
    const auto* const bytes = static_cast<const unsigned char*>(array->GetVoidPointer(0));
    for (vtkIdType i = 0; i < array->GetNumberOfValues() * array->GetDataTypeSize(); ++i)
    {
      sum += bytes[i];
    }
  }
  touched = sum;
}

/// Each array has a name, and a value for each point, cell or row.
void RequireArrays(vtkDataObject* output)
{
  for (int type = 0; type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
  {
    vtkFieldData* const arrays = output->GetAttributesAsFieldData(type);
    for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = arrays->GetAbstractArray(i);
      Require(array && array->GetName() && *array->GetName(), "an array without a name");
      Require(type == vtkDataObject::FIELD ||
          array->GetNumberOfTuples() == output->GetNumberOfElements(type),
        std::to_string(array->GetNumberOfTuples()) + " tuples of " + array->GetName());
      Touch(array);
    }
  }
}

/// Filters may trust it.
void RequireValid(vtkDataObject* output)
{
  Require(output, "no output");
  RequireArrays(output);
  if (auto* const blocks = vtkCompositeDataSet::SafeDownCast(output))
  {
    const auto each = vtk::TakeSmartPointer(blocks->NewIterator());
    for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
    {
      RequireValid(each->GetCurrentDataObject());
    }
  }
  auto* const set = vtkPointSet::SafeDownCast(output);
  if (set && set->GetPoints())
  {
    Touch(set->GetPoints()->GetData());
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; set && cell < set->GetNumberOfCells(); ++cell)
  {
    set->GetCellPoints(cell, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      Require(ids->GetId(i) >= 0 && ids->GetId(i) < set->GetNumberOfPoints(),
        "a cell of point " + std::to_string(ids->GetId(i)));
    }
  }
}

// ---- readers -----------------------------------------------------------------------------------

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

/// Sets the properties that a reader has at random.
template <class Type>
void SetUp(vtkGranularSeriesReader& base, Random& random)
{
  constexpr const char* names[] = { "", "", "id type x y z",
    "id type x y z ix iy iz vx vy vz radius element", "id type xs ys zs ix iy iz", "a b c d e" };
  constexpr const char* styles[] = { "", "", "sphere", "full", "ellipsoid", "hybrid sphere bond" };
  constexpr const char* boundaries[] = { "", "p p p", "f f f" };
  auto& reader = static_cast<Type&>(base);
  const auto any = [&](std::size_t end) { return static_cast<int>(below(random, end)); };
  reader.SetThreads(any(4));
  reader.SetRepeatedSteps(any(3));
  reader.SetTimestepSize(Once(random, 8) ? 1e300 : 1e-5);
  if constexpr (std::is_same_v<Type, vtkGranularDumpReader>)
  {
    reader.SetColumnNames(names[any(std::size(names))]);
    reader.SetPointPrecision(any(2));
    reader.SetVertices(any(3));
    reader.SetPointOrigin(Once(random, 3) ? 1e3 : 0, 0, 0);
    reader.SetRegionOfInterest(Once(random, 3) ? 0 : 1, Once(random, 2) ? 0.05 : -1, 1, -1, 1, -1);
  }
  if constexpr (std::is_same_v<Type, vtkGranularDataFileReader>)
  {
    reader.SetAtomStyle(styles[any(std::size(styles))]);
    reader.SetBoundary(boundaries[any(std::size(boundaries))]);
  }
  if constexpr (requires { reader.SetSortById(true); })
  {
    reader.SetCoordinates(any(3));
    reader.SetSortById(Once(random, 2));
    reader.SetStride(Once(random, 3) ? 3 : 1);
  }
  if constexpr (requires { reader.SetPeriodicLines(0); })
  {
    reader.SetPeriodicLines(any(3));
  }
  if constexpr (requires { reader.SetPreset(0); })
  {
    reader.SetPreset(Once(random, 2) ? 0 : any(13));
  }
  if constexpr (requires { reader.SetOutputType(0); })
  {
    reader.SetOutputType(any(2));
  }
  if constexpr (requires { reader.SetCheckOverlap(0); })
  {
    reader.SetCheckOverlap(any(3));
    reader.SetCheckGaps(any(3));
  }
  if constexpr (requires { reader.SetHistoryLayout(0); })
  {
    reader.SetHistoryLayout(Once(random, 2) ? 0 : any(6));
  }
  if constexpr (requires { reader.GetPointDataArraySelection(); })
  {
    Choose(reader.GetPointDataArraySelection(), random);
  }
  if constexpr (requires { reader.GetCellDataArraySelection(); })
  {
    Choose(reader.GetCellDataArraySelection(), random);
  }
}

/// A reader that lives as long as the process.
struct LastingReader
{
  int (*CanRead)(const char*);
  void (*Set)(vtkGranularSeriesReader& reader, Random& random);
  vtkSmartPointer<vtkGranularSeriesReader> Get;
  vtkNew<Observer> Errors;
  vtkNew<Observer> Others; ///< warnings, and what the pipeline says of errors

  template <class Type>
  static std::unique_ptr<LastingReader> Make()
  {
    auto reader = std::make_unique<LastingReader>();
    reader->CanRead = &Type::CanReadFile;
    reader->Set = &SetUp<Type>;
    reader->Get = vtkSmartPointer<Type>::New();
    reader->Get->AddObserver(vtkCommand::ErrorEvent, reader->Errors);
    reader->Get->AddObserver(vtkCommand::WarningEvent, reader->Others);
    reader->Get->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, reader->Others);
    return reader;
  }
};

struct Counts
{
  std::size_t Read = 0;
  std::size_t Refused = 0;
  std::int64_t Memory = 0; ///< bytes beyond those before
  double Time = 0;         ///< s of processors
};

/// One update: valid outputs, or an error and empty ones. What an error is about must be named.
void UpdateAndCheck(LastingReader& reader, const std::function<void()>& update,
  const fs::path& folder, Counts& counts)
{
  reader.Errors->Said.clear();
  reader.Others->Said.clear();
  update();
  const bool failed = reader.Get->GetErrorCode() != vtkErrorCode::NoError;
  const std::string message = reader.Get->GetErrorMessage();
  Require(failed != message.empty(),
    "an error without a message, or a message without an error: " + message);
  Require(failed || reader.Errors->Said.empty(), "an error was told, but nothing failed");
  Require(!failed || message.find(folder.string()) != std::string::npos,
    "an error that names no file: " + message);
  for (int port = 0; !failed && port < reader.Get->GetNumberOfOutputPorts(); ++port)
  {
    RequireValid(reader.Get->GetOutputDataObject(port));
  }
  Require(!failed || IsEmpty(reader.Get), "an error, and yet an output");
  ++(failed ? counts.Refused : counts.Read);
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
void Use(LastingReader& reader, const std::vector<std::string>& paths, const fs::path& folder,
  Random& random, Counts& counts)
{
  vtkGranularSeriesReader& get = *reader.Get;
  get.ClearFileNames();
  for (const std::string& path : paths)
  {
    get.AddFileName(path.c_str());
  }
  get.Refresh(); // the names are those of the copy before
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
  explicit Session(fs::path folder)
    : Folder(std::move(folder))
  {
    vtkOutputWindow::SetInstance(this->Window);
    this->Readers.push_back(LastingReader::Make<vtkGranularDumpReader>());
    this->Readers.push_back(LastingReader::Make<vtkGranularLocalReader>());
    this->Readers.push_back(LastingReader::Make<vtkGranularDataFileReader>());
    this->Readers.push_back(LastingReader::Make<vtkGranularEulerReader>());
    this->Readers.push_back(LastingReader::Make<vtkGranularDecompositionReader>());
    this->Readers.push_back(LastingReader::Make<vtkGranularRestartReader>());
    for (const auto& entry : fs::recursive_directory_iterator(GRANULAR_DATA "/good"))
    {
      if (entry.is_regular_file() && entry.file_size() > 0)
      {
        const auto source = granular::unpack(granular::open_file(entry.path().string()));
        this->Files.push_back({ entry.path(), file_damage::content_of(entry.path()),
          source->compressed() ? packing::read_all(*source) : "", {} });
      }
    }
    std::ranges::sort(this->Files, {}, &File::Path);
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
    this->What = "seed " + std::to_string(seed) + " copy " + std::to_string(copy) + " of " +
      file.Path.string();
    std::int64_t bytes = 0;
    const std::vector<std::string> paths = this->Write(file, random, bytes);
    std::ofstream(this->Folder / "last") << this->What << "\n";
    ::alarm(longestWait);
    const std::int64_t before = restart_peak();
    const std::clock_t start = std::clock();
    largest_request = 0;
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
    this->Note(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
      std::max(status_of_process("VmHWM") - before, static_cast<std::int64_t>(largest_request)),
      bytes);
    const std::string unheard = std::exchange(this->Window->Said, {});
    Require(unheard.empty(), "said where nobody observes: " + unheard);
  }

  std::string What; ///< is done now

private:
  /// A copy, or two; the second may be the file as it was.
  std::vector<std::string> Write(const File& file, Random& random, std::int64_t& bytes)
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
      bytes += static_cast<std::int64_t>(std::max(copy.size(), file.Content.size()));
      std::ofstream(paths.back(), std::ios::binary) << copy;
    }
    return paths;
  }

  void Note(double time, std::int64_t memory, std::int64_t bytes)
  {
    this->Seen.Time = std::max(this->Seen.Time, time);
    this->Seen.Memory = std::max(this->Seen.Memory, memory);
    Require(time < longest, std::to_string(time) + " s of processors");
    Require(memory <= mostTimesOfFiles * bytes + mostBeside,
      std::to_string(memory / mebibyte) + " MiB of memory for " + std::to_string(bytes) + " bytes");
  }

  std::vector<File> Files;
  fs::path Folder;
  vtkNew<Unheard> Window;
  std::vector<std::unique_ptr<LastingReader>> Readers;
  Counts Seen;
};

std::uint64_t NumberOf(const char* variable, std::uint64_t usual)
{
  const char* const given = std::getenv(variable);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}
}

TEST(MutatedFiles, AreReadOrRefused)
{
  const std::uint64_t seed = NumberOf("GRANULAR_SEED", 1);
  const std::uint64_t copies = NumberOf("GRANULAR_COPIES", 4);
  Session session(Folder().path(""));
  for (std::uint64_t copy = 0; copy < copies; ++copy)
  {
    for (std::size_t i = 0; i < session.Size(); ++i)
    {
      try
      {
        session.Read(i, seed, copy);
      }
      catch (const std::exception& error)
      {
        ADD_FAILURE() << session.What << ": " << error.what();
      }
    }
  }
  const Counts& found = session.Found();
  std::printf(
    "%zu files, %llu copies of each: %zu updates gave data, %zu were refused; longest: %.3f s "
    "of processors; most memory: %.1f MiB\n",
    session.Size(), static_cast<unsigned long long>(copies), found.Read, found.Refused, found.Time,
    static_cast<double>(found.Memory) / mebibyte);
  EXPECT_GT(found.Read, 0u);
  EXPECT_GT(found.Refused, 0u);
}
