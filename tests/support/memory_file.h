// SPDX-License-Identifier: BSD-3-Clause
// Files in memory that are no dumps, and damage that is done to them.
#ifndef granular_tests_support_memory_file_h
#define granular_tests_support_memory_file_h

#include "dumps.h"
#include "resident_memory.h"

#include "granular/frames/file_index.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

/// A file in memory, called "memory" in messages, with its index. Frame: what becomes of a frame.
template <class Frame>
class MemoryFile
{
public:
  using Read = std::function<Frame(const granular::ByteSource&, const granular::FrameEntry&,
    granular::Notices&, granular::Progress&)>;

  MemoryFile(const granular::FileFormat& format, Read read, std::string bytes)
    : format_(format)
    , read_(std::move(read))
  {
    this->grow(std::move(bytes));
  }

  /// Goes on as if the file had grown to that.
  void grow(std::string bytes)
  {
    bytes_ = std::make_unique<std::string>(std::move(bytes));
    source_ = granular::open_memory(*bytes_);
    granular::Progress progress;
    format_.index(*source_, index_, progress, {});
  }

  const granular::FileIndex& index() const { return index_; }
  std::size_t frames() const { return index_.frames.size(); }
  const granular::FrameEntry& entry(std::size_t frame = 0) const { return index_.frames.at(frame); }
  std::string said() const { return lines_of(index_.notices); }
  std::string defect() const { return index_.defect ? to_string(*index_.defect) : ""; }
  const granular::ByteSource& source() const { return *source_; }

  Frame read(std::size_t frame = 0)
  {
    granular::Progress progress;
    notices_.clear();
    return read_(*source_, this->entry(frame), notices_, progress);
  }

  /// The notices of the last reading, one a line.
  std::string told() const { return lines_of(notices_); }

  std::string error(std::size_t frame = 0)
  {
    return error_of([&] { this->read(frame); });
  }

private:
  const granular::FileFormat& format_;
  Read read_;
  std::unique_ptr<std::string> bytes_;
  std::unique_ptr<granular::ByteSource> source_;
  granular::FileIndex index_;
  granular::Notices notices_;
};

/// Calls use for each text that differs from a good one in one byte.
inline void change_each_byte(
  const std::string& good, const std::function<void(const std::string&)>& use)
{
  for (std::size_t at = 0; at < good.size(); ++at)
  {
    for (const char byte : { '\0', '\n', '#', '9', '\xff' })
    {
      std::string text = good;
      text[at] = byte;
      use(text);
    }
  }
}

/// Calls use for each text that has other counts than a good one.
inline void change_each_count(
  const std::string& good, const std::function<void(const std::string&)>& use)
{
  for (std::size_t at = 1; at < good.size(); ++at)
  {
    const bool number =
      good[at] >= '0' && good[at] <= '9' && (good[at - 1] == ' ' || good[at - 1] == '"');
    for (const char* claim : { "1000000000000000000", "9223372036854775807", "16777216", "0" })
    {
      if (number)
      {
        use(good.substr(0, at) + claim + good.substr(at + 1));
      }
    }
  }
}

#endif
