// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_row_text_h
#define granular_base_row_text_h

#include "granular/base/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// Where the values of one column of a text go: value of row r to data + r * stride bytes.
struct ColumnSink
{
  enum class Kind : std::uint8_t
  {
    Skip,
    Int32,   ///< std::int32_t
    Int64,   ///< std::int64_t
    Float64, ///< double
    Text     ///< std::string_view into the text
  };

  Kind kind = Kind::Skip;
  void* data = nullptr;
  std::ptrdiff_t stride = 0;
};

enum class RowStatus : std::uint8_t
{
  Done,       ///< the text or the rows asked for are used up
  TooFew,     ///< a row has fewer words than there are columns
  NotANumber, ///< a word that should be a number is none
  NotExact    ///< a number that an integer column cannot hold
};

/// What decode_rows did. After an error, ptr is the start of the row at fault (TooFew) or of the
/// word (NotANumber, NotExact), column its column, and rows counts the rows before it.
struct RowResult
{
  const char* ptr;
  std::int64_t rows = 0;
  RowStatus status = RowStatus::Done;
  int column = -1;
  bool surplus = false; ///< some row had more words than columns; they were passed over
};

/// Instruction sets the decoder is built for; results do not depend on the choice.
enum class Simd : std::uint8_t
{
  Portable,
  Avx2,
  Avx512
};

/// The best one this processor has.
Simd best_simd() noexcept;

/// Decodes rows of blank-separated words into columns.
///
/// [first, last) holds whole lines: it is empty or ends in LF. It lies in a PaddedBuffer: up to
/// 64 bytes before and after are read (and ignored). sinks has one entry a column of the file;
/// columns after the last one that is not Skip are not looked at, but counted. Lines without
/// words are passed over. At most max_rows rows are decoded.
/// Numbers are parsed as by parse_double and parse_int64, to the bit. Does not throw or allocate.
RowResult decode_rows(const char* first, const char* last, std::span<const ColumnSink> sinks,
  std::int64_t max_rows, Simd simd = best_simd()) noexcept;
}
#endif
