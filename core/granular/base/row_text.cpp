// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/row_text.h"

#include "granular/base/number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <string_view>

#if defined(__x86_64__) && defined(__GNUC__)
#define GRANULAR_X86 1
#include <immintrin.h>
#endif

namespace granular
{
namespace
{
struct RowPlan
{
  std::span<ColumnSink> sinks;
  std::uint32_t columns;
};

RowStatus store_integer(std::int64_t value, ColumnSink& sink) noexcept
{
  if (sink.kind == ColumnSink::Kind::Int64)
  {
    std::memcpy(sink.data, &value, sizeof value);
    return RowStatus::Done;
  }
  const auto narrow = static_cast<std::int32_t>(value);
  std::memcpy(sink.data, &narrow, sizeof narrow);
  return narrow == value ? RowStatus::Done : RowStatus::NotExact;
}

RowStatus store_integer(const char* first, const char* last, ColumnSink& sink) noexcept
{
  std::int64_t whole = 0;
  double number = 0;
  if (parse_int64(first, last, whole))
  {
    return store_integer(whole, sink);
  }
  return parse_double(first, last, number) ? RowStatus::NotExact : RowStatus::NotANumber;
}

RowStatus store_text(const char* first, const char* last, ColumnSink& sink) noexcept
{
  const std::string_view text(first, static_cast<std::size_t>(last - first));
  std::memcpy(sink.data, &text, sizeof text);
  return RowStatus::Done;
}

RowStatus store_double(const char* first, const char* last, ColumnSink& sink) noexcept
{
  double value = 0;
  if (!parse_double(first, last, value))
  {
    return RowStatus::NotANumber;
  }
  std::memcpy(sink.data, &value, sizeof value);
  return RowStatus::Done;
}

RowStatus store(const char* first, const char* last, ColumnSink& sink) noexcept
{
  switch (sink.kind)
  {
    case ColumnSink::Kind::Float64:
      return store_double(first, last, sink);
    case ColumnSink::Kind::Text:
      return store_text(first, last, sink);
    default:
      return store_integer(first, last, sink);
  }
}

bool is_blank(char c) noexcept
{
  return static_cast<unsigned char>(c) <= ' ';
}

/// Counts the words of [at, line_end), storing those that are wanted. count and word are of the
/// word where it stopped.
RowStatus store_row(const char* at, const char* line_end, RowPlan& plan, std::uint32_t& count,
  const char*& word) noexcept
{
  auto sink = plan.sinks.begin();
  for (count = 0;; ++count)
  {
    at = std::find_if_not(at, line_end, is_blank);
    if (at == line_end)
    {
      return count == 0 || count >= plan.columns ? RowStatus::Done : RowStatus::TooFew;
    }
    word = at;
    at = std::find_if(at, line_end, is_blank);
    if (sink != plan.sinks.end() && sink->column == count)
    {
      const RowStatus status = store(word, at, *sink);
      if (status != RowStatus::Done)
      {
        return status;
      }
      ++sink;
    }
  }
}

/// Decodes the line at result.ptr, which may be blank, the plain way.
void decode_plain_row(const char* last, RowPlan& plan, RowResult& result) noexcept
{
  const char* const line_end = std::find(result.ptr, last, '\n');
  std::uint32_t count = 0;
  const char* word = result.ptr;
  result.status = store_row(result.ptr, line_end, plan, count, word);
  if (result.status == RowStatus::Done)
  {
    result.ptr = line_end + 1;
    if (count != 0)
    {
      ++result.rows;
      result.surplus = result.surplus || count > plan.columns;
      for (ColumnSink& sink : plan.sinks)
      {
        sink.data += sink.stride;
      }
    }
  }
  else if (result.status != RowStatus::TooFew)
  {
    result.ptr = word;
    result.column = static_cast<int>(count);
  }
}

RowResult decode_portable(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  RowResult result{ first };
  while (result.ptr < last && result.rows < max_rows && result.status == RowStatus::Done)
  {
    decode_plain_row(last, plan, result);
  }
  return result;
}

#if GRANULAR_X86

constexpr std::ptrdiff_t batch_bytes = 16384;

/// Edges of words in up to batch_bytes of text; a little room more, since they are written in
/// groups without looking.
struct Edges
{
  std::uint32_t count;
  std::uint32_t lines;
  alignas(64) std::uint16_t offsets[batch_bytes + 128];
  alignas(64) std::uint16_t line_ends[batch_bytes + 128];
};

struct BlockMarks
{
  std::uint64_t words; ///< bytes above ' '
  std::uint64_t lines; ///< line feeds
};

/// &keep_last[n] is a mask of 16 bytes that keeps the last n.
constexpr auto keep_last = []
{
  std::array<std::uint8_t, 32> masks{};
  std::fill(masks.begin() + 16, masks.end(), std::uint8_t{ 0xff });
  return masks;
}();

/// drop_point[p] moves the bytes before position p up by one, over it; 16 moves none.
struct alignas(16) Shuffle : std::array<std::uint8_t, 16>
{
};

constexpr auto drop_point = []
{
  std::array<Shuffle, 17> shuffles{};
  for (std::size_t p = 0; p < 17; ++p)
  {
    for (std::size_t i = 0; i < 16; ++i)
    {
      const std::size_t from = p < 16 && i <= p ? i - 1 : i;
      shuffles[p][i] = p < 16 && i == 0 ? std::uint8_t{ 0x80 } : static_cast<std::uint8_t>(from);
    }
  }
  return shuffles;
}();

/// Digits behind a point at position p of 16.
constexpr auto digits_behind = []
{
  std::array<std::int8_t, 17> counts{};
  for (int p = 0; p < 16; ++p)
  {
    counts[static_cast<std::size_t>(p)] = static_cast<std::int8_t>(15 - p);
  }
  return counts;
}();

/// 10^p as a factor or a divisor, both exact.
struct Scale
{
  double factor;
  double divisor;
};

constexpr auto scales = []
{
  std::array<Scale, 45> table{};
  double power = 1;
  for (std::size_t p = 0; p <= 22; ++p)
  {
    table[22 + p] = { power, 1 };
    table[22 - p] = { 1, power };
    power *= 10; // exact up to 10^22
  }
  return table;
}();

namespace avx2
{
#define GRANULAR_TARGET __attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt")))

GRANULAR_TARGET inline BlockMarks mark_block(const char* block) noexcept
{
  const __m256i low = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block));
  const __m256i high = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block + 32));
  const auto mask = [](__m256i a, __m256i b) GRANULAR_TARGET
  {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(a))) |
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(b))) << 32;
  };
  const __m256i first = _mm256_set1_epi8(' ' + 1);
  const __m256i feed = _mm256_set1_epi8('\n');
  return { mask(_mm256_cmpeq_epi8(_mm256_max_epu8(low, first), low),
             _mm256_cmpeq_epi8(_mm256_max_epu8(high, first), high)),
    mask(_mm256_cmpeq_epi8(low, feed), _mm256_cmpeq_epi8(high, feed)) };
}

