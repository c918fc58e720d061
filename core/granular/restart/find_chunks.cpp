// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/find_chunks.h"

#include "granular/bonds/bond_record.h"
#include "granular/restart/record_walker.h"
#include "granular/restart/restart_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t count_bytes = 4;
constexpr auto least_doubles = static_cast<std::int64_t>(RecordSlots::common);
constexpr std::size_t scan_window = std::size_t{ 1 } << 17;

/// A complete file needs one walk over its records, and a hop for each process, each of which has a count there.
SearchBudget budget_of(std::int64_t bytes, std::int64_t processes)
{
  const std::int64_t hops = std::min(processes, bytes / count_bytes);
  return { 4 * (bytes / (8 * least_doubles) + hops) + 1'000'000,
    2 * bytes + (std::int64_t{ 1 } << 28) };
}

constexpr std::size_t pair_bytes = 12; ///< of a count and the length of a record

/// The next place from `at` on of a count, not above `most`, and the length of a record that fits into so many doubles; the end of what
/// can be such a place if there is none. As one loop for each byte order: it goes over all bytes of a file.
template <bool Swapped>
std::size_t next_pair(std::string_view bytes, std::size_t at, std::int64_t most) noexcept
{
  const std::size_t end = bytes.size() - (pair_bytes - 1);
  const auto range = static_cast<std::uint64_t>(most - least_doubles);
  for (; at < end; ++at)
  {
    const std::int64_t count = load_number<std::int32_t>(bytes.data() + at, Swapped);
    if (static_cast<std::uint64_t>(count - least_doubles) > range)
    {
      continue;
    }
    const double length = load_number<double>(bytes.data() + at + count_bytes, Swapped);
    if (length >= least_doubles && length <= static_cast<double>(count) &&
      length == std::floor(length))
    {
      return at;
    }
  }
  return end;
}

/// Where the search is for.
enum class Behind : std::uint8_t
{
  End,     ///< the end of the file
  Anything ///< meshes
};

class ChunkFinder
{
public:
  ChunkFinder(const ByteSource& source, bool swapped, const RestartHeader& header,
    std::int64_t begin, Progress& progress)
    : header_(header)
    , begin_(begin)
    , progress_(progress)
    , scan_(source, swapped)
    , hops_(source, swapped)
    , walker_(source, swapped, header, false, progress)
    , walker_in_box_(source, swapped, header, true, progress)
    , size_(scan_.size())
    , budget_(budget_of(size_, header.processes))
  {
  }

  ChunkSearch find()
  {
    if (header_.atoms == 0)
    {
      this->find_none();
      return std::move(result_);
    }
    this->scan(Behind::End);
    if (!result_.found && header_.time)
    {
      budget_ = budget_of(size_, header_.processes);
      this->scan(Behind::Anything);
    }
    return std::move(result_);
  }

private:
  /// Chunks from one with records on.
  struct Run
  {
    std::int64_t chunks = 0;
    std::int64_t end = 0; ///< byte behind the last
  };

  /// No particles: a zero for each process. With meshes behind them they cannot be told from what comes before.
  void find_none()
  {
    const std::int64_t first = size_ - header_.processes * count_bytes;
    if (first >= begin_ && this->zeros(first, size_))
    {
      this->take(first, size_);
    }
    else if (header_.time)
    {
      result_.found = true;
      result_.begin = size_;
    }
  }

  void scan(Behind behind)
  {
    const auto next = scan_.swapped() ? &next_pair<true> : &next_pair<false>;
    for (std::int64_t at = begin_; size_ - at >= 8 * least_doubles;)
    {
      progress_.step(static_cast<double>(at) / static_cast<double>(size_));
      const std::string_view bytes = scan_.view(at, scan_window);
      if (bytes.size() < pair_bytes)
      {
        return;
      }
      const std::size_t end = bytes.size() - (pair_bytes - 1);
      const std::int64_t most = (size_ - at) / 8;
      for (std::size_t i = next(bytes, 0, most); i < end; i = next(bytes, i + 1, most))
      {
        if (this->try_at(at + static_cast<std::int64_t>(i), behind) || result_.gave_up)
        {
          return;
        }
      }
      at += static_cast<std::int64_t>(end);
    }
  }

  bool try_at(std::int64_t at, Behind behind)
  {
    const bool found = behind == Behind::End ? this->try_to_end(at) : this->try_inside(at);
    result_.gave_up = !found && budget_.spent();
    return found;
  }

