// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_hash_h
#define granular_base_hash_h

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace granular
{
/// Tells bytes that changed from those that did not; no proof against somebody who wants it to fail.
/// After FNV-1a (Fowler, Noll, Vo), eight bytes at a time. How the bytes are split over the calls
/// is part of the hash.
class Hash
{
public:
  void add(const void* data, std::size_t bytes) noexcept
  {
    const char* at = static_cast<const char*>(data);
    for (; bytes >= sizeof(std::uint64_t); bytes -= sizeof(std::uint64_t))
    {
      this->mix(at, sizeof(std::uint64_t));
      at += sizeof(std::uint64_t);
    }
    this->mix(at, bytes);
  }

  std::uint64_t value() const noexcept { return value_; }

private:
  void mix(const char* from, std::size_t bytes) noexcept
  {
    std::uint64_t word = bytes; // the length tells an end of zeros from none
    std::memcpy(&word, from, bytes);
    value_ = (value_ ^ word) * 0x100000001b3;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value_ = 0xcbf29ce484222325;
};
}
#endif
