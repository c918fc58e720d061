// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/find_chunks.h"

#include "granular/formats/restart/bond_record.h"
#include "granular/formats/restart/restart_bytes.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr auto least_doubles = static_cast<std::int64_t>(RecordSlots::common);
constexpr std::int64_t records_a_report = 65536;
constexpr std::int64_t block_doubles = std::int64_t{ 1 } << 17;
constexpr std::int64_t most_int = std::numeric_limits<std::int32_t>::max();

bool in_range(std::int64_t number, std::int64_t low, std::int64_t high) noexcept
{
  return number >= low && number <= high;
}

/// All of these have doubles of their own.
bool is_whole_in(double number, std::int64_t low, std::int64_t high) noexcept
{
  return number >= static_cast<double>(low) && number <= static_cast<double>(high) &&
    number == static_cast<double>(static_cast<std::int64_t>(number));
}

constexpr std::int64_t count_bytes = 4;

/// A complete file needs one walk over its records, and a hop for each process, each of which has a count there.
SearchBudget budget_of(std::int64_t bytes, std::int64_t processes)
{
  const std::int64_t hops = std::min(processes, bytes / count_bytes);
  return { 4 * (bytes / (8 * least_doubles) + hops) + 1'000'000,
    2 * bytes + (std::int64_t{ 1 } << 28) };
}

/// Returns true if there may be a count and the length of a record that fits into so many doubles.
constexpr auto is_pair = [](const char* bytes, bool swapped, std::int64_t left) noexcept
{
  const std::int64_t count = load_number<std::int32_t>(bytes, swapped);
  const auto range = static_cast<std::uint64_t>(left / 8 - least_doubles);
  if (static_cast<std::uint64_t>(count - least_doubles) > range)
  {
    return false;
  }
  const auto length = load_number<double>(bytes + count_bytes, swapped);
  return length_of(length, RecordSlots::common, static_cast<std::size_t>(count)) > 0;
};

class ChunkFinder
{
public:
  ChunkFinder(
    const ByteSource& source, std::int64_t begin, RestartLayout& layout, Progress& progress)
    : layout_(layout)
    , header_(layout.header)
    , begin_(begin)
    , hops_(source, layout.swapped, &budget_)
    , walker_(source, layout.swapped, header_, budget_, progress)
    , size_(hops_.size())
    , progress_(progress)
  {
  }

  ChunkSearch find()
  {
    if (header_.atoms == 0)
    {
      this->find_none();
      return result_;
    }
    this->search(false);
    if (!result_.found && header_.time)
    {
      this->search(true);
    }
    return result_;
  }

private:
  /// No particles: a zero for each process. With meshes behind them they cannot be told from what comes before.
  void find_none()
  {
    budget_ = budget_of(size_, header_.processes);
    const std::int64_t first = this->zeros_before(size_, header_.processes);
    const bool there = size_ - first == header_.processes * count_bytes;
    result_.found = there || header_.time;
    this->take(there ? first : size_, size_, {});
  }

  void search(bool inside)
  {
    budget_ = budget_of(size_, header_.processes);
    constexpr std::size_t pair_bytes = count_bytes + sizeof(double);
    search_pairs<pair_bytes>(
      hops_.source(), hops_.swapped(), begin_, size_, 8 * least_doubles, is_pair,
      [&](std::int64_t at)
      {
        result_.found = this->try_at(at, inside);
        result_.gave_up = !result_.found && budget_.spent();
        return result_.found || result_.gave_up;
      },
      progress_);
  }

  /// Tries the chunks from one that has records to the end of the file or, inside of it, to the last that has, wherever it ends.
  bool try_at(std::int64_t at, bool inside)
  {
    if (!inside && !this->hops_to_end(at))
    {
      return false;
    }
    walker_.restart(inside);
    std::vector<RestartChunk> chunks;
    std::int64_t end = at;
    while (inside ? walker_.records() < header_.atoms : end < size_)
    {
      const bool may = std::ssize(chunks) < header_.processes && !budget_.spent();
      const std::int64_t doubles = may ? this->doubles_at(end) : -1;
      if (doubles < 0 || !walker_.walk(end + count_bytes, doubles))
      {
        return false;
      }
      chunks.push_back({ {}, end + count_bytes, doubles });
      end += count_bytes + doubles * 8;
    }
    // those without records are before, as far as there are zeros, else behind
    std::int64_t missing = header_.processes - std::ssize(chunks);
    const std::int64_t first = this->zeros_before(at, missing);
    missing -= (at - first) / count_bytes;
    for (; inside && missing > 0 && this->doubles_at(end) == 0; --missing)
    {
      end += count_bytes;
      chunks.push_back({ {}, end, 0 });
    }
    if (missing > 0)
    {
      return false;
    }
    if (walker_.records() != header_.atoms)
    {
      result_.misfit =
        inside ? result_.misfit : std::max(result_.misfit.value_or(0), walker_.records());
      return false;
    }
    this->take(first, at, chunks);
    return true;
  }

