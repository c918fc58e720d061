// SPDX-License-Identifier: BSD-3-Clause
// Shared by the tests of vtkGranularDumpReader: small files, and the messages that VTK prints.
#ifndef tests_dump_reader_helpers_h
#define tests_dump_reader_helpers_h

#include "vtkGranularDumpReader.h"

#include "vtkAbstractArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataArraySelection.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

inline std::string Good(const std::string& name)
{
  return std::string(GRANULAR_DATA) + "/good/" + name;
}

/// A file of the test's own: tests may run at the same time.
inline std::string WriteFile(const std::string& name, const std::string& text)
{
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
    std::filesystem::path(GRANULAR_OUTPUT) / test->test_suite_name() / test->name();
  std::filesystem::create_directories(folder);
  std::ofstream out(folder / name, std::ios::binary);
  out << text;
  return (folder / name).string();
}

/// Keeps the text of errors and warnings instead of printing them.
class Messages : public vtkCommand
{
public:
  static Messages* New() { return new Messages; }

  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    std::string text = static_cast<const char*>(data);
    const std::size_t start = text.find("): ");
    text = start == std::string::npos ? text : text.substr(start + 3);
    text.erase(text.find_last_not_of('\n') + 1);
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings).push_back(text);
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

/// A reader of files whose messages are kept.
struct Reader
{
  vtkNew<vtkGranularDumpReader> Get;
  vtkNew<Messages> Said;
  vtkNew<Messages> PipelineSaid;

  explicit Reader(const std::vector<std::string>& files = {})
  {
    this->Get->AddObserver(vtkCommand::ErrorEvent, this->Said);
    this->Get->AddObserver(vtkCommand::WarningEvent, this->Said);
    this->Get->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->PipelineSaid);
    for (const std::string& file : files)
    {
      this->Get->AddFileName(file.c_str());
    }
  }

  vtkGranularDumpReader* operator->() { return this->Get; }

  void Open(const std::string& file)
  {
    this->Get->ClearFileNames();
    this->Get->AddFileName(file.c_str());
  }

  std::vector<double> Times()
  {
    this->Get->UpdateInformation();
    vtkInformation* info = this->Get->GetOutputInformation(0);
    const double* steps = info->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    const int length = info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    return std::vector<double>(steps, steps + length);
  }

  vtkPolyData* Particles() { return this->Get->GetOutput(); }
  vtkUnstructuredGrid* Box()
  {
    return vtkUnstructuredGrid::SafeDownCast(this->Get->GetOutputDataObject(1));
  }
  vtkAbstractArray* Array(const char* name)
  {
    return this->Particles()->GetPointData()->GetAbstractArray(name);
  }
  vtkDataArray* Numbers(const char* name)
  {
    return this->Particles()->GetPointData()->GetArray(name);
  }
  vtkDataArray* Field(const char* name)
  {
    return this->Particles()->GetFieldData()->GetArray(name);
  }
  std::string Text(const char* name, vtkIdType index = 0)
  {
    auto* array =
      vtkStringArray::SafeDownCast(this->Particles()->GetFieldData()->GetAbstractArray(name));
    return array && index < array->GetNumberOfValues() ? array->GetValue(index) : "(none)";
  }
};

inline void ExpectEmpty(Reader& reader)
{
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader.Particles()->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reader.Particles()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 0);
}

/// That the next file is read as if nothing had happened.
inline void ExpectGood(Reader& reader)
{
  reader.Open(Good("grains_1000.dump"));
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_EQ(reader.Particles()->GetNumberOfPoints(), 1200);
  EXPECT_EQ(reader.Box()->GetNumberOfCells(), 1);
}

/// A dump of one frame: header, and the rows as given.
inline std::string Frame(
  long timestep, std::size_t rows, const std::string& columns, const std::string& text)
{
  std::ostringstream out;
  out << "ITEM: TIMESTEP\n"
      << timestep << "\nITEM: NUMBER OF ATOMS\n"
      << rows << "\nITEM: BOX BOUNDS pp pp ff\n0 10\n0 10\n0 10\nITEM: ATOMS " << columns << "\n"
      << text;
  return out.str();
}

/// Asks an algorithm to stop at its n-th report of progress, or at every one, and keeps the reports.
class Stopper : public vtkCommand
{
public:
  static Stopper* New() { return new Stopper; }

  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    this->Reported.push_back(*static_cast<double*>(data));
    if (this->At == Every || this->At == static_cast<int>(this->Reported.size()))
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }

  static constexpr int Never = 0;
  static constexpr int Every = -1;
  int At = Never;
  std::vector<double> Reported;
};

/// Counts how often a reader reads.
class Executions
{
public:
  explicit Executions(Reader& reader)
  {
    vtkNew<vtkCallbackCommand> start;
    start->SetClientData(&this->Count);
    start->SetCallback(
      [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
    reader->AddObserver(vtkCommand::StartEvent, start);
  }

  int Count = 0;
};

#endif
