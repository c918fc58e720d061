// SPDX-License-Identifier: BSD-3-Clause
// Frames that are written: made, read, cut for ranks; and what came of writing them.
#ifndef granular_tests_support_dump_writing_h
#define granular_tests_support_dump_writing_h

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/formats/dump/write/dump_writer.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// A frame that was read, as one that is to be written.
struct ReadFrameView
{
  explicit ReadFrameView(granular::Table read);

  granular::Table frame;
  std::vector<std::vector<std::string>> texts; ///< of each array of texts
  granular::FrameView view;
};

/// Rows that can be told from each other: ids in no order, points in the box and a bit outside.
struct MadeRows
{
  explicit MadeRows(std::int64_t count, const granular::Box& box, unsigned seed = 1);
  MadeRows(const MadeRows&) = delete;

  /// id, type, radius, v, image and words of different lengths.
  granular::FrameView view() const;
  granular::AtomRows atoms(bool image) const;

  granular::Box box;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> types;
  std::vector<double> points;
  std::vector<std::int32_t> images;
  std::vector<float> radii;
  std::vector<double> v;
  std::vector<std::string> words;
};

/// A box with six-digit bounds, tilted or not.
granular::Box small_box(bool tilted);

using Frames = std::vector<granular::FrameView>;

/// The rows [first, first + count) of a frame.
granular::FrameView rows_of(
  const granular::FrameView& whole, std::int64_t first, std::int64_t count);

/// A rank that has nothing and knows nothing.
constexpr std::int64_t knows_nothing = -1;

/// The frames of each rank, who have so many rows of each; the last has what is left.
std::vector<Frames> cut(const Frames& whole, const std::vector<std::int64_t>& shares);

/// What came of writing.
struct Written
{
  std::string bytes; ///< of the file; empty: there is none
  std::string said;  ///< the notices, one a line
  std::string error; ///< what() of an Error, "cancelled" or "out of memory"
};

using MakeProgress = std::function<std::unique_ptr<granular::Progress>(int rank)>;

/// By one process.
Written write_dump(const std::string& path, const Frames& frames,
  const granular::DumpFormat& format, const granular::WriteOptions& options = {});

/// By ranks that are threads. Notices and errors must be the same on all.
Written write_dump(const std::string& path, const std::vector<Frames>& ranks,
  const granular::DumpFormat& format, const granular::WriteOptions& options = {},
  const MakeProgress& progress = {});

/// The bytes of a file; none if there is none.
std::string bytes_of_file(const std::string& path);

/// The first thing that two texts do not share, for messages; "" if they are the same.
std::string difference(const std::string& one, const std::string& other);

/// The 16 forms of dump atom.
struct Form
{
  granular::AtomForm atom;
  bool tilted = false;
  bool binary = false;

  std::string name() const;
};
std::vector<Form> all_forms();

granular::DumpFormat atom_format(const Form& form, granular::Dialect dialect);

#endif
