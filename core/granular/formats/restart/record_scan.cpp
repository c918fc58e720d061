// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/record_scan.h"

#include "granular/formats/restart/bond_record.h"
#include "granular/formats/restart/restart_bytes.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <exception>
#include <limits>

namespace granular
{
namespace
{
constexpr auto double_bytes = static_cast<std::int64_t>(sizeof(double));
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
constexpr auto least_length = static_cast<std::int64_t>(RecordSlots::common);

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
    batch.byte + before * double_bytes);
}

RecordScan::RecordScan(
  const ByteSource& source, const RestartLayout& layout, std::int64_t doubles_a_block)
  : source_(source)
  , layout_(layout)
{
  std::int64_t most = 0;
  for (std::size_t chunk = 0; chunk < layout.chunks.size(); ++chunk)
  {
    const std::int64_t doubles = layout.chunks[chunk].doubles;
    most += doubles / least_length;
    for (std::int64_t first = 0; first < doubles; first += doubles_a_block)
    {
      blocks_.push_back({ chunk, first, std::min(first + doubles_a_block, doubles) });
    }
  }
  if (layout.records < 0 || layout.records > most)
  {
    throw FormatError("expected at most " + std::to_string(most) +
        " records, for which there is room, got " + std::to_string(layout.records),
      { source.path() });
  }
}

void RecordScan::Buffer::reserve(std::size_t count, std::size_t kept)
{
  if (capacity < count)
  {
    std::unique_ptr<double[]> larger(new double[count]); // not value-initialised
    std::copy_n(doubles.get(), kept, larger.get());
    doubles = std::move(larger);
    capacity = count;
  }
}

void RecordScan::run(
  const Executor& executor, std::int64_t end_row, const Visit& visit, Progress& progress)
{
  buffers_ = std::vector<Buffer>(executor.workers(blocks_.size()));
  turns_.restart();
  stopped_ = false;
  hopped_ = 0;
  next_ = row_ = 0;
  end_row_ = end_row;
  executor.parallel_for(
    blocks_.size(),
    [&](std::size_t number, std::size_t worker) { this->do_block(number, worker, visit); },
    progress);
  if (hopped_ == blocks_.size() && row_ != layout_.records)
  {
    throw FormatError("expected " + std::to_string(layout_.records) + " records, got " +
        std::to_string(row_) + ": the file changed while it was read",
      { source_.path() });
  }
}

const ByteSource& RecordScan::open(const RecordBlock& block, Buffer& buffer) const
{
  const std::string& path = layout_.chunks[block.chunk].path;
  if (path.empty())
  {
    return source_;
  }
  if (!buffer.file || buffer.path != path)
  {
    buffer.file = unpack(open_file(path));
    buffer.path = path;
  }
  return *buffer.file;
}

/// Some doubles of a chunk.
void RecordScan::read(const ByteSource& source, const RecordBlock& block, std::int64_t first,
  std::int64_t last, double* to) const
{
  const RestartChunk& chunk = layout_.chunks[block.chunk];
  const std::int64_t from = chunk.offset + first * double_bytes;
  const auto bytes = static_cast<std::size_t>((last - first) * double_bytes);
  const std::size_t got = source.read(from, reinterpret_cast<char*>(to), bytes);
  if (got < bytes)
  {
    throw IoError("the file was shortened while it was read: expected " +
        std::to_string(from + static_cast<std::int64_t>(bytes)) + " bytes, got " +
        std::to_string(from + static_cast<std::int64_t>(got)),
      { source.path() });
  }
  if (layout_.swapped)
  {
    swap_doubles(to, static_cast<std::size_t>(last - first));
  }
}

/// Finds the records of a block, and says where the next one begins.
void RecordScan::hop(std::size_t number, RecordBatch& batch, Buffer& buffer)
{
  const RecordBlock& block = blocks_[number];
  const std::int64_t doubles = layout_.chunks[block.chunk].doubles;
  std::int64_t at = block.first == 0 ? 0 : next_;
  buffer.starts.clear();
  batch.first_row = row_;
  while (at < block.last)
  {
    const double* const record = buffer.doubles.get() + (at - block.first);
    const std::size_t length =
      length_of(*record, RecordSlots::common, static_cast<std::size_t>(doubles - at));
    if (length == 0)
    {
      refuse("expected the length of a record, from " + std::to_string(least_length) + " to " +
          std::to_string(doubles - at) + " doubles, got " + to_text(*record),
        row_, std::span(record, static_cast<std::size_t>(block.last - at)), *batch.path,
        batch.byte + (at - block.first) * double_bytes);
    }
    buffer.starts.push_back(static_cast<std::size_t>(at - block.first));
    at += static_cast<std::int64_t>(length);
    ++row_;
  }
  if (row_ > layout_.records)
  {
    throw FormatError("expected " + std::to_string(layout_.records) +
        " records, got more: the file changed while it was read",
      { *batch.path, 0, batch.byte });
  }
  buffer.starts.push_back(static_cast<std::size_t>(at - block.first));
  next_ = at;
  const bool last = row_ >= end_row_ && number + 1 < blocks_.size();
  hopped_ = last ? nowhere : number + 1;
  stopped_ = stopped_ || last;
}

/// Reads a block, and what its last record has behind it. False: there is nothing to be seen.
bool RecordScan::read_block(std::size_t number, Buffer& buffer, Turn& turn, RecordBatch& batch)
{
  if (stopped_)
  {
    return false; // before anything is read: all that is wanted may be the first of many blocks
  }
  const RecordBlock& block = blocks_[number];
  const RestartChunk& chunk = layout_.chunks[block.chunk];
  const bool in_turn = chunk.path.empty() && !source_.concurrent();
  const auto there = static_cast<std::size_t>(block.last - block.first);
  const ByteSource* source = nullptr;
  std::exception_ptr failure;
  try
  {
    if (in_turn)
    {
      turn.wait();
    }
    source = &this->open(block, buffer);
    buffer.reserve(there + 4096, 0); // most records end not far behind
    this->read(*source, block, block.first, block.last, buffer.doubles.get());
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  turn.wait();
  if (hopped_ != number)
  {
    return false; // one before failed, and says so, or was the last
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
  batch.path = &source->path();
  batch.byte = chunk.offset + block.first * double_bytes;
  this->hop(number, batch, buffer);
  if (buffer.starts.size() == 1)
  {
    return false;
  }
  if (!in_turn)
  {
    turn.pass();
  }
  const std::size_t end = std::max(buffer.starts.back(), there);
  buffer.reserve(end, there);
  this->read(*source, block, block.last, block.first + static_cast<std::int64_t>(end),
    buffer.doubles.get() + there);
  turn.pass();
  batch.data = buffer.doubles.get();
  batch.starts = buffer.starts;
  return true;
}

void RecordScan::do_block(std::size_t number, std::size_t worker, const Visit& visit)
{
  Turn turn(turns_, number);
  RecordBatch batch;
  try
  {
    if (this->read_block(number, buffers_[worker], turn, batch))
    {
      visit(worker, number, batch);
    }
  }
  catch (...)
  {
    stopped_ = true; // its turn has come: nothing before it is left to be read
    throw;
  }
}
}
