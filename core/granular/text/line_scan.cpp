// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/line_scan.h"

#include "granular/common/words.h"

#include <algorithm>
#include <bit>
#include <cstring>

#if GRANULAR_X86
#include <immintrin.h>
#endif

namespace granular
{
namespace
{
LineScan scan_portable(const char* first, const char* last, char mark, LineState state) noexcept
{
  LineScan scan{ first };
  while (scan.ptr < last && !(state.start && *scan.ptr == mark))
  {
    const void* const feed = std::memchr(scan.ptr, '\n', static_cast<std::size_t>(last - scan.ptr));
    const char* const end = feed ? static_cast<const char*>(feed) : last;
    const bool blank = state.blank && std::all_of(scan.ptr, end, is_blank);
    if (!feed)
    {
      scan.ptr = last;
      state = { false, blank };
      break;
    }
    scan.ptr = end + 1;
    scan.after_last_feed = scan.ptr;
    ++scan.feeds;
    scan.blank_lines += blank ? 1 : 0;
    state = {};
  }
  scan.state = state;
  return scan;
}

#if GRANULAR_X86
/// Bytes of a block; bit i is byte i.
struct Block64
{
  std::uint64_t feeds;
  std::uint64_t words; ///< bytes above ' '
  std::uint64_t marks;
};

/// Masks for blocks of number rows. A line that begins with a usual byte has a word.
struct UsualBlock64
{
  std::uint64_t feeds;
  std::uint64_t unusual; ///< bytes outside first_usual to last_usual
};

// From the first byte above ' ' to the last before the letters: digits, signs and the point are usual, the I of ITEM is not.
constexpr char first_usual = '!';
constexpr char last_usual = '@';

#define GRANULAR_TARGET __attribute__((target("avx2,bmi,popcnt")))

GRANULAR_TARGET inline std::uint64_t joined(__m256i low, __m256i high) noexcept
{
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(high))) << 32 |
    static_cast<std::uint32_t>(_mm256_movemask_epi8(low));
}

GRANULAR_TARGET inline __m256i is_word(__m256i bytes) noexcept
{
  return _mm256_cmpeq_epi8(_mm256_max_epu8(bytes, _mm256_set1_epi8(' ' + 1)), bytes);
}

GRANULAR_TARGET inline __m256i is_unusual(__m256i bytes) noexcept
{
  constexpr int smallest = -128; // AVX2 compares signed bytes, so first_usual is moved here
  return _mm256_cmpgt_epi8(
    _mm256_sub_epi8(bytes, _mm256_set1_epi8(static_cast<char>(first_usual - smallest))),
    _mm256_set1_epi8(static_cast<char>(smallest + last_usual - first_usual)));
}

GRANULAR_TARGET inline UsualBlock64 load_usual(const char* block) noexcept
{
  const __m256i low = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block));
  const __m256i high = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block + 32));
  const __m256i feed = _mm256_set1_epi8('\n');
  return { joined(_mm256_cmpeq_epi8(low, feed), _mm256_cmpeq_epi8(high, feed)),
    joined(is_unusual(low), is_unusual(high)) };
}

GRANULAR_TARGET inline Block64 load(const char* block, char mark) noexcept
{
  const __m256i low = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block));
  const __m256i high = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block + 32));
  const __m256i feed = _mm256_set1_epi8('\n');
  const __m256i marks = _mm256_set1_epi8(mark);
  return { joined(_mm256_cmpeq_epi8(low, feed), _mm256_cmpeq_epi8(high, feed)),
    joined(is_word(low), is_word(high)),
    joined(_mm256_cmpeq_epi8(low, marks), _mm256_cmpeq_epi8(high, marks)) };
}

