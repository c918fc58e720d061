// SPDX-License-Identifier: BSD-3-Clause
// A main for fuzz targets without libFuzzer: feeds every file named on the command line, and every
// file of every folder named there, to the target once. A crash is the failure; so is an empty
// corpus, which would test nothing.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{

// The order of a folder's entries is the file system's: sorted, a failing run can be repeated.
std::vector<std::filesystem::path> inputs_of(const std::filesystem::path& name)
{
  std::vector<std::filesystem::path> inputs;
  if (!std::filesystem::is_directory(name))
  {
    inputs.push_back(name);
    return inputs;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(name))
  {
    if (entry.is_regular_file())
    {
      inputs.push_back(entry.path());
    }
  }
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

bool replay(const std::filesystem::path& input)
{
  std::ifstream stream(input, std::ios::binary);
  if (!stream)
  {
    std::fprintf(stderr, "cannot read %s\n", input.c_str());
    return false;
  }
  // In a buffer of exactly this size a sanitizer sees a read past the end.
  const std::vector<char> bytes{ std::istreambuf_iterator<char>(stream), {} };
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  std::printf("%s (%zu bytes)\n", input.c_str(), data.size());
  std::fflush(stdout);
  LLVMFuzzerTestOneInput(data.data(), data.size());
  return true;
}

} // namespace

int main(int argc, char** argv)
{
  std::size_t count = 0;
  for (int i = 1; i < argc; ++i)
  {
    for (const std::filesystem::path& input : inputs_of(argv[i]))
    {
      if (!replay(input))
      {
        return 1;
      }
      ++count;
    }
  }
  if (count == 0)
  {
    std::fprintf(stderr, "no inputs: name a folder that holds at least one file\n");
    return 1;
  }
  std::printf("%zu inputs\n", count);
  return 0;
}
