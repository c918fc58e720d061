// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/byte_sink.h"

#include "granular/base/error.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace granular
{
namespace
{
/// A file that is there under its name once it is complete, and until then under another.
class NewFile
{
public:
  explicit NewFile(const std::string& target)
    : target_(target)
  {
    // what crashed programs left behind, and what other threads are writing, is passed over
    constexpr int most_tries = 1000;
    const std::string begin =
      target.substr(0, target.rfind('/') + 1) + ".granular-" + std::to_string(::getpid()) + "-";
    for (int number = 0; file_ < 0; ++number)
    {
      name_ = begin + std::to_string(number) + ".tmp";
      file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && ((errno != EEXIST && errno != EINTR) || number == most_tries))
      {
        this->fail();
      }
    }
  }

  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  ~NewFile()
  {
    if (file_ >= 0)
    {
      ::close(file_);
    }
    if (!name_.empty())
    {
      ::unlink(name_.c_str());
    }
  }

  void write(std::string_view bytes)
  {
    while (!bytes.empty())
    {
      const ssize_t done = ::write(file_, bytes.data(), bytes.size());
      if (done < 0 && errno != EINTR)
      {
        this->fail();
      }
      bytes.remove_prefix(done > 0 ? static_cast<std::size_t>(done) : 0);
    }
  }

  void finish()
  {
    const int file = file_;
    file_ = -1;
    // a full disk behind a network may show here first
    if ((::close(file) != 0 && errno != EINTR) || std::rename(name_.c_str(), target_.c_str()) != 0)
    {
      this->fail();
    }
    name_.clear();
  }

private:
  [[noreturn]] void fail() const
  {
    const int error = errno;
    throw IoError("cannot write: " + std::generic_category().message(error), { target_ },
      static_cast<std::errc>(error));
  }

  std::string target_;
  std::string name_; ///< until it has that of the target
  int file_ = -1;
};
}

void write_file(const std::string& path, std::string_view bytes)
{
  NewFile file(path);
  file.write(bytes);
  file.finish();
}
}
