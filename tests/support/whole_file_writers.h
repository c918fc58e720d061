// SPDX-License-Identifier: BSD-3-Clause
// What the tests of writers share that write a file as a whole.
#ifndef granular_tests_support_whole_file_writers_h
#define granular_tests_support_whole_file_writers_h

#include "../dump/writer_helpers.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

using Lines = std::vector<std::string>;

inline void AddField(vtkDataObject* data, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTuple(values.data());
  data->GetFieldData()->AddArray(array);
}

inline void AddText(vtkDataObject* data, const char* name, const char* value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

/// A writer of files, and what it says.
template <class Class>
struct WholeFileWriter
{
  vtkNew<Class> Get;
  vtkNew<Messages> Said;

  explicit WholeFileWriter(const std::string& file, vtkDataObject* data = nullptr)
  {
    this->Get->AddObserver(vtkCommand::ErrorEvent, this->Said);
    this->Get->AddObserver(vtkCommand::WarningEvent, this->Said);
    this->Get->SetFileName(file.c_str());
    this->Get->SetInputDataObject(data);
  }

  Class* operator->() { return this->Get; }

  void ExpectWritten()
  {
    EXPECT_EQ(this->Get->Write(), 1);
    EXPECT_TRUE(this->Get->GetWritten());
    EXPECT_EQ(this->Said->Errors, Lines{});
  }

  std::string Bytes()
  {
    this->ExpectWritten();
    return Content(this->Get->GetFileName());
  }

  void ExpectError(unsigned long code, const std::string& text)
  {
    this->Said->Errors.clear();
    EXPECT_EQ(this->Get->Write(), 0);
    EXPECT_FALSE(this->Get->GetWritten());
    EXPECT_EQ(this->Get->GetErrorCode(), code);
    EXPECT_EQ(this->Said->Errors, Lines{ text });
    this->Said->Errors.clear();
  }

  void ExpectUnsupported(const std::string& text)
  {
    this->ExpectError(
      vtkErrorCode::FileFormatError, std::string(this->Get->GetFileName()) + ": " + text);
  }
};

/// A name in an empty folder.
inline std::string FreshName(const std::string& name)
{
  const std::filesystem::path path = NewName(name);
  for (const std::string& beside : Beside(path.string()))
  {
    std::filesystem::remove(path.parent_path() / beside);
  }
  return path.string();
}

/// A file whose time stamp is of long ago.
class Stamped
{
public:
  explicit Stamped(std::string path)
    : Path(std::move(path))
  {
    std::filesystem::last_write_time(this->Path, Old());
  }

  bool IsUntouched() const { return std::filesystem::last_write_time(this->Path) == Old(); }

private:
  static std::filesystem::file_time_type Old()
  {
    return std::filesystem::file_time_type{} + std::chrono::hours(24);
  }

  std::string Path;
};

#endif
