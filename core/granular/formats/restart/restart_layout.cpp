// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/restart/restart_layout.h"

#include "granular/formats/restart/find_chunks.h"
#include "granular/formats/restart/process_files.h"
#include "granular/formats/restart/restart_bytes.h"

#include <cstddef>
#include <limits>
#include <memory>
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

/// The known properties of fixes.
struct FixSearch
{
  bool found = false;
  std::int64_t global = 0; ///< number of fixes with a state of their own
  std::vector<RestartFix> fixes;
};

/// Finds what fixes have stored between two bytes: the first place from which it leads to `end` exactly. A fix with a state of
/// its own has an id, a style, a count of bytes and these; one that adds to records an id, a style and the doubles that it
/// may have in one.
class FixFinder
{
public:
  FixFinder(const RestartBytes& bytes, std::int64_t begin, std::int64_t end)
    : budget_{ (end - begin) / 8 + 1'000'000, 4 * (end - begin) + (std::int64_t{ 1 } << 28) }
    , bytes_(bytes.source(), bytes.swapped(), &budget_)
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
    std::int64_t of_records = 0;
    result_.found =
      this->read_list(result_.global, false) && this->read_list(of_records, true) && at_ == end_;
    return result_.found;
  }

  /// Reads how many fixes there are, and these: those that add to records, or those with a state.
  bool read_list(std::int64_t& count, bool of_records)
  {
    bool right = this->next_count(count);
    for (std::int64_t i = 0; right && i < count; ++i)
    {
      RestartFix fix;
      right = this->next_text(fix.id) && this->next_text(fix.style) && this->next_count(fix.most);
      if (of_records)
      {
        result_.fixes.push_back(std::move(fix));
        continue;
      }
      right = right && fix.most <= end_ - at_;
      at_ += fix.most;
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

  bool next_text(std::string& text)
  {
    constexpr std::int64_t cost = 64; ///< to look at the longest text, in steps
    budget_.steps -= cost;
    const std::int64_t behind = bytes_.text_end(at_);
    if (behind < 0 || behind > end_ || budget_.steps <= 0)
    {
      return false;
    }
    text = bytes_.next_text(at_, "a fix");
    return true;
  }

  SearchBudget budget_;
  RestartBytes bytes_;
  std::int64_t begin_;
  std::int64_t end_;
  std::int64_t at_ = 0;
  FixSearch result_;
};

/// Reads the layout of a file of which the size is known.
class LayoutReader
{
public:
  LayoutReader(const ByteSource& source, Progress& progress)
    : bytes_(source)
    , progress_(progress)
  {
  }

  RestartLayout read()
  {
    layout_.header = read_header(bytes_);
    layout_.swapped = bytes_.swapped();
    layout_.size = bytes_.size();
    at_ = layout_.header.end;
    this->read_groups();
    this->read_masses();
    progress_.set_part(0, 0.8);
    const std::vector<ProcessNames> names = process_names(bytes_.source().path());
    const ProcessNames* const files =
      layout_.header.atoms == 0 ? find_process_names(names) : nullptr;
    if (files)
    {
      // before the zeros at the end of the file, which may be counts of fixes
      this->take_fixes(layout_.size);
      read_process_files(*files, layout_, progress_);
      return std::move(layout_);
    }
    const ChunkSearch search = find_chunks(bytes_.source(), at_, layout_, progress_);
    progress_.set_part(0.8, 1);
    if (search.found)
    {
      this->take_fixes(layout_.begin);
    }
    else
    {
      this->read_others(search, names);
    }
    return std::move(layout_);
  }

private:
  /// Reads the number of groups, then slots until so many were seen: a count of bytes, 0 of a slot that is free, and the name.
  void read_groups()
  {
    constexpr std::int32_t most = 32; ///< bits of a mask
    const auto count = bytes_.next<std::int32_t>(at_, "the number of groups");
    if (count < 1 || count > most)
    {
      bytes_.refuse("the number of groups, 1 to 32", std::to_string(count), at_ - 4);
    }
    for (std::int32_t seen = 0; seen < count;)
    {
      if (layout_.groups.size() == most)
      {
        bytes_.refuse("the names of " + std::to_string(count) + " groups in 32 places",
          std::to_string(seen), at_);
      }
      constexpr const char* what = "the name of a group";
      const bool is_free = bytes_.number_at<std::int32_t>(at_, what) == 0;
      layout_.groups.push_back(is_free ? "" : bytes_.next_text(at_, what));
      at_ += is_free ? 4 : 0;
      seen += is_free ? 0 : 1;
    }
  }

  /// A zero and the masses of all types, or nothing; then -1.
  void read_masses()
  {
    constexpr const char* what = "the masses of types (0), or their end (-1)";
    auto kind = bytes_.next<std::int32_t>(at_, what);
    if (kind == 0)
    {
      for (int type = 0; type < layout_.header.types; ++type)
      {
        layout_.masses.push_back(bytes_.next<double>(at_, "the mass of a type"));
      }
      kind = bytes_.next<std::int32_t>(at_, "the end of the masses of types (-1)");
    }
    if (kind != -1)
    {
      bytes_.refuse(what, std::to_string(kind), at_ - 4);
    }
  }

  /// Reads the values of fixes, which lie right before `end`.
  FixSearch take_fixes(std::int64_t end)
  {
    FixSearch fixes = FixFinder(bytes_, at_, end).find(progress_);
    layout_.has_fixes = fixes.found;
    layout_.fixes = fixes.fixes;
    return fixes;
  }

  /// They are there, or nowhere.
  void read_others(const ChunkSearch& search, const std::vector<ProcessNames>& names)
  {
    // without such a name they are for the message alone
    constexpr std::int64_t worth = std::int64_t{ 1 } << 20;
    const bool look = !names.empty() || layout_.size - at_ < worth;
    const FixSearch fixes = look ? this->take_fixes(layout_.size) : FixSearch{};
    const ProcessNames* const files = find_process_names(names);
    if (files || (fixes.found && !names.empty()))
    {
      // the first says which file is missing
      read_process_files(files ? *files : names.front(), layout_, progress_);
      return;
    }
    std::string text = "expected " + std::to_string(layout_.header.atoms) + " particles of " +
      std::to_string(layout_.header.processes) + " processes" +
      (layout_.header.time ? "" : " up to the end of the file") + ", found none behind byte " +
      std::to_string(at_) + "; understood: header, groups, masses";
    if (fixes.found && fixes.global + static_cast<std::int64_t>(fixes.fixes.size()) > 0)
    {
      text += ", fixes (" + std::to_string(fixes.global) + " and " +
        std::to_string(fixes.fixes.size()) + ")";
    }
    if (search.misfit)
    {
      text += "; found " + std::to_string(*search.misfit) + " particles where these should be";
    }
    if (search.gave_up)
    {
      text += "; gave up, as too much of the file looks like particles";
    }
    throw FormatError(text, { bytes_.source().path(), 0, at_ });
  }

  RestartBytes bytes_;
  PartialProgress progress_;
  std::int64_t at_ = 0;
  RestartLayout layout_;
};
}

RestartLayout read_layout(const ByteSource& source, Notices& notices, Progress& progress)
{
  if (!source.compressed())
  {
    RestartLayout layout = LayoutReader(source, progress).read();
    note_fixes(layout, source.path(), notices);
    return layout;
  }
  {
    RestartBytes first(source);
    read_header(first); // what is none is not unpacked
  }
  const std::string content =
    read_up_to(source, std::numeric_limits<std::int64_t>::max(), &progress);
  const std::unique_ptr<ByteSource> unpacked = open_memory(content, source.path());
  return read_layout(*unpacked, notices, progress);
}

void note_fixes(const RestartLayout& layout, const std::string& path, Notices& notices)
{
  if (!layout.has_fixes && layout.records > 0)
  {
    notices.push_back({ { path, 0, layout.begin },
      "expected what fixes have stored before the particles, found nothing: what they "
      "add to particles has no names" });
  }
}
}
