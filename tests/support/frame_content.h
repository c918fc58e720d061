// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_frame_content_h
#define granular_tests_support_frame_content_h

#include "granular/formats/dump/read/dump_reader.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// All that a frame holds, as bytes that can be compared, and put together from parts.
struct FrameContent
{
  std::string head; ///< what is the same in all parts: header, schema, arrays
  std::int64_t rows = 0;
  std::vector<std::string> values; ///< points, then the arrays; of texts the word of each row
  std::vector<std::string> words;  ///< of each array of texts those that occur, in their order

  void append(const FrameContent& next);
  bool operator==(const FrameContent&) const = default;

  /// The first thing that is not the same, or "".
  std::string difference(const FrameContent& other) const;
};

FrameContent content_of(const granular::Table& frame);

/// What came of reading: the content and the notices, or what was thrown.
struct Outcome
{
  FrameContent content;
  std::string said;  ///< the notices, one a line
  std::string error; ///< what() of an Error, "out of memory" or "cancelled"

  std::string difference(const Outcome& other) const;
};

using ReadFrame =
  std::function<granular::Table(const granular::Request& request, granular::Notices& notices)>;

Outcome outcome_of(const ReadFrame& read, const granular::Request& request);

/// A request by one thread in one chunk: what all others are compared with.
granular::Request plainly(granular::Request request);

/// The same rows by so many threads in chunks of so many bytes.
granular::Request in_chunks(granular::Request request, int threads, std::size_t chunk_bytes);

/// The parts of a frame, put together.
Outcome outcome_of_parts(const ReadFrame& read, granular::Request request, int pieces);

/// Everything that can be asked of a frame: all columns, filters, order, precision, coordinates.
std::vector<granular::Request> all_requests();

#endif
