// SPDX-License-Identifier: BSD-3-Clause
// Binary dumps that are changed so that numbers of rows and lengths of chunks still fit.
#ifndef granular_tests_fuzz_binary_mutations_h
#define granular_tests_fuzz_binary_mutations_h

#include "mutations.h"

#include "granular/formats/dump/grammar/binary_header.h"
#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/frames/file_index.h"

#include <optional>
#include <string>
#include <vector>

namespace granular::fuzz
{
/// A frame whose chunks are known.
class FrameEditor
{
public:
  FrameEditor(std::string& bytes, const FrameEntry& entry, BinaryHeader header, Random& random)
    : bytes_(bytes)
    , entry_(entry)
    , layout_(binary_layouts()[static_cast<std::size_t>(entry.kind->layout)])
    , header_(std::move(header))
    , random_(random)
  {
    auto at = static_cast<std::size_t>(header_.chunks_offset);
    for (std::int32_t i = 0; i < header_.chunks && at + 4 <= bytes_.size(); ++i)
    {
      chunks_.push_back({ at, this->get<std::int32_t>(at) });
      at += 4 + 8 * static_cast<std::size_t>(std::max(0, chunks_.back().values));
    }
  }

  void change(std::size_t most)
  {
    if (chunks_.empty())
    {
      mutate_bytes(bytes_, most);
      return;
    }
    const Chunk chunk = chunks_[below(random_, chunks_.size())];
    switch (below(random_, 7))
    {
      case 0:
        return this->split(chunk);
      case 1:
        return this->add_rows(chunk);
      case 2:
        return this->remove_row(chunk);
      case 3:
        return this->change_header(most);
      case 4:
        return this->repeat();
      case 5:
        return this->swap_columns();
      default:
        return this->change_values(chunk);
    }
  }

private:
  struct Chunk
  {
    std::size_t at = 0; ///< of its length
    std::int32_t values = 0;
  };

  template <typename T>
  T get(std::size_t at) const
  {
    return load<T>(bytes_, at, layout_.swapped);
  }

  template <typename T>
  void put(std::size_t at, T value)
  {
    store(bytes_, at, value, layout_.swapped);
  }

  std::size_t timestep_at() const
  {
    const auto begin = static_cast<std::size_t>(entry_.offset);
    const std::size_t magic = layout_.wide ? 8 : 4;
    return layout_.magic ? begin + magic + 8 +
        static_cast<std::size_t>(
          layout_.wide ? -this->get<std::int64_t>(begin) : -this->get<std::int32_t>(begin))
                         : begin;
  }

  void put_count(std::size_t at, std::int64_t count)
  {
    layout_.wide ? this->put(at, count) : this->put(at, static_cast<std::int32_t>(count));
  }

  void put_rows(std::int64_t rows)
  {
    this->put_count(this->timestep_at() + (layout_.wide ? 8 : 4), rows);
  }

  /// In two, anywhere, also within a row.
  void split(const Chunk& chunk)
  {
    const auto first =
      static_cast<std::int32_t>(below(random_, static_cast<std::size_t>(chunk.values) + 1));
    this->put(chunk.at, first);
    const std::size_t second = chunk.at + 4 + 8 * static_cast<std::size_t>(first);
    bytes_.insert(second, 4, '\0');
    this->put(second, chunk.values - first);
    this->put(static_cast<std::size_t>(header_.chunks_offset) - 4, header_.chunks + 1);
  }

  void add_rows(const Chunk& chunk)
  {
    const auto values = static_cast<std::size_t>(header_.size_one);
    const std::size_t rows = 1 + below(random_, 3);
    const std::size_t room = bytes_.size() - chunk.at - 4;
    std::string more(bytes_, chunk.at + 4, 8 * std::min(rows * values, room / 8));
    more.resize(8 * rows * values);
    bytes_.insert(chunk.at + 4, more);
    this->put(
      chunk.at, static_cast<std::int32_t>(static_cast<std::size_t>(chunk.values) + rows * values));
    this->put_rows(header_.frame.rows + static_cast<std::int64_t>(rows));
  }

  void remove_row(const Chunk& chunk)
  {
    if (chunk.values >= header_.size_one)
    {
      bytes_.erase(chunk.at + 4, 8 * static_cast<std::size_t>(header_.size_one));
      this->put(chunk.at, chunk.values - header_.size_one);
      this->put_rows(header_.frame.rows - 1);
    }
  }

  void change_header(std::size_t most)
  {
    const auto begin = static_cast<std::size_t>(entry_.offset);
    const std::size_t size = static_cast<std::size_t>(header_.chunks_offset) - begin;
    std::string header = bytes_.substr(begin, size);
    if (one_in(random_, 2))
    {
      mutate_bytes(header, std::min(most, size + 64));
    }
    else
    {
      const std::size_t at = 4 * below(random_, size / 4);
      one_in(random_, 2)
        ? store(header, at, other_double(random_), layout_.swapped)
        : store(header, at, other_integer(load<std::int32_t>(header, at, layout_.swapped), random_),
            layout_.swapped);
    }
    bytes_.replace(begin, size, header);
  }

  /// The frame again, at another timestep.
  void repeat()
  {
    const auto begin = static_cast<std::size_t>(entry_.offset);
    const std::string frame = bytes_.substr(begin, static_cast<std::size_t>(entry_.end) - begin);
    this->put_count(this->timestep_at(), other_integer(header_.frame.timestep, random_));
    bytes_.insert(begin, frame);
  }

  /// As many values, but other rows.
  void swap_columns()
  {
    const std::int64_t values = header_.values();
    const auto columns = static_cast<std::int32_t>(1 + below(random_, 20));
    if (values % columns == 0)
    {
      this->put(static_cast<std::size_t>(header_.size_one_offset), columns);
      this->put_rows(values / columns);
    }
  }

  void change_values(const Chunk& chunk)
  {
    for (std::size_t left = 1 + below(random_, 3); left > 0 && chunk.values > 0; --left)
    {
      this->put(chunk.at + 4 + 8 * below(random_, static_cast<std::size_t>(chunk.values)),
        other_double(random_));
    }
  }

  std::string& bytes_;
  const FrameEntry& entry_;
  const BinaryLayout& layout_;
  BinaryHeader header_;
  Random& random_;
  std::vector<Chunk> chunks_;
};

inline void mutate(std::string& bytes, Random& random, std::size_t most)
{
  if (!one_in(random, 4))
  {
    const auto source = open_memory(bytes);
    FileIndex index;
    Progress progress;
    try
    {
      index_dump(*source, index, progress);
      if (!index.frames.empty())
      {
        const FrameEntry& entry = index.frames[below(random, index.frames.size())];
        if (!entry.kind->is_text())
        {
          auto header = read_binary_header(
            *source, entry.offset, binary_layouts()[static_cast<std::size_t>(entry.kind->layout)]);
          if (header)
          {
            FrameEditor(bytes, entry, std::move(*header), random).change(most);
            return;
          }
        }
      }
    }
    catch (const Error&)
    {
      // a file of which nobody knows the parts
    }
  }
  mutate_bytes(bytes, most);
}
}

#endif
