// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_hash_h
#define granular_common_hash_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace granular
{
/// A hash that detects changed bytes; it does not withstand deliberate forgery. After FNV-1a (Fowler, Noll, Vo), eight bytes
/// at a time. The division of the bytes into calls is part of the hash.
class Hash
{
public:
  void add(const void* data, std::size_t bytes) noexcept
  {
    const char* at = static_cast<const char*>(data);
    // long data in four lanes, because each step waits for the one before
    if (bytes >= sizeof(Lanes))
    {
      Lanes lanes = { value_, ~value_, value_ << 1, ~value_ << 1 };
      for (; bytes >= sizeof(Lanes); bytes -= sizeof(Lanes), at += sizeof(Lanes))
      {
        for (std::size_t i = 0; i < std::size(lanes); ++i)
        {
          std::uint64_t word = 0;
          std::memcpy(&word, at + i * sizeof word, sizeof word);
          lanes[i] = mixed(lanes[i], word);
        }
      }
      for (const std::uint64_t lane : lanes)
      {
        value_ = mixed(value_, lane);
      }
    }
    for (; bytes >= sizeof(std::uint64_t); bytes -= sizeof(std::uint64_t))
    {
      this->mix(at, sizeof(std::uint64_t));
      at += sizeof(std::uint64_t);
    }
    this->mix(at, bytes);
  }

  std::uint64_t value() const noexcept { return value_; }

private:
  using Lanes = std::uint64_t[4];

  static std::uint64_t mixed(std::uint64_t value, std::uint64_t word) noexcept
  {
    value = (value ^ word) * 0x100000001b3;
    return value ^ value >> 32;
  }

  void mix(const char* from, std::size_t bytes) noexcept
  {
    std::uint64_t word = bytes; // the length tells an end of zeros from none
    std::memcpy(&word, from, bytes);
    value_ = mixed(value_, word);
  }

  std::uint64_t value_ = 0xcbf29ce484222325;
};
}
#endif
