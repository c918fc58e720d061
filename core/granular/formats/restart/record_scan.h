// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_record_scan_h
#define granular_formats_restart_record_scan_h

#include "granular/bytes/byte_source.h"
#include "granular/formats/restart/restart_layout.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The records of a block, in order.
struct RecordBatch
{
  const double* data = nullptr;
  std::span<const std::size_t> starts; ///< of each in data, and the end of the last
  std::int64_t first_row = 0;          ///< from 0, in all chunks
  const std::string* path = nullptr;
  std::int64_t byte = 0; ///< of data

  std::size_t size() const noexcept { return starts.size() - 1; }

  std::span<const double> record(std::size_t i) const noexcept
  {
    return { data + starts[i], starts[i + 1] - starts[i] };
  }
};

/// Throws FormatError with the place of a record: its number from 1, its particle if known, and its byte.
[[noreturn]] void refuse_record(const RecordBatch& batch, std::size_t i, const std::string& text);

/// The memory of a thread that reads blocks.
struct RecordBuffer
{
  std::unique_ptr<double[]> doubles;
  std::size_t capacity = 0;
  std::vector<std::size_t> starts;
  std::unique_ptr<ByteSource> file; ///< of `path`
  std::string path;
};

/// Reads a block of records, and follows their lengths. The buffer keeps them. source: the restart file. Throws FormatError for
/// lengths, or if there are not as many records as in the layout; IoError.
RecordBatch read_records(const ByteSource& source, const RestartLayout& layout,
  const RecordBlock& block, RecordBuffer& buffer);
}
#endif
