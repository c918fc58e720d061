// SPDX-License-Identifier: BSD-3-Clause
// Files as Windows has them: names, long paths, locks, and what is replaced while others read it.
#include "granular/bytes/byte_sink.h"
#include "granular/bytes/find_files.h"

#include "../support/error_of.h"
#include "../support/own_folder.h"
#include "../support/write_file.h"

#include <algorithm>
#include <system_error>

#include <windows.h>

namespace fs = std::filesystem;

namespace
{
using granular::find_files;
using granular::open_file;

class WindowsFiles : public OwnFolder
{
protected:
  static fs::path wide(const std::string& path) { return std::u8string(path.begin(), path.end()); }

  /// Returns the name with all its folders as the library has it.
  std::string whole(const std::string& name) const
  {
    return fs::absolute(this->path(name)).generic_string();
  }

  std::vector<std::string> names() const
  {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(this->folder()))
    {
      found.push_back(entry.path().filename().string());
    }
    std::ranges::sort(found);
    return found;
  }
};

std::string content(const std::string& path)
{
  return granular::read_up_to(*open_file(path), 1000);
}

std::errc code_of(const std::string& path)
{
  try
  {
    open_file(path);
  }
  catch (const granular::IoError& error)
  {
    return error.code();
  }
  return {};
}

TEST_F(WindowsFiles, NamesOfAnyScript)
{
  // "data" in Cyrillic and Chinese letters, and "frame"
  const std::string data = "\u0434\u0430\u043d\u043d\u044b\u0435 \u6570\u636e";
  const std::string frame = "\u043a\u0430\u0434\u0440_";
  const std::string folder = this->path(data);
  fs::create_directories(wide(folder));
  for (const char* number : { "10", "2" })
  {
    write_file(folder + "/" + frame + number + ".dump", number);
  }
  const std::string whole = this->whole("") + data + "/" + frame;
  const std::vector<std::string> expected{ whole + "2.dump", whole + "10.dump" };
  EXPECT_EQ(find_files({ folder + "/" + frame + "*.dump" }), expected);
  std::string pattern = this->path("\u0434* \u6570\u636e/\u043a\u0430*_*.dump");
  std::ranges::replace(pattern, '/', '\\');
  EXPECT_EQ(find_files({ pattern }), expected);
  EXPECT_EQ(find_files({ whole + "[0-3].dump" }), std::vector{ expected[0] });
  EXPECT_EQ(content(expected[1]), "10");
  EXPECT_TRUE(fs::exists(wide(expected[0])));
}

TEST_F(WindowsFiles, PathsLongerThan260)
{
  // the marked name of the folder i folders down
  const auto down = [this](int i) -> std::string
  {
    std::string name = fs::absolute(this->folder()).make_preferred().string();
    for (int k = 0; k < i; ++k)
    {
      name += "\\" + std::string(40, static_cast<char>('a' + k));
    }
    return "\\\\?\\" + name;
  };
  constexpr int deepest = 12;
  for (int i = 1; i <= deepest; ++i)
  {
    ASSERT_TRUE(::CreateDirectoryW(wide(down(i)).c_str(), nullptr));
  }
  const std::string folder = down(deepest).substr(4) + "/";
  write_file(folder + "old.dump", "1");
  write_file(folder + "old.dump", "22");
  const std::vector<std::string> found = find_files({ folder + "*.dump" });
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(content(found[0]), "22");
  EXPECT_TRUE(::DeleteFileW(wide(down(deepest) + "\\old.dump").c_str()));
  for (int i = deepest; i > 0; --i)
  {
    EXPECT_TRUE(::RemoveDirectoryW(wide(down(i)).c_str()));
  }
}

