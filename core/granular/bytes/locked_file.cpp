// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_sink.h"

#include "granular/bytes/system_calls.h"
#include "granular/common/hash.h"

#include <array>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
constexpr int most_tries = 1000; // numbers that are looked at
constexpr int most_processes = 1000000;
constexpr int other_file = -1; // no error of the system

/// The folder of the target, and the begin of a name: the target's own name may have 255 bytes already.
std::string begin_of_names(const std::string& target)
{
  const std::string machine = os::machine(); // without a name all machines are one
  const std::size_t begin = target.rfind('/') + 1;
  Hash hash;
  hash.add(machine.data(), machine.size());
  hash.add(target.data() + begin, target.size() - begin);
  std::array<char, 17> digits = {};
  std::snprintf(digits.data(), digits.size(), "%016llx",
    static_cast<unsigned long long>(hash.value())); // NOLINT: the type of the format
  return target.substr(0, begin) + ".granular-" + digits.data() + "-";
}

std::string numbered(const std::string& begin, int number)
{
  return begin + std::to_string(number) + ".tmp";
}

/// Returns 0 if a name is that of an open file, other_file if it is not, or why the system does not tell.
int compare_name(const std::string& name, int file) noexcept
{
  os::Status there;
  os::Status open;
  if (os::status_of(file, open) != 0 || (os::status_of(name, there) != 0 && errno != ENOENT))
  {
    return errno;
  }
  return there.stamp.inode == open.stamp.inode && there.stamp.device == open.stamp.device
    ? 0
    : other_file;
}

/// Returns nothing if there is no such file.
FileStamp look_at(const std::string& name) noexcept
{
  os::Status there;
  return os::status_of(name, there) == 0 ? there.stamp : FileStamp{};
}

/// 0, or the reason. A lock is that of the open file: a thread keeps out the others of its program, too.
int lock(int file)
{
  return os::lock(file) == 0 ? 0 : errno;
}

/// Removes a file whose writer is surely dead. Returns false if there is no file that might be one.
bool remove_left(const std::string& name)
{
  const std::string data = name + LockedFile::data_ending;
  const std::size_t begin = data.rfind('/') + 1;
  const std::string folder = begin == 0 ? "." : data.substr(0, begin);
  const int file = os::open(name, os::Opening::WriteSame);
  if (file < 0)
  {
    return false;
  }
  os::Status state;
  if (os::status_of(file, state) == 0 && state.kind == os::Kind::File &&
    state.owner == os::user() && lock(file) == 0 && compare_name(name, file) == 0)
  {
    os::remove(data);                           // first: they are found by the last
    os::remove_all(folder, data.substr(begin)); // of Open MPI, and folders of the package
    os::remove(name);
  }
  os::close(file);
  return true;
}
}

LockedFile::LockedFile(const std::string& target, unsigned permissions)
  : process_(os::process())
{
  constexpr int most_free = 8; // names in a row: writers that ended have left gaps between others
  const std::string begin = begin_of_names(target);
  for (int number = 0, free = 0; free < most_free && number < most_tries; ++number)
  {
    free = remove_left(numbered(begin, number)) ? 0 : free + 1;
  }
  for (int tries = 0, number = 0; tries < most_tries; ++tries, ++number)
  {
    name_ = numbered(begin, number);
    file_ = os::open(name_, os::Opening::Create, permissions);
    if (file_ < 0 && errno != EEXIST && errno != EINTR)
    {
      throw std::system_error(errno, std::generic_category());
    }
    // another may have taken the new file for one that was left, before it was locked
    if (file_ < 0)
    {
      continue;
    }
    const int locked = lock(file_);
    const int error = locked == EWOULDBLOCK ? other_file : compare_name(name_, file_);
    if (error == 0 && (locked == 0 || number >= most_tries))
    {
      return;
    }
    if (error != other_file)
    {
      os::remove(name_);
    }
    os::close(file_);
    if (error != 0 && error != other_file)
    {
      throw std::system_error(error, std::generic_category());
    }
    if (error == 0)
    {
      // Without a lock it would pass for one that was left as soon as another gets one: nobody looks at numbers like this.
      number = most_tries * (1 + static_cast<int>(os::process() % most_processes));
    }
  }
  throw std::system_error(EEXIST, std::generic_category());
}

LockedFile::~LockedFile()
{
  // where the system does not tell, the name is that of this file, as it was a moment ago
  const bool has_name = file_ >= 0 ? compare_name(name_, file_) != other_file : this->has_name();
  if (this->is_own() && has_name)
  {
    os::remove(name_);
  }
  if (file_ >= 0)
  {
    os::close(file_);
  }
}

void LockedFile::close() noexcept
{
  os::settle(file_);
  closed_ = look_at(name_);
  os::close(std::exchange(file_, -1));
}

bool LockedFile::is_own() const noexcept
{
  return os::process() == process_;
}

bool LockedFile::has_name() const noexcept
{
  // a closed file by its time as well: numbers of files are given again
  return file_ >= 0 ? compare_name(name_, file_) == 0
                    : closed_ != FileStamp{} && look_at(name_) == closed_;
}
}