  /// From a chunk that has records to the end of the file.
  bool try_to_end(std::int64_t at)
  {
    const Run run = this->hop(at);
    if (run.end != size_)
    {
      return false;
    }
    const std::int64_t first = at - (header_.processes - run.chunks) * count_bytes;
    if (first < begin_ || !this->zeros(first, at))
    {
      return false;
    }
    walker_.reset();
    for (std::int64_t chunk = at; chunk < size_;)
    {
      const std::int64_t doubles = this->doubles_at(chunk); // which may be others by now
      if (doubles < 0 || !walker_.walk(chunk + count_bytes, doubles, budget_))
      {
        return false;
      }
      chunk += count_bytes + doubles * 8;
    }
    if (walker_.records() != header_.atoms)
    {
      result_.misfit = std::max(result_.misfit.value_or(0), walker_.records());
      return false;
    }
    this->take(first, size_);
    return true;
  }

  /// Hops over chunks, as many as there are processes or up to the end of the file.
  Run hop(std::int64_t at)
  {
    Run run = { 0, at };
    while (run.end < size_ && run.chunks < header_.processes)
    {
      const std::int64_t doubles = this->doubles_at(run.end);
      const bool fits = doubles == 0 || doubles >= least_doubles;
      if (!fits || budget_.spent())
      {
        return { 0, -1 };
      }
      run.end += count_bytes + doubles * 8;
      ++run.chunks;
    }
    return run;
  }

  /// From a chunk that has records to the last that has, wherever it ends.
  bool try_inside(std::int64_t at)
  {
    Run run = { 0, at };
    walker_in_box_.reset();
    while (walker_in_box_.records() < header_.atoms)
    {
      const std::int64_t doubles =
        run.chunks < header_.processes && !budget_.spent() ? this->doubles_at(run.end) : -1;
      if (doubles < 0 || !walker_in_box_.walk(run.end + count_bytes, doubles, budget_))
      {
        return false;
      }
      run.end += count_bytes + doubles * 8;
      ++run.chunks;
    }
    if (walker_in_box_.records() != header_.atoms)
    {
      return false;
    }
    // those without records are before, as far as there are zeros, else behind
    std::int64_t missing = header_.processes - run.chunks;
    std::int64_t first = at;
    for (;
         missing > 0 && first - count_bytes >= begin_ && this->doubles_at(first - count_bytes) == 0;
         --missing)
    {
      first -= count_bytes;
    }
    for (; missing > 0 && this->doubles_at(run.end) == 0; --missing)
    {
      run.end += count_bytes;
    }
    if (missing == 0)
    {
      this->take(first, run.end);
    }
    return missing == 0;
  }

  /// The count of a chunk, for whose doubles there is room; -1 where there is none.
  std::int64_t doubles_at(std::int64_t at)
  {
    const std::int64_t before = hops_.read_bytes();
    const std::string_view bytes = hops_.view(at, count_bytes);
    --budget_.steps;
    budget_.bytes -= hops_.read_bytes() - before;
    const std::int64_t doubles = bytes.size() < count_bytes ? -1 : hops_.int32_in(bytes.data());
    return doubles > (size_ - at - count_bytes) / 8 ? -1 : doubles;
  }

  bool zeros(std::int64_t first, std::int64_t end)
  {
    while (first < end)
    {
      const std::int64_t before = hops_.read_bytes();
      const std::string_view there = hops_.view(first, 1);
      --budget_.steps;
      budget_.bytes -= hops_.read_bytes() - before;
      const std::string_view part = there.substr(0, static_cast<std::size_t>(end - first));
      if (part.empty() || budget_.spent() || part.find_first_not_of('\0') != part.npos)
      {
        return false;
      }
      first += static_cast<std::int64_t>(part.size());
    }
    return true;
  }

  /// All chunks were there a moment ago.
  void take(std::int64_t first, std::int64_t end)
  {
    result_.begin = first;
    result_.records = header_.atoms;
    for (std::int64_t at = first; at < end;)
    {
      const std::int64_t doubles = this->doubles_at(at);
      if (doubles < 0)
      {
        throw IoError("the file changed while it was read: expected the number of doubles of a "
                      "process, got another one",
          scan_.where(at));
      }
      result_.chunks.push_back({ {}, at + count_bytes, doubles });
      at += count_bytes + doubles * 8;
    }
    result_.found = true;
  }

  const RestartHeader& header_;
  std::int64_t begin_;
  Progress& progress_;
  RestartBytes scan_;
  RestartBytes hops_;
  RecordWalker walker_;
  RecordWalker walker_in_box_;
  std::int64_t size_;
  SearchBudget budget_;
  ChunkSearch result_;
};
}

ChunkSearch find_chunks(const ByteSource& source, bool swapped, const RestartHeader& header,
  std::int64_t begin, Progress& progress)
{
  return ChunkFinder(source, swapped, header, begin, progress).find();
}
}
