// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/find_fixes.h"

#include "granular/restart/record_walker.h"
#include "granular/restart/restart_bytes.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t scan_window = std::size_t{ 1 } << 17;
constexpr std::int64_t least_bytes = 16; ///< of a fix
constexpr std::size_t pair_bytes = 8;    ///< of two counts, the least that there is

/// The next place from `at` on of two counts: of fixes, at most so many, and of the bytes of the first id, or of fixes of the other
/// kind. The end of what can be such a place if there is none. As one loop for each byte order.
template <bool Swapped>
std::size_t next_pair(std::string_view bytes, std::size_t at, std::int64_t most) noexcept
{
  const std::size_t end = bytes.size() - (pair_bytes - 1);
  for (; at < end; ++at)
  {
    const std::int64_t first = load_number<std::int32_t>(bytes.data() + at, Swapped);
    if (first < 0 || first > most)
    {
      continue;
    }
    const std::int64_t second = load_number<std::int32_t>(bytes.data() + at + 4, Swapped);
    if (second >= 0 && second <= (first == 0 ? most : RestartBytes::most_text))
    {
      return at;
    }
  }
  return end;
}

class FixFinder
{
public:
  FixFinder(const ByteSource& source, bool swapped, std::int64_t end)
    : scan_(source, swapped)
    , bytes_(source, swapped)
    , end_(end)
  {
  }

  FixSearch find(std::int64_t begin, Progress& progress)
  {
    budget_ = { (end_ - begin) / 8 + 1'000'000, 4 * (end_ - begin) + (std::int64_t{ 1 } << 28) };
    const auto next = scan_.swapped() ? &next_pair<true> : &next_pair<false>;
    for (std::int64_t at = begin; end_ - at >= static_cast<std::int64_t>(pair_bytes);)
    {
      progress.step(static_cast<double>(at - begin) / static_cast<double>(end_ - begin));
      const std::string_view bytes = scan_.view(at, scan_window);
      if (bytes.size() < pair_bytes)
      {
        break;
      }
      const std::size_t end = bytes.size() - (pair_bytes - 1);
      const std::int64_t most = (end_ - at) / least_bytes;
      for (std::size_t i = next(bytes, 0, most); i < end; i = next(bytes, i + 1, most))
      {
        const std::int64_t place = at + static_cast<std::int64_t>(i);
        const std::int64_t both = scan_.int64_in(bytes.data() + i);
        const bool is_none = both == 0 && place + static_cast<std::int64_t>(pair_bytes) != end_;
        if (!is_none && this->read_at(place))
        {
          return std::move(result_);
        }
        if (budget_.spent())
        {
          return {};
        }
      }
      at += static_cast<std::int64_t>(end);
    }
    return {};
  }

private:
  bool read_at(std::int64_t place)
  {
    at_ = place;
    result_.fixes.clear();
    const std::int64_t read_before = bytes_.read_bytes();
    result_.found = this->read_global() && this->read_peratom() && at_ == end_;
    budget_.bytes -= bytes_.read_bytes() - read_before;
    return result_.found;
  }

  bool read_global()
  {
    std::int64_t count = 0;
    bool right = this->next_count(count);
    result_.global = count;
    for (std::int64_t i = 0; right && i < count; ++i)
    {
      std::int64_t bytes = 0;
      right =
        this->pass_text() && this->pass_text() && this->next_count(bytes) && bytes <= end_ - at_;
      at_ += bytes;
    }
    return right;
  }

  bool read_peratom()
  {
    std::int64_t count = 0;
    bool right = this->next_count(count);
    for (std::int64_t i = 0; right && i < count; ++i)
    {
      RestartFix fix;
      right = this->next_text(fix.id) && this->next_text(fix.style) && this->next_count(fix.most);
      result_.fixes.push_back(std::move(fix));
    }
    return right;
  }

  bool next_count(std::int64_t& count)
  {
    const std::string_view there = bytes_.view(at_, 4);
    --budget_.steps;
    if (there.size() < 4 || at_ + 4 > end_ || budget_.steps <= 0)
    {
      return false;
    }
    count = bytes_.int32_in(there.data());
    at_ += 4;
    return count >= 0;
  }

  bool pass_text()
  {
    constexpr std::int64_t cost = 64; ///< to look at the longest text, in steps
    budget_.steps -= cost;
    const std::int64_t behind = bytes_.text_end(at_);
    at_ = behind < 0 ? at_ : behind;
    return behind >= 0 && behind <= end_ && budget_.steps > 0;
  }

  bool next_text(std::string& text)
  {
    const std::int64_t begin = at_;
    const bool right = this->pass_text();
    text = right ? bytes_.text_at(begin, "a fix") : std::string();
    return right;
  }

  RestartBytes scan_;
  RestartBytes bytes_;
  std::int64_t end_;
  std::int64_t at_ = 0;
  SearchBudget budget_;
  FixSearch result_;
};
}

FixSearch find_fixes(
  const ByteSource& source, bool swapped, std::int64_t begin, std::int64_t end, Progress& progress)
{
  return FixFinder(source, swapped, end).find(begin, progress);
}
}