GRANULAR_TARGET LineScan scan_avx2(
  const char* first, const char* last, char mark, LineState state) noexcept
{
  std::uint64_t start = state.start ? 1 : 0;
  std::uint64_t blank = state.blank ? 1 : 0;
  LineScan scan{ last };
  std::uint64_t last_feeds = 0; // from which after_last_feed is made at the end
  const char* block_of_last = first;
  const bool usual_mark = mark >= first_usual && mark <= last_usual;
  for (const char* block = first; block < last; block += 64)
  {
    const bool whole = last - block >= 64;
    if (whole && !usual_mark)
    {
      // In nearly all blocks of rows each line that begins here starts with a usual byte, and the line at hand has a word or begins
      // here. So no line that ends here is blank, and none begins with the mark.
      const UsualBlock64 bytes = load_usual(block);
      const std::uint64_t starts = bytes.feeds << 1 | start;
      if (((starts & bytes.unusual) | (blank & ~start)) == 0)
      {
        scan.feeds += std::popcount(bytes.feeds);
        block_of_last = bytes.feeds != 0 ? block : block_of_last;
        last_feeds = bytes.feeds != 0 ? bytes.feeds : last_feeds;
        start = blank = bytes.feeds >> 63;
        continue;
      }
    }
    Block64 bytes = load(block, mark);
    const std::uint64_t inside =
      whole ? ~std::uint64_t{} : (std::uint64_t{ 1 } << (last - block)) - 1;
    bytes.feeds &= inside;
    // Adding a run of blanks to its first bit carries that bit to the byte behind the run: a line
    // feed there ends a line without words.
    const std::uint64_t blanks = ~(bytes.feeds | bytes.words) & inside;
    const std::uint64_t begins = bytes.feeds << 1 | blank;
    const std::uint64_t carried = (begins & blanks) + blanks;
    const std::uint64_t still_blank = (begins | carried) & ~blanks;
    const std::uint64_t found = (bytes.feeds << 1 | start) & bytes.marks & inside;
    const std::uint64_t before = found != 0 ? (found & (0 - found)) - 1 : inside;
    const std::uint64_t feeds = bytes.feeds & before;
    if (feeds != 0)
    {
      scan.feeds += std::popcount(feeds);
      scan.blank_lines += std::popcount(still_blank & feeds);
      block_of_last = block;
      last_feeds = feeds;
    }
    if (found != 0)
    {
      scan.ptr = block + std::countr_zero(found);
      break;
    }
    start = whole ? bytes.feeds >> 63 : (bytes.feeds << 1) >> (last - block) & 1;
    blank =
      whole ? bytes.feeds >> 63 | (carried < blanks ? 1 : 0) : still_blank >> (last - block) & 1;
  }
  if (scan.ptr == last)
  {
    scan.state = { start != 0, blank != 0 };
  }
  if (last_feeds != 0)
  {
    scan.after_last_feed = block_of_last + 64 - std::countl_zero(last_feeds);
  }
  return scan;
}
#undef GRANULAR_TARGET
#endif
}

LineScan scan_lines(
  const char* first, const char* last, char mark, LineState state, Simd simd) noexcept
{
#if GRANULAR_X86
  if (simd != Simd::Portable)
  {
    return scan_avx2(first, last, mark, state);
  }
#endif
  static_cast<void>(simd);
  return scan_portable(first, last, mark, state);
}

LineScan scan_to_word(const char* first, const char* last, const char* end, std::string_view word,
  LineState state) noexcept
{
  LineScan all{ first };
  all.state = state;
  for (;;)
  {
    const LineScan part = scan_lines(all.ptr, last, word.front(), all.state);
    all.ptr = part.ptr;
    all.feeds += part.feeds;
    all.blank_lines += part.blank_lines;
    all.after_last_feed = part.after_last_feed ? part.after_last_feed : all.after_last_feed;
    all.state = part.state;
    if (all.ptr >= last ||
      std::string_view(all.ptr, static_cast<std::size_t>(end - all.ptr)).starts_with(word))
    {
      return all;
    }
    ++all.ptr;
    all.state = { false, false };
  }
}
}
