// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/record_scan.h"

#include "granular/formats/restart/bond_record.h"
#include "granular/formats/restart/restart_bytes.h"
#include "granular/numbers/number_print.h"

#include <iterator>

namespace granular
{
namespace
{
void swap_doubles(double* doubles, std::size_t count) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    doubles[i] = load_number<double>(reinterpret_cast<const char*>(doubles + i), true);
  }
}

/// " of particle 17", if that can be told.
std::string particle_of(std::span<const double> record)
{
  if (record.size() < RecordSlots::common)
  {
    return {};
  }
  try
  {
    const std::int64_t id = to_whole(record[RecordSlots::tag], whole_numbers_of(record));
    return " of particle " + std::to_string(id);
  }
  catch (const FormatError&)
  {
    return {};
  }
}

[[noreturn]] void refuse(const std::string& text, std::int64_t row, std::span<const double> record,
  const std::string& path, std::int64_t byte)
{
  throw FormatError(
    text + ", in record " + std::to_string(row + 1) + particle_of(record), { path, 0, byte });
}
}

void refuse_record(const RecordBatch& batch, std::size_t i, const std::string& text)
{
  const auto before = static_cast<std::int64_t>(batch.starts[i]);
  refuse(text, batch.first_row + static_cast<std::int64_t>(i), batch.record(i), *batch.path,
    batch.byte + before * std::int64_t{ sizeof(double) });
}

RecordBatch read_records(const ByteSource& source, const RestartLayout& layout,
  const RecordBlock& block, RecordBuffer& buffer)
{
  if (!block.path.empty() && buffer.path != block.path)
  {
    buffer.file = unpack(open_file(block.path));
    buffer.path = block.path;
  }
  const ByteSource& file = block.path.empty() ? source : *buffer.file;
  const auto count = static_cast<std::size_t>(block.doubles);
  if (buffer.capacity < count)
  {
    buffer.doubles = std::make_unique_for_overwrite<double[]>(count);
    buffer.capacity = count;
  }
  double* const doubles = buffer.doubles.get();
  const auto bytes = static_cast<std::int64_t>(count * sizeof(double));
  const auto got = static_cast<std::int64_t>(
    file.read(block.offset, reinterpret_cast<char*>(doubles), static_cast<std::size_t>(bytes)));
  if (got < bytes)
  {
    throw IoError("the file was shortened while it was read: expected " +
        std::to_string(block.offset + bytes) + " bytes, got " + std::to_string(block.offset + got),
      { file.path() });
  }
  if (layout.swapped)
  {
    swap_doubles(doubles, count);
  }
  buffer.starts.clear();
  for (std::size_t at = 0; at < count;)
  {
    const std::size_t length = length_of(doubles[at], RecordSlots::common, count - at);
    if (length == 0)
    {
      refuse("expected the length of a record, from " + std::to_string(RecordSlots::common) +
          " to " + std::to_string(count - at) + " doubles, got " + to_text(doubles[at]),
        block.first_row + std::ssize(buffer.starts), std::span(doubles + at, count - at),
        file.path(), block.offset + static_cast<std::int64_t>(at * sizeof(double)));
    }
    buffer.starts.push_back(at);
    at += length;
  }
  if (std::ssize(buffer.starts) != block.records)
  {
    throw FormatError("expected " + std::to_string(block.records) + " records, got " +
        std::to_string(buffer.starts.size()) + ": the file changed while it was read",
      { file.path(), 0, block.offset });
  }
  buffer.starts.push_back(count);
  return { doubles, buffer.starts, block.first_row, &file.path(), block.offset };
}
}
