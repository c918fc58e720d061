// SPDX-License-Identifier: BSD-3-Clause
// Files of every kind at strange places and under strange names, read and written through the C interface. What is read under
// a plain name is the reference.
#include "runs.h"

#include "../support/apart.h"
#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

using namespace runs;

namespace
{
class Places : public OwnFolder
{
};

/// A name, and how a message shows it.
struct Name
{
  std::string name;
  std::string shown;
};

const Name strange_names[] = {
  { "a b", "a b" },
  { "quote'\"`", "quote'\"`" },
  { "new\nline", "new\\nline" },
  { "tab\there", "tab\\there" },
  { "bell\a\x1b[31m\x7f", "bell\\x07\\x1b[31m\\x7f" },
  { "back\\slash", "back\\slash" },
  { "per%cent %d %s", "per%cent %d %s" },
  { "st*r", "st*r" },
  { "b[r]a?k", "b[r]a?k" },
  { "[", "[" },
  { "-dash", "-dash" },
  { "#~$(HOME);&|<>", "#~$(HOME);&|<>" },
  { "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80",
    "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80" }, // a umlaut, euro, a face
  { "\xff\xfe\xc3", "\\xff\\xfe\\xc3" },      // not UTF-8
  { "\xc2\x9b\xed\xa0\x80\xc0\xaf",
    "\\xc2\\x9b\\xed\\xa0\\x80\\xc0\\xaf" }, // a control character, a surrogate, overlong
  { std::string(240, 'n'), std::string(240, 'n') },
};

/// A message names a file as it is shown, and says more of it on the same line; the path is as it is.
void expect_shown(const std::string& shown, const std::string& path)
{
  EXPECT_TRUE(message().starts_with(shown)) << message();
  EXPECT_EQ(granular_last_error()->path, path);
  EXPECT_EQ(message().find('\n'), std::string::npos) << message();
}

/// All that is no file, made in a folder, and how it is refused.
std::map<std::string, std::string> no_files(const std::string& folder)
{
  const std::string device = "expected a file, got a device or a pipe";
  const std::string directory = "expected a file, got a directory: name the files in it";
  const std::string missing = "no such file or folder";
  const std::string unfit = "no file fits the pattern";
  ::mkfifo((folder + "/pipe").c_str(), 0644);
  fs::create_directory(folder + "/folder");
  fs::create_directory(folder + "/case[1]");
  const std::pair<const char*, const char*> links[] = { { "pipe", "to_pipe" },
    { "folder", "to_folder" }, { "/dev/zero", "to_device" }, { "loop", "loop" },
    { "none", "dangling" } };
  for (const auto& [target, link] : links)
  {
    fs::create_symlink(target, folder + "/" + link);
  }
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  const fs::path before = fs::current_path();
  fs::current_path(folder); // the name of a socket is short
  const sockaddr_un name = { AF_UNIX, "socket" };
  EXPECT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0);
  fs::current_path(before);
  ::close(socket);
  return { { folder + "/pipe", device }, { folder + "/to_pipe", device },
    { folder + "/to_device", device }, { folder + "/socket", device }, { "/dev/null", device },
    { "/dev/zero", device }, { "/dev/full", device }, { folder, directory },
    { folder + "/folder", directory }, { folder + "/to_folder", directory },
    { folder + "/loop", "cannot open: Too many levels of symbolic links" },
    { folder + "/dangling", "cannot open: No such file or directory" },
    { "/proc/self/status",
      "expected a file of a known size, got one of the system's, as in /proc" },
    { folder + "/missing", missing }, { folder + "/missing/below", missing },
    { folder + "/case[1]/missing", missing }, // the signs are those of a folder that there is
    { folder + "/open[", missing },           // not a set
    { folder + "/missing/below_*", unfit }, { folder + "/m?ssing", unfit },
    { folder + "/missing.%", unfit }, { folder + "/missing_[0-9]", unfit } };
}
}

TEST_F(Places, AreReadUnderStrangeNames)
{
  for (const Kind& kind : kinds)
  {
    const std::string source = file_of(kind);
    const Seen plain = look(source, kind.kind);
    ASSERT_EQ(plain.status, GRANULAR_OK) << kind.name << plain.text;
    for (const auto& [name, shown] : strange_names)
    {
      SCOPED_TRACE(std::string(kind.name) + " " + shown);
      const std::string folder = this->path(name);
      fs::create_directory(folder);
      const std::string file = folder + "/" + name + kind.ending;
      fs::copy_file(source, file);
      EXPECT_EQ(look(file, kind.kind), plain);
      EXPECT_EQ(files_of(folder).size(), 1u);
      EXPECT_EQ(look(folder + "/*" + kind.ending, kind.kind), plain);
      EXPECT_EQ(look(folder + "/*", kind.kind), plain);

      const granular_kind other =
        kind.kind == GRANULAR_KIND_RESTART ? GRANULAR_KIND_EULER : GRANULAR_KIND_RESTART;
      EXPECT_NE(look(file, other).status, GRANULAR_OK);
      expect_shown(this->path(shown) + "/" + shown + kind.ending, file);
      fs::remove_all(folder);
    }
  }
}

