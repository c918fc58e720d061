// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_row_decoding_h
#define granular_tests_support_row_decoding_h

#include "granular/text/row_text.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// A column that is wanted.
struct Wanted
{
  std::uint32_t column;
  granular::ValueType type;
};

/// What decode_rows did, free of pointers, so that two of them can be compared.
struct Decoded
{
  granular::RowStatus status;
  std::int64_t rows;
  int column;
  std::ptrdiff_t stopped_at;                    ///< offset of the result's ptr
  std::vector<std::vector<std::uint64_t>> bits; ///< numbers of the complete rows, by sink
  std::vector<std::vector<std::string>> texts;  ///< texts of the complete rows, by sink

  bool operator==(const Decoded&) const = default;
};

std::string to_string(const Decoded& decoded);

/// Decodes a text that lies in a buffer of exactly its size, between bytes that must not matter.
Decoded decode(std::string_view text, std::uint32_t columns, const std::vector<Wanted>& wanted,
  std::int64_t max_rows, granular::Simd simd);

#endif
