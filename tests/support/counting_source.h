// SPDX-License-Identifier: BSD-3-Clause
// Bytes in memory, and how many of them were read.
#ifndef granular_tests_support_counting_source_h
#define granular_tests_support_counting_source_h

#include "granular/bytes/byte_source.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

/// The bytes must live as long as it does.
class CountingSource final : public granular::ByteSource
{
public:
  explicit CountingSource(std::string_view bytes)
    : source_(granular::open_memory(bytes))
  {
  }

  const std::string& path() const override { return source_->path(); }
  granular::FileStamp stamp() const override { return source_->stamp(); }
  bool concurrent() const override { return true; }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    const std::size_t got = source_->read(offset, buffer, bytes);
    bytes_read_ += static_cast<std::int64_t>(got);
    return got;
  }

  std::int64_t bytes_read() const { return bytes_read_; }

private:
  std::unique_ptr<granular::ByteSource> source_;
  mutable std::atomic<std::int64_t> bytes_read_ = 0;
};

#endif