TEST_F(WindowsFiles, ErrorsTellWhatTheSystemSays)
{
  const std::string file = this->write("file", "x");
  const auto says = [](const std::string& path) { return error_of([&] { open_file(path); }); };
  EXPECT_EQ(says(file + "s"), file + "s: cannot open: No such file or directory");
  EXPECT_EQ(code_of(file + "s"), std::errc::no_such_file_or_directory);
  EXPECT_EQ(code_of(this->path("no/file")), std::errc::no_such_file_or_directory);
  EXPECT_EQ(says(this->folder()),
    this->folder() + ": expected a file, got a directory: name the files in it");
  EXPECT_EQ(code_of(this->folder()), std::errc::is_a_directory);
  EXPECT_EQ(says("NUL"), "NUL: expected a file, got a device or a pipe");
  EXPECT_EQ(code_of("\xff"), std::errc::no_such_file_or_directory);
  const HANDLE alone =
    ::CreateFileA(file.c_str(), GENERIC_READ, 0, nullptr, OPEN_EXISTING, 0, nullptr);
  EXPECT_EQ(code_of(file), std::errc::permission_denied);
  EXPECT_EQ(error_of([&] { write_file(file, "y"); }), file + ": cannot write: Permission denied");
  ::CloseHandle(alone);
  ::SetFileAttributesA(file.c_str(), FILE_ATTRIBUTE_READONLY);
  EXPECT_EQ(error_of([&] { write_file(file, "y"); }), file + ": cannot write: Permission denied");
  ::SetFileAttributesA(file.c_str(), FILE_ATTRIBUTE_NORMAL);
  EXPECT_EQ(error_of([&] { write_file(this->folder(), ""); }),
    this->folder() + ": cannot write: Is a directory");
  EXPECT_EQ(error_of([&] { write_file(this->path("no/file"), ""); }),
    this->path("no/file") + ": cannot write: No such file or directory");
  EXPECT_EQ(content(file), "x");
  EXPECT_EQ(this->names(), std::vector<std::string>{ "file" });
}

TEST_F(WindowsFiles, ReplacesWhatIsBeingRead)
{
  const std::string file = this->write("file", "old");
  const auto reader = open_file(file);
  if (::GetProcAddress(::GetModuleHandleA("ntdll.dll"), "wine_get_version"))
  {
    EXPECT_EQ(
      error_of([&] { write_file(file, "new one"); }), file + ": cannot write: Permission denied");
    EXPECT_EQ(this->names(), std::vector<std::string>{ "file" });
    GTEST_SKIP() << "wine 8 refuses this, Windows 10 does not";
  }
  write_file(file, "new one");
  std::string old(3, ' ');
  EXPECT_EQ(reader->read(0, old.data(), 3), 3);
  EXPECT_EQ(old, "old");
  EXPECT_EQ(content(file), "new one");
  EXPECT_NE(reader->stamp(), open_file(file)->stamp());
  EXPECT_EQ(this->names(), std::vector<std::string>{ "file" });
}

TEST_F(WindowsFiles, NothingIsReplacedBeforeTheEnd)
{
  const std::string file = this->write("file", "old");
  {
    granular::NewFile begun(file);
    begun.write_at(2, "x");
    EXPECT_EQ(content(file), "old");
    EXPECT_EQ(this->names().size(), 2);
  }
  EXPECT_EQ(this->names(), std::vector<std::string>{ "file" });
  granular::NewFile held(file);
  held.write_at(0, "held");
  held.hold(true);
  EXPECT_EQ(content(file), "old");
  held.finish(true);
  EXPECT_EQ(content(file), "held");
}

TEST_F(WindowsFiles, WhatDeadProgramsLeftIsRemovedAndOthersStay)
{
  const std::string file = this->path("file");
  std::string left;
  {
    const granular::LockedFile first(file, 0);
    left = first.name();
    const granular::LockedFile second(file, 0); // does not take the first one away
    EXPECT_NE(second.name(), left);
    EXPECT_TRUE(first.has_name());
  }
  std::ofstream(wide(left)) << "left";
  std::ofstream(wide(left + ".data")) << "left";
  fs::create_directories(wide(left + ".data.files"));
  EXPECT_EQ(this->names().size(), 3);
  {
    const granular::LockedFile next(file, 0);
    EXPECT_EQ(next.name(), left);
    EXPECT_EQ(this->names().size(), 1);
  }
  EXPECT_TRUE(this->names().empty());
}

TEST_F(WindowsFiles, AProgramThatWritesItself)
{
  const std::string file = this->write("file", "old");
  granular::NewFile begun(file, granular::Locking::Others);
  std::ofstream(wide(begun.temporary_name())) << "not yet";
  fs::rename(this->write("made", "its own"), wide(begun.temporary_name()));
  begun.finish(true);
  EXPECT_EQ(content(file), "its own");
  EXPECT_EQ(this->names(), std::vector<std::string>{ "file" });
}
}
