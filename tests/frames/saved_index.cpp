// SPDX-License-Identifier: BSD-3-Clause
// What is known of the files of a run, kept in a file between openings: it must come back as it
// was, or not at all, and never stand against what the files hold.
#include "granular/frames/saved_index.h"
#include "granular/dump/formats/dump_files.h"

#include "../support/byte_source_packing.h"
#include "../support/own_folder.h"

#include "granular/common/hash.h"
#include "granular/dump/formats/binary_header.h"
#include "granular/dump/read/dump_reader.h"
#include "granular/frames/run_index.h"
#include "granular/frames/saved_index.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;
using namespace granular;
using Files = std::vector<FileIndex>;
using Names = std::vector<std::string>;
using Steps = std::vector<std::int64_t>;

class IndexFileTest : public OwnFolder
{
protected:
  using OwnFolder::folder;

  std::string folder(const std::string& name) const
  {
    fs::create_directories(this->path(name));
    return this->path(name);
  }
};

std::string content(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
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

// ---- indexes made by hand ----------------------------------------------------------------------

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

/// All that is kept of a file.
std::string text_of(const FileIndex& file)
{
  std::ostringstream out;
  out << file.path << " " << file.stamp.size << " " << file.stamp.modified << " "
      << file.stamp.inode << " " << file.stamp.device << " " << file.ends_hash << " "
      << file.unnamed << " " << file.compressed << "\n"
      << lines_of(file.notices) << (file.defect ? to_string(*file.defect) : "no defect") << "\n";
  for (const Notice& notice : file.notices)
  {
    out << notice.where.line << " " << notice.where.byte << " " << notice.where.column << "\n";
  }
  for (const std::string& name : file.column_names)
  {
    out << "'" << name << "' ";
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

Files load(const std::string& path, const std::string& first_file, std::string& said)
{
  Notices notices;
  Files files = load_index(path, first_file, std::make_shared<FrameKinds>(), notices);
  said = lines_of(notices);
  return files;
}

/// What decode_index says of bytes, or "".
std::string refusal(const std::string& bytes)
{
  try
  {
    decode_index(bytes, "a.dump", std::make_shared<FrameKinds>());
    return "";
  }
  catch (const Error& error)
  {
    return error.text();
  }
}

/// The bytes with a hash at their end that fits: only what they say can be wrong then.
std::string sealed(std::string bytes)
{
  const std::size_t size = bytes.size() - sizeof(std::uint64_t);
  Hash hash;
  hash.add(bytes.data(), size);
  const std::uint64_t value = hash.value();
  std::memcpy(bytes.data() + size, &value, sizeof value);
  return bytes;
}

/// What is said of an index that somebody changed, hash and all.
std::string refusal(const FileIndex& file)
{
  return refusal(encode_index({ file }));
}
}

// ---- what is written is read -------------------------------------------------------------------

TEST_F(IndexFileTest, AllThatIsKnownComesBack)
{
  const Files files = some_files("runs/");
  const std::string path = this->path("index");
  Notices notices;
  save_index(path, files, notices);
  EXPECT_EQ(lines_of(notices), "");
  const auto kinds = std::make_shared<FrameKinds>();
  const Files loaded = load_index(path, "runs/a.dump", kinds, notices);
  EXPECT_EQ(lines_of(notices), "");
  EXPECT_EQ(text_of(loaded), text_of(files));
  for (const FileIndex& file : loaded)
  {
    EXPECT_TRUE(file.loaded);
    EXPECT_EQ(file.error, nullptr);
    EXPECT_EQ(file.kinds, kinds);
  }
  // the kinds are those of the store, each once
  ASSERT_EQ(loaded.size(), 4u);
  EXPECT_EQ(loaded[0].frames[0].kind, loaded[2].frames[2].kind);
  EXPECT_EQ(loaded[1].frames[0].kind, kinds->share(*files[1].frames[0].kind));
}

TEST_F(IndexFileTest, OfNoFilesThereIsNothing)
{
  EXPECT_EQ(refusal(encode_index({})), "");
  EXPECT_TRUE(decode_index(encode_index({}), "a", std::make_shared<FrameKinds>()).empty());
}

TEST_F(IndexFileTest, AFileWithAnErrorIsReadAgainNextTime)
{
  Files files = some_files("");
  files[0].error = std::make_exception_ptr(IoError("cannot read"));
  Files others(files.begin() + 1, files.end());
  const Files loaded =
    decode_index(encode_index(files), files[0].path, std::make_shared<FrameKinds>());
  EXPECT_EQ(text_of(loaded), text_of(others));
}

TEST_F(IndexFileTest, AFrameTakesNoMoreThanWhatIsKnownOfIt)
{
  FileIndex file = binary_file("a");
  const std::size_t before = encode_index({ file }).size();
  file.frames.resize(10'002, file.frames[0]);
  EXPECT_EQ(encode_index({ file }).size() - before, 64u * 10'000);
}

TEST_F(IndexFileTest, PathsAreSpelledAsTheUserDoes)
{
  const auto paths = [](const Names& names, const std::string& first_file)
  {
    Files files;
    for (const std::string& name : names)
    {
      files.push_back(text_file(name));
    }
    Names loaded;
    for (const FileIndex& file :
      decode_index(encode_index(files), first_file, std::make_shared<FrameKinds>()))
    {
      loaded.push_back(file.path);
      EXPECT_EQ(file.notices[0].where.path, file.path);
      EXPECT_EQ(file.notices[1].where.path, "/elsewhere/b.dump");
      EXPECT_EQ(file.defect->where.path, file.path);
    }
    return loaded;
  };
  // opened again in the same way
  for (const Names& names : { Names{ "a", "b", "c/d", "../e", "./f", "/g" },
         Names{ "./a", "./b", "b", "../c" }, Names{ "/r/a", "/r/b", "/r//c", "/rr/d", "/r/", "e" },
         Names{ "r/1/a", "r/2/b", "r/1/c/../d", "/r/1/e" }, Names{ "/a", "/b/c", "d" } })
  {
    EXPECT_EQ(paths(names, names[0]), names);
  }
  // below another folder, or spelled in another way
  EXPECT_EQ(paths({ "/r/a", "/r/b", "/r/c/d" }, "/new/run/a"),
    (Names{ "/new/run/a", "/new/run/b", "/new/run/c/d" }));
  EXPECT_EQ(paths({ "a", "b" }, "/r/a"), (Names{ "/r/a", "/r/b" }));
  EXPECT_EQ(paths({ "/r/a", "/r/b" }, "a"), (Names{ "a", "b" }));
  EXPECT_EQ(paths({ "/r/a", "/q/b" }, "/s/a"), (Names{ "/s/a", "/q/b" }));
}

// ---- where it is -------------------------------------------------------------------------------

TEST_F(IndexFileTest, PlaceOfTheIndexFile)
{
  ::setenv("HOME", "/home/somebody", 1);
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(index_file_path(KeepIndex::Never, "a.dump"), "");
  EXPECT_EQ(index_file_path(KeepIndex::Beside, "r/a.dump"), "r/a.dump.granular.idx");
  EXPECT_EQ(index_file_path(KeepIndex::Beside, ""), "");
  EXPECT_EQ(index_file_path(KeepIndex::Cache, ""), "");

  const std::string cached = index_file_path(KeepIndex::Cache, "/r/a.dump");
  const std::string folder = "/home/somebody/.cache/granular/";
  const std::string end = "-a.dump.granular.idx";
  ASSERT_TRUE(cached.starts_with(folder)) << cached;
  ASSERT_TRUE(cached.ends_with(end)) << cached;
  const std::string digits =
    cached.substr(folder.size(), cached.size() - folder.size() - end.size());
  EXPECT_EQ(digits.size(), 16u);
  EXPECT_EQ(digits.find_first_not_of("0123456789abcdef"), digits.npos) << digits;
  // the same file, and another one of that name
  EXPECT_EQ(index_file_path(KeepIndex::Cache, "/r/b/../a.dump"), cached);
  EXPECT_NE(index_file_path(KeepIndex::Cache, "/s/a.dump"), cached);
  const std::string here = fs::current_path().string() + "/a.dump";
  EXPECT_EQ(index_file_path(KeepIndex::Cache, "./a.dump"), index_file_path(KeepIndex::Cache, here));
  // a name as long as may be
  EXPECT_LE(
    fs::path(index_file_path(KeepIndex::Cache, std::string(255, 'x'))).filename().string().size(),
    255u);

  ::setenv("XDG_CACHE_HOME", "/cache", 1);
  EXPECT_EQ(index_file_path(KeepIndex::Cache, "/r/a.dump"), "/cache/granular/" + digits + end);
  for (const char* none : { "", "relative/cache" })
  {
    ::setenv("XDG_CACHE_HOME", none, 1);
    EXPECT_EQ(index_file_path(KeepIndex::Cache, "/r/a.dump"), cached);
  }
  ::setenv("HOME", "relative/home", 1);
  EXPECT_EQ(index_file_path(KeepIndex::Cache, "/r/a.dump"), "");
  ::unsetenv("HOME");
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(index_file_path(KeepIndex::Cache, "/r/a.dump"), "");
}

TEST_F(IndexFileTest, TheFolderOfTheCacheIsMadeAndNoOther)
{
  ::setenv("XDG_CACHE_HOME", this->path("home/cache").c_str(), 1);
  const Files files = { text_file("/r/a.dump") };
  std::string said;
  for (int time = 0; time < 2; ++time)
  {
    const std::string path = index_file_path(KeepIndex::Cache, "/r/a.dump");
    Notices notices;
    save_index(path, files, notices);
    EXPECT_EQ(lines_of(notices), "");
    EXPECT_EQ(text_of(load(path, "/r/a.dump", said)), text_of(files));
    EXPECT_EQ(said, "");
  }
  const std::string mistyped = this->path("mistyped/a.dump");
  Notices notices;
  save_index(index_file_path(KeepIndex::Beside, mistyped), { text_file(mistyped) }, notices);
  EXPECT_EQ(lines_of(notices),
    mistyped +
      ".granular.idx: cannot write the index file: No such file or directory; the index is "
      "not kept\n");
  EXPECT_FALSE(fs::exists(this->path("mistyped")));
}

TEST_F(IndexFileTest, WithoutFramesThereIsNothingToKeep)
{
  Notices notices;
  save_index(this->path("index"), { empty_file("a") }, notices);
  save_index(this->path("index"), {}, notices);
  EXPECT_EQ(lines_of(notices), "");
  EXPECT_FALSE(fs::exists(this->path("index")));
}

TEST_F(IndexFileTest, WhereNothingMayBeWritten)
{
  const std::string folder = this->folder("locked");
  ASSERT_EQ(::chmod(folder.c_str(), 0555), 0);
  const bool root = ::geteuid() == 0;
  constexpr uid_t nobody = 65534;
  if (root && ::seteuid(nobody) != 0)
  {
    GTEST_SKIP() << "root may write everywhere here";
  }
  Notices notices;
  save_index(folder + "/index", { text_file(folder + "/a.dump") }, notices);
  if (root)
  {
    ASSERT_EQ(::seteuid(0), 0);
  }
  ASSERT_EQ(::chmod(folder.c_str(), 0755), 0);
  EXPECT_EQ(lines_of(notices),
    folder + "/index: cannot write the index file: Permission denied; the index is not kept\n");
}

// ---- what is no index --------------------------------------------------------------------------

TEST_F(IndexFileTest, OneThatIsNotThereIsNoNews)
{
  std::string said;
  EXPECT_TRUE(load(this->path("missing"), "a", said).empty());
  EXPECT_EQ(said, "");
  EXPECT_TRUE(load(this->path("missing/index"), "a", said).empty());
  EXPECT_EQ(said, "");
  EXPECT_TRUE(load(this->write("file", "") + "/index", "a", said).empty());
  EXPECT_EQ(said, "");
}

TEST_F(IndexFileTest, OneThatCannotBeReadIsSaid)
{
  std::string said;
  const std::string folder = this->folder("index");
  EXPECT_TRUE(load(folder, "a", said).empty());
  EXPECT_EQ(said,
    folder + ": the index file cannot be read: expected a file, got a directory; it is ignored\n");
}

TEST_F(IndexFileTest, TrapAnyByteDamagedAnyPieceMissing)
{
  const std::string good = encode_index(some_files(""));
  ASSERT_EQ(refusal(good), "");
  for (std::size_t at = 0; at < good.size(); ++at)
  {
    for (const int flipped : { 0x01, 0x80, 0xff })
    {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flipped);
      EXPECT_NE(refusal(bytes), "") << at;
    }
    EXPECT_NE(refusal(good.substr(0, at)), "") << at;
  }
  EXPECT_NE(refusal(good + '\0'), "");
  EXPECT_NE(refusal(good + good), "");
  EXPECT_NE(refusal(std::string(good.size(), '\0')), "");
}

TEST_F(IndexFileTest, OneThatIsDamagedIsIgnoredAndSaid)
{
  const std::string good = encode_index(some_files(""));
  for (const std::string& bad : { good.substr(0, 10), good.substr(0, good.size() - 1), good + "x" })
  {
    const std::string path = this->write("index", bad);
    std::string said;
    EXPECT_TRUE(load(path, "a.dump", said).empty());
    EXPECT_EQ(said, path + ": the index file is damaged: " + refusal(bad) + "; it is ignored\n");
  }
}

TEST_F(IndexFileTest, SaysWhatIsWrong)
{
  const std::string good = encode_index(some_files(""));
  const auto with = [&](std::size_t at, char byte)
  {
    std::string bytes = good;
    bytes[at] = byte;
    return refusal(bytes);
  };
  EXPECT_EQ(refusal(""), "expected at least 24 bytes, got 0");
  EXPECT_EQ(with(0, 'I'), "expected the first bytes of an index file, got others");
  EXPECT_EQ(with(16, 'x'), "expected bytes that fit the hash at their end, got others");
  std::string swapped = good;
  std::reverse(swapped.begin() + 8, swapped.begin() + 12);
  EXPECT_EQ(refusal(swapped), "expected the byte order of this machine, got another");

  std::uint32_t version = 0;
  std::memcpy(&version, good.data() + 12, sizeof version);
  const std::uint32_t next = version + 1;
  std::string newer = good;
  std::memcpy(newer.data() + 12, &next, sizeof next);
  std::string said;
  const std::string path = this->write("index", sealed(newer));
  EXPECT_TRUE(load(path, "a.dump", said).empty());
  EXPECT_EQ(said,
    path + ": the index file is of another version: expected " + std::to_string(version) +
      ", got " + std::to_string(next) + "; it is ignored\n");
}

// Such bytes no disk makes by accident, but a folder may come from anywhere: what does not fit
// together is refused before it is used, and before memory is taken for it.
TEST_F(IndexFileTest, TrapNumbersThatDoNotFitTogether)
{
  const FileIndex text = text_file("a");
  const FileIndex binary = binary_file("a");
  ASSERT_EQ(refusal(text), "");
  ASSERT_EQ(refusal(binary), "");
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  const std::string misplaced = "expected a frame within its file, got something else";
  struct Place
  {
    std::int64_t rows, offset, end, line;
  };
  for (const Place& bad : { Place{ -1, 0, 100, 1 }, Place{ 1, -1, 100, 1 }, Place{ 1, 100, 99, 1 },
         Place{ 1, 0, 100, -1 }, Place{ 101, 0, 100, 1 }, Place{ largest, 0, 100, 1 },
         Place{ 1, 0, largest, 1 }, Place{ 1, largest, largest, 1 }, Place{ 1, 0, 100, largest },
         Place{ 1, 1500, text.stamp.size + 1, 1 }, Place{ 1, 1500, 1600, 1502 } })
  {
    FileIndex file = text;
    FrameEntry& frame = file.frames[1];
    frame.rows = bad.rows;
    frame.offset = bad.offset;
    frame.end = bad.end;
    frame.line = bad.line;
    EXPECT_EQ(refusal(file), misplaced) << bad.rows << " " << bad.offset << " " << bad.end;
  }
  FileIndex file = binary;
  file.frames[0].rows = (file.frames[0].end - file.frames[0].offset) / (4 * 8) + 1;
  EXPECT_EQ(refusal(file), misplaced) << "four doubles a row";
  file = binary;
  file.frames.push_back(text.frames[0]);
  file.frames.back().offset = file.frames[1].end;
  file.frames.back().end = file.frames.back().offset + 1000;
  EXPECT_EQ(refusal(file), "expected frames of the same layout, got something else");
  file = text;
  file.frames[1].offset = file.frames[0].end - 1;
  EXPECT_EQ(refusal(file), "expected frames one behind the other, got something else");
  file = text;
  file.compressed = true; // 12345 bytes are 2^15 times as many at most
  file.stamp.size = 12345;
  file.frames[2].end = std::int64_t{ 12345 } << 15;
  EXPECT_EQ(refusal(file), "");
  ++file.frames[2].end;
  EXPECT_EQ(refusal(file), misplaced);

  const std::string place = "expected a place in a file, got something else";
  for (const std::int64_t bad : { std::int64_t{ -1 }, largest })
  {
    file = text;
    file.resume_offset = bad;
    EXPECT_EQ(refusal(file), place);
    file = text;
    file.resume_line = bad;
    EXPECT_EQ(refusal(file), place);
    file = text;
    file.stamp.size = bad;
    EXPECT_EQ(refusal(file), "expected the size of a file, got something else");
  }
}

TEST_F(IndexFileTest, TrapKindsThatNoFileHas)
{
  using enum ValueType;
  const auto with = [](const Names& names, const std::vector<ValueType>& types, int layout)
  {
    FileIndex file = binary_file("a");
    file.frames.resize(1);
    file.frames[0].kind = kind_of(names, types, "", layout);
    return refusal(file);
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

TEST_F(IndexFileTest, RowsMayBeInTheFilesOfProcesses)
{
  FileIndex file;
  file.path = "base.restart";
  file.stamp.size = 994;
  file.beside = { { "0.restart", { 12'000, 1, 2, 3 } }, { "1.restart", {} } };
  file.frames = { { 7, 12'994, 0, 994, 0, FrameEntry::no_time, FrameEntry::whole,
    kind_of({}, {}, "", FrameKind::text) } };
  EXPECT_EQ(refusal(file), "");
  // cells are a product: as many as there are bytes along each of three axes
  constexpr std::int64_t bytes = 12'994;
  file.frames[0].rows = bytes * bytes * bytes;
  EXPECT_EQ(refusal(file), "");
  file.frames[0].rows += bytes * bytes;
  EXPECT_EQ(refusal(file), "expected a frame within its file, got something else");
}

TEST_F(IndexFileTest, TrapSeekPointsThatNoFileHas)
{
  const auto with = [](const SeekPoints::Point& point, std::int64_t spacing)
  {
    FileIndex file = compressed_file("a");
    file.stamp.size = 20'000;
    file.points->points.push_back(point);
    file.points->spacing = spacing;
    return refusal(file);
  };
  const std::string window(32768, 'w');
  const std::string outside = "expected a seek point within its file, got something else";
  EXPECT_EQ(with({ 2'000'000, 20'000, 7, 0, 0, window }, 1), "");
  EXPECT_EQ(with({ 2'000'000, 20'001, 7, 0, 0, window }, 1), outside);
  EXPECT_EQ(with({ 2'000'000, -1, 0, 0, 0, "" }, 1), outside);
  EXPECT_EQ(with({ 2'000'000, 0, 1, 0, 0, window }, 1), outside);
  EXPECT_EQ(with({ 2'000'000, 1000, 8, 0, 0, window }, 1), outside);
  EXPECT_EQ(with({ 2'000'000, 1000, 0, 0, 0, window + "w" }, 1),
    "expected a window of gzip, got something else");
  EXPECT_EQ(
    with({ 999'999, 1000, 0, 0, 0, "" }, 1), "expected increasing seek points, got something else");
  EXPECT_EQ(with({ 2'000'000, 1000, 0, 0, 0, "" }, 0),
    "expected a spacing of seek points, got something else");
}

TEST_F(IndexFileTest, AnythingBehindAHashThatFits)
{
  const std::string good = encode_index(some_files(""));
  int accepted = 0;
  for (std::size_t at = 16; at + 8 < good.size(); ++at)
  {
    for (const char value : { '\0', '\1', '\x7f', '\xff' })
    {
      std::string bytes = good;
      bytes[at] = value;
      accepted += refusal(sealed(bytes)).empty() ? 1 : 0;
      bytes.replace(at, std::min<std::size_t>(8, good.size() - 8 - at), 8, value);
      refusal(sealed(bytes)); // a count of anything: what matters is that it comes back
    }
    refusal(sealed(good.substr(0, at) + std::string(8, '\0')));
  }
  EXPECT_GT(accepted, 0) << "of a name any byte may be another";
}

// ---- with the files of a run -------------------------------------------------------------------

namespace
{
/// A frame of rows grains, whose x is the timestep.
std::string frame(std::int64_t step, int rows = 100)
{
  const std::string number = std::to_string(step);
  std::string text = "ITEM: TIMESTEP\n" + number + "\nITEM: NUMBER OF ATOMS\n" +
    std::to_string(rows) + "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n";
  for (int row = 1; row <= rows; ++row)
  {
    text += std::to_string(row) + " " + number + " 0.5 0.25\n";
  }
  return text;
}

/// Frames of steps first, first + 1, ...
std::string frames(std::int64_t first, int count)
{
  std::string text;
  for (int i = 0; i < count; ++i)
  {
    text += frame(first + i);
  }
  return text;
}

Steps steps_from(std::int64_t first, int count)
{
  Steps steps;
  for (int i = 0; i < count; ++i)
  {
    steps.push_back(first + i);
  }
  return steps;
}

/// As when a user opens the files in a program just started. said: all notices, one a line.
struct Opened
{
  explicit Opened(const Names& files, KeepIndex where = KeepIndex::Beside)
  {
    this->update(files, where);
  }

  void update(const Names& files, KeepIndex where = KeepIndex::Beside)
  {
    IndexOptions options = { .format = &granular::dump_format() };
    options.keep_index = where;
    Notices notices;
    Progress progress;
    index.update(files, options, notices, progress);
    said = lines_of(notices);
  }

  Steps steps() const
  {
    Steps steps;
    for (std::size_t i = 0; i < index.size(); ++i)
    {
      steps.push_back(index.first_piece(i).entry.timestep);
    }
    return steps;
  }

  RunIndex index;
  std::string said;
};

/// Changes the file so that nobody sees it who does not read it anew: in the middle, as long as it
/// was, at the same time. The header there is none any more.
void spoil(const std::string& path)
{
  const auto time = fs::last_write_time(path);
  const std::string text = content(path);
  const std::size_t at = text.find("ITEM: TIMESTEP", text.size() / 2);
  ASSERT_GT(text.size(), 16384u);
  ASSERT_LT(at, text.size() - 4096);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at));
    file << "ITEM: TIMESHARE";
  }
  fs::last_write_time(path, time);
}

void move_time(const std::string& path, int seconds)
{
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(seconds));
}

void append(const std::string& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary | std::ios::app) << text;
}
}

/// Which layouts there are only the format knows, which meets the index with the file.
TEST_F(IndexFileTest, TrapALayoutThatTheFormatHasNot)
{
  const std::string path = this->write("a.dump", frames(0, 3));
  Opened first({ path });
  const std::string kept = path + ".granular.idx";
  Notices notices;
  Files files = load_index(kept, path, std::make_shared<FrameKinds>(), notices);
  ASSERT_EQ(files.size(), 1u);
  auto kind = std::make_shared<FrameKind>(*files[0].frames[0].kind);
  kind->layout = static_cast<int>(binary_layouts().size());
  for (FrameEntry& frame : files[0].frames)
  {
    frame.kind = kind;
  }
  save_index(kept, files, notices);
  Opened again({ path });
  EXPECT_EQ(again.steps(), steps_from(0, 3));
  EXPECT_EQ(again.index.first_piece(0).entry.kind->layout, FrameKind::text);
}

TEST_F(IndexFileTest, ASecondOpeningDoesNotReadTheFile)
{
  const std::string path = this->write("a.dump", frames(0, 20));
  Opened first({ path });
  EXPECT_EQ(first.steps(), steps_from(0, 20));
  EXPECT_EQ(first.said, "");
  EXPECT_TRUE(fs::exists(path + ".granular.idx"));
  spoil(path);
  ASSERT_LT(Opened({ path }, KeepIndex::Never).steps().size(), 20u) << "who reads it sees it";
  const Opened second({ path });
  EXPECT_EQ(second.steps(), steps_from(0, 20));
  EXPECT_EQ(second.said, "");
  EXPECT_FALSE(second.index.changed());
  EXPECT_EQ(text_of(second.index.files()), text_of(first.index.files()));
}

/// Nothing is decompressed where each file has one frame, and a file that has more than the index says is not shown as if it had not.
TEST_F(IndexFileTest, ASecondOpeningDoesNotDecompressFilesOfAFrameEach)
{
  for (const bool gzip : { true, false })
  {
    const auto pack = [&](const std::string& text) {
      return gzip ? packing::gzip(text) : packing::zstd(text, { 3, true, false });
    };
    const std::string text = frame(5, 20000);
    const std::string good = pack(text);
    const std::string path = this->write("a.dump.gz", good);
    const Opened first({ path });
    EXPECT_EQ(first.steps(), steps_from(5, 1));
    const auto time = fs::last_write_time(path);
    std::string damaged = good;
    ASSERT_GT(damaged.size(), 10'200U);
    for (std::size_t i = damaged.size() / 2; i < damaged.size() / 2 + 1000; ++i)
    {
      damaged[i] = static_cast<char>(~damaged[i]);
    }
    this->write("a.dump.gz", damaged);
    fs::last_write_time(path, time);
    EXPECT_THROW(Opened({ path }, KeepIndex::Never), FormatError) << "who reads it sees it";
    const Opened second({ path });
    EXPECT_EQ(second.steps(), steps_from(5, 1));
    EXPECT_EQ(second.said, "");
    EXPECT_FALSE(second.index.changed());

    // the index of a longer file says that it ends with its first frame
    const std::string longer = pack(text + frame(6, 30000));
    this->write("a.dump.gz", longer);
    const Opened both({ path });
    EXPECT_EQ(both.steps(), steps_from(5, 2));
    const std::string kept = path + ".granular.idx";
    Notices notices;
    Files files = load_index(kept, path, std::make_shared<FrameKinds>(), notices);
    ASSERT_EQ(files.size(), 1U);
    files[0].frames.resize(1);
    files[0].points.reset();
    save_index(kept, files, notices);
    const Opened hidden({ path });
    ASSERT_EQ(hidden.steps(), steps_from(5, 1));
    Progress progress;
    try
    {
      read_dump(hidden.index.pieces(0), {}, notices, progress);
      ADD_FAILURE() << "a frame is hidden in silence";
    }
    catch (const FormatError& error)
    {
      EXPECT_EQ(std::string(error.what()),
        path +
          ": expected the end of the content where the index file says, got more; remove the index "
          "file");
    }
    fs::remove(kept);
  }
}

TEST_F(IndexFileTest, InTheCacheOfTheUser)
{
  ::setenv("XDG_CACHE_HOME", this->path("cache").c_str(), 1);
  const std::string path = this->write("a.dump", frames(0, 20));
  Opened first({ path }, KeepIndex::Cache);
  EXPECT_FALSE(fs::exists(path + ".granular.idx"));
  spoil(path);
  EXPECT_EQ(Opened({ path }, KeepIndex::Cache).steps(), steps_from(0, 20));
  // spelled in another way
  const fs::path before = fs::current_path();
  fs::current_path(fs::path(path).parent_path());
  EXPECT_EQ(Opened({ "a.dump" }, KeepIndex::Cache).steps(), steps_from(0, 20));
  fs::current_path(before);
  EXPECT_EQ(Opened({ path }, KeepIndex::Cache).steps(), steps_from(0, 20));
}

TEST_F(IndexFileTest, NeverMeansNever)
{
  ::setenv("XDG_CACHE_HOME", this->path("cache").c_str(), 1);
  const std::string path = this->write("a.dump", frames(0, 20));
  Opened({ path }, KeepIndex::Never);
  EXPECT_FALSE(fs::exists(path + ".granular.idx"));
  EXPECT_FALSE(fs::exists(this->path("cache")));
}

TEST_F(IndexFileTest, AFileThatGrewIsReadFromWhereItEnded)
{
  const std::string path = this->write("a.dump", frames(0, 20) + frame(20).substr(0, 200));
  Opened first({ path });
  EXPECT_EQ(first.steps(), steps_from(0, 20));
  spoil(path);
  append(path, frame(20).substr(200) + frames(21, 5));
  const Opened second({ path });
  EXPECT_EQ(second.steps(), steps_from(0, 26));
  EXPECT_EQ(second.said, "");
  // and is kept as it is now
  EXPECT_EQ(Opened({ path }).steps(), steps_from(0, 26));
}

TEST_F(IndexFileTest, AFileThatChangedIsReadAnew)
{
  const std::string path = this->write("a.dump", frames(10, 20));
  const auto size = fs::file_size(path);
  const auto time = fs::last_write_time(path);
  EXPECT_EQ(Opened({ path }).steps(), steps_from(10, 20));
  // another file of that name, as long and of the same time
  const std::string other = this->write("b.dump", frames(40, 20));
  fs::last_write_time(other, time);
  fs::rename(other, path);
  ASSERT_EQ(fs::file_size(path), size);
  EXPECT_EQ(Opened({ path }).steps(), steps_from(40, 20));
  // longer, shorter
  this->write("a.dump", frames(50, 30));
  EXPECT_EQ(Opened({ path }).steps(), steps_from(50, 30));
  this->write("a.dump", frames(50, 10));
  EXPECT_EQ(Opened({ path }).steps(), steps_from(50, 10));
  // at another time: what lies between its ends may be another
  this->write("a.dump", frames(10, 20));
  EXPECT_EQ(Opened({ path }).steps(), steps_from(10, 20));
  spoil(path);
  move_time(path, 10);
  EXPECT_LT(Opened({ path }).steps().size(), 20u);
}

TEST_F(IndexFileTest, AFolderMayBeMovedOrCopied)
{
  this->folder("run/rank");
  const Names files = { this->write("run/a.dump", frames(0, 20)),
    this->write("run/rank/b.dump", frames(20, 20)) };
  EXPECT_EQ(Opened(files).steps(), steps_from(0, 40));
  spoil(files[0]);
  spoil(files[1]);
  fs::rename(this->path("run"), this->path("moved"));
  EXPECT_EQ(Opened({ this->path("moved/a.dump"), this->path("moved/rank/b.dump") }).steps(),
    steps_from(0, 40));
  // copied as by cp -a, and opened from within
  this->folder("copy/rank");
  for (const char* name : { "/a.dump", "/rank/b.dump", "/a.dump.granular.idx" })
  {
    const std::string from = this->path("moved") + name;
    const std::string to = this->path("copy") + name;
    fs::copy_file(from, to);
    fs::last_write_time(to, fs::last_write_time(from));
  }
  const fs::path before = fs::current_path();
  fs::current_path(this->path("copy"));
  const Opened copy({ "a.dump", "rank/b.dump" });
  EXPECT_EQ(copy.steps(), steps_from(0, 40));
  EXPECT_FALSE(copy.index.changed());
  fs::current_path(before);
}

TEST_F(IndexFileTest, FilesComeAndGo)
{
  const std::string a = this->write("a.dump", frames(0, 20));
  const std::string b = this->write("b.dump", frames(20, 20));
  const std::string c = this->write("c.dump", frames(40, 20));
  EXPECT_EQ(Opened({ a, b }).steps(), steps_from(0, 40));
  spoil(a);
  spoil(b);
  fs::remove(b);
  const Opened second({ a, b, c });
  Steps steps = steps_from(0, 20);
  for (const std::int64_t step : steps_from(40, 20))
  {
    steps.push_back(step);
  }
  EXPECT_EQ(second.steps(), steps);
  EXPECT_EQ(second.said, b + ": cannot open: No such file or directory; the file is left out\n");
  spoil(c);
  this->write("b.dump", frames(20, 20));
  EXPECT_EQ(Opened({ a, b, c }).steps(), steps_from(0, 60));
}

TEST_F(IndexFileTest, ADamagedIndexIsSaidAndWrittenAnew)
{
  const std::string path = this->write("a.dump", frames(0, 20));
  const std::string kept = path + ".granular.idx";
  const Opened first({ path });
  const std::string good = content(kept);
  for (const std::string& bad :
    { good.substr(0, good.size() / 2), good.substr(0, 100) + "x" + good.substr(101) })
  {
    std::ofstream(kept, std::ios::binary | std::ios::trunc) << bad;
    const Opened second({ path });
    EXPECT_EQ(text_of(second.index.files()), text_of(first.index.files()));
    EXPECT_TRUE(second.said.starts_with(kept + ": the index file is damaged: ")) << second.said;
    EXPECT_EQ(content(kept), good);
    EXPECT_EQ(Opened({ path }).said, "");
  }
}

// A stranger's archive may hold anything under the name of an index, and links to files of the user.
TEST_F(IndexFileTest, NoLinkAndNoOtherFileIsReplaced)
{
  const std::string path = this->write("a.dump", frames(0, 20));
  const std::string kept = path + ".granular.idx";
  const std::string other = this->write("other", "of the user");
  for (const bool is_link : { true, false })
  {
    fs::remove(kept);
    is_link ? fs::create_symlink(other, kept) : fs::rename(other, kept);
    const Opened opened({ path });
    EXPECT_EQ(opened.steps(), steps_from(0, 20));
    EXPECT_TRUE(opened.said.ends_with(
      kept + ": cannot write the index file: File exists; the index is not kept\n"))
      << opened.said;
    EXPECT_EQ(content(kept), "of the user");
    EXPECT_EQ(fs::is_symlink(kept), is_link);
  }
}

TEST_F(IndexFileTest, WhatCannotBeKeptIsSaidAndTheRunOpens)
{
  const std::string path = this->write("a.dump", frames(0, 20));
  this->folder("a.dump.granular.idx");
  const Opened opened({ path });
  EXPECT_EQ(opened.steps(), steps_from(0, 20));
  const std::string kept = path + ".granular.idx: ";
  EXPECT_EQ(opened.said,
    kept + "the index file cannot be read: expected a file, got a directory; it is ignored\n" +
      kept + "cannot write the index file: Is a directory; the index is not kept\n");
}

TEST_F(IndexFileTest, NothingIsWrittenWhereNothingChanged)
{
  const std::string path = this->write("a.dump", frames(0, 20));
  const std::string kept = path + ".granular.idx";
  Opened first({ path });
  const FileStamp before = stamp_of(kept);
  first.update({ path });
  EXPECT_EQ(Opened({ path }).said, "");
  EXPECT_EQ(stamp_of(kept), before);
  append(path, frame(20));
  first.update({ path });
  EXPECT_NE(stamp_of(kept), before);
  EXPECT_EQ(Opened({ path }).steps(), steps_from(0, 21));
}

TEST_F(IndexFileTest, WhatWasLeftOutIsSaidAtEveryOpening)
{
  const std::string good = frame(0);
  const std::string path = this->write(
    "a.dump", good + frame(1).substr(0, frame(1).rfind('\n', frame(1).size() - 2) + 1) + frame(2));
  const std::string said = Opened({ path }).said;
  EXPECT_NE(said.find("the frame is left out"), std::string::npos) << said;
  EXPECT_EQ(Opened({ path }).said, said);
  append(path, frame(3));
  EXPECT_EQ(Opened({ path }).said, said);
  EXPECT_EQ(Opened({ path }).said, said);
}

TEST_F(IndexFileTest, WhatIsNoDumpGetsNoIndex)
{
  const std::string path = this->write("photo.jpg", "\xff\xd8\xff\xe0 no dump at all\n");
  EXPECT_THROW(Opened({ path }), Error);
  EXPECT_FALSE(fs::exists(path + ".granular.idx"));
}
