// SPDX-License-Identifier: BSD-3-Clause
// Kept indices with any of their numbers changed, and hashes that fit nevertheless: what a user sees is right, or an
// error; never other data in silence, never memory that the files have no use for.
#ifndef granular_tests_support_index_damage_h
#define granular_tests_support_index_damage_h

#include "granular/common/hash.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/frames/run_index.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace index_damage
{
/// A run whose index is kept beside its first file, and all that a user sees of a frame.
struct Run
{
  std::vector<std::string> files;
  granular::IndexOptions options = { .format = &granular::dump_format() };
  std::function<std::string(const granular::RunIndex& index, std::size_t frame)> show;

  std::string kept() const { return files.front() + std::string(granular::index_file_suffix); }
};

struct Outcomes
{
  int right = 0;
  int errors = 0;
  int told = 0;       ///< that an index is damaged, which is made anew then
  std::string silent; ///< what was changed where other data were shown, one a line
};

/// What this process may have beside what it has now. A sanitizer has memory of its own.
class MemoryLimit
{
public:
  explicit MemoryLimit(std::size_t bytes)
  {
    ::getrlimit(RLIMIT_AS, &before_);
#ifndef GRANULAR_TEST_SANITIZED
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + bytes;
    ::setrlimit(RLIMIT_AS, &limit);
#else
    static_cast<void>(bytes);
#endif
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;
  ~MemoryLimit()
  {
    ::setrlimit(RLIMIT_AS, &before_);
  }

private:
  rlimit before_ = {};
};

inline std::string content(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

inline void put(const std::string& path, const std::string& bytes)
{
  std::filesystem::remove(path); // file systems take their time to write over one
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The bytes of an index with a hash at their end that fits.
inline std::string sealed(std::string bytes)
{
  std::uint64_t value = 0;
  const std::size_t size = bytes.size() - sizeof value;
  granular::Hash hash;
  hash.add(bytes.data(), size);
  value = hash.value();
  std::memcpy(bytes.data() + size, &value, sizeof value);
  return bytes;
}

/// As in a program that was just started. Throws Error.
inline std::string open_and_show(const Run& run, granular::Notices& notices)
{
  granular::IndexOptions options = run.options;
  options.keep_index = granular::KeepIndex::Beside;
  granular::RunIndex index;
  granular::Progress progress;
  index.update(run.files, options, notices, progress);
  std::string seen;
  for (const double time : index.times(0.5))
  {
    seen += std::to_string(time) + " ";
  }
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    seen += std::to_string(index.first_piece(frame).entry.timestep) + "\n" + run.show(index, frame);
  }
  return seen;
}

inline void judge(const Run& run, const std::string& bytes, const std::string& right,
  const std::string& what, Outcomes& outcomes)
{
  put(run.kept(), sealed(bytes));
  granular::Notices notices;
  try
  {
    const std::string seen = open_and_show(run, notices);
    if (seen != right)
    {
      outcomes.silent += what + "\n";
      return;
    }
    ++outcomes.right;
  }
  catch (const granular::Error&)
  {
    ++outcomes.errors;
  }
  catch (const std::exception& error)
  {
    outcomes.silent += what + ": " + error.what() + "\n";
  }
  for (const granular::Notice& notice : notices)
  {
    outcomes.told += notice.text.find("index file is damaged") != notice.text.npos ? 1 : 0;
  }
}

/// Changes every byte, and all that eight bytes may be, at every `step`-th place.
inline Outcomes damage(const Run& run, std::size_t step = 1)
{
  constexpr std::size_t head = 16;
  std::filesystem::remove(run.kept());
  granular::Notices notices;
  const std::string right = open_and_show(run, notices);
  const std::string good = content(run.kept());
  EXPECT_GT(good.size(), head);
  const MemoryLimit limit(std::size_t{ 256 } << 20);
  Outcomes outcomes;
  for (std::size_t at = head; at + 8 < good.size(); at += step)
  {
    for (const int flipped : { 0x01, 0x80, 0xff })
    {
      std::string bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flipped);
      judge(run, bytes, right,
        "byte " + std::to_string(at) + " of " + std::to_string(good.size()) + " ^ " +
          std::to_string(flipped),
        outcomes);
    }
    constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t value : { std::int64_t{ -1 }, std::int64_t{ 0 },
           std::int64_t{ 1 } << 20, std::int64_t{ 1 } << 33, largest / 2 - 1 })
    {
      std::string bytes = good;
      std::memcpy(bytes.data() + at, &value, std::min(sizeof value, good.size() - 8 - at));
      judge(run, bytes, right,
        "bytes at " + std::to_string(at) + " of " + std::to_string(good.size()) + " = " +
          std::to_string(value),
        outcomes);
    }
  }
  std::filesystem::remove(run.kept());
  return outcomes;
}
}
#endif
