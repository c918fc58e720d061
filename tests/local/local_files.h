// SPDX-License-Identifier: BSD-3-Clause
// Files of local data and what is read of them, easy to look at.
#ifndef granular_tests_local_local_files_h
#define granular_tests_local_local_files_h

#include "../support/error_of.h"

#include "granular/formats/local/local_file.h"
#include "granular/formats/local/local_reader.h"
#include "granular/lines/line_columns.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

inline std::string local_file(const std::string& name)
{
  return std::string(GRANULAR_DATA) + "/good/local/" + name;
}

/// In a folder of the test's own: tests may run at the same time.
inline std::filesystem::path own_path(const std::string& name)
{
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  return std::filesystem::path(GRANULAR_OUTPUT) / test->test_suite_name() / test->name() / name;
}

/// A file of that content. Returns its path.
inline std::string write_text(const std::string& name, const std::string& text)
{
  const std::filesystem::path path = own_path(name);
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

/// A run of local data.
class LocalRun
{
public:
  LocalRun() = default;
  explicit LocalRun(const std::vector<std::string>& paths) { this->update(paths); }

  /// column_names: of the user's column map.
  void update(
    const std::vector<std::string>& paths, const std::vector<std::string>& column_names = {})
  {
    granular::IndexOptions options;
    options.format = &granular::local_format();
    options.column_names = column_names;
    granular::Progress progress;
    notices_.clear();
    index_.update(paths, options, notices_, progress);
  }

  const granular::RunIndex& index() const { return index_; }
  std::size_t size() const { return index_.size(); }
  std::int64_t step(std::size_t frame) const { return index_.first_piece(frame).entry.timestep; }
  std::size_t pieces(std::size_t frame) const { return index_.pieces(frame).size(); }

  std::vector<std::string> columns(std::size_t frame = 0) const
  {
    std::vector<std::string> names;
    for (const auto& column : index_.first_piece(frame).entry.kind->schema.columns())
    {
      names.push_back(column.name);
    }
    return names;
  }

  /// What the columns are taken for, blank-separated.
  std::string found(std::size_t frame = 0)
  {
    granular::Progress progress;
    const granular::FramePiece piece = index_.first_piece(frame);
    const granular::LocalSample sample = granular::read_sample(index_, *piece.entry.kind, progress);
    found_ =
      granular::find_columns(this->columns(frame), sample, granular::where_of(piece), notices_);
    return granular::join_words(found_);
  }

  /// columns: what they are taken for; empty: what they are found to be.
  granular::Table read(std::size_t frame, const granular::Request& request = {},
    const std::vector<std::string>& columns = {})
  {
    if (columns.empty())
    {
      this->found(frame);
    }
    granular::SerialCommunicator alone;
    granular::Progress progress;
    return granular::read_local(
      index_.pieces(frame), columns.empty() ? found_ : columns, request, alone, notices_, progress);
  }

  /// The notices so far, one a line.
  std::string said() const
  {
    std::string text;
    for (const granular::Notice& notice : notices_)
    {
      text += granular::to_string(notice) + "\n";
    }
    return text;
  }

private:
  granular::RunIndex index_;
  granular::Notices notices_;
  std::vector<std::string> found_;
};

/// Values of an array of a frame, row-major.
template <class Value>
std::span<const Value> values(const granular::Table& frame, const std::string& name)
{
  for (const granular::TableArray& array : frame.arrays)
  {
    if (array.info.name == name)
    {
      return { static_cast<const Value*>(array.block.data()), array.block.bytes() / sizeof(Value) };
    }
  }
  return {};
}

/// A frame of dump local.
inline std::string local_frame(const std::string& columns, const std::vector<std::string>& rows,
  const std::string& box = "BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10",
  const std::string& label = "ENTRIES", std::int64_t step = 0)
{
  std::string text = "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF " + label +
    "\n" + std::to_string(rows.size()) + "\n" + (box.empty() ? "" : "ITEM: " + box + "\n") +
    "ITEM: " + label + " " + columns + " \n";
  for (const std::string& row : rows)
  {
    text += row + " \n";
  }
  return text;
}

/// Names of columns that say nothing: c_a[1] and so on.
inline std::string silent_columns(int count)
{
  std::string names;
  for (int i = 1; i <= count; ++i)
  {
    names += (i > 1 ? " c_a[" : "c_a[") + std::to_string(i) + "]";
  }
  return names;
}
#endif
