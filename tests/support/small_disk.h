// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_small_disk_h
#define granular_tests_support_small_disk_h

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

/// A file system of 256 KiB, there where this is root and may mount one.
class SmallDisk
{
public:
  explicit SmallDisk(std::string folder)
    : folder_(std::move(folder))
  {
    std::filesystem::create_directories(folder_);
    there_ = run("mount -t tmpfs -o size=256k none");
  }

  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  ~SmallDisk()
  {
    if (there_)
    {
      run("umount -l");
    }
  }

  bool there() const noexcept { return there_; }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  static constexpr const char* not_there = "only root may mount a small disk, and not everywhere";

private:
  bool run(const std::string& command) const
  {
    return std::system((command + " '" + folder_ + "' 2> /dev/null").c_str()) == 0;
  }

  std::string folder_;
  bool there_ = false;
};

#endif
