// SPDX-License-Identifier: BSD-3-Clause
// Private to byte_source_gzip.cpp and byte_source_unpack.cpp.
#ifndef granular_bytes_inflate_h
#define granular_bytes_inflate_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace granular
{
/// Inflates deflate data (RFC 1951).
class Inflate
{
public:
  /// The outcome of a call.
  struct Step
  {
    std::ptrdiff_t read =
      0; ///< bytes of input; below 0: so many bytes of earlier calls were not needed
    std::size_t written = 0;
    bool ended = false;            ///< the last block is done
    const char* damage = nullptr;  ///< why the input is no deflate data
    std::optional<int> block_bits; ///< a block begins so many bits before the end of what was read
  };

  virtual ~Inflate() = default;

  /// Goes to the first block.
  virtual void start() = 0;

  /// Goes to a block between others: `bits` (0 to 7) of its first bits are the upper ones of a byte that comes before the
  /// input, and `window` (1 to 2^15 bytes) is the content before it.
  virtual void start(int bits, unsigned byte, std::string_view window) = 0;

  /// Inflates from `input` as much as there is room for. With `to_block`, stops where a block begins, if that can be seen and all
  /// content before was written, and may stop before that. Throws std::bad_alloc.
  virtual Step inflate(std::string_view input, std::span<char> output, bool to_block) = 0;

  /// Returns the CRC-32 of bytes behind others that have the CRC-32 `before`.
  virtual std::uint32_t check(std::uint32_t before, std::string_view bytes) const noexcept = 0;
};

/// A library that inflates.
struct Inflation
{
  const char* name;
  std::unique_ptr<Inflate> (*make)();
};

/// Returns those that there are, the fastest first. Whole data give the same content with all of them. What is damaged may be refused or
/// not, as long as no sum is compared: ISA-L takes codes that are incomplete but not used. If data end within a block, up to three of
/// the last bytes may be held back, and damage in its header may be seen or not.
std::span<const Inflation> inflations() noexcept;
}
#endif
