// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/formats/first_rows.h"

#include "granular/common/hash.h"
#include "granular/dump/formats/frame_rows.h"
#include "granular/frames/file_index.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
/// Calls take(rows) for batches of the first rows of a frame, at most so many, with the sinks filled. Rows that cannot be
/// decoded are left to the reader of the frame. Throws IoError: without the rows nobody can tell pieces from repetitions.
template <class Take>
void decode_first(const FileIndex& file, const FrameEntry& entry, std::size_t most,
  std::span<ColumnSink> sinks, const Take& take)
{
  try
  {
    const std::unique_ptr<ByteSource> source = open_indexed(file);
    const std::unique_ptr<FrameRows> rows = open_rows(*source, entry);
    const std::unique_ptr<RowReader> reader = rows->reader();
    const std::int64_t step = chunk_extent(entry, std::size_t{ 1 } << 18);
    for (std::int64_t at = 0; at < extent_of(entry) && most > 0; at += step)
    {
      reader->open(at, std::min(at + step, extent_of(entry)));
      const std::int64_t got = reader->decode(sinks, static_cast<std::int64_t>(most));
      most -= static_cast<std::size_t>(got);
      take(static_cast<std::size_t>(got));
    }
  }
  catch (const IoError&)
  {
    throw;
  }
  catch (const Error&)
  {
  }
  catch (const Misfits&)
  {
  }
}
}

FirstRows find_first_ids(const FileIndex& file, const FrameEntry& entry)
{
  const int column = entry.kind->schema.find(ColumnRole::Id);
  if (column < 0)
  {
    return {};
  }
  constexpr std::size_t most = 20'000;
  std::vector<std::int64_t> ids(most);
  std::size_t count = 0;
  ColumnSink sink = { static_cast<std::uint32_t>(column), ValueType::Int64,
    reinterpret_cast<char*>(ids.data()), sizeof ids[0] };
  decode_first(file, entry, most, { &sink, 1 }, [&](std::size_t rows) { count += rows; });
  ids.resize(count);
  return { std::move(ids), true };
}

FirstRows find_first_rows(const FileIndex& file, const FrameEntry& entry)
{
  constexpr std::size_t most_words = 100'000;
  const std::size_t columns = entry.kind->schema.columns().size();
  if (entry.kind->schema.find(ColumnRole::Id) >= 0)
  {
    return find_first_ids(file, entry);
  }
  if (!entry.kind->is_text() || columns == 0)
  {
    return {};
  }
  const std::size_t most = std::clamp<std::size_t>(most_words / columns, 1, 1'000);
  std::vector<std::string_view> words(columns * most);
  std::vector<ColumnSink> sinks;
  for (std::size_t i = 0; i < columns; ++i)
  {
    sinks.push_back(
      { static_cast<std::uint32_t>(i), ValueType::Text, reinterpret_cast<char*>(words.data() + i),
        static_cast<std::ptrdiff_t>(columns * sizeof words[0]) });
  }
  std::vector<std::int64_t> hashes;
  const auto take = [&](std::size_t rows)
  {
    for (std::size_t row = hashes.size(), end = row + rows; row < end; ++row)
    {
      Hash hash;
      for (std::size_t i = 0; i < columns; ++i)
      {
        const std::string_view word = words[row * columns + i];
        hash.add(word.data(), word.size());
        hash.add(" ", 1);
      }
      hashes.push_back(std::bit_cast<std::int64_t>(hash.value()));
    }
  };
  decode_first(file, entry, most, sinks, take);
  return { std::move(hashes), false };
}
}