  /// Hops over chunks. Returns true if, with those without records before them, there is one for each process up to the end of the file.
  bool hops_to_end(std::int64_t begin)
  {
    std::int64_t at = begin;
    std::int64_t missing = header_.processes;
    for (; at < size_ && missing > 0; --missing)
    {
      const std::int64_t doubles = this->doubles_at(at);
      const bool fits = doubles == 0 || doubles >= least_doubles;
      if (!fits || budget_.spent())
      {
        return false;
      }
      at += count_bytes + doubles * 8;
    }
    return at == size_ && begin - this->zeros_before(begin, missing) == missing * count_bytes;
  }

  /// The count of a chunk, for whose doubles there is room; -1 where there is none.
  std::int64_t doubles_at(std::int64_t at)
  {
    const std::string_view bytes = hops_.view(at, count_bytes);
    --budget_.steps;
    const std::int64_t doubles =
      bytes.size() < count_bytes ? -1 : hops_.load<std::int32_t>(bytes.data());
    return doubles > (size_ - at - count_bytes) / 8 ? -1 : doubles;
  }

  /// Returns the place from which there are only chunks without records up to another, at most so many.
  std::int64_t zeros_before(std::int64_t end, std::int64_t most)
  {
    const std::int64_t least = end - std::min(most, (end - begin_) / count_bytes) * count_bytes;
    const bool any = least < end && this->doubles_at(end - count_bytes) == 0;
    std::int64_t first = any ? least : end;
    for (std::int64_t at = first; at < end && !budget_.spent(); at += count_bytes)
    {
      first = this->doubles_at(at) == 0 ? first : at + count_bytes;
    }
    return first;
  }

  /// Takes chunks without records between two places, and those behind them.
  void take(std::int64_t first, std::int64_t end, const std::vector<RestartChunk>& behind)
  {
    layout_.begin = first;
    layout_.records = header_.atoms;
    for (std::int64_t at = first; at < end; at += count_bytes)
    {
      layout_.chunks.push_back({ {}, at + count_bytes, 0 });
    }
    layout_.chunks.insert(layout_.chunks.end(), behind.begin(), behind.end());
    layout_.blocks = walker_.blocks();
  }

  RestartLayout& layout_;
  const RestartHeader& header_;
  std::int64_t begin_;
  SearchBudget budget_;
  RestartBytes hops_;
  RecordWalker walker_;
  std::int64_t size_;
  Progress& progress_;
  ChunkSearch result_;
};
}

ChunkSearch find_chunks(
  const ByteSource& source, std::int64_t begin, RestartLayout& layout, Progress& progress)
{
  return ChunkFinder(source, begin, layout, progress).find();
}

RecordWalker::RecordWalker(const ByteSource& source, bool swapped, const RestartHeader& header,
  SearchBudget& budget, Progress& progress)
  : bytes_(source, swapped, &budget)
  , header_(header)
  , budget_(budget)
  , bounds_(header.box.bounds())
  , progress_(progress)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = bounds_.hi[axis] - bounds_.lo[axis];
    bounds_.lo[axis] -= length;
    bounds_.hi[axis] += length;
  }
}

bool RecordWalker::walk(std::int64_t offset, std::int64_t doubles)
{
  const std::int64_t end = offset + doubles * 8;
  for (at_ = offset; at_ < end;)
  {
    const std::int64_t left = (end - at_) / 8;
    const std::string_view record = bytes_.view(at_, least_doubles * 8);
    --budget_.steps;
    if (budget_.spent() || left < least_doubles || record.size() < least_doubles * 8)
    {
      return false;
    }
    const std::size_t length = length_of(
      bytes_.load<double>(record.data()), RecordSlots::common, static_cast<std::size_t>(left));
    if (length == 0 || !this->is_record(record.data()))
    {
      return false;
    }
    if (at_ == offset || blocks_.back().doubles >= block_doubles)
    {
      blocks_.push_back({ .offset = at_, .first_row = records_ });
    }
    blocks_.back().doubles += static_cast<std::int64_t>(length);
    ++blocks_.back().records;
    if (++records_ % records_a_report == 0)
    {
      progress_.step(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
    }
    at_ += static_cast<std::int64_t>(length) * 8;
  }
  return true;
}

/// Whole numbers are bits, or values: the type, which is at least 1, tells.
bool RecordWalker::is_record(const char* record) const noexcept
{
  constexpr std::int64_t least_int = -most_int - 1;
  constexpr std::int64_t most_value = std::int64_t{ 1 } << 53;
  using Slots = RecordSlots;
  const auto bits = [&](std::size_t slot) { return this->load<std::int64_t>(record, slot); };
  const auto value = [&](std::size_t slot) { return this->load<double>(record, slot); };
  if (in_range(bits(Slots::type), 1, header_.types))
  {
    return (header_.tag_bytes == 8 || in_range(bits(Slots::tag), least_int, most_int)) &&
      in_range(bits(Slots::mask), least_int, most_int) && this->near_box(record);
  }
  return is_whole_in(value(Slots::type), 1, header_.types) &&
    is_whole_in(value(Slots::tag), -most_value, most_value) &&
    is_whole_in(value(Slots::mask), least_int, most_int) && this->near_box(record);
}

bool RecordWalker::near_box(const char* record) const noexcept
{
  for (std::size_t axis = 0; in_box_ && axis < 3; ++axis)
  {
    const auto x = this->load<double>(record, RecordSlots::x + axis);
    if (!(x >= bounds_.lo[axis] && x <= bounds_.hi[axis])) // nor is it nan
    {
      return false;
    }
  }
  return true;
}
}
