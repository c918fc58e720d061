// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_text_row_text_h
#define granular_text_row_text_h

#include "granular/bytes/byte_source.h"
#include "granular/common/simd.h"
#include "granular/common/value_type.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace granular
{
/// A requested column of a text, and the destination of its next value.
struct ColumnSink
{
  std::uint32_t column = 0; ///< place of the word in its row, from 0
  ValueType type =
    ValueType::Float64; ///< Int32, Int64, Float64, or Text: std::string_view into the text
  char* data = nullptr;
  std::ptrdiff_t stride = 0; ///< bytes from one row's value to the next's
  bool open = false; ///< Float64: integers that it cannot hold are NotDouble, to readers of dumps
};

enum class RowStatus : std::uint8_t
{
  Done,       ///< the text or the rows asked for are used up
  TooFew,     ///< a row has fewer words than there are columns
  NotANumber, ///< a word that should be a number is none
  NotExact,   ///< a number that an integer column cannot hold
  NotDouble,  ///< an integer that a column of doubles cannot hold; not given by decode_rows
  TooMany,    ///< more rows than there is room for; not given by decode_rows
  Surplus     ///< a row has more words than there are columns
};

/// The result of decode_rows. After an error, ptr is the start of the invalid row (TooFew, Surplus) or word (NotANumber,
/// NotExact), column is the word's column, and rows counts the rows before it.
struct RowResult
{
  const char* ptr;
  std::int64_t rows = 0;
  RowStatus status = RowStatus::Done;
  int column = -1;
};

namespace row_text
{
struct Batch;

struct FreeBatch
{
  void operator()(Batch* batch) const noexcept;
};
}

/// The number of words of a row.
struct RowWords
{
  std::uint32_t columns;
  bool loose = false; ///< more words are no error, and ignored

  // NOLINTNEXTLINE(google-explicit-constructor): most rows have as many words as there are columns
  RowWords(std::uint32_t count, bool more = false)
    : columns(count)
    , loose(more)
  {
  }
};

/// Memory that decode_rows needs, about 250 kB, and allocates. It is kept for the next call, and not on the stack, which may be
/// small.
using RowMemory = std::unique_ptr<row_text::Batch, row_text::FreeBatch>;

/// Decodes rows of blank-separated words into columns.
///
/// [first, last) holds whole lines: it is empty or ends in LF. It must be in a PaddedBuffer: up to 64 bytes before and
/// after are read and ignored. A comment in a row, from a word that begins with '#' behind those of the columns on, is ignored. sinks names the requested columns
/// in increasing order; each sink's data pointer is advanced past the decoded rows. Lines without words are skipped. At
/// most max_rows rows are decoded. Numbers equal those of parse_double and parse_int64 to the last bit. Does not throw.
/// After an error the sinks' data pointers are unspecified. Without memory, words are decoded one by one.
RowResult decode_rows(const char* first, const char* last, RowWords words,
  std::span<ColumnSink> sinks, std::int64_t max_rows, RowMemory& memory,
  Simd simd = best_simd()) noexcept;

/// Returns the status that decode_rows gives for a single word: Done, NotANumber or NotExact.
RowStatus check_word(std::string_view word, ValueType type) noexcept;
}
#endif
