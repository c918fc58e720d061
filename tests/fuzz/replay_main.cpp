// SPDX-License-Identifier: BSD-3-Clause
// A main for fuzz targets without libFuzzer: feeds every file named on the command line, and every
// file of every folder named there, to the target once, and a few times damaged and as the target's own
// mutator changes it. A crash is the failure; so is an empty corpus, which would test nothing.

#include "../support/file_damage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace
{
file_damage::Random chance;
}

/// Instead of libFuzzer's: damage, the same in each run.
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most)
{
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  std::string other = file_damage::damage(bytes.empty() ? "0" : bytes, bytes, chance);
  other.resize(std::min(other.size(), most));
  other.copy(reinterpret_cast<char*>(data), other.size());
  return other.size();
}

namespace
{
constexpr unsigned mutations = 8; // every second one by the target's own mutator
constexpr std::size_t most_growth = 4096;

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

bool replay(const std::filesystem::path& input, bool mutate)
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
  for (unsigned seed = 1; mutate && seed <= mutations; ++seed)
  {
    std::vector<std::uint8_t> other = data;
    other.resize(data.size() + most_growth);
    chance.seed(seed);
    const std::size_t size = LLVMFuzzerCustomMutator && seed % 2 == 0
      ? LLVMFuzzerCustomMutator(other.data(), data.size(), other.size(), seed)
      : LLVMFuzzerMutate(other.data(), data.size(), other.size());
    const std::vector<std::uint8_t> exact(other.data(), other.data() + size);
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
  }
  return true;
}

} // namespace

int main(int argc, char** argv)
{
  std::size_t count = 0;
  // "as_is" first: no mutations, as where lines are counted
  const bool mutate = argc < 2 || std::string_view(argv[1]) != "as_is";
  for (int i = mutate ? 1 : 2; i < argc; ++i)
  {
    for (const std::filesystem::path& input : inputs_of(argv[i]))
    {
      if (!replay(input, mutate))
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
