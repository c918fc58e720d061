// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_dump.h"

#include "granular/common/hash.h"
#include "granular/formats/dump/grammar/atom_fit.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace granular
{
namespace
{
/// Columns of old dumps of LAMMPS that do not name them: dump atom, scaled, with or without images.
std::vector<std::string> unnamed_columns(std::size_t words, const Where& where)
{
  if (words != 0 && words != 5 && words != 8)
  {
    throw FormatError(
      "expected 5 or 8 words in a row of a dump that does not name its columns, got " +
        std::to_string(words),
      where);
  }
  return name_columns(words == 8 ? 8 : 5, {}, { .scaled = true }).names;
}

bool is_number(std::string_view word)
{
  double number = 0;
  return static_cast<bool>(parse_double(word.data(), word.data() + word.size(), number));
}

/// The schema of a frame, from its names and its first row: a column that the table does not know
/// holds texts if the first one is no number. counted: the rows.
ColumnSchema make_schema(std::vector<std::string> names,
  const std::vector<std::string_view>& first_row, const std::string& counted, const Where& where)
{
  if (names.empty())
  {
    names = counted == "ATOMS" ? unnamed_columns(first_row.size(), where)
                               : numbered_columns(first_row.size());
  }
  ColumnSchema schema(names, known_columns(), where);
  std::vector<ColumnSchema::TypeChange> texts;
  for (std::size_t i = 0; i < std::min(names.size(), first_row.size()); ++i)
  {
    if (!schema.columns()[i].known && !is_number(first_row[i]))
    {
      texts.push_back({ static_cast<int>(i), ValueType::Text });
    }
  }
  schema.set_types(texts);
  return schema;
}

/// Returns true if make_schema would give that schema; false where rows have columns without names.
bool makes_schema(const std::vector<std::string>& names,
  const std::vector<std::string_view>& first_row, const ColumnSchema& schema)
{
  const std::vector<ColumnInfo>& columns = schema.columns();
  for (std::size_t i = 0; i < columns.size() && names.size() == columns.size(); ++i)
  {
    const bool text = !columns[i].known && i < first_row.size() && !is_number(first_row[i]);
    if (columns[i].name != names[i] ||
      (!columns[i].known && text != (columns[i].type == ValueType::Text)))
    {
      return false;
    }
  }
  return names.size() == columns.size() && (!names.empty() || first_row.empty());
}

/// Takes the words of the first row, if there is one. They stay until the scanner moves on.
bool take_first_row(TextScanner& scanner, std::int64_t rows, std::vector<std::string_view>& words)
{
  std::string_view line;
  words.clear();
  while (rows > 0 && words.empty() && scanner.next(line))
  {
    append_words(line, words);
  }
  return !words.empty();
}

/// Finds the frames of a text, one after the other.
class Indexer
{
public:
  Indexer(const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead,
    RowsOf rows_of)
    : source_(source)
    , index_(index)
    , progress_(progress)
    , scanner_(source, index.resume_offset, index.resume_line, window, ahead)
    , reader_(scanner_, index.units, rows_of)
  {
  }

  void run()
  {
    while (this->next_frame())
    {
    }
  }

private:
  /// False at the end of the text.
  bool next_frame()
  {
    reader_.restart(index_.units);
    Notice why;
    try
    {
      return this->read_frame();
    }
    catch (const FormatError& error)
    {
      why = { error.where(), error.text() };
    }
    catch (const LimitError& error)
    {
      why = { error.where(), error.text() };
    }
    const bool more = this->go_to_next_frame();
    const bool is_frame = more || reader_.opened() || !index_.frames.empty();
    this->leave_out(why.where, why.text, is_frame ? "frame" : "file");
    return more;
  }

  bool read_frame()
  {
    if (!reader_.read())
    {
      if (reader_.opened())
      {
        set_defect(index_,
          { { source_.path(), reader_.line() },
            "expected a complete frame, got the end of the file in its header" });
      }
      return false;
    }
    const FrameHeader& header = reader_.header();
    rows_offset_ = scanner_.offset();
    index_.units = header.units;
    FrameEntry entry;
    entry.timestep = header.timestep;
    entry.rows = header.rows;
    entry.offset = reader_.offset();
    entry.line = reader_.line();
    entry.time = header.time.value_or(FrameEntry::no_time);
    entry.kind = this->kind();
    entry.shape = hash_shape(header, *entry.kind);
    std::int64_t rows = scanner_.skip_to_item(progress_);
    entry.end = scanner_.offset();
    std::string_view next;
    const bool at_end = !this->peek(next);
    if (this->find_glued_header(entry, rows) && rows != entry.rows)
    {
      this->leave_out({ source_.path(), entry.line },
        "expected " + std::to_string(entry.rows) +
          " rows, got the header of another frame within a row");
      return true;
    }
    return this->finish_frame(entry, rows, at_end);
  }

  /// Keeps the frame if it has the rows that its header promises.
  bool finish_frame(FrameEntry& entry, std::int64_t rows, bool at_end)
  {
    if (rows == entry.rows)
    {
      index_.resume_offset = scanner_.offset();
      index_.resume_line = scanner_.line();
      index_.frames.push_back(std::move(entry));
      return true;
    }
    const Where where{ source_.path(), entry.line };
    std::string why =
      "expected " + std::to_string(entry.rows) + " rows, got " + std::to_string(rows);
    if (at_end && rows < entry.rows)
    {
      why += this->unfinished_line() ? ", and a last line without its line feed" : "";
      set_defect(index_, { where, why });
      return false;
    }
    this->leave_out(where, why);
    return true;
  }

  const std::shared_ptr<const FrameKind>& kind()
  {
    const std::int64_t line_of_names = scanner_.last_line();
    const bool found = take_first_row(scanner_, reader_.header().rows, first_row_);
    const std::vector<std::string>& names = reader_.column_names();
    const std::string& units = reader_.header().units;
    if (!kind_)
    {
      kind_ = index_.kinds->last(); // another file is mostly of the same
    }
    if (!kind_ || kind_->layout != FrameKind::text || kind_->units != units ||
      !makes_schema(names, first_row_, kind_->schema))
    {
      kind_ = index_.kinds->share({ make_schema(names, first_row_, reader_.header().counted,
                                      { source_.path(), line_of_names }),
        units });
    }
    if (found)
    {
      scanner_.put_back();
    }
    return kind_;
  }

  void leave_out(const Where& where, const std::string& why, const char* what = "frame")
  {
    set_defect(index_, { where, why });
    index_.notices.push_back({ where, why + "; the " + what + " is left out" });
  }

  bool go_to_next_frame()
  {
    std::string_view line;
    for (;;)
    {
      scanner_.skip_to_item(progress_);
      if (!this->peek(line))
      {
        return false;
      }
      if (opens_frame(item_words(line)))
      {
        return true;
      }
      scanner_.next(line);
    }
  }

  /// The line that comes next, and stays. False at the end of the text, and where what comes is not
  /// even a line: a file system that lost power leaves zeros.
  bool peek(std::string_view& line)
  {
    try
    {
      if (!scanner_.next(line))
      {
        return false;
      }
    }
    catch (const LimitError&)
    {
      return false;
    }
    scanner_.put_back();
    return true;
  }

  /// Returns true if something follows the last line feed.
  bool unfinished_line() const
  {
    char byte = 0;
    return source_.read(scanner_.offset(), &byte, 1) > 0;
  }

  /// A run that was killed within a row and then went on appending leaves "0.16ITEM: TIMESTEP".
  /// Looks for that in the few lines before the scanner, goes there, and ends the frame before it:
  /// rows becomes the number of its rows.
  bool find_glued_header(FrameEntry& entry, std::int64_t& rows)
  {
    constexpr std::int64_t reach = 512; // two sections of a header, and more
    const std::int64_t to = scanner_.offset();
    const std::int64_t start = std::max(rows_offset_, to - reach);
    std::string buffer;
    const std::string_view tail = scanner_.before(static_cast<std::size_t>(to - start), buffer);
    for (const std::string_view opening : { "ITEM: UNITS", "ITEM: TIME", "ITEM: TIMESTEP" })
    {
      const std::size_t found = tail.find(opening);
      if (found != tail.npos)
      {
        const auto lines =
          std::count(tail.begin() + static_cast<std::ptrdiff_t>(found), tail.end(), '\n');
        const std::size_t feed = tail.rfind('\n', found);
        entry.end = start + static_cast<std::int64_t>(feed == tail.npos ? 0 : feed + 1);
        rows -= lines;
        scanner_.go_to(start + static_cast<std::int64_t>(found), scanner_.line() - lines);
        return true;
      }
    }
    return false;
  }

  static constexpr std::size_t window = std::size_t{ 1 } << 18;

  const ByteSource& source_;
  FileIndex& index_;
  Progress& progress_;
  TextScanner scanner_;
  TextHeader reader_;                       ///< of the frame at hand
  std::vector<std::string_view> first_row_; ///< its words
  std::shared_ptr<const FrameKind> kind_;   ///< of the frame before: most have the same
  std::int64_t rows_offset_ = 0;            ///< of the frame at hand
};

}

std::optional<RowsOf> tell_rows(std::string_view first_bytes)
{
  constexpr int longest_header = 64; // lines
  bool opened = false;
  if (first_bytes.starts_with(byte_order_mark))
  {
    first_bytes.remove_prefix(byte_order_mark.size());
  }
  for (int line = 0; line < longest_header && !first_bytes.empty(); ++line)
  {
    const std::size_t feed = first_bytes.find('\n');
    const std::string_view text = first_bytes.substr(0, feed);
    const std::vector<std::string_view> words = item_words(text);
    if (!opened && !split_words(text).empty())
    {
      if (!opens_frame(words))
      {
        return {};
      }
      opened = true;
    }
    if (feed != first_bytes.npos && begins_with(words, "NUMBER OF"))
    {
      return begins_with(words, "NUMBER OF ATOMS") ? RowsOf::Particles : RowsOf::Others;
    }
    if (feed != first_bytes.npos && begins_with(words, "GRID SIZE"))
    {
      return RowsOf::Cells;
    }
    first_bytes.remove_prefix(feed == first_bytes.npos ? first_bytes.size() : feed + 1);
  }
  return opened ? std::optional(RowsOf::Any) : std::nullopt;
}

bool is_text_dump(std::string_view first_bytes)
{
  const std::optional<RowsOf> rows = tell_rows(first_bytes);
  return rows == RowsOf::Particles || rows == RowsOf::Any;
}

std::vector<std::string> numbered_columns(std::size_t count)
{
  std::vector<std::string> names;
  while (names.size() < count)
  {
    names.push_back("column" + std::to_string(names.size() + 1));
  }
  return names;
}

bool makes_columns(const TextHeader& header, TextScanner& scanner, const ColumnSchema& schema)
{
  const std::vector<std::string>& names = header.column_names();
  std::vector<std::string_view> first_row;
  take_first_row(scanner, header.header().rows, first_row);
  if (makes_schema(names, first_row, schema))
  {
    return true;
  }
  try
  {
    // names that no header gives
    return make_schema(names, first_row, header.header().counted, {}) == schema;
  }
  catch (const FormatError&)
  {
    return false;
  }
}

void index_text_dump(const ByteSource& source, FileIndex& index, Progress& progress,
  const ScanAhead& ahead, RowsOf rows_of)
{
  Indexer(source, index, progress, ahead, rows_of).run();
}

std::vector<std::int64_t> hash_first_rows(const FileIndex& file, const FrameEntry& entry)
{
  constexpr std::int64_t most_bytes = std::int64_t{ 1 } << 18;
  std::string bytes(static_cast<std::size_t>(std::min(entry.end - entry.offset, most_bytes)), ' ');
  bytes.resize(open_indexed(file)->read(entry.offset, bytes.data(), bytes.size()));
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return { std::bit_cast<std::int64_t>(hash.value()) };
}
}