TEST_F(Places, AreWrittenUnderStrangeNames)
{
  for (const Output& output : outputs)
  {
    const std::string plain = this->path(std::string("plain") + output.ending);
    ASSERT_EQ(convert(good(output.file), plain), Seen{});
    for (const auto& [name, shown] : strange_names)
    {
      SCOPED_TRACE(std::string(output.name) + " " + shown);
      const std::string folder = this->path(name);
      fs::create_directory(folder);
      EXPECT_EQ(convert(good(output.file), folder + "/" + name + output.ending), Seen{});
      const std::map<std::string, std::string> files = files_of(folder);
      if (name.find('*') == std::string::npos) // which stands for the timestep in the last part
      {
        ASSERT_EQ(files.size(), 1u);
        EXPECT_EQ(files.begin()->second, content(plain));
        // in dumps `%` stands for the rank
        EXPECT_TRUE(files.contains(name + output.ending) || name.find('%') != std::string::npos);
      }
      EXPECT_EQ(convert(good(output.file), folder + "/no/" + name + output.ending).status,
        GRANULAR_IO_ERROR);
      EXPECT_TRUE(message().starts_with(this->path(shown) + "/no/")) << message();
      EXPECT_EQ(message().find('\n'), std::string::npos) << message();
      fs::remove_all(folder);
    }
  }
}

TEST_F(Places, WhereThereIsNoFileNothingIsRead)
{
  for (const auto& [path, why] : no_files(this->folder()))
  {
    for (int kind = GRANULAR_KIND_AUTOMATIC; kind <= GRANULAR_KIND_DECOMPOSITION; ++kind)
    {
      EXPECT_EQ(look(path, static_cast<granular_kind>(kind)),
        (Seen{ GRANULAR_IO_ERROR, path + ": " + why }));
    }
  }
}

TEST_F(Places, WhereThereIsNoFileNothingIsWritten)
{
  no_files(this->folder());
  const std::map<std::string, std::string> before = files_of(this->folder());
  for (const Output& output : outputs)
  {
    const std::string link =
      this->path("link" + std::string(output.ending)); // the ending says what is written
    for (const std::string place :
      { "pipe", "to_pipe", "to_device", "socket", "folder", "to_folder", "loop", "missing/file",
        "pipe/file", "/dev/null", "/dev/full", "/proc/file" })
    {
      fs::create_symlink(place, link);
      EXPECT_EQ(convert(good(output.file), link).status, GRANULAR_IO_ERROR) << place << output.name;
      EXPECT_TRUE(message().starts_with(link + ": cannot write: ")) << message();
      EXPECT_TRUE(fs::is_symlink(link));
      fs::remove(link);
      EXPECT_EQ(files_of(this->folder()), before) << place;
    }
  }
  EXPECT_TRUE(fs::is_fifo(this->path("pipe")) && fs::is_socket(this->path("socket")));
}

TEST_F(Places, LinksAreFiles)
{
  for (const Kind& kind : kinds)
  {
    SCOPED_TRACE(kind.name);
    const std::string source = file_of(kind);
    const Seen plain = look(source, kind.kind);
    const std::string folder = this->path(kind.name);
    fs::create_directories(folder + "/data");
    fs::copy_file(source, folder + "/data/7" + kind.ending);
    fs::create_directory_symlink("data", folder + "/far");
    fs::create_symlink("far/7" + std::string(kind.ending), folder + "/first");
    fs::create_symlink("first", folder + "/link_7" + kind.ending);
    fs::create_hard_link(folder + "/data/7" + kind.ending, folder + "/hard" + kind.ending);
    for (const std::string& path :
      { folder + "/link_7" + kind.ending, folder + "/far/7" + kind.ending,
        folder + "/hard" + kind.ending, folder + "/link_*" + kind.ending })
    {
      EXPECT_EQ(look(path, kind.kind), plain) << path;
    }
  }
}

/// A folder that may not be listed is not one without files.
TEST_F(Places, FoldersThatMayNotBeRead)
{
  fs::create_directory(this->path("locked"));
  fs::copy_file(good(kinds[0].file), this->path("locked/a_1.dump"));
  ASSERT_EQ(::chmod(this->path("locked").c_str(), 0), 0);
  const Ended ended = run_apart(
    [&]
    {
      if (!become_nobody() || ::access(this->folder().c_str(), X_OK) != 0)
      {
        return std::string("skip");
      }
      return look(this->path("locked/a_*.dump")).text + "\n" +
        look(this->path("locked/a_1.dump")).text;
    });
  ASSERT_EQ(::chmod(this->path("locked").c_str(), 0755), 0);
  if (ended.text == "skip")
  {
    GTEST_SKIP() << "root may read everything, and another user does not reach this folder";
  }
  const std::string refused = this->path("locked/") + ": cannot list the folder: Permission denied";
  EXPECT_EQ(ended.text, refused + "\n" + refused);
}
