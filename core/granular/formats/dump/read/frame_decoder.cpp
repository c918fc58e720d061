// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/read/frame_decoder.h"

#include "granular/sorting/text_dictionary.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <string>
#include <utility>

namespace granular
{
FrameDecoder::FrameDecoder(
  const FramePieces& pieces, const ColumnSchema& schema, const Request& request)
  : pieces_(pieces)
  , schema_(schema)
  , request_(request)
  , executor_(request.threads)
  , ranges_(cut_frame(pieces, request.piece, request.pieces))
  , chunks_(pieces, ranges_, request.chunk_bytes)
  , sources_(pieces.size())
{
  first_ = this->open(0);
  where_ = where_of(pieces.front());
  header_ = request.header.value_or(first_->rows->header());
  header_.rows = rows_of(pieces);
  const auto full =
    std::ranges::find_if(pieces, [](const FramePiece& piece) { return piece.entry.rows > 0; });
  const auto sample = full == pieces.end() ? 0 : static_cast<std::size_t>(full - pieces.begin());
  header_.digits = this->open(sample)->rows->digits();
}

std::shared_ptr<const FrameDecoder::Source> FrameDecoder::open(std::size_t piece)
{
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Source> source = sources_[piece].lock();
  if (!source)
  {
    std::shared_ptr<const ByteSource> bytes = open_piece(pieces_[piece], executor_.threads());
    std::unique_ptr<const FrameRows> rows = open_rows(*bytes, pieces_[piece].entry);
    source = std::make_shared<const Source>(Source{ std::move(bytes), std::move(rows) });
    sources_[piece] = source;
  }
  return source;
}

/// Opens a chunk in its turn to be read: those of a compressed file one after the other.
void FrameDecoder::open_chunk(const PieceRows& range, Worker& worker, Turn& read)
{
  if (!worker.source || worker.piece != range.piece)
  {
    worker.reader.reset();
    worker.source = this->open(range.piece);
    worker.reader = worker.source->rows->reader();
    worker.piece = range.piece;
  }
  read.wait();
  if (worker.source->bytes->concurrent())
  {
    read.pass();
  }
  worker.reader->open(range.first, range.last);
  read.pass();
}

/// Rows of the frame before this part: where they are chosen by their numbers.
std::int64_t FrameDecoder::rows_before(Progress& progress)
{
  if (request_.stride == 1 || schema_.find(ColumnRole::Id) >= 0 || ranges_.empty())
  {
    return 0;
  }
  const PieceRows& range = ranges_.front();
  std::int64_t before = 0;
  for (std::size_t piece = 0; piece < range.piece; ++piece)
  {
    before += pieces_[piece].entry.rows;
  }
  if (!pieces_[range.piece].entry.kind->is_text())
  {
    return before + range.first;
  }
  const ChunkCuts chunks(pieces_, { { range.piece, 0, range.first } }, request_.chunk_bytes);
  std::vector<Worker> workers(executor_.workers(chunks.size()));
  std::atomic<std::int64_t> rows = before;
  Turns reads;
  executor_.parallel_for(
    chunks.size(),
    [&](std::size_t chunk, std::size_t worker)
    {
      Turn read(reads, chunk);
      this->open_chunk(chunks[chunk], workers[worker], read);
      rows += workers[worker].reader->rows();
    },
    progress);
  return rows;
}

DumpPart FrameDecoder::run(Progress& whole)
{
  PartialProgress progress(whole);
  try
  {
    progress.set_part(0, 0.25);
    first_number_ = this->rows_before(progress);
    progress.set_part(0, 1);
    std::int64_t room = likely_rows(pieces_, ranges_);
    while (!this->decode(room, progress))
    {
      room = std::min(most_rows(pieces_, ranges_), 4 * room); // there are more than that
    }
  }
  catch (Misfits& misfits)
  {
    const std::size_t piece = misfits.front().piece;
    this->count_rows();
    this->check_counts(piece); // those before come first
    this->open(piece)->rows->locate(misfits);
    part_.misfits = std::move(misfits);
    return std::move(part_);
  }
  this->check_counts(pieces_.size());
  this->join_words();
  progress.step(1);
  part_.frame = layout_->take(next_row_, part_.ids);
  for (const DecodedChunk& chunk : decoded_)
  {
    part_.loss.add({ .moved = chunk.moved });
  }
  return std::move(part_);
}

/// False if there is not room enough, and could be more.
bool FrameDecoder::decode(std::int64_t room, Progress& progress)
{
  Notices notices;
  layout_ = std::make_unique<FrameLayout>(schema_, header_, request_, room, where_, notices);
  decoded_.clear();
  next_row_ = next_number_ = 0;
  alone_ = executor_.workers(chunks_.size()) == 1;
  filtered_ = request_.stride > 1 || request_.keep_id || layout_->region;
  reads_.restart();
  places_.restart();
  kept_.restart();
  std::vector<Worker> workers(executor_.workers(chunks_.size()));
  for (Worker& worker : workers)
  {
    worker.decoder = std::make_unique<ChunkDecoder>(*layout_, request_);
    worker.ranges.emplace(layout_->frame);
  }
  try
  {
    executor_.parallel_for(
      chunks_.size(),
      [&](std::size_t chunk, std::size_t worker) { this->decode_chunk(chunk, workers[worker]); },
      progress);
  }
  catch (const Misfits& misfits)
  {
    if (misfits.front().status != RowStatus::TooMany)
    {
      throw;
    }
    if (room < most_rows(pieces_, ranges_))
    {
      return false;
    }
    const std::size_t piece = misfits.front().piece;
    this->count_rows();
    this->check_counts(piece);
    part_.counts[piece] = pieces_[piece].entry.rows + 1;
    this->check_counts(piece + 1);
  }
  this->count_rows();
  this->join_ranges(workers);
  part_.notices.insert(part_.notices.end(), notices.begin(), notices.end());
  return true;
}

/// Returns the place for the result of a chunk. There is room for those alone that were begun: how many there are may be no more than a
/// claim.
DecodedChunk& FrameDecoder::result_of(std::size_t chunk)
{
  const std::lock_guard lock(mutex_);
  while (decoded_.size() <= chunk)
  {
    decoded_.emplace_back();
  }
  return decoded_[chunk];
}

void FrameDecoder::decode_chunk(std::size_t chunk, Worker& worker)
{
  std::optional<Turn> keep; // all from the start, so that they pass whatever fails
  if (filtered_ && !alone_)
  {
    keep.emplace(kept_, chunk);
  }
  Turn place(places_, chunk);
  Turn read(reads_, chunk);
  DecodedChunk& decoded = this->result_of(chunk);
  const PieceRows range = chunks_[chunk];
  this->open_chunk(range, worker, read);
  if (!alone_)
  {
    const std::int64_t rows = worker.reader->rows();
    place.wait();
    const std::int64_t number = next_number_;
    next_number_ += rows;
    place.pass();
    if (keep)
    {
      this->decode_aside(range.piece, number, rows, worker, decoded, *keep);
      return;
    }
    decoded.row = number;
    this->decode_rows(range.piece, number, rows, worker, decoded);
    return;
  }
  decoded.row = next_row_;
  this->decode_rows(range.piece, next_number_, layout_->rows, worker, decoded);
  next_row_ += decoded.kept;
  next_number_ += decoded.rows;
}

/// Decodes what the reader has open, at most so many rows, to where decoded.row is; number: rows before it
/// in this part.
void FrameDecoder::decode_rows(
  std::size_t piece, std::int64_t number, std::int64_t most, Worker& worker, DecodedChunk& decoded)
{
  try
  {
    worker.decoder->decode(*worker.reader, first_number_ + number,
      std::min(layout_->rows - number, most), where_, decoded, *worker.ranges);
  }
  catch (Misfits& misfits)
  {
    misfits.front().piece = piece;
    throw;
  }
  if (worker.reader->more())
  {
    throw Misfits{ { .status = RowStatus::TooMany, .column = -1, .word = {}, .piece = piece } };
  }
}

/// The same where filters leave few rows: they go to memory of the thread's own first, and from there
/// behind those of the chunk before. Else all rows would be in memory at once.
void FrameDecoder::decode_aside(std::size_t piece, std::int64_t number, std::int64_t rows,
  Worker& worker, DecodedChunk& decoded, Turn& turn)
{
  if (!worker.aside || worker.aside->rows < rows)
  {
    Notices known;
    worker.aside =
      std::make_unique<FrameLayout>(schema_, header_, request_, rows + rows / 8, where_, known);
    worker.decoder = std::make_unique<ChunkDecoder>(*worker.aside, request_);
  }
  this->decode_rows(piece, number, rows, worker, decoded);
  turn.wait();
  decoded.row = next_row_;
  next_row_ += decoded.kept;
  turn.pass();
  if (decoded.kept == 0)
  {
    return; // a layout without rows may have fewer blocks
  }
  std::vector<const char*> from;
  worker.aside->for_each_block(
    [&](Block& block, std::size_t) { from.push_back(static_cast<const char*>(block.data())); });
  auto next = from.begin();
  layout_->for_each_block(
    [&](Block& block, std::size_t bytes_a_row)
    {
      std::memcpy(
        static_cast<char*>(block.data()) + static_cast<std::size_t>(decoded.row) * bytes_a_row,
        *next++, static_cast<std::size_t>(decoded.kept) * bytes_a_row);
    });
}

void FrameDecoder::join_ranges(const std::vector<Worker>& workers)
{
  FrameRanges all(layout_->frame);
  for (const Worker& worker : workers)
  {
    all.add(*worker.ranges);
  }
  all.store(layout_->frame);
}

void FrameDecoder::count_rows()
{
  part_.counts.assign(pieces_.size(), 0);
  next_row_ = 0;
  for (std::size_t chunk = 0; chunk < decoded_.size(); ++chunk)
  {
    part_.counts[chunks_[chunk].piece] += decoded_[chunk].rows;
    next_row_ += decoded_[chunk].kept;
  }
}

/// Checks the first pieces: those read to their end must have as many rows as their headers promise, the others at most as many.
void FrameDecoder::check_counts(std::size_t pieces) const
{
  for (const PieceRows& range : ranges_)
  {
    if (range.piece >= pieces)
    {
      return;
    }
    const FrameEntry& entry = pieces_[range.piece].entry;
    const std::int64_t count = part_.counts[range.piece];
    const bool all = range.first == 0 && range.last == extent_of(entry);
    if (count > entry.rows || (all && count < entry.rows))
    {
      fail_count(pieces_[range.piece], count);
    }
  }
}

/// Makes one dictionary of those of the chunks.
void FrameDecoder::join_words()
{
  for (std::size_t text = 0; text < layout_->texts.size(); ++text)
  {
    TableArray& array = layout_->frame.arrays[layout_->texts[text].array];
    TextDictionary all;
    for (const DecodedChunk& chunk : decoded_)
    {
      std::vector<std::int32_t> index_of;
      for (const std::string& word : chunk.words[text])
      {
        index_of.push_back(all.index(word, where_));
      }
      std::int32_t* const first = static_cast<std::int32_t*>(array.block.data()) + chunk.row;
      std::for_each(first, first + chunk.kept,
        [&](std::int32_t& index) { index = index_of[static_cast<std::size_t>(index)]; });
    }
    array.words = all.take();
  }
}
}
