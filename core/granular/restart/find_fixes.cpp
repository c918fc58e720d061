// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/find_fixes.h"

#include "granular/restart/restart_bytes.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::int64_t count_bytes = 4;
constexpr std::int64_t none_bytes = 2 * count_bytes; ///< of no fixes of either kind
constexpr std::int64_t least_bytes = 16;             ///< of a fix

/// Returns true if there may be two counts: of fixes, and of the bytes of the first id, or of fixes of the other kind. Not two zeros, of
/// which files are full.
constexpr auto is_pair = [](const char* bytes, bool swapped, std::int64_t left) noexcept
{
  const std::int64_t most = left / least_bytes;
  const std::int64_t first = load_number<std::int32_t>(bytes, swapped);
  if (first < 0 || first > most)
  {
    return false;
  }
  const std::int64_t second = load_number<std::int32_t>(bytes + count_bytes, swapped);
  return first == 0 ? second > 0 && second <= most
                    : second >= 0 && second <= RestartBytes::most_text;
};

class FixFinder
{
public:
  FixFinder(const ByteSource& source, bool swapped, std::int64_t begin, std::int64_t end)
    : budget_{ (end - begin) / 8 + 1'000'000, 4 * (end - begin) + (std::int64_t{ 1 } << 28) }
    , bytes_(source, swapped, &budget_)
    , begin_(begin)
    , end_(end)
  {
  }

  FixSearch find(Progress& progress)
  {
    const auto try_at = [&](std::int64_t at) { return this->read_at(at) || budget_.spent(); };
    search_pairs<none_bytes>(
      bytes_.source(), bytes_.swapped(), begin_, end_, none_bytes, is_pair, try_at, progress);
    const std::int64_t none = end_ - none_bytes;
    if (!result_.found && !budget_.spent() && none >= begin_)
    {
      this->read_at(none);
    }
    return result_.found ? std::move(result_) : FixSearch{};
  }

private:
  bool read_at(std::int64_t place)
  {
    at_ = place;
    result_.fixes.clear();
    result_.found = this->read_global() && this->read_peratom() && at_ == end_;
    return result_.found;
  }

  bool read_global()
  {
    bool right = this->next_count(result_.global);
    for (std::int64_t i = 0; right && i < result_.global; ++i)
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
      right = this->pass_text(&fix.id) && this->pass_text(&fix.style) && this->next_count(fix.most);
      result_.fixes.push_back(std::move(fix));
    }
    return right;
  }

  bool next_count(std::int64_t& count)
  {
    const std::string_view there = bytes_.view(at_, count_bytes);
    --budget_.steps;
    if (there.size() < count_bytes || at_ + count_bytes > end_ || budget_.steps <= 0)
    {
      return false;
    }
    count = bytes_.load<std::int32_t>(there.data());
    at_ += count_bytes;
    return count >= 0;
  }

  bool pass_text(std::string* text = nullptr)
  {
    constexpr std::int64_t cost = 64; ///< to look at the longest text, in steps
    budget_.steps -= cost;
    const std::int64_t behind = bytes_.text_end(at_);
    if (behind < 0 || behind > end_ || budget_.steps <= 0)
    {
      return false;
    }
    if (text)
    {
      *text = bytes_.next_text(at_, "a fix");
    }
    at_ = behind;
    return true;
  }

  SearchBudget budget_;
  RestartBytes bytes_;
  std::int64_t begin_;
  std::int64_t end_;
  std::int64_t at_ = 0;
  FixSearch result_;
};
}

FixSearch find_fixes(
  const ByteSource& source, bool swapped, std::int64_t begin, std::int64_t end, Progress& progress)
{
  return FixFinder(source, swapped, begin, end).find(progress);
}
}
