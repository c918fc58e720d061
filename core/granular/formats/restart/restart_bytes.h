// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_restart_bytes_h
#define granular_formats_restart_restart_bytes_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace granular
{
/// Returns a number from bytes in this machine's order or the other one.
template <class Number>
Number load_number(const char* bytes, bool swapped) noexcept
{
  std::array<char, sizeof(Number)> own;
  std::memcpy(own.data(), bytes, own.size());
  if (swapped)
  {
    std::ranges::reverse(own);
  }
  return std::bit_cast<Number>(own);
}

/// The budget of a search, for any file: the search ends when it is used up.
struct SearchBudget
{
  std::int64_t steps = 0; ///< counts, strings and records that may still be looked at
  std::int64_t bytes = 0; ///< that may still be read from the file

  bool spent() const noexcept { return steps <= 0 || bytes <= 0; }
};

/// Numbers and strings at any byte of a file, in either byte order, through a window on it. The source must outlive it.
class RestartBytes
{
public:
  /// The largest number of bytes in a string, with its final zero.
  static constexpr std::int64_t most_text = 1024;

  /// The size of a compressed source is unknown; it counts as endless. budget: pays for reading; null: unlimited.
  explicit RestartBytes(
    const ByteSource& source, bool swapped = false, SearchBudget* budget = nullptr);

  const ByteSource& source() const noexcept { return source_; }
  std::int64_t size() const noexcept { return size_; }

  /// Returns true if the file has the other byte order.
  bool swapped() const noexcept { return swapped_; }
  void set_swapped(bool swapped) noexcept { swapped_ = swapped; }

  /// Throws FormatError, with the byte.
  [[noreturn]] void refuse(
    const std::string& expected, const std::string& got, std::int64_t offset) const;

  /// Throw FormatError that expected `what`, with the byte, where the file ends before.
  template <class Number>
  Number number_at(std::int64_t offset, std::string_view what)
  {
    return this->load<Number>(this->need(offset, sizeof(Number), what));
  }

  /// Reads a value and goes behind it.
  template <class Number>
  Number next(std::int64_t& at, std::string_view what)
  {
    const auto number = this->number_at<Number>(at, what);
    at += static_cast<std::int64_t>(sizeof(Number));
    return number;
  }

  /// Reads a string and goes behind it: the number of bytes with the final zero, then the bytes. Throws FormatError, also if
  /// the count is not in 2 .. most_text, a byte is not printable, or a zero is missing at the end or comes before.
  std::string next_text(std::int64_t& at, std::string_view what);

  /// Returns the byte behind such a string; -1 if there is none.
  std::int64_t text_end(std::int64_t offset);

  /// Returns true if there are so many bytes; false also for an offset outside the file.
  bool has(std::int64_t offset, std::size_t bytes) { return this->find(offset, bytes) != nullptr; }

  /// Returns the bytes from an offset in the window, which moves if it has fewer than requested: at least these, or all up to
  /// the end of the file. Valid until the next call.
  std::string_view view(std::int64_t offset, std::size_t at_least);

  /// Returns a number from a view.
  template <class Number>
  Number load(const char* bytes) const noexcept
  {
    return load_number<Number>(bytes, swapped_);
  }

private:
  /// Returns the bytes, or null if the file ends before.
  const char* find(std::int64_t offset, std::size_t bytes);
  const char* need(std::int64_t offset, std::size_t bytes, std::string_view what);
  void move_to(std::int64_t offset, std::size_t at_least);

  const ByteSource& source_;
  std::int64_t size_;
  bool swapped_;
  SearchBudget* budget_;
  std::vector<char> window_;
  std::int64_t begin_ = 0;    ///< of the window in the file
  std::size_t length_ = 0;    ///< bytes in it
  std::size_t next_read_ = 0; ///< grows while one window follows the other
};

/// Tries the places of a file from `begin` on, while `least` bytes are left up to `end`, at which a pair of numbers may be what is
/// searched for: is_pair(bytes, swapped, left) of so many bytes, and of those that were left a moment ago. As one loop for each
/// byte order: it goes over all bytes of a file. Ends when try_at(offset) is true. Throws IoError, Cancelled.
template <std::size_t pair_bytes, class IsPair, class TryAt>
void search_pairs(const ByteSource& source, bool swapped, std::int64_t begin, std::int64_t end,
  std::int64_t least, const IsPair& is_pair, const TryAt& try_at, Progress& progress)
{
  constexpr std::size_t window = std::size_t{ 1 } << 17;
  RestartBytes file(source, swapped);
  const auto search = [&](auto order)
  {
    for (std::int64_t at = begin; end - at >= least;)
    {
      progress.step(static_cast<double>(at - begin) / static_cast<double>(end - begin));
      const std::string_view bytes = file.view(at, window);
      if (bytes.size() < pair_bytes)
      {
        return;
      }
      const std::size_t places = bytes.size() - (pair_bytes - 1);
      const std::int64_t left = end - at;
      const auto next = [=](std::size_t i) // a loop that does nothing else is faster
      {
        while (i < places && !is_pair(bytes.data() + i, order, left))
        {
          ++i;
        }
        return i;
      };
      for (std::size_t i = next(0); i < places; i = next(i + 1))
      {
        if (try_at(at + static_cast<std::int64_t>(i)))
        {
          return;
        }
      }
      at += static_cast<std::int64_t>(places);
    }
  };
  swapped ? search(std::true_type{}) : search(std::false_type{});
}
}
#endif
