// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkGranularDumpWriter share.
#ifndef tests_dump_writer_helpers_h
#define tests_dump_writer_helpers_h

#include "vtkGranularDumpWriter.h"

#include "reader_helpers.h"

#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkPoints.h"

#include <algorithm>

/// A file of the test's own, that is not there yet.
inline std::string NewName(const std::string& name)
{
  const std::string path = WriteFile(name, "");
  std::filesystem::remove(path);
  return path;
}

inline std::string Content(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
}

/// What lies beside a file, itself too.
inline std::vector<std::string> Beside(const std::string& path)
{
  std::vector<std::string> names;
  for (const auto& entry :
    std::filesystem::directory_iterator(std::filesystem::path(path).parent_path()))
  {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A writer whose messages are kept.
struct Writer
{
  vtkNew<vtkGranularDumpWriter> Get;
  vtkNew<Messages> Said;

  explicit Writer(const std::string& file = {})
  {
    this->Get->AddObserver(vtkCommand::ErrorEvent, this->Said);
    this->Get->AddObserver(vtkCommand::WarningEvent, this->Said);
    this->Get->SetFileName(file.c_str());
  }

  vtkGranularDumpWriter* operator->() { return this->Get; }

  /// The lines of the rows after Write(), which must be right.
  std::vector<std::string> Rows()
  {
    EXPECT_EQ(this->Get->Write(), 1);
    EXPECT_EQ(this->Said->Errors, std::vector<std::string>{});
    std::istringstream in(Content(this->Get->GetFileName()));
    std::vector<std::string> rows;
    std::string line;
    while (std::getline(in, line) && line.rfind("ITEM: ATOMS", 0) != 0)
    {
    }
    while (std::getline(in, line))
    {
      rows.push_back(line);
    }
    return rows;
  }

  /// Write() fails, with just one error.
  void ExpectError(unsigned long code, const std::string& text)
  {
    this->Said->Errors.clear();
    EXPECT_EQ(this->Get->Write(), 0);
    EXPECT_FALSE(this->Get->GetWritten());
    EXPECT_EQ(this->Get->GetErrorCode(), code);
    ASSERT_EQ(this->Said->Errors.size(), 1u) << text;
    EXPECT_EQ(this->Said->Errors[0], text);
    this->Said->Errors.clear();
  }
};

/// Grains in the box 0 10 0 10 0 10 at (i, 0.5, 0.25), i from 0.
inline vtkSmartPointer<vtkPolyData> MakeParticles(vtkIdType count)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, static_cast<double>(i), 0.5, 0.25);
  }
  data->SetPoints(points);
  const auto add = [&](const char* name, const std::vector<double>& values)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(values.size()));
    array->InsertNextTuple(values.data());
    data->GetFieldData()->AddArray(array);
  };
  add("BoxOrigin", { 0, 0, 0 });
  add("BoxVectors", { 10, 0, 0, 0, 10, 0, 0, 0, 10 });
  add("timestep", { 7 });
  vtkNew<vtkStringArray> boundary;
  boundary->SetName("Boundary");
  boundary->InsertNextValue("pp pp ff");
  data->GetFieldData()->AddArray(boundary);
  return data;
}

template <typename Array>
vtkSmartPointer<Array> AddArray(
  vtkPolyData* data, const char* name, const std::vector<typename Array::ValueType>& values)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), values[i]);
  }
  data->GetPointData()->AddArray(array);
  return array;
}

#endif
