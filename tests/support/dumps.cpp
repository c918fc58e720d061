// SPDX-License-Identifier: BSD-3-Clause
#include "dumps.h"

#include "granular/common/words.h"
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/formats/dump/grammar/frame_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

using namespace granular;

namespace
{
template <typename To, typename From>
std::vector<To> converted(const Block& block, std::size_t count)
{
  const auto* const from = static_cast<const From*>(block.data());
  if (block.bytes() != count * sizeof(From))
  {
    throw std::length_error("a block of another size than its rows");
  }
  std::vector<To> values;
  std::transform(
    from, from + count, std::back_inserter(values), [](From v) { return static_cast<To>(v); });
  return values;
}

template <typename To>
std::vector<To> values_of(const Table& frame, const TableArray& array)
{
  const std::size_t count = static_cast<std::size_t>(frame.rows) * array.info.columns.size();
  switch (array.info.type)
  {
    case ValueType::Int32:
      return converted<To, std::int32_t>(array.block, count);
    case ValueType::Int64:
      return converted<To, std::int64_t>(array.block, count);
    case ValueType::Float64:
      return converted<To, double>(array.block, count);
    default:
      throw std::invalid_argument("texts have no values");
  }
}
}

std::string replaced(std::string text, const std::string& what, const std::string& with)
{
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + with.size()))
  {
    text.replace(at, what.size(), with);
  }
  return text;
}

std::vector<double> Decoded::points() const
{
  return converted<double, double>(frame.points, 3 * static_cast<std::size_t>(frame.rows));
}

std::vector<float> Decoded::single_points() const
{
  return converted<float, float>(frame.points, 3 * static_cast<std::size_t>(frame.rows));
}

std::string Decoded::names() const
{
  std::string text;
  for (const TableArray& one : frame.arrays)
  {
    text += (text.empty() ? "" : " ") + one.info.name;
  }
  return text;
}

bool Decoded::has(const std::string& name) const
{
  return std::any_of(frame.arrays.begin(), frame.arrays.end(),
    [&](const TableArray& one) { return one.info.name == name; });
}

const TableArray& Decoded::array(const std::string& name) const
{
  for (const TableArray& one : frame.arrays)
  {
    if (one.info.name == name)
    {
      return one;
    }
  }
  throw std::out_of_range("no array " + name + " among " + this->names());
}

std::vector<double> Decoded::values(const std::string& name) const
{
  return values_of<double>(frame, this->array(name));
}

std::vector<std::int64_t> Decoded::integers(const std::string& name) const
{
  if (this->type(name) == ValueType::Float64)
  {
    throw std::invalid_argument(name + " holds doubles");
  }
  return values_of<std::int64_t>(frame, this->array(name));
}

std::vector<std::string> Decoded::texts(const std::string& name) const
{
  const TableArray& one = this->array(name);
  if (one.info.type != ValueType::Text)
  {
    throw std::invalid_argument(name + " does not hold a text a row");
  }
  const auto* const indices = static_cast<const std::int32_t*>(one.block.data());
  std::vector<std::string> texts;
  for (std::int64_t row = 0; row < frame.rows; ++row)
  {
    texts.push_back(one.words.at(static_cast<std::size_t>(indices[row])));
  }
  return texts;
}

ValueType Decoded::type(const std::string& name) const
{
  return this->array(name).info.type;
}

std::string Decoded::said() const
{
  return lines_of(notices);
}

Dump::Dump(std::string bytes, const std::string& column_names)
  : text_(std::make_unique<std::string>(std::move(bytes)))
  , source_(unpack(open_memory(*text_)))
{
  Progress progress;
  for (const std::string_view name : split_words(column_names))
  {
    index_.column_names.emplace_back(name);
  }
  index_dump(*source_, index_, progress);
}

FrameHeader Dump::header(std::size_t frame) const
{
  return open_rows(*source_, this->entry(frame))->header();
}

std::vector<std::int64_t> Dump::steps() const
{
  std::vector<std::int64_t> steps;
  for (const FrameEntry& frame : index_.frames)
  {
    steps.push_back(frame.timestep);
  }
  return steps;
}

std::string Dump::said() const
{
  return lines_of(index_.notices);
}

Decoded Dump::read(const Request& request, std::size_t frame) const
{
  Progress progress;
  return this->read(request, frame, progress);
}

Decoded Dump::read(const Request& request, std::size_t frame, Progress& progress) const
{
  Decoded decoded;
  decoded.frame = read_dump(*source_, this->entry(frame), request, decoded.notices, progress);
  return decoded;
}

std::string Dump::error(const Request& request, std::size_t frame) const
{
  return error_of([&] { this->read(request, frame); });
}

std::string one_frame(const std::string& columns, const std::string& rows, const std::string& box)
{
  const auto count = std::count(rows.begin(), rows.end(), '\n');
  return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(count) +
    "\nITEM: BOX BOUNDS" + box + "ITEM: ATOMS " + columns + "\n" + rows;
}

std::string lines_of(const Notices& notices)
{
  std::string text;
  for (const Notice& notice : notices)
  {
    text += to_string(notice) + "\n";
  }
  return text;
}

Request everything()
{
  Request request;
  request.wanted = [](std::string_view, bool) { return true; };
  return request;
}

Folder::Folder()
{
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string program = program_invocation_short_name; // test_NAME
  path_ = std::string(GRANULAR_OUTPUT) + "/" + program.substr(program.find('_') + 1) + "/" +
    test->test_suite_name() + "." + test->name();
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

std::string names_in(const std::string& folder)
{
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    names.insert(entry.path().filename().string());
  }
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "" : " ") + name;
  }
  return text;
}

std::string Folder::write(const std::string& name, const std::string& text) const
{
  std::ofstream(this->path(name), std::ios::binary | std::ios::trunc) << text;
  return this->path(name);
}

void Folder::append(const std::string& name, const std::string& text) const
{
  std::ofstream(this->path(name), std::ios::binary | std::ios::app) << text;
}

std::string data_file(const std::string& name)
{
  std::ifstream stream(std::string(GRANULAR_DATA) + "/" + name, std::ios::binary);
  if (!stream)
  {
    throw std::runtime_error("cannot read " + name);
  }
  return { std::istreambuf_iterator<char>(stream), {} };
}
