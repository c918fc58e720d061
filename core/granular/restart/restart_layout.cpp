// SPDX-License-Identifier: BSD-3-Clause
#include "granular/restart/restart_layout.h"

#include "granular/restart/find_chunks.h"
#include "granular/restart/find_fixes.h"
#include "granular/restart/process_files.h"
#include "granular/restart/restart_bytes.h"

#include <memory>
#include <utility>

namespace granular
{
namespace
{
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
      this->read_files(*files);
      return std::move(layout_);
    }
    ChunkSearch search =
      find_chunks(bytes_.source(), layout_.swapped, layout_.header, at_, progress_);
    progress_.set_part(0.8, 1);
    if (search.found)
    {
      layout_.begin = search.begin;
      layout_.chunks = std::move(search.chunks);
      layout_.records = layout_.header.atoms;
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
    FixSearch fixes = find_fixes(bytes_.source(), layout_.swapped, at_, end, progress_);
    layout_.has_fixes = fixes.found;
    layout_.fixes = fixes.fixes;
    return fixes;
  }

  /// The particles are in files of their own.
  void read_files(const ProcessNames& names)
  {
    layout_.begin = layout_.size;
    read_process_files(names, layout_, progress_);
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
      this->read_files(files ? *files : names.front()); // the first says which file is missing
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
  const std::string content = read_content(source, progress);
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
