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
    constexpr std::size_t pair = 8; ///< two counts at least
    for (std::int64_t at = begin; at + static_cast<std::int64_t>(pair) <= end_;)
    {
      progress.step(static_cast<double>(at - begin) / static_cast<double>(end_ - begin));
      const std::string_view bytes = scan_.view(at, scan_window);
      for (std::size_t i = 0; i + pair <= bytes.size(); ++i)
      {
        const std::int64_t place = at + static_cast<std::int64_t>(i);
        if (this->may_begin(bytes.data() + i, place) && this->read_at(place))
        {
          return std::move(result_);
        }
        if (budget_.spent())
        {
          return {};
        }
      }
      if (bytes.size() < pair)
      {
        break;
      }
      at += static_cast<std::int64_t>(bytes.size() - pair + 1);
    }
    return {};
  }

private:
  /// Two counts: of fixes, and of the bytes of the first id, or of fixes of the other kind.
  bool may_begin(const char* bytes, std::int64_t place) const noexcept
  {
    const std::int64_t first = scan_.int32_in(bytes);
    const std::int64_t second = scan_.int32_in(bytes + 4);
    if (first == 0 && second == 0)
    {
      return place + 8 == end_;
    }
    constexpr std::int64_t least_bytes = 16; ///< of a fix
    const std::int64_t most = (end_ - place) / least_bytes;
    return first >= 0 && first <= most && second >= 0 &&
      second <= (first == 0 ? most : RestartBytes::most_text);
  }

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