/// Appends the places of the bits, eight at a time: writing too many costs less than a branch.
GRANULAR_TARGET inline void append(
  std::uint64_t bits, std::uint32_t base, std::uint16_t* to, int count) noexcept
{
  for (int done = 0; done < count; done += 8)
  {
    for (int i = 0; i < 8; ++i)
    {
      to[done + i] = static_cast<std::uint16_t>(base + _tzcnt_u64(bits));
      bits = _blsr_u64(bits);
    }
  }
}

GRANULAR_TARGET inline void append_bits(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  const int count = __builtin_popcountll(bits);
  append(bits, base, edges.offsets + edges.count, count);
  edges.count += static_cast<std::uint32_t>(count);
}

GRANULAR_TARGET inline void append_lines(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  std::uint16_t* const to = edges.line_ends + edges.lines;
  to[0] = static_cast<std::uint16_t>(base + _tzcnt_u64(bits));
  to[1] = static_cast<std::uint16_t>(base + _tzcnt_u64(_blsr_u64(bits)));
  const int count = __builtin_popcountll(bits);
  if (count > 2)
  {
    append(bits, base, to, count);
  }
  edges.lines += static_cast<std::uint32_t>(count);
}

#include "granular/base/row_text_kernel.inc"
#undef GRANULAR_TARGET
}

namespace avx512
{
#define GRANULAR_TARGET                                                                            \
  __attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt,avx512f,avx512bw,avx512vl,avx512vbmi2")))

GRANULAR_TARGET inline BlockMarks mark_block(const char* block) noexcept
{
  const __m512i bytes = _mm512_loadu_si512(block);
  return { _mm512_cmpgt_epu8_mask(bytes, _mm512_set1_epi8(' ')),
    _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8('\n')) };
}

GRANULAR_TARGET inline void append(std::uint64_t bits, std::uint32_t base, std::uint16_t* to) noexcept
{
  alignas(64) static constexpr auto places = []
  {
    std::array<std::uint8_t, 64> bytes{};
    for (std::size_t i = 0; i < 64; ++i)
    {
      bytes[i] = static_cast<std::uint8_t>(i);
    }
    return bytes;
  }();
  const __m512i packed = _mm512_maskz_compress_epi8(bits, _mm512_load_si512(places.data()));
  const __m512i offset = _mm512_set1_epi16(static_cast<short>(base));
  const __m512i low = _mm512_cvtepu8_epi16(_mm512_maskz_extracti64x4_epi64(0xff, packed, 0));
  _mm512_storeu_si512(to, _mm512_add_epi16(low, offset));
  if (__builtin_popcountll(bits) > 32)
  {
    const __m512i high = _mm512_cvtepu8_epi16(_mm512_maskz_extracti64x4_epi64(0xff, packed, 1));
    _mm512_storeu_si512(to + 32, _mm512_add_epi16(high, offset));
  }
}

GRANULAR_TARGET inline void append_bits(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  append(bits, base, edges.offsets + edges.count);
  edges.count += static_cast<std::uint32_t>(__builtin_popcountll(bits));
}

GRANULAR_TARGET inline void append_lines(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  append(bits, base, edges.line_ends + edges.lines);
  edges.lines += static_cast<std::uint32_t>(__builtin_popcountll(bits));
}

#include "granular/base/row_text_kernel.inc"
#undef GRANULAR_TARGET
}

#endif // GRANULAR_X86
}

Simd best_simd() noexcept
{
#if GRANULAR_X86
  static const Simd best = []
  {
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
    const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi2");
    return avx2 && avx512 ? Simd::Avx512 : avx2 ? Simd::Avx2 : Simd::Portable;
  }();
  return best;
#else
  return Simd::Portable;
#endif
}

RowResult decode_rows(const char* first, const char* last, std::uint32_t columns,
  std::span<ColumnSink> sinks, std::int64_t max_rows, Simd simd) noexcept
{
  RowPlan plan{ sinks, columns };
#if GRANULAR_X86
  switch (simd)
  {
    case Simd::Avx512:
      return avx512::decode(first, last, plan, max_rows);
    case Simd::Avx2:
      return avx2::decode(first, last, plan, max_rows);
    case Simd::Portable:
      break;
  }
#endif
  return decode_portable(first, last, plan, max_rows);
}
}
