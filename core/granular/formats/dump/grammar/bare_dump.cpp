// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace granular
{
namespace
{
/// Calls visit(line) for each line with words, in which the scanner knows where it is.
template <class Visit>
void for_each_row(TextScanner& scanner, const Visit& visit)
{
  for (std::string_view line; scanner.next(line);)
  {
    if (!says_nothing(line))
    {
      visit(line);
    }
  }
}

/// Returns the ids of all rows; none if a row has no integer there.
std::vector<std::int64_t> read_ids(const ByteSource& source, int column)
{
  std::vector<std::int64_t> ids;
  bool all = column >= 0;
  TextScanner scanner(source, 0, 1);
  for_each_row(scanner,
    [&](std::string_view line)
    {
      std::string_view word;
      for (int i = 0; i <= column; ++i)
      {
        word = take_word(line);
      }
      ids.push_back(0);
      all = all && parse_int64(word.data(), word.data() + word.size(), ids.back());
    });
  return all ? ids : std::vector<std::int64_t>();
}

/// Returns the number of rows after which the same ids come again, as often as there are rows for; 0: they do not.
std::size_t rows_a_frame(const std::vector<std::int64_t>& ids)
{
  std::unordered_set<std::int64_t> seen;
  const auto again =
    std::ranges::find_if(ids, [&](std::int64_t id) { return !seen.insert(id).second; });
  const auto rows = static_cast<std::size_t>(again - ids.begin());
  std::vector<std::int64_t> first(ids.begin(), again);
  std::ranges::sort(first);
  for (std::size_t at = 0; rows > 0 && at + rows <= ids.size(); at += rows)
  {
    std::vector<std::int64_t> next(ids.data() + at, ids.data() + at + rows);
    std::ranges::sort(next);
    if (next != first)
    {
      return 0;
    }
  }
  return rows;
}
}

void index_bare_dump(const ByteSource& source, FileIndex& index)
{
  forget_frames(index);
  TextScanner scanner(source, 0, 1);
  FrameKind kind;
  kind.layout = FrameKind::bare;
  std::vector<std::string_view> words;
  take_first_row(scanner, 1, words);
  if (words.size() != index.column_names.size())
  {
    throw FormatError("expected " + std::to_string(index.column_names.size()) +
        " words in a row, as in ColumnNames, got " + std::to_string(words.size()),
      scanner.where());
  }
  kind.schema = make_schema(index.column_names, words, "ATOMS", scanner.where());
  const std::vector<std::int64_t> ids = read_ids(source, kind.schema.find(ColumnRole::Id));
  const auto rows = static_cast<std::int64_t>(rows_a_frame(ids));
  FrameEntry entry;
  entry.kind = index.kinds->share(std::move(kind));
  scanner.go_to(0, 1);
  for_each_row(scanner,
    [&](std::string_view)
    {
      if (index.frames.empty() || index.frames.back().rows == rows)
      {
        entry.offset = scanner.last_offset();
        entry.line = scanner.last_line();
        index.frames.push_back(entry);
        ++entry.timestep;
      }
      ++index.frames.back().rows;
      index.frames.back().end = scanner.offset();
    });
  const std::size_t frames = index.frames.size();
  const std::string told = std::to_string(frames) + " frames of " + std::to_string(rows) +
    " rows, told apart by ids that come again";
  index.notices.push_back({ { source.path() },
    "rows without headers: " + (frames > 1 ? told : "all rows are one frame"), "bare" });
  if (char byte = 0; source.read(scanner.offset(), &byte, 1) > 0)
  {
    index.notices.push_back(
      { { source.path(), scanner.line() }, "a last row without its line feed is left out" });
  }
  if (frames > 1 && index.frames.back().rows < rows)
  {
    set_defect(index,
      { where_of(source.path(), index.frames.back()),
        "expected " + std::to_string(rows) + " rows, got " +
          std::to_string(index.frames.back().rows) });
    index.frames.pop_back();
  }
}
}
