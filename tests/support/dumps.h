// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_dumps_h
#define granular_tests_support_dumps_h

#include "error_of.h"
#include "granular/frames/file_index.h"
#include "read_source.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// A decoded frame with its notices, easy to look at.
struct Decoded
{
  granular::Table frame;
  granular::Notices notices;

  std::int64_t rows() const { return frame.rows; }
  std::vector<double> points() const;       ///< x y z of each row, double points
  std::vector<float> single_points() const; ///< the same of single points
  std::string names() const;                ///< of the arrays, blank-separated
  bool has(const std::string& name) const;

  /// Values of an array, row-major; of the integer types, converted.
  std::vector<double> values(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  granular::ValueType type(const std::string& name) const;

  /// The notices, one a line.
  std::string said() const;

private:
  const granular::TableArray& array(const std::string& name) const;
};

/// The text with every occurrence of what replaced.
std::string replaced(std::string text, const std::string& what, const std::string& with);

/// A dump in memory, called "memory" in messages, with its index. column_names is for binary dumps
/// that do not name theirs, blank-separated.
class Dump
{
public:
  explicit Dump(std::string bytes, const std::string& column_names = "");

  const granular::FileIndex& index() const { return index_; }
  std::size_t frames() const { return index_.frames.size(); }
  const granular::FrameEntry& entry(std::size_t frame = 0) const { return index_.frames.at(frame); }
  granular::FrameHeader header(std::size_t frame = 0) const; ///< read again, as for the frame
  std::vector<std::int64_t> steps() const;
  std::string said() const; ///< the notices of the index, one a line

  Decoded read(const granular::Request& request = {}, std::size_t frame = 0) const;
  Decoded read(
    const granular::Request& request, std::size_t frame, granular::Progress& progress) const;

  /// What read() throws, or "".
  std::string error(const granular::Request& request = {}, std::size_t frame = 0) const;

private:
  std::unique_ptr<std::string> text_;
  std::unique_ptr<granular::ByteSource> source_;
  granular::FileIndex index_;
};

/// A dump of one frame at step 0: columns and rows as they stand in the file, box lines "0 1" or
/// as given, behind "ITEM: BOX BOUNDS".
std::string one_frame(const std::string& columns, const std::string& rows,
  const std::string& box = " pp pp pp\n0 1\n0 1\n0 1\n");

/// One a line.
std::string lines_of(const granular::Notices& notices);

/// Nobody of these names is there: all arrays, also the coordinate columns.
granular::Request everything();

/// Files in a folder of this test's own.
class Folder
{
public:
  Folder();

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& text) const;
  void append(const std::string& name, const std::string& text) const;

private:
  std::string path_;
};

/// The names in a folder, blank-separated.
std::string names_in(const std::string& folder);

/// The contents of a file of tests/data.
std::string data_file(const std::string& name);

#endif
