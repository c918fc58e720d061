// SPDX-License-Identifier: BSD-3-Clause
// Data files and what is read of them, easy to look at.
#ifndef granular_tests_data_file_data_run_h
#define granular_tests_data_file_data_run_h

#include "granular/formats/data_file/data_file.h"
#include "granular/formats/data_file/read_data.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

inline std::string good_data(const std::string& name)
{
  return std::string(GRANULAR_DATA) + "/good/" + name;
}

/// A file of that content, in a folder of the test's own. Returns its path.
inline std::string write_data(const std::string& text, const std::string& name = "some.data")
{
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path path =
    std::filesystem::path(GRANULAR_OUTPUT) / test->test_suite_name() / test->name() / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

/// A file with so many atoms and bonds in a box of 10, and these sections.
inline std::string data_text(int atoms, const std::string& sections, int bonds = 0)
{
  return "a title\n\n" + std::to_string(atoms) + " atoms\n" + std::to_string(bonds) +
    " bonds\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\n" + sections;
}

/// One data file, looked at and read.
class DataRun
{
public:
  explicit DataRun(const std::string& path)
  {
    granular::IndexOptions options;
    options.format = &granular::data_file_format();
    granular::Progress progress;
    index_.update({ path }, options, notices_, progress);
  }

  std::int64_t step() const { return index_.first_piece(0).entry.timestep; }
  const granular::FileIndex& file() const { return index_.first_piece(0).file; }

  granular::Tables read(
    const granular::Request& request = {}, const granular::DataOptions& options = {})
  {
    granular::SerialCommunicator alone;
    granular::Progress progress;
    return granular::read_data(index_.first_piece(0), options, request, alone, notices_, progress);
  }

  std::string said() const
  {
    std::string all;
    for (const granular::Notice& notice : notices_)
    {
      all += notice.text + "\n";
    }
    return all;
  }

private:
  granular::RunIndex index_;
  granular::Notices notices_;
};

/// The message of what looking at the text and reading it throws, less the path; or "".
inline std::string data_error(const std::string& text, const granular::DataOptions& options = {})
{
  const std::string path = write_data(text);
  try
  {
    DataRun(path).read({}, options);
  }
  catch (const granular::Error& error)
  {
    const std::string what = error.what();
    return what.starts_with(path) ? what.substr(path.size()) : what;
  }
  return "";
}

/// The values of an array; none: it is not there.
template <class Value = double>
std::vector<Value> array_of(const granular::Table& frame, const std::string& name)
{
  for (const granular::TableArray& array : frame.arrays)
  {
    if (array.info.name == name)
    {
      const auto* const values = static_cast<const Value*>(array.block.data());
      return { values, values + array.block.bytes() / sizeof(Value) };
    }
  }
  return {};
}

inline std::vector<double> points_of(const granular::Table& frame)
{
  const auto* const values = static_cast<const double*>(frame.points.data());
  return { values, values + frame.points.bytes() / sizeof(double) };
}

inline std::string names_of(const granular::Table& frame)
{
  std::string names;
  for (const granular::TableArray& array : frame.arrays)
  {
    names += (names.empty() ? "" : " ") + array.info.name;
  }
  return names;
}

#endif
