// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_own_folder_h
#define granular_tests_support_own_folder_h

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

/// A folder of its own for each test, empty at first.
class OwnFolder : public ::testing::Test
{
protected:
  void SetUp() override
  {
    folder_ = std::string(GRANULAR_OUTPUT) + "/" +
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }

  const std::string& folder() const { return folder_; }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  std::string write(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(this->path(name), std::ios::binary | std::ios::trunc) << bytes;
    return this->path(name);
  }

private:
  std::string folder_;
};

#endif
