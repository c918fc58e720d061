// SPDX-License-Identifier: BSD-3-Clause
// The knowledge of a rank about files, as bytes for others: it comes back as it was, and other bytes are refused.
#include "granular/frames/run_index_parts.h"

#include "../support/dumps.h"

#include "granular/formats/dump/grammar/binary_header.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using namespace granular;
using Files = std::vector<FileIndex>;
using Names = std::vector<std::string>;

std::shared_ptr<const FrameKind> kind_of(
  const Names& names, const std::vector<ValueType>& types, const std::string& units, int layout)
{
  FrameKind kind{ ColumnSchema(names), units, layout };
  for (std::size_t i = 0; i < types.size(); ++i)
  {
    if (kind.schema.columns()[i].type != types[i])
    {
      kind.schema.set_type(static_cast<int>(i), types[i]);
    }
  }
  return std::make_shared<const FrameKind>(kind);
}

/// Text, with columns of words, and two kinds of frames.
FileIndex text_file(const std::string& path)
{
  using enum ValueType;
  FileIndex file;
  file.path = path;
  file.stamp = { 123'456'789'012, 1'700'000'000'123'456'789, 42, 7 };
  file.ends_hash = 0xfedcba9876543210;
  file.resume_offset = 5000;
  file.resume_line = 77;
  file.units = "si";
  file.notices = { { { path, 12, -1, "x" }, "expected 3 rows, got 4; the frame is left out" },
    { { "/elsewhere/b.dump", 0, 99, "" }, "text" } };
  file.defect = Notice{ { path, 12 }, "expected 3 rows, got 4" };
  const auto words = kind_of({ "id", "x", "y", "z", "word", "c_1[1]", "c_1[2]", "diameter" },
    { Int64, Float64, Float64, Float64, Text, Float64, Float64, Float64 }, "si", FrameKind::text);
  const auto plain = kind_of({ "id", "type", "x", "y", "z" }, {}, "", FrameKind::text);
  file.frames = { { 0, 20, 100, 1500, 1, 0.1, 0x1122334455667788, words },
    { -100, 0, 1500, 1600, 30, FrameEntry::no_time, 1, plain },
    { std::numeric_limits<std::int64_t>::max(), 100, 1600, 5000, 40, -HUGE_VAL, 2, words } };
  return file;
}

/// Binary, its columns named by the user.
FileIndex binary_file(const std::string& path)
{
  FileIndex file;
  file.path = path;
  file.stamp = { 10'000, -5, 43, 7 };
  file.beside = { { "other.bin", { 12'000, 1, 2, 3 } }, { "missing.bin", {} } };
  file.unchecked = "the end is not checked";
  file.resume_offset = 4000;
  file.unnamed = true;
  file.column_names = { "id", "type", "c_stress[1]", "" };
  const auto kind = kind_of(file.column_names, {}, "lj", 3);
  file.frames = { { 7, 10, 0, 2000, 0, 2.5, 3, kind }, { 8, 10, 2000, 4000, 0, 3.5, 3, kind } };
  return file;
}

/// Compressed: with seek points.
FileIndex compressed_file(const std::string& path)
{
  FileIndex file = text_file(path);
  file.defect.reset();
  file.notices.clear();
  file.compressed = true;
  file.points = std::make_shared<SeekPoints>();
  file.points->spacing = 3 << 20;
  file.points->points = { { 1000, 100, 0, 0, 0, "" },
    { 1'000'000, 12'345, 5, 0xdeadbeef, 999'000, std::string(100, '\0') + "window" } };
  return file;
}

/// A file in which no frame was found.
FileIndex empty_file(const std::string& path)
{
  FileIndex file;
  file.path = path;
  file.stamp.size = 3;
  file.defect = Notice{ { path }, "expected a dump, got no complete frame" };
  return file;
}

Files some_files(const std::string& folder)
{
  return { text_file(folder + "a.dump"), binary_file(folder + "b.bin"),
    compressed_file(folder + "c/c.dump.gz"), empty_file(folder + "d.dump") };
}

std::string text_of(const FrameKind& kind)
{
  std::ostringstream out;
  out << kind.units << " " << kind.layout << " (";
  for (const ColumnInfo& column : kind.schema.columns())
  {
    out << " " << column.name << ":" << static_cast<int>(column.type) << ":"
        << static_cast<int>(column.role);
  }
  for (const ArrayInfo& array : kind.schema.arrays())
  {
    out << " | " << array.name << ":" << static_cast<int>(array.type) << ":"
        << static_cast<int>(array.role) << ":" << array.components() << ":" << array.scale;
  }
  return out.str() + ")";
}

/// All that is sent of a file.
std::string text_of(const FileIndex& file)
{
  std::ostringstream out;
  out << file.path << " " << file.stamp.size << " " << file.stamp.modified << " "
      << file.stamp.inode << " " << file.stamp.device << " " << file.ends_hash << " "
      << file.unnamed << " " << file.compressed << " " << file.resume_offset << " "
      << file.resume_line << " " << file.units << " " << file.unchecked << "\n"
      << lines_of(file.notices) << (file.defect ? to_string(*file.defect) : "no defect") << "\n";
  for (const Notice& notice : file.notices)
  {
    out << notice.where.line << " " << notice.where.byte << " " << notice.where.column << "\n";
  }
  for (const std::string& name : file.column_names)
  {
    out << "'" << name << "' ";
  }
  for (const KnownFile& other : file.beside)
  {
    out << other.path << " " << other.stamp.size << " " << other.stamp.modified << "\n";
  }
  out << (file.points ? "points " + std::to_string(file.points->spacing) : "no points") << "\n";
  for (const SeekPoints::Point& point :
    file.points ? file.points->points : decltype(SeekPoints::points)())
  {
    out << point.offset << " " << point.packed << " " << int{ point.bits } << " " << point.check
        << " " << point.member_bytes << " '" << point.window << "'\n";
  }
  for (const FrameEntry& frame : file.frames)
  {
    out << frame.timestep << " " << frame.rows << " " << frame.offset << " " << frame.end << " "
        << frame.line << " " << std::bit_cast<std::uint64_t>(frame.time) << " " << frame.shape
        << " " << text_of(*frame.kind) << "\n";
  }
  return out.str();
}

std::string text_of(const Files& files)
{
  std::string text;
  for (const FileIndex& file : files)
  {
    text += text_of(file);
  }
  return text;
}

Files decode(const std::string& bytes)
{
  return decode_files(bytes, std::make_shared<FrameKinds>());
}

/// The error of decode_files for these bytes, or "".
std::string refusal(const std::string& bytes)
{
  try
  {
    decode(bytes);
    return "";
  }
  catch (const Error& error)
  {
    return error.text();
  }
}
}

TEST(FileIndexArchive, AllThatIsKnownComesBack)
{
  const Files files = some_files("runs/");
  const auto kinds = std::make_shared<FrameKinds>();
  const Files decoded = decode_files(encode_files(files), kinds);
  EXPECT_EQ(text_of(decoded), text_of(files));
  for (const FileIndex& file : decoded)
  {
    EXPECT_EQ(file.error, nullptr);
    EXPECT_EQ(file.kinds, kinds);
  }
  // the kinds are those of the store, each once
  ASSERT_EQ(decoded.size(), 4u);
  EXPECT_EQ(decoded[0].frames[0].kind, decoded[2].frames[2].kind);
  EXPECT_EQ(decoded[1].frames[0].kind, kinds->share(*files[1].frames[0].kind));
}

TEST(FileIndexArchive, OfNoFilesThereIsNothing)
{
  EXPECT_TRUE(decode(encode_files({})).empty());
}

TEST(FileIndexArchive, AFrameTakesNoMoreThanWhatIsKnownOfIt)
{
  FileIndex file = binary_file("a");
  const std::size_t before = encode_files({ file }).size();
  file.frames.resize(10'002, file.frames[0]);
  EXPECT_EQ(encode_files({ file }).size() - before, 64u * 10'000);
}

TEST(FileIndexArchive, TrapAnyPieceMissing)
{
  const std::string good = encode_files(some_files(""));
  for (std::size_t size = 0; size < good.size(); ++size)
  {
    EXPECT_NE(refusal(good.substr(0, size)), "") << size;
  }
  EXPECT_NE(refusal(good + '\0'), "");
}

TEST(FileIndexArchive, TrapKindsThatNoFileHas)
{
  using enum ValueType;
  const auto with = [](const Names& names, const std::vector<ValueType>& types, int layout)
  {
    FileIndex file = binary_file("a");
    file.frames.resize(1);
    file.frames[0].kind = kind_of(names, types, "", layout);
    return refusal(encode_files({ file }));
  };
  const auto last = static_cast<int>(binary_layouts().size()) - 1;
  EXPECT_EQ(with({ "id" }, {}, FrameKind::text), "");
  EXPECT_EQ(with({ "id" }, {}, last), "");
  EXPECT_EQ(with({ "id" }, {}, FrameKind::bare), "");
  EXPECT_EQ(
    with({ "id" }, {}, FrameKind::bare - 1), "expected a layout of frames, got something else");
  EXPECT_EQ(with({}, {}, 0), "expected a column, got something else");
  EXPECT_EQ(with({ "word" }, { Text }, FrameKind::text), "");
  EXPECT_EQ(with({ "element" }, { Int32 }, 0), "");
  EXPECT_EQ(with({ "word" }, { Text }, 0), "expected a column of texts, got something else");
}

/// A count of anything: it comes back, with an Error or without.
TEST(FileIndexArchive, AnyBytes)
{
  const std::string good = encode_files(some_files(""));
  int accepted = 0;
  for (std::size_t at = 0; at < good.size(); ++at)
  {
    for (const char value : { '\0', '\1', '\x7f', '\xff' })
    {
      std::string bytes = good;
      bytes[at] = value;
      accepted += refusal(bytes).empty() ? 1 : 0;
      bytes.replace(at, std::min<std::size_t>(8, good.size() - at), 8, value);
      refusal(bytes);
    }
  }
  EXPECT_GT(accepted, 0) << "of a name any byte may be another";
}
