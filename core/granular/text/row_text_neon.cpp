// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text_detail.h"

#if GRANULAR_NEON

#include "granular/text/row_text_tables.h"

#include <arm_neon.h>

namespace granular::row_text::neon
{
namespace
{
#define GRANULAR_TARGET

/// A bit for each byte of four registers: whether it is all ones.
inline std::uint64_t mask(uint8x16_t a, uint8x16_t b, uint8x16_t c, uint8x16_t d) noexcept
{
  const uint8x16_t bits = vreinterpretq_u8_u64(vdupq_n_u64(0x8040201008040201));
  const uint8x16_t ab = vpaddq_u8(vandq_u8(a, bits), vandq_u8(b, bits));
  const uint8x16_t cd = vpaddq_u8(vandq_u8(c, bits), vandq_u8(d, bits));
  const uint8x16_t all = vpaddq_u8(ab, cd);
  return vgetq_lane_u64(vreinterpretq_u64_u8(vpaddq_u8(all, all)), 0);
}

inline BlockMarks mark_block(const char* block) noexcept
{
  const uint8x16x4_t text = vld1q_u8_x4(reinterpret_cast<const std::uint8_t*>(block));
  const uint8x16_t blank = vdupq_n_u8(' ');
  const uint8x16_t feed = vdupq_n_u8('\n');
  return { mask(vcgtq_u8(text.val[0], blank), vcgtq_u8(text.val[1], blank),
             vcgtq_u8(text.val[2], blank), vcgtq_u8(text.val[3], blank)),
    mask(vceqq_u8(text.val[0], feed), vceqq_u8(text.val[1], feed), vceqq_u8(text.val[2], feed),
      vceqq_u8(text.val[3], feed)) };
}

inline void append_edges(std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  // in each byte: how many bits are set up to it
  const std::uint64_t counts =
    0x0101010101010101 * vget_lane_u64(vreinterpret_u64_u8(vcnt_u8(vcreate_u8(bits))), 0);
  std::uint16_t* const to = edges.offsets + edges.count;
  for (int i = 0; i < 8; ++i)
  {
    const uint8x8_t places = vld1_u8(bit_places[bits >> (8 * i) & 0xff].data());
    const std::uint64_t before = (counts << 8) >> (8 * i) & 0xff;
    vst1q_u16(to + before,
      vaddw_u8(vdupq_n_u16(static_cast<std::uint16_t>(base + 8U * static_cast<std::uint32_t>(i))),
        places));
  }
  edges.count += static_cast<std::uint32_t>(counts >> 56);
}

inline void append_lines(std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  for (; bits != 0; bits &= bits - 1)
  {
    edges.line_ends[edges.lines++] =
      static_cast<std::uint16_t>(base + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
}

/// Words that are parsed together.
constexpr std::uint32_t group = 4;

struct Constants
{
};

constexpr uint8x16_t places = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };

/// Where digits are points, that is '.' - '0'.
inline uint8x16_t find_points(uint8x16_t digits) noexcept
{
  return vceqq_u8(digits, vdupq_n_u8(static_cast<std::uint8_t>('.' - '0')));
}

/// Four words.
struct FourWords
{
  uint8x16_t digits[4];   ///< without signs and points, right-aligned
  uint8x8_t lengths;      ///< a byte for each word: its characters
  uint8x8_t marks;        ///< the same: the place of its point, from 1, and 128 for a minus
  std::uint8_t points[8]; ///< without the minus; only of doubles
};

/// Four words of up to 16 characters. False if one has more.
template <bool Points>
inline bool read_words(const char* base, const std::uint16_t* edges, FourWords& words) noexcept
{
  const uint16x4x2_t ends = vld2_u16(edges);
  const uint16x4_t lengths = vsub_u16(ends.val[1], ends.val[0]);
  if (vmaxv_u16(lengths) > 16)
  {
    return false;
  }
  words.lengths = vmovn_u16(vcombine_u16(lengths, lengths));
  alignas(8) std::uint8_t starts[8];
  vst1_u8(starts, vsub_u8(vdup_n_u8(16), words.lengths));
  uint8x16_t marks[4];
  for (int i = 0; i < 4; ++i)
  {
    const uint8x16_t text =
      vld1q_u8(reinterpret_cast<const std::uint8_t*>(base + edges[2 * i + 1] - 16));
    const uint8x16_t start = vld1q_dup_u8(starts + i);
    const uint8x16_t minus = vandq_u8(vceqq_u8(places, start), vceqq_u8(text, vdupq_n_u8('-')));
    const uint8x16_t word = vandq_u8(vcgeq_u8(places, start), vsubq_u8(text, vdupq_n_u8('0')));
    words.digits[i] = vbicq_u8(word, minus);
    marks[i] = vandq_u8(minus, vdupq_n_u8(128));
    if constexpr (Points)
    {
      const uint8x16_t point = find_points(word);
      marks[i] = vorrq_u8(marks[i], vandq_u8(point, vaddq_u8(places, vdupq_n_u8(1))));
    }
  }
  uint8x16_t sums = vpaddq_u8(vpaddq_u8(marks[0], marks[1]), vpaddq_u8(marks[2], marks[3]));
  sums = vpaddq_u8(sums, sums);
  words.marks = vget_low_u8(vpaddq_u8(sums, sums));
  if constexpr (Points)
  {
    // bytes up to the point come from one place before; a second point would stay, and be found
    vst1_u8(words.points, vand_u8(words.marks, vdup_n_u8(127)));
    for (int i = 0; i < 4; ++i)
    {
      const uint8x16_t shift = vcltq_u8(places, vld1q_dup_u8(words.points + i));
      words.digits[i] = vqtbl1q_u8(words.digits[i], vaddq_u8(places, shift));
    }
  }
  return true;
}

/// Whether all words are of digits only, and of one at least. others: characters of each that are not digits.
inline bool are_digits(const FourWords& words, uint8x8_t others) noexcept
{
  const uint8x16_t most = vmaxq_u8(
    vmaxq_u8(words.digits[0], words.digits[1]), vmaxq_u8(words.digits[2], words.digits[3]));
  return vmaxvq_u8(most) <= 9 && vminv_u8(vcgt_u8(words.lengths, others)) != 0;
}

/// The numbers that two words are.
inline uint64x2_t combine(uint8x16_t a, uint8x16_t b) noexcept
{
  const uint8x16_t tens = vreinterpretq_u8_u16(vdupq_n_u16(0x010a));
  const uint8x16_t pairs = vpaddq_u8(vmulq_u8(a, tens), vmulq_u8(b, tens));
  const uint8x16_t hundreds = vreinterpretq_u8_u16(vdupq_n_u16(0x0164));
  const uint16x8_t fours =
    vpaddq_u16(vmull_u8(vget_low_u8(pairs), vget_low_u8(hundreds)), vmull_high_u8(pairs, hundreds));
  const uint16x8_t ten_thousands = vreinterpretq_u16_u32(vdupq_n_u32(0x00012710));
  const uint32x4_t eights = vpaddq_u32(vmull_u16(vget_low_u16(fours), vget_low_u16(ten_thousands)),
    vmull_high_u16(fours, ten_thousands));
  const uint32x2_t high = vmovn_u64(vreinterpretq_u64_u32(eights));
  return vmlal_n_u32(vshrq_n_u64(vreinterpretq_u64_u32(eights), 32), high, 100'000'000);
}

/// The bytes of four words as the highest of 64 bits: of the first two, and of the last two.
inline uint64x2x2_t spread(uint8x8_t bytes) noexcept
{
  const uint8x16_t all = vcombine_u8(bytes, bytes);
  const uint8x16_t first = { 16, 16, 16, 16, 16, 16, 16, 0, 16, 16, 16, 16, 16, 16, 16, 1 };
  const uint8x16_t last = { 16, 16, 16, 16, 16, 16, 16, 2, 16, 16, 16, 16, 16, 16, 16, 3 };
  return { vreinterpretq_u64_u8(vqtbl1q_u8(all, first)),
    vreinterpretq_u64_u8(vqtbl1q_u8(all, last)) };
}

/// Four integers of a sign and digits, of up to 16 characters. False if one is not.
inline bool parse_integers(
  const char* base, const std::uint16_t* edges, const Constants&, std::uint64_t* values) noexcept
{
  FourWords words;
  if (!read_words<false>(base, edges, words) || !are_digits(words, vshr_n_u8(words.marks, 7)))
  {
    return false;
  }
  const uint64x2x2_t marks = spread(words.marks);
  for (int i = 0; i < 2; ++i)
  {
    const int64x2_t sign = vshrq_n_s64(vreinterpretq_s64_u64(marks.val[i]), 63);
    const int64x2_t number =
      vreinterpretq_s64_u64(combine(words.digits[2 * i], words.digits[2 * i + 1]));
    vst1q_u64(values + 2 * i, vreinterpretq_u64_s64(vsubq_s64(veorq_s64(number, sign), sign)));
  }
  return true;
}

/// What a word is divided by, by the place of its point.
constexpr auto powers_by_point = []
{
  std::array<double, 17> powers{};
  powers[0] = 1;
  for (std::size_t point = 1; point < powers.size(); ++point)
  {
    powers[point] = powers_of_ten[16 - point];
  }
  return powers;
}();

/// Four doubles of a sign, digits and a point, of up to 16 characters. False if one is not.
inline bool parse_doubles(
  const char* base, const std::uint16_t* edges, const Constants&, std::uint64_t* values) noexcept
{
  FourWords words;
  if (!read_words<true>(base, edges, words))
  {
    return false;
  }
  const uint8x8_t has_point = vmin_u8(vld1_u8(words.points), vdup_n_u8(1));
  if (!are_digits(words, vadd_u8(vshr_n_u8(words.marks, 7), has_point)))
  {
    return false;
  }
  const uint64x2x2_t marks = spread(words.marks);
  for (int i = 0; i < 2; ++i)
  {
    // fewer than 2^53 if there is a point; else there is one rounding, too
    const float64x2_t whole = vcvtq_f64_u64(combine(words.digits[2 * i], words.digits[2 * i + 1]));
    const float64x2_t power = { powers_by_point[words.points[2 * i]],
      powers_by_point[words.points[2 * i + 1]] };
    const uint64x2_t sign = vandq_u64(marks.val[i], vdupq_n_u64(std::uint64_t{ 1 } << 63));
    vst1q_u64(values + 2 * i, vorrq_u64(vreinterpretq_u64_f64(vdivq_f64(whole, power)), sign));
  }
  return true;
}

/// The byte, from 0, of the first that is all ones; 16 without one.
inline std::size_t find_first(uint8x16_t bytes) noexcept
{
  const uint8x8_t halves = vshrn_n_u16(vreinterpretq_u16_u8(bytes), 4);
  return static_cast<std::size_t>(std::countr_zero(vget_lane_u64(vreinterpret_u64_u8(halves), 0))) /
    4;
}

/// The characters before end minus '0', of which the last count of 16 stay, behind zeros.
inline uint8x16_t load_word(const char* end, std::size_t count) noexcept
{
  const uint8x16_t text = vld1q_u8(reinterpret_cast<const std::uint8_t*>(end - 16));
  const uint8x16_t start = vdupq_n_u8(static_cast<std::uint8_t>(16 - count));
  return vandq_u8(vcgeq_u8(places, start), vsubq_u8(text, vdupq_n_u8('0')));
}

inline bool parse_short(
  const char* end, std::size_t count, std::uint64_t& value, int& behind) noexcept
{
  const uint8x16_t word = load_word(end, count);
  const std::size_t point = find_first(find_points(word));
  // bytes up to the point come from one place before; a second point stays, and is found
  const uint8x16_t shift = vcleq_u8(places, vdupq_n_u8(static_cast<std::uint8_t>(point)));
  const uint8x16_t digits = point == 16 ? word : vqtbl1q_u8(word, vaddq_u8(places, shift));
  value = vgetq_lane_u64(combine(digits, digits), 0);
  behind = point == 16 ? 0 : 15 - static_cast<int>(point);
  return vmaxvq_u8(digits) <= 9 && (point == 16 || count > 1);
}

inline bool parse_long(
  const char* end, std::size_t count, std::uint64_t& value, int& behind) noexcept
{
  uint8x16x2_t digits = { load_word(end - 16, count - 16), load_word(end, 16) };
  std::size_t point = find_first(find_points(digits.val[0]));
  point += point == 16 ? find_first(find_points(digits.val[1])) : 0;
  behind = 0;
  if (point < 32)
  {
    const uint8x16_t last = vdupq_n_u8(static_cast<std::uint8_t>(point));
    const uint8x16_t from = vaddq_u8(places, vdupq_n_u8(16));
    digits = { vqtbl2q_u8(digits, vaddq_u8(places, vcleq_u8(places, last))),
      vqtbl2q_u8(digits, vaddq_u8(from, vcleq_u8(from, last))) };
    behind = 31 - static_cast<int>(point);
    --count;
  }
  const uint64x2_t both = combine(digits.val[0], digits.val[1]);
  value = vgetq_lane_u64(both, 0) * 10'000'000'000'000'000U + vgetq_lane_u64(both, 1);
  return count <= 19 && vmaxvq_u8(vmaxq_u8(digits.val[0], digits.val[1])) <= 9;
}

#include "granular/text/row_text_word.inc"

#include "granular/text/row_text_kernel.inc"
}

RowResult decode(const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  return decode_batches(first, last, plan, max_rows);
}
}
#endif
